//! Defines [`MeshPart`], the vertex arrays of one part of a film's appearance.

use super::shading::StainSample;
use crate::stain::shown::MOST_LAYERS;

/// Vertices and triangles of one part of a film's appearance (front, backs or metal), in the film's space.
///
/// Each array holds one entry a vertex, or none at all where the part does not have the attribute.
///
/// ```
/// use bevy_coating::appearance::MeshPart;
///
/// let corner = MeshPart {
///     positions: vec![[0.0, 0.0, 0.1]],
///     stains: vec![[0.5, 0.0, 0.2, 0.0]],
///     rest: vec![[0.0; 3]],
///     rest_normals: vec![[0.0, 0.0, 1.0]],
///     ..MeshPart::default()
/// };
/// assert_eq!(corner.sample(0).map(|sample| sample.rust), Some(0.5));
/// assert_eq!(corner.sample(1), None, "there is one vertex only");
/// assert!(corner.is_empty(), "a vertex without triangles draws nothing");
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshPart {
    /// Positions, in metres.
    pub positions: Vec<[f32; 3]>,
    /// Normals, of unit length.
    pub normals: Vec<[f32; 3]>,
    /// First texture coordinates; empty if the prop has none.
    pub uvs: Vec<[f32; 2]>,
    /// Second texture coordinates; empty if the prop has none.
    pub uvs_1: Vec<[f32; 2]>,
    /// Tangents of unit length, with the handedness in the fourth component; empty if the prop has none, and for backs
    /// and metal.
    pub tangents: Vec<[f32; 4]>,
    /// Linear vertex colours of the prop with alpha; empty if it has none. Of backs and metal, which have colours of
    /// their own, only the alpha counts: it cuts holes where the prop's material is a mask.
    pub colors: Vec<[f32; 4]>,
    /// Stains of each vertex: layers of rust that has run off (0 to 1; more is cut off), dust (0 to 1), moisture (0 to
    /// 1), and corrosion of the metal at this place (0 bright to 1 rusted through).
    pub stains: Vec<[f32; 4]>,
    /// Position of each vertex at rest, in metres. Patterns of stains are computed from it, so that they stay fixed to
    /// the paint when flakes move.
    pub rest: Vec<[f32; 3]>,
    /// Normal of each vertex at rest, of unit length.
    pub rest_normals: Vec<[f32; 3]>,
    /// Number of each vertex, unique in the part. It is the same while film tears elsewhere, so that a vertex can be
    /// found again when vertices are numbered afresh.
    pub keys: Vec<u32>,
    /// Vertex indices, three a triangle. Fronts and metal are wound as the prop's own triangles, backs the other way.
    pub indices: Vec<u32>,
}

/// Returns the entry of [`MeshPart::stains`] for a vertex with `layers` of rust.
pub(super) fn vertex_stains(layers: f32, dust: f32, moisture: f32, corrosion: f32) -> [f32; 4] {
    [layers.min(MOST_LAYERS), dust, moisture, corrosion]
}

impl MeshPart {
    /// Returns whether the part has no triangles, so that there is nothing to draw.
    pub fn is_empty(&self) -> bool {
        self.indices.is_empty()
    }

    /// Returns the stains of vertex `i` with its place and normal at rest, as [shading](super::shading) needs them.
    /// `None` if the part has no such vertex or no stains.
    pub fn sample(&self, i: usize) -> Option<StainSample> {
        let (&stains, &rest, &normal) = (self.stains.get(i)?, self.rest.get(i)?, self.rest_normals.get(i)?);
        Some(StainSample::new(stains, rest.into(), normal.into()))
    }

    /// Removes all vertices and triangles and keeps the buffers.
    pub(super) fn clear(&mut self) {
        self.positions.clear();
        self.normals.clear();
        self.uvs.clear();
        self.uvs_1.clear();
        self.tangents.clear();
        self.colors.clear();
        self.stains.clear();
        self.rest.clear();
        self.rest_normals.clear();
        self.keys.clear();
        self.indices.clear();
    }
}
