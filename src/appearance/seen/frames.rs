//! Follows how each vertex of the film has turned since rest.

use bevy_math::Vec3;

use super::{differences::Differences, moves::Moves};
use crate::appearance::turn::{Turn, unit};
use crate::film::{FilmMesh, Topology, VertexId};

/// Rotation of each vertex since rest: the smallest between the normals of its faces then and now.
///
/// Both normals are means over the faces that the vertex has now, so a film at rest has not turned however it has torn.
/// The prop's own normals and tangents at a vertex turn with it.
#[derive(Clone, Debug, Default)]
pub(in crate::appearance) struct Frames {
    /// Unit normal of each vertex at rest over the faces that it has now.
    rest: Vec<Vec3>,
    /// Sum of the normals of the faces around each vertex, as long as twice their areas. Only those of the vertices
    /// that turned last are true.
    sums: Vec<Vec3>,
    /// Rotation of each vertex.
    turns: Vec<Turn>,
}

impl Frames {
    /// Turns the vertices at faces that moved, and those with other faces.
    pub fn follow(&mut self, mesh: &FilmMesh, moves: &Moves, differences: &Differences) {
        let Self { rest, sums, turns } = self;
        let (topology, geometry) = (&mesh.topology, &mesh.geometry);
        let count = topology.vertex_count();
        rest.resize(count, Vec3::ZERO);
        sums.resize(count, Vec3::ZERO);
        turns.resize(count, Turn::default());
        if differences.whole {
            rest.fill(Vec3::ZERO);
            add_up(topology, &geometry.rest_positions, rest, |_| true);
            rest.iter_mut().for_each(|normal| *normal = unit(*normal));
        } else {
            for &v in &differences.vertices {
                rest[v.index()] = rest_normal(mesh, v);
            }
        }
        for &v in &moves.vertices {
            sums[v.index()] = Vec3::ZERO;
        }
        // Going through the faces in their order is quicker than going around each vertex.
        add_up(topology, moves.positions(), sums, |v| moves.is_turned(v));
        for &v in &moves.vertices {
            turns[v.index()] = Turn::between(rest[v.index()], unit(sums[v.index()]));
        }
    }

    /// Returns the rotation of `v` since rest.
    #[inline]
    pub fn turn(&self, v: VertexId) -> Turn {
        self.turns[v.index()]
    }
}

/// Adds the normal of each face that has a corner for which `wanted` is true to the sums of its corners.
#[inline]
fn add_up(topology: &Topology, positions: &[Vec3], sums: &mut [Vec3], wanted: impl Fn(VertexId) -> bool) {
    for f in topology.live_faces() {
        let corners = topology.corners(f);
        if wanted(corners[0]) | wanted(corners[1]) | wanted(corners[2]) {
            let normal = cross(corners.map(|v| positions[v.index()]));
            corners.iter().for_each(|v| sums[v.index()] += normal);
        }
    }
}

/// Returns the unit normal of `v` at rest: the bits are those of [`add_up`], as the faces are summed in their order.
fn rest_normal(mesh: &FilmMesh, v: VertexId) -> Vec3 {
    let mut sum = Vec3::ZERO;
    let mut next = mesh.topology.fan(v).map(|h| h.face()).min();
    while let Some(f) = next {
        sum += cross(mesh.topology.corners(f).map(|v| mesh.geometry.rest_positions[v.index()]));
        next = mesh.topology.fan(v).map(|h| h.face()).filter(|&other| other > f).min();
    }
    unit(sum)
}

#[inline]
fn cross([a, b, c]: [Vec3; 3]) -> Vec3 {
    (b - a).cross(c - a)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{remesh::sample, settings::CoatingSettings, sim::FilmState, stain::Environment};

    #[test]
    fn normals_at_rest_are_the_same_bits_whichever_way_they_are_found() {
        let piece = sample::curved_plate(500, 3).unwrap();
        let settings = CoatingSettings::default();
        let mut film = FilmState::new(&piece.film, &settings, 3, 100).unwrap();
        film.age_to(0.9, &settings, &Environment::default());
        let (mesh, mut sums) = (&film.mesh, vec![Vec3::ZERO; film.mesh.topology.vertex_count()]);
        add_up(&mesh.topology, &mesh.geometry.rest_positions, &mut sums, |_| true);
        let split = mesh.topology.vertex_count() - mesh.topology.original_vertex_count();
        assert!(split > 50, "{split}");
        for v in mesh.topology.all_vertices() {
            assert_eq!(rest_normal(mesh, v), unit(sums[v.index()]), "{v:?}");
        }
    }
}
