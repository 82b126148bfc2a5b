//! Ages a model and keeps the time.

use std::time::{Duration, Instant};

use bevy_coating::{
    appearance::{DisplayChanges, FilmAppearance},
    bake::{BakeError, BakeOptions, Coated, Images, Input, coat},
    deform::{SimdLevel, SolverQuality, sweeps_of_step},
    remesh::FilmResolution,
    settings::{CoatingSettings, Preset},
    sim::{FilmState, Stage, StageTimes},
    stain::Environment,
};

use crate::args::Args;

/// A model and its films at rest.
pub struct Loaded {
    name: String,
    coated: Coated,
}

/// One line of the table.
pub struct Row {
    pub model: String,
    pub triangles: usize,
    pub steps: u32,
    pub quality: SolverQuality,
    pub seconds: f64,
    /// Shares of the time, in the order of [`STAGES`].
    pub shares: [f64; 5],
    pub sweeps_per_step: f64,
    /// Share of all constraints that sweeps visited: the mean over all steps, of those that the whole film would have
    /// with everything separated and nothing torn.
    pub mean_active: f64,
    pub lift_p90: Option<f64>,
    pub strain_rms: Option<f64>,
    pub simd: &'static str,
}

/// What time is spent on, as in the paper.
pub const STAGES: [(Stage, &str); 5] = [
    (Stage::Fracture, "fracture"),
    (Stage::Deformation, "deformation"),
    (Stage::MeshGeneration, "mesh"),
    (Stage::Stains, "stains"),
    (Stage::Other, "other"),
];

/// Reads a model and makes its films.
pub fn load(input: &Input, args: &Args) -> Result<Loaded, BakeError> {
    let model = input.read(args.seed, Images::Skip)?;
    let options = BakeOptions {
        resolution: FilmResolution::Keep,
        seed: args.seed,
        steps: args.steps,
        quality: args.quality,
        ..BakeOptions::default()
    };
    let coated = coat(&model.origin, model.meshes, &options)?;
    Ok(Loaded { name: model.origin, coated })
}

/// Ages a model from fresh to age 1 as often as asked for; the run of the median time counts.
pub fn measure(model: &Loaded, args: &Args) -> Row {
    let mut runs: Vec<_> = (0..args.repeat).map(|_| run(model, args)).collect();
    runs.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
    runs.swap_remove(runs.len() / 2)
}

fn run(model: &Loaded, args: &Args) -> Row {
    let (settings, environment) = (CoatingSettings::from(Preset::Paper), Environment::default());
    let mut films = model.coated.films.clone();
    let mut shown: Vec<FilmAppearance> = (films.iter().zip(&model.coated.props))
        .map(|(film, prop)| FilmAppearance::new(&prop.built, &prop.surface, &film.mesh, &film.forces, &film.stains))
        .collect();
    let mut changes = vec![DisplayChanges::default(); films.len()];
    let whole: usize = films.iter().map(whole_constraints).sum();
    let mut times = StageTimes::default();
    let (mut active, mut sweeps) = (0u64, 0u64);
    let mut wall = Duration::ZERO;
    for _ in 0..args.steps {
        let start = Instant::now();
        for ((film, shown), changes) in films.iter_mut().zip(&mut shown).zip(&mut changes) {
            film.step_timed(&settings, &environment, &mut times);
            times.measure(Stage::MeshGeneration, || {
                changes.record(&film.changes, &film.stains);
                shown.update(&film.mesh, &film.forces, &film.stains, changes.take());
            });
        }
        wall += start.elapsed();
        active += films.iter().map(|film| film.constraints.active_counts().iter().sum::<usize>() as u64).sum::<u64>();
        if let Some(film) = films.first() {
            let (per_age, _) = bevy_coating::deform::sweeps_and_momentum(settings.deform.sweeps_per_age, args.quality);
            sweeps += u64::from(sweeps_of_step(per_age, film.clock.steps, args.steps));
        }
    }
    let named: Duration = STAGES.iter().map(|(stage, _)| times.of(*stage)).sum();
    times.add(Stage::Other, wall.saturating_sub(named));
    let seconds = wall.as_secs_f64();
    let measures = FilmState::measure_all(&films);
    let steps = f64::from(args.steps);
    Row {
        model: model.name.clone(),
        triangles: films.iter().map(|film| film.mesh.topology.face_count()).sum(),
        steps: args.steps,
        quality: args.quality,
        seconds,
        shares: STAGES.map(|(stage, _)| times.of(stage).as_secs_f64() / seconds.max(f64::MIN_POSITIVE)),
        sweeps_per_step: sweeps as f64 / steps,
        mean_active: active as f64 / (steps * whole.max(1) as f64),
        lift_p90: measures.lift_p90,
        strain_rms: measures.strain_rms,
        simd: if args.quality == SolverQuality::Reference { "none" } else { SimdLevel::best().name() },
    }
}

/// Lengths and bends of a film with everything separated and nothing torn.
fn whole_constraints(film: &FilmState) -> usize {
    let topology = &film.mesh.topology;
    topology.all_edges().map(|h| 1 + usize::from(topology.rest_twin(h).is_some())).sum()
}
