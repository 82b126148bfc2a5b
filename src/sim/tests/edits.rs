//! Tests that edits from outside keep every part of a film in step.

use bevy_math::Vec3;

use super::{plate, quick};
use crate::{
    deform::tests::draw::Draw,
    film::{FaceId, FilmMesh, HalfEdgeId, VertexId, tests::grid},
    settings::{CoatingSettings, Preset},
    sim::state::FilmState,
    stain::Environment,
};

#[test]
fn random_tears_and_strips_between_steps_keep_every_invariant() {
    for seed in 1..=6u64 {
        let mut settings = quick();
        settings.stripping.fall_faces = seed as u32 % 3 * 5;
        let environment = Environment::default();
        let mut draw = Draw(seed);
        let mut film = plate(300, seed, &settings, 60);
        let (mut tears, mut strips) = (0, 0);
        for step in 0..60 {
            for _ in 0..draw.below(4) {
                let topology = &film.mesh.topology;
                let h = HalfEdgeId(draw.below(topology.half_edge_count() as u32 + 3));
                let f = FaceId(draw.below(topology.face_count() as u32 + 3));
                let torn = topology.removed_face_count();
                if draw.below(3) > 0 {
                    tears += u32::from(film.tear_edge(h, &settings, &environment));
                } else if film.strip_face(f, &settings, &environment) {
                    assert!(!film.mesh.topology.is_live(f) && film.mesh.topology.removed_face_count() > torn);
                    strips += 1;
                }
                film.validate().unwrap_or_else(|error| panic!("seed {seed}, step {step}: {error}"));
            }
            film.step(&settings, &environment);
            film.validate().unwrap_or_else(|error| panic!("seed {seed}, after step {step}: {error}"));
        }
        assert!(tears > 10 && strips > 5, "{tears} tears, {strips} strips");
    }
}

#[test]
fn every_face_can_be_stripped_one_after_the_other() {
    let settings = quick();
    let (positions, triangles) = grid(3, 3);
    for fall_faces in [0, 6] {
        let mut settings = settings.clone();
        settings.stripping.fall_faces = fall_faces;
        let mesh = FilmMesh::new(positions.clone(), &triangles).unwrap();
        let mut film = FilmState::from_mesh(mesh, &settings, 1, 50);
        for f in film.mesh.topology.all_faces() {
            film.strip_face(f, &settings, &Environment::default());
            film.validate().unwrap_or_else(|error| panic!("{f:?}: {error}"));
            film.step(&settings, &Environment::default());
        }
        assert_eq!(film.mesh.topology.removed_face_count(), triangles.len());
        assert_eq!(film.constraints.length_count(), 0);
    }
}

#[test]
fn a_blow_looks_like_a_crack_and_reports_what_happened() {
    let settings = CoatingSettings::from(Preset::Paper);
    let environment = Environment::default();
    let mut film = plate(300, 1, &settings, 100);
    let edge = film.mesh.topology.all_edges().find(|&h| film.mesh.topology.bound_twin(h).is_some()).unwrap();
    assert!(film.tear_edge(edge, &settings, &environment));
    assert!(!film.tear_edge(edge, &settings, &environment), "torn already");
    assert!(!film.tear_edge(HalfEdgeId(u32::MAX - 1), &settings, &environment), "there is no such edge");
    assert!(!film.strip_face(FaceId(u32::MAX / 3), &settings, &environment), "there is no such face");
    assert_eq!((film.changes.torn.as_slice(), film.changes.separated.len()), (&[edge][..], 2));
    assert_eq!(film.forces.torn_edges, 1);
    let kept = settings.tearing.contraction_kept * settings.tearing.contraction;
    assert!((film.forces.contraction(edge.face()) - kept).abs() < 1e-6);
    let ends: Vec<VertexId> = film.changes.separated.clone();
    assert!(ends.iter().all(|&v| film.forces.separated_age[v.index()] == 0.0));
    film.age_to(0.5, &settings, &environment);
    film.validate().unwrap();
}

#[test]
fn a_piece_that_waits_to_fall_may_be_stripped_by_hand() {
    let (settings, environment) = (CoatingSettings::default(), Environment::default());
    let corners = vec![Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y];
    let mesh = FilmMesh::new(corners, &[[0, 1, 2], [0, 2, 3]]).unwrap();
    let mut film = FilmState::from_mesh(mesh, &settings, 7, 1000);
    assert!(film.tear_edge(HalfEdgeId(2), &settings, &environment));
    assert!(film.mesh.topology.all_vertices().all(|v| !film.forces.is_attached(v)), "both hang loose");
    assert!(film.strip_face(FaceId(0), &settings, &environment));
    assert!(!film.mesh.topology.is_live(FaceId(0)) && film.mesh.topology.is_live(FaceId(1)));
    film.validate().unwrap();
}
