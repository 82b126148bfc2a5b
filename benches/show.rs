//! The cost of bringing the appearance up to date with its film, in each frame in which it took a step.
//!
//! All of the plate has separated, so that every face has a back and metal under it. In `moving` every vertex has moved
//! since the last time, as when a whole film bends; in `still` nothing has (the plugin does not ask then); `stained`
//! changes nothing but the stains. In `partly_moving` two fifths of the plate have separated, and nothing else moves.
//! `ageing` follows a film through 20 steps at age 0.6, one at a time. `new` makes the parts from scratch, as once a
//! prop, and `new_fresh` those of a film that has not separated anywhere. An item is a triangle of the film.
//! `heat` computes the values and colours of each heat map on a film at age 0.6.
//! Handing the arrays to the engine comes on top; that is in the bench `plugin`.
//!
//! Names with `fine` are at level 2, with 16 triangles for each of the film.
//!
//! Run with `cargo bench --profile dev --bench show`.

mod common;

use bevy_coating::{
    appearance::{Detail, DisplayChanges, FilmAppearance},
    heat::{HeatFilm, HeatMap, HeatValues},
    remesh::sample::TestPiece,
    settings::CoatingSettings,
    sim::FilmState,
    stain::Environment,
};
use divan::{Bencher, counter::ItemsCount};

const SIZES: [u32; 3] = [3_000, 10_000, 100_000];
const FINE_SIZES: [u32; 2] = [3_000, 10_000];
/// Size at which the cost of levels is compared.
const SIZE: u32 = 10_000;
/// Share of the film that moves in `partly_moving`.
const SHARE: f32 = 0.4;
/// Steps that `ageing` shows.
const STEPS: usize = 20;
/// Age at which `ageing` begins.
const AGE: f64 = 0.6;

fn main() {
    divan::main();
}

/// Makes the film of a plate of which this share, from the left, has come off the metal.
fn separated(piece: &TestPiece, share: f32) -> FilmState {
    let mut film = fresh(piece);
    for v in common::left_share(&film.mesh, share) {
        film.forces.separated_age[v.index()] = 0.0;
    }
    film.forces.touch_all();
    film
}

fn fresh(piece: &TestPiece) -> FilmState {
    FilmState::new(&piece.film, &CoatingSettings::default(), 1, 1000).expect("a manifold")
}

fn shown(piece: &TestPiece, film: &FilmState, level: u32) -> FilmAppearance {
    shown_within(piece, film, level, 0.0)
}

/// Shows a film within this tolerance.
fn shown_within(piece: &TestPiece, film: &FilmState, level: u32, tolerance: f32) -> FilmAppearance {
    let FilmState { mesh, forces, stains, .. } = film;
    let detail = Detail { level, tolerance, ..Detail::default() };
    FilmAppearance::with_detail(&piece.film, &piece.surface, mesh, forces, stains, detail).expect("a clean plate")
}

/// Updates the appearance after each `change` of the film, of which this share has separated.
fn update(
    bencher: Bencher,
    triangles: u32,
    level: u32,
    share: f32,
    changes: DisplayChanges,
    change: impl Fn(&mut FilmState, f32),
) {
    let piece = common::plate(triangles);
    let mut film = separated(&piece, share);
    let mut shown = shown(&piece, &film, level);
    let mut sign = 1.0;
    bencher.counter(ItemsCount::new(triangles)).bench_local(|| {
        sign = -sign;
        change(&mut film, sign);
        shown.update(&film.mesh, &film.forces, &film.stains, changes)
    });
}

/// Moves every vertex on this share of the film, which has separated.
fn move_share(bencher: Bencher, triangles: u32, level: u32, share: f32) {
    let mut moved = DisplayChanges::default();
    moved.moved = true;
    let film = fresh(&common::plate(triangles));
    let those: Vec<usize> = common::left_share(&film.mesh, share).map(|v| v.index()).collect();
    update(bencher, triangles, level, share, moved, |film, sign| {
        for &i in &those {
            film.mesh.geometry.positions[i].z += sign * 1e-3 * (1 + i % 3) as f32;
        }
    });
}

#[divan::bench(args = SIZES)]
fn moving(bencher: Bencher, triangles: u32) {
    move_share(bencher, triangles, 0, 1.0);
}

#[divan::bench(args = FINE_SIZES)]
fn moving_fine(bencher: Bencher, triangles: u32) {
    move_share(bencher, triangles, 2, 1.0);
}

#[divan::bench]
fn partly_moving(bencher: Bencher) {
    move_share(bencher, SIZE, 0, SHARE);
}

#[divan::bench]
fn partly_moving_fine(bencher: Bencher) {
    move_share(bencher, SIZE, 2, SHARE);
}

/// Follows a film that ages, step by step.
fn age(bencher: Bencher, level: u32, tolerance: f32) {
    let (piece, settings, environment) = (common::plate(SIZE), CoatingSettings::default(), Environment::default());
    let mut film = fresh(&piece);
    film.age_to(AGE, &settings, &environment);
    let begun = shown_within(&piece, &film, level, tolerance);
    common::follow(bencher, film, begun, &settings, STEPS, SIZE as usize * STEPS);
}

#[divan::bench]
fn ageing(bencher: Bencher) {
    age(bencher, 0, 0.0);
}

#[divan::bench]
fn ageing_fine(bencher: Bencher) {
    age(bencher, 2, 0.0);
}

#[divan::bench(args = SIZES)]
fn still(bencher: Bencher, triangles: u32) {
    update(bencher, triangles, 0, 1.0, DisplayChanges::default(), |_, _| {});
}

#[divan::bench(args = SIZES)]
fn stained(bencher: Bencher, triangles: u32) {
    let mut stained = DisplayChanges::default();
    stained.stains = true;
    update(bencher, triangles, 0, 1.0, stained, |_, _| {});
}

/// The same with moves of up to 1 % of an edge overlooked.
#[divan::bench]
fn ageing_tolerant(bencher: Bencher) {
    age(bencher, 0, 0.01);
}

#[divan::bench]
fn ageing_tolerant_fine(bencher: Bencher) {
    age(bencher, 2, 0.01);
}

/// Makes all parts of a film of which this share has separated.
fn make(bencher: Bencher, triangles: u32, level: u32, share: f32) {
    let piece = common::plate(triangles);
    let film = separated(&piece, share);
    bencher.counter(ItemsCount::new(triangles)).bench_local(|| shown(&piece, &film, level));
}

#[divan::bench(args = SIZES, sample_count = 20, sample_size = 1)]
fn new(bencher: Bencher, triangles: u32) {
    make(bencher, triangles, 0, 1.0);
}

#[divan::bench(args = FINE_SIZES, sample_count = 20, sample_size = 1)]
fn new_fine(bencher: Bencher, triangles: u32) {
    make(bencher, triangles, 2, 1.0);
}

#[divan::bench(sample_count = 20, sample_size = 1)]
fn new_fresh(bencher: Bencher) {
    make(bencher, SIZE, 0, 0.0);
}

#[divan::bench(sample_count = 20, sample_size = 1)]
fn new_fresh_fine(bencher: Bencher) {
    make(bencher, SIZE, 2, 0.0);
}

#[divan::bench(args = HeatMap::ALL)]
fn heat(bencher: Bencher, map: HeatMap) {
    let (settings, environment) = (CoatingSettings::default(), Environment::default());
    let mut film = fresh(&common::plate(SIZE));
    film.age_to(AGE, &settings, &environment);
    let parts = HeatFilm { mesh: &film.mesh, forces: &film.forces, stains: &film.stains, settings: &settings };
    let (mut values, range) = (HeatValues::default(), map.range());
    bencher.counter(ItemsCount::new(SIZE)).bench_local(|| {
        values.update(map, parts);
        values.corners().iter().map(|&value| map.color(value, range)[0]).sum::<f32>()
    });
}
