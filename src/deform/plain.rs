//! The plain solver: one constraint after the other, sorted by half-edge, with the printed forms (VC 4.2, 4.3). It is
//! the reference for looks and for speed.

use bevy_math::Vec3;

use super::{
    bend::{BendConstraint, bend_corrections},
    half_space::above_plane,
    ledger::Ledger,
    length::{LengthConstraint, length_corrections},
    packed::{constraints::PackedConstraints, points::Motion},
};
use crate::film::{FilmMesh, Geometry, Topology};

/// All constraints of a film, sorted by half-edge.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PlainConstraints {
    /// Revision of the ledger that these are of; `None` before the first.
    revision: Option<u64>,
    lengths: Vec<LengthConstraint>,
    bends: Vec<BendConstraint>,
    /// Inverse mass of each vertex: 0 attached, 1 separated.
    inverse_masses: Vec<f32>,
}

impl PlainConstraints {
    /// Brings these up to date with the constraints of a film and their targets.
    pub fn follow(&mut self, mesh: &FilmMesh, ledger: &Ledger, packed: &PackedConstraints) {
        // A vertex that lets go may have all its constraints already, as its neighbours have them: the ledger stays.
        let mass = |v| if packed.motion(v) == Motion::Attached { 0.0 } else { 1.0 };
        self.inverse_masses.clear();
        self.inverse_masses.extend(mesh.topology.all_vertices().map(mass));
        if self.revision != Some(ledger.revision()) {
            self.revision = Some(ledger.revision());
            self.lengths.clear();
            self.bends.clear();
            self.lengths.extend(ledger.lengths().iter().map(|h| LengthConstraint::of_edge(mesh, h)));
            self.bends.extend(ledger.bends().iter().filter_map(|h| packed.bend_of(ledger, mesh, h)));
        }
        self.renew_targets(&mesh.topology, ledger, packed);
    }

    fn renew_targets(&mut self, topology: &Topology, ledger: &Ledger, packed: &PackedConstraints) {
        for bend in &mut self.bends {
            if let Some(target) = packed.target(ledger, topology, bend.half_edge)
                && target != bend.target
            {
                bend.set_target(target);
            }
        }
    }

    /// Sweeps once: solves every bend in turn, then every length. After each of the two the vertices below their planes
    /// are lifted onto them, all at once: lifted one by one, in the middle of a pass, the vertices of a loose piece
    /// would push it off the metal instead of bending it.
    pub fn sweep(&self, geometry: &mut Geometry) {
        let positions = &mut geometry.positions;
        for bend in &self.bends {
            let (p, w) = self.gather(positions, bend.points);
            if let Some(corrections) = bend_corrections(p, w, bend.reach, bend.rest_medians) {
                apply(positions, bend.points, w, corrections);
            }
        }
        self.lift(geometry);
        let positions = &mut geometry.positions;
        for length in &self.lengths {
            let (p, w) = self.gather(positions, length.ends);
            if let Some(corrections) = length_corrections(p, w, length.rest) {
                apply(positions, length.ends, w, corrections);
            }
        }
        self.lift(geometry);
    }

    /// Lifts onto their planes the vertices that are free and below (VC 5).
    fn lift(&self, geometry: &mut Geometry) {
        let planes = geometry.rest_positions.iter().zip(&geometry.rest_normals);
        for ((p, (&rest, &normal)), &w) in geometry.positions.iter_mut().zip(planes).zip(&self.inverse_masses) {
            if w > 0.0 {
                *p = above_plane(*p, rest, normal);
            }
        }
    }

    #[inline]
    fn gather<const N: usize>(&self, positions: &[Vec3], points: [u32; N]) -> ([Vec3; N], [f32; N]) {
        (points.map(|v| positions[v as usize]), points.map(|v| self.inverse_masses[v as usize]))
    }
}

/// Moves the points that are free by their corrections.
#[inline]
fn apply<const N: usize>(positions: &mut [Vec3], points: [u32; N], w: [f32; N], corrections: [Vec3; N]) {
    for ((v, w), correction) in points.into_iter().zip(w).zip(corrections) {
        if w > 0.0 {
            positions[v as usize] += correction;
        }
    }
}
