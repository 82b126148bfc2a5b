//! Tests whole runs by the grain: nothing floats, and curls of fine films, which momentum pays for, come to rest.

use super::*;

/// A film whose mean edge is half its grain.
fn fine(seed: u64, steps_per_age: u32) -> (FilmState, CoatingSettings) {
    let mut settings = CoatingSettings::default();
    settings.scale.grain = 0.08;
    (plate(1500, seed, &settings, steps_per_age), settings)
}

#[test]
fn no_piece_floats_longer_than_it_is_held() {
    for seed in 1..=3 {
        let (mut film, settings) = fine(seed, 500);
        let held = (settings.stripping.hold * 500.0) as u64;
        let mut since = vec![u64::MAX; film.mesh.topology.face_count()];
        let (mut fell, mut seen) = (0, 0);
        for step in 0..600 {
            film.step(&settings, &Environment::default());
            for piece in film.forces.loose.iter() {
                seen += 1;
                for f in piece.faces {
                    let since = &mut since[f.index()];
                    *since = step.min(*since);
                    assert!(step - *since <= held, "seed {seed}: {f:?} has floated for {} steps", step - *since);
                }
            }
            fell += film.changes.debris.len();
        }
        assert!(seen > 100 && fell > 10, "{seen} and {fell}");
        assert_eq!(film.measure().loose_pieces, film.forces.loose.iter().count() as u64);
    }
}

/// Ages a film until it has cracked, and then keeps forces and targets as they are.
fn stopped(steps_per_age: u32) -> (FilmState, CoatingSettings) {
    let (mut film, mut settings) = fine(2, steps_per_age);
    film.age_to(0.8, &settings, &Environment::default());
    settings.adhesion.decay = 0.0;
    settings.tearing.contraction_growth = 0.0;
    settings.tearing.binding_decay = 0.0;
    settings.deform.narrowing_rate = 0.0;
    settings.stripping.hold_area = 0.0;
    (film, settings)
}

/// Returns the farthest way that a vertex moves in the next tick, in mean edges.
fn motion(film: &mut FilmState, settings: &CoatingSettings) -> f32 {
    let before = film.mesh.geometry.positions.clone();
    film.age_to(film.clock.age() + 0.01, settings, &Environment::default());
    let moved = before.iter().zip(&film.mesh.geometry.positions).map(|(a, b)| a.distance(*b));
    moved.fold(0.0, f32::max) / film.mesh.geometry.mean_edge
}

#[test]
fn a_film_whose_targets_stand_still_comes_to_rest_and_sleeps() {
    for steps_per_age in [250, 1000, 4000] {
        let (mut film, settings) = stopped(steps_per_age);
        let begin = motion(&mut film, &settings);
        assert!(begin > 1e-3 && film.constraints.awake_count() > 100, "{steps_per_age}: {begin}");
        let (mut last, mut most) = (begin, begin);
        for _ in 0..30 {
            for _ in 0..9 {
                most = motion(&mut film, &settings).max(most);
            }
            last = motion(&mut film, &settings);
            film.validate().unwrap();
        }
        assert!(most < 3.0 * begin, "{steps_per_age}: it moves by {most}, after {begin}");
        assert!(last < 0.1 * begin, "{steps_per_age}: it still moves by {last}, after {begin}");
        let awake = film.constraints.awake_count() as f32 / film.mesh.topology.vertex_count() as f32;
        assert!(awake < 0.1, "{steps_per_age}: {awake} of the film is awake");

        // A blow wakes what lies beside it, which comes to rest again and does not ring through the film.
        let topology = &film.mesh.topology;
        let free = |h: &crate::film::HalfEdgeId| {
            let ends = [topology.origin(*h), topology.target(*h)];
            topology.bound_twin(*h).is_some() && ends.iter().all(|&v| !film.forces.is_attached(v))
        };
        let edge = topology.all_edges().filter(free).nth(20).unwrap();
        let before = film.mesh.geometry.positions.clone();
        assert!(film.tear_edge(edge, &settings, &Environment::default()));
        let blow: f32 = (0..100).map(|_| motion(&mut film, &settings)).fold(0.0, f32::max);
        assert!(blow < 0.5, "{steps_per_age}: a blow moves it by {blow} in a tick");
        let far = before.iter().zip(&film.mesh.geometry.positions).filter(|(a, b)| a.distance(**b) > 1e-3).count();
        assert!(far < before.len() / 4, "{steps_per_age}: a blow moves {far} of {} vertices", before.len());
        film.validate().unwrap();
    }
}

#[test]
fn film_by_the_grain_curls_less_of_itself_than_by_the_paper() {
    // Most of what has separated is held all around; by the paper's rules all of it bends.
    let share = |settings: &CoatingSettings| {
        let mut film = plate(1500, 1, settings, 500);
        film.age_to(0.6, settings, &Environment::default());
        let [lengths, bends] = film.constraints.active_counts();
        (lengths + bends) as f32 / (film.constraints.length_count() + film.constraints.bend_count()) as f32
    };
    let (_, by_grain) = fine(1, 500);
    let (grain, paper) = (share(&by_grain), share(&CoatingSettings::from(Preset::Paper)));
    assert!(grain < 0.9 * paper, "{grain} of the constraints are active, {paper} by the paper's rules");
}
