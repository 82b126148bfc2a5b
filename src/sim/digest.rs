//! A digest of a film's state, to compare runs bit by bit.

use bevy_math::Vec3;

use super::FilmState;
use crate::{film::FaceFate, stain::RustSource};

/// Name of the digest's algorithm and version of its fields.
pub const DIGEST_ALGORITHM: &str = "blake3-256/film-3";

impl FilmState {
    /// Feeds the state into `hasher`, all numbers little-endian: steps (u64); vertex, face and half-edge
    /// counts (u32 each); for each vertex original (u32), rest position, position (3 f32 each), adhesion,
    /// separation age (f32; infinite while attached), tip direction (3 f32); for each face its three origins
    /// (u32), fate (u8: 0 live, 1 stripped, 2 fallen), contraction (f32); for each half-edge torn (u8),
    /// binding (f32). Forces as they are now, however they are kept.
    ///
    /// Then the stains: for the film and then for the metal wet rust, stained rust, dust and moisture; then
    /// corrosion, exposure to rain and exposure to sun, each of these eleven as its length (u32) and its values
    /// (f32); the number of sources' states (u32) and the states (u8: 0 never, 1 present, 2 past); rust emitted
    /// and dripped (f64 each); the direction of streaks (3 f32). Exposure is part of it, as what a film does next
    /// depends on it. What stages can find again is not: areas, ways of run-off, counts for display.
    pub fn digest_into(&self, hasher: &mut blake3::Hasher) {
        let (topology, geometry) = (&self.mesh.topology, &self.mesh.geometry);
        let mut bytes = Vec::with_capacity(64 * topology.vertex_count() + 48 * topology.face_count());
        let vector = |bytes: &mut Vec<u8>, v: Vec3| v.to_array().iter().for_each(|x| bytes.extend(x.to_le_bytes()));
        bytes.extend(self.clock.steps.to_le_bytes());
        for count in [topology.vertex_count(), topology.face_count(), topology.half_edge_count()] {
            bytes.extend((count as u32).to_le_bytes());
        }
        for v in topology.all_vertices() {
            bytes.extend(topology.original(v).0.to_le_bytes());
            vector(&mut bytes, geometry.rest_positions[v.index()]);
            vector(&mut bytes, geometry.positions[v.index()]);
            bytes.extend(self.forces.adhesion(v).to_le_bytes());
            bytes.extend(self.forces.separated_age[v.index()].to_le_bytes());
            vector(&mut bytes, self.forces.tips[v.index()]);
        }
        for f in topology.all_faces() {
            topology.corners(f).iter().for_each(|v| bytes.extend(v.0.to_le_bytes()));
            bytes.push(match topology.fate(f) {
                FaceFate::Live => 0,
                FaceFate::Stripped => 1,
                FaceFate::Fallen => 2,
            });
            bytes.extend(self.forces.contraction(f).to_le_bytes());
        }
        for h in topology.all_half_edges() {
            bytes.push(u8::from(topology.is_torn(h)));
            bytes.extend(self.forces.binding(topology, h).to_le_bytes());
        }
        let stains = &self.stains;
        let layers =
            [&stains.film, &stains.metal].map(|layer| [&layer.wet, &layer.stained, &layer.dust, &layer.moisture]);
        let others = [&stains.corrosion, &stains.exposure.rain, &stains.exposure.sun];
        for field in layers.into_iter().flatten().chain(others) {
            bytes.extend((field.len() as u32).to_le_bytes());
            bytes.extend(field.iter().flat_map(|x| x.to_le_bytes()));
        }
        bytes.extend((stains.sources.len() as u32).to_le_bytes());
        bytes.extend(stains.sources.iter().map(|source| match source {
            RustSource::Never => 0,
            RustSource::Present => 1,
            RustSource::Past => 2,
        }));
        bytes.extend(stains.budget.emitted.to_le_bytes());
        bytes.extend(stains.budget.dripped.to_le_bytes());
        vector(&mut bytes, stains.streaks);
        hasher.update(&bytes);
    }

    /// The digest of this film alone, in hexadecimal; see [`FilmState::digest_into`] for what it covers.
    pub fn digest(&self) -> String {
        let mut hasher = blake3::Hasher::new();
        self.digest_into(&mut hasher);
        hasher.finalize().to_hex().to_string()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{film::FilmMesh, settings::CoatingSettings};

    #[test]
    fn every_field_of_stains_counts() {
        let mesh = FilmMesh::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y], &[[0, 1, 2]]).unwrap();
        let film = FilmState::from_mesh(mesh, &CoatingSettings::default(), 1, 100);
        let changes: [fn(&mut FilmState); 16] = [
            |film| film.stains.film.wet[0] = 0.5,
            |film| film.stains.film.stained[1] = 0.5,
            |film| film.stains.film.dust[2] = 0.5,
            |film| film.stains.film.moisture[0] = 0.5,
            |film| film.stains.metal.wet[0] = 0.5,
            |film| film.stains.metal.stained[1] = 0.5,
            |film| film.stains.metal.dust[2] = 0.5,
            |film| film.stains.metal.moisture[0] = 0.5,
            |film| film.stains.corrosion[1] = 0.5,
            |film| film.stains.exposure.rain = vec![0.5],
            |film| film.stains.exposure.sun = vec![0.5],
            |film| film.stains.sources[0] = RustSource::Present,
            |film| film.stains.sources[0] = RustSource::Past,
            |film| film.stains.budget.emitted = 0.5,
            |film| film.stains.budget.dripped = 0.5,
            |film| film.stains.streaks = Vec3::X,
        ];
        let mut digests = vec![film.digest()];
        for change in changes {
            let mut film = film.clone();
            change(&mut film);
            digests.push(film.digest());
        }
        digests.sort();
        digests.dedup();
        assert_eq!(digests.len(), 17);
    }
}
