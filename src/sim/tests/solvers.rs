//! Tests the packed solver over whole runs: the same bits at every level, the lift of the plain solver, and sleep.

use bevy_math::Vec3;

use super::{plate, quick};
use crate::{
    deform::{self, SimdLevel, SolvePace, SolverQuality, sweeps_and_momentum},
    film::{FilmMesh, VertexId, tests::sphere},
    settings::{CoatingSettings, Preset},
    sim::{stage, state::FilmState},
    stain::Environment,
};

fn bumpy() -> FilmMesh {
    let (mut positions, triangles) = sphere(3);
    for (i, p) in positions.iter_mut().enumerate() {
        *p *= 1.0 + 0.02 * ((i * 7919 % 13) as f32 / 13.0);
    }
    FilmMesh::new(positions, &triangles).unwrap()
}

#[test]
fn every_level_gives_the_same_bits_through_steps_with_tearing() {
    let settings = CoatingSettings::from(Preset::Paper);
    for (mesh, seed) in [(plate(700, 3, &settings, 200).mesh, 3), (bumpy(), 4)] {
        let start = FilmState::from_mesh(mesh, &settings, seed, 200);
        let run = |level| {
            let mut film = start.clone();
            film.scratch.bend.level = level;
            let digests: Vec<String> = (0..200)
                .map(|_| {
                    film.step(&settings, &Environment::default());
                    film.digest()
                })
                .collect();
            assert!(film.measure().torn > Some(0.05));
            digests
        };
        let twin = run(SimdLevel::Scalar);
        // Those that this CPU lacks are named by `every_instruction_set_of_this_machine_is_compared`.
        for level in SimdLevel::ALL.into_iter().filter(|level| level.is_available()) {
            let found = run(level);
            let first = twin.iter().zip(&found).position(|(a, b)| a != b);
            assert_eq!(first, None, "{} differs from this step on", level.name());
        }
    }
}

/// Returns the lift at ages 0.5 and 1 and the strain at age 1, means over three seeds.
fn lifts_and_strain(quality: SolverQuality) -> [f64; 3] {
    let settings = CoatingSettings::from(Preset::Paper);
    let mut sums = [0.0; 3];
    let seeds = 1..=3;
    for seed in seeds.clone() {
        let mut film = plate(1500, seed, &settings, 1000);
        film.quality = quality;
        film.age_to(0.5, &settings, &Environment::default());
        sums[0] += film.measure().lift_p90.unwrap();
        film.age_to(1.0, &settings, &Environment::default());
        let end = film.measure();
        sums[1] += end.lift_p90.unwrap();
        sums[2] += end.strain_rms.unwrap();
    }
    sums.map(|sum| sum / seeds.clone().count() as f64)
}

#[test]
fn packed_solvers_lift_and_strain_like_the_plain_one() {
    let reference = lifts_and_strain(SolverQuality::Reference);
    for (quality, tolerance) in
        [(SolverQuality::High, 0.04), (SolverQuality::Default, 0.04), (SolverQuality::Fast, 0.06)]
    {
        let found = lifts_and_strain(quality);
        for i in 0..2 {
            let ratio = found[i] / reference[i];
            assert!((ratio - 1.0).abs() < tolerance, "{quality:?}: lifts {found:?} for {reference:?}");
        }
        assert!(found[2] < 1.1 * reference[2], "{quality:?}: strain {} for {}", found[2], reference[2]);
    }
}

#[test]
fn cracks_do_not_depend_on_how_bending_is_solved() {
    let settings = quick();
    let run = |quality| {
        let mut film = plate(800, 5, &settings, 250);
        film.quality = quality;
        film.age_to(1.0, &settings, &Environment::default());
        let topology = &film.mesh.topology;
        let torn: Vec<bool> = topology.all_half_edges().map(|h| topology.is_torn(h)).collect();
        (torn, film.forces.separated_age.clone())
    };
    let reference = run(SolverQuality::Reference);
    for quality in [SolverQuality::High, SolverQuality::Default, SolverQuality::Fast] {
        assert!(run(quality) == reference, "{quality:?}");
    }
}

#[test]
fn momentum_makes_up_for_the_sweeps_that_are_left_out() {
    assert_eq!(sweeps_and_momentum(10_000.0, SolverQuality::Reference), (10_000.0, 0.0));
    assert_eq!(sweeps_and_momentum(10_000.0, SolverQuality::High), (10_000.0, 0.0));
    assert_eq!(sweeps_and_momentum(10_000.0, SolverQuality::Default), (2_000.0, 0.8));
    assert_eq!(sweeps_and_momentum(10_000.0, SolverQuality::Fast), (1_000.0, 0.9));
    // Never fewer than a thousand, unless fewer are asked for.
    assert_eq!(sweeps_and_momentum(2_000.0, SolverQuality::Fast), (1_000.0, 0.5));
    assert_eq!(sweeps_and_momentum(200.0, SolverQuality::Default), (200.0, 0.0));
    assert_eq!(sweeps_and_momentum(0.0, SolverQuality::Default), (0.0, 0.0));
}

/// Takes one step, in which nothing falls asleep.
pub(super) fn step_sleepless(film: &mut FilmState, settings: &CoatingSettings) {
    let environment = Environment::default();
    let FilmState { mesh, forces, constraints, stains, clock, quality, changes, scratch } = film;
    stage::begin(clock, changes);
    stage::forces(mesh, forces, stains, clock, settings);
    stage::separate(mesh, forces, clock, changes, settings);
    stage::tear(mesh, forces, changes, settings, environment.gravity, &mut scratch.fracture);
    stage::strip(mesh, forces, clock, changes, settings, &mut scratch.fracture);
    stage::link(mesh, constraints, changes, settings);
    let step = (clock.steps, clock.steps_per_age);
    let sweeps = settings.deform.sweeps_per_age;
    let pace = match settings.scale.grain_of(&mesh.geometry) {
        Some(grain) => SolvePace::of_grain_step(sweeps, grain.in_edges(&mesh.geometry), *quality, step, false),
        None => SolvePace::of_step(sweeps, *quality, step, false),
    };
    deform::bend_film(mesh, constraints, &forces.loose, &settings.deform, pace, changes, &mut scratch.bend);
}

#[test]
fn sleep_changes_no_crack_and_little_shape() {
    let settings = CoatingSettings::from(Preset::Paper);
    for (mesh, seed) in [(plate(1500, 6, &settings, 1000).mesh, 6), (bumpy(), 7)] {
        let mut film = FilmState::from_mesh(mesh, &settings, seed, 1000);
        let mut awake = film.clone();
        let mut slept = 0;
        for (step, compare) in (1..=1000).map(|step| (step, step == 500 || step == 1000)) {
            film.step(&settings, &Environment::default());
            step_sleepless(&mut awake, &settings);
            let count = |film: &FilmState| film.constraints.awake_count();
            slept += count(&awake) - count(&film);
            if !compare {
                continue;
            }
            assert!(film.mesh.topology == awake.mesh.topology, "cracks differ at step {step}");
            let free: Vec<VertexId> = (film.mesh.topology.all_vertices())
                .filter(|&v| film.mesh.topology.has_faces(v) && !film.forces.is_attached(v))
                .collect();
            let distance = |v: &VertexId| {
                f64::from(film.mesh.geometry.positions[v.index()].distance(awake.mesh.geometry.positions[v.index()]))
            };
            let mean = free.iter().map(distance).sum::<f64>() / free.len() as f64;
            assert!(mean <= 0.02 * f64::from(film.mesh.geometry.mean_edge), "{mean} at step {step}");
        }
        assert!(slept > 0, "nothing ever slept");
    }
}

#[test]
fn a_film_that_came_to_rest_sleeps_and_wakes_when_settings_change() {
    let mut settings = CoatingSettings::from(Preset::Paper);
    // No cracks, little curl that is over soon: everything comes to rest.
    settings.tearing.weak_probability = 0.0;
    settings.adhesion.decay = 100.0;
    settings.tearing.contraction_growth = 0.0;
    settings.deform.bend_limit = 0.05;
    let mut film = plate(300, 8, &settings, 100);
    film.age_to(20.0, &settings, &Environment::default());
    film.validate().unwrap();
    assert_eq!(film.constraints.awake_count(), 0, "still awake");
    assert_eq!(film.constraints.active_counts(), [0, 0]);
    assert!(film.constraints.length_count() > 0 && film.constraints.bend_count() > 0);
    let before = film.mesh.geometry.positions.clone();
    film.step(&settings, &Environment::default());
    assert!(!film.changes.moved && film.mesh.geometry.positions == before);
    settings.deform.bend_limit = 0.3;
    for _ in 0..100 {
        film.step(&settings, &Environment::default());
        film.validate().unwrap();
    }
    assert!(film.changes.moved && film.constraints.awake_count() > 100);
    let most = |positions: &[Vec3]| positions.iter().map(|p| p.z).fold(0.0, f32::max);
    assert!(most(&film.mesh.geometry.positions) > 1.5 * most(&before));
}

#[test]
fn a_film_whose_targets_do_not_narrow_sleeps() {
    for rate in [0.0, 1e-9] {
        let mut settings = CoatingSettings::from(Preset::Paper);
        settings.tearing.weak_probability = 0.0;
        settings.adhesion.decay = 100.0;
        settings.tearing.contraction_growth = 0.0;
        settings.deform.narrowing_rate = rate;
        let mut film = plate(300, 8, &settings, 100);
        film.age_to(1.0, &settings, &Environment::default());
        film.validate().unwrap();
        assert!(film.constraints.bend_count() > 0);
        assert_eq!(film.constraints.awake_count(), 0, "still awake at a rate of {rate}");
    }
}

#[test]
fn quality_may_change_under_way() {
    let settings = CoatingSettings::from(Preset::Paper);
    let mut film = plate(400, 9, &settings, 200);
    for step in 0..200 {
        film.quality =
            [SolverQuality::Default, SolverQuality::Reference, SolverQuality::Fast, SolverQuality::High][step / 20 % 4];
        film.step(&settings, &Environment::default());
        film.validate().unwrap_or_else(|e| panic!("step {step}: {e}"));
    }
    assert!(film.measure().lift_p90 > Some(0.5));
}

#[test]
fn films_of_several_regions_hold_their_invariants() {
    let mut settings = CoatingSettings::from(Preset::Paper);
    // Ages fast, so that a few steps see everything.
    settings.adhesion.decay = 4.0;
    settings.tearing.contraction_growth = 4.0;
    let mut film = plate(36_000, 2, &settings, 100);
    for step in 0..25 {
        film.step(&settings, &Environment::default());
        if step % 4 == 0 {
            film.validate().unwrap_or_else(|e| panic!("step {step}: {e}"));
        }
    }
    film.validate().unwrap();
    assert!(film.measure().torn > Some(0.05) && film.measure().lift_p90 > Some(0.1));
}
