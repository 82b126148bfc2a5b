//! Measures the shape of a surface around a vertex, which dust and moisture depend on.

use core::f32::consts::PI;

use bevy_math::Vec3;

use crate::film::{FilmMesh, HalfEdgeId, VertexId, signed_dihedral};

/// Orientation and curvature of a surface at a vertex.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Shape {
    /// Unit normal, weighted by area; zero where the faces' normals cancel out.
    pub normal: Vec3,
    /// Mean dihedral angle of the edges opposite the vertex, in radians: pi is flat, above pi is convex (the curvature
    /// of VC 6.2).
    pub dihedral: f32,
}

impl Shape {
    /// Measures the film at vertex `v` in its present positions.
    pub fn now(mesh: &FilmMesh, v: VertexId) -> Self {
        let (topology, geometry) = (&mesh.topology, &mesh.geometry);
        let at = |v: VertexId| geometry.positions[v.index()];
        let mut normal = Vec3::ZERO;
        let mut mean = Mean::default();
        for h in topology.fan(v) {
            let [a, b, c] = h.face().half_edges();
            let [a, b, c] = [at(topology.origin(a)), at(topology.origin(b)), at(topology.origin(c))];
            normal += (b - a).cross(c - a);
            // As `Geometry::dihedral` at the edge opposite `v`, whose face has been looked up already.
            mean.add(topology.bound_twin(h.next()).and_then(|twin| {
                let [apex, from, to] = match h.index() % 3 {
                    0 => [a, b, c],
                    1 => [b, c, a],
                    _ => [c, a, b],
                };
                signed_dihedral(from, to, apex, at(topology.apex(twin)))
            }));
        }
        Self { normal: normal.normalize_or_zero(), dihedral: mean.finish() }
    }

    /// Measures the surface at original vertex `v` at rest, before anything tore. `fan` holds the half-edges around it.
    pub fn at_rest(mesh: &FilmMesh, v: VertexId, fan: impl Iterator<Item = HalfEdgeId>) -> Self {
        let mut mean = Mean::default();
        for h in fan {
            let opposite = h.next();
            let inner = mesh.topology.rest_twin(opposite).is_some();
            mean.add(inner.then(|| mesh.geometry.rest_dihedrals[opposite.index()]));
        }
        Self { normal: mesh.geometry.rest_normals[v.index()], dihedral: mean.finish() }
    }
}

/// Mean of angles, some of which may be missing; pi (flat) if all are.
#[derive(Default)]
struct Mean {
    sum: f32,
    count: f32,
}

impl Mean {
    fn add(&mut self, angle: Option<f32>) {
        if let Some(angle) = angle {
            self.sum += angle;
            self.count += 1.0;
        }
    }

    fn finish(&self) -> f32 {
        if self.count > 0.0 { self.sum / self.count } else { PI }
    }
}
