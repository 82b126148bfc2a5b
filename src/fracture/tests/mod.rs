//! Tests each equation and rule of the fracture stages against an independent derivation.

mod follow;
mod grain;
mod necks;
mod predictions;

use core::f32::consts::PI;

use bevy_math::Vec3;

use super::{
    aging::age_forces,
    forces::FilmForces,
    scratch::FractureScratch,
    separation::{bending_force, separate, separation_age},
    sigmoid::sigmoid,
    stripping::strip,
    tearing::tear,
};
use crate::{
    film::{FilmChanges, FilmMesh, HalfEdgeId, VertexId},
    settings::{CoatingSettings, Preset},
};

/// Makes a hexagon of six equilateral triangles around vertex 0.
fn hexagon() -> FilmMesh {
    let mut positions = vec![Vec3::ZERO];
    let h = 3.0f32.sqrt() / 2.0;
    positions.extend(
        [(1.0, 0.0), (0.5, h), (-0.5, h), (-1.0, 0.0), (-0.5, -h), (0.5, -h)].map(|(x, y)| Vec3::new(x, y, 0.0)),
    );
    let triangles: Vec<_> = (0..6).map(|i| [0, 1 + i, 1 + (i + 1) % 6]).collect();
    FilmMesh::new(positions, &triangles).unwrap()
}

/// Makes a triangular lattice of `n` by `n` cells with unit edges, flat, facing +z.
fn lattice(n: u32) -> FilmMesh {
    let row = n + 1;
    let h = 3.0f32.sqrt() / 2.0;
    let positions = (0..row * row)
        .map(|i| Vec3::new((i % row) as f32 + 0.5 * (i / row) as f32, (i / row) as f32 * h, 0.0))
        .collect();
    let triangles: Vec<_> = (0..n * n)
        .map(|i| (i / n) * row + i % n)
        .flat_map(|i| [[i, i + 1, i + row], [i + 1, i + row + 1, i + row]])
        .collect();
    FilmMesh::new(positions, &triangles).unwrap()
}

fn uniform_forces(mesh: &FilmMesh, settings: &CoatingSettings) -> FilmForces {
    let mut settings = settings.clone();
    settings.tearing.weak_probability = 0.0;
    FilmForces::new(mesh, &settings, 0)
}

fn separate_all(forces: &mut FilmForces) {
    forces.separated_age.fill(0.0);
    forces.touch_all();
}

fn set_all_adhesion(mesh: &FilmMesh, forces: &mut FilmForces, adhesion: f32) {
    mesh.topology.all_vertices().for_each(|v| forces.set_adhesion(v, adhesion));
}

fn edge_between(mesh: &FilmMesh, a: u32, b: u32) -> HalfEdgeId {
    mesh.topology
        .all_edges()
        .find(|&h| {
            let ends = (mesh.topology.origin(h).0, mesh.topology.target(h).0);
            ends == (a, b) || ends == (b, a)
        })
        .unwrap()
}

struct Tearing {
    mesh: FilmMesh,
    forces: FilmForces,
    settings: CoatingSettings,
    changes: FilmChanges,
}

impl Tearing {
    fn on(mesh: FilmMesh) -> Self {
        let mut settings = CoatingSettings::from(Preset::Paper);
        settings.tearing.weak_probability = 0.0;
        let mut forces = FilmForces::new(&mesh, &settings, 0);
        separate_all(&mut forces);
        Self { mesh, forces, settings, changes: FilmChanges::default() }
    }

    fn bind(&mut self, h: HalfEdgeId, binding: f32) {
        self.forces.set_binding(&self.mesh.topology, h, binding);
    }

    fn binding(&self, h: HalfEdgeId) -> f32 {
        self.forces.binding(&self.mesh.topology, h)
    }

    /// Attaches `v` again, or separates it.
    fn attach(&mut self, v: VertexId, attached: bool) {
        self.forces.separated_age[v.index()] = if attached { f32::INFINITY } else { 0.0 };
        self.forces.touch_all();
    }

    fn step(&mut self) -> Vec<HalfEdgeId> {
        self.changes.clear();
        let mut scratch = FractureScratch::default();
        tear(&mut self.mesh, &mut self.forces, &self.settings.tearing, Vec3::NEG_Y, &mut self.changes, &mut scratch);
        self.mesh.validate().unwrap();
        self.changes.torn.clone()
    }
}

#[test]
fn sigmoid_is_half_when_flat_and_grows_with_convexity() {
    assert_eq!(sigmoid(PI, 2.0), 0.5);
    for gamma in [0.5, 2.0, 4.0] {
        // Against the logistic function in f64.
        for phi in [0.3, 1.0, 2.5, 3.5, 5.0, 6.2f32] {
            let exact = 1.0 / (1.0 + (-f64::from(gamma) * (f64::from(phi) - std::f64::consts::PI)).exp());
            assert!((f64::from(sigmoid(phi, gamma)) - exact).abs() < 1e-6);
        }
        assert!((sigmoid(PI + 0.7, gamma) + sigmoid(PI - 0.7, gamma) - 1.0).abs() < 1e-6, "odd about flat");
    }
    assert!(sigmoid(4.0, 4.0) > sigmoid(4.0, 1.0) && sigmoid(2.0, 4.0) < sigmoid(2.0, 1.0));
}

#[test]
fn a_flat_vertex_of_valence_six_feels_exactly_the_contraction() {
    let mesh = lattice(6);
    let settings = CoatingSettings::from(Preset::Paper);
    let mut forces = uniform_forces(&mesh, &settings);
    mesh.topology.all_faces().for_each(|f| forces.set_contraction(&mesh.topology, f, 1.7));
    let centre = VertexId(3 * 7 + 3);
    assert_eq!(mesh.topology.fan(centre).count(), 6);
    assert!((bending_force(&mesh, &forces, centre, 1.0 / 3.0) - 1.7).abs() < 1e-6);
}

#[test]
fn border_and_torn_edges_push_nothing() {
    let settings = CoatingSettings::from(Preset::Paper);
    // All edges opposite the centre of a lone hexagon are borders.
    let mesh = hexagon();
    assert_eq!(bending_force(&mesh, &uniform_forces(&mesh, &settings), VertexId(0), 1.0), 0.0);
    let mut mesh = lattice(6);
    let forces = uniform_forces(&mesh, &settings);
    let centre = VertexId(3 * 7 + 3);
    let opposite = mesh.topology.fan(centre).next().unwrap().next();
    let before = bending_force(&mesh, &forces, centre, 1.0);
    mesh.tear(opposite, Vec3::NEG_Y).unwrap();
    assert!((before - bending_force(&mesh, &forces, centre, 1.0) - 0.5).abs() < 1e-6);
}

#[test]
fn adhesion_falls_at_its_rate_and_stops_at_zero() {
    let mesh = lattice(2);
    let settings = CoatingSettings::from(Preset::Paper);
    let mut forces = uniform_forces(&mesh, &settings);
    set_all_adhesion(&mesh, &mut forces, 0.25);
    age_forces(&mesh, &mut forces, &settings, &[], 0.1);
    let topology = &mesh.topology;
    assert!(topology.all_vertices().all(|v| (forces.adhesion(v) - 0.15).abs() < 1e-6));
    assert!(topology.all_faces().all(|f| (forces.contraction(f) - 1.1).abs() < 1e-6));
    for _ in 0..5 {
        age_forces(&mesh, &mut forces, &settings, &[], 0.1);
    }
    assert!(topology.all_vertices().all(|v| forces.adhesion(v) == 0.0));
}

#[test]
fn a_vertex_separates_once_at_the_age_of_the_closed_form() {
    let mesh = lattice(8);
    let mut settings = CoatingSettings::from(Preset::Paper);
    settings.tearing.weak_probability = 0.0;
    for (adhesion, decay, growth) in
        [(2.1, 1.0, 1.0), (1.0, 0.5, 0.0), (3.0, 1.5, 2.0), (0.5, 1.0, 1.0), (2.5, 0.0, 2.0)]
    {
        settings.adhesion.decay = decay;
        settings.tearing.contraction_growth = growth;
        let mut forces = uniform_forces(&mesh, &settings);
        set_all_adhesion(&mesh, &mut forces, adhesion);
        let centre = VertexId(4 * 9 + 4);
        let lift = bending_force(&mesh, &forces, centre, settings.bending.gain) / settings.tearing.contraction;
        let predicted = separation_age(lift, settings.tearing.contraction, growth, adhesion, decay);
        let dt = 1e-3;
        let mut changes = FilmChanges::default();
        for step in 1..=4000 {
            age_forces(&mesh, &mut forces, &settings, &[], dt);
            separate(&mesh, &mut forces, &settings, step as f32 * dt, &mut changes);
        }
        let found = forces.separated_age[centre.index()];
        assert!((found - predicted).abs() <= 1.5 * dt + 1e-3 * predicted, "{found} for {predicted}");
        assert_eq!(changes.separated.iter().filter(|&&v| v == centre).count(), 1, "separates once");
    }
}

#[test]
fn a_vertex_that_nothing_lifts_never_separates() {
    assert_eq!(separation_age(0.0, 1.0, 1.0, 2.0, 1.0), f32::INFINITY);
    assert_eq!(separation_age(1.0, 1.0, 0.0, 2.0, 0.0), f32::INFINITY);
    assert_eq!(separation_age(3.0, 1.0, 1.0, 2.0, 1.0), 0.0);
}

#[test]
fn weak_edges_are_drawn_at_their_probability() {
    let mesh = lattice(100);
    let settings = CoatingSettings::from(Preset::Paper);
    let weak = |seed| {
        let forces = FilmForces::new(&mesh, &settings, seed);
        let inner = mesh.topology.all_edges().filter(|&h| mesh.topology.rest_twin(h).is_some());
        inner.filter(|&h| forces.binding(&mesh.topology, h) < 1.0).map(|h| h.0).collect::<Vec<_>>()
    };
    let count = weak(5).len() as f64 / 29_800.0;
    assert!((0.007..0.013).contains(&count), "{count}");
    assert_eq!(weak(5), weak(5));
    assert_ne!(weak(5), weak(6));
}

#[test]
fn an_edge_tears_only_between_separated_ends_and_beyond_its_binding() {
    let mut film = Tearing::on(lattice(6));
    let h = edge_between(&film.mesh, 24, 25);
    assert_eq!(film.step(), [], "a pull of 2 does not break a binding of 6");
    film.bind(h, 2.0);
    assert_eq!(film.step(), [], "a pull of exactly the binding does not either");
    film.bind(h, 1.999);
    film.attach(VertexId(25), true);
    assert_eq!(film.step(), [], "an attached end holds the edge");
    film.attach(VertexId(25), false);
    assert_eq!(film.step(), [h]);
    let twin = film.mesh.topology.rest_twin(h).unwrap();
    for f in [h.face(), twin.face()] {
        assert!((film.forces.contraction(f) - 0.3).abs() < 1e-6, "both faces are relieved");
    }
    // Both ends are tips that point away from the torn edge.
    let along = film.mesh.geometry.rest_positions[25] - film.mesh.geometry.rest_positions[24];
    assert!(film.forces.tip(VertexId(25)).unwrap().distance(along) < 1e-6);
    assert!(film.forces.tip(VertexId(24)).unwrap().distance(-along) < 1e-6);
}

#[test]
fn a_tip_relieves_the_edge_straight_ahead_and_no_other() {
    let mut film = Tearing::on(lattice(6));
    film.bind(edge_between(&film.mesh, 23, 24), 0.01);
    assert_eq!(film.step().len(), 1);
    // Binding 6, beta 0.2: relieved edges hold 1.2. The crack runs straight on at both ends; the edges at
    // 60 degrees (cosine 0.5 > alpha) were candidates too, but the first tear took the tip along.
    let ahead = [edge_between(&film.mesh, 22, 23), edge_between(&film.mesh, 24, 25)];
    assert_eq!(film.step(), ahead);
    // Now judge alpha alone: turned away by 60 degrees the cosine is 0.5.
    for (alpha, tears) in [(0.499, true), (0.501, false)] {
        let mut film = Tearing::on(lattice(6));
        film.settings.tearing.alpha = alpha;
        film.bind(edge_between(&film.mesh, 23, 24), 0.01);
        film.step();
        for ahead in [(24, 25), (23, 22)] {
            film.bind(edge_between(&film.mesh, ahead.0, ahead.1), 100.0);
        }
        assert_eq!(!film.step().is_empty(), tears, "alpha {alpha}");
    }
}

#[test]
fn candidates_are_judged_again_when_their_turn_comes() {
    // Two weak edges of one triangle: the first tear relieves the face they share below what the second holds.
    let mut film = Tearing::on(lattice(6));
    let (a, b) = (edge_between(&film.mesh, 24, 25), edge_between(&film.mesh, 25, 31));
    film.bind(a, 1.0);
    film.bind(b, 1.5);
    assert_eq!(film.step(), [a], "largest force over binding first; then the other no longer tears");
    // Equal excess: the lower edge goes first.
    let mut film = Tearing::on(lattice(6));
    film.bind(a, 1.5);
    film.bind(b, 1.5);
    assert_eq!(film.step(), [a.min(b)]);
}

#[test]
fn the_best_aligned_candidate_goes_first() {
    let mut film = Tearing::on(lattice(6));
    film.bind(edge_between(&film.mesh, 23, 24), 0.01);
    film.step();
    // A much weaker edge elsewhere comes after the one at the tip.
    let elsewhere = edge_between(&film.mesh, 8, 9);
    film.bind(elsewhere, 0.001);
    let torn = film.step();
    assert_eq!(torn.last(), Some(&elsewhere), "{torn:?}");
    assert!(torn.len() >= 2);
}

#[test]
fn meeting_cracks_make_a_junction_and_clear_the_tip() {
    let mut film = Tearing::on(lattice(6));
    for (a, b) in [(23, 24), (24, 25)] {
        film.bind(edge_between(&film.mesh, a, b), 0.0);
    }
    film.settings.tearing.contraction_kept = 1.0;
    film.step();
    assert!(film.forces.tip(VertexId(24)).is_none(), "the middle is a junction");
    assert_eq!(film.changes.duplicates, [VertexId(49)]);
    assert!(film.forces.tip(VertexId(49)).is_none());
    assert!(film.forces.tip(VertexId(23)).is_some() && film.forces.tip(VertexId(25)).is_some());
    let below = film.mesh.topology.fan(VertexId(24)).all(|h| {
        film.mesh.geometry.rest_centroid(&film.mesh.topology, h.face()).y < film.mesh.geometry.rest_positions[24].y
    });
    assert!(below, "the fan lowest along gravity keeps the id");
}

#[test]
fn bound_edges_of_torn_faces_lose_binding_once_for_each() {
    let mut film = Tearing::on(lattice(6));
    let torn = edge_between(&film.mesh, 24, 25);
    film.bind(torn, 0.1);
    film.step();
    age_forces(&film.mesh, &mut film.forces, &film.settings, &[], 0.5);
    let kept = (-1.3f64 * 0.5).exp() as f32;
    let twin = film.mesh.topology.rest_twin(torn).unwrap();
    for h in [torn.next(), torn.previous(), twin.next(), twin.previous()] {
        assert!((film.binding(h) - 6.0 * kept).abs() < 1e-5);
        let other = film.mesh.topology.rest_twin(h).unwrap();
        assert_eq!(film.binding(h), film.binding(other));
    }
    let decayed = |h: &HalfEdgeId| film.binding(*h) < 6.0 && film.binding(*h) > 0.1;
    assert_eq!(film.mesh.topology.all_half_edges().filter(decayed).count(), 8, "no other edge does");
    // An edge between two torn faces decays twice.
    film.bind(twin.next(), 6.0);
    let beyond = film.mesh.topology.rest_twin(twin.next()).unwrap();
    film.bind(beyond.next(), 0.0);
    film.settings.tearing.alpha = 1.0;
    film.step();
    film.bind(twin.next(), 6.0);
    age_forces(&film.mesh, &mut film.forces, &film.settings, &[], 0.5);
    assert!((film.binding(twin.next()) - 6.0 * kept * kept).abs() < 1e-5);
}

#[test]
fn without_weak_edges_nothing_tears_while_the_pull_is_below_binding() {
    let mut film = Tearing::on(lattice(10));
    for _ in 0..1000 {
        age_forces(&film.mesh, &mut film.forces, &film.settings, &[], 1e-3);
        assert_eq!(film.step(), []);
    }
}

#[test]
fn faces_torn_all_round_are_stripped_and_loose_pieces_fall_up_to_the_limit() {
    for (limit, fallen) in [(0, 0), (6, 6), (5, 0)] {
        let mut film = Tearing::on(lattice(6));
        film.settings.stripping.fall_faces = limit;
        film.attach(VertexId(0), true); // one corner holds the rest of the film
        film.settings.tearing.contraction_kept = 1.0;
        // Cut out the hexagon around vertex 24.
        let ring: Vec<_> = film.mesh.topology.fan(VertexId(24)).map(|h| h.next()).collect();
        for h in ring {
            film.bind(h, 0.0);
        }
        film.settings.tearing.alpha = 1.0;
        assert_eq!(film.step().len(), 6);
        let mut scratch = FractureScratch::default();
        strip(&mut film.mesh, &mut film.forces, &film.settings.stripping, 0.5, &mut film.changes, &mut scratch);
        film.mesh.validate().unwrap();
        assert_eq!(film.changes.removed.len(), fallen, "limit {limit}");
        assert_eq!(film.forces.loose.len(), usize::from(fallen == 0));
        if fallen > 0 {
            let debris = film.changes.debris[0];
            assert_eq!(debris.faces, 6);
            assert!((debris.area - 6.0 * 3.0f32.sqrt() / 4.0).abs() < 1e-5);
            assert!(debris.position.distance(film.mesh.geometry.rest_positions[24]) < 1e-5);
        }
    }
    // A single face.
    let mut film = Tearing::on(lattice(6));
    film.attach(VertexId(0), true);
    film.settings.stripping.fall_faces = 0;
    film.settings.tearing.contraction_kept = 1.0;
    film.settings.tearing.alpha = 1.0;
    for h in HalfEdgeId(90).face().half_edges() {
        film.bind(h, 0.0);
    }
    film.step();
    strip(
        &mut film.mesh,
        &mut film.forces,
        &film.settings.stripping,
        0.5,
        &mut film.changes,
        &mut FractureScratch::default(),
    );
    assert_eq!(film.changes.removed, [HalfEdgeId(90).face()]);
    film.mesh.validate().unwrap();
}

#[test]
fn a_border_face_hangs_on_until_its_last_vertex_separates() {
    let mut film = Tearing::on(hexagon());
    film.settings.stripping.fall_faces = 0;
    film.settings.tearing.contraction_kept = 1.0;
    film.settings.tearing.alpha = 1.0;
    // Both inner edges of the face (0, 1, 2) tear; vertices 1 and 2 are on the border.
    film.bind(edge_between(&film.mesh, 0, 1), 0.0);
    film.bind(edge_between(&film.mesh, 0, 2), 0.0);
    assert_eq!(film.step().len(), 2);
    let mut scratch = FractureScratch::default();
    let attached = film.mesh.topology.corners(HalfEdgeId(0).face())[1];
    film.attach(attached, true);
    strip(&mut film.mesh, &mut film.forces, &film.settings.stripping, 0.5, &mut film.changes, &mut scratch);
    assert_eq!(film.changes.removed, []);
    film.changes.clear();
    film.attach(attached, false);
    film.changes.separated.push(attached);
    strip(&mut film.mesh, &mut film.forces, &film.settings.stripping, 0.5, &mut film.changes, &mut scratch);
    assert_eq!(film.changes.removed, [HalfEdgeId(0).face()]);
    film.mesh.validate().unwrap();
}
