//! Properties that every remeshed film must have, on shapes made here.

mod fine;
mod thin;

use std::collections::{BTreeMap, BTreeSet};

use bevy_math::{Vec2, Vec3, Vec4, ops};
use proptest::prelude::*;

use super::topology::Topology;
use super::{BuiltFilm, FilmTarget, build_film, build_film_in_pieces};
use crate::{
    film::{FaceId, VertexId},
    rest::{NoRest, Rest, at_once},
    surface::{BuildError, BuildWarning, Surface, clean},
};

/// Properties that remeshing must not change.
#[derive(Debug, PartialEq, Eq)]
struct Shape {
    euler: i64,
    border_loops: usize,
}

fn shape_of(triangles: &[[u32; 3]], vertices: usize) -> Shape {
    let topology = at_once(Topology::new(triangles, vertices, &mut NoRest));
    topology.check();
    let edges = topology.edges().count();
    let mut following = BTreeMap::new();
    for h in topology.edges().filter(|&h| topology.twin(h).is_none()) {
        assert_eq!(following.insert(topology.origin(h), topology.target(h)), None, "two borders leave one vertex");
    }
    let mut border_loops = 0;
    while let Some((&start, _)) = following.first_key_value() {
        border_loops += 1;
        let mut at = start;
        while let Some(next) = following.remove(&at) {
            at = next;
        }
        assert_eq!(at, start, "an open border");
    }
    let used: BTreeSet<u32> = triangles.iter().flatten().copied().collect();
    assert_eq!(used.len(), vertices, "unused vertices");
    Shape { euler: used.len() as i64 - edges as i64 + triangles.len() as i64, border_loops }
}

fn area(positions: &[Vec3], triangles: &[[u32; 3]]) -> f32 {
    triangles
        .iter()
        .map(|t| {
            let [a, b, c] = t.map(|v| positions[v as usize]);
            0.5 * (b - a).cross(c - a).length()
        })
        .sum()
}

/// The value of a corner attribute at a film corner.
fn at_corner<T: Copy + std::ops::Mul<f32, Output = T> + std::ops::Add<Output = T>>(
    film: &BuiltFilm,
    corner: usize,
    values: impl Fn(usize) -> T,
) -> T {
    let site = film.sites[corner];
    let t = 3 * site.triangle as usize;
    values(t) * site.weights.x + values(t + 1) * site.weights.y + values(t + 2) * site.weights.z
}

/// Builds and checks what must hold for any surface and target.
fn checked(surface: &Surface, target: FilmTarget, seed: u64) -> BuiltFilm {
    let film = build_film(surface, target, seed).expect("a film");
    let cleaned = clean(surface).expect("a clean surface");
    let faces = film.triangles.len();
    assert_eq!((film.slots.len(), film.flipped.len(), film.sites.len()), (faces, faces, 3 * faces));
    assert_eq!(
        shape_of(&film.triangles, film.positions.len()),
        shape_of(&cleaned.triangles, cleaned.positions.len()),
        "topology changed"
    );
    let scale = area(&film.positions, &film.triangles).sqrt();
    // Weights are rounded, which matters on long thin triangles.
    let size = film.positions.iter().fold(0.0_f32, |size, p| size.max(p.distance(film.positions[0])));
    let tolerance = (1e-4 * scale).max(1e-5 * size);
    for (corner, site) in film.sites.iter().enumerate() {
        let face = corner / 3;
        assert!((site.weights.element_sum() - 1.0).abs() < 1e-4 && site.weights.min_element() > -1e-4);
        let slot = surface.slots.get(site.triangle as usize).copied().unwrap_or_default();
        assert_eq!(slot, film.slots[face], "a face lies in two slots");
        let corner_of = |i: usize| surface.positions[surface.triangles[i / 3][i % 3] as usize];
        let here = film.positions[film.triangles[face][corner % 3] as usize];
        let there = at_corner(&film, corner, corner_of);
        assert!(here.distance(there) < tolerance, "site {corner} is {} off", here.distance(there) / scale);
    }
    film
}

/// Adds the corners of a quad grid over `at`, with texture coordinates from `uv`.
fn grid(surface: &mut Surface, n: [usize; 2], at: impl Fn(Vec2) -> Vec3, uv: impl Fn(Vec2) -> Vec2) {
    let base = surface.positions.len() as u32;
    let parameter = |i: usize, j: usize| Vec2::new(i as f32 / n[0] as f32, j as f32 / n[1] as f32);
    for j in 0..=n[1] {
        surface.positions.extend((0..=n[0]).map(|i| at(parameter(i, j))));
    }
    for j in 0..n[1] {
        for i in 0..n[0] {
            for corners in [[(i, j), (i + 1, j), (i + 1, j + 1)], [(i, j), (i + 1, j + 1), (i, j + 1)]] {
                surface.triangles.push(corners.map(|(i, j)| base + (j * (n[0] + 1) + i) as u32));
                surface.uvs.extend(corners.map(|(i, j)| uv(parameter(i, j))));
            }
        }
    }
}

fn on_sphere(p: Vec2) -> Vec3 {
    let (longitude, latitude) = (std::f32::consts::TAU * p.x, std::f32::consts::PI * (p.y - 0.5));
    let (sin, cos) = ops::sin_cos(longitude);
    Vec3::new(cos * ops::cos(latitude), sin * ops::cos(latitude), ops::sin(latitude))
}

/// A sphere with a seam in its texture and smooth normals.
fn sphere(n: usize) -> Surface {
    let mut surface = Surface::default();
    grid(&mut surface, [2 * n, n], on_sphere, |p| p);
    surface.normals = surface.triangles.iter().flatten().map(|&v| surface.positions[v as usize]).collect();
    surface
}

/// An open wavy sheet without attributes.
fn sheet(n: usize, height: f32) -> Surface {
    let mut surface = Surface::default();
    grid(&mut surface, [n, n], |p| Vec3::new(p.x, p.y, height * ops::sin(9.0 * p.x) * ops::cos(7.0 * p.y)), |p| p);
    surface.uvs.clear();
    surface
}

/// A box with bevelled edges along x, textured face by face, in two slots.
fn bevelled_box(size: Vec3, bevel: f32, n: usize) -> Surface {
    let mut surface = Surface::default();
    let (y, z) = (size.y - bevel, size.z - bevel);
    let ring = [
        [y, -size.z],
        [size.y, -z],
        [size.y, z],
        [y, size.z],
        [-y, size.z],
        [-size.y, z],
        [-size.y, -z],
        [-y, -size.z],
    ];
    for k in 0..8 {
        let (a, b) = (ring[k], ring[(k + 1) % 8]);
        let at = |p: Vec2| {
            let [y, z] = [0, 1].map(|i| a[i] + (b[i] - a[i]) * p.y);
            Vec3::new(size.x * (1.0 - 2.0 * p.x), y, z)
        };
        grid(&mut surface, [n, 1], at, |p| Vec2::new(p.x, p.y + 2.0 * k as f32));
    }
    for side in [-1.0_f32, 1.0] {
        let base = surface.positions.len() as u32;
        surface.positions.extend(ring.map(|[y, z]| Vec3::new(side * size.x, y, z)));
        for k in 1..7 {
            let t = if side > 0.0 { [0, k, k + 1] } else { [0, k + 1, k] };
            surface.triangles.push(t.map(|v| base + v));
            surface.uvs.extend(t.map(|v| Vec2::from(ring[v as usize]) + 40.0 * side));
        }
    }
    surface.slots = (0..surface.triangles.len()).map(|t| u32::from(t >= 16 * n)).collect();
    surface
}

fn append(surface: &mut Surface, other: &Surface, offset: Vec3) {
    let base = surface.positions.len() as u32;
    surface.positions.extend(other.positions.iter().map(|&p| p + offset));
    surface.triangles.extend(other.triangles.iter().map(|t| t.map(|v| v + base)));
}

#[test]
fn sphere_is_closed_even_and_round() {
    // Without texture: its coordinates jump at every spoke of the poles, which the film would have to follow.
    let surface = Surface { uvs: Vec::new(), ..sphere(60) };
    let film = checked(&surface, FilmTarget::Triangles(1500), 3);
    assert!((1425..=1575).contains(&film.triangles.len()), "{} triangles", film.triangles.len());
    assert_eq!(film.warnings.iter().filter(|w| matches!(w, BuildWarning::FeaturesDenserThanTarget { .. })).count(), 0);
    let mut lengths = Vec::new();
    for t in &film.triangles {
        let [a, b, c] = t.map(|v| film.positions[v as usize]);
        let normal = (b - a).cross(c - a);
        assert!(normal.dot(a + b + c) > 0.0, "a face points inward");
        assert!((a + b + c).length() / 3.0 > 0.97, "a face cuts through the sphere");
        lengths.extend([a.distance(b), b.distance(c), c.distance(a)]);
    }
    let mean = lengths.iter().sum::<f32>() / lengths.len() as f32;
    let variance = lengths.iter().map(|l| (l - mean) * (l - mean)).sum::<f32>() / lengths.len() as f32;
    assert!(variance.sqrt() < 0.25 * mean, "edge lengths vary by {}", variance.sqrt() / mean);
}

/// On both sides of a texture seam that lies within one patch each face must take its own side's coordinates.
#[test]
fn faces_at_a_seam_stay_on_their_side() {
    for n in [6, 40] {
        let surface = sphere(n);
        let film = checked(&surface, FilmTarget::Triangles(2000), 1);
        for face in 0..film.triangles.len() {
            let u = [0, 1, 2].map(|k| at_corner(&film, 3 * face + k, |i| surface.uvs[i]).x);
            let poles = film.triangles[face].iter().any(|&v| film.positions[v as usize].z.abs() > 0.9);
            let width = u.into_iter().fold(f32::MIN, f32::max) - u.into_iter().fold(f32::MAX, f32::min);
            assert!(poles || width < 0.25, "face {face} spans {u:?}");
        }
    }
}

/// The shown film of a low-poly prop interpolates its attributes exactly as the prop does.
#[test]
fn low_poly_faces_lie_on_single_facets() {
    let surface = bevelled_box(Vec3::new(2.0, 0.7, 0.5), 0.1, 3);
    let film = checked(&surface, FilmTarget::Triangles(3000), 7);
    assert!((2850..=3150).contains(&film.triangles.len()), "{} triangles", film.triangles.len());
    assert!((area(&film.positions, &film.triangles) / area(&surface.positions, &surface.triangles) - 1.0).abs() < 1e-4);
    for face in 0..film.triangles.len() {
        let [a, b, c] = film.triangles[face].map(|v| film.positions[v as usize]);
        let normal = (b - a).cross(c - a).normalize();
        // Each side of the box has its own range of v; the ends are far off.
        let side = |k: usize| (at_corner(&film, 3 * face + k, |i| surface.uvs[i]).y + 0.5).div_euclid(2.0);
        assert_eq!((side(0), side(0)), (side(1), side(2)), "face {face} lies on two sides");
        let t = surface.triangles[film.sites[3 * face].triangle as usize].map(|v| surface.positions[v as usize]);
        let facet = (t[1] - t[0]).cross(t[2] - t[0]).normalize();
        assert!(normal.dot(facet) > 0.999, "face {face} leaves its facet by {}", normal.dot(facet));
    }
}

/// Total length of the film's border and of its slot borders.
fn feature_lengths(positions: &[Vec3], triangles: &[[u32; 3]], slots: &[u32]) -> [f32; 2] {
    let topology = at_once(Topology::new(triangles, positions.len(), &mut NoRest));
    let slot = |f: FaceId| slots.get(f.index()).copied().unwrap_or_default();
    let mut lengths = [0.0; 2];
    for h in topology.edges() {
        let length = [topology.origin(h), topology.target(h)].map(|v: VertexId| positions[v.index()]);
        let kind = match topology.twin(h) {
            None => 0,
            Some(t) if slot(h.face()) != slot(t.face()) => 1,
            Some(_) => continue,
        };
        lengths[kind] += length[0].distance(length[1]);
    }
    lengths
}

#[test]
fn borders_and_slot_borders_keep_their_length() {
    let mut surface = sheet(50, 0.05);
    surface.slots = surface
        .triangles
        .iter()
        .map(|t| u32::from(t.iter().all(|&v| surface.positions[v as usize].x <= 0.5)))
        .collect();
    let film = checked(&surface, FilmTarget::Triangles(900), 2);
    let before = feature_lengths(&surface.positions, &surface.triangles, &surface.slots);
    let after = feature_lengths(&film.positions, &film.triangles, &film.slots);
    for (before, after) in before.into_iter().zip(after) {
        assert!(before > 0.9 && (after / before - 1.0).abs() < 0.01, "{before} became {after}");
    }
}

/// Cracks follow edges: on a flat quad no direction may prevail.
#[test]
fn flat_quads_show_no_grid() {
    let mut surface = Surface::default();
    grid(&mut surface, [1, 1], |p| p.extend(0.0), |p| p);
    let film = checked(&surface, FilmTarget::Triangles(2000), 5);
    let mut sum = Vec2::ZERO;
    for t in &film.triangles {
        for k in 0..3 {
            let edge = film.positions[t[(k + 1) % 3] as usize] - film.positions[t[k] as usize];
            sum += Vec2::from_angle(6.0 * ops::atan2(edge.y, edge.x));
        }
    }
    let order = sum.length() / (3 * film.triangles.len()) as f32;
    assert!(order < 0.12, "edges line up: six-fold order {order}");
}

#[test]
fn the_same_seed_gives_the_same_bits() {
    let surface = bevelled_box(Vec3::new(1.0, 0.7, 0.5), 0.1, 2);
    let build = |seed| build_film(&surface, FilmTarget::Triangles(1000), seed).expect("a film");
    let (a, b, other) = (build(4), build(4), build(5));
    let bits =
        |film: &BuiltFilm| film.positions.iter().flat_map(|p| p.to_array().map(f32::to_bits)).collect::<Vec<_>>();
    assert_eq!((bits(&a), &a.triangles, &a.sites), (bits(&b), &b.triangles, &b.sites));
    assert_ne!(bits(&a), bits(&other));
}

/// Counts the rests.
struct Counter(u32);

impl Rest for Counter {
    async fn rest(&mut self) {
        self.0 += 1;
    }
}

#[test]
fn a_film_that_is_built_in_pieces_is_the_same() {
    let surface = bevelled_box(Vec3::new(1.0, 0.7, 0.5), 0.1, 2);
    let (target, mut counter) = (FilmTarget::Triangles(1000), Counter(0));
    let whole = build_film(&surface, target, 4).expect("a film");
    let in_pieces = at_once(build_film_in_pieces(&surface, target, 4, &mut counter)).expect("a film");
    assert_eq!((in_pieces.positions, in_pieces.sites), (whole.positions, whole.sites));
    // Those of ten rounds at least: many enough for the frames of a browser.
    assert!(counter.0 > 50, "{}", counter.0);
}

#[test]
fn edge_length_is_met() {
    let film = checked(&sheet(30, 0.1), FilmTarget::EdgeLength(0.05), 1);
    let edges: Vec<f32> = film
        .triangles
        .iter()
        .flat_map(|t| {
            [0, 1, 2].map(|k| film.positions[t[k] as usize].distance(film.positions[t[(k + 1) % 3] as usize]))
        })
        .collect();
    let mean = edges.iter().sum::<f32>() / edges.len() as f32;
    assert!((mean / 0.05 - 1.0).abs() < 0.1, "mean edge {mean}");
}

#[test]
fn features_denser_than_the_target_are_kept_with_a_warning() {
    let surface = bevelled_box(Vec3::new(1.0, 0.7, 0.5), 0.1, 8);
    let film = checked(&surface, FilmTarget::Triangles(20), 1);
    let found = film.triangles.len() as u32;
    assert!(film.warnings.contains(&BuildWarning::FeaturesDenserThanTarget { target: 20, triangles: found }));
}

#[test]
fn keep_is_the_mesh_itself() {
    let surface = sphere(8);
    let film = checked(&surface, FilmTarget::Keep, 1);
    let cleaned = clean(&surface).expect("a clean surface");
    assert_eq!((film.positions, film.triangles), (cleaned.positions, cleaned.triangles));
}

#[test]
fn senseless_targets_are_refused() {
    let surface = sphere(8);
    let bad = [
        FilmTarget::Triangles(3),
        FilmTarget::EdgeLength(0.0),
        FilmTarget::EdgeLength(-1.0),
        FilmTarget::EdgeLength(f32::NAN),
        FilmTarget::EdgeLength(f32::INFINITY),
    ];
    for target in bad {
        assert!(matches!(build_film(&surface, target, 0), Err(BuildError::Resolution { .. })), "{target:?}");
    }
    let tiny = build_film(&surface, FilmTarget::EdgeLength(1e-9), 0);
    assert!(matches!(tiny, Err(BuildError::TooLarge { .. })), "{tiny:?}");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

    /// Whatever the shape and the numbers, the film is a manifold of the surface's topology, on the surface.
    #[test]
    fn any_shape_keeps_its_topology(
        kind in 0..5_usize,
        n in 2..14_usize,
        size in prop::array::uniform3(0.2..3.0_f32),
        faces in 4..2500_u32,
        seed: u64,
        colored: bool,
    ) {
        let mut surface = match kind {
            0 => sphere(n + 2),
            1 => sheet(n, 0.2 * size[0]),
            2 => bevelled_box(Vec3::from(size), 0.15 * Vec3::from(size).min_element(), n),
            3 => {
                let mut several = sheet(n, 0.1);
                append(&mut several, &sphere(n + 2), Vec3::splat(5.0));
                append(&mut several, &bevelled_box(Vec3::from(size), 0.02, 1), Vec3::splat(-9.0));
                several
            }
            _ => {
                // Holes in a sheet, some of them meeting in corners.
                let mut holes = sheet(n + 2, 0.1);
                let mut t = 0;
                holes.triangles.retain(|_| { t += 1; !(t * 7 + seed as usize).is_multiple_of(11) });
                holes
            }
        };
        if colored {
            let color = |t: usize| Vec4::splat(if t.is_multiple_of(5) { 0.2 } else { 0.8 });
            surface.colors = (0..3 * surface.triangles.len()).map(|c| color(c / 3)).collect();
        }
        checked(&surface, FilmTarget::Triangles(faces), seed);
    }
}
