//! The buildings: broken walls with window holes, floors, sills, and bent reinforcing bars.

use super::builder::MeshBuilder;
use super::walls::Wall;
use super::{FAR_KERB, Site};
use bevy::prelude::*;
use noise::{Fbm, MultiFractal, Perlin};
use std::f32::consts::FRAC_PI_2;

const STOREY: f32 = 3.3;
const BAY: f32 = 2.5;

/// A building: `place` is its front left corner at the ground, the front facing its own +z.
struct Building {
    place: Transform,
    width: f32,
    depth: f32,
    storeys: u32,
    ruin: f32,
    cell: f32,
    tint: Vec3,
}

impl Building {
    /// Whether it is built in detail, and near enough to shelter the props.
    fn is_near(&self) -> bool {
        self.cell < 0.45
    }
}

pub fn build(site: &mut Site) {
    let left = |z: f32| Transform::from_xyz(FAR_KERB - 3.6, -0.2, z).with_rotation(Quat::from_rotation_y(FRAC_PI_2));
    let right = |x: f32, z: f32| Transform::from_xyz(x, -0.2, z).with_rotation(Quat::from_rotation_y(-FRAC_PI_2));
    let far = |x: f32, z: f32, yaw: f32| Transform::from_xyz(x, -0.3, z).with_rotation(Quat::from_rotation_y(yaw));
    let building =
        |place, width, depth, storeys, ruin, cell, tint| Building { place, width, depth, storeys, ruin, cell, tint };
    let sand = Vec3::new(1.0, 0.93, 0.82);
    let ochre = Vec3::new(1.0, 0.82, 0.60);
    let grey = Vec3::new(0.82, 0.83, 0.84);
    let buildings = [
        building(right(5.4, -19.6), 13.0, 10.0, 3, 0.9, 0.25, sand),
        building(right(5.0, -40.0), 16.0, 10.0, 4, 0.8, 0.4, grey),
        building(right(6.5, -62.0), 18.0, 12.0, 6, 0.5, 0.5, ochre),
        building(left(-1.0), 12.0, 9.0, 3, 0.85, 0.25, ochre),
        building(left(-15.5), 14.0, 10.0, 4, 0.75, 0.3, sand),
        building(left(-34.0), 15.0, 10.0, 5, 0.8, 0.44, grey),
        building(left(-53.0), 18.0, 12.0, 6, 0.55, 0.5, sand),
        // The end of the street, in the haze.
        building(far(-14.0, -92.0, 0.06), 15.0, 12.0, 10, 0.55, 0.7, grey),
        building(far(-2.5, -118.0, -0.1), 16.0, 12.0, 15, 0.5, 0.9, grey),
        building(far(-38.0, -105.0, 0.3), 18.0, 12.0, 12, 0.6, 0.9, grey),
        building(far(16.0, -130.0, -0.2), 22.0, 14.0, 11, 0.7, 1.0, grey),
        building(far(-62.0, -75.0, 0.5), 20.0, 14.0, 9, 0.7, 1.0, grey),
        building(far(-75.0, -130.0, 0.3), 26.0, 14.0, 14, 0.5, 1.2, grey),
    ];
    let plaster = site.surfaces.plaster.material(0.92);
    let plaster = site.materials.add(plaster);
    let concrete = site.surfaces.concrete.material(0.9);
    let concrete = site.materials.add(concrete);
    let rust = site.materials.add(StandardMaterial {
        base_color: Color::linear_rgb(0.13, 0.055, 0.025),
        perceptual_roughness: 0.85,
        ..default()
    });
    // Each building apart, so that those out of sight, or out of a shadow map's reach, are not drawn.
    for (index, building) in buildings.iter().enumerate() {
        let (mut faces, mut edges, mut bars) = <(MeshBuilder, MeshBuilder, MeshBuilder)>::default();
        raise(site, building, index as f32 * 40.0, &mut faces, &mut edges, &mut bars);
        if building.is_near() {
            site.spawn_shelter(faces, &plaster);
            site.spawn_shelter(edges, &concrete);
        } else {
            site.spawn(faces, &plaster);
            site.spawn(edges, &concrete);
        }
        site.spawn_shadowless(bars, &rust);
    }
}

fn windows(length: f32, storeys: u32) -> Vec<Rect> {
    let bays = (length / BAY).floor().max(1.0);
    let pitch = length / bays;
    let one = |storey: u32, bay: u32| {
        let middle = pitch * (bay as f32 + 0.5);
        let sill = storey as f32 * STOREY + if storey == 0 { 0.9 } else { 1.0 };
        let half = if storey == 0 { 0.72 } else { 0.60 };
        Rect::new(middle - half, sill, middle + half, sill + 1.65)
    };
    (0..storeys).flat_map(|s| (0..bays as u32).map(move |b| one(s, b))).collect()
}

fn raise(
    site: &mut Site,
    building: &Building,
    offset: f32,
    faces: &mut MeshBuilder,
    edges: &mut MeshBuilder,
    bars: &mut MeshBuilder,
) {
    let (width, depth) = (building.width, building.depth);
    let height = building.storeys as f32 * STOREY + 0.5;
    let near = building.is_near();
    let noise = Fbm::<Perlin>::new(21).set_octaves(4);
    let plaster_scale = 1.0 / site.surfaces.plaster.size;
    let wall = |length: f32, height: f32, openings: bool, index: f32| Wall {
        length,
        height,
        thickness: 0.34,
        windows: if openings { windows(length, building.storeys) } else { Vec::new() },
        ruin: building.ruin,
        cell: building.cell,
        uv_scale: plaster_scale,
        tint: building.tint,
        noise: noise.clone(),
        offset: offset + index * 9.7,
        plan: (Vec2::ZERO, Vec2::X),
        site: offset,
        bearings: Vec::new(),
        two_sided: near,
    };
    // Front, back and the two ends; local x runs along the wall seen from outside.
    let stand = |x: f32, z: f32, yaw: f32| {
        building.place * Transform::from_xyz(x, 0.0, z).with_rotation(Quat::from_rotation_y(yaw))
    };
    let sides = [
        (stand(0.0, 0.0, 0.0), width, true, (Vec2::ZERO, Vec2::X)),
        (stand(width, 0.0, FRAC_PI_2), depth, near, (Vec2::new(width, 0.0), Vec2::NEG_Y)),
        (stand(0.0, -depth, -FRAC_PI_2), depth, near, (Vec2::new(0.0, -depth), Vec2::Y)),
        (stand(width, -depth, 2.0 * FRAC_PI_2), width, true, (Vec2::new(width, -depth), Vec2::NEG_X)),
    ];
    let mut standing = Vec::new();
    for (index, (place, length, openings, plan)) in sides.into_iter().enumerate() {
        // The far side of a distant building is behind its front.
        if !near && index >= 2 {
            break;
        }
        let wall = Wall { plan, ..wall(length, height, openings, index as f32) };
        wall.build(&place, faces, edges);
        if near {
            ledges(&wall, &place, edges);
            reinforcement(site, &wall, &place, bars);
        }
        standing.push((place, wall));
    }
    if !near {
        return;
    }
    // A party wall and the floors, which have broken further than the walls.
    let plan = (Vec2::new(width * 0.5, 0.0), Vec2::NEG_Y);
    let party = Wall { plan, ..wall(depth - 0.4, height, false, 5.0) };
    party.build(&stand(width * 0.5, -0.2, FRAC_PI_2), faces, edges);
    for storey in 1..=building.storeys {
        let lying = Quat::from_rotation_x(-FRAC_PI_2);
        let place = building.place * Transform::from_xyz(0.2, storey as f32 * STOREY + 0.1, -0.2).with_rotation(lying);
        let mut floor = wall(width - 0.4, depth - 0.4, false, 6.0 + storey as f32);
        floor.thickness = 0.24;
        floor.ruin = building.ruin * 0.4;
        let level = storey as f32 * STOREY;
        let back = place.to_matrix().inverse();
        for (stand, wall) in &standing {
            let steps = (wall.length / 0.5) as u32;
            let points = (0..=steps).map(|i| Vec2::new(i as f32 * 0.5, level));
            // The wall must stand well above the floor, or it has fallen with it.
            let firm =
                points.filter(|at| wall.solid(*at - Vec2::Y * 0.5) > 0.1 && wall.solid(*at + Vec2::Y * 0.3) > 0.0);
            floor
                .bearings
                .extend(firm.map(|at| back.transform_point3(stand.transform_point(at.extend(0.0))).truncate()));
        }
        if floor.bearings.is_empty() {
            continue;
        }
        floor.build(&place, faces, edges);
        reinforcement(site, &floor, &place, bars);
    }
}

/// Sills under the windows and a band at each floor, where the wall behind them still stands.
fn ledges(wall: &Wall, place: &Transform, mesh: &mut MeshBuilder) {
    let front = wall.thickness / 2.0;
    let tint = wall.tint * 1.05;
    for window in &wall.windows {
        let foot = Vec2::new(window.center().x, window.min.y);
        let stands = |at: Vec2| wall.solid(at) > 0.05;
        if stands(foot - Vec2::Y * 0.15) {
            let at = place.mul_transform(Transform::from_translation((foot - Vec2::Y * 0.04).extend(front + 0.03)));
            mesh.cuboid(&at, Vec3::new(window.width() / 2.0 + 0.10, 0.045, 0.07), 0.5, tint);
        }
        let head = Vec2::new(window.center().x, window.max.y);
        if stands(head + Vec2::Y * 0.15) && stands(head + Vec2::new(0.7, 0.1)) && stands(head + Vec2::new(-0.7, 0.1)) {
            let at = place.mul_transform(Transform::from_translation((head + Vec2::Y * 0.11).extend(front + 0.01)));
            mesh.cuboid(&at, Vec3::new(window.width() / 2.0 + 0.16, 0.10, 0.035), 0.5, tint * 0.9);
        }
    }
    let floors = (wall.height / STOREY) as u32;
    for floor in 1..=floors {
        for piece in 0..wall.length as u32 {
            let at = Vec2::new(piece as f32 + 0.5, floor as f32 * STOREY + 0.1);
            if [-0.5, 0.0, 0.5].iter().all(|dx| wall.solid(at + Vec2::new(*dx * 0.96, 0.0)) > 0.12) {
                let at = place.mul_transform(Transform::from_translation(at.extend(front + 0.02)));
                mesh.cuboid(&at, Vec3::new(0.5, 0.09, 0.06), 0.5, tint * 0.95);
            }
        }
    }
}

/// Bars that stick out of the broken edge, bent by what fell.
fn reinforcement(site: &mut Site, wall: &Wall, place: &Transform, mesh: &mut MeshBuilder) {
    let mut x = 0.3;
    while x < wall.length - 0.3 {
        x += site.between(0.25, 0.9);
        // The topmost masonry over x.
        let mut y = wall.height + 0.6;
        while y > 0.5 && wall.solid(Vec2::new(x, y)) <= 0.0 {
            y -= 0.1;
        }
        if y <= 0.5 || y > wall.height - 0.3 || site.between(0.0, 1.0) < 0.35 {
            continue;
        }
        let lean =
            Vec3::new(site.between(-0.6, 0.6), site.between(0.2, 1.0), site.between(-0.7, 0.7)).normalize_or(Vec3::Y);
        let length = site.between(0.3, 1.1);
        let bend = Vec3::new(site.between(-0.5, 0.5), -0.5, site.between(-0.5, 0.5));
        let root = Vec3::new(x, y - 0.15, site.between(-0.1, 0.1));
        let path: Vec<Vec3> = (0..=5)
            .map(|i| {
                let t = i as f32 / 5.0;
                place.transform_point(root + Vec3::Y * 0.15 * t + lean * length * t + bend * length * t * t)
            })
            .collect();
        mesh.tube(&path, 0.011, 5, Vec3::ONE);
    }
}
