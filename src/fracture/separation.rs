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
    let mut sum = 0.0;
    for h in mesh.topology.fan(v) {
        let opposite = h.next();
        if !mesh.topology.is_torn(opposite) {
            sum += forces.contraction[h.face().index()] * forces.bend_weights[opposite.index()];
        }
    }
    gain * sum
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
pub fn separate(
    mesh: &FilmMesh,
    forces: &mut FilmForces,
    settings: &CoatingSettings,
    age: f32,
    changes: &mut FilmChanges,
) {
    for v in mesh.topology.all_vertices() {
        if !forces.is_attached(v) || !mesh.topology.has_faces(v) {
            continue;
        }
        if bending_force(mesh, forces, v, settings.bending.gain) > forces.adhesion[v.index()] {
            forces.separated_age[v.index()] = age;
            changes.separated.push(v);
        }
    }
}
