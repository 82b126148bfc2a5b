//! The film mesh: connectivity and positions together, and the tear that keeps both in step.

use bevy_math::Vec3;

use super::{
    edit::TearEnd,
    geometry::Geometry,
    handles::{FaceId, HalfEdgeId},
    topology::{Topology, TopologyError},
};

/// The film mesh of one coated prop.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "plugin", derive(bevy::ecs::component::Component))]
pub struct FilmMesh {
    /// Connectivity.
    pub topology: Topology,
    /// Positions.
    pub geometry: Geometry,
}

impl FilmMesh {
    /// A film at rest of `triangles`, an oriented manifold over `positions`.
    ///
    /// # Errors
    /// [`TopologyError`] when the triangles are no oriented manifold.
    pub fn new(positions: Vec<Vec3>, triangles: &[[u32; 3]]) -> Result<Self, TopologyError> {
        let topology = Topology::from_triangles(positions.len(), triangles)?;
        let geometry = Geometry::at_rest(&topology, positions);
        Ok(Self { topology, geometry })
    }

    /// Tears the edge of `h`; see [`Topology::tear`]. Of two fans the one that lies lowest along `gravity`
    /// (mean of its faces' centroids at rest; at a tie the one with the lowest face) keeps the vertex.
    pub fn tear(&mut self, h: HalfEdgeId, gravity: Vec3) -> Option<[TearEnd; 2]> {
        let Self { topology, geometry } = self;
        let ends = topology.tear(h, |topology, a, b| {
            let (depth_a, face_a) = fan_depth(topology, geometry, a, gravity);
            let (depth_b, face_b) = fan_depth(topology, geometry, b, gravity);
            if depth_a == depth_b { face_a < face_b } else { depth_a > depth_b }
        })?;
        for end in ends {
            if let TearEnd::Split { kept, .. } = end {
                geometry.duplicate_vertex(kept);
            }
        }
        Some(ends)
    }
}

/// How far along gravity a fan lies, and its lowest face.
fn fan_depth(topology: &Topology, geometry: &Geometry, first: HalfEdgeId, gravity: Vec3) -> (f32, FaceId) {
    let (mut depth, mut faces, mut lowest) = (0.0, 0.0, FaceId::NONE);
    for h in topology.fan_at(first) {
        depth += geometry.rest_centroid(topology, h.face()).dot(gravity);
        faces += 1.0;
        lowest = lowest.min(h.face());
    }
    (depth / faces, lowest)
}
