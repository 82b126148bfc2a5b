//! Models whose unit is no metre.

use std::{fs, path::Path};

use bevy_coating::bake::{Images, Input};
use bevy_math::Vec3;
use serde_json::Value;

use crate::tool::{QUICK, folder, stats, write_two_squares};

/// Corners of the bounding box of a model in its scene, in its own unit.
fn bounds(file: &Path) -> [Vec3; 2] {
    let model = Input::parse(file.as_os_str()).expect("an input").read(0, Images::Skip).expect("a model");
    let points = model.meshes.iter().flat_map(|mesh| mesh.surface.positions.iter().map(|&p| p + mesh.origin));
    let empty = [Vec3::INFINITY, Vec3::NEG_INFINITY];
    points.fold(empty, |[low, high], p| [low.min(p), high.max(p)])
}

/// Figures of a baked model, and its bounding box.
fn run(folder: &Path, arguments: &[&str]) -> (Value, [Vec3; 2]) {
    let common = ["--triangles", "300", "--age", "0.6", "--vertex-colors", "--out", "out.glb"];
    let stats = stats(folder, &[arguments, &common, &QUICK].concat());
    (stats, bounds(&folder.join("out.glb")))
}

#[test]
fn a_model_in_another_unit_ages_alike_and_keeps_its_size() {
    let folder = folder();
    // A square of a metre, 20 m beside the origin.
    for (name, size) in [("metres.obj", 1.0), ("small.obj", 128.0)] {
        let [a, b] = [20.0 * size, 21.0 * size];
        let text = format!("v {a} 0 0\nv {b} 0 0\nv {b} {size} 0\nv {a} {size} 0\nf 1 2 3 4\n");
        fs::write(folder.path().join(name), text).expect("a file");
    }
    let (metres, places) = run(folder.path(), &["metres.obj"]);
    let (small, small_places) = run(folder.path(), &["small.obj", "--metres-per-unit", "0.0078125"]);
    assert_eq!((&small["digest"], &small["film"]), (&metres["digest"], &metres["film"]));
    for (small, metres) in small_places.iter().zip(places) {
        assert!(small.distance(metres * 128.0) < 0.02, "{small} {metres}");
    }
}

#[test]
fn nodes_keep_their_unit() {
    let folder = folder();
    write_two_squares(folder.path());
    let (metres, places) = run(folder.path(), &["two.gltf"]);
    let (large, large_places) = run(folder.path(), &["two.gltf", "--metres-per-unit", "4"]);
    assert_ne!(large["digest"], metres["digest"], "larger squares");
    let edges = [&large, &metres].map(|stats| stats["film"]["mean_edge"].as_f64().expect("a length"));
    assert!((edges[0] / edges[1] - 4.0).abs() < 0.2, "{edges:?}");
    // But for flakes that curl, they are where they were.
    for (large, metres) in large_places.iter().zip(places) {
        assert!(large.distance(metres) < 0.3, "{large} {metres}");
    }
}
