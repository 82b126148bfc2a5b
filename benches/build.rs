//! The cost of coating a prop, before its first step.
//!
//! `remesh` and `keep` are the two ways from a surface to a film, on a torus of twice as many triangles as the film is
//! to have (`remesh`), or of as many (`keep`). `half_edges` makes the film mesh of the plate, `fresh_film` all that a
//! film needs to step, with that mesh among it. An item is a triangle of the film.
//!
//! All of it runs in the background, once a prop. Run with `cargo bench --profile dev --bench build`.

mod common;

use std::f32::consts::TAU;

use bevy_coating::{
    film::FilmMesh,
    remesh::{FilmTarget, build_film},
    settings::CoatingSettings,
    sim::FilmState,
    surface::Surface,
};
use bevy_math::{Vec3, ops};
use divan::{Bencher, counter::ItemsCount};

const SIZES: [u32; 3] = [3_000, 10_000, 100_000];

fn main() {
    divan::main();
}

/// Makes a torus of about so many triangles, with radii 1 and 0.4.
fn torus(triangles: u32) -> Surface {
    let across = (triangles as f32 / 5.0).sqrt().round() as u32;
    let along = (triangles as f32 / (2 * across) as f32).round() as u32;
    let point = |i: u32, j: u32| {
        let (sin_a, cos_a) = ops::sin_cos(TAU * i as f32 / along as f32);
        let (sin_b, cos_b) = ops::sin_cos(TAU * j as f32 / across as f32);
        let radius = 1.0 + 0.4 * cos_b;
        Vec3::new(radius * cos_a, 0.4 * sin_b, -radius * sin_a)
    };
    let cells = || (0..along).flat_map(move |i| (0..across).map(move |j| (i, j)));
    let index = |i: u32, j: u32| (i % along) * across + j % across;
    Surface {
        positions: cells().map(|(i, j)| point(i, j)).collect(),
        triangles: cells()
            .flat_map(|(i, j)| {
                let [a, b, c, d] = [index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1)];
                [[a, b, c], [a, c, d]]
            })
            .collect(),
        ..Surface::default()
    }
}

fn build_of(bencher: Bencher, surface: &Surface, target: FilmTarget, triangles: u32) {
    let make = || build_film(surface, target, 1).expect("a film");
    bencher.counter(ItemsCount::new(triangles)).bench_local(make);
}

#[divan::bench(args = SIZES, sample_count = 5, sample_size = 1)]
fn remesh(bencher: Bencher, triangles: u32) {
    build_of(bencher, &torus(2 * triangles), FilmTarget::Triangles(triangles), triangles);
}

#[divan::bench(args = SIZES, sample_count = 20, sample_size = 1)]
fn keep(bencher: Bencher, triangles: u32) {
    build_of(bencher, &torus(triangles), FilmTarget::Keep, triangles);
}

#[divan::bench(args = SIZES, sample_count = 20, sample_size = 1)]
fn half_edges(bencher: Bencher, triangles: u32) {
    let piece = common::plate(triangles);
    let film = &piece.film;
    bencher
        .counter(ItemsCount::new(triangles))
        .with_inputs(|| film.positions.clone())
        .bench_local_values(|positions| FilmMesh::new(positions, &film.triangles));
}

#[divan::bench(args = SIZES, sample_count = 20, sample_size = 1)]
fn fresh_film(bencher: Bencher, triangles: u32) {
    let (piece, settings) = (common::plate(triangles), CoatingSettings::default());
    bencher.counter(ItemsCount::new(triangles)).bench_local(|| FilmState::new(&piece.film, &settings, 1, 1000));
}
