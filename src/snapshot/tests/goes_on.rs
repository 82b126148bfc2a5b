//! Restore and continue: the same as never having stopped.

use std::thread;

use bevy_math::Vec3;
use proptest::prelude::*;

use super::{parts::first_difference, plate};
use crate::{
    deform::SolverQuality,
    film::{FaceId, FilmMesh, HalfEdgeId, VertexId},
    settings::{CoatingSettings, Preset},
    sim::FilmState,
    snapshot::Snapshot,
    stain::{Environment, Exposure},
};

/// Weather of several kinds.
fn weather(kind: usize) -> Environment {
    let still = Environment::still(Vec3::new(0.6, -0.8, 0.0));
    match kind % 4 {
        0 => Environment::default(),
        1 => still,
        2 => Environment { rain: Vec3::NEG_Y, wind: Vec3::X * 0.5, gusts: 0.3, ..still },
        _ => Environment { sun: Vec3::new(0.0, -0.6, -0.8), rain: Vec3::new(0.0, -0.5, -0.2), ..still },
    }
}

/// A film of several kinds: plates by both rules, a sphere without a border, a film of loose triangles.
fn film(kind: usize, settings: &CoatingSettings, seed: u64, steps_per_age: u32) -> FilmState {
    match kind % 3 {
        0 => plate(400, settings, seed, steps_per_age),
        1 => {
            let (positions, triangles) = crate::film::tests::sphere(2);
            let mesh = FilmMesh::new(positions, &triangles).expect("a manifold");
            FilmState::from_mesh(mesh, settings, seed, steps_per_age)
        }
        _ => {
            let corners: Vec<Vec3> =
                (0..60).map(|i| Vec3::new((i / 3) as f32, (i % 3 / 2) as f32, (i % 3 % 2) as f32)).collect();
            let triangles: Vec<[u32; 3]> = (0..20).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
            FilmState::from_mesh(FilmMesh::new(corners, &triangles).expect("a manifold"), settings, seed, steps_per_age)
        }
    }
}

/// Takes steps, with an edit now and then.
fn age(film: &mut FilmState, steps: u64, settings: &CoatingSettings, environment: &Environment, edits: bool) {
    for _ in 0..steps {
        let n = film.clock.steps as u32;
        if edits && n % 17 == 5 {
            let faces = film.mesh.topology.face_count() as u32;
            film.strip_face(FaceId(n * 31 % faces), settings, environment);
            film.tear_edge(HalfEdgeId(n * 97 % (3 * faces)), settings, environment);
            film.forces.set_adhesion(VertexId(n % 40), f32::INFINITY);
            film.forces.set_binding(&film.mesh.topology, HalfEdgeId(n % 40), 0.5);
            film.forces.set_contraction(&film.mesh.topology, FaceId(n % 20), 1.5);
        }
        film.step(settings, environment);
    }
}

/// Returns the part in which a film that was saved and restored differs first, right away or after more steps.
fn difference_after(
    mut film: FilmState,
    steps: [u64; 2],
    settings: [&CoatingSettings; 2],
    weathers: [Environment; 2],
    edits: bool,
) -> Option<&'static str> {
    age(&mut film, steps[0], settings[0], &weathers[0], edits);
    let saved = Snapshot::of(&film).expect("a snapshot");
    // Restoring on the fresh mesh and on the torn one is the same.
    let restored = saved.restore(&film.mesh.at_rest().expect("a manifold")).expect("the same film");
    if let Some(part) = first_difference(&restored, &film) {
        return Some(part);
    }
    assert_eq!(Snapshot::of(&restored).expect("a snapshot"), saved, "the same bytes for the same state");
    // Each goes on on a thread of its own.
    let settings = settings[1].clone();
    let [film, restored] = thread::scope(|scope| {
        let settings = &settings;
        [film, restored]
            .map(|mut film| {
                scope.spawn(move || {
                    age(&mut film, steps[1], settings, &weathers[1], edits);
                    film
                })
            })
            .map(|thread| thread.join().expect("no panic"))
    });
    restored.validate().expect("a film in order");
    first_difference(&restored, &film)
}

/// A sixth of the cases that are asked for: each ages a film.
fn config() -> ProptestConfig {
    let asked = ProptestConfig::default();
    ProptestConfig { cases: (asked.cases / 6).max(1), failure_persistence: None, ..asked }
}

proptest! {
    #![proptest_config(config())]

    #[test]
    fn a_restored_film_goes_on_as_it_would_have(
        (kind, seed, per_age) in (0usize..3, 0u64..1000, prop::sample::select(vec![60u32, 100, 250, 1000])),
        share in 0.0f64..1.3,
        more in 1u64..60,
        presets in (0usize..6, 0usize..6),
        changes in any::<bool>(),
        edits in any::<bool>(),
        quality in 0usize..4,
        weathers in (0usize..4, 0usize..4),
    ) {
        let settings = [presets.0, if changes { presets.1 } else { presets.0 }]
            .map(|preset| {
                let mut settings = CoatingSettings::from(Preset::ALL[preset % Preset::ALL.len()]);
                settings.scale.grain = 0.08;
                settings.deform.sweeps_per_age = 2000.0;
                settings
            });
        let mut film = film(kind, &settings[0], seed, per_age);
        film.quality = SolverQuality::ALL[quality];
        if seed % 3 == 0 {
            film.stains.exposure = Exposure { rain: vec![0.25; 30], sun: (0..20).map(|i| i as f32 / 20.0).collect() };
        }
        let steps = (share * f64::from(per_age.min(250))) as u64;
        let weathers = [weather(weathers.0), weather(weathers.1)];
        let found = difference_after(film, [steps, more], [&settings[0], &settings[1]], weathers, edits);
        prop_assert_eq!(found, None);
    }
}

#[test]
fn the_running_film_is_put_back() {
    let (settings, environment) = (CoatingSettings::default(), Environment::default());
    let mut film = plate(300, &settings, 3, 100);
    film.age_to(0.5, &settings, &environment);
    let (saved, digest) = (Snapshot::of(&film).expect("a snapshot"), film.digest());
    film.age_to(1.0, &settings, &environment);
    film.restore(&saved).expect("the same film");
    assert_eq!(film.digest(), digest);
    assert!(saved.is_of(&film.mesh) && !saved.is_of(&plate(300, &settings, 4, 100).mesh));
}

#[test]
fn the_first_part_that_differs_is_named() {
    let settings = CoatingSettings::default();
    let film = plate(100, &settings, 3, 100);
    let changes: [(&str, fn(&mut FilmState)); 5] = [
        ("clock", |film| film.clock.steps = 1),
        ("positions", |film| film.mesh.geometry.positions[3].z = 0.1),
        ("forces", |film| film.forces.set_adhesion(VertexId(1), 0.5)),
        ("stains of the metal", |film| film.stains.metal.dust[1] = 0.5),
        ("streaks", |film| film.stains.streaks = Vec3::X),
    ];
    assert_eq!(first_difference(&film, &film), None);
    for (part, change) in changes {
        let mut changed = film.clone();
        change(&mut changed);
        assert_eq!(first_difference(&film, &changed), Some(part));
    }
}
