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

    /// Sweeps once: solves every bend in turn, then every length.
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
