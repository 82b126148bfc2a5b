//! Joins the backs and the metal of several slots, for those who draw them with one material.

use super::{FilmAppearance, MeshPart};

impl FilmAppearance {
    /// Returns the backs of the flakes of those slots that `wanted` asks for, in one part.
    pub fn backs_in(&self, wanted: impl Fn(usize) -> bool) -> MeshPart {
        join(self.all_backs(), wanted)
    }

    /// Returns the bare metal of those slots that `wanted` asks for, in one part.
    ///
    /// ```
    /// use bevy_coating::{appearance::FilmAppearance, remesh::sample, settings::CoatingSettings, sim::FilmState};
    ///
    /// let (piece, settings) = (sample::plate(200, 1)?, CoatingSettings::default());
    /// let film = FilmState::new(&piece.film, &settings, 0, 100).ok_or("an empty film")?;
    /// let fresh = FilmAppearance::new(&piece.film, &piece.surface, &film.mesh, &film.forces, &film.stains);
    /// assert!(fresh.metal_in(|_| true).is_empty(), "fresh paint hides all metal");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn metal_in(&self, wanted: impl Fn(usize) -> bool) -> MeshPart {
        join(self.all_metal(), wanted)
    }
}

/// Appends the parts of some slots to each other.
fn join(parts: &[MeshPart], wanted: impl Fn(usize) -> bool) -> MeshPart {
    let mut joined = MeshPart::default();
    for (_, part) in parts.iter().enumerate().filter(|&(slot, _)| wanted(slot)) {
        let first = joined.positions.len() as u32;
        joined.positions.extend_from_slice(&part.positions);
        joined.normals.extend_from_slice(&part.normals);
        joined.uvs.extend_from_slice(&part.uvs);
        joined.uvs_1.extend_from_slice(&part.uvs_1);
        joined.colors.extend_from_slice(&part.colors);
        joined.stains.extend_from_slice(&part.stains);
        joined.rest.extend_from_slice(&part.rest);
        joined.rest_normals.extend_from_slice(&part.rest_normals);
        joined.indices.extend(part.indices.iter().map(|&vertex| first + vertex));
    }
    joined
}
