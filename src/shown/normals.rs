//! Normals and tangents of a film that bends: the prop's own, turned with the faces.
//!
//! Each corner's normal at rest is turned by the rotation that takes its face's normal from rest to now, and averaged
//! over the faces around its vertex that share the normal at rest. So a film at rest has exactly the prop's normals,
//! hard edges stay hard, and cracks part the shading as they part the vertices.

use bevy_math::{Vec3, Vec4};

use super::CornerAttributes;
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
    turns: Vec<Turn>,
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
    pub fn new(mesh: &FilmMesh) -> Self {
        let cross = |f| {
            let rest = |v| mesh.geometry.rest_positions[mesh.topology.original(v).index()];
            let [a, b, c] = mesh.topology.corners(f).map(rest);
            (b - a).cross(c - a)
        };
        Self {
            rest_normals: mesh.topology.all_faces().map(|f| cross(f).normalize_or_zero()).collect(),
            weights: mesh.topology.all_faces().map(|f| cross(f).length()).collect(),
            turns: vec![Turn::default(); mesh.topology.face_count()],
        }
    }

    /// Brings the rotations of all live faces up to date.
    pub fn turn_faces(&mut self, mesh: &FilmMesh) {
        for f in mesh.topology.live_faces() {
            let [a, b, c] = mesh.topology.corners(f).map(|v| mesh.geometry.positions[v.index()]);
            let now = (b - a).cross(c - a).normalize_or_zero();
            self.turns[f.index()] = Turn::between(self.rest_normals[f.index()], now);
        }
    }

    /// Normal of the corner at the start of `h`.
    pub fn normal(&self, topology: &Topology, attributes: &CornerAttributes, h: HalfEdgeId) -> Vec3 {
        let rest = attributes.normals[h.index()];
        self.turned(topology, attributes, h, |g| attributes.normals[g.index()]).unwrap_or(rest)
    }

    /// Tangent of the corner at the start of `h`, perpendicular to `normal`.
    pub fn tangent(&self, topology: &Topology, attributes: &CornerAttributes, h: HalfEdgeId, normal: Vec3) -> Vec4 {
        let rest = attributes.tangents[h.index()];
        let same = |g: HalfEdgeId| attributes.tangents[g.index()].truncate();
        self.turned(topology, attributes, h, same).map_or(rest, |turned| {
            let flat = turned - normal * turned.dot(normal);
            flat.try_normalize().map_or(rest, |t| t.extend(rest.w))
        })
    }

    /// Mean of `value` turned with each face around the corner's vertex that is smooth with it; `None` where none
    /// of them has turned.
    fn turned(
        &self,
        topology: &Topology,
        attributes: &CornerAttributes,
        h: HalfEdgeId,
        value: impl Fn(HalfEdgeId) -> Vec3,
    ) -> Option<Vec3> {
        let normal = attributes.normals[h.index()];
        let (mut sum, mut still) = (Vec3::ZERO, true);
        for g in topology.fan(topology.origin(h)) {
            if attributes.normals[g.index()].abs_diff_eq(normal, SMOOTH) {
                let turn = self.turns[g.face().index()];
                still &= turn.is_still();
                sum += turn.apply(value(g)) * self.weights[g.face().index()];
            }
        }
        if still { None } else { sum.try_normalize() }
    }
}
