//! Answers questions by asking every face, as a check of the answers that pass over most of them.

use std::f64::consts::PI;

use bevy_math::Vec3;
use proptest::prelude::*;

use super::{
    FilmArea, FilmPoint, FilmView,
    ray::{front, take},
    sphere::{Sample, Sums, cuts, for_middles},
    triangle::{self, Hit},
    view::Face,
};
use crate::{
    film::direction::unit_or_zero,
    remesh::sample,
    settings::{CoatingSettings, Preset},
    sim::FilmState,
    stain::Environment,
};

/// Returns the place nearest to `point`.
fn nearest(view: FilmView, point: Vec3, within: f32) -> Option<FilmPoint> {
    let (mut best, mut found) = (within * within, None::<(Face, Vec3)>);
    for face in view.faces() {
        let corners = if face.live { view.now(face.corners) } else { view.at_rest(face.corners) };
        let at = triangle::nearest(point, corners);
        let distance = triangle::at(corners, at).distance_squared(point);
        let nearer = match found {
            Some((other, _)) => distance < best || (distance == best && face.live && !other.live),
            None => distance <= best,
        };
        if nearer {
            (best, found) = (distance, Some((face, at)));
        }
    }
    let (face, at) = found?;
    Some(view.seen_from(point, face, at, best.sqrt()))
}

/// Returns the first place that a ray meets.
fn along_ray(view: FilmView, origin: Vec3, direction: Vec3, within: f32) -> Option<FilmPoint> {
    let direction = unit_or_zero(direction);
    let [mut film, mut metal, mut hidden]: [Option<(Face, Hit)>; 3] = [None; 3];
    let [mut film_at, mut metal_at, mut hidden_at] = [within; 3];
    for face in view.faces() {
        let at_rest = front(origin, direction, view.at_rest(face.corners));
        if !face.live {
            take(&mut metal, &mut metal_at, face, at_rest);
            continue;
        }
        let loose = face.corners.iter().any(|&v| view.has_separated(v));
        let hit = triangle::hit(origin, direction, view.now(face.corners)).filter(|hit| loose || !hit.back);
        take(&mut film, &mut film_at, face, hit);
        take(&mut hidden, &mut hidden_at, face, at_rest.filter(|_| loose));
    }
    view.first_of(film, metal, hidden)
}

/// Returns what lies in a sphere.
fn in_sphere(view: FilmView, centre: Vec3, radius: f32) -> Option<FilmArea> {
    let mut sums = Sums::default();
    let square = radius * radius;
    for face in view.faces() {
        let corners = if face.live { view.now(face.corners) } else { view.at_rest(face.corners) };
        let [a, b, c] = corners;
        let beside = (a.min(b).min(c) - centre).max(centre - a.max(b).max(c)).max(Vec3::ZERO);
        if beside.length_squared() > square {
            continue;
        }
        let area = f64::from(view.mesh.geometry.rest_area_of(&view.mesh.topology, face.id));
        let is_in = |p: Vec3| p.distance_squared(centre) <= square;
        let cuts = if corners.into_iter().all(is_in) { 1 } else { cuts(corners, radius) };
        let Face { id, corners: ids, live } = face;
        for_middles(cuts, |at| {
            if is_in(triangle::at(corners, at)) {
                let place = match live {
                    true => view.film_point(id, ids, at, false, 0.0),
                    false => view.metal_point(id, ids, at, 0.0),
                };
                sums.add(&Sample::from(&place), area / f64::from(cuts * cuts));
            }
        });
    }
    if sums.area == 0.0 {
        sums.add(&Sample::from(&nearest(view, centre, radius)?), PI * f64::from(square));
    }
    Some(sums.finish())
}

/// Films of several shapes and ages, from fresh to mostly gone, turned out of the planes of the axes.
fn films() -> Vec<FilmState> {
    let settings = CoatingSettings::from(Preset::Heavy);
    let environment = Environment { rain: Vec3::NEG_Z, ..Environment::default() };
    let pieces = [sample::plate(400, 7), sample::curved_plate(300, 5), sample::disk(300, 3)];
    let films = pieces.into_iter().flat_map(|piece| {
        let mut film = FilmState::new(&piece.expect("a test piece").film, &settings, 7, 100).expect("a manifold");
        [0.0, 0.5, 0.9, 1.6].map(|age| {
            film.age_to(age, &settings, &environment);
            film.clone()
        })
    });
    films.collect()
}

fn vector(most: f32) -> impl Strategy<Value = Vec3> {
    [-most..most, -most..most, -most..most].prop_map(Vec3::from)
}

#[test]
fn all_faces_give_the_same_answers() {
    let films = films();
    assert!(films.iter().any(|film| film.mesh.topology.removed_face_count() > 50));
    let strategy = (0..films.len(), vector(1.0), vector(1.0), 0.0f32..2.0, 0usize..5, any::<bool>());
    let mut runner = proptest::test_runner::TestRunner::new(ProptestConfig::with_cases(4_000));
    let checked = runner.run(&strategy, |(film, place, way, size, hide, on_film)| {
        let film = &films[film];
        let hidden: Vec<bool> = film.mesh.topology.all_faces().map(|f| f.index() % 7 < hide).collect();
        let view = FilmView { hidden: if hide == 0 { &[] } else { &hidden }, ..film.view() };
        // Also places that lie on vertices, and rays that pass through them.
        let positions = &film.mesh.geometry.positions;
        let vertex = positions[(size * 1e6) as usize % positions.len()];
        let place = if on_film { vertex } else { place };
        prop_assert_eq!(view.nearest(place, f32::INFINITY), nearest(view, place, f32::INFINITY));
        prop_assert_eq!(view.nearest(place, size * 0.1), nearest(view, place, size * 0.1));
        for (origin, direction) in [(place, way), (vertex + way, -way), (place, vertex - place)] {
            if unit_or_zero(direction) != Vec3::ZERO {
                let within = if hide == 1 { size } else { f32::INFINITY };
                let (found, plain) =
                    (view.along_ray(origin, direction, within), along_ray(view, origin, direction, within));
                prop_assert_eq!(found, plain);
            }
        }
        let radius = size * size * 0.3;
        prop_assert_eq!(view.in_sphere(place, radius), in_sphere(view, place, radius));
        Ok(())
    });
    checked.expect("the same answers");
}

#[test]
fn a_place_beside_a_corner_by_less_than_rounding_is_found() {
    let film = &films()[4];
    for (i, &p) in film.mesh.geometry.positions.iter().enumerate() {
        let way = [Vec3::X, Vec3::Y, Vec3::Z, Vec3::ONE][i % 4] * f32::EPSILON * 0.3;
        assert!(film.view().nearest(p + way, f32::INFINITY).is_some());
    }
}
