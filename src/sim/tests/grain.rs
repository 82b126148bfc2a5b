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
    let (mut fell, mut seen) = (0, 0);
    for seed in 1..=3 {
        let (mut film, settings) = fine(seed, 500);
        let held = (settings.stripping.hold * 500.0) as u64;
        let mut since = vec![u64::MAX; film.mesh.topology.face_count()];
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
        assert_eq!(film.measure().loose_pieces, film.forces.loose.iter().count() as u64);
    }
    assert!(seen > 100 && fell > 15, "{seen} and {fell}");
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
fn a_film_whose_targets_stand_still_comes_to_rest() {
    let mut asleep = 0;
    for steps_per_age in [250, 1000, 4000] {
        let (mut film, settings) = stopped(steps_per_age);
        let begin = motion(&mut film, &settings);
        assert!(begin > 1e-3 && film.constraints.awake_count() > 100, "{steps_per_age}: {begin}");
        let mut most = |ticks: u32| (0..ticks).map(|_| motion(&mut film, &settings)).fold(0.0, f32::max);
        let (first, last) = (most(300), most(100));
        assert!(first < 3.0 * begin, "{steps_per_age}: it moves by {first}, after {begin}");
        assert!(last < 0.2 * begin, "{steps_per_age}: it still moves by {last}, after {begin}");
        asleep += usize::from(film.constraints.awake_count() == 0);

        // A blow wakes what lies beside it, and does not ring.
        let topology = &film.mesh.topology;
        let free = |h: &crate::film::HalfEdgeId| {
            let ends = [topology.origin(*h), topology.target(*h)];
            topology.bound_twin(*h).is_some() && ends.iter().all(|&v| !film.forces.is_attached(v))
        };
        let edge = topology.all_edges().filter(free).nth(20).unwrap();
        assert!(film.tear_edge(edge, &settings, &Environment::default()));
        let mut most = || (0..100).map(|_| motion(&mut film, &settings)).fold(0.0, f32::max);
        let (blow, after) = (most(), most());
        assert!(blow < 1.0 && after < 0.1 && after < blow, "{steps_per_age}: it moves by {blow}, then by {after}");
        film.validate().unwrap();
    }
    assert!(asleep > 0, "no film fell asleep");
}
