//! Separation: the film lets go of the metal where bending force exceeds adhesion (VC 5.1).

use core::f32::consts::PI;

use bevy_math::ops;

use super::FilmForces;
use crate::{
    film::{FilmChanges, FilmMesh, VertexId},
    settings::CoatingSettings,
};

/// S(phi) of VC eq. 4: how strongly an edge of dihedral angle `phi` (radians, pi when flat) lifts the film,
/// in (0, 1); convex edges more than concave ones, the more so the larger `gamma`.
pub fn sigmoid(phi: f32, gamma: f32) -> f32 {
    1.0 / (1.0 + ops::exp(-gamma * (phi - PI)))
}

/// Sum of the bending forces F_B = k T S(phi) on `v` (VC eq. 4): each bound edge opposite `v` in a face of
/// its one-ring exerts one, border and torn edges none. `gain` is k.
#[inline]
pub fn bending_force(mesh: &FilmMesh, forces: &FilmForces, v: VertexId, gain: f32) -> f32 {
    OneRing::new(mesh, forces, v, gain).force
}

/// The age at which a vertex of an untouched one-ring separates, as the root of the linear equation
/// `lift (T0 + growth a) = adhesion - decay a`: `lift` is the sum of k S(phi) over the one-ring. At least 0;
/// infinite if it never does (nothing lifts it, not even without adhesion).
pub fn separation_age(lift: f32, contraction: f32, growth: f32, adhesion: f32, decay: f32) -> f32 {
    if lift * contraction > adhesion {
        return 0.0;
    }
    let closing = decay + lift * growth;
    if lift <= 0.0 || closing <= 0.0 { f32::INFINITY } else { (adhesion - lift * contraction) / closing }
}

/// Separates every attached vertex on which the sum of bending forces exceeds its adhesion; it never attaches
/// again. `age` is the film's age at the end of this step.
///
/// Looks only at vertices that may be due. Adhesion and bending force are linear in age while nothing tears, and what
/// tears or falls only ever takes bending force away, so a prediction can be too early but never too late.
pub fn separate(
    mesh: &FilmMesh,
    forces: &mut FilmForces,
    settings: &CoatingSettings,
    age: f32,
    changes: &mut FilmChanges,
) {
    let topology = &mesh.topology;
    forces.find_pieces(topology);
    let gain = settings.bending.gain;
    // Duplicates have separated, so the queue is of original vertices.
    let elements = topology.original_vertex_count();
    let basis = forces.predictions.basis_of_separations(gain, forces.gamma);
    let queue = &mut forces.predictions.separations;
    let mut due = if queue.rests_on(basis, elements) {
        queue.take_due()
    } else {
        queue.restart(basis, elements, 0..elements as u32)
    };
    due.sort_unstable();
    for &v in &due {
        let v = VertexId(v);
        if !forces.is_attached(v) || !topology.has_faces(v) {
            continue;
        }
        let ring = OneRing::new(mesh, forces, v, gain);
        if ring.force > forces.adhesion(v) {
            forces.separated_age[v.index()] = age;
            forces.separations += 1;
            forces.predictions.pieces.vertex_separated(topology, v);
            forces.touch_edges_at(topology, v);
            changes.separated.push(v);
        } else {
            let steps = ring.steps_until_separation(forces, v);
            forces.predictions.separations.put_off(v.0, steps);
        }
    }
    forces.predictions.separations.give_back(due);
}

/// What the one-ring of a vertex does to it.
struct OneRing {
    /// Sum of bending forces.
    force: f32,
    /// The same for a contraction of 1 everywhere: sum of k S(phi).
    lift: f32,
    /// Number of terms.
    edges: f32,
}

impl OneRing {
    #[inline]
    fn new(mesh: &FilmMesh, forces: &FilmForces, v: VertexId, gain: f32) -> Self {
        let (mut force, mut lift, mut edges) = (0.0, 0.0, 0.0);
        for h in mesh.topology.fan(v) {
            let opposite = h.next();
            if !mesh.topology.is_torn(opposite) {
                let weight = forces.bend_weights[opposite.index()];
                force += forces.contraction(h.face()) * weight;
                lift += weight;
                edges += 1.0;
            }
        }
        Self { force: gain * force, lift: gain * lift, edges }
    }

    /// In how many steps `v`, which holds now, can separate at the earliest: the root of the linear equation (as in
    /// [`separation_age`]), with `v` as wet as can be where anything is, less all that rounding may bring forward.
    fn steps_until_separation(&self, forces: &FilmForces, v: VertexId) -> f64 {
        let (lift, force, adhesion) = (f64::from(self.lift), f64::from(self.force), f64::from(forces.adhesion(v)));
        if self.lift == 0.0 || adhesion == f64::INFINITY {
            return f64::INFINITY;
        }
        let base = f64::from(forces.adhesion_bases[v.index()].abs());
        let rates = forces.predictions.rates;
        // Each term of a sum may be off by half the last place of the largest, and so may each step while it is wet.
        let rounding = f64::from(f32::EPSILON * (self.edges + 8.0));
        let slack = rounding * (force + lift * forces.grown + base + forces.adhesion_lost);
        let mut closing = lift * rates.growth;
        if adhesion > 0.0 {
            closing += rates.fall;
            if rates.wet_fall > 0.0 {
                closing += rates.wet_fall + f64::from(f32::EPSILON) * base;
            }
        }
        let steps = (adhesion - force - slack) / (closing * (1.0 + rounding));
        // Nothing closes in: it will hold for as long as that is so.
        if closing > 0.0 { steps } else { f64::INFINITY }
    }
}
