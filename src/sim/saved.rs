//! Codes the state of a whole film for snapshots.

#![cfg_attr(
    not(test),
    deny(
        clippy::indexing_slicing,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "what is read here comes from outside"
    )
)]

use super::{clock::FilmClock, state::FilmState};
use crate::{
    coding::{Coder, Damage, Reader, Writer},
    deform::{FilmConstraints, code_quality},
    film::FilmMesh,
    fracture::FilmForces,
    stain::{StainFields, StainLayer},
};

/// Film as it was before anything happened to it: what saved states are told apart from.
#[derive(Clone, Debug)]
pub(crate) struct FreshFilm {
    pub mesh: FilmMesh,
    /// Forces, drawn as those of the film were that was coded last.
    forces: Option<FilmForces>,
    constraints: FilmConstraints,
    stains: StainFields,
}

impl FreshFilm {
    /// Makes the fresh film on `rest`, on which nothing has torn or moved.
    pub fn new(rest: FilmMesh) -> Self {
        let (constraints, stains) = (FilmConstraints::new(&rest), StainFields::new(&rest));
        Self { mesh: rest, forces: None, constraints, stains }
    }

    /// Writes the state of `film`, which is one of this mesh, and leaves it as it is.
    ///
    /// # Errors
    /// [`Damage`] if the state was changed by hand so that it is none.
    pub fn write(&mut self, film: &mut FilmState) -> Result<Vec<u8>, Damage> {
        // The functions that code take what they may change; a writer changes nothing.
        check_lengths(film)?;
        let mut writer = Writer::new();
        self.code(film, &mut writer)?;
        Ok(writer.finish())
    }

    /// Reads the state that was written. `distrusts` says whether the bytes come from outside.
    ///
    /// # Errors
    /// [`Damage`] if it is none of a film of this mesh.
    pub fn read(&mut self, bytes: &[u8], distrusts: bool) -> Result<FilmState, Damage> {
        let mut film = FilmState {
            mesh: self.mesh.clone(),
            constraints: self.constraints.clone(),
            stains: self.stains.clone(),
            ..FilmState::default()
        };
        let mut reader = Reader::new(bytes, distrusts)?;
        self.code(&mut film, &mut reader)?;
        reader.finish()?;
        Ok(film)
    }

    fn code<C: Coder>(&mut self, film: &mut FilmState, coder: &mut C) -> Result<(), Damage> {
        let FilmState { mesh, forces, constraints, stains, clock, quality, .. } = film;
        clock.code_state(coder)?;
        *quality = code_quality(*quality, coder)?;
        forces.code_drawn(coder);
        let fresh = match self.forces.take().filter(|fresh| forces.is_drawn_like(fresh)) {
            Some(fresh) => fresh,
            None => forces.redrawn(&self.mesh)?,
        };
        if C::READS {
            forces.clone_from(&fresh);
        }
        let fresh = self.forces.insert(fresh);
        mesh.code_state(&self.mesh, coder)?;
        forces.code_state(fresh, &mesh.topology, coder)?;
        constraints.code_state(mesh, &self.mesh, |v| forces.is_attached(v), clock.dt(), coder)?;
        #[expect(clippy::cast_possible_truncation, reason = "stains expect an age in single precision")]
        let age = clock.age() as f32;
        stains.code_state(&self.stains, mesh, age, coder)
    }
}

/// Checks the lists whose lengths anybody can change.
fn check_lengths(film: &FilmState) -> Result<(), Damage> {
    let FilmState { mesh, forces, stains, .. } = film;
    let (vertices, originals) = (mesh.topology.vertex_count(), mesh.topology.original_vertex_count());
    let geometry = &mesh.geometry;
    let places = [&geometry.rest_positions, &geometry.rest_normals, &geometry.positions, &forces.tips];
    let layer = |layer: &StainLayer, count: usize| {
        let StainLayer { wet, stained, dust, moisture, areas } = layer;
        [wet, stained, dust, moisture, areas].into_iter().all(|list| list.len() == count)
    };
    let fit = places.into_iter().all(|list| list.len() == vertices)
        && [forces.separated_age.len(), stains.sources.len()] == [vertices; 2]
        && layer(&stains.film, vertices)
        && layer(&stains.metal, originals)
        && stains.corrosion.len() == originals;
    if fit { Ok(()) } else { Err(Damage("the length of a list")) }
}

impl FilmClock {
    fn code_state<C: Coder>(&mut self, coder: &mut C) -> Result<(), Damage> {
        coder.plain_long(&mut self.steps);
        coder.plain_word(&mut self.steps_per_age);
        // A film that steps a billion times a second for a hundred years has taken fewer.
        if self.steps >> 62 == 0 { Ok(()) } else { Err(Damage("its clock")) }
    }
}
