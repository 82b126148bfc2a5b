//! The cost of questions to a film that has aged: what lies nearest, along a ray and in a sphere, and its shares.
//!
//! The plate has cracked and curled, and part of it is gone (age 1, preset `heavy`). `nearest` asks from 3 cm above it,
//! `nearest_far` from 3 m away. `along_ray` looks down on it, `along_ray_beside` past it. `in_sphere` is a hand of 10
//! cm radius, `in_sphere_all` holds the whole plate. `shares` counts everything, `survey` brings the counts up to date
//! after stains have changed, and `survey_same` finds that nothing has. An item is a question.
//!
//! Run with `cargo bench --profile dev --bench ask`.

mod common;

use std::sync::OnceLock;

use bevy_coating::{
    settings::{CoatingSettings, Preset},
    sim::FilmState,
    stain::Environment,
    survey::FilmSurvey,
};
use bevy_math::Vec3;
use divan::{Bencher, black_box};

const SIZES: [u32; 3] = [3_000, 10_000, 100_000];
/// Steps per age of the film that is asked.
const STEPS: u32 = 100;

fn main() {
    divan::main();
}

/// Returns the film of so many triangles. It is aged once: that takes half a minute for the largest.
fn old(triangles: u32) -> &'static FilmState {
    static FILMS: [OnceLock<FilmState>; SIZES.len()] = [const { OnceLock::new() }; SIZES.len()];
    let index = SIZES.iter().position(|&size| size == triangles).expect("one of the sizes");
    FILMS[index].get_or_init(|| {
        let settings = CoatingSettings::from(Preset::Heavy);
        let piece = common::plate(triangles);
        let mut film = FilmState::new(&piece.film, &settings, 1, STEPS).expect("a manifold");
        film.age_to(1.0, &settings, &Environment::default());
        film
    })
}

#[divan::bench(args = SIZES)]
fn nearest(bencher: Bencher, triangles: u32) {
    let film = old(triangles);
    bencher.bench_local(|| film.view().nearest(black_box(Vec3::new(0.11, -0.07, 0.03)), f32::INFINITY));
}

#[divan::bench(args = SIZES)]
fn nearest_far(bencher: Bencher, triangles: u32) {
    let film = old(triangles);
    bencher.bench_local(|| film.view().nearest(black_box(Vec3::new(3.0, 0.1, 0.2)), f32::INFINITY));
}

#[divan::bench(args = SIZES)]
fn along_ray(bencher: Bencher, triangles: u32) {
    let film = old(triangles);
    let (eye, down) = (Vec3::new(0.4, -0.3, 1.0), Vec3::new(-0.3, 0.2, -1.0));
    bencher.bench_local(|| film.view().along_ray(black_box(eye), black_box(down), 9.0));
}

#[divan::bench(args = SIZES)]
fn along_ray_beside(bencher: Bencher, triangles: u32) {
    let film = old(triangles);
    bencher.bench_local(|| film.view().along_ray(black_box(Vec3::new(3.0, 0.0, 1.0)), Vec3::NEG_Z, 9.0));
}

#[divan::bench(args = SIZES)]
fn in_sphere(bencher: Bencher, triangles: u32) {
    let film = old(triangles);
    bencher.bench_local(|| film.view().in_sphere(black_box(Vec3::new(0.1, 0.1, 0.0)), 0.1));
}

#[divan::bench(args = SIZES)]
fn in_sphere_all(bencher: Bencher, triangles: u32) {
    let film = old(triangles);
    bencher.bench_local(|| film.view().in_sphere(black_box(Vec3::ZERO), 9.0));
}

#[divan::bench(args = SIZES)]
fn shares(bencher: Bencher, triangles: u32) {
    let film = old(triangles);
    bencher.bench_local(|| black_box(film).shares());
}

#[divan::bench(args = SIZES)]
fn survey(bencher: Bencher, triangles: u32) {
    let mut film = old(triangles).clone();
    let mut survey = FilmSurvey::default();
    bencher.bench_local(|| {
        film.stains.revision = film.stains.revision.wrapping_add(1);
        survey.update(black_box(&film).view())
    });
}

#[divan::bench(args = SIZES)]
fn survey_same(bencher: Bencher, triangles: u32) {
    let film = old(triangles);
    let mut survey = FilmSurvey::default();
    bencher.bench_local(|| survey.update(black_box(film).view()));
}
