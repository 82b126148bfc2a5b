//! What a prop costs by its number of triangles and by the level at which it is shown: the table of `docs/choosing.md`.
//!
//! Each film is a plate whose grain is chosen so that its edges are 0.7 grains long, as films have them by default, so
//! that all crack alike. `build` is what happens once in the background: from the surface to a film that is shown.
//! `life` ages it from 0 to 1 in 1,000 steps; an item is a step. `show` brings what is drawn up to date after each of
//! 20 steps at age 0.6; an item is a step, too.
//!
//! Run with `cargo bench --profile dev --bench choose`.

mod common;

use std::fmt;

use bevy_coating::{
    appearance::{Detail, FilmAppearance},
    remesh::{BuiltFilm, FilmTarget, build_film, sample::TestPiece},
    settings::CoatingSettings,
    sim::FilmState,
    stain::Environment,
};
use divan::{Bencher, counter::ItemsCount};

const SIZES: [u32; 3] = [1_000, 4_000, 16_000];
const LEVELS: [u32; 4] = [0, 1, 2, 3];
/// Mean edge in grains, as by default.
const SHARE: f32 = 0.7;
const STEPS: usize = 20;
const AGE: f64 = 0.6;

fn main() {
    divan::main();
}

/// A number of triangles and a level.
struct Case {
    triangles: u32,
    level: u32,
}

impl fmt::Display for Case {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} level {}", self.triangles, self.level)
    }
}

fn cases() -> impl Iterator<Item = Case> {
    SIZES.into_iter().flat_map(|triangles| LEVELS.map(|level| Case { triangles, level }))
}

/// Returns settings whose grain suits films of so many triangles over a square metre.
fn settings(triangles: u32) -> CoatingSettings {
    let mut settings = CoatingSettings::default();
    // A near-equilateral triangle of edge e has the area 0.433 e^2.
    settings.scale.grain = (1.0 / (0.433 * triangles as f32)).sqrt() / SHARE;
    settings
}

fn fresh(film: &BuiltFilm, settings: &CoatingSettings) -> FilmState {
    FilmState::new(film, settings, 1, 1000).expect("a manifold")
}

fn shown(piece: &TestPiece, built: &BuiltFilm, film: &FilmState, level: u32) -> FilmAppearance {
    let FilmState { mesh, forces, stains, .. } = film;
    let detail = Detail { level, ..Detail::default() };
    FilmAppearance::with_detail(built, &piece.surface, mesh, forces, stains, detail).expect("a clean plate")
}

#[divan::bench(args = cases(), sample_count = 5, sample_size = 1)]
fn build(bencher: Bencher, case: &Case) {
    let (piece, settings) = (common::plate(case.triangles), settings(case.triangles));
    bencher.bench_local(|| {
        let built = build_film(&piece.surface, FilmTarget::Triangles(case.triangles), 1).expect("a film");
        let film = fresh(&built, &settings);
        shown(&piece, &built, &film, case.level)
    });
}

#[divan::bench(args = SIZES, sample_count = 3, sample_size = 1)]
fn life(bencher: Bencher, triangles: u32) {
    let (piece, settings) = (common::plate(triangles), settings(triangles));
    let bencher = bencher.counter(ItemsCount::new(1000_usize));
    bencher.with_inputs(|| fresh(&piece.film, &settings)).bench_local_values(|mut film| {
        film.age_to(1.0, &settings, &Environment::default());
        film
    });
}

#[divan::bench(args = cases(), sample_count = 10, sample_size = 1)]
fn show(bencher: Bencher, case: &Case) {
    let (piece, settings) = (common::plate(case.triangles), settings(case.triangles));
    let environment = Environment::default();
    let mut film = fresh(&piece.film, &settings);
    film.age_to(AGE, &settings, &environment);
    let begun = shown(&piece, &piece.film, &film, case.level);
    common::follow(bencher, film, begun, &settings, STEPS, STEPS);
}
