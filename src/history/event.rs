//! Events from outside that a film's fate depends on.

use crate::{
    deform::SolverQuality,
    film::{FaceId, HalfEdgeId, VertexId},
    settings::CoatingSettings,
    stain::{Environment, Exposure},
    touch::Touch,
};

/// Event between two steps of a film: a change of what acts on it, or an edit.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Event {
    /// Settings hold from now on.
    Settings(Box<CoatingSettings>),
    /// Gravity, wind, rain and sun are these from now on.
    Environment(Environment),
    /// Bending is solved with this quality from now on.
    Quality(SolverQuality),
    /// Rain and sun reach the prop so from now on.
    Exposure(Exposure),
    /// An edge tears ([`FilmState::tear_edge`](crate::sim::FilmState::tear_edge)).
    TearEdge(HalfEdgeId),
    /// A face is cut out ([`FilmState::strip_face`](crate::sim::FilmState::strip_face)).
    StripFace(FaceId),
    /// The adhesion of a vertex is set, a force
    /// ([`FilmForces::set_adhesion`](crate::fracture::FilmForces::set_adhesion)).
    Adhesion(VertexId, f32),
    /// The contraction of a face is set, a force
    /// ([`FilmForces::set_contraction`](crate::fracture::FilmForces::set_contraction)).
    Contraction(FaceId, f32),
    /// The binding of an edge is set, a force ([`FilmForces::set_binding`](crate::fracture::FilmForces::set_binding)).
    Binding(HalfEdgeId, f32),
    /// A brush or a game touches the film ([`FilmState::touch`](crate::sim::FilmState::touch)). The number is that of
    /// the stroke that the touch is part of: strokes are undone as a whole.
    Touch(Touch, u32),
}

/// Event and when it happened.
#[derive(Clone, Debug, PartialEq)]
pub struct LogEntry {
    /// Number of steps that the film had taken.
    pub step: u64,
    /// Event that happened then, before the next step.
    pub event: Event,
}

impl LogEntry {
    /// Returns the memory that this takes, in bytes.
    pub(super) fn bytes(&self) -> usize {
        let beside = match &self.event {
            Event::Settings(_) => size_of::<CoatingSettings>(),
            Event::Exposure(Exposure { rain, sun }) => size_of::<f32>() * (rain.len() + sun.len()),
            _ => 0,
        };
        size_of::<Self>() + beside
    }
}
