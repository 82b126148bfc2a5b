use bevy_math::{Vec2, Vec3};
use proptest::prelude::*;
use rand::seq::SliceRandom;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::checker::{check, euler_and_borders, shells};
use super::{CleanSurface, clean, twins};
use crate::surface::{BuildError, BuildWarning, Surface};

fn surface(positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> Surface {
    Surface {
        positions: positions.iter().copied().map(Vec3::from).collect(),
        triangles: triangles.to_vec(),
        ..Default::default()
    }
}

fn checked(surface: &Surface) -> CleanSurface {
    let clean = clean(surface).unwrap();
    check(surface, &clean);
    assert_eq!(clean, super::clean(surface).unwrap(), "the same input gives the same bits");
    clean
}

fn cube() -> Surface {
    let positions: Vec<[f32; 3]> = (0..8).map(|i| [i & 1, i >> 1 & 1, i >> 2 & 1].map(|x| x as f32)).collect();
    let quads = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let triangles: Vec<_> = quads.iter().flat_map(|&[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    surface(&positions, &triangles)
}

/// Every triangle with three vertices of its own.
fn soup(mesh: &Surface) -> Surface {
    let positions: Vec<Vec3> = mesh.triangles.iter().flatten().map(|v| mesh.positions[*v as usize]).collect();
    let triangles = (0..mesh.triangles.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
    Surface { positions, triangles, ..Default::default() }
}

/// `rows` by `columns` quads over a square of the plane, or bent by `bend`.
fn grid(rows: u32, columns: u32, bend: impl Fn(f32, f32) -> Vec3) -> Surface {
    let mut mesh = Surface::default();
    for r in 0..=rows {
        for c in 0..=columns {
            mesh.positions.push(bend(c as f32 / columns as f32, r as f32 / rows as f32));
        }
    }
    for r in 0..rows {
        for c in 0..columns {
            let a = r * (columns + 1) + c;
            let d = a + columns + 1;
            mesh.triangles.extend([[a, a + 1, d], [a + 1, d + 1, d]]);
        }
    }
    mesh
}

/// Volume enclosed by a closed surface, positive if it faces outward.
fn volume(clean: &CleanSurface) -> f32 {
    let corner = |t: &[u32; 3]| t.map(|v| clean.positions[v as usize]);
    clean.triangles.iter().map(corner).map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum()
}

fn scaled(mut mesh: Surface, scale: f32, offset: Vec3) -> Surface {
    for p in &mut mesh.positions {
        *p = *p * scale + offset;
    }
    mesh
}

#[test]
fn refuses_what_cannot_be_read() {
    let nothing = Surface { positions: vec![Vec3::ZERO], ..Default::default() };
    assert_eq!(clean(&nothing), Err(BuildError::NoTriangles));

    let mut mesh = cube();
    mesh.triangles[3][1] = 8;
    assert_eq!(clean(&mesh), Err(BuildError::IndexOutOfRange { triangle: 3, vertex: 8, vertices: 8 }));

    let mut mesh = cube();
    mesh.positions[5].y = f32::INFINITY;
    let position = mesh.positions[5];
    assert_eq!(clean(&mesh), Err(BuildError::NonFinitePosition { vertex: 5, position }));

    let mut mesh = cube();
    mesh.uvs = vec![Vec2::ZERO; 35];
    let error = BuildError::AttributeLength { attribute: "texture coordinates", found: 35, expected: 36 };
    assert_eq!(clean(&mesh), Err(error));
    let mut mesh = cube();
    mesh.slots = vec![0; 13];
    assert!(matches!(clean(&mesh), Err(BuildError::AttributeLength { attribute: "slots", .. })));

    let line = surface(&[[0.0; 3], [1.0; 3], [2.0; 3]], &[[0, 1, 2], [0, 0, 1], [2, 1, 0]]);
    assert_eq!(clean(&line), Err(BuildError::AllDegenerate { triangles: 3 }));
    let point = surface(&[[7.0; 3], [7.0; 3], [7.0; 3]], &[[0, 1, 2]]);
    assert_eq!(clean(&point), Err(BuildError::AllDegenerate { triangles: 1 }));
}

#[test]
fn a_clean_mesh_stays_as_it_is() {
    let mut mesh = cube();
    mesh.positions.insert(3, Vec3::NAN);
    for v in mesh.triangles.iter_mut().flatten() {
        *v += u32::from(*v >= 3);
    }
    let clean = checked(&mesh);
    assert_eq!(clean.triangles, cube().triangles, "an unused vertex that is not finite is ignored");
    assert_eq!(clean.positions, cube().positions);
    assert_eq!(clean.warnings, []);
    assert!(clean.flipped.iter().all(|flipped| !flipped));
    assert!(clean.corners.iter().flatten().copied().eq(0..36));
    assert!(twins(&clean.triangles).iter().all(|twin| *twin != u32::MAX));
}

#[test]
fn welds_a_soup_at_any_magnitude() {
    for scale in [1e-6, 1e-3, 1.0, 1e6, 1e18] {
        let mut mesh = scaled(soup(&cube()), scale, Vec3::ZERO);
        // Both zeros are one place, and so is what exporters round differently.
        mesh.positions[0].x = -0.0;
        mesh.positions[1].y += 1e-7 * scale;
        let clean = checked(&mesh);
        assert_eq!((clean.positions.len(), clean.triangles.len()), (8, 12), "scale {scale}");
        assert_eq!(euler_and_borders(&clean.triangles, 8), (2, 0));
    }
}

#[test]
fn thin_sheets_and_small_details_do_not_collapse() {
    // A plate much thinner than the welding tolerance, with its side walls.
    let mut plate = cube();
    for p in &mut plate.positions {
        p.z *= 3e-6;
    }
    let clean = checked(&plate);
    assert_eq!((clean.positions.len(), clean.triangles.len()), (8, 12));

    // A bolt whose edges are shorter than the tolerance of the whole prop.
    let mut prop = scaled(cube(), 1e5, Vec3::ZERO);
    prop.positions.extend(cube().positions.iter().map(|p| *p - 2.0));
    prop.triangles.extend(cube().triangles.iter().map(|t| t.map(|v| v + 8)));
    let clean = checked(&prop);
    assert_eq!((clean.positions.len(), clean.triangles.len()), (16, 24));
}

#[test]
fn a_cap_that_fills_a_t_junction_leaves_no_hole() {
    // The edge 0-1 of the bottom is one edge below and three in front, and caps fill the gap, as in exported
    // props: the middle vertices 8 and 9 lie on the edge.
    let mut mesh = cube();
    mesh.positions.extend([Vec3::new(0.25, 0.0, 0.0), Vec3::new(0.75, 0.0, 0.0)]);
    mesh.triangles.retain(|t| *t != [0, 1, 5]);
    mesh.triangles.extend([[0, 8, 5], [8, 9, 5], [9, 1, 5]]);
    mesh.triangles.extend([[0, 1, 8], [8, 1, 9]]);
    mesh.uvs = mesh.triangles.iter().flatten().map(|v| mesh.positions[*v as usize].truncate()).collect();
    let clean = checked(&mesh);
    assert_eq!(clean.warnings, [BuildWarning::DegenerateDropped(2)]);
    assert_eq!(euler_and_borders(&clean.triangles, clean.positions.len()), (2, 0));
    assert_eq!(clean.triangles.len(), 11 + 3 + 2, "the bottom face is split at both vertices");
    assert!((volume(&clean) - 1.0).abs() < 1e-6);
    for (f, sites) in clean.sites.iter().enumerate() {
        for (k, site) in sites.iter().enumerate() {
            let uv: Vec2 = (0..3).map(|i| mesh.uvs[3 * site.triangle as usize + i] * site.weights[i]).sum();
            assert!(uv.distance(clean.positions[clean.triangles[f][k] as usize].truncate()) < 1e-6);
        }
    }
}

#[test]
fn a_needle_is_collapsed_and_its_neighbours_meet() {
    // Vertex 8 is vertex 3 again, one rounding step away, and only the needles around it make it watertight:
    // the edge between the two is far too short to be drawn, but the weld must not join ends of an edge.
    let mut mesh = cube();
    mesh.positions.push(Vec3::new(1.0, 1.0, 1e-7));
    for t in &mut mesh.triangles {
        if *t == [2, 7, 3] {
            *t = [2, 7, 8];
        }
    }
    mesh.triangles.extend([[2, 8, 3], [3, 8, 7]]);
    let clean = checked(&mesh);
    assert_eq!(clean.warnings, [BuildWarning::DegenerateDropped(2)]);
    assert_eq!(clean.triangles.len(), 12);
    assert_eq!(euler_and_borders(&clean.triangles, clean.positions.len()), (2, 0));
}

#[test]
fn duplicates_are_dropped_and_two_sided_sheets_are_two_sheets() {
    let mut mesh = cube();
    mesh.triangles.extend([[4, 6, 0], [2, 0, 6]]);
    let clean = checked(&mesh);
    assert_eq!(clean.warnings, [BuildWarning::DuplicatesDropped(2)]);
    assert_eq!(clean.triangles, cube().triangles);

    let sheet = grid(3, 4, |x, y| Vec3::new(x, y, x * y));
    let mut both = sheet.clone();
    both.triangles.extend(sheet.triangles.iter().map(|&[a, b, c]| [a, c, b]));
    let clean = checked(&both);
    assert_eq!(clean.positions.len(), 2 * sheet.positions.len());
    assert_eq!(clean.triangles.len(), 2 * sheet.triangles.len());
    assert_eq!(shells(&clean), 2);
    assert!(clean.flipped.iter().all(|flipped| !flipped), "each side keeps its winding");
}

#[test]
fn the_larger_area_decides_the_winding() {
    let mut mesh = cube();
    for t in [0, 5, 6] {
        mesh.triangles[t].swap(1, 2);
    }
    let clean = checked(&mesh);
    assert_eq!(clean.warnings, [BuildWarning::WindingTurned(3)]);
    assert!((volume(&clean) - 1.0).abs() < 1e-6);
    for t in 0..12 {
        assert_eq!(clean.flipped[t], [0, 5, 6].contains(&t));
        for k in 0..3 {
            let corner = clean.corners[t][k] as usize;
            assert_eq!(clean.triangles[t][k], mesh.triangles[corner / 3][corner % 3], "corners follow the turn");
        }
    }
}

#[test]
fn a_moebius_band_is_cut_once() {
    let columns = 24;
    let band = grid(3, columns, |x, y| {
        let (turn, half) = (x * std::f32::consts::TAU, x * std::f32::consts::PI);
        let radius = 2.0 + (y - 0.5) * bevy_math::ops::cos(half);
        let [sin, cos] = [bevy_math::ops::sin(turn), bevy_math::ops::cos(turn)];
        Vec3::new(radius * cos, radius * sin, (y - 0.5) * bevy_math::ops::sin(half))
    });
    let clean = checked(&band);
    let cut = clean.warnings.iter().find_map(|w| match w {
        BuildWarning::OneSidedEdgesCut(cut) => Some(*cut),
        _ => None,
    });
    assert!(cut.is_some_and(|cut| (3..=9).contains(&cut)), "{:?}", clean.warnings);
    assert_eq!(clean.triangles.len(), 6 * columns as usize);
    assert_eq!(shells(&clean), 1);
    assert_eq!(euler_and_borders(&clean.triangles, clean.positions.len()).0, 1, "a cut band is a disk");
}

#[test]
fn a_fin_leaves_the_flat_sheet_whole() {
    // Two halves of a flat sheet with a fin on their common edge 0-1.
    let positions = [[0.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 0.5, 0.0], [-1.0, 0.5, 0.0], [0.1, 0.5, 1.0]];
    let clean = checked(&surface(&positions, &[[0, 1, 4], [0, 1, 3], [1, 0, 2]]));
    assert_eq!(clean.warnings, [BuildWarning::NonManifoldEdgesSplit(1)]);
    assert_eq!(clean.positions.len(), 7);
    assert_eq!(shells(&clean), 2);
    let twin = twins(&clean.triangles);
    assert!(twin[..3].iter().all(|twin| *twin == u32::MAX), "the fin stands alone");
}

/// Two unit cubes as a soup, the second moved by `offset`.
fn two_cubes(offset: Vec3) -> Surface {
    let mut mesh = soup(&cube());
    mesh.positions.extend(soup(&cube()).positions.iter().map(|p| *p + offset));
    mesh.triangles.extend((12..24).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]));
    mesh
}

#[test]
fn cubes_that_touch_come_apart() {
    for offset in [Vec3::new(1.0, 1.0, 0.0), Vec3::ONE] {
        let clean = checked(&two_cubes(offset));
        assert_eq!(clean.positions.len(), 16, "offset {offset}");
        assert_eq!(euler_and_borders(&clean.triangles, clean.positions.len()), (4, 0));
        assert_eq!(shells(&clean), 2);
        assert!((volume(&clean) - 2.0).abs() < 1e-5);
    }
}

#[test]
fn cubes_that_share_a_face_are_one_box() {
    // The common face, which nobody sees, is left inside as two sheets back to back.
    let clean = checked(&two_cubes(Vec3::X));
    assert_eq!(clean.positions.len(), 12 + 4 + 4);
    assert_eq!(euler_and_borders(&clean.triangles, clean.positions.len()), (2 + 1 + 1, 4 + 4));
    assert_eq!(shells(&clean), 3);
    assert!((volume(&clean) - 2.0).abs() < 1e-5);
}

#[test]
fn sheets_that_meet_in_a_point_are_split() {
    let mesh = surface(
        &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [-1.0, -1.0, 0.0]],
        &[[0, 1, 2], [0, 3, 4]],
    );
    let clean = checked(&mesh);
    assert_eq!(clean.warnings, [BuildWarning::NonManifoldVerticesSplit(1)]);
    assert_eq!(clean.positions.len(), 6);
}

/// A closed blob, an open sheet, or both at the same place.
fn base_mesh(kind: u8) -> Surface {
    let sheet = grid(5, 6, |x, y| Vec3::new(x - 0.3, y - 0.4, x * y));
    match kind % 3 {
        0 => cube(),
        1 => sheet,
        _ => {
            let mut mesh = cube();
            let offset = mesh.positions.len() as u32;
            mesh.positions.extend(&sheet.positions);
            mesh.triangles.extend(sheet.triangles.iter().map(|t| t.map(|v| v + offset)));
            mesh
        }
    }
}

/// A cube somewhere, with T-junctions on T-junctions, each filled with a triangle without area, and needles beside
/// them.
fn cube_with_junctions(seed: u64, junctions: usize, offset: f32) -> Surface {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let axis = Vec3::new(rng.random(), rng.random(), rng.random::<f32>() + 0.1).normalize();
    let turn = bevy_math::Quat::from_axis_angle(axis, rng.random_range(0.0..3.0));
    let mut mesh = cube();
    for p in &mut mesh.positions {
        *p = turn * *p + offset;
    }
    for _ in 0..junctions {
        let t = rng.random_range(0..mesh.triangles.len());
        let k = rng.random_range(0..3);
        let [a, b, c] = [0, 1, 2].map(|i| mesh.triangles[t][(k + i) % 3]);
        let along = if rng.random_bool(0.1) { 1e-7 } else { rng.random_range(0.2..0.8) };
        let middle = mesh.positions.len() as u32;
        mesh.positions.push(mesh.positions[a as usize].lerp(mesh.positions[b as usize], along));
        mesh.triangles[t] = [a, middle, c];
        mesh.triangles.extend([[middle, b, c], [a, b, middle]]);
    }
    mesh
}

/// Fillers to which rounding gave some area may enclose next to nothing in a shell of their own; each shell is closed.
fn check_watertight(mesh: &Surface) {
    let clean = checked(mesh);
    assert_eq!(euler_and_borders(&clean.triangles, clean.positions.len()), (2 * shells(&clean) as i64, 0));
    assert!(shells(&clean) <= 2 && (volume(&clean).abs() - 1.0).abs() < 1e-2);
}

#[test]
fn junctions_within_junctions_leave_no_hole() {
    // Finds of the property below: fillers with opposite windings that welding brought onto the same vertices were
    // taken for the sides of a sheet, those with the same winding for copies; edges flipped to and fro until the steps
    // were used up; a shell of four fillers.
    for (seed, junctions, offset) in [
        (7_862_118_190_122_989_298, 35, 12.441_142),
        (16_625_212_790_208_152_660, 20, 0.0),
        (15_952_003_633_337_895_482, 28, 16.465_145),
        (18_174_603_407_137_491_069, 36, -0.051_240_92),
    ] {
        check_watertight(&cube_with_junctions(seed, junctions, offset));
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    /// Few vertices and many triangles: non-manifold edges and vertices everywhere.
    #[test]
    fn random_soups_become_manifolds(seed: u64, vertices in 4_u32..14, triangles in 1_usize..60) {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut vertex = || Vec3::new(rng.random(), rng.random(), rng.random());
        let positions = (0..vertices).map(|_| vertex()).collect();
        let triangles = (0..triangles).map(|_| [(); 3].map(|()| rng.random_range(0..vertices))).collect();
        let mesh = Surface { positions, triangles, ..Default::default() };
        match clean(&mesh) {
            Ok(clean) => check(&mesh, &clean),
            Err(error) => prop_assert_eq!(error, BuildError::AllDegenerate { triangles: mesh.triangles.len() }),
        }
    }

    /// Vertices on a small lattice: caps, needles, overlaps and coincident vertices everywhere.
    #[test]
    fn random_lattice_soups_become_manifolds(seed: u64, side in 2_u8..5, triangles in 1_usize..80) {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut positions = Vec::new();
        for _ in 0..3 * triangles {
            positions.push(Vec3::from([(); 3].map(|()| f32::from(rng.random_range(0..side)))));
        }
        let mesh = soup(&Surface {
            triangles: (0..triangles as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect(),
            positions,
            ..Default::default()
        });
        match clean(&mesh) {
            Ok(clean) => {
                check(&mesh, &clean);
                prop_assert_eq!(&clean, &super::clean(&mesh).unwrap());
            }
            Err(error) => prop_assert_eq!(error, BuildError::AllDegenerate { triangles: mesh.triangles.len() }),
        }
    }

    /// Order, windings, rotations, repeats and lost welds do not change a manifold prop.
    #[test]
    fn a_mangled_mesh_is_recovered(seed: u64, kind in 0_u8..2, turned in 0.0_f64..0.4, noise in 0.0_f32..5e-7) {
        let base = base_mesh(kind);
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut mesh = soup(&base);
        for p in &mut mesh.positions {
            *p += noise * Vec3::new(rng.random(), rng.random(), rng.random());
        }
        let repeats: Vec<_> = mesh.triangles.iter().copied().filter(|_| rng.random_bool(0.2)).collect();
        mesh.triangles.extend(&repeats);
        for t in &mut mesh.triangles {
            t.rotate_left(rng.random_range(0..3));
        }
        // All copies of one triangle turn alike: turned against each other they would be a two-sided sheet.
        let turned: Vec<bool> = base.triangles.iter().map(|_| rng.random_bool(turned)).collect();
        for t in &mut mesh.triangles {
            if turned[t[0] as usize / 3] {
                t.swap(1, 2);
            }
        }
        mesh.triangles.shuffle(&mut rng);
        let clean = checked(&mesh);
        let expected = checked(&base);
        prop_assert_eq!(clean.positions.len(), expected.positions.len());
        prop_assert_eq!(clean.triangles.len(), expected.triangles.len());
        prop_assert_eq!(
            euler_and_borders(&clean.triangles, clean.positions.len()),
            euler_and_borders(&expected.triangles, expected.positions.len())
        );
        prop_assert_eq!(shells(&clean), shells(&expected));
    }

    /// Dissolving all of them leaves no hole, wherever rounding has put the middle vertices.
    #[test]
    fn filled_junctions_are_watertight(seed: u64, junctions in 1_usize..40, offset in -20.0_f32..20.0) {
        check_watertight(&cube_with_junctions(seed, junctions, offset));
    }

    /// Pages bound at one spine of several edges: at most half as many sheets as pages go through it.
    #[test]
    fn books_of_pages_come_apart(seed: u64, pages in 2_usize..9, length in 1_u32..5) {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        let mut mesh = Surface::default();
        for i in 0..pages {
            let angle = std::f32::consts::TAU * (i as f32 + 0.9 * rng.random::<f32>()) / pages as f32;
            let (sin, cos) = (bevy_math::ops::sin(angle), bevy_math::ops::cos(angle));
            let page = soup(&grid(length, 2, |x, y| Vec3::new(x * cos, x * sin, y)));
            let offset = mesh.positions.len() as u32;
            let turn = rng.random_bool(0.5);
            mesh.positions.extend(page.positions);
            mesh.triangles.extend(page.triangles.iter().map(|&[a, b, c]| {
                [a, b, c].map(|v| v + offset)
            }).map(|[a, b, c]| if turn { [a, c, b] } else { [a, b, c] }));
        }
        let clean = checked(&mesh);
        prop_assert_eq!(clean.triangles.len(), mesh.triangles.len());
        prop_assert!(shells(&clean) >= pages.div_ceil(2));
        // Sheets lie flat or bent over the whole spine: each is a disk.
        prop_assert_eq!(euler_and_borders(&clean.triangles, clean.positions.len()).0, shells(&clean) as i64);
    }
}
