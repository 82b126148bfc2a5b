//! Edits of a film from outside: damage that a game does, with all parts of the film in step.
//!
//! ```
//! use bevy_coating::{film::FaceFate, remesh::sample, settings::CoatingSettings, sim::FilmState, stain::Environment};
//!
//! let (settings, environment) = (CoatingSettings::default(), Environment::default());
//! let piece = sample::plate(100, 7)?;
//! let mut film = FilmState::new(&piece.film, &settings, 7, 100).expect("a plate is a manifold");
//! let edge = film.mesh.topology.all_edges().find(|&h| film.mesh.topology.bound_twin(h).is_some()).expect("an edge");
//!
//! // A blow: an edge tears, and a face flies off.
//! assert!(film.tear_edge(edge, &settings, &environment));
//! assert!(film.strip_face(edge.face(), &settings, &environment));
//! assert_ne!(film.mesh.topology.fate(edge.face()), FaceFate::Live);
//! assert!(!film.strip_face(edge.face(), &settings, &environment), "gone already");
//! assert!(film.changes.debris.iter().any(|debris| debris.faces == 1));
//! film.step(&settings, &environment);
//! # Ok::<(), bevy_coating::surface::BuildError>(())
//! ```

use super::{clock::FilmClock, scratch::StepScratch, state::FilmState};
use crate::{
    deform::{self, FilmConstraints},
    film::{FaceId, FilmChanges, FilmMesh, HalfEdgeId, VertexId},
    fracture::{self, FilmForces},
    settings::CoatingSettings,
    stain::{self, Environment, StainFields},
};

/// Parts of a film that follow each other in an edit. The plugin keeps them as components of an entity.
#[derive(Debug)]
pub struct FilmParts<'a> {
    /// Mesh of the film.
    pub mesh: &'a mut FilmMesh,
    /// Forces and fracture state.
    pub forces: &'a mut FilmForces,
    /// Constraints of bending.
    pub constraints: &'a mut FilmConstraints,
    /// Stains of the film and the metal.
    pub stains: &'a mut StainFields,
    /// Step counter.
    pub clock: &'a FilmClock,
    /// Buffers of a step.
    pub scratch: &'a mut StepScratch,
}

/// Tears the edge of `h`, whatever holds it, and separates its ends from the metal. Faces and pieces that nothing holds
/// any more come off.
///
/// Returns what happened, in the form of a step's changes; display and messages follow from it. Returns `None`, and
/// changes nothing, if there is no such edge, it has torn or lies on the border, or a face at it is gone.
///
/// ```
/// use bevy_coating::{
///     film::HalfEdgeId,
///     remesh::sample,
///     settings::CoatingSettings,
///     sim::{
///         FilmState,
///         edit::{FilmParts, tear_edge},
///     },
///     stain::Environment,
/// };
///
/// let (settings, environment) = (CoatingSettings::default(), Environment::default());
/// let piece = sample::plate(100, 7)?;
/// let mut film = FilmState::new(&piece.film, &settings, 7, 100).expect("a plate is a manifold");
/// let edge = film.mesh.topology.all_edges().find(|&h| film.mesh.topology.bound_twin(h).is_some()).expect("an edge");
///
/// let FilmState { mesh, forces, constraints, stains, clock, scratch, .. } = &mut film;
/// let parts = FilmParts { mesh, forces, constraints, stains, clock, scratch };
/// let changes = tear_edge(parts, &settings, &environment, edge).expect("it was bound");
/// assert_eq!(changes.torn, [edge]);
/// assert_eq!(changes.separated.len(), 2);
/// # Ok::<(), bevy_coating::surface::BuildError>(())
/// ```
pub fn tear_edge(
    parts: FilmParts,
    settings: &CoatingSettings,
    environment: &Environment,
    h: HalfEdgeId,
) -> Option<FilmChanges> {
    let mut changes = FilmChanges::default();
    edit(parts, settings, environment, &mut changes, |parts, changes| {
        let age = parts.clock.age() as f32;
        let FilmParts { mesh, forces, scratch, .. } = parts;
        fracture::tear_by_hand(mesh, forces, settings, environment.gravity, age, h, changes, &mut scratch.fracture)
    })
    .then_some(changes)
}

/// Separates the corners of the face `f`, tears its edges and removes it. What else nothing holds any more comes off
/// with it.
///
/// Returns what happened, in the form of a step's changes; display and messages follow from it. Returns `None`, and
/// changes nothing, if there is no such face or it is gone. See [`tear_edge`] for an example.
pub fn strip_face(
    parts: FilmParts,
    settings: &CoatingSettings,
    environment: &Environment,
    f: FaceId,
) -> Option<FilmChanges> {
    let mut changes = FilmChanges::default();
    edit(parts, settings, environment, &mut changes, |parts, changes| {
        let age = parts.clock.age() as f32;
        let FilmParts { mesh, forces, scratch, .. } = parts;
        fracture::strip_by_hand(mesh, forces, settings, environment.gravity, age, f, changes, &mut scratch.fracture)
    })
    .then_some(changes)
}

/// Does an edit and lets all other parts follow it. Returns whether anything was edited.
pub(crate) fn edit(
    mut parts: FilmParts,
    settings: &CoatingSettings,
    environment: &Environment,
    changes: &mut FilmChanges,
    fracture: impl FnOnce(&mut FilmParts, &mut FilmChanges) -> bool,
) -> bool {
    let edited = fracture(&mut parts, changes);
    if edited {
        deform::update_constraints(parts.mesh, parts.constraints, changes);
        deform::follow_free_edges(parts.mesh, parts.constraints, settings, changes);
        stain::update_stains(parts.mesh, parts.stains, changes, environment.gravity);
    }
    edited
}

/// Way in which parts of a film were made new.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Renewed {
    /// They were not: the film is as it was.
    No,
    /// In place: all elements have the numbers that they had. These vertices, which had separated, are attached again.
    InPlace(Vec<VertexId>),
    /// In place, but edges are whole and faces are there that were not, and some of them have other vertices.
    Mended,
    /// The film was put together again: vertices have other numbers.
    Whole,
}

impl FilmParts<'_> {
    /// Makes `faces` new, one entry for each face of the film: those that are gone come back, cracks between them
    /// close, and they lie on the metal at rest, clean and with the forces of fresh paint. The film stays as it is if
    /// its parts were changed by hand so that no fresh film is known.
    ///
    /// It takes time in proportion to the faces, and a short pass over the film. Where more than half of the film is
    /// new, or painting has left many vertices without faces, the film is put together again.
    pub(crate) fn renew(&mut self, settings: &CoatingSettings, environment: &Environment, faces: Vec<bool>) -> Renewed {
        match self.renew_in_place(&faces) {
            Renewed::No if self.is_mended_better(&faces) => self.mend(settings, environment, faces),
            Renewed::No => self.renew_whole(settings, environment, faces),
            in_place => in_place,
        }
    }

    /// Returns whether it is better to mend the film than to put it together again.
    fn is_mended_better(&self, faces: &[bool]) -> bool {
        let topology = &self.mesh.topology;
        let originals = topology.original_vertex_count();
        let duplicates = topology.vertex_count() - originals;
        // A tear leaves two duplicates at most. The others have no use any more, but for those that fell.
        let most = (originals + 2 * self.forces.torn_edges as usize).min(topology.half_edge_count() / 2);
        let new = faces.iter().filter(|is_new| **is_new).count();
        duplicates <= most && 2 * new <= faces.len()
    }

    /// Makes `faces` new where they are.
    pub(crate) fn mend(&mut self, settings: &CoatingSettings, environment: &Environment, faces: Vec<bool>) -> Renewed {
        let Ok(drawn) = self.forces.begin_mend(self.mesh) else { return Renewed::No };
        let mend = self.mesh.mend(faces);
        self.forces.mend(self.mesh, &mend, &drawn, self.clock.age() as f32, &mut self.scratch.fracture);
        let forces = &*self.forces;
        self.constraints.mend(self.mesh, &mend, settings, |v| forces.is_attached(v));
        self.stains.mend(self.mesh, &mend, environment.gravity);
        Renewed::Mended
    }

    /// Makes `faces` new if that changes no connectivity.
    fn renew_in_place(&mut self, faces: &[bool]) -> Renewed {
        let Some(repaint) = self.mesh.repaint(faces) else { return Renewed::No };
        let Some(attach) = self.forces.find_attachable(self.mesh, &repaint) else { return Renewed::No };
        if self.forces.repaint(self.mesh, &repaint, &attach).is_err() {
            return Renewed::No;
        }
        for v in &attach {
            self.mesh.geometry.positions[v.index()] = self.mesh.geometry.rest_positions[v.index()];
        }
        self.constraints.attach(self.mesh, &attach);
        self.stains.repaint(self.mesh, &repaint);
        Renewed::InPlace(attach)
    }

    /// Makes `faces` new and puts the film together again.
    pub(crate) fn renew_whole(
        &mut self,
        settings: &CoatingSettings,
        environment: &Environment,
        faces: Vec<bool>,
    ) -> Renewed {
        let renewal = self.mesh.renew(faces, environment.gravity);
        if self.forces.renew(&renewal, self.clock.age() as f32).is_err() {
            return Renewed::No;
        }
        let forces = &*self.forces;
        self.constraints.renew(&renewal, settings, |v| forces.is_attached(v));
        self.stains.renew(&renewal, environment);
        *self.mesh = renewal.mesh;
        Renewed::Whole
    }
}

impl FilmState {
    /// Tears the edge of `h`, whatever holds it, and separates its ends from the metal, between two steps. Returns
    /// whether there was such an edge, bound between two faces.
    ///
    /// The changes are appended to [`FilmState::changes`]. See [`edit`](self) for an example.
    pub fn tear_edge(&mut self, h: HalfEdgeId, settings: &CoatingSettings, environment: &Environment) -> bool {
        let found = tear_edge(self.parts(), settings, environment, h);
        found.map(|found| self.changes.append(found)).is_some()
    }

    /// Cuts out the face `f` and removes it, between two steps. Returns whether there was such a face.
    ///
    /// The changes are appended to [`FilmState::changes`]. See [`edit`](self) for an example.
    pub fn strip_face(&mut self, f: FaceId, settings: &CoatingSettings, environment: &Environment) -> bool {
        let found = strip_face(self.parts(), settings, environment, f);
        found.map(|found| self.changes.append(found)).is_some()
    }

    /// Returns the parts that an edit changes.
    pub fn parts(&mut self) -> FilmParts<'_> {
        let Self { mesh, forces, constraints, stains, clock, scratch, .. } = self;
        FilmParts { mesh, forces, constraints, stains, clock, scratch }
    }
}
