//! Compares stages that judge only what is due with stages that judge everything.

use bevy_math::Vec3;
use proptest::prelude::*;

use super::{lattice, separate_all};
use crate::{
    film::{FaceId, FilmChanges, FilmMesh, HalfEdgeId, VertexId, tests::any_mesh},
    fracture::{
        aging::age_forces,
        forces::FilmForces,
        predictions::Predictions,
        scratch::FractureScratch,
        separation::{bending_force, separate},
        stripping::strip,
        tearing::{tear, tear_everywhere},
    },
    remesh::sample,
    settings::{CoatingSettings, Preset, Rules},
};

/// A film, and a second one of the same kind that discards its predictions now and then.
struct Pair {
    mesh: FilmMesh,
    forces: FilmForces,
    changes: FilmChanges,
    scratch: FractureScratch,
    other: (FilmMesh, FilmForces),
}

/// A change from outside before a step.
#[derive(Clone, Debug)]
enum Event {
    Nothing,
    /// One of the settings changes. The second value is a share of the range that is tried here.
    Setting(u8, f32),
    /// Moisture comes in a pattern, or goes.
    Moisture(Option<u32>),
    Adhesion(u32, f32),
    Binding(u32, f32),
    Contraction(u32, f32),
    /// The second film discards its predictions.
    Forget,
}

fn any_event() -> impl Strategy<Value = Event> {
    prop_oneof![
        20 => Just(Event::Nothing),
        1 => (any::<u8>(), 0.0f32..1.0).prop_map(|(which, share)| Event::Setting(which, share)),
        1 => prop::option::of(any::<u32>()).prop_map(Event::Moisture),
        1 => (any::<u32>(), 0.0f32..3.0).prop_map(|(v, force)| Event::Adhesion(v, force)),
        1 => (any::<u32>(), 0.0f32..8.0).prop_map(|(h, force)| Event::Binding(h, force)),
        1 => (any::<u32>(), 0.0f32..2.0).prop_map(|(f, force)| Event::Contraction(f, force)),
        1 => Just(Event::Forget),
    ]
}

fn any_film() -> impl Strategy<Value = FilmMesh> {
    prop_oneof![
        any_mesh(),
        (50u32..400, any::<u64>()).prop_map(|(triangles, seed)| {
            let film = sample::plate(triangles, seed).unwrap().film;
            FilmMesh::new(film.positions, &film.triangles).unwrap()
        }),
    ]
}

/// Sets one of the settings that fracture depends on.
fn set(settings: &mut CoatingSettings, which: u8, share: f32) {
    let tearing = &mut settings.tearing;
    let (setting, max) = match which % 24 {
        0 => (&mut settings.adhesion.decay, 3.0),
        1 => (&mut settings.bending.gain, 0.6),
        2 => (&mut settings.bending.gamma, 6.0),
        3 => (&mut tearing.contraction_growth, 2.0),
        4 => (&mut tearing.contraction_kept, 1.0),
        5 => (&mut tearing.binding_decay, 6.0),
        6 => (&mut tearing.alpha, 0.9),
        7 => (&mut tearing.beta, 1.0),
        8 => (&mut settings.moisture.adhesion, 4.0),
        9 => {
            settings.stripping.fall_faces = (share * 20.0) as u32;
            return;
        }
        10 => (&mut settings.adhesion.mean, 3.0),
        11 => (&mut settings.adhesion.deviation, 2.0),
        12 => (&mut tearing.contraction, 2.0),
        13 => (&mut tearing.binding, 8.0),
        14 => (&mut tearing.weak_probability, 0.3),
        15 => (&mut tearing.weak_factor, 1.0),
        16 => (&mut tearing.relief, 1.0),
        17 => (&mut tearing.relief_reach, 3.0),
        18 => (&mut tearing.memory, 10.0),
        19 => (&mut settings.stripping.hold, 0.2),
        20 => (&mut settings.stripping.hold_area, 10.0),
        21 => (&mut tearing.neck_width, 3.0),
        22 => {
            settings.scale.rules = if share < 0.3 { Rules::Paper } else { Rules::Grain };
            settings.scale.grain = 0.02 + share;
            return;
        }
        // Back to the start, so that settings do not stay extreme.
        _ => {
            *settings = CoatingSettings::from(Preset::Paper);
            return;
        }
    };
    *setting = share * max;
}

impl Pair {
    fn new(mesh: FilmMesh, settings: &CoatingSettings, seed: u64) -> Self {
        let forces = FilmForces::new(&mesh, settings, seed);
        Self {
            other: (mesh.clone(), forces.clone()),
            mesh,
            forces,
            changes: FilmChanges::default(),
            scratch: FractureScratch::default(),
        }
    }

    /// Changes both films.
    fn edit(&mut self, edit: impl Fn(&FilmMesh, &mut FilmForces)) {
        edit(&self.mesh, &mut self.forces);
        edit(&self.other.0, &mut self.other.1);
    }

    fn step(&mut self, settings: &CoatingSettings, moisture: &[f32], age: f32, dt: f32) {
        self.edit(|mesh, forces| age_forces(mesh, forces, settings, moisture, dt));
        let Self { mesh, forces, changes, scratch, other } = self;
        changes.clear();
        let gain = settings.bending.gain;
        let separates = |v: &VertexId| {
            let held = forces.is_attached(*v) && mesh.topology.has_faces(*v);
            held && bending_force(mesh, forces, *v, gain) > forces.adhesion(*v)
        };
        let expected: Vec<VertexId> = mesh.topology.all_vertices().filter(separates).collect();
        separate(mesh, forces, settings, age, changes);
        assert_eq!(changes.separated, expected);

        let (mut all_mesh, mut all_forces, mut all_changes) = (mesh.clone(), forces.clone(), changes.clone());
        let gravity = Vec3::new(0.6, -0.8, 0.0);
        tear_everywhere(&mut all_mesh, &mut all_forces, &settings.tearing, gravity, &mut all_changes, scratch);
        tear(mesh, forces, &settings.tearing, gravity, changes, scratch);
        assert_eq!(*changes, all_changes);
        assert!(*mesh == all_mesh && *forces == all_forces);

        strip(mesh, forces, &settings.stripping, age, changes, scratch);
        mesh.validate().unwrap();
        forces.validate(&mesh.topology).unwrap();

        let (other_mesh, other_forces) = other;
        let (mut other_changes, mut other_scratch) = (FilmChanges::default(), FractureScratch::default());
        separate(other_mesh, other_forces, settings, age, &mut other_changes);
        tear(other_mesh, other_forces, &settings.tearing, gravity, &mut other_changes, &mut other_scratch);
        strip(other_mesh, other_forces, &settings.stripping, age, &mut other_changes, &mut other_scratch);
        assert_eq!(*changes, other_changes);
        assert!(mesh == other_mesh && forces == other_forces);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    #[test]
    fn events_happen_only_where_they_are_due(
        mesh in any_film(),
        seed in any::<u64>(),
        (dt, weak, binding) in (prop_oneof![Just(0.004f32), Just(0.02), 1e-5f32..0.05], 0.0f32..0.1, 2.0f32..7.0),
        events in prop::collection::vec(any_event(), 100..400),
    ) {
        let mut settings = CoatingSettings::from(Preset::Paper);
        settings.tearing.weak_probability = weak;
        settings.tearing.binding = binding;
        let mut film = Pair::new(mesh, &settings, seed);
        let mut wet = None;
        for (step, event) in events.into_iter().enumerate() {
            let topology = film.mesh.topology.clone();
            let vertices = topology.vertex_count();
            match event {
                Event::Nothing => {}
                Event::Setting(which, share) => set(&mut settings, which, share),
                Event::Moisture(pattern) => wet = pattern,
                Event::Adhesion(v, force) => {
                    film.edit(|_, forces| forces.set_adhesion(VertexId(v % vertices as u32), force));
                }
                Event::Binding(h, force) => {
                    let h = HalfEdgeId(h % topology.half_edge_count() as u32);
                    film.edit(|_, forces| forces.set_binding(&topology, h, force));
                }
                Event::Contraction(f, force) => {
                    let f = FaceId(f % topology.face_count() as u32);
                    film.edit(|_, forces| forces.set_contraction(&topology, f, force));
                }
                Event::Forget => film.other.1.touch_all(),
            }
            let moisture: Vec<f32> = wet.map_or(Vec::new(), |pattern: u32| {
                (0..vertices).map(|i| ((pattern >> (i % 32)) % 4) as f32 / 3.0).collect()
            });
            film.step(&settings, &moisture, step as f32 * dt, dt);
        }
    }
}

/// Ages a plate of 1,000 triangles by 1. Returns how often vertices and edges were judged, and the film.
fn judged_in_a_run(settings: &CoatingSettings, steps: u32) -> ([u64; 2], FilmForces, FilmMesh) {
    let film = sample::plate(1000, 3).unwrap().film;
    let mut mesh = FilmMesh::new(film.positions, &film.triangles).unwrap();
    let mut forces = FilmForces::new(&mesh, settings, 3);
    let (mut changes, mut scratch) = (FilmChanges::default(), FractureScratch::default());
    for step in 1..=steps {
        changes.clear();
        age_forces(&mesh, &mut forces, settings, &[], 1.0 / steps as f32);
        separate(&mesh, &mut forces, settings, step as f32 / steps as f32, &mut changes);
        tear(&mut mesh, &mut forces, &settings.tearing, Vec3::NEG_Y, &mut changes, &mut scratch);
        strip(&mut mesh, &mut forces, &settings.stripping, step as f32 / steps as f32, &mut changes, &mut scratch);
    }
    let Predictions { separations, tears, .. } = &forces.predictions;
    ([separations.judged, tears.judged], forces, mesh)
}

#[test]
fn work_depends_on_events_and_not_on_steps() {
    for steps in [1000, 10_000] {
        let ([vertices, edges], forces, mesh) = judged_in_a_run(&CoatingSettings::from(Preset::Paper), steps);
        assert!(forces.torn_edges > 100);
        let originals = mesh.topology.original_vertex_count() as u64;
        assert!(vertices < 3 * originals, "{vertices} judgements of {originals} vertices in {steps} steps");
        // There are 1,500 edges, and every tear makes about ten around it due.
        let expected = 2 * mesh.topology.all_edges().count() as u64 + 15 * u64::from(forces.torn_edges);
        assert!(edges < expected, "{edges} judgements of edges in {steps} steps with {} tears", forces.torn_edges);
    }
}

#[test]
fn a_film_to_which_nothing_can_happen_is_judged_once() {
    let mut settings = CoatingSettings::from(Preset::Paper);
    settings.adhesion.mean = 50.0;
    let ([vertices, edges], _, mesh) = judged_in_a_run(&settings, 1000);
    let all = mesh.topology.original_vertex_count() as u64;
    assert_eq!([vertices, edges], [all, mesh.topology.all_edges().count() as u64]);
}

#[test]
fn infinite_forces_never_give_way() {
    let mut settings = CoatingSettings::from(Preset::Paper);
    settings.adhesion.mean = 0.0;
    settings.tearing.contraction = 50.0;
    let mesh = lattice(6);
    let mut film = Pair::new(mesh, &settings, 1);
    let held = VertexId(24);
    film.edit(|mesh, forces| {
        forces.set_adhesion(held, f32::INFINITY);
        mesh.topology.fan(VertexId(10)).for_each(|h| forces.set_binding(&mesh.topology, h, f32::INFINITY));
    });
    for step in 0..50 {
        film.step(&settings, &[], step as f32, 0.1);
    }
    assert!(film.forces.is_attached(held) && film.forces.torn_edges > 50);
    assert!(film.mesh.topology.fan(VertexId(10)).all(|h| !film.mesh.topology.is_torn(h)));
}

/// The steps are so small that forces change by the last places of their numbers. No event may come late because a
/// prediction was rounded the wrong way.
#[test]
fn rounding_makes_no_event_late() {
    let mut settings = CoatingSettings::from(Preset::Paper);
    settings.tearing.weak_probability = 0.0;
    // In older films the amounts that are counted once for the whole film are larger.
    for (dt, age, wet) in [(1e-6, 0.0f32, false), (2e-7, 1.0, false), (2e-7, 8.0, true)] {
        for tears in [false, true] {
            let mut film = Pair::new(lattice(20), &settings, 0);
            let share = |i: u32| 600.0 * dt * (i * 193 % 1009) as f32 / 1009.0;
            film.edit(|mesh, forces| {
                age_forces(mesh, forces, &settings, &[], age);
                mesh.topology.all_faces().for_each(|f| forces.set_contraction(&mesh.topology, f, 1.1));
                for v in mesh.topology.all_vertices() {
                    forces.set_adhesion(v, bending_force(mesh, forces, v, settings.bending.gain) + share(v.0));
                }
                for h in mesh.topology.all_edges() {
                    forces.set_binding(&mesh.topology, h, if tears { 2.2 + share(h.0) } else { 100.0 });
                }
                if tears {
                    separate_all(forces);
                }
            });
            let moisture = if wet { vec![0.7; 2000] } else { Vec::new() };
            for step in 0..300 {
                film.step(&settings, &moisture, step as f32, dt);
            }
            let topology = &film.mesh.topology;
            let separated = topology.all_vertices().filter(|&v| !film.forces.is_attached(v)).count();
            assert!(separated > topology.vertex_count() / 2, "{separated}");
            assert_eq!(film.forces.torn_edges > 100, tears, "{}", film.forces.torn_edges);
        }
    }
}
