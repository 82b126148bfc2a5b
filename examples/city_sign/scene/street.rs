//! Street furniture that is not a prop: a leaning lamp, poles and slack wires, weeds in the cracks.

use super::builder::{Corner, MeshBuilder};
use super::{FAR_KERB, KERB, ROAD, Site};
use bevy::prelude::*;

pub fn build(site: &mut Site) {
    lamps(site);
    wires(site);
    weeds(site);
}

fn lamps(site: &mut Site) {
    let steel = site.materials.add(StandardMaterial {
        base_color: Color::linear_rgb(0.10, 0.085, 0.07),
        metallic: 0.4,
        perceptual_roughness: 0.6,
        ..default()
    });
    let mut mesh = MeshBuilder::default();
    // Foot, lean, towards the road (+1: to the right).
    let lamps = [
        (Vec3::new(FAR_KERB - 0.6, 0.0, -11.0), Vec3::new(0.16, 0.0, 0.10), 1.0),
        (Vec3::new(KERB + 0.6, 0.0, -23.0), Vec3::new(-0.06, 0.0, 0.03), -1.0),
        (Vec3::new(FAR_KERB - 0.6, 0.0, -33.0), Vec3::new(0.03, 0.0, -0.03), 1.0),
    ];
    for (foot, lean, side) in lamps {
        let shaft: Vec<Vec3> = (0..=6)
            .map(|i| {
                let t = i as f32 / 6.0;
                foot + Vec3::Y * 6.2 * t + lean * 6.2 * t * t
            })
            .collect();
        let top = foot + Vec3::Y * 6.2 + lean * 6.2;
        let arm: Vec<Vec3> = (0..=6)
            .map(|i| {
                let a = i as f32 / 6.0 * 1.5;
                top + Vec3::new(side * 1.5 * (1.0 - a.cos()), 0.75 * a.sin(), 0.0)
            })
            .collect();
        mesh.tube(&shaft, 0.07, 10, Vec3::ONE);
        mesh.tube(&arm, 0.035, 8, Vec3::ONE);
        if let Some(end) = arm.last() {
            let head = Transform::from_translation(*end + Vec3::X * side * 0.3)
                .with_rotation(Quat::from_rotation_z(side * -0.25));
            mesh.cuboid(&head, Vec3::new(0.36, 0.06, 0.13), 1.0, Vec3::ONE);
        }
        mesh.cuboid(&Transform::from_translation(foot + Vec3::Y * 0.4), Vec3::new(0.11, 0.45, 0.11), 1.0, Vec3::ONE);
    }
    site.spawn(mesh, &steel);
}

fn wires(site: &mut Site) {
    let black = site.materials.add(StandardMaterial {
        base_color: Color::linear_rgb(0.02, 0.018, 0.016),
        perceptual_roughness: 0.8,
        ..default()
    });
    let mut mesh = MeshBuilder::default();
    let spans = [
        (Vec3::new(-13.4, 8.6, -7.0), Vec3::new(5.4, 7.2, -15.0), 1.6),
        (Vec3::new(-13.4, 9.0, -21.0), Vec3::new(5.4, 6.4, -17.5), 2.0),
        (Vec3::new(-13.4, 11.0, -23.0), Vec3::new(5.0, 9.5, -33.0), 1.5),
        (Vec3::new(-13.4, 12.0, -41.0), Vec3::new(5.0, 10.0, -36.0), 2.2),
        // Torn down at one end.
        (Vec3::new(-13.4, 7.8, -8.0), Vec3::new(-9.0, ROAD + 0.1, -8.6), 0.9),
        (Vec3::new(5.4, 7.0, -10.0), Vec3::new(2.6, 0.1, -9.2), 0.6),
    ];
    for (from, to, sag) in spans {
        let path: Vec<Vec3> = (0..=24)
            .map(|i| {
                let t = i as f32 / 24.0;
                from.lerp(to, t) - Vec3::Y * sag * 4.0 * t * (1.0 - t)
            })
            .collect();
        mesh.tube(&path, 0.013, 5, Vec3::ONE);
    }
    site.spawn_shadowless(mesh, &black);
}

/// Dry grass along the kerb, at the sign's posts and in the joints of the pavement.
fn weeds(site: &mut Site) {
    let grass = site.materials.add(StandardMaterial {
        base_color: Color::linear_rgb(0.34, 0.27, 0.13),
        perceptual_roughness: 0.9,
        double_sided: true,
        cull_mode: None,
        ..default()
    });
    let mut mesh = MeshBuilder::default();
    for tuft in 0..260 {
        let z = 1.0 - 20.0 * site.between(0.0, 1.0).powi(2);
        let foot = match tuft {
            0..4 => Vec3::new(-0.40 + site.between(-0.06, 0.06), 0.0, -0.06 + site.between(-0.05, 0.05)),
            4..8 => Vec3::new(0.40 + site.between(-0.06, 0.06), 0.0, -0.06 + site.between(-0.05, 0.05)),
            8..110 => Vec3::new(KERB - 0.02, ROAD, z),
            110..170 => Vec3::new(FAR_KERB - 0.15, 0.0, z * 1.5),
            170..210 => Vec3::new(5.1 - site.between(0.0, 0.4), 0.0, z - 6.0),
            _ => Vec3::new(site.between(KERB + 0.2, 5.0), 0.0, z),
        };
        let size = site.between(0.06, 0.22);
        for _ in 0..10 {
            let angle = site.between(0.0, std::f32::consts::TAU);
            let out = Vec3::new(angle.cos(), 0.0, angle.sin());
            let across = Vec3::new(-out.z, 0.0, out.x) * size * 0.025;
            let root = foot + out * site.between(0.0, 0.05);
            let height = size * site.between(0.6, 1.3);
            let bent = out * height * site.between(0.15, 0.7);
            let shade = Vec3::new(1.0, site.between(0.85, 1.15), 1.0) * site.between(0.5, 1.1);
            let corner = |p: Vec3, dark: f32| Corner::new(p, Vec2::ZERO, shade * dark);
            let middle = root + Vec3::Y * height * 0.6 + bent * 0.35;
            let tip = root + Vec3::Y * height + bent;
            mesh.polygon(&[
                corner(root - across, 0.5),
                corner(root + across, 0.5),
                corner(middle + across, 0.9),
                corner(middle - across, 0.9),
            ]);
            mesh.polygon(&[corner(middle - across, 0.9), corner(middle + across, 0.9), corner(tip, 1.1)]);
        }
    }
    site.spawn_shadowless(mesh, &grass);
}
