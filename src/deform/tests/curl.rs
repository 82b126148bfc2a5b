//! Tests curls by the grain: at free edges, to one curvature on every film.

use bevy_math::{Vec3, ops};

use super::disk;
use crate::{
    deform::{
        BendScratch, FilmConstraints, SolvePace, SolverQuality, bend_film, follow_free_edges, update_constraints,
    },
    film::{FilmChanges, FilmMesh, LoosePieces, VertexId},
    settings::{CoatingSettings, Rules},
};

const GRAIN: f32 = 0.1;

fn by_grain() -> CoatingSettings {
    let mut settings = CoatingSettings::default();
    settings.scale.rules = Rules::Grain;
    settings.scale.grain = GRAIN;
    settings
}

/// A strip of the length 1 along x and the width 0.1, of regular triangles with the edge `h`.
fn strip(h: f32) -> FilmMesh {
    let (columns, rows) = ((1.0 / h) as u32, (0.1 / (h * 0.866)).round().max(1.0) as u32);
    let width = columns + 1;
    let place = |i: u32| {
        let (x, y) = (i % width, i / width);
        Vec3::new((x as f32 + 0.5 * (y % 2) as f32) * h, y as f32 * h * 0.866, 0.0)
    };
    let positions = (0..width * (rows + 1)).map(place).collect();
    let mut triangles = Vec::new();
    for i in (0..rows).flat_map(|y| (0..columns).map(move |x| y * width + x)) {
        let (a, b, c, d) = (i, i + 1, i + width, i + width + 1);
        let pair = if (i / width) % 2 == 0 { [[a, b, c], [b, d, c]] } else { [[a, d, c], [a, b, d]] };
        triangles.extend(pair);
    }
    FilmMesh::new(positions, &triangles).unwrap()
}

/// Bends a strip that is held at its left end for as long as it takes. Returns the mean height of its right end.
fn height_of_end(h: f32, settings: &CoatingSettings) -> f32 {
    let mut mesh = strip(h);
    let mut constraints = FilmConstraints::new(&mesh);
    let mut changes = FilmChanges::default();
    let rest = mesh.geometry.rest_positions.clone();
    changes.separated.extend(mesh.topology.all_vertices().filter(|v| rest[v.index()].x > 1.6 * h));
    update_constraints(&mesh, &mut constraints, &changes);
    follow_free_edges(&mesh, &mut constraints, settings, &changes);
    let (loose, mut scratch) = (LoosePieces::default(), BendScratch::default());
    for _ in 0..100 {
        let mut changes = FilmChanges::default();
        let pace = SolvePace { dt: 0.02, sweeps: 600, momentum: 0.997, tick: false, quality: SolverQuality::Default };
        bend_film(&mut mesh, &mut constraints, &loose, &settings.deform, pace, &mut changes, &mut scratch);
    }
    mesh.validate().unwrap();
    let longest = rest.iter().map(|p| p.x).fold(0.0, f32::max);
    let ends: Vec<_> = mesh.topology.all_vertices().filter(|v| rest[v.index()].x > longest - h).collect();
    ends.iter().map(|&v| mesh.geometry.height(v)).sum::<f32>() / ends.len() as f32
}

#[test]
fn a_strip_bends_to_the_same_cylinder_on_every_film() {
    let mut settings = by_grain();
    settings.scale.grain = 0.5;
    settings.deform.curl_reach = 1000.0;
    let curvature = settings.deform.bend_limit / (0.577_35 * settings.scale.grain);
    // The curl begins in the middle of the column of triangles between what is held and what is free.
    let exact = |h: f32| (1.0 - ops::cos(curvature * (1.0 - h))) / curvature;
    for h in [0.05f32, 0.04] {
        let found = height_of_end(h, &settings);
        assert!((found / exact(h) - 1.0).abs() < 0.02, "h {h}: {found}, not {}", exact(h));
    }
}

#[test]
fn film_that_is_held_all_around_lies_flat_and_that_at_a_crack_curls() {
    let mut settings = by_grain();
    settings.scale.grain = 1.0 / 12.0;
    for torn in [false, true] {
        let mut mesh = disk(12);
        let mut constraints = FilmConstraints::new(&mesh);
        let mut changes = FilmChanges::default();
        let held = |v: VertexId| mesh.topology.is_border(v);
        changes.separated.extend(mesh.topology.all_vertices().filter(|&v| !held(v)));
        update_constraints(&mesh, &mut constraints, &changes);
        follow_free_edges(&mesh, &mut constraints, &settings, &changes);
        if torn {
            let mut changes = FilmChanges::default();
            for h in mesh.topology.all_edges().collect::<Vec<_>>() {
                let at = |v: VertexId| mesh.geometry.rest_positions[v.index()];
                let ends = [at(mesh.topology.origin(h)), at(mesh.topology.target(h))];
                if ends.iter().all(|p| p.y.abs() < 1e-4 && p.x.abs() < 0.6) {
                    super::tear(&mut mesh, h, &mut changes);
                }
            }
            assert!(changes.torn.len() > 10);
            update_constraints(&mesh, &mut constraints, &changes);
            follow_free_edges(&mesh, &mut constraints, &settings, &changes);
        }
        let mut scratch = BendScratch::default();
        for step in 1..=1000 {
            let mut changes = FilmChanges::default();
            let pace = SolvePace::of_grain_step(10_000.0, 1.0, SolverQuality::Default, (step, 1000), step % 10 == 0);
            let loose = LoosePieces::default();
            bend_film(&mut mesh, &mut constraints, &loose, &settings.deform, pace, &mut changes, &mut scratch);
        }
        let highest = mesh.topology.all_vertices().map(|v| mesh.geometry.height(v)).fold(0.0, f32::max);
        assert_eq!(highest > 0.02, torn, "{highest}");
        assert!(torn || constraints.awake_count() == 0, "film that lies flat sleeps");
    }
}
