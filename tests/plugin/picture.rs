//! At age 0 a coated prop looks like the uncoated one. Needs a graphics adapter, be it a software renderer.

use std::path::PathBuf;

use bevy::{gltf::GltfAssetLabel, prelude::*, world_serialization::WorldAssetRoot};
use bevy_coating::prelude::*;

use crate::{common::update_until, studio::Studio};

/// A prop, what to look at, and eyes: outside, behind, and inside or below its open shell.
struct Prop {
    file: &'static str,
    target: Vec3,
    eyes: [Vec3; 3],
    films: usize,
}

const PROPS: [Prop; 2] = [
    Prop {
        file: "prop_firehydrant.glb",
        target: Vec3::new(0.0, 0.11, 0.0),
        eyes: [Vec3::new(0.28, 0.28, 0.32), Vec3::new(-0.3, 0.2, -0.3), Vec3::new(0.05, -0.35, 0.08)],
        films: 1,
    },
    Prop {
        file: "prop_car.glb",
        target: Vec3::new(0.0, 0.12, 0.0),
        eyes: [Vec3::new(0.9, 0.6, 1.1), Vec3::new(-0.9, 0.4, -1.1), Vec3::new(0.2, -1.2, 0.4)],
        films: 5,
    },
];

const FOLDER: &str = "assets/props";

/// Where to leave the pictures: `COATING_PICTURES`, if set.
fn output() -> Option<PathBuf> {
    let folder = PathBuf::from(std::env::var_os("COATING_PICTURES")?);
    std::fs::create_dir_all(&folder).ok()?;
    Some(folder)
}

#[test]
fn a_fresh_prop_looks_like_the_uncoated_one() {
    let output = output();
    let Some(mut studio) = Studio::open(640, 480, FOLDER) else { return };
    let mut worst = f64::INFINITY;
    for prop in &PROPS {
        let scene = studio.app.world().resource::<AssetServer>().load(GltfAssetLabel::Scene(0).from_asset(prop.file));
        let root = studio.app.world_mut().spawn(WorldAssetRoot(scene)).id();
        let meshes = |app: &mut App| app.world_mut().query::<&Mesh3d>().iter(app.world()).count();
        update_until(&mut studio.app, |app| meshes(app) == prop.films && assets_loaded(app));
        let before = prop.eyes.map(|eye| studio.shoot(eye, prop.target));
        let coating = Coating::new(Preset::Heavy).with_seed(3);
        studio.app.world_mut().entity_mut(root).insert(coating);
        let films = prop.films;
        update_until(&mut studio.app, |app| app.world().resource::<CoatingStatus>().films == films);
        for (i, (eye, before)) in prop.eyes.iter().zip(&before).enumerate() {
            let after = studio.shoot(*eye, prop.target);
            let (psnr, pixels) = before.psnr(&after);
            println!("{} view {i}: {psnr:.1} dB over {pixels} pixels", prop.file);
            if let Some(folder) = &output {
                before.save(&folder.join(format!("{}_{i}_before.png", prop.file)));
                after.save(&folder.join(format!("{}_{i}_after.png", prop.file)));
            }
            assert!(pixels > 5000, "{} must fill the picture", prop.file);
            worst = worst.min(psnr);
        }
        // What it looks like later is for the eye.
        if let Some(folder) = &output {
            for age in [0.5, 1.0] {
                let mut clock = studio.app.world_mut().resource_mut::<CoatingClock>();
                clock.target_age = Some(age);
                clock.request_steps(10_000);
                let reached = |app: &mut App| app.world().resource::<CoatingStatus>().youngest >= age - 1e-9;
                update_until(&mut studio.app, reached);
                for (i, eye) in prop.eyes.iter().enumerate() {
                    let name = format!("{}_{i}_age_{age:.1}.png", prop.file);
                    studio.shoot(*eye, prop.target).save(&folder.join(name));
                    let close = prop.target + (eye - prop.target) * 0.4;
                    let name = format!("{}_{i}_age_{age:.1}_close.png", prop.file);
                    studio.shoot(close, prop.target).save(&folder.join(name));
                }
            }
        }
        studio.app.world_mut().entity_mut(root).despawn();
        studio.app.update();
    }
    assert!(worst >= 40.0, "{worst:.1} dB");
}

/// Whether every image and mesh that is asked for has been loaded.
fn assets_loaded(app: &mut App) -> bool {
    let materials = app.world().resource::<Assets<StandardMaterial>>();
    let images = app.world().resource::<Assets<Image>>();
    let loaded = |handle: &Option<Handle<Image>>| handle.as_ref().is_none_or(|handle| images.contains(handle));
    materials.iter().all(|(_, material)| loaded(&material.base_color_texture))
}
