//! Turns the prop's own normals and tangents with the faces of a film that bends.
//!
//! Each corner's normal at rest is rotated as its face's normal has rotated since rest, and averaged over the faces
//! around its vertex that share the normal at rest. So a film at rest has exactly the prop's normals, hard edges stay
//! hard, and normals differ across a crack, as its two sides have vertices of their own.

use bevy_math::{Vec3, Vec4};

use super::{
    corners::CornerAttributes,
    moves::Moves,
    turn::{Turn, unit},
};
use crate::film::{FilmMesh, HalfEdgeId, Topology};

/// Largest difference in each component between normals at rest that belong to one smooth surface.
const SMOOTH: f32 = 1e-3;

/// Normals and tangents of the corners, turned with their faces since rest.
#[derive(Clone, Debug, Default)]
pub(super) struct CornerFrames {
    /// Unit normal of each face at rest; zero for a face without area.
    rest_normals: Vec<Vec3>,
    /// Twice the area of each face at rest: its weight in means.
    weights: Vec<f32>,
    /// Whether each face has turned since rest.
    turned: Vec<bool>,
    /// Normal of each corner, turned with its face and weighted.
    normals: Vec<Vec3>,
    /// Tangent of each corner, turned with its face and weighted; empty if the prop has none.
    tangents: Vec<Vec3>,
    /// Whether all corners around an original vertex have the same normal at rest.
    smooth: Vec<bool>,
    /// Sum over the faces around each vertex; filled only for smooth vertices with a face that moved.
    sums: Vec<Sum>,
}

/// Sum over the faces around a vertex.
#[derive(Clone, Copy, Debug, Default)]
struct Sum {
    normal: Vec3,
    tangent: Vec3,
    turned: bool,
}

impl CornerFrames {
    /// Measures the faces of `mesh` at rest; it may have torn and moved since.
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

    /// Turns the normals and tangents of the corners of faces that moved.
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

    /// Sums normals and tangents over the faces around each smooth vertex. Going through the faces in their order is
    /// much faster than going around each vertex.
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

    /// Returns the unit normal of the corner at the start of `h`.
    pub fn normal(&self, topology: &Topology, attributes: &CornerAttributes, h: HalfEdgeId) -> Vec3 {
        let mean = self.mean(topology, attributes, h, &self.normals, |sum| sum.normal);
        mean.unwrap_or(attributes.normals[h.index()])
    }

    /// Returns the tangent of the corner at the start of `h`: perpendicular to `normal`, handedness in `w`.
    pub fn tangent(&self, topology: &Topology, attributes: &CornerAttributes, h: HalfEdgeId, normal: Vec3) -> Vec4 {
        let rest = attributes.tangents[h.index()];
        self.mean(topology, attributes, h, &self.tangents, |sum| sum.tangent).map_or(rest, |turned| {
            let flat = unit(turned - normal * turned.dot(normal));
            if flat == Vec3::ZERO { rest } else { flat.extend(rest.w) }
        })
    }

    /// Returns the unit mean of the turned values of the faces around the corner's vertex that share its normal at
    /// rest; `None` where none of these faces has turned.
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

/// Returns for each original vertex whether all corners around it have the same normal at rest.
fn smooth_vertices(mesh: &FilmMesh, attributes: &CornerAttributes) -> Vec<bool> {
    let topology = &mesh.topology;
    let mut first = vec![HalfEdgeId::NONE; topology.original_vertex_count()];
    let mut even = vec![true; first.len()];
    let original = |h| topology.original(topology.origin(h)).index();
    for h in topology.all_half_edges() {
        let v = original(h);
        if let Some(g) = first[v].get() {
            // Half the limit, so that any two of the corners are within it.
            even[v] &= attributes.normals[h.index()].abs_diff_eq(attributes.normals[g.index()], 0.5 * SMOOTH);
        } else {
            first[v] = h;
        }
    }
    even
}
