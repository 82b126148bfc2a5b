//! Holds the buffers of tearing and stripping.

use super::{neck_search::NeckScratch, relief::ReliefScratch};
use crate::film::{FaceId, HalfEdgeId, PieceScratch, VertexId};

/// Buffers of [`tear`](super::tear) and [`strip`](super::strip).
///
/// Keep one for each film, so that a step need not allocate. No result depends on its contents: start with the default.
///
/// ```
/// let mut scratch = bevy_coating::fracture::FractureScratch::default();
/// # let _ = &mut scratch;
/// ```
#[derive(Clone, Debug, Default)]
pub struct FractureScratch {
    /// Edges to be torn in this step.
    pub(super) candidates: Vec<Candidate>,
    /// Buffers of the search for connected pieces.
    pub(super) pieces: PieceScratch,
    /// A face of each piece that tore or separated in this step, some of them several times.
    pub(super) touched: Vec<FaceId>,
    /// Attached vertices of a piece.
    pub(super) attached: Vec<VertexId>,
    /// Buffers of the search for faces beside a tear.
    pub(super) relief: ReliefScratch,
    /// Buffers of the search for necks.
    pub(super) necks: NeckScratch,
}

/// An edge that would tear in the state at the start of the step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Candidate {
    /// Lower half-edge of the edge.
    pub edge: HalfEdgeId,
    /// Largest cosine between the edge and a crack that ends at one of its ends; `None` if no crack does.
    pub alignment: Option<f32>,
    /// Factor by which contraction exceeds binding, above 1.
    pub excess: f32,
}
