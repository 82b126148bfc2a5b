//! Random tears on random meshes keep every invariant.

use bevy_math::Vec3;
use proptest::prelude::*;

use super::*;

/// A `w` x `h` grid of quads, each split into two triangles, with open borders.
pub(crate) fn grid(w: u32, h: u32) -> (Vec<Vec3>, Vec<[u32; 3]>) {
    let positions = (0..=h).flat_map(|y| (0..=w).map(move |x| Vec3::new(x as f32, y as f32, 0.0))).collect();
    let row = w + 1;
    let triangles = (0..h)
        .flat_map(|y| (0..w).map(move |x| y * row + x))
        .flat_map(|i| [[i, i + 1, i + row + 1], [i, i + row + 1, i + row]])
        .collect();
    (positions, triangles)
}

/// A closed octahedron, each face split into four `levels` times and pushed onto the unit sphere.
pub(crate) fn sphere(levels: u32) -> (Vec<Vec3>, Vec<[u32; 3]>) {
    let mut positions = vec![Vec3::X, Vec3::Y, Vec3::Z, Vec3::NEG_X, Vec3::NEG_Y, Vec3::NEG_Z];
    let mut triangles: Vec<[u32; 3]> =
        vec![[0, 1, 2], [1, 3, 2], [3, 4, 2], [4, 0, 2], [1, 0, 5], [3, 1, 5], [4, 3, 5], [0, 4, 5]];
    for _ in 0..levels {
        let mut middles = std::collections::BTreeMap::new();
        let mut split = Vec::new();
        for t in &triangles {
            let m = [0, 1, 2].map(|i| {
                let (a, b) = (t[i], t[(i + 1) % 3]);
                *middles.entry((a.min(b), a.max(b))).or_insert_with(|| {
                    positions.push((positions[a as usize] + positions[b as usize]).normalize());
                    positions.len() as u32 - 1
                })
            });
            split.extend([[t[0], m[0], m[2]], [t[1], m[1], m[0]], [t[2], m[2], m[1]], m]);
        }
        triangles = split;
    }
    (positions, triangles)
}

/// A grid whose left and right sides are one, a tube with two borders; or also its ends, a torus.
pub(crate) fn wrapped(w: u32, h: u32, ends_too: bool) -> (Vec<Vec3>, Vec<[u32; 3]>) {
    use bevy_math::ops;
    use core::f32::consts::TAU;
    let rows = if ends_too { h } else { h + 1 };
    let place = |x: u32, y: u32| {
        let (a, b) = (TAU * x as f32 / w as f32, TAU * y as f32 / rows as f32);
        let bend = if ends_too { b } else { 0.0 };
        let out = 3.0 + ops::cos(a);
        Vec3::new(out * ops::cos(bend), out * ops::sin(bend) + if ends_too { 0.0 } else { y as f32 }, ops::sin(a))
    };
    let positions = (0..rows).flat_map(|y| (0..w).map(move |x| place(x, y))).collect();
    let at = move |x: u32, y: u32| (y % rows) * w + x % w;
    let triangles = (0..h)
        .flat_map(|y| (0..w).map(move |x| (x, y)))
        .flat_map(|(x, y)| [[at(x, y), at(x + 1, y), at(x + 1, y + 1)], [at(x, y), at(x + 1, y + 1), at(x, y + 1)]])
        .collect();
    (positions, triangles)
}

/// Both meshes as shells of one film.
pub(crate) fn shells(a: (Vec<Vec3>, Vec<[u32; 3]>), b: (Vec<Vec3>, Vec<[u32; 3]>)) -> (Vec<Vec3>, Vec<[u32; 3]>) {
    let offset = a.0.len() as u32;
    let positions = a.0.into_iter().chain(b.0.into_iter().map(|p| p + Vec3::X * 20.0)).collect();
    let triangles = a.1.into_iter().chain(b.1.into_iter().map(|t| t.map(|v| v + offset))).collect();
    (positions, triangles)
}

fn film((positions, triangles): (Vec<Vec3>, Vec<[u32; 3]>)) -> FilmMesh {
    FilmMesh::new(positions, &triangles).expect("test meshes are manifold")
}

/// Sheets, tubes, spheres, tori and films of two shells.
pub(crate) fn any_mesh() -> impl Strategy<Value = FilmMesh> {
    prop_oneof![
        (1u32..6, 1u32..6).prop_map(|(w, h)| film(grid(w, h))),
        (0u32..3).prop_map(|l| film(sphere(l))),
        (3u32..7, 3u32..7, any::<bool>()).prop_map(|(w, h, ends_too)| film(wrapped(w, h, ends_too))),
        (1u32..4, 0u32..2).prop_map(|(w, l)| film(shells(grid(w, 3), sphere(l)))),
    ]
}

/// Number of shells of live faces plus handles and holes, by counting: V - E + F with edges counted once
/// while bound and twice when torn.
fn euler(film: &FilmMesh) -> i64 {
    let t = &film.topology;
    let vertices = t.all_vertices().filter(|&v| t.has_faces(v)).count() as i64;
    let faces = t.live_faces().count() as i64;
    let half: i64 =
        t.live_faces().flat_map(FaceId::half_edges).map(|h| if t.bound_twin(h).is_some() { 1 } else { 2 }).sum();
    vertices - half / 2 + faces
}

proptest! {
    #[test]
    fn random_tears_and_strips_keep_every_invariant(
        mut film in any_mesh(),
        picks in prop::collection::vec(any::<u32>(), 1..150),
    ) {
        film.validate().unwrap();
        let edges: Vec<_> = film.topology.all_edges().collect();
        for pick in picks {
            let h = edges[pick as usize % edges.len()];
            let before = (euler(&film), film.topology.vertex_count());
            let bound = film.topology.bound_twin(h).is_some() && film.topology.is_live(h.face());
            let ends = film.tear(h, Vec3::NEG_Y);
            prop_assert_eq!(ends.is_some(), bound);
            film.validate().unwrap();
            if let Some(ends) = ends {
                let splits = ends.iter().filter(|e| matches!(e, TearEnd::Split { .. })).count();
                prop_assert_eq!(film.topology.vertex_count(), before.1 + splits);
                // One edge more; each split adds a vertex: opening twice takes one from Euler's number.
                prop_assert_eq!(euler(&film), before.0 - 1 + splits as i64);
                for f in [h.face(), film.topology.rest_twin(h).unwrap().face()] {
                    if film.topology.is_cut_out(f) {
                        prop_assert!(film.topology.strip(f));
                        prop_assert!(!film.topology.strip(f), "a stripped face strips once");
                        film.validate().unwrap();
                    }
                }
            }
        }
    }

    #[test]
    fn tearing_everything_leaves_single_faces(mut film in any_mesh()) {
        let edges: Vec<_> = film.topology.all_edges().filter(|&h| film.topology.rest_twin(h).is_some()).collect();
        for h in edges {
            prop_assert!(film.tear(h, Vec3::NEG_Z).is_some());
        }
        film.validate().unwrap();
        prop_assert_eq!(film.topology.vertex_count(), film.topology.face_count() * 3);
    }
}

#[test]
fn first_tear_inside_makes_two_tips_and_no_vertex() {
    let mut film = film(sphere(2));
    let h = HalfEdgeId(10);
    let (a, b) = (film.topology.origin(h), film.topology.target(h));
    assert_eq!(film.tear(h, Vec3::NEG_Y), Some([TearEnd::Opened(a), TearEnd::Opened(b)]));
    assert_eq!(film.topology.vertex_count(), film.topology.original_vertex_count());
    assert!(!film.topology.is_closed_fan(a));
}

#[test]
fn a_border_vertex_splits_at_the_first_tear() {
    let mut film = film(grid(2, 2));
    // The vertical edge from the middle of the bottom side up to the centre.
    let h = film.topology.all_edges().find(|&h| {
        let ends = [film.topology.origin(h).0, film.topology.target(h).0];
        ends.contains(&1) && ends.contains(&4)
    });
    let ends = film.tear(h.unwrap(), Vec3::NEG_Y).unwrap();
    assert!(ends.contains(&TearEnd::Opened(VertexId(4))), "the centre is a tip: {ends:?}");
    assert!(ends.contains(&TearEnd::Split { kept: VertexId(1), duplicate: VertexId(9) }), "{ends:?}");
    assert!(film.topology.is_border(VertexId(9)) && film.topology.original(VertexId(9)) == VertexId(1));
}

#[test]
fn the_fan_lowest_along_gravity_keeps_the_vertex() {
    // The horizontal middle line of a grid, torn through: the faces below keep the original vertices.
    for (gravity, below) in [(Vec3::NEG_Y, true), (Vec3::Y, false)] {
        let mut film = film(grid(4, 2));
        for x in 5..9 {
            let h = film.topology.all_edges().find(|&h| {
                let (a, b) = (film.topology.origin(h).0, film.topology.target(h).0);
                (a.min(b), a.max(b)) == (x, x + 1)
            });
            film.tear(h.unwrap(), gravity).unwrap();
        }
        film.validate().unwrap();
        for x in 5..10 {
            let v = VertexId(x);
            let lower = film.topology.fan(v).all(|h| film.geometry.rest_centroid(&film.topology, h.face()).y < 1.0);
            assert_eq!(lower, below, "vertex {x}, gravity {gravity}");
        }
    }
}

#[test]
fn dihedral_runs_over_a_full_turn() {
    use bevy_math::ops;
    use core::f32::consts::PI;
    for i in 1..72 {
        let phi = i as f32 * PI / 36.0;
        // Edge along +y at the origin; wing 1 to -x stays, wing 2 turns. Outside is +z when flat.
        let (p1, p2) = (Vec3::ZERO, Vec3::Y);
        let p3 = Vec3::new(-1.0, 0.3, 0.0);
        // The angle on the outer side, from wing 1 (pointing to -x) through +z to wing 2.
        let p4 = Vec3::new(-ops::cos(phi), 0.6, ops::sin(phi));
        let found = signed_dihedral(p1, p2, p3, p4).unwrap();
        assert!((found - phi).abs() < 1e-4, "{found} for {phi}");
    }
}

#[test]
fn coordinates_next_to_zero_are_zero() {
    let positions = vec![Vec3::new(-0.0, 4e-44, 0.0), Vec3::new(1.0, -1e-31, 1e-29), Vec3::Y];
    let film = FilmMesh::new(positions, &[[0, 1, 2]]).expect("a manifold");
    let bits = film.geometry.positions.iter().map(|p| p.to_array().map(f32::to_bits)).collect::<Vec<_>>();
    let expected = [[-0.0, 0.0, 0.0], [1.0, -0.0, 1e-29], [0.0, 1.0, 0.0_f32]].map(|p| p.map(f32::to_bits));
    assert_eq!(bits, expected);
}

#[test]
fn bad_triangles_are_refused() {
    let p = vec![Vec3::ZERO; 5];
    let new = |t: &[[u32; 3]]| FilmMesh::new(p.clone(), t).map(|_| ()).unwrap_err();
    assert!(matches!(new(&[[0, 1, 9]]), TopologyError::BadTriangle { triangle: 0, .. }));
    assert!(matches!(new(&[[0, 1, 1]]), TopologyError::BadTriangle { .. }));
    assert!(matches!(new(&[[0, 1, 2], [0, 1, 3]]), TopologyError::NonManifoldEdge { .. }));
    assert!(matches!(new(&[[0, 1, 2], [1, 0, 3], [0, 1, 4]]), TopologyError::NonManifoldEdge { .. }));
    assert!(matches!(new(&[[0, 1, 2], [0, 3, 4]]), TopologyError::NonManifoldVertex { vertex: 0 }));
}

#[test]
fn a_tear_from_border_to_border_splits_both_ends_and_the_lower_face_keeps_them() {
    let corners = vec![Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y];
    let mut film = FilmMesh::new(corners, &[[0, 1, 2], [0, 2, 3]]).unwrap();
    let diagonal = FaceId(0).half_edges()[2]; // From vertex 2 to vertex 0.
    assert!(!film.topology.strip(FaceId(0)), "still bound to face 1");
    let ends = film.tear(diagonal, Vec3::NEG_Y).unwrap();
    assert_eq!(ends[0], TearEnd::Split { kept: VertexId(2), duplicate: VertexId(4) });
    assert_eq!(ends[1], TearEnd::Split { kept: VertexId(0), duplicate: VertexId(5) });
    assert_eq!(film.geometry.positions[4], film.geometry.positions[2]);
    assert_eq!(film.tear(diagonal, Vec3::NEG_Y), None, "torn already");
    assert!(film.topology.strip(FaceId(0)));
    assert_eq!((film.topology.fate(FaceId(0)), film.topology.fate(FaceId(1))), (FaceFate::Stripped, FaceFate::Live));
}
