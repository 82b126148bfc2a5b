//! How much is solved in a step, and how.

#[cfg(feature = "plugin")]
use bevy::reflect::prelude::ReflectDefault;

/// Least number of sweeps an age that are really done, if as many are asked for: below, flakes would move in jerks.
const LEAST_SWEEPS: f32 = 1000.0;

/// Largest momentum: with 0.999 a film whose mean edge is a quarter of its grain lifts by a fifth less than with 0.996.
const MOST_MOMENTUM: f32 = 0.9985;

/// Quality of the solver: how many of the sweeps that are asked for are really done, and how.
///
/// All qualities give much the same look. A film keeps its cracks whatever the quality, as fracture is judged at rest.
///
/// ```
/// use bevy_coating::deform::SolverQuality;
///
/// assert_eq!(SolverQuality::default(), SolverQuality::Default);
/// assert_eq!(SolverQuality::named("fast"), Some(SolverQuality::Fast));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(
    feature = "plugin",
    derive(bevy::reflect::Reflect),
    reflect(Default, Debug, Clone, PartialEq, Hash),
    type_path = "bevy_coating::deform"
)]
pub enum SolverQuality {
    /// Solves one constraint after the other with the printed forms and leaves nothing out: a reference to compare
    /// with.
    Reference,
    /// Solves packs of constraints, in every sweep that is asked for.
    High,
    /// Solves packs of constraints in a fifth of the sweeps; momentum makes up for the others.
    #[default]
    Default,
    /// Solves packs of constraints in a tenth of the sweeps; momentum makes up for the others. Flakes lift a few
    /// percent more or less.
    Fast,
}

impl SolverQuality {
    /// All qualities, the one with the most work first.
    pub const ALL: [Self; 4] = [Self::Reference, Self::High, Self::Default, Self::Fast];

    /// Returns the lower-case name, as in command lines.
    pub fn name(self) -> &'static str {
        match self {
            Self::Reference => "reference",
            Self::High => "high",
            Self::Default => "default",
            Self::Fast => "fast",
        }
    }

    /// Returns the quality that has that [name](Self::name), if any.
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|quality| quality.name() == name)
    }
}

/// Pace of the solver: how much of an age a step covers, and how much is solved in it.
///
/// ```
/// use bevy_coating::deform::{SolvePace, SolverQuality};
///
/// // 10,000 sweeps an age over 1,000 steps are 10 a step. A fifth of them is done.
/// let pace = SolvePace::of_step(10_000.0, SolverQuality::Default, (1, 1000), false);
/// assert_eq!(pace.sweeps, 2);
/// assert!((pace.momentum - 0.8).abs() < 1e-6);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SolvePace {
    /// Age that the step covers.
    pub dt: f32,
    /// Number of whole sweeps.
    pub sweeps: u32,
    /// Share of its last movement, 0 to 1, by which a point goes on before each sweep (heavy-ball momentum).
    pub momentum: f32,
    /// Whether this step decides again which vertices move and which sleep.
    pub tick: bool,
    /// Quality of the solver.
    pub quality: SolverQuality,
}

impl SolvePace {
    /// Returns the pace of step number `step` (1 is the first) when an age has `steps_per_age` steps, for
    /// `sweeps_per_age` plain sweeps an age
    /// ([`DeformSettings::sweeps_per_age`](crate::settings::DeformSettings::sweeps_per_age)).
    pub fn of_step(sweeps_per_age: f32, quality: SolverQuality, (step, steps_per_age): (u64, u32), tick: bool) -> Self {
        let (sweeps_per_age, momentum) = sweeps_and_momentum(sweeps_per_age, quality);
        let sweeps = sweeps_of_step(sweeps_per_age, step, steps_per_age);
        Self { dt: 1.0 / steps_per_age.max(1) as f32, sweeps, momentum, tick, quality }
    }
}

impl SolvePace {
    /// Returns the pace of step number `step` (1 is the first) of a film that is measured by its grain, which is
    /// `in_edges` times as long as its mean edge.
    ///
    /// The progress of wide curls goes with the number of sweeps times the fourth power of the edge, so that many
    /// sweeps are asked for: `sweeps_per_age` on a film whose mean edge is the grain, 16 times as many where it is half
    /// of it. Momentum pays for most of them: a film is swept more often than one whose mean edge is the grain only
    /// where momentum would be above 0.9985, with which curls would lag behind by a third of an age.
    pub fn of_grain_step(
        sweeps_per_age: f32,
        in_edges: f32,
        quality: SolverQuality,
        (step, steps_per_age): (u64, u32),
        tick: bool,
    ) -> Self {
        let asked = sweeps_per_age * in_edges * in_edges * in_edges * in_edges;
        let (done, _) = sweeps_and_momentum(sweeps_per_age, quality);
        let done = match quality {
            SolverQuality::Reference => asked,
            _ => done,
        };
        let least = asked * (1.0 - MOST_MOMENTUM);
        let sweeps = done.max(least).min(asked);
        let momentum = if asked > 0.0 { 1.0 - sweeps / asked } else { 0.0 };
        let dt = 1.0 / steps_per_age.max(1) as f32;
        Self { dt, sweeps: sweeps_of_step(sweeps, step, steps_per_age), momentum, tick, quality }
    }
}

/// Narrowing of the targets of bends in one step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Narrowing {
    /// Angle by which targets narrow, in radians.
    pub step: f32,
    /// Angle below that at which a bend began, at which its target stays, in radians.
    pub limit: f32,
}

/// Returns the number of sweeps an age that are really done when `asked` plain sweeps are asked for, and the momentum
/// that makes up for the others.
///
/// With `n` sweeps done for `R` asked for, momentum is `1 - n / R` (heavy ball). At least 1,000 sweeps an age are done,
/// or as many as are asked for.
///
/// ```
/// use bevy_coating::deform::{SolverQuality, sweeps_and_momentum};
///
/// assert_eq!(sweeps_and_momentum(10_000.0, SolverQuality::High), (10_000.0, 0.0));
/// let (sweeps, momentum) = sweeps_and_momentum(10_000.0, SolverQuality::Fast);
/// assert!((sweeps - 1000.0).abs() < 0.1 && (momentum - 0.9).abs() < 1e-6);
/// ```
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

/// Returns the number of whole sweeps in the step that ends at step number `step` (1 is the first) when an age has
/// `steps_per_age` steps. Fractions carry over, so that any number of steps gives the same relaxation per unit age.
///
/// ```
/// use bevy_coating::deform::sweeps_of_step;
///
/// // 2.5 sweeps a step.
/// let sweeps: Vec<u32> = (1..=4).map(|step| sweeps_of_step(10_000.0, step, 4000)).collect();
/// assert_eq!(sweeps, [2, 3, 2, 3]);
/// ```
pub fn sweeps_of_step(sweeps_per_age: f32, step: u64, steps_per_age: u32) -> u32 {
    // In f64 and from the step number alone: exact, and no state to save. The bias keeps 10,000 * 0.001 whole.
    let until = |step: u64| (f64::from(sweeps_per_age) * step as f64 / f64::from(steps_per_age.max(1)) + 1e-9).floor();
    (until(step) - until(step.saturating_sub(1))) as u32
}
