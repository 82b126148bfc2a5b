//! Tests that forces follow settings that change, and keep what became of them.

use bevy_math::Vec3;

use super::{Tearing, edge_between, lattice};
use crate::{
    film::{FaceId, FilmMesh, VertexId, tests::grid},
    fracture::{adhesion::adhesion_at, aging::age_forces, forces::FilmForces},
    settings::{CoatingSettings, Preset},
};

#[test]
fn a_fresh_film_that_follows_settings_is_one_that_was_made_with_them() {
    let (positions, triangles) = grid(12, 12);
    let mesh = FilmMesh::new(positions, &triangles).unwrap();
    let changes: [fn(&mut CoatingSettings); 8] = [
        |settings| settings.adhesion.mean = 1.3,
        |settings| settings.adhesion.deviation = 0.1,
        |settings| settings.adhesion.octaves = 4,
        |settings| settings.adhesion.frequency = 9.0,
        |settings| settings.tearing.contraction = 1.7,
        |settings| settings.tearing.binding = 4.0,
        |settings| settings.tearing.weak_probability = 0.2,
        |settings| settings.tearing.weak_factor = 0.3,
    ];
    let before = CoatingSettings::from(Preset::Paper);
    for (i, change) in changes.into_iter().enumerate() {
        let mut after = before.clone();
        change(&mut after);
        let mut forces = FilmForces::new(&mesh, &before, 5);
        let made = FilmForces::new(&mesh, &after, 5);
        assert!(forces != made, "change {i} changes nothing");
        forces.follow_settings(&mesh, &after);
        assert!(forces == made, "change {i}");
        forces.follow_settings(&mesh, &before);
        assert!(forces == FilmForces::new(&mesh, &before, 5), "change {i}, there and back");
    }
}

#[test]
fn what_is_drawn_for_a_part_is_what_was_drawn_there_for_all() {
    let (positions, triangles) = grid(12, 12);
    let mesh = FilmMesh::new(positions.clone(), &triangles).unwrap();
    for preset in [Preset::Paper, Preset::Default] {
        let mut settings = CoatingSettings::from(preset);
        (settings.tearing.weak_probability, settings.scale.grain) = (0.3, 1.5);
        let mut forces = FilmForces::new(&mesh, &settings, 5);
        assert_eq!(forces.grain().is_some(), preset == Preset::Default);
        let some = || mesh.topology.all_edges().filter(|h| h.0 % 7 < 3);
        let (mut weak, mut count) = (0, 0);
        forces.draw_fresh_bindings(&mesh, &settings.tearing, some(), |forces, h, binding| {
            assert_eq!(forces.bindings[h.index()], binding, "{h:?} by {preset:?}");
            weak += usize::from(binding.drawn < settings.tearing.binding);
            count += 1;
        });
        assert!(count == some().count() && weak > 10 && weak < count - 10, "{weak} of {count}");

        let places = positions.iter().copied().step_by(5);
        let adhesion = adhesion_at(&positions, places, &settings.adhesion, forces.grain(), 5);
        let all = mesh.topology.all_vertices().step_by(5);
        assert!(adhesion.eq(all.map(|v| forces.adhesion(v))));
    }
}

#[test]
fn what_was_lost_stays_lost_and_what_was_set_by_hand_stays() {
    let mut film = Tearing::on(lattice(6));
    let torn = edge_between(&film.mesh, 24, 25);
    let beside = torn.next();
    film.bind(torn, 0.1);
    assert_eq!(film.step(), [torn]);
    let moisture = vec![0.5; film.mesh.topology.vertex_count()];
    age_forces(&film.mesh, &mut film.forces, &film.settings, &moisture, 0.25);
    let by_hand = (VertexId(3), FaceId(2), edge_between(&film.mesh, 0, 1));
    film.forces.set_adhesion(by_hand.0, 7.0);
    film.forces.set_contraction(&film.mesh.topology, by_hand.1, 0.4);
    film.bind(by_hand.2, 9.0);
    let before = film.forces.clone();
    film.settings.adhesion.mean += 1.0;
    film.settings.adhesion.deviation = 0.0;
    film.settings.tearing.contraction = 2.0;
    film.settings.tearing.binding = 12.0;
    film.forces.follow_settings(&film.mesh, &film.settings);
    let (topology, forces) = (&film.mesh.topology, &film.forces);

    // Mean 3.1, less 0.25 with age and half of that again where it was wet.
    assert!((forces.adhesion(VertexId(0)) - (3.1 - 0.25 - 0.125)).abs() < 1e-6);
    // The face beside the tear keeps 0.3 of twice the initial contraction, and all have gained 0.25.
    assert!((forces.contraction(torn.face()) - (0.3 * 2.0 + 0.25)).abs() < 1e-6);
    assert!((forces.contraction(FaceId(0)) - 2.25).abs() < 1e-6);
    // The edge beside the tear keeps its share of twice the binding.
    assert!((forces.binding(topology, beside) / before.binding(topology, beside) - 2.0).abs() < 1e-6);
    assert!(forces.binding(topology, beside) < 12.0);
    assert!(topology.is_torn(torn) && forces.binding(topology, torn) == before.binding(topology, torn));

    assert_eq!(forces.adhesion(by_hand.0), 7.0);
    assert_eq!(forces.contraction(by_hand.1), before.contraction(by_hand.1));
    assert_eq!(forces.binding(topology, by_hand.2), 9.0);
}

#[test]
fn duplicates_follow_like_their_originals() {
    let mut film = Tearing::on(lattice(6));
    film.bind(edge_between(&film.mesh, 23, 24), 0.01);
    film.bind(edge_between(&film.mesh, 24, 25), 0.01);
    film.settings.tearing.contraction_kept = 1.0;
    film.step();
    film.step();
    let topology = film.mesh.topology.clone();
    assert!(topology.vertex_count() > topology.original_vertex_count());
    film.settings.adhesion.frequency = 2.0;
    film.forces.follow_settings(&film.mesh, &film.settings);
    for v in topology.all_vertices() {
        assert_eq!(film.forces.adhesion(v), film.forces.adhesion(topology.original(v)));
    }
    film.forces.validate(&topology).unwrap();
    film.mesh.tear(edge_between(&film.mesh, 8, 9), Vec3::NEG_Y).unwrap();
}
