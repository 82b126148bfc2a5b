//! Positions of the film's vertices and what is measured on them at rest. Knows no connectivity beyond the
//! handles it is asked about.

use bevy_math::{Vec3, ops};
use core::f32::consts::PI;

use super::{
    handles::{FaceId, HalfEdgeId, VertexId},
    topology::Topology,
};

/// Positions, at rest and now, in the prop's space with its world scale applied; and rest measures.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Geometry {
    /// Position of each vertex at rest.
    pub rest_positions: Vec<Vec3>,
    /// Unit normal of each vertex at rest (angle-weighted), or zero where its faces cancel out.
    pub rest_normals: Vec<Vec3>,
    /// Position of each vertex now.
    pub positions: Vec<Vec3>,
    /// Rest length of each half-edge.
    pub rest_lengths: Vec<f32>,
    /// Signed dihedral angle of each half-edge's edge at rest, in radians in (0, 2 pi); pi at the border.
    pub rest_dihedrals: Vec<f32>,
    /// Mean length of the edges at rest: the film's unit of length, h.
    pub mean_edge: f32,
    /// Area of all faces at rest.
    pub rest_area: f32,
}

impl Geometry {
    /// Measures the film at rest. `positions` holds one entry a vertex of `topology`.
    pub fn at_rest(topology: &Topology, positions: Vec<Vec3>) -> Self {
        debug_assert_eq!(topology.vertex_count(), positions.len());
        let mut geometry = Self { positions: positions.clone(), rest_positions: positions, ..Self::default() };
        geometry.rest_normals = geometry.vertex_normals(topology);
        geometry.rest_lengths = topology
            .all_half_edges()
            .map(|h| {
                let (a, b) = (topology.origin(h), topology.target(h));
                geometry.rest_positions[a.index()].distance(geometry.rest_positions[b.index()])
            })
            .collect();
        geometry.rest_dihedrals =
            topology.all_half_edges().map(|h| geometry.rest_dihedral(topology, h).unwrap_or(PI)).collect();
        let (mut sum, mut edges) = (0.0f64, 0u32);
        for h in topology.all_edges() {
            sum += f64::from(geometry.rest_lengths[h.index()]);
            edges += 1;
        }
        geometry.mean_edge = (sum / f64::from(edges.max(1))) as f32;
        geometry.rest_area = topology
            .all_faces()
            .map(|f| {
                let [a, b, c] = topology.corners(f).map(|v| geometry.rest_positions[v.index()]);
                f64::from((b - a).cross(c - a).length()) * 0.5
            })
            .sum::<f64>() as f32;
        geometry
    }

    fn vertex_normals(&self, topology: &Topology) -> Vec<Vec3> {
        let mut normals = vec![Vec3::ZERO; topology.vertex_count()];
        for f in topology.all_faces() {
            let corners = topology.corners(f);
            let p = corners.map(|v| self.rest_positions[v.index()]);
            let normal = (p[1] - p[0]).cross(p[2] - p[0]).normalize_or_zero();
            for i in 0..3 {
                let (a, b) = (p[(i + 1) % 3] - p[i], p[(i + 2) % 3] - p[i]);
                // atan2 holds where acos of a rounded cosine does not.
                let angle = ops::atan2(a.cross(b).length(), a.dot(b));
                normals[corners[i].index()] += normal * angle;
            }
        }
        for n in &mut normals {
            *n = n.normalize_or_zero();
        }
        normals
    }

    /// Copies all that belongs to `v` to a new vertex at the end.
    pub fn duplicate_vertex(&mut self, v: VertexId) {
        let i = v.index();
        self.rest_positions.push(self.rest_positions[i]);
        self.rest_normals.push(self.rest_normals[i]);
        self.positions.push(self.positions[i]);
    }

    /// Mean of the corners of `f` at rest.
    #[inline]
    pub fn rest_centroid(&self, topology: &Topology, f: FaceId) -> Vec3 {
        // Through the originals, which never move or change: a duplicate may not be known here yet.
        let [a, b, c] = topology.corners(f).map(|v| self.rest_positions[topology.original(v).index()]);
        (a + b + c) / 3.0
    }

    /// Area of `f` at rest.
    pub fn rest_area_of(&self, topology: &Topology, f: FaceId) -> f32 {
        let [a, b, c] = topology.corners(f).map(|v| self.rest_positions[topology.original(v).index()]);
        // A square root is exact everywhere; the vector type's own may be a call of a library.
        (b - a).cross(c - a).length_squared().sqrt() * 0.5
    }

    /// Height of `v` over the plane of its rest position, in the film's space; negative is below.
    #[inline]
    pub fn height(&self, v: VertexId) -> f32 {
        let i = v.index();
        (self.positions[i] - self.rest_positions[i]).dot(self.rest_normals[i])
    }

    /// Signed dihedral angle at the edge of `h` now; `None` where the two faces are not bound.
    pub fn dihedral(&self, topology: &Topology, h: HalfEdgeId) -> Option<f32> {
        let twin = topology.bound_twin(h)?;
        let [p1, p2, p3, p4] = [topology.origin(h), topology.target(h), topology.apex(h), topology.apex(twin)]
            .map(|v| self.positions[v.index()]);
        signed_dihedral(p1, p2, p3, p4)
    }

    fn rest_dihedral(&self, topology: &Topology, h: HalfEdgeId) -> Option<f32> {
        let twin = topology.rest_twin(h)?;
        let [p1, p2, p3, p4] = [topology.origin(h), topology.target(h), topology.apex(h), topology.apex(twin)]
            .map(|v| self.rest_positions[v.index()]);
        signed_dihedral(p1, p2, p3, p4)
    }
}

/// Angle between face 1 = (p1, p2, p3) and face 2 = (p2, p1, p4), both counter-clockwise from outside, on
/// the outer side: pi is flat, below pi a valley, above pi a mountain; in (0, 2 pi). VC 4.3 takes the arc
/// cosine, which cannot tell the two folds apart and is not smooth when flat; this form is smooth everywhere
/// but at fully folded pairs. `None` where a face has no area.
pub fn signed_dihedral(p1: Vec3, p2: Vec3, p3: Vec3, p4: Vec3) -> Option<f32> {
    let edge = p2 - p1;
    let length = edge.length_squared().sqrt();
    let n1 = edge.cross(p3 - p1);
    let n2 = edge.cross(p2 - p4);
    // Both terms carry the lengths of both normals, which cancel out.
    let (sine, cosine) = (edge.dot(n1.cross(n2)) / length, n1.dot(n2));
    let whole = n1.length_squared() > 0.0 && n2.length_squared() > 0.0;
    (whole && (sine != 0.0 || cosine != 0.0)).then(|| PI + ops::atan2(sine, cosine))
}
