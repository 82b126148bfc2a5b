//! Vertex arrays of a shown part.

use super::shading::StainSample;

/// Vertices and triangles of one shown part, in the film's space. Attributes that the prop does not have are empty,
/// others hold one entry a vertex.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshPart {
    /// Positions.
    pub positions: Vec<[f32; 3]>,
    /// Unit normals.
    pub normals: Vec<[f32; 3]>,
    /// First texture coordinates.
    pub uvs: Vec<[f32; 2]>,
    /// Second texture coordinates.
    pub uvs_1: Vec<[f32; 2]>,
    /// Unit tangents, handedness in the fourth component.
    pub tangents: Vec<[f32; 4]>,
    /// Linear colours.
    pub colors: Vec<[f32; 4]>,
    /// Stains: layers of rust, at most one, dust, moisture, and how far the metal has rusted at this place.
    pub stains: Vec<[f32; 4]>,
    /// Where each vertex lies at rest: what patterns are tied to, so that they do not swim when flakes move.
    pub rest: Vec<[f32; 3]>,
    /// Unit normal of each vertex at rest.
    pub rest_normals: Vec<[f32; 3]>,
    /// Three vertices a triangle, wound as the prop's own triangles are.
    pub indices: Vec<u32>,
}

/// Layers of rust beyond which more looks the same. Between a vertex far above it and a clean one, almost the whole edge
/// would be covered, and stains would have the outlines of triangles.
const MOST_LAYERS: f32 = 1.0;

/// Stains of a vertex with `layers` of rust, as they are shown.
pub(super) fn shown_stains(layers: f32, dust: f32, moisture: f32, corrosion: f32) -> [f32; 4] {
    [layers.min(MOST_LAYERS), dust, moisture, corrosion]
}

impl MeshPart {
    /// Whether there is nothing to show.
    pub fn is_empty(&self) -> bool {
        self.indices.is_empty()
    }

    /// What is known of the stains of vertex `i`; `None` if there is none such.
    pub fn sample(&self, i: usize) -> Option<StainSample> {
        let (&stains, &rest, &normal) = (self.stains.get(i)?, self.rest.get(i)?, self.rest_normals.get(i)?);
        Some(StainSample::new(stains, rest.into(), normal.into()))
    }

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
        self.indices.clear();
    }
}
