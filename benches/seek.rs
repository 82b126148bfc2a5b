//! Going to a step: how long a film with a history takes to get there, by the age that it goes to.
//!
//! A film is aged to 1 in 1,000 steps, with the keyframes that 16 MiB hold. Then it goes to steps drawn at random, each
//! from another that was drawn: the median and the 95th percentile are printed, and of what a median goes the restoring
//! of a keyframe. Films are a plate of 10,000 triangles and those that are given:
//!
//! ```sh
//! cargo bench --profile dev --bench seek -- ../shared/data/bunny_10k.glb
//! ```

use std::{env, path::Path, time::Instant};

use bevy_coating::{
    bake::{BakeOptions, Images, Input, coat},
    history::History,
    remesh::FilmResolution,
    settings::CoatingSettings,
    sim::FilmState,
    snapshot::Snapshot,
    stain::Environment,
};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

const STEPS: u32 = 1000;
const BANDS: [[u64; 2]; 4] = [[0, 250], [250, 500], [500, 750], [750, 1000]];

fn main() {
    let mut inputs: Vec<String> = env::args().skip(1).filter(|argument| !argument.starts_with("--")).collect();
    // Once, not measured, as the gate runs benches.
    let tries = if env::args().any(|argument| argument == "--test") { 2 } else { 100 };
    inputs.insert(0, if tries == 2 { "plate:300" } else { "plate:10000" }.into());
    for input in inputs {
        if input.contains(':') || Path::new(&input).exists() {
            measure(&input, tries);
        } else {
            println!("{input}: skipped, as there is no such file");
        }
    }
}

fn measure(input: &str, tries: usize) {
    let mut history = history_of(input);
    let begin = Instant::now();
    for _ in 0..STEPS {
        history.step().expect("a step");
    }
    println!(
        "{input}: {} triangles, {:.2} s of ageing, {} keyframes, {:.1} MiB",
        history.film().mesh.topology.face_count(),
        begin.elapsed().as_secs_f64(),
        history.keyframe_steps().count(),
        history.keyframe_bytes() as f64 / f64::from(1 << 20),
    );
    let mut random = ChaCha8Rng::seed_from_u64(1);
    for [first, end] in BANDS {
        let mut times = Vec::new();
        for _ in 0..tries {
            history.seek(random.random_range(0..u64::from(STEPS))).expect("the past");
            let step = random.random_range(first..end);
            let begin = Instant::now();
            history.seek(step).expect("the past");
            times.push(begin.elapsed().as_secs_f64() * 1e3);
        }
        times.sort_by(f64::total_cmp);
        let snapshot = Snapshot::of(history.film()).expect("a snapshot");
        let mut film = history.film().clone();
        let begin = Instant::now();
        (0..5).for_each(|_| film.restore(&snapshot).expect("the same film"));
        let restoring = begin.elapsed().as_secs_f64() * 1e3 / 5.0;
        println!(
            "  steps {first:4} to {end:4}: median {:5.1} ms, p95 {:5.1} ms; a snapshot: {restoring:.1} ms",
            times[times.len() / 2],
            times[times.len() * 95 / 100],
        );
    }
}

/// Makes the history of the largest film of a model, or of a test piece.
fn history_of(input: &str) -> History {
    let model = Input::parse(input.as_ref()).expect("an input").read(7, Images::Skip).expect("a model");
    // A test piece has its film already.
    let options = BakeOptions { resolution: FilmResolution::Keep, steps: STEPS, seed: 7, ..BakeOptions::default() };
    let films = coat(&model.origin, model.meshes, &options).expect("films").films;
    let film: FilmState = films.into_iter().max_by_key(|film| film.mesh.topology.face_count()).expect("a film");
    History::new(film, CoatingSettings::default(), Environment::default()).expect("a history")
}
