//! A solve of four sweeps, and whole runs: the cost of bending a film for a step, and of ageing it from 0 to 1.
//!
//! `best` is the packed solver on the best instruction set that this CPU has, `scalar` the same packs one float at a
//! time, `reference` one constraint after the other with the printed forms. Each solves plates of which a share is off
//! the metal (0, 10, 40 and 100 %); none of it is allowed to fall asleep, so what is measured is the dearest step of a
//! film in that state. With 0 % there is nothing to do, in less time than can be told from that of the loop. An item is
//! a triangle. `whole_run` takes the paper's plate of 3,012 triangles through 1,000 steps to age 1, with fracture and
//! stains, at every quality; an item is a step.
//!
//! Not measured here: a C++ PBD library needs at its very best 7.0 ns a length and 27.8 ns a bend constraint and
//! sweep at 10,000 triangles (noted once on another machine, one thread); there are about 1.5 of each a triangle.
//!
//! Run with `cargo bench --profile dev --bench step`. With the environment variable `BEVY_COATING_BENCH_LARGE` there
//! are films of a million triangles, too.

mod common;

use std::fmt;

use bevy_coating::{
    deform::{BendScratch, SimdLevel, SolvePace, SolverQuality, bend_film},
    film::{FilmChanges, LoosePieces},
    settings::{CoatingSettings, DeformSettings},
    sim::FilmState,
    stain::Environment,
};
use divan::{Bencher, black_box, counter::ItemsCount};

const STEPS: u32 = 1000;

fn main() {
    divan::main();
}

/// A plate, and the share of it that is off the metal.
struct Case {
    triangles: u32,
    percent: u32,
}

impl fmt::Display for Case {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {} %", self.triangles, self.percent)
    }
}

fn cases() -> Vec<Case> {
    let mut sizes = vec![3012, 10_000, 100_000];
    if std::env::var_os("BEVY_COATING_BENCH_LARGE").is_some() {
        sizes.push(1_000_000);
    }
    let shares = |triangles| [0, 10, 40, 100].map(|percent| Case { triangles, percent });
    sizes.into_iter().flat_map(shares).collect()
}

fn solve(bencher: Bencher, case: &Case, quality: SolverQuality, level: SimdLevel) {
    let (mut mesh, mut constraints) = common::separated(case.triangles, case.percent as f32 / 100.0);
    let (settings, loose) = (DeformSettings::default(), LoosePieces::default());
    let (mut changes, mut scratch) = (FilmChanges::default(), BendScratch::default());
    scratch.level = level;
    let pace = SolvePace { dt: 0.001, sweeps: 4, momentum: 0.8, tick: false, quality };
    let mut step = || {
        // Else a solve that finds nothing to do is taken out of the loop.
        let constraints = black_box(&mut constraints);
        bend_film(&mut mesh, constraints, &loose, &settings, pace, &mut changes, &mut scratch);
    };
    // The first one allocates.
    step();
    bencher.counter(ItemsCount::new(case.triangles)).bench_local(step);
}

#[divan::bench(args = cases())]
fn best(bencher: Bencher, case: &Case) {
    solve(bencher, case, SolverQuality::Default, SimdLevel::default());
}

#[divan::bench(args = cases())]
fn scalar(bencher: Bencher, case: &Case) {
    solve(bencher, case, SolverQuality::Default, SimdLevel::Scalar);
}

#[divan::bench(args = cases(), sample_count = 20)]
fn reference(bencher: Bencher, case: &Case) {
    solve(bencher, case, SolverQuality::Reference, SimdLevel::default());
}

#[divan::bench(args = SolverQuality::ALL.map(SolverQuality::name), sample_count = 3, sample_size = 1)]
fn whole_run(bencher: Bencher, quality: &str) {
    let (settings, environment) = (CoatingSettings::default(), Environment::default());
    let piece = common::plate(3012);
    let mut fresh = FilmState::new(&piece.film, &settings, 1, STEPS).expect("a manifold");
    fresh.quality = SolverQuality::named(quality).expect("a quality");
    bencher.counter(ItemsCount::new(STEPS)).with_inputs(|| fresh.clone()).bench_local_values(|mut film| {
        film.age_to(1.0, &settings, &environment);
        film
    });
}
