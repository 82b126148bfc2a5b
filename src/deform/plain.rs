//! The plain solver: one constraint after the other, sorted by half-edge, with the printed forms (VC 4.2, 4.3). It is
//! the reference for looks and for speed.

use bevy_math::Vec3;

use super::{BendConstraint, FilmConstraints, LengthConstraint, bend::bend_corrections, length::length_corrections};
use crate::film::{FilmMesh, Geometry, Topology};

/// All constraints of a film, sorted by half-edge.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PlainConstraints {
    /// Revision of the film's constraints that these are of.
    revision: u64,
    lengths: Vec<LengthConstraint>,
    bends: Vec<BendConstraint>,
    /// Inverse mass of each vertex: 0 attached, 1 separated.
    inverse_masses: Vec<f32>,
}

impl PlainConstraints {
    /// Follows the constraints of a film and their targets.
    pub fn follow(&mut self, mesh: &FilmMesh, constraints: &FilmConstraints) {
        if self.revision != constraints.revision || self.inverse_masses.len() != mesh.topology.vertex_count() {
            self.revision = constraints.revision;
            self.lengths.clear();
            self.bends.clear();
            let [lengths, bends] = constraints.carriers();
            self.lengths.extend(lengths.filter_map(|h| constraints.length_of(mesh, h)));
            self.bends.extend(bends.filter_map(|h| constraints.bend_of(mesh, h)));
            self.inverse_masses.clear();
            let mass = |v| if constraints.is_attached(v) { 0.0 } else { 1.0 };
            self.inverse_masses.extend(mesh.topology.all_vertices().map(mass));
        }
        self.renew_targets(&mesh.topology, constraints);
    }

    fn renew_targets(&mut self, topology: &Topology, constraints: &FilmConstraints) {
        for bend in &mut self.bends {
            if let Some(target) = constraints.target(topology, bend.half_edge)
                && target != bend.target
            {
                bend.set_target(target);
            }
        }
    }

    /// One sweep: every bend in turn, then every length.
    pub fn sweep(&self, geometry: &mut Geometry) {
        let (rest, normals) = (&geometry.rest_positions, &geometry.rest_normals);
        let positions = &mut geometry.positions;
        for bend in &self.bends {
            let (p, w) = self.gather(positions, bend.points);
            let Some(corrections) = bend_corrections(p, w, bend.reach, bend.rest_medians) else { continue };
            for i in 0..4 {
                if w[i] > 0.0 {
                    let v = bend.points[i] as usize;
                    positions[v] = above_plane(p[i] + corrections[i], rest[v], normals[v]);
                }
            }
        }
        for length in &self.lengths {
            let (p, w) = self.gather(positions, length.ends);
            let Some(corrections) = length_corrections(p, w, length.rest) else { continue };
            for i in 0..2 {
                if w[i] > 0.0 {
                    let v = length.ends[i] as usize;
                    positions[v] = above_plane(p[i] + corrections[i], rest[v], normals[v]);
                }
            }
        }
    }

    #[inline]
    fn gather<const N: usize>(&self, positions: &[Vec3], points: [u32; N]) -> ([Vec3; N], [f32; N]) {
        (points.map(|v| positions[v as usize]), points.map(|v| self.inverse_masses[v as usize]))
    }
}

/// Takes out what puts `p` below the plane through its rest position (VC 5): all the contact there is.
#[inline]
pub fn above_plane(p: Vec3, rest: Vec3, normal: Vec3) -> Vec3 {
    let height = (p - rest).dot(normal);
    if height < 0.0 { p - height * normal } else { p }
}
