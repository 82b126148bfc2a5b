//! Computes a digest of a film's state, to compare runs bit by bit.

use bevy_math::Vec3;

use super::state::FilmState;
use crate::{
    film::{FaceFate, words::Words},
    stain::RustSource,
};

/// Algorithm of the digest and version of the fields that it covers. Digests of different versions cannot be compared.
pub const DIGEST_ALGORITHM: &str = "blake3-256/film-4";

impl FilmState {
    /// Feeds the state of the film into `hasher`, for a digest of several films or of more than films.
    ///
    /// All numbers are little-endian. First the film:
    ///
    /// - the number of steps (u64), the number of steps in a unit of age (u32) and the numbers of vertices, faces and half-edges (u32 each);
    /// - for each vertex its original (u32), rest position, position (3 f32 each), adhesion, separation age (f32 each;
    ///   infinite while attached) and tip direction (3 f32);
    /// - for each face the origins of its half-edges (3 u32), its fate (u8: 0 live, 1 stripped, 2 fallen) and its
    ///   contraction (f32);
    /// - for each half-edge whether it is torn (u8) and its binding (f32).
    ///
    /// Forces are their present values, however they are stored. Then the stains:
    ///
    /// - wet rust, stained rust, dust and moisture of the film, the same of the metal, corrosion, exposure to rain and
    ///   exposure to sun: each of these eleven as its length (u32) and its values (f32);
    /// - the number of source states (u32) and the states (u8: 0 never, 1 present, 2 past);
    /// - rust emitted and dripped (f64 each) and the direction of streaks (3 f32).
    ///
    /// Exposure is included because the later state of the film depends on it. At last whatever else decides later bits,
    /// as 32-bit words, in the order in which the parts of the film keep it: how forces are stored, and the seed and
    /// settings that they were drawn with; all constraints with their targets, their order in packs, the momentum of
    /// points, and who sleeps; open metal, where cracks drain to, and the gravity, pull and rates that dust and run-off
    /// keep through small changes.
    ///
    /// Areas, predictions, buffers and counters for display are not covered: they follow from the rest or decide nothing.
    /// Settings, environment and quality are no part of the film, but inputs of its next step.
    ///
    /// ```
    /// use bevy_coating::{remesh::sample, settings::CoatingSettings, sim::FilmState};
    ///
    /// let piece = sample::plate(100, 7)?;
    /// let film = FilmState::new(&piece.film, &CoatingSettings::default(), 7, 100).expect("a plate is a manifold");
    /// let mut hasher = blake3::Hasher::new();
    /// film.digest_into(&mut hasher);
    /// assert_eq!(hasher.finalize().to_hex().to_string(), film.digest());
    /// # Ok::<(), bevy_coating::surface::BuildError>(())
    /// ```
    pub fn digest_into(&self, hasher: &mut blake3::Hasher) {
        let (topology, geometry) = (&self.mesh.topology, &self.mesh.geometry);
        let mut bytes = Vec::with_capacity(64 * topology.vertex_count() + 48 * topology.face_count());
        let vector = |bytes: &mut Vec<u8>, v: Vec3| v.to_array().iter().for_each(|x| bytes.extend(x.to_le_bytes()));
        bytes.extend(self.clock.steps.to_le_bytes());
        bytes.extend(self.clock.steps_per_age.to_le_bytes());
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
        let mut words = Words::default();
        self.forces.write_state(&mut words);
        self.constraints.write_state(&mut words);
        self.stains.write_state(&mut words);
        hasher.update(&words.bytes());
    }

    /// Returns the digest of this film, 64 hexadecimal digits. [`FilmState::digest_into`] lists the fields that it
    /// covers.
    ///
    /// ```
    /// use bevy_coating::{remesh::sample, settings::CoatingSettings, sim::FilmState, stain::Environment};
    ///
    /// let settings = CoatingSettings::default();
    /// let piece = sample::plate(100, 7)?;
    /// let mut film = FilmState::new(&piece.film, &settings, 7, 100).expect("a plate is a manifold");
    /// let mut other = film.clone();
    /// film.step(&settings, &Environment::default());
    /// assert_ne!(film.digest(), other.digest());
    /// other.step(&settings, &Environment::default());
    /// assert_eq!(film.digest(), other.digest());
    /// # Ok::<(), bevy_coating::surface::BuildError>(())
    /// ```
    pub fn digest(&self) -> String {
        let mut hasher = blake3::Hasher::new();
        self.digest_into(&mut hasher);
        hasher.finalize().to_hex().to_string()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        deform::update_constraints,
        film::{FaceId, FilmChanges, FilmMesh, VertexId},
        settings::CoatingSettings,
        stain::{Environment, settle_dust},
    };

    /// Fields within the parts have tests beside them; here, that no part is left out.
    #[test]
    fn every_part_of_a_film_counts() {
        let mesh = FilmMesh::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y], &[[0, 1, 2]]).unwrap();
        let film = FilmState::from_mesh(mesh, &CoatingSettings::default(), 1, 100);
        let changes: [fn(&mut FilmState); 9] = [
            |film| film.clock.steps = 1,
            |film| film.clock.steps_per_age = 10,
            |film| film.mesh.geometry.positions[0].x = 0.5,
            |film| film.mesh.geometry.rest_positions[0].x = 0.5,
            |film| film.forces.set_adhesion(VertexId(0), 0.5),
            // The same force by hand: it no longer follows settings.
            |film| film.forces.set_contraction(&film.mesh.topology, FaceId(0), 1.0),
            |film| {
                let separated = vec![VertexId(0)];
                let changes = FilmChanges { separated, ..FilmChanges::default() };
                update_constraints(&film.mesh, &mut film.constraints, &changes);
            },
            |film| settle(film, Vec3::NEG_Y),
            |film| settle(film, Vec3::new(0.0, -1.0, 1e-3)),
        ];
        let mut digests = vec![film.digest()];
        for change in changes {
            let mut film = film.clone();
            change(&mut film);
            digests.push(film.digest());
        }
        digests.sort();
        digests.dedup();
        assert_eq!(digests.len(), 10);
    }

    /// Lets so little dust settle that no value changes, but the rates and their gravity are known then.
    fn settle(film: &mut FilmState, gravity: Vec3) {
        let settings = CoatingSettings::default();
        settle_dust(&film.mesh, &mut film.stains, &settings.dust, &Environment::still(gravity), 0.0);
    }

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
