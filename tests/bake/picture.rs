//! Baked models in Bevy: fresh ones look like the prop. Needs a graphics adapter, be it a software renderer.

#[path = "../common/mod.rs"]
mod common;
#[path = "../common/studio.rs"]
mod studio;

use std::{
    fs,
    path::{Path, PathBuf},
};

use bevy::{
    camera::primitives::Aabb, gltf::GltfAssetLabel, math::ops, prelude::*, world_serialization::WorldAssetRoot,
};
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

/// Files that are baked fresh, in `folder`, with arguments: some from the repository, or all models of the folder that
/// `COATING_MODELS` names.
fn fresh_models() -> Vec<(PathBuf, Vec<&'static str>)> {
    let Some(folder) = std::env::var_os("COATING_MODELS") else {
        let models = [("firehydrant", &["0", "2"][..]), ("watertower", &["2"])];
        let path = |name| format!("assets/props/prop_{name}.glb").into();
        return models.into_iter().flat_map(|(name, levels)| at_levels(path(name), levels)).collect();
    };
    let entries = fs::read_dir(folder).expect("a folder of models").map(|entry| entry.expect("a file").path());
    let mut models: Vec<PathBuf> = entries.filter(|path| path.extension().is_some_and(|end| end == "glb")).collect();
    models.sort();
    models.into_iter().flat_map(|model| at_levels(model, &["0", "2"])).collect()
}

fn at_levels(model: PathBuf, levels: &[&'static str]) -> Vec<(PathBuf, Vec<&'static str>)> {
    let mut found: Vec<_> = levels.iter().map(|level| (model.clone(), vec!["--level", level])).collect();
    if model.ends_with("bunny_raw.glb") {
        // On a film of few triangles, which fine levels make up for.
        let coarse = |level| (model.clone(), vec!["--level", level, "--triangles", "4000"]);
        found.extend(["0", "1", "2", "3"].map(coarse));
    }
    found
}

/// Puts the camera around everything that has a mesh, and takes a picture from four sides.
fn around(studio: &mut Studio, file: &str) -> Vec<Picture> {
    let scene = studio.app.world().resource::<AssetServer>().load(GltfAssetLabel::Scene(0).from_asset(file.to_owned()));
    let root = studio.app.world_mut().spawn(WorldAssetRoot(scene)).id();
    let has_boxes = |app: &mut App| {
        let mut meshes = app.world_mut().query_filtered::<Has<Aabb>, With<Mesh3d>>();
        meshes.iter(app.world()).count() > 0 && meshes.iter(app.world()).all(|has_box| has_box)
    };
    update_until(&mut studio.app, |app| has_boxes(app) && images_loaded(app));
    let mut boxes = studio.app.world_mut().query::<(&Aabb, &GlobalTransform)>();
    let corners = boxes.iter(studio.app.world()).flat_map(|(own, at)| {
        let (centre, half) = (Vec3::from(own.center), Vec3::from(own.half_extents));
        [-1.0, 1.0].map(|sign| at.transform_point(centre + sign * half))
    });
    let (min, max) = corners.fold((Vec3::INFINITY, Vec3::NEG_INFINITY), |(a, b), p| (a.min(p), b.max(p)));
    let (centre, radius) = ((min + max) / 2.0, (max - min).length() / 2.0);
    let sides = [(1.0, 0.4, 1.0), (-1.0, 0.3, 0.8), (0.6, -0.3, -1.0), (0.1, 1.0, 0.2)].map(Vec3::from);
    let distance = 1.1 * radius / ops::sin(studio::FIELD_OF_VIEW / 2.0);
    let pictures = sides.map(|side| studio.shoot(centre + side.normalize() * distance, centre));
    studio.app.world_mut().entity_mut(root).despawn();
    pictures.into()
}

#[test]
fn fresh_props_look_like_themselves_at_every_level() {
    let folder = tool::folder();
    let models = fresh_models();
    for (i, (model, arguments)) in models.iter().enumerate() {
        fs::copy(model, folder.path().join(format!("own{i}.glb"))).expect("the model");
        let out = format!("fresh{i}.glb");
        tool::baked(folder.path(), &[&[&*format!("own{i}.glb"), "--age", "0", "--out", &out], &arguments[..]].concat());
    }
    let Some(mut studio) = Studio::open(640, 480, folder.path().to_str().expect("a path")) else { return };
    let (mut bad, mut own) = (Vec::new(), Vec::new());
    for (i, (model, arguments)) in models.iter().enumerate() {
        if i == 0 || models[i - 1].0 != *model {
            own = around(&mut studio, &format!("own{i}.glb"));
        }
        let fresh = around(&mut studio, &format!("fresh{i}.glb"));
        let measured = own.iter().zip(&fresh).map(|(own, fresh)| own.psnr(fresh));
        let name = model.file_name().unwrap_or_default().to_string_lossy();
        let (least, pixels) = measured.fold((f64::INFINITY, 0), |(least, sum), (psnr, n)| (least.min(psnr), sum + n));
        println!("{name} {}: {least:.1} dB over {pixels} pixels", arguments.join(" "));
        if least < 40.0 || pixels < 20_000 {
            bad.push(format!("{name} {}: {least:.1} dB over {pixels} pixels", arguments.join(" ")));
        }
        if let Some(folder) = std::env::var_os("COATING_PICTURES") {
            for (kind, pictures) in [("own", &own), ("fresh", &fresh)] {
                for (side, picture) in pictures.iter().enumerate() {
                    picture.save(&Path::new(&folder).join(format!("{name}_{i}_{side}_{kind}.png")));
                }
            }
        }
    }
    assert!(bad.is_empty() || std::env::var_os("COATING_MODELS").is_some(), "{bad:#?}");
}
