use std::collections::BTreeSet;

use super::*;
use crate::surface::{clean, twins};

type Generator = fn(u32, u64) -> Result<TestPiece, BuildError>;

const ALL: [(&str, Generator); 3] = [("plate", plate), ("curved plate", curved_plate), ("disk", disk)];

fn edges(film: &BuiltFilm) -> BTreeSet<(u32, u32)> {
    let sides = |&[a, b, c]: &[u32; 3]| [(a, b), (b, c), (c, a)].map(|(a, b)| (a.min(b), a.max(b)));
    film.triangles.iter().flat_map(sides).collect()
}

fn corners(film: &BuiltFilm) -> impl Iterator<Item = [Vec3; 3]> + '_ {
    film.triangles.iter().map(|t| t.map(|v| film.positions[v as usize]))
}

fn area(film: &BuiltFilm) -> f64 {
    corners(film).map(|[a, b, c]| f64::from((b - a).cross(c - a).length()) / 2.0).sum()
}

/// In degrees.
fn min_angle(film: &BuiltFilm) -> f32 {
    let angles = |p: [Vec3; 3]| [0, 1, 2].map(|k| (p[(k + 1) % 3] - p[k]).angle_between(p[(k + 2) % 3] - p[k]));
    corners(film).flat_map(angles).fold(f32::INFINITY, f32::min).to_degrees()
}

/// Standard deviation of the edge lengths over their mean.
fn edge_variation(film: &BuiltFilm) -> f64 {
    let length = |&(a, b): &(u32, u32)| f64::from(film.positions[a as usize].distance(film.positions[b as usize]));
    let lengths: Vec<f64> = edges(film).iter().map(length).collect();
    let count = lengths.len() as f64;
    let mean = lengths.iter().sum::<f64>() / count;
    (lengths.iter().map(|l| (l - mean).powi(2)).sum::<f64>() / count).sqrt() / mean
}

#[test]
fn every_count_is_exact_and_every_piece_one_disk() {
    let counts = (2..200).chain([301, 512, 997]);
    for (count, (name, generate)) in counts.flat_map(|count| ALL.map(|piece| (count, piece))) {
        if name == "disk" && count < 6 {
            continue;
        }
        for seed in 0..3 {
            let film = generate(count, seed).unwrap().film;
            assert_eq!(film.triangles.len(), count as usize, "{name}:{count} seed {seed}");
            let euler = film.positions.len() as i64 - edges(&film).len() as i64 + i64::from(count);
            assert_eq!(euler, 1, "{name}:{count} seed {seed}");
            assert!(min_angle(&film) > 10.0, "{name}:{count} seed {seed}: {}", min_angle(&film));
        }
    }
}

#[test]
fn pieces_are_clean_already() {
    for (name, generate) in ALL {
        let TestPiece { surface, film } = generate(611, 4).unwrap();
        let clean = clean(&surface).unwrap();
        assert_eq!(clean.warnings, [], "{name}");
        assert_eq!((&clean.positions, &clean.triangles), (&film.positions, &film.triangles), "{name}");
        assert!(clean.sites.iter().flatten().eq(&film.sites), "{name}");
        assert_eq!([film.slots.len(), film.flipped.len(), 3 * film.triangles.len()], [611, 611, film.sites.len()]);
    }
}

#[test]
fn edges_are_even_and_angles_wide() {
    for (name, generate) in ALL {
        for (count, seed) in [(1000, 1), (3005, 2), (3012, 0), (3012, 3), (4047, 5)] {
            let film = generate(count, seed).unwrap().film;
            assert!(edge_variation(&film) < 0.16, "{name}:{count}: {}", edge_variation(&film));
            assert!(min_angle(&film) > 22.0, "{name}:{count}: {}", min_angle(&film));
        }
    }
}

/// In a hexagonal lattice the sum of the sixth powers of the edge directions is as long as the number of edges,
/// in a square one that of the fourth powers.
#[test]
fn no_direction_is_preferred() {
    for (count, seed) in [(3012, 1), (10_000, 2)] {
        let film = plate(count, seed).unwrap().film;
        let directions: Vec<Vec2> = edges(&film)
            .iter()
            .map(|&(a, b)| (film.positions[b as usize] - film.positions[a as usize]).truncate().normalize())
            .collect();
        for fold in [2, 4, 6] {
            let powers = directions.iter().map(|d| (1..fold).fold(*d, |power, _| power.rotate(*d)));
            let order = powers.sum::<Vec2>().length() / directions.len() as f32;
            assert!(order < 0.1, "{fold}-fold order {order} at {count}");
        }
        let mut faces_at = vec![0; film.positions.len()];
        film.triangles.iter().flatten().for_each(|v| faces_at[*v as usize] += 1);
        let six = faces_at.iter().filter(|faces| **faces == 6).count() as f64 / faces_at.len() as f64;
        assert!(six < 0.6, "{six} of the vertices are those of a lattice");
    }
}

#[test]
fn shapes_are_as_documented() {
    let film = plate(3012, 0).unwrap().film;
    assert!((area(&film) - 1.0).abs() < 1e-6);
    assert!(film.positions.iter().all(|p| p.z == 0.0 && p.abs().max_element() <= 0.5));
    assert!(corners(&film).all(|[a, b, c]| (b - a).cross(c - a).z > 0.0), "faces +z");

    let film = curved_plate(3005, 0).unwrap().film;
    assert!((area(&film) - 1.0).abs() < 1e-3);
    let radius = std::f32::consts::FRAC_2_PI;
    for p in &film.positions {
        assert!((p.with_y(0.0).length() - radius).abs() < 1e-6 && p.y.abs() <= 0.5);
        assert!(p.z >= radius * 0.707 && p.x.abs() <= radius * 0.7072);
    }
    let outward = |[a, b, c]: [Vec3; 3]| (b - a).cross(c - a).dot((a + b + c).with_y(0.0)) > 0.0;
    assert!(corners(&film).all(outward), "the convex side faces outward");

    let film = disk(4047, 0).unwrap().film;
    assert!((area(&film) - std::f64::consts::PI).abs() < 2e-3);
    assert!(film.positions.iter().all(|p| p.z == 0.0 && p.length() < 1.0 + 1e-6));
    let twin = twins(&film.triangles);
    for (h, _) in twin.iter().enumerate().filter(|(_, twin)| **twin == u32::MAX) {
        let rim = film.positions[film.triangles[h / 3][h % 3] as usize];
        assert!((rim.length() - 1.0).abs() < 1e-6, "the border is the rim");
    }
}

#[test]
fn textures_lie_upright_and_normals_point_out() {
    for (name, generate) in ALL {
        let TestPiece { surface, .. } = generate(500, 9).unwrap();
        for (t, triangle) in surface.triangles.iter().enumerate() {
            for (k, v) in triangle.iter().enumerate() {
                let (p, uv) = (surface.positions[*v as usize], surface.uvs[3 * t + k]);
                let normal = surface.normals[3 * t + k];
                let (expected, outward) = match name {
                    "plate" => (Vec2::new(0.5 + p.x, 0.5 - p.y), Vec3::Z),
                    "disk" => (Vec2::new(0.5 + 0.5 * p.x, 0.5 - 0.5 * p.y), Vec3::Z),
                    _ => {
                        let angle = bevy_math::ops::atan2(p.x, p.z) / std::f32::consts::FRAC_PI_2;
                        (Vec2::new(0.5 + angle, 0.5 - p.y), p.with_y(0.0).normalize())
                    }
                };
                assert!(uv.distance(expected) < 1e-5, "{name}: {uv} is not {expected}");
                assert!(normal.distance(outward) < 1e-5, "{name}: {normal} is not {outward}");
            }
        }
    }
}

#[test]
fn a_seed_is_one_piece() {
    for (name, generate) in ALL {
        let positions = |seed| generate(400, seed).unwrap().film.positions;
        assert_eq!(positions(3), positions(3), "{name}");
        assert_ne!(positions(3), positions(4), "{name}");
    }
}

#[test]
fn impossible_counts_are_refused() {
    for (count, generate) in [(0, plate as Generator), (1, curved_plate), (5, disk), (u32::MAX, plate)] {
        assert!(matches!(generate(count, 0), Err(BuildError::Resolution { .. })), "{count}");
    }
}
