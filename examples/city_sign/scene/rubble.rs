//! Heaps of broken masonry, and what has scattered from them: convex chunks, bricks and bent bars.

use super::builder::{Corner, MeshBuilder};
use super::{FAR_KERB, KERB, ROAD, Site};
use bevy::prelude::*;
use noise::{NoiseFn, Perlin};

const CONCRETE: [Vec3; 4] = [
    Vec3::new(0.95, 0.90, 0.84),
    Vec3::new(0.72, 0.68, 0.62),
    Vec3::new(0.85, 0.76, 0.64),
    Vec3::new(0.55, 0.50, 0.45),
];
const CLAY: Vec3 = Vec3::new(0.85, 0.36, 0.22);

struct Heap {
    centre: Vec3,
    radius: f32,
    height: f32,
    chunks: u32,
}

pub fn build(site: &mut Site) {
    let heap = |x: f32, y: f32, z: f32, radius: f32, height: f32, chunks: u32| Heap {
        centre: Vec3::new(x, y, z),
        radius,
        height,
        chunks,
    };
    let heaps = [
        // At the foot of the right-hand ruin, behind the sign.
        heap(4.6, 0.0, -6.2, 3.0, 1.25, 420),
        heap(3.0, 0.0, -12.5, 2.6, 0.9, 260),
        heap(4.5, 0.0, -20.0, 4.0, 1.8, 160),
        // Across the street.
        heap(-13.2, 0.0, -9.0, 3.8, 1.7, 300),
        heap(-12.0, 0.0, -17.0, 3.0, 1.1, 150),
        heap(-14.0, 0.0, -30.0, 5.0, 2.4, 130),
        // A collapse that blocks half the road further down.
        heap(-4.0, ROAD, -38.0, 6.0, 1.8, 130),
        heap(-11.0, ROAD, -50.0, 8.0, 4.0, 90),
        heap(2.0, 0.0, -56.0, 9.0, 4.5, 90),
    ];
    let material = site.surfaces.concrete.material(0.9);
    let material = site.materials.add(material);
    for heap in &heaps {
        let mut mesh = MeshBuilder::default();
        mound(&mut mesh, heap);
        for _ in 0..heap.chunks {
            // Denser towards the middle; the largest pieces are rare.
            let angle = site.between(0.0, std::f32::consts::TAU);
            let out = site.between(0.0, 1.0).powf(0.7) * 1.35;
            let place = heap.centre + Vec3::new(angle.cos(), 0.0, angle.sin()) * out * heap.radius;
            let size = 0.05 + 0.42 * site.between(0.0, 1.0).powi(5) * heap.height.min(1.5) + site.between(0.0, 0.09);
            let ground = surface(heap, place).max(ground_height(place));
            scatter(site, &mut mesh, place.with_y(ground + size * 0.15), size);
        }
        site.spawn(mesh, &material);
    }
    // Crumbs on road and pavement, thicker along the kerb and the walls.
    let mut mesh = MeshBuilder::default();
    for _ in 0..900 {
        let z = 1.5 - 26.0 * site.between(0.0, 1.0).powf(1.6);
        let x = match (site.between(0.0, 3.0)) as u32 {
            0 => KERB - 0.05 - 0.8 * site.between(0.0, 1.0).powi(2),
            1 => KERB + 0.2 + 5.0 * site.between(0.0, 1.0),
            _ => site.between(FAR_KERB, KERB),
        };
        let size = 0.008 + 0.05 * site.between(0.0, 1.0).powi(4);
        let place = Vec3::new(x, 0.0, z);
        scatter(site, &mut mesh, place.with_y(ground_height(place) + size * 0.3), size);
    }
    site.spawn(mesh, &material);
}

fn ground_height(at: Vec3) -> f32 {
    if at.x > FAR_KERB && at.x < KERB { ROAD - 0.01 } else { 0.0 }
}

/// Height of the heap's surface; its foot sinks below the ground.
fn surface(heap: &Heap, at: Vec3) -> f32 {
    let out = (at - heap.centre).with_y(0.0).length() / heap.radius;
    let lumps = Perlin::new(5).get([f64::from(at.x) * 0.9, f64::from(at.z) * 0.9]) as f32;
    heap.centre.y - 0.15 + (heap.height + 0.15) * (1.0 - out * out).max(-0.5) * (1.0 + 0.45 * lumps)
}

fn mound(mesh: &mut MeshBuilder, heap: &Heap) {
    let (rings, spokes) = (9, 28);
    let grit = Perlin::new(6);
    let point = |ring: usize, spoke: usize| {
        let angle = std::f32::consts::TAU * (spoke % spokes) as f32 / spokes as f32;
        let out = heap.radius * 1.1 * ring as f32 / rings as f32;
        let at = heap.centre + Vec3::new(angle.cos(), 0.0, angle.sin()) * out;
        let bump = grit.get([f64::from(at.x) * 3.0, f64::from(at.z) * 3.0]) as f32 * 0.10;
        let position = at.with_y(surface(heap, at) + bump);
        Corner::new(position, Vec2::new(at.x, at.z) * 0.5, Vec3::new(0.60, 0.52, 0.43))
    };
    for ring in 0..rings {
        for spoke in 0..spokes {
            let [a, b] = [point(ring, spoke), point(ring, spoke + 1)];
            let [c, d] = [point(ring + 1, spoke + 1), point(ring + 1, spoke)];
            mesh.polygon(&[a, c, d]);
            if ring > 0 {
                mesh.polygon(&[a, b, c]);
            }
        }
    }
}

/// One piece: a brick now and then, else a chunk.
fn scatter(site: &mut Site, mesh: &mut MeshBuilder, place: Vec3, size: f32) {
    let turn = Quat::from_euler(
        EulerRot::YXZ,
        site.between(0.0, std::f32::consts::TAU),
        site.between(-0.7, 0.7),
        site.between(-0.7, 0.7),
    );
    let transform = Transform::from_translation(place).with_rotation(turn);
    if size > 0.06 && size < 0.14 && site.between(0.0, 1.0) < 0.6 {
        let length = site.between(0.055, 0.115);
        let shade = CLAY * site.between(0.6, 1.1);
        mesh.cuboid(&transform, Vec3::new(length, 0.035, 0.054), 0.8, shade);
        return;
    }
    let colour = CONCRETE[site.between(0.0, 3.999) as usize] * site.between(0.75, 1.05);
    let colour = if site.between(0.0, 1.0) < 0.15 { CLAY * 0.8 } else { colour };
    chunk(site, mesh, &transform, size, colour);
}

/// A convex chunk: a box with its corners cut off by random planes, seen as the distance at which each
/// direction leaves it.
fn chunk(site: &mut Site, mesh: &mut MeshBuilder, transform: &Transform, size: f32, colour: Vec3) {
    let half = Vec3::new(1.0, site.between(0.35, 0.8), site.between(0.55, 1.0)) * size;
    let cuts: Vec<(Vec3, f32)> = (0..5)
        .map(|_| {
            let normal = Vec3::new(site.between(-1.0, 1.0), site.between(-1.0, 1.0), site.between(-1.0, 1.0));
            let normal = normal.normalize_or(Vec3::Y);
            (normal, (half * normal).length() * site.between(0.55, 0.95))
        })
        .collect();
    let reach = |direction: Vec3| {
        let sides = (half / direction.abs().max(Vec3::splat(1e-4))).min_element();
        let cut = |(normal, distance): &(Vec3, f32)| distance / normal.dot(direction).max(1e-4);
        direction * cuts.iter().map(cut).fold(sides, f32::min)
    };
    // Small pieces need few faces: the sides of a cube, cut finer for the large ones.
    let steps = if size > 0.22 {
        4
    } else if size > 0.10 {
        2
    } else {
        1
    };
    for axis in 0..3 {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        for side in [-1.0, 1.0] {
            let corner = |i: usize, j: usize| {
                let at = |k: usize| 2.0 * k as f32 / steps as f32 - 1.0;
                let mut direction = Vec3::ZERO;
                direction[axis] = side;
                direction[u] = at(i) * side;
                direction[v] = at(j);
                let local = reach((direction * half).normalize());
                Corner::new(transform.transform_point(local), Vec2::new(local[u], local[v]) * 0.7, colour)
            };
            for i in 0..steps {
                for j in 0..steps {
                    mesh.polygon(&[corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)]);
                }
            }
        }
    }
}
