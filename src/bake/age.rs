//! Ages all films of a model from age 0 to the age asked for, and measures them on the way.

use web_time::Instant;

use super::{
    baked::Baked,
    coat::{Coated, Prop, coat},
    error::BakeError,
    extras::read_extras,
    leave::leave_alone,
    model::Model,
    options::BakeOptions,
    parallel,
    progress::Progress,
    shelter::shelter,
    stats::{FilmStats, InputStats, RatedAge, RunStats, STATS_SCHEMA, Stats, UntilStats},
    stopwatch::Stopwatch,
    warning::BakeWarning,
};
use crate::{
    sim::{FilmMeasures, FilmState, StageTimes},
    survey::UntilWatch,
};

/// Makes films of a model's meshes and ages them from 0 to [`BakeOptions::age`], or until [`BakeOptions::until`].
/// `stopwatch` has run since before the model was read.
///
/// ```
/// use bevy_coating::bake::{BakeOptions, Images, Input, Stopwatch, bake};
///
/// let stopwatch = Stopwatch::start();
/// let model = Input::parse("disk:60".as_ref())?.read(3, Images::Skip)?;
/// let options = BakeOptions { age: 0.1, seed: 3, ..BakeOptions::default() };
/// let baked = bake(model, &options, stopwatch, &())?;
/// // Measured at ages 0, 0.05 and 0.1.
/// assert_eq!(baked.stats().timeline.len(), 3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`BakeError::Options`] if an option is out of its range, [`BakeError::AllLeftAlone`] if everything is glass or
/// excluded, [`BakeError::Build`] if no film can be made of a mesh,
/// [`BakeError::Broken`] if a film is not sound.
pub fn bake(
    model: Model,
    options: &BakeOptions,
    mut stopwatch: Stopwatch,
    progress: &dyn Progress,
) -> Result<Baked, BakeError> {
    options.validate()?;
    let input = InputStats::of(&model.meshes);
    let mut model = model;
    if options.extras {
        read_extras(&mut model);
    }
    let left = leave_alone(&mut model, &options.exclude, options.extras)?;
    let Model { origin, copyright, meshes, materials, mut warnings, carried, .. } = model;
    let coated = stopwatch.build(|| coat(&origin, meshes, options))?;
    let Coated { props, mut films, warnings: built } = coated;
    warnings.extend(built);
    BakeWarning::gather(&mut warnings);

    stopwatch.build(|| shelter(&props, &mut films, &options.environment));

    let film = FilmStats::of(&films);
    let Aged { timeline, ratings, reached } = age(&mut films, &props, options, &mut stopwatch, progress);
    let until = options.until.zip(ratings.last()).map(|(goal, last)| UntilStats { goal, reached, age: last.age });
    if let (Some(UntilStats { goal: until, reached: false, age }), Some(last)) = (&until, ratings.last()) {
        warnings.push(BakeWarning::NotReached { until: *until, age: *age, ratings: last.ratings });
    }
    for (film, prop) in films.iter().zip(&props) {
        film.validate().map_err(|cause| BakeError::Broken {
            origin: origin.clone(),
            mesh: prop.name.clone(),
            source: cause.into(),
        })?;
    }
    let mut hasher = blake3::Hasher::new();
    films.iter().for_each(|film| film.digest_into(&mut hasher));
    let run = RunStats {
        age: options.age,
        steps: options.steps,
        seed: options.seed,
        preset: options.preset.clone(),
        sweeps_per_age: options.settings.deform.sweeps_per_age,
        quality: options.quality.name().into(),
        until,
    };
    let digest = hasher.finalize().to_hex().to_string();
    let seconds = stopwatch.seconds();
    let stats = Stats { schema: STATS_SCHEMA, input, film, run, seconds, timeline, ratings, digest };
    let detail = options.detail;
    Ok(Baked { origin, copyright, props, films, materials, warnings, carried, left, detail, stopwatch, stats })
}

/// Ages of the timeline: every twentieth up to `age`, and `age` itself.
fn timeline_ages(age: f64) -> Vec<f64> {
    let mut ages: Vec<f64> = (0u32..).map(|k| f64::from(k) / 20.0).take_while(|&k| k < age).collect();
    ages.push(age);
    ages
}

/// Figures that were measured while films were aged.
#[derive(Default)]
struct Aged {
    timeline: Vec<FilmMeasures>,
    ratings: Vec<RatedAge>,
    /// Whether the films have come to the condition.
    reached: bool,
}

/// Ages the films, measuring them at every age of the timeline, and at the one at which they have come to the
/// condition.
fn age(
    films: &mut [FilmState],
    props: &[Prop],
    options: &BakeOptions,
    stopwatch: &mut Stopwatch,
    progress: &dyn Progress,
) -> Aged {
    let mut aged = Aged::default();
    let Some(clock) = films.first().map(|film| film.clock) else { return aged };
    let faces: u64 = films.iter().map(|film| film.mesh.topology.face_count() as u64).sum();
    progress.begin(faces * clock.step_at(options.age));
    let mut watch = options.until.map(UntilWatch::new);
    for age in timeline_ages(options.age) {
        let step = clock.step_at(age);
        loop {
            aged.reached = watch.as_mut().is_some_and(|watch| watch.is_reached(films));
            let now = films.first().map_or(step, |film| film.clock.steps);
            if aged.reached || now >= step {
                break;
            }
            take_steps(films, props, step, options, stopwatch, progress);
        }
        aged.timeline.push(FilmState::measure_all(films));
        aged.ratings.push(RatedAge::of(films));
        if aged.reached {
            break;
        }
    }
    aged
}

/// Takes all films to `step`, or only to the next tick where a condition is looked for.
fn take_steps(
    films: &mut [FilmState],
    props: &[Prop],
    step: u64,
    options: &BakeOptions,
    stopwatch: &mut Stopwatch,
    progress: &dyn Progress,
) {
    let start = Instant::now();
    let settings = props.iter().map(|prop| &prop.settings);
    let mut runs: Vec<_> =
        films.iter_mut().zip(settings).map(|(film, settings)| (film, settings, StageTimes::default())).collect();
    parallel::for_each(&mut runs, |(film, settings, times)| {
        let work = film.mesh.topology.face_count() as u64;
        let step = if options.until.is_some() { step.min(film.clock.next_tick()) } else { step };
        while film.clock.steps < step {
            film.step_timed(settings, &options.environment, times);
            progress.advance(work);
        }
    });
    let mut times = StageTimes::default();
    runs.iter().for_each(|(.., own)| times.merge(own));
    stopwatch.add_stages(&times, start.elapsed());
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_timeline_ends_at_the_age_asked_for() {
        assert_eq!(timeline_ages(0.0), [0.0]);
        assert_eq!(timeline_ages(0.1), [0.0, 0.05, 0.1]);
        assert_eq!(timeline_ages(0.12), [0.0, 0.05, 0.1, 0.12]);
        assert_eq!(timeline_ages(1.0).len(), 21);
        assert_eq!(timeline_ages(0.3).last(), Some(&0.3));
        assert_eq!(timeline_ages(0.3).len(), 7);
    }
}
