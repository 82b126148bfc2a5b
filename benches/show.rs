//! The cost of bringing the appearance up to date with its film, in each frame in which it took a step.
//!
//! All of the plate has separated, so that every face has a back and metal under it. In `moving` every vertex has moved
//! since the last time, as when a whole film bends; in `still` nothing has (the plugin does not ask then); `stained`
//! changes nothing but the stains. `new` makes the parts from scratch, as once a prop. An item is a triangle.
//! Handing the arrays to the engine comes on top; that is in the bench `plugin`.
//!
//! Run with `cargo bench --profile dev --bench show`.

mod common;

use bevy_coating::{
    appearance::{Detail, DisplayChanges, FilmAppearance},
    remesh::sample::TestPiece,
    settings::CoatingSettings,
    sim::FilmState,
};
use divan::{Bencher, counter::ItemsCount};

const SIZES: [u32; 3] = [3_000, 10_000, 100_000];
const FINE_SIZES: [u32; 2] = [3_000, 10_000];

fn main() {
    divan::main();
}

/// Makes the film of a plate that has come off the metal.
fn separated(piece: &TestPiece) -> FilmState {
    let mut film = FilmState::new(&piece.film, &CoatingSettings::default(), 1, 1000).expect("a manifold");
    film.forces.separated_age.fill(0.0);
    film.forces.touch_all();
    film
}

fn shown(piece: &TestPiece, film: &FilmState, level: u32) -> FilmAppearance {
    let FilmState { mesh, forces, stains, .. } = film;
    let detail = Detail { level, ..Detail::default() };
    FilmAppearance::with_detail(&piece.film, &piece.surface, mesh, forces, stains, detail).expect("a clean plate")
}

/// Updates the appearance after each `change` of the film.
fn update(bencher: Bencher, triangles: u32, level: u32, changes: DisplayChanges, change: impl Fn(&mut FilmState, f32)) {
    let piece = common::plate(triangles);
    let mut film = separated(&piece);
    let mut shown = shown(&piece, &film, level);
    let mut sign = 1.0;
    bencher.counter(ItemsCount::new(triangles)).bench_local(|| {
        sign = -sign;
        change(&mut film, sign);
        shown.update(&film.mesh, &film.forces, &film.stains, changes)
    });
}

/// Moves every vertex.
fn move_all(bencher: Bencher, triangles: u32, level: u32) {
    let mut moved = DisplayChanges::default();
    moved.moved = true;
    update(bencher, triangles, level, moved, |film, sign| {
        for (i, p) in film.mesh.geometry.positions.iter_mut().enumerate() {
            p.z += sign * 1e-3 * (1 + i % 3) as f32;
        }
    });
}

#[divan::bench(args = SIZES)]
fn moving(bencher: Bencher, triangles: u32) {
    move_all(bencher, triangles, 0);
}

/// The same with 16 triangles for each.
#[divan::bench(args = FINE_SIZES)]
fn moving_fine(bencher: Bencher, triangles: u32) {
    move_all(bencher, triangles, 2);
}

#[divan::bench(args = SIZES)]
fn still(bencher: Bencher, triangles: u32) {
    update(bencher, triangles, 0, DisplayChanges::default(), |_, _| {});
}

#[divan::bench(args = SIZES)]
fn stained(bencher: Bencher, triangles: u32) {
    let mut stained = DisplayChanges::default();
    stained.stains = true;
    update(bencher, triangles, 0, stained, |_, _| {});
}

/// Makes all parts.
fn make(bencher: Bencher, triangles: u32, level: u32) {
    let piece = common::plate(triangles);
    let film = separated(&piece);
    bencher.counter(ItemsCount::new(triangles)).bench_local(|| shown(&piece, &film, level));
}

#[divan::bench(args = SIZES, sample_count = 20, sample_size = 1)]
fn new(bencher: Bencher, triangles: u32) {
    make(bencher, triangles, 0);
}

/// The same with 16 triangles for each.
#[divan::bench(args = FINE_SIZES, sample_count = 20, sample_size = 1)]
fn new_fine(bencher: Bencher, triangles: u32) {
    make(bencher, triangles, 2);
}
