//! The solve of a step (VC 4.1): targets narrow, then sweeps, then loose pieces go back to their place.

#[cfg(feature = "plugin")]
use bevy::reflect::prelude::ReflectDefault;
use bevy_math::Vec3;

use super::{FilmConstraints, packed::SimdLevel, plain::PlainConstraints, rigid};
use crate::{
    film::{FilmChanges, FilmMesh, LoosePieces},
    settings::DeformSettings,
};

/// Sweeps an age that are done at least, if as many are asked for: below, flakes would move in jerks.
const LEAST_SWEEPS: f32 = 1000.0;

/// How much work goes into the look: how many sweeps are really done, and how.
///
/// All give much the same look; a film keeps its cracks, whatever the quality, as fracture is judged at rest.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(
    feature = "plugin",
    derive(bevy::reflect::Reflect),
    reflect(Default, Debug, Clone, PartialEq, Hash),
    type_path = "bevy_coating::deform"
)]
pub enum SolverQuality {
    /// One constraint after the other with the printed forms, nothing left out: to compare with.
    Reference,
    /// Packed, every sweep that is asked for.
    High,
    /// Packed, a fifth of the sweeps; momentum makes up for the others.
    #[default]
    Default,
    /// Packed, a tenth of the sweeps; momentum makes up for the others. Lifts differ by a few percent.
    Fast,
}

impl SolverQuality {
    /// All, the most work first.
    pub const ALL: [Self; 4] = [Self::Reference, Self::High, Self::Default, Self::Fast];

    /// Lower-case name, as in command lines.
    pub fn name(self) -> &'static str {
        match self {
            Self::Reference => "reference",
            Self::High => "high",
            Self::Default => "default",
            Self::Fast => "fast",
        }
    }

    /// The quality of that [name](Self::name).
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|quality| quality.name() == name)
    }
}

/// What a solve keeps between steps that is no part of the film: buffers, and the instruction set.
#[derive(Clone, Debug, Default)]
pub struct BendScratch {
    /// Instruction set of the packed solver; the best there is unless set.
    pub level: SimdLevel,
    before: Vec<Vec3>,
}

/// How much is solved in a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolvePace {
    /// Age of the step.
    pub dt: f32,
    /// Whole sweeps.
    pub sweeps: u32,
    /// Share of its last movement that a point goes on by before each sweep (heavy-ball momentum): 0 to 1.
    pub momentum: f32,
    /// Whether what moves and what sleeps is looked at anew.
    pub tick: bool,
    /// How it is solved.
    pub quality: SolverQuality,
}

impl SolvePace {
    /// The pace of step number `step` (1 is the first) when an age has `steps_per_age` steps.
    pub fn of_step(sweeps_per_age: f32, quality: SolverQuality, (step, steps_per_age): (u64, u32), tick: bool) -> Self {
        let (sweeps_per_age, momentum) = sweeps_and_momentum(sweeps_per_age, quality);
        let sweeps = sweeps_of_step(sweeps_per_age, step, steps_per_age);
        Self { dt: 1.0 / steps_per_age.max(1) as f32, sweeps, momentum, tick, quality }
    }
}

/// Sweeps an age that are done for the relaxation that is asked for, and the momentum that makes up for the others:
/// `b = 1 - n / R` (the method's heavy ball).
pub fn sweeps_and_momentum(asked: f32, quality: SolverQuality) -> (f32, f32) {
    let share = match quality {
        SolverQuality::Reference | SolverQuality::High => 1.0,
        SolverQuality::Default => 0.2,
        SolverQuality::Fast => 0.1,
    };
    let least = if asked < LEAST_SWEEPS { asked } else { LEAST_SWEEPS };
    let sweeps = if asked * share > least { asked * share } else { least };
    (sweeps, if asked > 0.0 { 1.0 - sweeps / asked } else { 0.0 })
}

/// Number of whole sweeps in the step that ends at step number `step` (1 is the first) when an age has
/// `steps_per_age` steps: fractions carry over, so that any number of steps gives the same relaxation per
/// unit age.
pub fn sweeps_of_step(sweeps_per_age: f32, step: u64, steps_per_age: u32) -> u32 {
    // In f64 and from the step number alone: exact, and no state to save. The bias keeps 10,000 * 0.001 whole.
    let until = |step: u64| (f64::from(sweeps_per_age) * step as f64 / f64::from(steps_per_age.max(1)) + 1e-9).floor();
    (until(step) - until(step.saturating_sub(1))) as u32
}

/// Bends the film for one step: targets narrow, then sweeps of bends and lengths (VC 4), then loose pieces are put
/// back in their place.
pub fn bend_film(
    mesh: &mut FilmMesh,
    constraints: &mut FilmConstraints,
    loose: &LoosePieces,
    settings: &DeformSettings,
    pace: SolvePace,
    changes: &mut FilmChanges,
    scratch: &mut BendScratch,
) {
    if constraints.settings.as_ref().is_none_or(|(last, quality)| last != settings || *quality != pace.quality) {
        constraints.settings = Some((settings.clone(), pace.quality));
        constraints.wake_all(mesh);
    }
    if constraints.points.awake_count() == 0 {
        return;
    }
    constraints.narrow(scratch.level, settings.narrowing_rate * pace.dt, settings.bend_limit);
    if pace.sweeps > 0 {
        changes.moved = true;
        rigid::remember(&mesh.geometry.positions, loose, constraints, &mut scratch.before);
        if pace.quality == SolverQuality::Reference {
            sweep_plainly(mesh, constraints, pace.sweeps);
            rigid::put_back(&mut mesh.geometry, loose, constraints, &scratch.before);
            return;
        }
        if constraints.points_outdated {
            constraints.reload_points(&mesh.geometry);
        }
        for _ in 0..pace.sweeps {
            constraints.points.sweep(&constraints.regions, scratch.level, pace.momentum);
        }
        constraints.points.finish(scratch.level);
        constraints.points.write_awake(&mut mesh.geometry.positions);
        rigid::put_back(&mut mesh.geometry, loose, constraints, &scratch.before);
    }
    if pace.tick && pace.quality != SolverQuality::Reference {
        constraints.put_to_sleep(mesh, loose, settings.bend_limit);
    }
}

fn sweep_plainly(mesh: &mut FilmMesh, constraints: &mut FilmConstraints, sweeps: u32) {
    let mut plain: PlainConstraints = std::mem::take(&mut constraints.plain);
    plain.follow(mesh, constraints);
    for _ in 0..sweeps {
        plain.sweep(&mut mesh.geometry);
    }
    constraints.plain = plain;
    constraints.points_outdated = true;
}
