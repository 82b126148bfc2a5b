//! Sweeps of the solver (VC 4.1) and the half-space that keeps the film out of the metal (VC 5).

use bevy_math::Vec3;

use super::{FilmConstraints, rigid};
use crate::{
    film::{FilmChanges, FilmMesh, LoosePieces},
    settings::DeformSettings,
};

/// Room for positions before a solve, kept between steps.
#[derive(Clone, Debug, Default)]
pub struct BendScratch {
    before: Vec<Vec3>,
}

/// Number of whole sweeps in the step that ends at step number `step` (1 is the first) when an age has
/// `steps_per_age` steps: fractions carry over, so that any number of steps gives the same relaxation per
/// unit age.
pub fn sweeps_of_step(sweeps_per_age: f32, step: u64, steps_per_age: u32) -> u32 {
    // In f64 and from the step number alone: exact, and no state to save. The bias keeps 10,000 * 0.001 whole.
    let until = |step: u64| (f64::from(sweeps_per_age) * step as f64 / f64::from(steps_per_age.max(1)) + 1e-9).floor();
    (until(step) - until(step.saturating_sub(1))) as u32
}

/// Bends the film for one step of `dt`: targets narrow, then `sweeps` sweeps of bends and lengths (VC 4),
/// then loose pieces are put back in their place.
pub fn bend_film(
    mesh: &mut FilmMesh,
    constraints: &mut FilmConstraints,
    loose: &LoosePieces,
    settings: &DeformSettings,
    (dt, sweeps): (f32, u32),
    changes: &mut FilmChanges,
    scratch: &mut BendScratch,
) {
    let step = settings.narrowing_rate * dt;
    for bend in &mut constraints.bends {
        bend.narrow(step, settings.bend_limit);
    }
    if sweeps == 0 || constraints.lengths.is_empty() {
        return;
    }
    changes.moved = true;
    rigid::remember(&mesh.geometry.positions, loose, &mut scratch.before);
    for _ in 0..sweeps {
        sweep(mesh, constraints);
    }
    rigid::put_back(&mut mesh.geometry, loose, &scratch.before);
}

/// One sweep: every bend in turn, then every length.
fn sweep(mesh: &mut FilmMesh, constraints: &FilmConstraints) {
    let geometry = &mut mesh.geometry;
    let (rest, normals) = (&geometry.rest_positions, &geometry.rest_normals);
    let positions = &mut geometry.positions;
    for bend in &constraints.bends {
        let (p, w) = constraints.gather(positions, bend.points);
        let Some(corrections) = bend.corrections(p, w) else { continue };
        for i in 0..4 {
            if w[i] > 0.0 {
                let v = bend.points[i] as usize;
                positions[v] = above_plane(p[i] + corrections[i], rest[v], normals[v]);
            }
        }
    }
    for length in &constraints.lengths {
        let (p, w) = constraints.gather(positions, length.ends);
        let Some(corrections) = super::length::length_corrections(p, w, length.rest) else { continue };
        for i in 0..2 {
            if w[i] > 0.0 {
                let v = length.ends[i] as usize;
                positions[v] = above_plane(p[i] + corrections[i], rest[v], normals[v]);
            }
        }
    }
}

/// Takes out what puts `p` below the plane through its rest position (VC 5): all the contact there is.
#[inline]
pub fn above_plane(p: Vec3, rest: Vec3, normal: Vec3) -> Vec3 {
    let height = (p - rest).dot(normal);
    if height < 0.0 { p - height * normal } else { p }
}
