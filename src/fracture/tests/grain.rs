//! Tests the rules that count in grains.

use bevy_math::{Vec3, ops};
use core::f32::consts::PI;

use super::{hexagon, lattice, separate_all};
use crate::{
    film::{FilmChanges, FilmMesh, HalfEdgeId, VertexId},
    fracture::{FilmForces, FractureScratch, age_forces, bending_force, separate, strip, tear, tear_edge::remember},
    remesh::sample,
    settings::{CoatingSettings, Preset, Rules},
};

fn by_grain(grain: f32) -> CoatingSettings {
    let mut settings = CoatingSettings::default();
    settings.scale.rules = Rules::Grain;
    settings.scale.grain = grain;
    settings
}

/// A plate of the side 1.
fn plate(triangles: u32, seed: u64) -> FilmMesh {
    let film = sample::plate(triangles, seed).unwrap().film;
    FilmMesh::new(film.positions, &film.triangles).unwrap()
}

/// Length of cracks and share of vertices that have separated.
struct Cracks {
    length: f32,
    separated: f32,
}

/// Ages plates by 1, without curls, and returns the means over seeds.
fn cracks(triangles: u32, seeds: u64, settings: &CoatingSettings) -> Cracks {
    let (mut length, mut separated) = (0.0, 0.0);
    for seed in 1..=seeds {
        let mut mesh = plate(triangles, seed);
        let mut forces = FilmForces::new(&mesh, settings, seed);
        let (mut changes, mut scratch) = (FilmChanges::default(), FractureScratch::default());
        for step in 1..=500 {
            let age = step as f32 / 500.0;
            changes.clear();
            age_forces(&mesh, &mut forces, settings, &[], 1.0 / 500.0);
            separate(&mesh, &mut forces, settings, age, &mut changes);
            tear(&mut mesh, &mut forces, &settings.tearing, Vec3::NEG_Y, &mut changes, &mut scratch);
            strip(&mut mesh, &mut forces, &settings.stripping, age, &mut changes, &mut scratch);
            length += changes.torn.iter().map(|h| mesh.geometry.rest_lengths[h.index()]).sum::<f32>();
        }
        mesh.validate().unwrap();
        forces.validate(&mesh.topology).unwrap();
        separated += forces.separations as f32 / mesh.topology.original_vertex_count() as f32;
    }
    Cracks { length: length / seeds as f32, separated: separated / seeds as f32 }
}

#[test]
fn films_of_any_fineness_crack_at_one_scale() {
    // h = s and h = s / 2. Over eight seeds the mean length is known to about 5 %.
    let (coarse, fine) = (cracks(1500, 8, &by_grain(0.0392)), cracks(6000, 8, &by_grain(0.0392)));
    let ratio = fine.length / coarse.length;
    assert!((0.8..1.25).contains(&ratio), "cracks of {} and {}", coarse.length, fine.length);
    assert!((fine.separated - coarse.separated).abs() < 0.04);
    // What this is for.
    let paper = CoatingSettings::from(Preset::Paper);
    let ratio = cracks(3000, 6, &paper).length / cracks(750, 6, &paper).length;
    assert!(ratio > 2.0, "by the paper's rules cracks get longer by only {ratio}");
}

#[test]
fn a_finer_grain_makes_more_cracks_on_the_same_film() {
    let (wide, narrow) = (cracks(3000, 3, &by_grain(0.1)), cracks(3000, 3, &by_grain(0.03)));
    assert!(narrow.length > 2.0 * wide.length, "{} and {}", narrow.length, wide.length);
}

#[test]
fn the_force_on_a_vertex_does_not_depend_on_its_valence() {
    let settings = by_grain(0.1);
    let mesh = lattice(6);
    let forces = FilmForces::new(&mesh, &settings, 1);
    for v in mesh.topology.all_vertices() {
        let opposite = |h: HalfEdgeId| mesh.topology.rest_twin(h.next()).is_some();
        if mesh.topology.fan(v).any(opposite) {
            let force = bending_force(&mesh, &forces, v, settings.bending.gain);
            assert!((force - 1.0).abs() < 1e-4, "{v:?}: {force}");
        }
    }
}

/// Tears one edge of a plate and returns plate, forces and edge.
fn torn_once(settings: &CoatingSettings) -> (FilmMesh, FilmForces, HalfEdgeId) {
    let mut mesh = plate(2000, 5);
    let mut forces = FilmForces::new(&mesh, settings, 5);
    separate_all(&mut forces);
    let centred = mesh.geometry.rest_positions.iter().sum::<Vec3>() / mesh.geometry.rest_positions.len() as f32;
    let nearest = |&h: &HalfEdgeId| mesh.geometry.rest_positions[mesh.topology.origin(h).index()].distance(centred);
    let edge = mesh
        .topology
        .all_edges()
        .filter(|h| mesh.topology.rest_twin(*h).is_some())
        .min_by(|a, b| nearest(a).total_cmp(&nearest(b)))
        .unwrap();
    for h in mesh.topology.all_edges().collect::<Vec<_>>() {
        forces.set_binding(&mesh.topology, h, if h == edge { 0.1 } else { 100.0 });
    }
    let (mut changes, mut scratch) = (FilmChanges::default(), FractureScratch::default());
    tear(&mut mesh, &mut forces, &settings.tearing, Vec3::NEG_Y, &mut changes, &mut scratch);
    assert_eq!(changes.torn, [edge]);
    (mesh, forces, edge)
}

#[test]
fn a_tear_relieves_what_lies_beside_it_and_nothing_ahead() {
    let settings = by_grain(0.1);
    let (mesh, forces, edge) = torn_once(&settings);
    let place = |v: VertexId| mesh.geometry.rest_positions[v.index()];
    let (a, b) = (place(mesh.topology.origin(edge)), place(mesh.topology.target(edge)));
    let along = (b - a).normalize();
    let reach = 0.6 * 0.1;
    let mut relieved = 0;
    for f in mesh.topology.all_faces() {
        let p = mesh.geometry.rest_centroid(&mesh.topology, f) - a;
        let (x, d) = (p.dot(along) / a.distance(b), (p - p.dot(along) * along).length());
        let contraction = forces.contraction(f);
        if (-0.15..=1.15).contains(&x) && d <= 3.0 * reach {
            let expected = 1.0 - 0.95 * ops::exp(-d / reach);
            assert!((contraction - expected).abs() < 1e-4, "{contraction}, not {expected}, at {d}");
            relieved += 1;
        } else {
            assert_eq!(contraction, 1.0, "at {x}, {d}");
        }
    }
    assert!(relieved > 10, "{relieved}");
}

#[test]
fn a_crack_keeps_its_direction_over_a_length_not_over_edges() {
    // A straight run along +x, then a kink: the shorter the edge, the less it counts.
    let turned_by = |length: f32| {
        let settings = by_grain(1.0);
        let ahead = Vec3::new(0.5, 3f32.sqrt() / 2.0, 0.0);
        let crack = remember(Vec3::X, ahead, length / settings.tearing.memory);
        assert!((crack.length() - 1.0).abs() < 1e-6);
        ops::acos(crack.dot(Vec3::X))
    };
    assert!(turned_by(0.05) < 0.05 && turned_by(20.0) > PI / 3.0 - 0.01);
    let (once, twice) = (turned_by(0.1), turned_by(0.2));
    assert!((twice / once - 2.0).abs() < 0.2, "{once}, {twice}");
}

#[test]
fn loose_pieces_fall_after_a_while_whatever_their_size() {
    let mut settings = by_grain(0.1);
    settings.stripping.hold = 0.05;
    let mut mesh = lattice(6);
    let mut forces = FilmForces::new(&mesh, &settings, 1);
    separate_all(&mut forces);
    let (mut changes, mut scratch) = (FilmChanges::default(), FractureScratch::default());
    strip(&mut mesh, &mut forces, &settings.stripping, 0.30, &mut changes, &mut scratch);
    strip(&mut mesh, &mut forces, &settings.stripping, 0.33, &mut changes, &mut scratch);
    assert_eq!((forces.loose.len(), changes.debris.len()), (1, 0), "it came loose at 0.3");
    strip(&mut mesh, &mut forces, &settings.stripping, 0.36, &mut changes, &mut scratch);
    assert_eq!(changes.debris[0].faces as usize, mesh.topology.face_count());
    assert!(forces.loose.is_empty() && mesh.topology.live_faces().next().is_none());
}

#[test]
fn what_hangs_on_by_too_little_lets_go_but_rivets_hold() {
    // The middle vertex holds a third of six faces. 2.5 faces of the grain must hold: 2.5, or 1.6.
    for (grain, rivet, lets_go) in [(1.0, false, true), (0.8, false, false), (1.0, true, false)] {
        let settings = by_grain(grain);
        let mut mesh = hexagon();
        let mut forces = FilmForces::new(&mesh, &settings, 1);
        let last = VertexId(0);
        for v in mesh.topology.all_vertices() {
            forces.set_adhesion(v, if v == last { 50.0 } else { 0.0 });
        }
        if rivet {
            forces.set_adhesion(last, f32::INFINITY);
        }
        let (mut changes, mut scratch) = (FilmChanges::default(), FractureScratch::default());
        separate(&mesh, &mut forces, &settings, 0.1, &mut changes);
        assert_eq!((changes.separated.len(), forces.is_attached(last)), (6, true));
        strip(&mut mesh, &mut forces, &settings.stripping, 0.1, &mut changes, &mut scratch);
        assert_eq!(forces.is_attached(last), !lets_go, "grain {grain}, rivet {rivet}");
        assert_eq!(forces.loose.len(), usize::from(lets_go));
        forces.validate(&mesh.topology).unwrap();
    }
}
