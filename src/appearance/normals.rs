//! Normals and tangents of a film that bends: the prop's own, turned with the faces.
//!
//! Each corner's normal at rest is turned by the rotation that takes its face's normal from rest to now, and averaged
//! over the faces around its vertex that share the normal at rest. So a film at rest has exactly the prop's normals,
//! hard edges stay hard, and cracks part the shading as they part the vertices.

use bevy_math::{Vec3, Vec4};

use super::{CornerAttributes, moves::Moves};
use crate::film::{FilmMesh, HalfEdgeId, Topology};

/// Normals at rest that differ by less are one smooth surface.
const SMOOTH: f32 = 1e-3;
/// Faces that turned by less than this (1 - cosine) have not moved: their normals are exactly the prop's.
const STILL: f32 = 1e-7;

/// Rotation of each face since rest.
#[derive(Clone, Debug, Default)]
pub(super) struct CornerFrames {
    /// Unit normal of each face at rest; zero for a face without area.
    rest_normals: Vec<Vec3>,
    /// Area of each face at rest: its weight.
    weights: Vec<f32>,
    /// Whether each face has turned since rest.
    turned: Vec<bool>,
    /// Normal of each corner, turned with its face and weighted.
    normals: Vec<Vec3>,
    /// Tangent of each corner, likewise; empty if the prop has none.
    tangents: Vec<Vec3>,
    /// Whether the normals at rest of all corners around an original vertex are one smooth surface.
    smooth: Vec<bool>,
    /// At vertices that are smooth: sums of normals and tangents around them, and whether none of their faces has turned.
    sums: Vec<Sum>,
}

/// What the faces around a vertex come to.
#[derive(Clone, Copy, Debug, Default)]
struct Sum {
    normal: Vec3,
    tangent: Vec3,
    turned: bool,
}

/// `v` with unit length; zero where it has none. The vector type's own calls a library for the square root where it is built
/// for the same bits on every platform; a square root is exact everywhere.
#[inline]
fn unit(v: Vec3) -> Vec3 {
    let length = v.length_squared().sqrt();
    if length > 0.0 { v * (1.0 / length) } else { Vec3::ZERO }
}

/// The smallest rotation between two unit vectors, in the form `v + c x v + c x (c x v) / (1 + cosine)`.
#[derive(Clone, Copy, Debug, Default)]
struct Turn {
    cross: Vec3,
    /// `1 / (1 + cosine)`; 0 if the face has not turned.
    scale: f32,
}

impl Turn {
    fn between(rest: Vec3, now: Vec3) -> Self {
        let cosine = rest.dot(now);
        if cosine > 1.0 - STILL || rest == Vec3::ZERO || now == Vec3::ZERO {
            return Self::default();
        }
        // A face turned right over has no smallest rotation; any half turn in its plane will do.
        if cosine < -0.9999 {
            let axis = rest.any_orthonormal_vector();
            return Self { cross: axis * 2e-2, scale: 5e3 };
        }
        Self { cross: rest.cross(now), scale: 1.0 / (1.0 + cosine) }
    }

    fn apply(self, v: Vec3) -> Vec3 {
        let once = self.cross.cross(v);
        v + once + self.cross.cross(once) * self.scale
    }

    fn is_still(self) -> bool {
        self.scale == 0.0
    }
}

impl CornerFrames {
    /// `mesh` may have torn and moved since it was at rest.
    pub fn new(mesh: &FilmMesh, attributes: &CornerAttributes) -> Self {
        let cross = |f| {
            let rest = |v| mesh.geometry.rest_positions[mesh.topology.original(v).index()];
            let [a, b, c] = mesh.topology.corners(f).map(rest);
            (b - a).cross(c - a)
        };
        Self {
            rest_normals: mesh.topology.all_faces().map(|f| unit(cross(f))).collect(),
            weights: mesh.topology.all_faces().map(|f| cross(f).length()).collect(),
            turned: vec![false; mesh.topology.face_count()],
            normals: vec![Vec3::ZERO; mesh.topology.half_edge_count()],
            tangents: vec![Vec3::ZERO; attributes.tangents.len()],
            smooth: smooth_vertices(mesh, attributes),
            sums: Vec::new(),
        }
    }

    /// Brings what has moved up to date.
    pub fn turn_faces(&mut self, mesh: &FilmMesh, attributes: &CornerAttributes, moves: &Moves) {
        for f in mesh.topology.live_faces().filter(|&f| moves.has_moved(f)) {
            let [a, b, c] = mesh.topology.corners(f).map(|v| mesh.geometry.positions[v.index()]);
            let turn = Turn::between(self.rest_normals[f.index()], unit((b - a).cross(c - a)));
            self.turned[f.index()] = !turn.is_still();
            let weight = self.weights[f.index()];
            for h in f.half_edges().map(|h| h.index()) {
                self.normals[h] = turn.apply(attributes.normals[h]) * weight;
                if let Some(tangent) = self.tangents.get_mut(h) {
                    *tangent = turn.apply(attributes.tangents[h].truncate()) * weight;
                }
            }
        }
    }

    /// Adds up what the faces around vertices with a turned face come to, in the order of faces: much quicker than going round
    /// each vertex.
    pub fn add_up(&mut self, topology: &Topology, moves: &Moves) {
        let Self { turned, normals, tangents, smooth, sums, .. } = self;
        sums.clear();
        sums.resize(topology.vertex_count(), Sum::default());
        for f in topology.live_faces() {
            for h in f.half_edges() {
                let v = topology.origin(h);
                if moves.is_turned(v) && smooth[topology.original(v).index()] {
                    let sum = &mut sums[v.index()];
                    sum.turned |= turned[f.index()];
                    sum.normal += normals[h.index()];
                    if let Some(tangent) = tangents.get(h.index()) {
                        sum.tangent += tangent;
                    }
                }
            }
        }
    }

    /// Normal of the corner at the start of `h`.
    pub fn normal(&self, topology: &Topology, attributes: &CornerAttributes, h: HalfEdgeId) -> Vec3 {
        let mean = self.mean(topology, attributes, h, &self.normals, |sum| sum.normal);
        mean.unwrap_or(attributes.normals[h.index()])
    }

    /// Tangent of the corner at the start of `h`, perpendicular to `normal`.
    pub fn tangent(&self, topology: &Topology, attributes: &CornerAttributes, h: HalfEdgeId, normal: Vec3) -> Vec4 {
        let rest = attributes.tangents[h.index()];
        self.mean(topology, attributes, h, &self.tangents, |sum| sum.tangent).map_or(rest, |turned| {
            let flat = unit(turned - normal * turned.dot(normal));
            if flat == Vec3::ZERO { rest } else { flat.extend(rest.w) }
        })
    }

    /// Mean of the turned values of the faces around the corner's vertex that are smooth with it; `None` where none
    /// of them has turned.
    #[inline]
    fn mean(
        &self,
        topology: &Topology,
        attributes: &CornerAttributes,
        h: HalfEdgeId,
        values: &[Vec3],
        of: impl Fn(&Sum) -> Vec3,
    ) -> Option<Vec3> {
        let v = topology.origin(h);
        let (mut sum, mut turned) = (of(&self.sums[v.index()]), self.sums[v.index()].turned);
        if !self.smooth[topology.original(v).index()] {
            let normal = attributes.normals[h.index()];
            for g in topology.fan(v).filter(|g| attributes.normals[g.index()].abs_diff_eq(normal, SMOOTH)) {
                turned |= self.turned[g.face().index()];
                sum += values[g.index()];
            }
        }
        let mean = unit(sum);
        (turned && mean != Vec3::ZERO).then_some(mean)
    }
}

/// For each original vertex whether all corners around it have one normal at rest.
fn smooth_vertices(mesh: &FilmMesh, attributes: &CornerAttributes) -> Vec<bool> {
    let topology = &mesh.topology;
    let mut first = vec![HalfEdgeId::NONE; topology.original_vertex_count()];
    let mut even = vec![true; first.len()];
    let original = |h| topology.original(topology.origin(h)).index();
    for h in topology.all_half_edges() {
        let v = original(h);
        if let Some(g) = first[v].get() {
            // Half of what is smooth, so that any two of them are.
            even[v] &= attributes.normals[h.index()].abs_diff_eq(attributes.normals[g.index()], 0.5 * SMOOTH);
        } else {
            first[v] = h;
        }
    }
    even
}
