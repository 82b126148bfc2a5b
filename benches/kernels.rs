//! The innermost loops: the cost of projecting a constraint once, on a plate that has separated altogether.
//!
//! Compared are the packed solver on every instruction set that this CPU has, and the plain solver, which takes one
//! constraint after the other with the printed forms. `lengths` and `bends` are one sweep over all constraints of a
//! kind; `packed` is both after each other, to set beside `plain`, which does both at once, too. An item is a
//! constraint: 1 Gitem/s is 1 ns a constraint, 100 Mitem/s are 10 ns. The film is bending, as at rest the plain
//! solver would skip what needs no correction.
//!
//! Not measured here, but noted once on another machine, one thread, ns per constraint and sweep at 10,000 and 100,000
//! triangles: a C++ PBD library took 7.0 and 7.7 a length and 27.8 and 28.7 a bend at its very best, 13.9 and 75 a
//! length and 47 and 215 a bend as it is shipped.
//!
//! Run with `cargo bench --profile dev --bench kernels`.

mod common;

use std::fmt;

use bevy_coating::{
    deform::{BendScratch, FilmConstraints, SimdLevel, SolvePace, SolverQuality, bend_film},
    film::{FilmChanges, FilmMesh, LoosePieces},
    settings::DeformSettings,
};
use divan::{Bencher, counter::ItemsCount};

const SIZES: [u32; 2] = [10_000, 100_000];

fn main() {
    divan::main();
}

/// A film and an instruction set.
struct Case {
    triangles: u32,
    level: SimdLevel,
}

impl fmt::Display for Case {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} {}", self.triangles, self.level.name())
    }
}

fn cases() -> impl Iterator<Item = Case> {
    let levels = || SimdLevel::ALL.into_iter().filter(|level| level.is_available());
    SIZES.into_iter().flat_map(move |triangles| levels().map(move |level| Case { triangles, level }))
}

/// A plate that is off the metal and has begun to bend.
fn bending(triangles: u32) -> (FilmMesh, FilmConstraints) {
    let (mut mesh, mut constraints) = common::separated(triangles, 1.0);
    let pace = SolvePace { dt: 0.1, sweeps: 8, momentum: 0.0, tick: false, quality: SolverQuality::Default };
    let (settings, mut scratch) = (DeformSettings::default(), BendScratch::default());
    let (loose, mut changes) = (LoosePieces::default(), FilmChanges::default());
    bend_film(&mut mesh, &mut constraints, &loose, &settings, pace, &mut changes, &mut scratch);
    (mesh, constraints)
}

#[divan::bench(args = cases())]
fn lengths(bencher: Bencher, case: &Case) {
    let (_, mut constraints) = bending(case.triangles);
    let [lengths, _] = constraints.active_counts();
    bencher.counter(ItemsCount::new(lengths)).bench_local(|| constraints.sweep_lengths(case.level));
}

#[divan::bench(args = cases())]
fn bends(bencher: Bencher, case: &Case) {
    let (_, mut constraints) = bending(case.triangles);
    let [_, bends] = constraints.active_counts();
    bencher.counter(ItemsCount::new(bends)).bench_local(|| constraints.sweep_bends(case.level));
}

#[divan::bench(args = cases())]
fn packed(bencher: Bencher, case: &Case) {
    let (_, mut constraints) = bending(case.triangles);
    let [lengths, bends] = constraints.active_counts();
    bencher.counter(ItemsCount::new(lengths + bends)).bench_local(|| {
        constraints.sweep_bends(case.level);
        constraints.sweep_lengths(case.level);
    });
}

#[divan::bench(args = SIZES)]
fn plain(bencher: Bencher, triangles: u32) {
    let (mut mesh, mut constraints) = bending(triangles);
    constraints.follow_plainly(&mesh);
    let count = constraints.length_count() + constraints.bend_count();
    bencher.counter(ItemsCount::new(count)).bench_local(|| constraints.sweep_plainly(&mut mesh.geometry));
}

/// Cost of new targets to the plain solver, once a step.
#[divan::bench(args = SIZES)]
fn plain_follow(bencher: Bencher, triangles: u32) {
    let (mesh, mut constraints) = bending(triangles);
    constraints.follow_plainly(&mesh);
    let count = constraints.length_count() + constraints.bend_count();
    bencher.counter(ItemsCount::new(count)).bench_local(|| constraints.follow_plainly(&mesh));
}
