//! Road with potholes and a puddle, kerbs, pavements, and the dirt beyond.

use super::builder::{Corner, MeshBuilder};
use super::{FAR_KERB, KERB, ROAD, Site};
use bevy::prelude::*;
use noise::{Fbm, MultiFractal, NoiseFn, Perlin};

pub fn build(site: &mut Site) {
    let relief = Fbm::<Perlin>::new(3).set_octaves(4).set_frequency(0.35);
    let at = |x: f32, z: f32| relief.get([f64::from(x), f64::from(z)]) as f32;

    // Subsidence of the road: long waves, and potholes where the waves are deepest.
    let road = move |x: f32, z: f32| {
        let wave = at(x, z);
        let hole = (wave + 0.30).min(0.0).abs();
        ROAD + 0.035 * wave - 0.55 * hole.min(0.18)
    };
    let asphalt = site.surfaces.asphalt.material(0.82);
    let asphalt = site.materials.add(asphalt);
    let mut mesh = MeshBuilder::default();
    let size = site.surfaces.asphalt.size;
    sheet(&mut mesh, Rect::new(FAR_KERB - 0.1, -34.0, KERB + 0.1, 8.0), 0.4, size, road);
    sheet(&mut mesh, Rect::new(FAR_KERB - 0.1, -120.0, KERB + 0.1, -34.0), 2.0, size, |_, _| ROAD - 0.02);
    site.spawn_shadowless(mesh, &asphalt);

    let slabs = site.surfaces.pavement.material(0.8);
    let slabs = site.materials.add(slabs);
    let mut mesh = MeshBuilder::default();
    let size = site.surfaces.pavement.size;
    let pavement = move |x: f32, z: f32| 0.02 * at(x * 1.4 + 9.0, z * 1.4);
    sheet(&mut mesh, Rect::new(KERB + 0.14, -34.0, 9.0, 8.0), 0.5, size, pavement);
    sheet(&mut mesh, Rect::new(KERB + 0.14, -120.0, 9.0, -34.0), 2.0, size, |_, _| 0.0);
    sheet(&mut mesh, Rect::new(FAR_KERB - 3.6, -120.0, FAR_KERB - 0.14, 8.0), 1.0, size, pavement);
    site.spawn_shadowless(mesh, &slabs);

    kerbs(site);

    // Standing water in the potholes: a flat sheet that the road's relief cuts to shape.
    let water = site.materials.add(StandardMaterial {
        base_color: Color::linear_rgb(0.022, 0.019, 0.015),
        perceptual_roughness: 0.06,
        reflectance: 0.5,
        ..default()
    });
    let mut mesh = MeshBuilder::default();
    sheet(&mut mesh, Rect::new(FAR_KERB, -30.0, KERB, 6.0), 6.0, 4.0, |_, _| ROAD - 0.062);
    site.spawn_shadowless(mesh, &water);

    let dirt = site.surfaces.concrete.material(0.95);
    let dirt = site.materials.add(StandardMaterial { base_color: Color::linear_rgb(0.62, 0.52, 0.40), ..dirt });
    let mut mesh = MeshBuilder::default();
    let field = |x: f32, z: f32| -0.22 + 0.5 * at(x * 0.3, z * 0.3).max(-0.1);
    sheet(&mut mesh, Rect::new(-160.0, -260.0, 160.0, 60.0), 8.0, 4.0, |_, _| -0.35);
    sheet(&mut mesh, Rect::new(-40.0, -60.0, FAR_KERB - 3.5, 10.0), 1.0, 4.0, field);
    sheet(&mut mesh, Rect::new(8.9, -60.0, 40.0, 10.0), 1.0, 4.0, field);
    site.spawn_shadowless(mesh, &dirt);
}

/// A height field over `area` (x and z), smooth-shaded, one vertex each `step` metres.
fn sheet(mesh: &mut MeshBuilder, area: Rect, step: f32, size: f32, height: impl Fn(f32, f32) -> f32) {
    let cells = (area.size() / step).ceil().as_uvec2().max(UVec2::ONE);
    let pitch = area.size() / cells.as_vec2();
    let mut rows: Vec<Vec<u32>> = Vec::new();
    for j in 0..=cells.y {
        let mut row = Vec::new();
        for i in 0..=cells.x {
            let at = area.min + pitch * Vec2::new(i as f32, j as f32);
            let slope = Vec2::new(
                height(at.x + 0.1, at.y) - height(at.x - 0.1, at.y),
                height(at.x, at.y + 0.1) - height(at.x, at.y - 0.1),
            ) / 0.2;
            let normal = Vec3::new(-slope.x, 1.0, -slope.y).normalize();
            let position = Vec3::new(at.x, height(at.x, at.y), at.y);
            row.push(mesh.vertex(Corner::new(position, at / size, Vec3::ONE), normal));
        }
        rows.push(row);
    }
    for pair in rows.windows(2) {
        for (near, far) in pair[1].windows(2).zip(pair[0].windows(2)) {
            mesh.triangle(near[0], near[1], far[1]);
            mesh.triangle(near[0], far[1], far[0]);
        }
    }
}

/// Kerb stones of a metre, none quite in line, some gone.
fn kerbs(site: &mut Site) {
    let material = site.surfaces.concrete.material(0.85);
    let material = site.materials.add(material);
    let uv_scale = 1.0 / site.surfaces.concrete.size;
    let mut mesh = MeshBuilder::default();
    for x in [KERB + 0.07, FAR_KERB - 0.07] {
        for stone in 0..110 {
            let z = 7.0 - stone as f32;
            if site.between(0.0, 1.0) < 0.05 && z < -2.0 {
                continue;
            }
            let tilt = Quat::from_euler(
                EulerRot::YXZ,
                site.between(-0.02, 0.02),
                site.between(-0.012, 0.012),
                site.between(-0.06, 0.06),
            );
            let place = Vec3::new(x + site.between(-0.015, 0.015), -0.12 + site.between(-0.015, 0.012), z);
            let shade = Vec3::splat(site.between(0.75, 1.05));
            let transform = Transform::from_translation(place).with_rotation(tilt);
            mesh.cuboid(&transform, Vec3::new(0.075, 0.13, 0.488), uv_scale, shade);
        }
    }
    site.spawn(mesh, &material);
}
