//! Questions to plates that have aged, and to some whose state is made by hand.

use bevy_math::Vec3;

use super::*;
use crate::{
    film::FilmMesh,
    remesh::sample,
    settings::{CoatingSettings, Preset},
    sim::FilmState,
    stain::Environment,
};

/// A plate from corner (-0.5, -0.5) to (0.5, 0.5), facing +z.
fn plate(age: f64) -> FilmState {
    let settings = CoatingSettings::from(Preset::Heavy);
    let piece = sample::plate(800, 7).expect("a plate");
    let mut film = FilmState::new(&piece.film, &settings, 7, 100).expect("a manifold");
    film.age_to(age, &settings, &Environment::default());
    film
}

/// Two triangles that make up a square of 2 by 2 in the xy plane, facing +z.
fn square() -> FilmState {
    let corners = vec![Vec3::ZERO, Vec3::X * 2.0, Vec3::new(2.0, 2.0, 0.0), Vec3::Y * 2.0];
    let mesh = FilmMesh::new(corners, &[[0, 1, 2], [0, 2, 3]]).expect("a manifold");
    FilmState::from_mesh(mesh, &CoatingSettings::default(), 7, 100)
}

/// Places over and around a plate.
fn places() -> impl Iterator<Item = Vec3> {
    (0..512u32).map(|i| {
        let [x, y, z] = [i % 8, i / 8 % 8, i / 64].map(|k| k as f32);
        Vec3::new(x * 0.171 - 0.6, y * 0.167 - 0.58, z * 0.05 - 0.08)
    })
}

#[test]
fn the_nearest_place_is_that_of_a_search_without_shortcuts() {
    let film = plate(0.9);
    assert!(film.mesh.topology.removed_face_count() > 0);
    let view = film.view();
    for point in places() {
        let found = view.nearest(point, f32::INFINITY).expect("a place");
        let least = view.faces().map(|face| {
            let corners = if face.live { view.now(face.corners) } else { view.at_rest(face.corners) };
            triangle::at(corners, triangle::nearest(point, corners)).distance(point)
        });
        let least = least.fold(f32::INFINITY, f32::min);
        assert!((found.distance - least).abs() < 1e-6, "{point}: {found:?}, {least}");
        assert!((found.position.distance(point) - found.distance).abs() < 1e-5);
        assert_eq!(found.surface.is_metal(), !film.mesh.topology.is_live(found.face));
        assert_eq!(view.nearest(point, found.distance * 0.99), None);
        assert_eq!(view.nearest(point, found.distance * 1.01 + 1e-6), Some(found));
    }
}

#[test]
fn a_ray_onto_a_plate_always_meets_something() {
    // Whatever has cracked and curled: there is metal under it.
    for age in [0.0, 0.6, 1.0, 2.0] {
        let film = plate(age);
        for place in places().filter(|p| p.x.abs() < 0.49 && p.y.abs() < 0.49) {
            let from = place.with_z(2.0);
            let found = film.view().along_ray(from, Vec3::NEG_Z * 3.0, 2.5).expect("a hit");
            assert!(found.distance <= 2.0 + 1e-4 && found.position.with_z(0.0).abs_diff_eq(place.with_z(0.0), 1e-4));
            assert!((found.barycentric.element_sum() - 1.0).abs() < 1e-5);
            if found.surface.is_metal() {
                assert!(found.position.z.abs() < 1e-5 && !found.attached && found.normal.abs_diff_eq(Vec3::Z, 1e-5));
            }
        }
    }
}

#[test]
fn film_is_seen_before_the_metal_that_it_lies_on() {
    let mut film = square();
    film.forces.separated_age.fill(0.0);
    let look = |film: &FilmState| film.view().along_ray(Vec3::new(0.5, 0.7, 1.0), Vec3::NEG_Z, 9.0).expect("a hit");
    assert_eq!(look(&film).surface, FilmSurface::Paint, "flat, and off the metal");
    assert!(!look(&film).attached);
    // Between its vertices it may dip through curved metal.
    film.mesh.geometry.positions.iter_mut().for_each(|p| p.z = -0.1);
    assert_eq!(look(&film).surface, FilmSurface::Paint);
    // It has moved aside.
    film.mesh.geometry.positions.iter_mut().for_each(|p| p.x += 5.0);
    let metal = look(&film);
    assert_eq!(
        (metal.surface, metal.distance, metal.position),
        (FilmSurface::BareMetal, 1.0, Vec3::new(0.5, 0.7, 0.0))
    );
}

#[test]
fn what_holds_is_met_from_outside_only() {
    let mut film = square();
    let from_below = |film: &FilmState| film.view().along_ray(Vec3::new(0.5, 0.7, -1.0), Vec3::Z, 9.0);
    assert_eq!(from_below(&film), None);
    film.forces.separated_age[0] = 0.0;
    film.mesh.geometry.positions[0].z = 0.2;
    let back = from_below(&film).expect("a flake that stands up");
    assert_eq!(back.surface, FilmSurface::Primer);
    assert!(back.normal.z < 0.0 && back.distance > 1.0);
}

#[test]
fn a_flake_is_primer_from_below() {
    let mut film = square();
    film.forces.separated_age.fill(0.0);
    film.mesh.geometry.positions.iter_mut().for_each(|p| p.z = 0.5);
    let of = |z: f32| film.view().nearest(Vec3::new(1.0, 0.5, z), 1.0).expect("near");
    assert_eq!([of(0.7), of(0.3)].map(|p| p.surface), [FilmSurface::Paint, FilmSurface::Primer]);
    assert_eq!([of(0.7), of(0.3)].map(|p| p.normal), [Vec3::Z, Vec3::NEG_Z]);
    assert_eq!(of(0.3).rest_position, Vec3::new(1.0, 0.5, 0.0));
}

#[test]
fn places_show_their_stains() {
    let mut film = square();
    film.stains.film.moisture = vec![1.0, 0.0, 0.0, 0.0];
    film.stains.film.dust.fill(0.25);
    film.stains.film.stained.fill(0.5);
    let corner = film.view().nearest(Vec3::ZERO, 1.0).expect("near");
    assert_eq!((corner.wetness, corner.dust, corner.rusted, corner.attached), (1.0, 0.25, 0.0, true));
    assert!((corner.rust_stain - 0.7769).abs() < 1e-4);
    let middle = film.view().nearest(Vec3::new(1.0, 1.0, 0.0), 1.0).expect("near");
    assert!((middle.wetness - 0.5).abs() < 1e-6);

    let (settings, environment) = (CoatingSettings::default(), Environment::default());
    film.strip_face(crate::film::FaceId(0), &settings, &environment);
    let metal = |film: &FilmState| film.view().nearest(Vec3::new(1.5, 0.5, 0.0), 1.0).expect("near");
    assert_eq!((metal(&film).surface, metal(&film).dust), (FilmSurface::BareMetal, 0.0), "the metal's own stains");
    film.stains.corrosion.fill(0.2);
    assert_eq!(metal(&film).surface, FilmSurface::RustedMetal);
}

#[test]
fn nonsense_finds_nothing() {
    let film = square();
    let (view, nan) = (film.view(), f32::NAN);
    assert_eq!(view.nearest(Vec3::splat(nan), 1.0), None);
    assert_eq!(view.nearest(Vec3::INFINITY, f32::INFINITY), None);
    assert_eq!(view.nearest(Vec3::ONE, nan), None);
    assert_eq!(view.nearest(Vec3::ONE, -1.0), None);
    for (origin, direction, within) in [
        (Vec3::splat(nan), Vec3::NEG_Z, 9.0),
        (Vec3::ONE, Vec3::ZERO, 9.0),
        (Vec3::ONE, Vec3::splat(nan), 9.0),
        (Vec3::ONE, Vec3::NEG_Z, nan),
    ] {
        assert_eq!(view.along_ray(origin, direction, within), None);
    }
    assert!(view.along_ray(Vec3::ONE, Vec3::NEG_Z * 1e30, f32::INFINITY).is_some(), "of any length");
    for (centre, radius) in
        [(Vec3::splat(nan), 1.0), (Vec3::ZERO, nan), (Vec3::ZERO, -1.0), (Vec3::ZERO, f32::INFINITY)]
    {
        assert_eq!(view.in_sphere(centre, radius), None);
    }
    assert_eq!(FilmState::default().view().nearest(Vec3::ZERO, 1.0), None, "an empty film");
    assert_eq!(FilmState::default().shares(), FilmShares::default());
}

#[test]
fn spheres_of_any_size_find_their_share_of_a_plate() {
    let film = plate(0.0);
    for radius in [0.3, 0.1, 0.02, 0.005] {
        let found = film.view().in_sphere(Vec3::new(0.03, -0.02, 0.0), radius).expect("paint");
        let disc = std::f64::consts::PI * f64::from(radius * radius);
        assert!((found.area / disc - 1.0).abs() < 0.1, "{radius}: {} of {disc}", found.area);
        assert!((found.paint - 1.0).abs() < 1e-9);
    }
    let point = film.view().in_sphere(Vec3::ZERO, 0.0);
    assert!(point.is_none_or(|point| point.area == 0.0));
    assert_eq!(film.view().in_sphere(Vec3::Z, 0.5), None);
}

#[test]
fn a_sphere_around_all_agrees_with_the_shares() {
    let film = plate(1.0);
    let (all, shares) = (film.view().in_sphere(Vec3::ZERO, 9.0).expect("all"), film.shares());
    assert!((all.area / shares.area - 1.0).abs() < 1e-4);
    assert!((all.bare - shares.gone).abs() < 1e-4 && shares.gone > 0.05, "{all:?}, {shares:?}");
    assert!((all.dust - shares.dusty).abs() < 1e-3 && shares.dusty > 0.0);
    assert!(all.rusted > 0.0 && all.rusted <= shares.rusted + 0.01, "{} of {}", all.rusted, shares.rusted);
}

#[test]
fn a_survey_that_follows_a_film_agrees_with_a_new_one() {
    let settings = CoatingSettings::from(Preset::Heavy);
    let mut film = plate(0.0);
    let mut survey = FilmSurvey::default();
    for _ in 0..70 {
        film.step(&settings, &Environment::default());
        survey.look(film.view());
    }
    assert_eq!(survey.shares(), &film.shares());
    let shares = *survey.shares();
    let whole = shares.attached + shares.separated + shares.gone;
    assert!((whole - 1.0).abs() < 1e-6 && (shares.area - 1.0).abs() < 1e-3, "{shares:?}");
    assert!((shares.crack_sizes.iter().sum::<f64>() - shares.crack_density).abs() < 1e-9);
    assert!((shares.gone_sizes.iter().sum::<f64>() - shares.gone).abs() < 1e-9);
    assert!(shares.cracks > 1 && shares.crack_density > 1.0, "{shares:?}");
}

#[test]
fn an_edge_is_a_crack_until_a_face_at_it_is_gone() {
    let (settings, environment) = (CoatingSettings::default(), Environment::default());
    let mut film = square();
    let edge = film.mesh.topology.all_edges().find(|&h| film.mesh.topology.bound_twin(h).is_some()).expect("an edge");
    assert!(film.tear_edge(edge, &settings, &environment));
    let shares = film.shares();
    assert_eq!(shares.cracks, 1);
    assert!((shares.crack_density - 8f64.sqrt() / 4.0).abs() < 1e-6);
    film.strip_face(crate::film::FaceId(0), &settings, &environment);
    assert_eq!((film.shares().cracks, film.shares().crack_density), (0, 0.0));
}

#[test]
fn separate_cracks_are_counted() {
    let (settings, environment) = (CoatingSettings::default(), Environment::default());
    let mut film = plate(0.0);
    let near = |film: &FilmState, x: f32| {
        let topology = &film.mesh.topology;
        let inner = topology.all_edges().filter(|&h| topology.bound_twin(h).is_some());
        let at = |v: crate::film::VertexId| film.mesh.geometry.rest_positions[v.index()];
        let distance = |&h: &crate::film::HalfEdgeId| at(topology.origin(h)).distance(Vec3::X * x);
        inner.min_by(|a, b| distance(a).total_cmp(&distance(b))).expect("an edge")
    };
    for (x, cracks) in [(-0.3, 1), (0.0, 2), (0.3, 3)] {
        let edge = near(&film, x);
        assert!(film.tear_edge(edge, &settings, &environment));
        assert_eq!(film.shares().cracks, cracks);
        let next = edge.next();
        if film.tear_edge(next, &settings, &environment) {
            assert_eq!(film.shares().cracks, cracks, "it has only grown");
        }
    }
    let shares = film.shares();
    assert!(shares.crack_density > 0.0);
    assert_eq!(shares.crack_sizes[0], shares.crack_density, "none of them gapes yet");
    assert_eq!(Ratings::from(&shares).cracking.quantity(), 0, "so nobody sees them");
}

#[test]
fn hidden_faces_do_not_count() {
    let film = square();
    let hidden = [true, false];
    let view = FilmView { hidden: &hidden, ..film.view() };
    assert!((view.shares().area - 2.0).abs() < 1e-6 && view.shares().attached == 1.0);
    let found = view.nearest(Vec3::new(1.5, 0.5, 0.0), 9.0).expect("the other");
    assert_eq!(found.face, crate::film::FaceId(1));
    assert_eq!(view.along_ray(Vec3::new(1.5, 0.5, 1.0), Vec3::NEG_Z, 9.0), None);
    assert!((view.in_sphere(Vec3::ZERO, 9.0).expect("one").area - 2.0).abs() < 1e-6);
    let mut survey = FilmSurvey::default();
    assert!(survey.update(film.view()) && survey.update(view), "what is hidden is a change");
}

#[test]
fn grades_are_those_of_the_standards() {
    let rusted = |rusted: f64| Ratings::from(&FilmShares { rusted, ..FilmShares::default() });
    let percents = [0.0, 0.0005, 0.01, 0.02, 0.05, 0.08, 0.2, 0.5, 0.9, 2.0, 8.0, 9.0, 15.0, 30.0, 45.0, 60.0];
    let found = percents.map(|percent| {
        let Ratings { rust, astm, .. } = rusted(percent / 100.0);
        (rust.number(), astm.grade())
    });
    let expected = [
        (0, 10),
        (0, 10),
        (1, 10),
        (1, 9),
        (1, 8),
        (2, 8),
        (2, 7),
        (2, 6),
        (3, 6),
        (4, 5),
        (4, 4),
        (5, 4),
        (5, 3),
        (5, 2),
        (5, 1),
        (5, 0),
    ];
    assert_eq!(found, expected);
    let gone = |gone: f64| Ratings::from(&FilmShares { gone, ..FilmShares::default() }).flaking.quantity();
    assert_eq!([0.0, 0.001, 0.002, 0.01, 0.03, 0.04, 0.5].map(gone), [0, 1, 2, 3, 4, 5, 5]);
}

#[test]
fn ratings_are_read_as_they_are_written() {
    let all = ["Ri0", "Ri5", "D610-10", "D610-0", "flaking 0", "flaking 3", "flaking 3(S4)", "cracking 5(S5)"];
    for text in all {
        let rating: Rating = text.parse().expect(text);
        assert_eq!(rating.to_string(), text);
        let until: Until = text.parse().expect(text);
        assert_eq!(until, Until::Rating(rating));
        let json = serde_json::to_string(&until).expect("text");
        assert_eq!(json, format!("{text:?}"));
        assert_eq!(serde_json::from_str::<Until>(&json).expect("the same"), until);
    }
    for (loose, strict) in
        [(" ri 3", "Ri3"), ("astm 7", "D610-7"), ("d610 7", "D610-7"), ("Flaking3(4)", "flaking 3(S4)")]
    {
        assert_eq!(loose.parse::<Rating>().expect(loose).to_string(), strict);
    }
    for text in ["", "3", "Ri", "Ri6", "Ri-1", "D610-11", "flaking", "flaking 6", "cracking 2(S9)", "3(S4)", "R\u{e9}3"]
    {
        assert!(text.parse::<Rating>().is_err() && text.parse::<Until>().is_err(), "{text}");
    }
    for (text, until) in [
        ("wet=0.5", Until::Share(Share::Wet, 0.5)),
        ("Rusted = 7%", Until::Share(Share::Rusted, 0.07)),
        ("age=0.7", Until::Age(0.7)),
    ] {
        assert_eq!(text.parse::<Until>().expect(text), until);
        assert_eq!(until.to_string().parse::<Until>().expect(text), until);
    }
    for text in ["gone=", "gone=2", "gone=-1%", "gone=NaN", "age=-1", "age=10%", "age=inf", "attached=0.1", "=1"] {
        assert!(text.parse::<Until>().is_err(), "{text}");
    }
}

#[test]
fn films_are_aged_to_the_tick_at_which_they_come_to_it() {
    let settings = CoatingSettings::from(Preset::Heavy);
    let environment = Environment::default();
    let until = Until::Share(Share::Gone, 0.1);
    let mut film = plate(0.0);
    let age = film.age_until(&until, 10.0, &settings, &environment).expect("it flakes");
    assert!(film.shares().gone >= 0.1 && film.clock.age() == age);
    let mut before = plate(age - 0.01);
    assert!(before.shares().gone < 0.1);
    assert_eq!(before.age_until(&until, age - 0.005, &settings, &environment), Some(age), "a whole step further");
    assert_eq!(before.digest(), film.digest());
    assert_eq!(film.age_until(&until, 0.0, &settings, &environment), Some(age), "it is that far already");
    assert_eq!(film.age_until(&Until::Age(age + 0.05), f64::NAN, &settings, &environment), None);
    assert_eq!(film.clock.age(), age);
}
