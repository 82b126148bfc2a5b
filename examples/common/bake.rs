//! Ageing: all films of a model from age 0 to the age asked for, with figures on the way.

use std::time::Instant;

use bevy_coating::{
    deform::SolverQuality,
    settings::CoatingSettings,
    sim::{FilmMeasures, FilmState, StageTimes},
    stain::Environment,
};

use super::{
    BakeError, MaterialLibrary, Model, Resolution, Stats, parallel,
    props::{Coated, Coating, Prop, coat},
    shelter::shelter,
    stats::{FilmStats, InputStats, RunStats, SCHEMA},
    stopwatch::Stopwatch,
};

/// How a model is aged.
#[derive(Clone, Debug)]
pub struct BakeOptions {
    /// How fine the films are.
    pub resolution: Resolution,
    /// Settings of the coating.
    pub settings: CoatingSettings,
    /// What to call the settings in the figures.
    pub preset: String,
    /// Age to reach; finite, not negative.
    pub age: f64,
    /// Steps per unit age; at least 1.
    pub steps: u32,
    /// How bending is solved.
    pub quality: SolverQuality,
    /// Seed of films and forces.
    pub seed: u64,
    /// Gravity and weather in scene space.
    pub environment: Environment,
}

impl Default for BakeOptions {
    fn default() -> Self {
        Self {
            resolution: Resolution::Triangles(4000),
            settings: CoatingSettings::default(),
            preset: "default".into(),
            age: 1.0,
            steps: 1000,
            quality: SolverQuality::default(),
            seed: 0,
            environment: Environment::default(),
        }
    }
}

/// Told how far ageing has come, from several threads. `()` ignores it.
pub trait Progress: Sync {
    /// Ageing begins and will take so much work.
    fn begin(&self, work: u64);
    /// So much more work is done.
    fn advance(&self, work: u64);
}

impl Progress for () {
    fn begin(&self, _: u64) {}
    fn advance(&self, _: u64) {}
}

/// An aged model.
#[derive(Debug)]
pub struct Baked {
    /// What to call the input in messages.
    pub origin: String,
    /// Who made the model.
    pub copyright: Option<String>,
    /// The props' own surfaces.
    pub props: Vec<Prop>,
    /// Their films, one to one.
    pub films: Vec<FilmState>,
    /// The model's materials.
    pub materials: MaterialLibrary,
    /// What the user should know.
    pub warnings: Vec<String>,
    /// Time spent.
    pub stopwatch: Stopwatch,
    /// All figures but the seconds, which run on.
    stats: Stats,
}

impl Baked {
    /// The figures, with the seconds up to now.
    pub fn stats(&self) -> Stats {
        Stats { seconds: self.stopwatch.seconds(), ..self.stats.clone() }
    }
}

/// Makes films of a model's meshes and ages them. `stopwatch` has run since before the model was read.
///
/// # Errors
/// [`BakeError::Build`] if no film can be made of a mesh.
pub fn bake(
    model: Model,
    options: &BakeOptions,
    mut stopwatch: Stopwatch,
    progress: &dyn Progress,
) -> Result<Baked, BakeError> {
    let Model { origin, copyright, meshes, materials, mut warnings } = model;
    let input = InputStats::of(&meshes);
    let coating = Coating {
        resolution: options.resolution,
        settings: &options.settings,
        seed: options.seed,
        steps_per_age: options.steps,
        quality: options.quality,
    };
    let coated = stopwatch.build(|| coat(&origin, meshes, &coating))?;
    let Coated { props, mut films, warnings: built } = coated;
    warnings.extend(built);

    stopwatch.build(|| shelter(&props, &mut films, &options.environment));

    let film = FilmStats::of(&films);
    let timeline = age(&mut films, options, &mut stopwatch, progress);
    for (film, prop) in films.iter().zip(&props) {
        film.validate().map_err(|cause| BakeError::Broken {
            origin: origin.clone(),
            mesh: prop.name.clone(),
            cause: cause.to_string(),
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
    };
    let digest = hasher.finalize().to_hex().to_string();
    let stats = Stats { schema: SCHEMA, input, film, run, seconds: stopwatch.seconds(), timeline, digest };
    Ok(Baked { origin, copyright, props, films, materials, warnings, stopwatch, stats })
}

/// Ages of the timeline: every twentieth up to `age`, and `age` itself.
fn timeline_ages(age: f64) -> Vec<f64> {
    let mut ages: Vec<f64> = (0u32..).map(|k| f64::from(k) / 20.0).take_while(|&k| k < age).collect();
    ages.push(age);
    ages
}

/// Ages the films, measuring them at every age of the timeline.
fn age(
    films: &mut [FilmState],
    options: &BakeOptions,
    stopwatch: &mut Stopwatch,
    progress: &dyn Progress,
) -> Vec<FilmMeasures> {
    let Some(clock) = films.first().map(|film| film.clock) else { return Vec::new() };
    let faces: u64 = films.iter().map(|film| film.mesh.topology.face_count() as u64).sum();
    progress.begin(faces * clock.step_at(options.age));
    let mut timeline = Vec::new();
    for age in timeline_ages(options.age) {
        let step = clock.step_at(age);
        let start = Instant::now();
        let mut runs: Vec<_> = films.iter_mut().map(|film| (film, StageTimes::default())).collect();
        parallel::for_each(&mut runs, |(film, times)| {
            let work = film.mesh.topology.face_count() as u64;
            while film.clock.steps < step {
                film.step_timed(&options.settings, &options.environment, times);
                progress.advance(work);
            }
        });
        let mut times = StageTimes::default();
        runs.iter().for_each(|(_, own)| times.merge(own));
        stopwatch.add_stages(&times, start.elapsed());
        timeline.push(FilmState::measure_all(films));
    }
    timeline
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
