//! Counts and times the pieces of what is done in the background: `docs/browser.md` has the table.

use std::{f32::consts::TAU, time::Instant};

use bevy_math::{Vec2, Vec3, Vec4, ops};

use super::*;
use crate::{
    appearance::{Detail, DisplayChanges, FilmAppearance},
    remesh::{FilmTarget, build_film_in_pieces},
    settings::CoatingSettings,
    sim::FilmState,
    stain::exposure::{ExposedSurface, TriangleTree},
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
    let mut rows = STAGES.map(|name| format!("| {name} |"));
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
        for (row, pieces) in rows.iter_mut().zip(least) {
            let (all, longest) = (pieces.iter().sum::<f64>(), pieces.iter().copied().fold(0.0, f64::max));
            *row += &format!(" {} | {all:.0} | {longest:.1} |", pieces.len());
        }
    }
    println!("{}", rows.join("\n"));
}

/// No stage goes on for long without a rest.
#[test]
fn every_stage_of_a_build_rests() {
    let prop = torus(64, 48);
    let mut watch = Watch::new();
    build(&prop, 2_000, &mut watch);
    // Of 6,144 triangles of the prop, 2,000 of the film and 32,000 that show it, at a few thousand entries a piece.
    let least = [60, 500, 8, 6, 100, 150, 60];
    for ((name, pieces), least) in STAGES.iter().zip(&watch.pieces).zip(least) {
        assert!(pieces.len() >= least, "{name}: {} pieces", pieces.len());
    }
}

/// Four times as many triangles have about four times as many pieces, not longer ones.
#[test]
fn cleaning_rests_more_often_for_a_larger_prop() {
    let rests = |prop: &Surface| {
        let mut watch = Watch::new();
        at_once(clean_in_pieces(prop, &mut watch)).expect("a clean surface");
        watch.pieces[0].len() as f32
    };
    let (small, large) = (rests(&torus(128, 64)), rests(&torus(256, 128)));
    assert!(large > 2.0 * small, "{small} and {large} for four times the triangles");
}

#[test]
fn a_list_sorted_in_pieces_is_sorted() {
    let mut number = 1_u32;
    let mut next = move || {
        number = number.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        number
    };
    for (count, most) in [(0, 1), (1, 1), (20_000, 5), (20_000, 3_000), (20_000, u32::MAX)] {
        let items: Vec<(u32, u32)> = (0..count).map(|_| (next() % most, next())).collect();
        let mut expected = items.clone();
        expected.sort_unstable();
        let mut watch = Watch::new();
        let sorted = at_once(sort_by_number(items, |item| item.0, &mut watch));
        assert!(sorted == expected, "{count} entries below {most}");
        assert_eq!(watch.pieces[0].is_empty(), count == 0, "it rests");
        // Pieces of whole runs cover the list.
        let (mut from, mut pieces) = (0, 0);
        while from < sorted.len() {
            let end = end_of_runs(&sorted, from, |a, b| a.0 == b.0);
            assert!(end == sorted.len() || sorted[end - 1].0 != sorted[end].0);
            (from, pieces) = (end, pieces + 1);
        }
        assert!(pieces <= sorted.len().div_ceil(LIGHT_PIECE));
    }
}

/// The engine runs such work on any of its threads.
#[test]
fn work_in_pieces_may_change_threads() {
    fn assert_send(_: impl Send) {}
    let (prop, settings) = (torus(8, 6), CoatingSettings::default());
    let built = crate::remesh::build_film(&prop, FilmTarget::Triangles(100), 7).expect("a film");
    let film = FilmState::new(&built, &settings, 7, 1000).expect("a manifold");
    let FilmState { mesh, forces, stains, .. } = &film;
    let mut watch = Watch::new();
    assert_send(clean_in_pieces(&prop, &mut watch));
    assert_send(build_film_in_pieces(&prop, FilmTarget::Triangles(100), 7, &mut watch));
    assert_send(FilmState::new_in_pieces(&built, &settings, 7, 1000, &mut watch));
    let detail = Detail { level: 1, ..Detail::default() };
    assert_send(FilmAppearance::in_pieces(&built, &prop, mesh, forces, stains, detail, &mut watch));
    let mut shown = FilmAppearance::with_detail(&built, &prop, mesh, forces, stains, detail).expect("a film");
    let levels = shown.levels();
    assert_send(levels.appearance_in_pieces(1, mesh, forces, stains, &mut watch));
    assert_send(shown.update_in_pieces(mesh, forces, stains, DisplayChanges::everything(), &mut watch));
    let exposed = ExposedSurface::new(mesh);
    assert_send(ExposedSurface::new_in_pieces(mesh, &mut watch));
    assert_send(exposed.cast_in_pieces(&[], Vec3::NEG_Y, Vec3::ZERO, &mut watch));
    assert_send(TriangleTree::new_in_pieces([[Vec3::ZERO, Vec3::X, Vec3::Y]], &mut watch));
}
