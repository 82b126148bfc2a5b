//! Tests exposure with roofs, boxes and single rays.

use core::f32::consts::{FRAC_PI_2, PI};

use std::sync::Arc;

use bevy_math::{Affine3A, Mat3, Quat, Vec3};
use proptest::prelude::*;

use super::{
    ray::Ray,
    surface::{Blocker, ExposedSurface, exposure_of},
    tree::TriangleTree,
};
use crate::{film::FilmMesh, remesh::sample::plate, stain::fields::Exposure};

/// Makes a rectangle in the plane y = `height`, over `min` to `max` in x and z.
fn roof(height: f32, min: [f32; 2], max: [f32; 2]) -> [[Vec3; 3]; 2] {
    let [a, b, c, d] =
        [[min[0], min[1]], [max[0], min[1]], [max[0], max[1]], [min[0], max[1]]].map(|[x, z]| Vec3::new(x, height, z));
    [[a, b, c], [a, c, d]]
}

/// Makes a film of `n` by `n` squares over 0 to 1 in x and z, facing up.
fn floor(n: u32) -> FilmMesh {
    let side = n + 1;
    let positions = (0..side * side).map(|i| Vec3::new((i % side) as f32, 0.0, (i / side) as f32) / n as f32).collect();
    let mut triangles = Vec::new();
    for (x, z) in (0..n).flat_map(|x| (0..n).map(move |z| (x, z))) {
        let a = z * side + x;
        triangles.extend([[a, a + side, a + 1], [a + 1, a + side, a + side + 1]]);
    }
    FilmMesh::new(positions, &triangles).unwrap()
}

/// Makes a box from -`half` to `half`, with `n` by `n` squares a side that share their vertices along its edges.
fn cube(n: i32, half: f32) -> FilmMesh {
    let (mut positions, mut triangles) = (Vec::<Vec3>::new(), Vec::new());
    let mut at = |p: Vec3| {
        positions.iter().position(|q| q.distance(p) < 1e-4).unwrap_or_else(|| {
            positions.push(p);
            positions.len() - 1
        }) as u32
    };
    for turn in [
        Quat::IDENTITY,
        Quat::from_rotation_z(FRAC_PI_2),
        Quat::from_rotation_z(PI),
        Quat::from_rotation_z(-FRAC_PI_2),
        Quat::from_rotation_x(FRAC_PI_2),
        Quat::from_rotation_x(-FRAC_PI_2),
    ] {
        let corner = |x: i32, z: i32| {
            turn * (Vec3::new(2.0 * x as f32 / n as f32 - 1.0, 1.0, 2.0 * z as f32 / n as f32 - 1.0) * half)
        };
        for (x, z) in (0..n).flat_map(|x| (0..n).map(move |z| (x, z))) {
            let [a, b, c, d] = [(x, z), (x, z + 1), (x + 1, z + 1), (x + 1, z)].map(|(x, z)| at(corner(x, z)));
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    FilmMesh::new(positions, &triangles).unwrap()
}

fn exposure_at(film: &FilmMesh, exposure: &[f32], at: Vec3) -> f32 {
    let nearest = (0..film.topology.original_vertex_count())
        .min_by(|&i, &j| {
            let distance = |i: usize| film.geometry.rest_positions[i].distance_squared(at);
            distance(i).total_cmp(&distance(j))
        })
        .unwrap();
    exposure[nearest]
}

#[test]
fn a_roof_keeps_what_is_under_it_dry_and_has_a_soft_border() {
    let film = floor(40);
    let exposure = exposure_of(&film, roof(1.0, [-9.0, -9.0], [0.5, 9.0]), Vec3::NEG_Y, Vec3::ZERO);
    let at = |x| exposure_at(&film, &exposure.rain, Vec3::new(x, 0.0, 0.5));
    // The cone is 7 cm wide to either side from 1 m below.
    assert_eq!((at(0.0), at(0.4), at(0.6), at(1.0)), (0.0, 0.0, 1.0, 1.0));
    let border: Vec<f32> = (0..7).map(|i| at(0.425 + 0.025 * i as f32)).collect();
    assert!(border.is_sorted() && border[3] > 0.2 && border[3] < 0.8, "{border:?}");
    assert!(exposure.sun.is_empty());
}

#[test]
fn slanted_rain_comes_in_under_a_roof() {
    let film = floor(20);
    let around = roof(0.5, [-9.0, -9.0], [0.5, 9.0]);
    // Falls towards -x: what is 0.5 below the roof gets wet 0.5 further in.
    let exposure = exposure_of(&film, around, Vec3::new(-1.0, -1.0, 0.0), Vec3::new(1.0, -1.0, 0.0));
    let at = |field: &[f32], x| exposure_at(&film, field, Vec3::new(x, 0.0, 0.5));
    assert_eq!((at(&exposure.rain, 0.2), at(&exposure.rain, 0.8)), (1.0, 1.0));
    assert_eq!((at(&exposure.sun, 0.2), at(&exposure.sun, 0.8)), (0.0, 0.0));
}

#[test]
fn a_film_in_the_open_has_no_exposure_to_store() {
    let film = floor(10);
    let below = roof(-0.5, [-9.0, -9.0], [9.0, 9.0]);
    assert_eq!(exposure_of(&film, below, Vec3::NEG_Y, Vec3::new(0.2, -1.0, 0.3)), Exposure::default());
}

#[test]
fn the_film_shelters_itself() {
    let film = cube(8, 0.5);
    let exposure = exposure_of(&film, [], Vec3::NEG_Y, Vec3::ZERO);
    let at = |x, y, z| exposure_at(&film, &exposure.rain, Vec3::new(x, y, z) * 0.5);
    assert_eq!((at(0.0, 1.0, 0.0), at(1.0, 1.0, 1.0)), (1.0, 1.0), "top");
    assert_eq!((at(0.0, -1.0, 0.0), at(1.0, -1.0, 0.3)), (0.0, 0.0), "underside");
    assert_eq!((at(1.0, 0.0, 0.0), at(0.0, 0.0, -1.0)), (1.0, 1.0), "sides: rain along them reaches them");
}

#[test]
fn inside_a_bell_no_rain_falls() {
    // A box turned inside out: the film is on its inner side.
    let outside = cube(6, 0.5);
    let (topology, geometry) = (&outside.topology, &outside.geometry);
    let turned: Vec<[u32; 3]> =
        topology.all_faces().map(|f| topology.corners(f).map(|v| v.0)).map(|[a, b, c]| [a, c, b]).collect();
    let inside = FilmMesh::new(geometry.rest_positions.clone(), &turned).unwrap();
    let exposure = exposure_of(&inside, [], Vec3::new(0.3, -1.0, 0.1), Vec3::ZERO);
    assert_eq!(exposure.rain, vec![0.0; inside.topology.original_vertex_count()]);
}

#[test]
fn fracture_does_not_change_exposure() {
    let mut film = floor(6);
    let around = roof(1.0, [-9.0, -9.0], [0.5, 9.0]);
    let fresh = exposure_of(&film, around, Vec3::NEG_Y, Vec3::Y);
    let inner: Vec<_> =
        film.topology.all_edges().filter(|&h| film.topology.bound_twin(h).is_some()).step_by(3).collect();
    for h in inner {
        film.tear(h, Vec3::NEG_Y);
    }
    film.geometry.positions.iter_mut().for_each(|p| p.y += 0.1);
    assert!(film.topology.vertex_count() > film.topology.original_vertex_count());
    assert_eq!(exposure_of(&film, around, Vec3::NEG_Y, Vec3::Y), fresh);
}

#[test]
fn blockers_may_be_turned_scaled_and_far_from_their_origin() {
    let film = floor(20);
    let place = Affine3A::from_mat3_translation(
        Mat3::from_quat(Quat::from_rotation_y(0.7)) * Mat3::from_diagonal(Vec3::new(3.0, -0.5, 40.0)),
        Vec3::new(12.0, -4.0, 3.0),
    );
    let around = roof(1.0, [-2.0, -2.0], [0.5, 2.0]);
    let tree = Arc::new(TriangleTree::new(around.map(|t| t.map(|p| place.transform_point3(p)))));
    let surface = ExposedSurface::new(&film);
    let placed = surface.cast(&[Blocker { tree, into: place }], Vec3::NEG_Y, Vec3::ZERO);
    let plain = exposure_of(&film, around, Vec3::NEG_Y, Vec3::ZERO);
    let same = placed.rain.iter().zip(&plain.rain).filter(|(a, b)| a == b).count();
    assert!(same > plain.rain.len() * 9 / 10 && plain.rain.contains(&0.0) && plain.rain.contains(&1.0), "{same}");
}

#[test]
fn blockers_that_are_no_shape_block_nothing() {
    let surface = ExposedSurface::new(&floor(4));
    let tree = Arc::new(TriangleTree::new(roof(1.0, [-9.0, -9.0], [9.0, 9.0])));
    for into in [Affine3A::ZERO, Affine3A::NAN, Affine3A::from_scale(Vec3::new(1.0, 0.0, 1.0))] {
        let flat = Blocker { tree: tree.clone(), into };
        assert_eq!(surface.cast(&[flat], Vec3::NEG_Y, Vec3::ZERO), Exposure::default(), "{into:?}");
    }
    let broken = [Vec3::NAN, Vec3::ONE, Vec3::ZERO];
    assert!(TriangleTree::new([broken]).is_empty());
    assert_eq!(surface.cast(&[], Vec3::NAN, Vec3::ZERO), Exposure::default());
}

#[test]
fn no_ray_slips_through_the_seams_of_a_roof() {
    // A roof of many small triangles, so that many rays come close to an edge.
    let film = floor(60);
    let roof: Vec<[Vec3; 3]> = {
        let mesh = plate(4000, 3).unwrap().film;
        let place = |p: Vec3| Vec3::new(p.x * 4.0 + 0.5, 1.0 + 0.1 * p.x, p.y * 4.0 + 0.5);
        mesh.triangles.iter().map(|t| t.map(|v| place(mesh.positions[v as usize]))).collect()
    };
    for rain in [Vec3::NEG_Y, Vec3::new(0.1, -1.0, 0.05)] {
        let exposure = exposure_of(&film, roof.clone(), rain, Vec3::ZERO);
        assert_eq!(exposure.rain, vec![0.0; film.topology.original_vertex_count()], "{rain}");
    }
}

proptest! {
    /// Compares the tree with a test of every triangle.
    #[test]
    fn the_tree_misses_nothing(
        corners in prop::collection::vec(prop::array::uniform3(prop::array::uniform3(-8i8..8)), 0..60),
        origin in prop::array::uniform3(-8i8..8),
        direction in prop::array::uniform3(-3i8..4),
    ) {
        let point = |p: [i8; 3]| Vec3::from_array(p.map(f32::from)) * 0.37;
        let mut triangles: Vec<[Vec3; 3]> = corners.iter().map(|t| t.map(point)).collect();
        prop_assume!(direction != [0; 3]);
        let (origin, direction) = (point(origin), point(direction).normalize());
        // Where a triangle is seen edge on is decided by rounding.
        let seen = |[a, b, c]: &[Vec3; 3]| (*b - *a).cross(*c - *a).dot(direction).abs() > 1e-3;
        triangles.retain(seen);
        let ray = Ray::new(direction);
        let expected = triangles.iter().any(|t| ray.meets_triangle(origin, t));
        prop_assert_eq!(TriangleTree::new(triangles).is_met(&ray, origin), expected);
    }
}
