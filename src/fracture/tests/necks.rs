//! Tests that flaps break off at narrow necks, and nothing else does.

use bevy_math::Vec3;

use crate::{
    film::{FilmChanges, FilmMesh, HalfEdgeId, LoosePieces, PieceScratch, tests::grid},
    fracture::{FilmForces, FractureScratch, age_forces, separate, strip, tear},
    remesh::sample,
    settings::{CoatingSettings, Rules},
};

/// Two squares of the side 10, joined by a strip of the length 10 and some width. The grain is 3.
struct Dumbbell {
    mesh: FilmMesh,
    forces: FilmForces,
    settings: CoatingSettings,
    scratch: FractureScratch,
}

impl Dumbbell {
    /// Makes a film whose vertices are attached where `holds` says so for their x.
    fn new(width: f32, holds: impl Fn(f32) -> bool) -> Self {
        let (positions, triangles) = grid(30, 10);
        let place = |v: u32| positions[v as usize];
        let is_in = |t: &[u32; 3]| {
            let c = (place(t[0]) + place(t[1]) + place(t[2])) / 3.0;
            !(10.0..20.0).contains(&c.x) || (c.y - 5.0).abs() < 0.5 * width
        };
        let triangles: Vec<_> = triangles.into_iter().filter(is_in).collect();
        let mut used: Vec<u32> = triangles.iter().flatten().copied().collect();
        used.sort_unstable();
        used.dedup();
        let number = |v: u32| used.binary_search(&v).unwrap() as u32;
        let triangles: Vec<_> = triangles.iter().map(|t| t.map(number)).collect();
        let mesh = FilmMesh::new(used.iter().map(|&v| place(v)).collect(), &triangles).unwrap();
        let mut settings = CoatingSettings::default();
        settings.scale.rules = Rules::Grain;
        settings.scale.grain = 3.0;
        settings.tearing.weak_probability = 0.0;
        settings.tearing.beta = 1.0; // cracks do not run on
        let forces = FilmForces::new(&mesh, &settings, 1);
        let mut film = Self { mesh, forces, settings, scratch: FractureScratch::default() };
        film.hold(holds);
        film
    }

    fn hold(&mut self, holds: impl Fn(f32) -> bool) {
        for (age, at) in self.forces.separated_age.iter_mut().zip(&self.mesh.geometry.rest_positions) {
            *age = if holds(at.x) { f32::INFINITY } else { 0.1 };
        }
        self.forces.touch_all();
    }

    fn inner_edges(&self) -> impl Iterator<Item = HalfEdgeId> + '_ {
        self.mesh.topology.all_edges().filter(|&h| self.mesh.topology.bound_twin(h).is_some())
    }

    fn x_of(&self, h: HalfEdgeId) -> f32 {
        self.mesh.geometry.rest_positions[self.mesh.topology.origin(h).index()].x
    }

    /// Weakens an edge across the strip that begins at its lower rim.
    fn nick(&mut self) {
        let topology = &self.mesh.topology;
        let lowest = |h: &HalfEdgeId| {
            let [a, b] =
                [topology.origin(*h), topology.target(*h)].map(|v| self.mesh.geometry.rest_positions[v.index()]);
            (a.x == 15.0 && b.x == 15.0).then_some(a.y.min(b.y))
        };
        let edge = self.inner_edges().filter(|h| lowest(h).is_some());
        let edge = edge.min_by(|a, b| lowest(a).partial_cmp(&lowest(b)).unwrap()).unwrap();
        self.forces.set_binding(&self.mesh.topology, edge, 0.0);
    }

    /// Tears for one step. Returns the number of edges that tore, and the number of pieces of the film.
    fn tear(&mut self) -> (usize, usize) {
        let mut changes = FilmChanges::default();
        let Self { mesh, forces, settings, scratch } = self;
        tear(mesh, forces, &settings.tearing, Vec3::NEG_Y, &mut changes, scratch);
        mesh.validate().unwrap();
        forces.validate(&mesh.topology).unwrap();
        let pieces =
            LoosePieces::default().find(&mesh.topology, &mut PieceScratch::default(), |v| forces.is_attached(v));
        (changes.torn.len(), pieces)
    }
}

#[test]
fn a_flap_breaks_off_at_a_narrow_neck() {
    let mut film = Dumbbell::new(2.0, |x| x < 8.0);
    assert_eq!(film.tear(), (0, 1), "nothing has torn at the neck");
    film.nick();
    let (torn, pieces) = film.tear();
    assert_eq!((torn, pieces), (2, 2), "the neck tears right across");
    assert_eq!(film.forces.necks, []);
}

#[test]
fn a_wide_neck_holds() {
    let mut film = Dumbbell::new(8.0, |x| x < 8.0);
    film.nick();
    assert_eq!(film.tear(), (1, 1));
}

#[test]
fn a_flap_that_is_held_stays_until_it_is_held_no_more() {
    let mut film = Dumbbell::new(2.0, |x| !(8.0..22.0).contains(&x));
    film.nick();
    assert_eq!(film.tear(), (1, 1));
    assert!(!film.forces.necks.is_empty());
    assert_eq!(film.tear(), (0, 1));
    film.hold(|x| x < 8.0);
    assert_eq!(film.tear(), (1, 2));
}

#[test]
fn corners_do_not_break_off() {
    // A nick in the rim of a square without a strip makes corners, which a short line cuts off.
    let mut film = Dumbbell::new(0.5, |x| x < 5.0);
    let topology = &film.mesh.topology;
    let at_rim = |h: &HalfEdgeId| topology.is_border(topology.origin(*h)) && film.x_of(*h) == 9.0;
    let nick = film.inner_edges().find(at_rim).unwrap();
    film.forces.set_binding(&film.mesh.topology, nick, 0.0);
    let (torn, _) = film.tear();
    assert_eq!(torn, 1);
}

#[test]
fn sealed_edges_and_a_width_of_0_hold_every_flap() {
    let mut sealed = Dumbbell::new(2.0, |x| x < 8.0);
    sealed.nick();
    let right = sealed.inner_edges().filter(|&h| sealed.x_of(h) > 9.0).collect::<Vec<_>>();
    for h in right {
        if sealed.forces.pull_and_binding(&sealed.mesh.topology, h).is_some_and(|(_, binding)| binding > 0.0) {
            sealed.forces.set_binding(&sealed.mesh.topology, h, f32::INFINITY);
        }
    }
    assert_eq!(sealed.tear(), (1, 1));

    let mut off = Dumbbell::new(2.0, |x| x < 8.0);
    off.settings.tearing.neck_width = 0.0;
    off.nick();
    assert_eq!(off.tear(), (1, 1));

    let mut paper = Dumbbell::new(2.0, |x| x < 8.0);
    paper.settings.scale.rules = Rules::Paper;
    paper.forces.follow_settings(&paper.mesh, &paper.settings);
    paper.nick();
    assert_eq!(paper.tear(), (1, 1));
}

/// Ages a plate whose mean edge is half a grain by 1. Returns the number of vertices at which a flap hangs on a neck.
fn necks_left(neck_width: f32, seed: u64) -> usize {
    let film = sample::plate(6000, seed).unwrap().film;
    let mut mesh = FilmMesh::new(film.positions, &film.triangles).unwrap();
    let mut settings = CoatingSettings::default();
    settings.scale.grain = 0.0392;
    settings.tearing.neck_width = neck_width;
    let mut forces = FilmForces::new(&mesh, &settings, seed);
    let (mut changes, mut scratch) = (FilmChanges::default(), FractureScratch::default());
    for step in 1..=500 {
        let age = step as f32 / 500.0;
        changes.clear();
        age_forces(&mesh, &mut forces, &settings, &[], 1.0 / 500.0);
        separate(&mesh, &mut forces, &settings, age, &mut changes);
        tear(&mut mesh, &mut forces, &settings.tearing, Vec3::NEG_Y, &mut changes, &mut scratch);
        strip(&mut mesh, &mut forces, &settings.stripping, age, &mut changes, &mut scratch);
    }
    mesh.validate().unwrap();
    scratch.necks.count(&mesh, &mut forces, settings.scale.grain)
}

#[test]
fn hardly_any_flap_is_left_on_a_neck() {
    let left = |width| (1..=3).map(|seed| necks_left(width, seed)).sum::<usize>();
    let (with, without) = (left(1.0), left(0.0));
    assert!(without > 10 && 4 * with < without, "{with} vertices with the rule, {without} without");
}
