//! Tests that the fine surface is whole where the film is, and parts only where it does.

use std::sync::Arc;

use bevy_math::Vec3;

use super::{FineSurface, chips::Chip};
use crate::{
    appearance::{Detail, DisplayChanges, FilmAppearance, MeshPart, Shown, tests::shown},
    film::{FaceGrid, FaceId, FilmMesh, HalfEdgeId, Topology},
    remesh::{
        BuiltFilm,
        sample::{self, TestPiece},
    },
    settings::CoatingSettings,
    sim::FilmState,
    stain::Environment,
};

/// A film on a curved plate with a grain of about its mean edge, aged.
struct Aged {
    piece: TestPiece,
    film: FilmState,
    fine: FilmAppearance,
    grid: FaceGrid,
}

impl Aged {
    fn new(triangles: u32, seed: u64, level: u32, age: f32) -> Self {
        let piece = sample::curved_plate(triangles, seed).unwrap();
        let mut settings = CoatingSettings::default();
        settings.scale.grain = 0.05;
        let mut film = FilmState::new(&piece.film, &settings, seed, 200).unwrap();
        film.age_to(f64::from(age), &settings, &Environment::default());
        let detail = Detail { level, ..Detail::default() };
        let fine =
            FilmAppearance::with_detail(&piece.film, &piece.surface, &film.mesh, &film.forces, &film.stains, detail);
        Self { piece, film, fine: fine.unwrap(), grid: FaceGrid::new(level) }
    }

    fn front(&self) -> &MeshPart {
        self.fine.front(0).unwrap()
    }

    fn surface(&self) -> &FineSurface {
        let Shown::Fine(surface) = &self.fine.shown else { panic!("it is fine") };
        surface
    }

    /// Vertices of the front at the points of the grid of `f`.
    fn vertices(&self, f: FaceId) -> Vec<usize> {
        vertices(&self.fine, &self.film.mesh.topology, f)
    }

    /// Positions of the front along the half-edge `h`.
    fn edge(&self, h: HalfEdgeId) -> Vec<Vec3> {
        let vertices = self.vertices(h.face());
        let edge = self.grid.edge(h.index() % 3).iter();
        edge.map(|&i| Vec3::from_array(self.front().positions[vertices[i as usize]])).collect()
    }
}

/// Vertices of the front of a film with one slot at the points of the grid of `f`.
fn vertices(fine: &FilmAppearance, topology: &Topology, f: FaceId) -> Vec<usize> {
    let Shown::Fine(surface) = &fine.shown else { panic!("it is fine") };
    let mut vertices = Vec::new();
    surface.fronts.skin.list(topology, &surface.base, 0, f, &mut vertices);
    vertices.into_iter().map(|vertex| vertex as usize).collect()
}

/// Largest distance between the points of two edges that run against each other.
fn gap(a: &[Vec3], b: &[Vec3]) -> f32 {
    a.iter().zip(b.iter().rev()).map(|(a, b)| a.distance(*b)).fold(0.0, f32::max)
}

#[test]
fn fresh_paint_is_the_props_own_surface() {
    let aged = Aged::new(300, 2, 2, 0.0);
    assert_eq!(aged.front().indices.len(), 3 * 16 * 300);
    assert_eq!(aged.front().positions, aged.front().rest);
    assert!(aged.fine.metal(0).unwrap().is_empty() && aged.fine.backs(0).unwrap().is_empty());
}

#[test]
fn bound_neighbours_meet_at_every_level() {
    for (level, seed) in [(1, 1), (2, 2), (3, 3), (4, 4)] {
        let aged = Aged::new(700, seed, level, 1.0);
        let topology = &aged.film.mesh.topology;
        let (mut bound, mut moved) = (0, 0);
        for h in topology.all_edges().filter(|&h| topology.is_live(h.face())) {
            let Some(twin) = topology.bound_twin(h) else { continue };
            let (a, b) = (aged.edge(h), aged.edge(twin));
            let gap = gap(&a, &b);
            assert!(gap < 1e-4 * aged.film.mesh.geometry.mean_edge, "a gap of {gap} at level {level}");
            bound += 1;
            moved += u32::from(a[0] != aged.film.mesh.geometry.rest_positions[topology.origin(h).index()]);
        }
        assert!(bound > 200 && moved > 100, "{bound} edges, {moved} of them moved");
        assert!(aged.front().positions.iter().flatten().all(|x| x.is_finite()));
    }
}

#[test]
fn faces_share_vertices_where_film_is_bound_and_nowhere_else() {
    for level in 1..=3u32 {
        let fresh = Aged::new(300, 2, level, 0.0);
        let topology = &fresh.film.mesh.topology;
        let (n, edges) = (1usize << level, topology.all_edges().count());
        let unshared = 3 * 300 * (n - 1) - edges * (n - 1);
        let points = topology.vertex_count() + edges * (n - 1) + 300 * (n - 1) * (n - 2) / 2;
        assert_eq!(fresh.front().positions.len(), points, "level {level}: {unshared} points are spared");

        let aged = Aged::new(300, 2, level, 1.0);
        let topology = &aged.film.mesh.topology;
        let (mut bound, mut torn) = (0, 0);
        for h in topology.all_edges().filter(|&h| topology.is_live(h.face())) {
            let Some(twin) = topology.rest_twin(h).filter(|twin| topology.is_live(twin.face())) else { continue };
            let along = |h: HalfEdgeId| {
                let vertices = aged.vertices(h.face());
                aged.grid.edge(h.index() % 3).iter().map(|&i| vertices[i as usize]).collect::<Vec<_>>()
            };
            let (a, b) = (along(h), along(twin));
            if topology.is_torn(h) {
                assert!(a[1..n].iter().all(|vertex| !b.contains(vertex)), "both sides of a crack have their own");
                torn += 1;
            } else {
                assert!(a.iter().eq(b.iter().rev()));
                bound += 1;
            }
        }
        assert!(bound > 50 && torn > 20, "{bound} {torn}");
    }
}

#[test]
fn seams_keep_their_vertices_apart_and_closed() {
    let mut piece = sample::curved_plate(400, 3).unwrap();
    // Triangles in the upper half have other texture coordinates.
    let middle = |t: &[u32; 3]| t.iter().map(|&v| piece.surface.positions[v as usize].y).sum::<f32>() / 3.0;
    let upper: Vec<bool> = piece.surface.triangles.iter().map(|t| middle(t) > 0.0).collect();
    for (uv, upper) in piece.surface.uvs.chunks_exact_mut(3).zip(&upper) {
        uv.iter_mut().filter(|_| *upper).for_each(|uv| uv.x += 3.0);
    }
    let mut settings = CoatingSettings::default();
    settings.scale.grain = 0.05;
    let mut film = FilmState::new(&piece.film, &settings, 3, 200).unwrap();
    film.age_to(0.7, &settings, &Environment::default());
    let FilmState { mesh, forces, stains, .. } = &film;
    let detail = Detail { level: 2, ..Detail::default() };
    let fine = FilmAppearance::with_detail(&piece.film, &piece.surface, mesh, forces, stains, detail).unwrap();
    let (front, grid) = (fine.front(0).unwrap(), FaceGrid::new(2));
    let (mut seams, mut moved) = (0, 0);
    for h in mesh.topology.all_edges().filter(|&h| mesh.topology.is_live(h.face())) {
        let Some(twin) = mesh.topology.bound_twin(h) else { continue };
        let along = |h: HalfEdgeId| {
            let vertices = vertices(&fine, &mesh.topology, h.face());
            grid.edge(h.index() % 3).iter().map(|&i| vertices[i as usize]).collect::<Vec<_>>()
        };
        for (a, b) in along(h).into_iter().zip(along(twin).into_iter().rev()) {
            assert_eq!(front.positions[a], front.positions[b], "closed to the bit");
            let is_seam = (front.uvs[a][0] - front.uvs[b][0]).abs() > 1.0;
            assert_eq!(a != b, is_seam);
            seams += u32::from(is_seam);
            moved += u32::from(is_seam && front.positions[a] != front.rest[a]);
        }
    }
    assert!(seams > 20 && moved > 5, "{seams} {moved}");
}

#[test]
fn cracks_that_have_not_opened_are_closed_exactly() {
    let mut aged = Aged::new(300, 4, 2, 0.0);
    let inner: Vec<_> =
        aged.film.mesh.topology.all_edges().filter(|&h| aged.film.mesh.topology.rest_twin(h).is_some()).collect();
    let settings = CoatingSettings::default();
    for &h in inner.iter().step_by(7) {
        aged.film.tear_edge(h, &settings, &Environment::default());
    }
    let FilmState { mesh, forces, stains, .. } = &aged.film;
    aged.fine.update(mesh, forces, stains, DisplayChanges::everything());
    let (mut torn, mut chipped) = (0, 0);
    for &h in &inner {
        let twin = mesh.topology.rest_twin(h).unwrap();
        let both_live = [h, twin].iter().all(|h| mesh.topology.is_live(h.face()));
        if !both_live {
            continue;
        }
        let (a, b) = (aged.edge(h), aged.edge(twin));
        assert!(a.iter().eq(b.iter().rev()), "an edge parts: {a:?} {b:?}");
        torn += u32::from(mesh.topology.is_torn(h));
        let middle = a[0].lerp(a[a.len() - 1], 0.5);
        chipped += u32::from(mesh.topology.is_torn(h) && a[a.len() / 2].distance(middle) > 0.002);
    }
    assert!(torn > 30 && chipped > torn / 2, "{torn} torn edges, {chipped} chipped");
}

#[test]
fn rims_join_fronts_and_backs() {
    let aged = Aged::new(700, 5, 2, 1.0);
    let backs = aged.fine.backs(0).unwrap();
    // Every edge of the closed skin of fronts, backs and rims has two triangles, or lies where film is still bound.
    let place = |p: [f32; 3]| p.map(|x| (x * 1e5).round() as i32);
    let mut edges = std::collections::BTreeMap::new();
    let topology = &aged.film.mesh.topology;
    let separated: Vec<bool> = topology
        .all_faces()
        .map(|f| topology.is_live(f) && topology.corners(f).iter().all(|&v| !aged.film.forces.is_attached(v)))
        .collect();
    let mut count = |part: &MeshPart, t: &[u32]| {
        for k in 0..3 {
            let [a, b] = [t[k], t[(k + 1) % 3]].map(|v| place(part.positions[v as usize]));
            *edges.entry((a.min(b), a.max(b))).or_insert(0) += 1;
        }
    };
    for f in topology.live_faces().filter(|f| separated[f.index()]) {
        let vertices = aged.vertices(f);
        for t in aged.grid.triangles() {
            count(aged.front(), &t.map(|i| vertices[i as usize] as u32));
        }
    }
    for t in backs.triangles() {
        count(backs, &t);
    }
    let open = edges.values().filter(|&&n| n == 1).count();
    // Backs of faces that are partly attached have no front here.
    assert!(open * 5 < edges.len(), "{open} of {} edges are open", edges.len());
    let rims = topology.all_half_edges().filter(|&h| aged.surface().backs.rims.vertices_of(h).is_some()).count();
    assert!(rims > 100, "{rims}");
}

#[test]
fn nothing_dips_below_the_props_surface() {
    let aged = Aged::new(700, 6, 2, 1.0);
    let (mesh, front) = (&aged.film.mesh, aged.front());
    for f in mesh.topology.live_faces() {
        let vertices = aged.vertices(f);
        let normals = mesh.topology.corners(f).map(|v| mesh.geometry.rest_normals[v.index()]);
        for (&at, b) in vertices.iter().zip(aged.grid.points()) {
            let up = normals[0] * b.x + normals[1] * b.y + normals[2] * b.z;
            let height = (Vec3::from_array(front.positions[at]) - Vec3::from_array(front.rest[at])).dot(up);
            assert!(height > -0.01 * mesh.geometry.mean_edge, "{height}");
        }
    }
}

#[test]
fn updates_give_what_a_new_surface_would_be() {
    let mut aged = Aged::new(500, 7, 2, 0.3);
    let mut settings = CoatingSettings::default();
    settings.scale.grain = 0.05;
    let mut changes = DisplayChanges::default();
    for _ in 0..100 {
        aged.film.step(&settings, &Environment::default());
        changes.record(&aged.film.changes, &aged.film.stains);
        let FilmState { mesh, forces, stains, .. } = &aged.film;
        aged.fine.update(mesh, forces, stains, changes.take());
    }
    let FilmState { mesh, forces, stains, .. } = &aged.film;
    let piece = Arc::new(aged.piece);
    let (built, surface): (&BuiltFilm, _) = (&piece.film, &piece.surface);
    let detail = Detail { level: 2, ..Detail::default() };
    let fresh = FilmAppearance::with_detail(built, surface, mesh, forces, stains, detail).unwrap();
    for (now, fresh) in [
        (aged.fine.front(0), fresh.front(0)),
        (aged.fine.backs(0), fresh.backs(0)),
        (aged.fine.metal(0), fresh.metal(0)),
    ] {
        let (now, fresh) = (now.unwrap(), fresh.unwrap());
        assert_eq!(shown(now), shown(fresh));
    }
}

#[test]
fn other_levels_show_the_same_film() {
    let aged = Aged::new(500, 8, 3, 0.9);
    let FilmState { mesh, forces, stains, .. } = &aged.film;
    let live = mesh.topology.live_faces().count();
    for level in 0..=3u32 {
        let other = aged.fine.levels().appearance(level, mesh, forces, stains);
        let (front, finest) = (other.front(0).unwrap(), aged.front());
        assert_eq!((other.level(), front.triangles().count()), (level, live << (2 * level)));
        if level == 3 {
            assert_eq!(shown(front), shown(finest));
        } else if level > 0 {
            // Every point is one of the finest, but for chips, which waves of an edge shape at each level alike.
            let grid = FaceGrid::new(level);
            let own = aged.grid.points_of(&grid);
            for f in mesh.topology.live_faces() {
                let (vertices, of_finest) = (vertices(&other, &mesh.topology, f), aged.vertices(f));
                for (vertex, &i) in vertices.into_iter().zip(&own) {
                    let (place, fine) = (front.positions[vertex], finest.positions[of_finest[i as usize]]);
                    let gap = Vec3::from_array(place).distance(Vec3::from_array(fine));
                    assert!(gap < 0.02 * mesh.geometry.mean_edge, "{gap} at level {level}");
                }
            }
        }
    }
}

#[test]
fn slivers_are_chipped_no_further_than_they_are_wide() {
    // A long triangle whose apex lies far beside the edge that it shares with another.
    let corners = vec![Vec3::ZERO, Vec3::X, Vec3::new(20.0, 0.2, 0.0), Vec3::new(0.5, -0.9, 0.0)];
    let mut mesh = FilmMesh::new(corners, &[[0, 1, 2], [1, 0, 3]]).unwrap();
    mesh.tear(HalfEdgeId(0), Vec3::NEG_Y).unwrap();
    for (h, most) in [(HalfEdgeId(0), 0.01), (HalfEdgeId(3), 0.01)] {
        let chip = Chip::of(&mesh, h, 0.3).unwrap();
        for i in 0..=16 {
            let t = i as f32 / 16.0;
            let shift = chip.shift(Vec3::new(1.0 - t, t, 0.0));
            assert!(shift.abs() <= most, "{shift}");
            assert!(chip.moved(shift).abs().max_element() < 0.4);
        }
    }
}
