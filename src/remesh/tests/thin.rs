//! Props that are thin, round, tiny, far away or divided far more finely than the film.

use std::f32::consts::TAU;

use super::super::{
    features::{Fidelity, Scale},
    flip::flip_edges,
    reference::Reference,
    work_mesh::{EDITS, WorkMesh},
};
use super::*;

/// Points on a circle.
fn circle(sides: usize, radius: f32) -> Vec<Vec2> {
    (0..sides).map(|i| Vec2::from_angle(TAU * i as f32 / sides as f32) * radius).collect()
}

fn rectangle(width: f32, height: f32) -> Vec<Vec2> {
    vec![Vec2::ZERO, Vec2::new(width, 0.0), Vec2::new(width, height), Vec2::new(0.0, height)]
}

/// A convex profile along y, closed at both ends.
fn bar(profile: &[Vec2], length: f32, rings: usize) -> Surface {
    let mut surface = Surface::default();
    let n = profile.len() as u32;
    for k in 0..=rings {
        let y = length * k as f32 / rings as f32;
        surface.positions.extend(profile.iter().map(|p| Vec3::new(p.x, y, p.y)));
    }
    for (k, i) in (0..rings as u32).flat_map(|k| (0..n).map(move |i| (k * n, i))) {
        let (a, b) = (k + i, k + (i + 1) % n);
        surface.triangles.extend([[a, b + n, b], [a, a + n, b + n]]);
    }
    let last = n * rings as u32;
    for i in 1..n - 1 {
        surface.triangles.extend([[0, i, i + 1], [last, last + i + 1, last + i]]);
    }
    surface
}

/// A flat strip of two triangles.
fn strip(length: f32, width: f32) -> Surface {
    let mut surface = Surface::default();
    grid(&mut surface, [1, 1], |p| Vec3::new(length * p.x, width * p.y, 0.0), |p| p);
    surface.uvs.clear();
    surface
}

fn volume(positions: &[Vec3], triangles: &[[u32; 3]]) -> f64 {
    let corners = |t: &[u32; 3]| t.map(|v| positions[v as usize].as_dvec3());
    triangles.iter().map(corners).map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum()
}

/// Relative change from the surface to the film.
fn change(before: f64, after: f64) -> f64 {
    after / before - 1.0
}

fn area_change(surface: &Surface, film: &BuiltFilm) -> f64 {
    let [before, after] =
        [(&surface.positions, &surface.triangles), (&film.positions, &film.triangles)].map(|(p, t)| area(p, t));
    change(before.into(), after.into())
}

fn volume_change(surface: &Surface, film: &BuiltFilm) -> f64 {
    change(volume(&surface.positions, &surface.triangles), volume(&film.positions, &film.triangles))
}

/// Builds and checks a film, and returns it with the number of splits, collapses and flips that it took.
fn counted(surface: &Surface, triangles: u32) -> (BuiltFilm, u64) {
    EDITS.set(0);
    let film = checked(surface, FilmTarget::Triangles(triangles), 1);
    assert!(film.positions.iter().all(|p| p.is_finite()));
    (film, EDITS.get())
}

fn is_dense(warning: &BuildWarning) -> bool {
    matches!(warning, BuildWarning::FeaturesDenserThanTarget { .. })
}

fn thin_props() -> Vec<(&'static str, Surface, f64)> {
    vec![
        ("pole of 12 sides", bar(&circle(12, 0.02), 10.0, 1), 0.06),
        ("pole of 6 sides", bar(&circle(6, 0.02), 10.0, 1), 1e-3),
        ("pole of 32 sides", bar(&circle(32, 0.02), 10.0, 1), 0.06),
        ("divided pole", bar(&circle(24, 0.02), 10.0, 60), 0.06),
        ("cable", bar(&circle(8, 0.0025), 20.0, 1), 0.06),
        ("flat bar", bar(&rectangle(0.005, 0.02), 4.0, 1), 1e-3),
        ("square bar", bar(&rectangle(0.01, 0.01), 10.0, 1), 1e-3),
        ("sheet of 1 mm", bar(&rectangle(2.0, 0.001), 2.0, 1), 1e-3),
        ("strip of 1 mm", strip(1.0, 1e-3), 1e-3),
        ("strip of 0.1 mm", strip(1.0, 1e-4), 1e-3),
    ]
}

#[test]
fn thin_props_take_the_triangles_asked_for_and_bounded_work() {
    for (name, surface, most) in thin_props() {
        let mut fewer = None;
        for asked in [1000, 4000] {
            let (film, edits) = counted(&surface, asked);
            let found = film.triangles.len();
            assert!(2 * found <= 3 * asked as usize, "{name}: {found} triangles for {asked}: {:?}", film.warnings);
            assert!(!film.warnings.iter().any(is_dense) || found as u32 > asked, "{name}: {:?}", film.warnings);
            let lost = area_change(&surface, &film);
            let warned = film.warnings.iter().any(|w| matches!(w, BuildWarning::ShapeCoarse { .. }));
            assert!(lost.abs() < most || warned, "{name}: the area of {asked} is {lost} off");
            let work = edits / u64::from(asked);
            assert!(work < 400, "{name}: {edits} edits for {asked} triangles");
            // Four times the triangles may take little more than four times the work.
            assert!(
                fewer.is_none_or(|fewer| edits < 8 * fewer),
                "{name}: {fewer:?} edits for 1,000, {edits} for 4,000"
            );
            fewer = Some(edits);
        }
    }
}

/// The diagonal of a flat kite joins its far corners, and a flip must turn it.
#[test]
fn a_flat_pair_of_needles_is_flipped() {
    let surface = Surface {
        positions: vec![Vec3::ZERO, Vec3::X, Vec3::new(0.5, 0.1, 0.0), Vec3::new(0.5, -0.1, 0.0)],
        triangles: vec![[0, 1, 2], [1, 0, 3]],
        ..Surface::default()
    };
    let cleaned = clean(&surface).expect("a clean surface");
    let scale = Scale { target: 0.2, triangles: 2.0, fidelity: Fidelity::Facets };
    let reference = at_once(Reference::new(&surface, &cleaned, scale, &mut NoRest));
    let mut mesh = WorkMesh::new(&reference);
    at_once(flip_edges(&mut mesh, &mut NoRest));
    mesh.topology.check();
    assert!(mesh.topology.edge_between(VertexId(0), VertexId(1)).is_none(), "the long diagonal is still there");
    assert!(mesh.topology.edge_between(VertexId(2), VertexId(3)).is_some());
}

#[test]
fn a_fine_rim_is_resampled_to_the_film() {
    let rim = circle(6000, 1.0);
    let surface = Surface {
        positions: rim.iter().map(|p| p.extend(0.0)).collect(),
        triangles: (1..rim.len() as u32 - 1).map(|i| [0, i, i + 1]).collect(),
        ..Surface::default()
    };
    let (film, edits) = counted(&surface, 1000);
    assert!((950..=1050).contains(&film.triangles.len()), "{} triangles", film.triangles.len());
    assert!(area_change(&surface, &film).abs() < 5e-3, "area {} off", area_change(&surface, &film));
    assert!(edits < 100_000, "{edits} edits");
}

#[test]
fn round_bars_stay_round_or_a_warning_says_how_far_they_do_not() {
    for (sides, rings) in [(16, 40), (24, 100), (64, 200)] {
        // A smooth pipe of which about four of the target's edges go around.
        let surface = bar(&circle(sides, 0.02), 10.0, rings);
        let film = checked(&surface, FilmTarget::Triangles(4000), 1);
        let (area, volume) = (area_change(&surface, &film), volume_change(&surface, &film));
        assert!(volume > -0.12 && area > -0.04, "{sides} sides: area {area}, volume {volume} off");
        let warned = film.warnings.iter().find_map(|w| match w {
            BuildWarning::ShapeCoarse { volume, triangles, .. } => Some((volume.expect("closed"), *triangles)),
            _ => None,
        });
        assert_eq!(warned.is_some(), volume < -0.08 || area < -0.03, "{warned:?}: area {area}, volume {volume}");
        if let Some((percent, triangles)) = warned {
            assert!((f64::from(percent) - 100.0 * volume).abs() < 0.1, "{percent} % said, {volume}");
            let finer = checked(&surface, FilmTarget::Triangles(triangles), 1);
            let (area, volume) = (area_change(&surface, &finer), volume_change(&surface, &finer));
            assert!(volume > -0.09 && area > -0.034, "the way out is none: area {area}, volume {volume}");
        }
    }
}

/// A panel with small smooth caps on it, in slot 1.
fn riveted(caps: usize) -> Surface {
    let mut surface = strip(6.0, 2.5);
    for i in 0..caps {
        let mut cap = Surface::default();
        let dome = |p: Vec2| 0.009 * on_sphere(Vec2::new(p.x, 0.5 + 0.5 * p.y));
        grid(&mut cap, [12, 4], dome, |p| p);
        append(&mut surface, &cap, Vec3::new(0.05 + 0.07 * i as f32, 1.0, 0.0));
    }
    surface.slots = (0..surface.triangles.len()).map(|t| u32::from(t >= 2)).collect();
    surface
}

#[test]
fn small_parts_keep_their_shape_or_a_warning_counts_them() {
    let surface = riveted(80);
    let of_caps = |positions: &[Vec3], triangles: &[[u32; 3]], slots: &[u32]| {
        let caps: Vec<_> = triangles.iter().zip(slots).filter(|&(_, &slot)| slot == 1).map(|(t, _)| *t).collect();
        f64::from(area(positions, &caps))
    };
    let before = of_caps(&surface.positions, &surface.triangles, &surface.slots);
    let film = checked(&surface, FilmTarget::Triangles(4000), 1);
    let lost = change(before, of_caps(&film.positions, &film.triangles, &film.slots));
    assert!(lost.abs() < 0.15, "the rivets' area is {lost} off");
    let is_coarse = |w: &BuildWarning| matches!(w, BuildWarning::SmallPartsCoarse { .. });
    assert!(!film.warnings.iter().any(is_coarse), "{:?}", film.warnings);

    let film = checked(&surface, FilmTarget::Triangles(500), 1);
    let Some(&BuildWarning::SmallPartsCoarse { parts, triangles }) = film.warnings.iter().find(|w| is_coarse(w)) else {
        panic!("no warning: {:?}", film.warnings);
    };
    assert_eq!(parts, 80);
    let film = checked(&surface, FilmTarget::Triangles(triangles), 1);
    assert!(!film.warnings.iter().any(is_coarse), "the way out is none: {:?}", film.warnings);
}

/// Many long blades at one edge, as a doubled export leaves them.
#[test]
fn doubled_thin_sheets_do_not_explode() {
    let mut surface = Surface::default();
    for k in 0..9 {
        let side = Vec2::from_angle(0.6 * k as f32) * 0.005;
        let base = surface.positions.len() as u32;
        surface.positions.extend([
            Vec3::ZERO,
            Vec3::new(16.0, 0.0, 0.0),
            Vec3::new(16.0, side.x, side.y),
            Vec3::new(0.0, side.x, side.y),
        ]);
        for _ in 0..2 {
            surface.triangles.extend([[0, 1, 2], [0, 2, 3]].map(|t| t.map(|v| base + v)));
        }
        surface.triangles.push([0, 2, 1].map(|v| base + v));
    }
    let (film, edits) = counted(&surface, 1000);
    assert!(film.triangles.len() <= 1500, "{} triangles", film.triangles.len());
    assert!(edits < 100_000, "{edits} edits");
}

#[test]
fn sizes_out_of_range_are_refused_and_all_others_give_finite_films() {
    let at = |size: f32| {
        let mut surface = bevelled_box(Vec3::new(0.5, 0.3, 0.2), 0.02, 2);
        surface.positions.iter_mut().for_each(|p| *p *= size);
        surface
    };
    for size in [1e-30, 1e-12, 1e-6, 1e7, 1e20, 1e38] {
        for target in [FilmTarget::Triangles(500), FilmTarget::Keep] {
            let result = build_film(&at(size), target, 1);
            assert!(matches!(result, Err(BuildError::Size { .. })), "{size} m: {result:?}");
        }
    }
    let reference = checked(&at(1.0), FilmTarget::Triangles(500), 1);
    for size in [1.1e-4, 1e-3, 1e3, 0.9e6] {
        let film = checked(&at(size), FilmTarget::Triangles(500), 1);
        assert!(film.positions.iter().all(|p| p.is_finite()));
        let ratio = film.triangles.len() as f32 / reference.triangles.len() as f32;
        assert!((ratio - 1.0).abs() < 0.02, "{size} m: {} triangles", film.triangles.len());
    }
}

#[test]
fn far_surfaces_are_built_around_their_middle() {
    let mut surface = bevelled_box(Vec3::new(128.0, 64.0, 64.0), 8.0, 2);
    let near = checked(&surface, FilmTarget::Triangles(1000), 1);
    // A power of two, so that both give the same bits.
    let offset = Vec3::new(524_288.0, 0.0, -524_288.0);
    surface.positions.iter_mut().for_each(|p| *p += offset);
    let far = build_film(&surface, FilmTarget::Triangles(1000), 1).expect("a film");
    assert_eq!((&far.triangles, &far.sites), (&near.triangles, &near.sites));
    for (far, near) in far.positions.iter().zip(&near.positions) {
        assert!((*far - offset).distance(*near) < 0.1, "{far} is not {near}");
    }

    let mut small = bevelled_box(Vec3::new(0.5, 0.5, 0.5), 0.125, 2);
    small.positions.iter_mut().for_each(|p| *p += offset);
    let result = build_film(&small, FilmTarget::Triangles(4000), 1);
    assert!(matches!(result, Err(BuildError::FarFromOrigin { .. })), "{result:?}");
}
