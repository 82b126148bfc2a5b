//! Tests whole runs: invariants at every step, determinism, independence of the step size, and figures within their
//! bands.

mod edits;
mod grain;
mod needles;
mod settings;
mod solvers;
mod stains;

use bevy_math::Vec3;

use super::{clock::FilmClock, state::FilmState};
use crate::{
    film::FaceFate,
    remesh::sample,
    settings::{CoatingSettings, Preset},
    stain::Environment,
};

fn plate(triangles: u32, seed: u64, settings: &CoatingSettings, steps_per_age: u32) -> FilmState {
    let piece = sample::plate(triangles, seed).unwrap();
    FilmState::new(&piece.film, settings, seed, steps_per_age).unwrap()
}

/// Makes the paper's settings with little bending, for tests of fracture alone: fracture is judged at rest, so bending
/// does not change it.
fn quick() -> CoatingSettings {
    let mut settings = CoatingSettings::from(Preset::Paper);
    settings.deform.sweeps_per_age = 200.0;
    settings
}

#[test]
fn every_invariant_holds_at_every_step() {
    for (seed, fall_faces) in [(1, Some(6)), (2, Some(0)), (3, None)] {
        let mut settings = CoatingSettings::from(if fall_faces.is_some() { Preset::Paper } else { Preset::Default });
        settings.stripping.fall_faces = fall_faces.unwrap_or_default();
        settings.scale.grain = 0.08;
        settings.deform.sweeps_per_age = 2000.0;
        // More than the reference run: films go on ageing past 1.
        let mut film = plate(400, seed, &settings, 200);
        for step in 0..300 {
            film.step(&settings, &Environment::still(Vec3::new(0.6, -0.8, 0.0)));
            film.validate().unwrap_or_else(|e| panic!("seed {seed}, step {step}: {e}"));
        }
        let m = film.measure();
        assert!(m.torn > Some(0.1) && m.separated > Some(0.75), "{m:?}");
    }
}

#[test]
fn closed_and_curved_films_age_too() {
    let settings = quick();
    let (positions, triangles) = crate::film::tests::sphere(3);
    let mesh = crate::film::FilmMesh::new(positions, &triangles).unwrap();
    let mut film = FilmState::from_mesh(mesh, &settings, 3, 250);
    for _ in 0..250 {
        film.step(&settings, &Environment::default());
        film.validate().unwrap();
    }
    assert!(film.measure().torn > Some(0.02));
}

#[test]
fn the_same_seed_gives_the_same_bits_and_another_does_not() {
    let settings = quick();
    let run = |seed| {
        let mut film = plate(300, 9, &settings, 100);
        film = FilmState::from_mesh(film.mesh, &settings, seed, 100);
        film.age_to(1.0, &settings, &Environment::default());
        film.digest()
    };
    assert_eq!(run(4), run(4));
    assert_ne!(run(4), run(5));
}

/// Which edge tears first decides how a crack runs on, so single films with other steps differ: at age 1 by up to 0.013
/// of their edges torn (of 0.06 to 0.2) and 0.010 of their faces come off. Means over eight seeds differ by up to 0.002
/// of the vertices separated, by 6 % of the torn edges at age 0.5 and 1.5 % at age 1, and by 5 % of the faces come off.
#[test]
fn fracture_does_not_depend_on_the_number_of_steps() {
    let settings = quick();
    let seeds = 1..=8;
    let means = |steps| {
        let mut sums = [0.0; 5];
        for seed in seeds.clone() {
            let mut film = plate(1000, seed, &settings, steps);
            film.age_to(0.5, &settings, &Environment::default());
            let half = film.measure();
            film.age_to(1.0, &settings, &Environment::default());
            let end = film.measure();
            let off = end.stripped.unwrap() + end.fallen.unwrap();
            let row = [half.separated, half.torn, end.separated, end.torn, Some(off)];
            sums.iter_mut().zip(row).for_each(|(sum, value)| *sum += value.unwrap());
        }
        sums.map(|sum| sum / seeds.clone().count() as f64)
    };
    let reference = means(1000);
    let allowed = [0.01, 0.1, 0.01, 0.03, 0.08];
    for steps in [250, 4000] {
        for (i, (found, expected)) in means(steps).into_iter().zip(reference).enumerate() {
            let apart = (found / expected - 1.0).abs();
            assert!(apart < allowed[i], "figure {i} of {steps} steps: {found} for {expected}");
        }
    }
}

/// Compares means over five seeds with bands found by an independent prototype. Bending does not change them.
#[test]
fn the_plate_of_3012_triangles_fractures_within_its_bands() {
    let mut settings = quick();
    settings.stripping.fall_faces = 0;
    let mut mean = [0.0; 6];
    for seed in 1..=5 {
        let mut film = plate(3012, seed, &settings, 1000);
        let mut at = |age| {
            film.age_to(age, &settings, &Environment::default());
            film.measure()
        };
        let (a, b, c, d) = (at(0.2), at(0.4), at(0.6), at(1.0));
        let row = [a.separated, b.separated, d.separated, c.torn, d.torn, d.stripped];
        for (mean, value) in mean.iter_mut().zip(row) {
            *mean += value.unwrap() / 5.0;
        }
    }
    let bands = [(0.07, 0.19), (0.21, 0.33), (0.69, 0.81), (0.0267, 0.0533), (0.1133, 0.2267), (0.005, 0.05)];
    for (i, (value, (low, high))) in mean.into_iter().zip(bands).enumerate() {
        assert!((low..=high).contains(&value), "figure {i}: {value} not in {low}..={high}");
    }
}

#[test]
fn cracks_run_nearly_straight() {
    let settings = quick();
    let straightness: Vec<f64> = (1..=3)
        .filter_map(|seed| {
            let mut film = plate(3012, seed, &settings, 500);
            film.age_to(0.5, &settings, &Environment::default());
            film.measure().straightness
        })
        .collect();
    assert!(straightness.iter().sum::<f64>() / straightness.len() as f64 > 0.8, "{straightness:?}");
}

#[test]
fn without_weak_edges_nothing_tears() {
    let mut settings = quick();
    settings.tearing.weak_probability = 0.0;
    let mut film = plate(1000, 1, &settings, 250);
    film.age_to(1.0, &settings, &Environment::default());
    assert_eq!(film.measure().torn, Some(0.0));
    assert!(film.measure().separated > Some(0.5));
}

#[test]
fn flakes_curl_outwards_as_far_as_in_the_reference() {
    // In the prototype 10,000 plain sweeps an age lifted flakes by 2.09 mean edges at age 1, on another mesh. Here the
    // lift is to agree within a third: 1.47 as a mean over six seeds, which lift by 1.28 to 1.67.
    let settings = CoatingSettings::from(Preset::Paper);
    let films = (1..=6).map(|seed| {
        let mut film = plate(1000, seed, &settings, 500);
        film.age_to(1.0, &settings, &Environment::default());
        film.measure()
    });
    let (lifts, strains): (Vec<f64>, Vec<f64>) = films.map(|m| (m.lift_p90.unwrap(), m.strain_rms.unwrap())).unzip();
    let lift = lifts.iter().sum::<f64>() / 6.0;
    assert!((lift / 2.09 - 1.0).abs() < 1.0 / 3.0, "{lift}: {lifts:?}");
    assert!(strains.iter().all(|strain| (0.01..0.03).contains(strain)), "{strains:?}");
}

#[test]
fn fallen_and_stripped_faces_are_reported_as_debris_once() {
    let settings = quick();
    let mut film = plate(1000, 1, &settings, 250);
    let (mut faces, mut pieces) = (0, 0);
    for _ in 0..250 {
        film.step(&settings, &Environment::default());
        faces += film.changes.debris.iter().map(|d| d.faces).sum::<u32>();
        pieces += film.changes.debris.len();
    }
    let gone = film.mesh.topology.all_faces().filter(|&f| film.mesh.topology.fate(f) != FaceFate::Live).count();
    assert_eq!(faces as usize, gone);
    assert!(pieces > 5 && gone > pieces);
    let m = film.measure();
    assert!((m.stripped.unwrap() + m.fallen.unwrap() - gone as f64 / 1000.0).abs() < 1e-9);
}

#[test]
fn a_fresh_film_measures_nothing() {
    let m = plate(200, 1, &quick(), 100).measure();
    assert_eq!(
        (m.separated, m.torn, m.straightness, m.strain_rms, m.lift_p90),
        (Some(0.0), Some(0.0), None, None, None)
    );
    assert_eq!((m.pieces, m.loose_pieces, m.crack_tips), (1, 0, 0));
    assert_eq!((m.lift_area_p50_m, m.lift_area_p90_m, m.lift_area_p99_m), (None, None, None));
}

#[test]
fn lift_by_area_is_in_metres_off_the_surface_at_rest() {
    let piece = sample::curved_plate(300, 1).expect("a piece");
    let mut film = FilmState::new(&piece.film, &quick(), 1, 100).expect("a manifold");
    film.age_to(0.6, &quick(), &Environment::default());
    assert!(film.measure().separated > Some(0.1));
    let geometry = &mut film.mesh.geometry;
    for i in 0..geometry.positions.len() {
        geometry.positions[i] = geometry.rest_positions[i] + 0.01 * geometry.rest_normals[i];
    }
    let m = film.measure();
    for lift in [m.lift_area_p50_m, m.lift_area_p90_m, m.lift_area_p99_m] {
        assert!((lift.expect("it has separated") - 0.01).abs() < 1e-5, "{lift:?}");
    }
}

#[test]
fn clocks_count_whole_steps() {
    let clock = FilmClock::new(1000);
    let at = |age| clock.step_at(age);
    assert_eq!((at(0.0), at(-1.0), at(f64::NAN), at(0.05), at(1.0), at(0.0501)), (0, 0, 0, 50, 1000, 51));
    assert_eq!(FilmClock::new(3).step_at(1.0 / 3.0), 1);
    assert_eq!(FilmClock::new(0).steps_per_age, 1);
}

#[test]
fn measures_of_several_films_add_up() {
    let settings = quick();
    let films = [1, 2].map(|seed| {
        let mut film = plate(300, seed, &settings, 100);
        film.age_to(0.8, &settings, &Environment::default());
        film
    });
    let (a, b, both) = (films[0].measure(), films[1].measure(), FilmState::measure_all(&films));
    assert_eq!(both.pieces, a.pieces + b.pieces);
    assert_eq!(both.vertices, a.vertices + b.vertices);
    let mean = (a.torn.unwrap() + b.torn.unwrap()) / 2.0;
    assert!((both.torn.unwrap() - mean).abs() < 0.01);
}
