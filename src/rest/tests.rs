//! Counts and times the pieces of what is done in the background: `docs/browser.md` has the table.

use std::{f32::consts::TAU, time::Instant};

use bevy_math::{Vec2, Vec3, Vec4, ops};

use super::*;
use crate::{
    appearance::{Detail, FilmAppearance},
    remesh::{FilmTarget, build_film_in_pieces},
    settings::CoatingSettings,
    sim::FilmState,
    stain::exposure::ExposedSurface,
    surface::{Surface, clean_in_pieces},
};

/// Names of the stages, in the order in which [`build`] does them.
const STAGES: [&str; 7] = [
    "cleaning the prop's mesh (by its triangles, not the film's)",
    "remeshing, with cleaning and features",
    "the state of the film",
    "what is shown at level 0",
    "what is shown at level 1",
    "what is shown at level 2",
    "rays for rain and sun, where there is any",
];

/// Notes how long each piece of each stage takes, in milliseconds.
struct Watch {
    began: Instant,
    pieces: Vec<Vec<f64>>,
}

impl Watch {
    fn new() -> Self {
        Self { began: Instant::now(), pieces: vec![Vec::new()] }
    }

    fn note(&mut self) {
        let taken = self.began.elapsed().as_secs_f64() * 1e3;
        self.pieces.last_mut().expect("a stage").push(taken);
        self.began = Instant::now();
    }

    /// Ends a stage, and begins the next one.
    fn next(&mut self) {
        self.note();
        self.pieces.push(Vec::new());
        self.began = Instant::now();
    }
}

impl Rest for Watch {
    async fn rest(&mut self) {
        self.note();
    }
}

/// Makes a torus of 2 times `along` times `across` triangles with texture seams along both circles, and with normals
/// and tangents, as a model file has them.
fn torus(along: u32, across: u32) -> Surface {
    let mut surface = Surface::default();
    let circle = |i: u32, n: u32| ops::sin_cos(TAU * (i % n) as f32 / n as f32);
    let (mut normals, mut tangents) = (Vec::new(), Vec::new());
    for i in 0..=along {
        for j in 0..=across {
            let ((s, c), (t, d)) = (circle(i, along), circle(j, across));
            let out = Vec3::new(c, s, 0.0);
            surface.positions.push(out * (1.0 + 0.4 * d) + Vec3::Z * 0.4 * t);
            normals.push(out * d + Vec3::Z * t);
            tangents.push(Vec4::new(-s, c, 0.0, 1.0));
        }
    }
    let mut uvs = Vec::new();
    for i in 0..along {
        for j in 0..across {
            let corner = |(di, dj): (u32, u32)| (i + di, j + dj);
            for t in [[(0, 0), (1, 0), (1, 1)], [(0, 0), (1, 1), (0, 1)]] {
                let corners = t.map(corner);
                let triangle = corners.map(|(i, j)| i * (across + 1) + j);
                surface.triangles.push(triangle);
                uvs.extend(corners.map(|(i, j)| Vec2::new(i as f32 / along as f32, j as f32 / across as f32)));
            }
        }
    }
    let of = |v: &u32| *v as usize;
    surface.normals = surface.triangles.iter().flatten().map(|v| normals[of(v)]).collect();
    surface.tangents = surface.triangles.iter().flatten().map(|v| tangents[of(v)]).collect();
    surface.uvs = uvs;
    surface
}

/// Does what is done in the background for a prop, stage by stage.
fn build(surface: &Surface, triangles: u32, watch: &mut Watch) {
    let settings = CoatingSettings::default();
    at_once(clean_in_pieces(surface, watch)).expect("a clean surface");
    watch.next();
    let built = at_once(build_film_in_pieces(surface, FilmTarget::Triangles(triangles), 7, watch)).expect("a film");
    watch.next();
    let film = at_once(FilmState::new_in_pieces(&built, &settings, 7, 1000, watch)).expect("a manifold");
    for level in 0..3 {
        watch.next();
        let detail = Detail { level, ..Detail::default() };
        let FilmState { mesh, forces, stains, .. } = &film;
        at_once(FilmAppearance::in_pieces(&built, surface, mesh, forces, stains, detail, watch)).expect("a film");
    }
    watch.next();
    let exposed = at_once(ExposedSurface::new_in_pieces(&film.mesh, watch));
    at_once(exposed.cast_in_pieces(&[], Vec3::NEG_Y, Vec3::new(1.0, -1.0, 0.3), watch));
    watch.note();
}

/// Prints the table of `docs/browser.md`: `cargo core --lib pieces_of_background_work -- --ignored --nocapture`.
#[test]
#[ignore = "a measurement, which takes some seconds"]
fn pieces_of_background_work() {
    let prop = torus(200, 160);
    for triangles in [4_000, 16_000] {
        let mut least: Vec<Vec<f64>> = Vec::new();
        // The pieces are the same each time: the least of each is what it takes without disturbance.
        for _ in 0..5 {
            let mut watch = Watch::new();
            build(&prop, triangles, &mut watch);
            if least.is_empty() {
                least = watch.pieces;
            } else {
                let both = least.iter_mut().flatten().zip(watch.pieces.iter().flatten());
                both.for_each(|(least, &new)| *least = least.min(new));
            }
        }
        println!(
            "{} triangles, film of {triangles}: pieces, all, median, 90 of 100, longest in ms",
            prop.triangles.len()
        );
        for (name, mut pieces) in STAGES.iter().zip(least) {
            let all: f64 = pieces.iter().sum();
            pieces.sort_by(f64::total_cmp);
            let at = |share: usize| pieces[(pieces.len() - 1) * share / 100];
            let (count, median, most, longest) = (pieces.len(), at(50), at(90), at(100));
            println!("| {name} | {count} | {all:.1} | {median:.2} | {most:.2} | {longest:.2} |");
        }
    }
}
