//! Baked models in Bevy: fresh ones look like the prop. Needs a graphics adapter, be it a software renderer.

#[path = "../common/mod.rs"]
mod common;
#[path = "../common/studio.rs"]
mod studio;

use std::{fs, path::Path};

use bevy::{gltf::GltfAssetLabel, prelude::*, world_serialization::WorldAssetRoot};
use common::update_until;
use studio::{Picture, Studio};

use crate::tool;

const EYES: [Vec3; 3] = [Vec3::new(0.28, 0.28, 0.32), Vec3::new(-0.3, 0.2, -0.3), Vec3::new(0.12, 0.13, 0.12)];
const TARGET: Vec3 = Vec3::new(0.0, 0.11, 0.0);

/// Pictures of a model from all eyes.
fn pictures(studio: &mut Studio, file: &str) -> [Picture; 3] {
    let scene = studio.app.world().resource::<AssetServer>().load(GltfAssetLabel::Scene(0).from_asset(file.to_owned()));
    let root = studio.app.world_mut().spawn(WorldAssetRoot(scene)).id();
    let has_mesh = |app: &mut App| app.world_mut().query::<&Mesh3d>().iter(app.world()).count() > 0;
    update_until(&mut studio.app, |app| has_mesh(app) && images_loaded(app));
    let pictures = EYES.map(|eye| studio.shoot(eye, TARGET));
    studio.app.world_mut().entity_mut(root).despawn();
    pictures
}

fn images_loaded(app: &mut App) -> bool {
    let server = app.world().resource::<AssetServer>();
    let loaded = |handle: &Handle<Image>| server.is_loaded_with_dependencies(handle);
    let materials = app.world().resource::<Assets<StandardMaterial>>();
    materials.iter().all(|(_, m)| {
        [&m.base_color_texture, &m.metallic_roughness_texture, &m.normal_map_texture].into_iter().flatten().all(loaded)
    })
}

#[test]
fn a_fresh_baked_prop_looks_like_the_prop() {
    let prop = Path::new("assets/props/prop_firehydrant.glb");
    let folder = tool::folder();
    fs::copy(prop, folder.path().join("prop.glb")).expect("the prop");
    let quick = ["--steps", "250", "--set", "deform.sweeps_per_age=2500"];
    for (file, extra) in [
        ("fresh.glb", &["--age", "0"][..]),
        ("colors.glb", &["--age", "0", "--vertex-colors"]),
        ("aged.glb", &["--age", "1"]),
        ("aged_colors.glb", &["--age", "1", "--vertex-colors"]),
    ] {
        tool::baked(folder.path(), &[&["prop.glb", "--out", file][..], extra, &quick].concat());
    }
    let Some(mut studio) = Studio::open(640, 480, folder.path().to_str().expect("a path")) else { return };
    let keep = |name: &str, pictures: &[Picture; 3]| {
        let Some(folder) = std::env::var_os("COATING_PICTURES") else { return };
        for (i, picture) in pictures.iter().enumerate() {
            picture.save(&Path::new(&folder).join(format!("baked_{name}_{i}.png")));
        }
    };
    let own = pictures(&mut studio, "prop.glb");
    keep("own", &own);
    for file in ["fresh.glb", "colors.glb"] {
        let fresh = pictures(&mut studio, file);
        keep(file, &fresh);
        for (i, (own, fresh)) in own.iter().zip(&fresh).enumerate() {
            let (psnr, pixels) = own.psnr(fresh);
            println!("{file} view {i}: {psnr:.1} dB over {pixels} pixels");
            assert!(psnr > 35.0 && pixels > 10_000, "{file} view {i}: {psnr:.1} dB over {pixels} pixels");
        }
    }
    for file in ["aged.glb", "aged_colors.glb"] {
        let aged = pictures(&mut studio, file);
        keep(file, &aged);
        for (own, aged) in own.iter().zip(&aged) {
            let (psnr, _) = own.psnr(aged);
            assert!(psnr < 25.0, "{file} has aged: {psnr:.1} dB");
        }
    }
}
