//! Glass, and what is excluded by its name, stays as it is.

use bevy_coating::bake::{BakeError, BakeOptions, BakeWarning, Images, Model, NamePattern, Stopwatch, bake};
use serde_json::{Value, json};

use crate::{
    build::Builder,
    carried::{ALL, SMALL, aged, built, drawn, quick},
    strict::{Glb, index},
};

/// A window frame with a pane, and a lens of transmissive glass.
fn window() -> Builder {
    let mut builder = Builder::new();
    let frame = builder.plate(5, &["NORMAL", "TEXCOORD_0"]);
    let mut pane = builder.plate(2, &["NORMAL"]);
    pane["material"] = 1.into();
    pane["extras"] = json!({ "pane": true });
    let mut lens = builder.plate(2, &["NORMAL"]);
    lens["material"] = 2.into();
    let points = json!({ "mode": 0, "attributes": pane["attributes"] });
    builder.root = json!({
        "asset": { "version": "2.0" },
        "extensionsUsed": ["KHR_materials_transmission"],
        "nodes": [{ "name": "window", "mesh": 0 }, { "name": "lens", "mesh": 1 }, { "name": "sill", "mesh": 2 }],
        "meshes": [
            { "name": "window mesh", "primitives": [frame, pane, points] },
            { "name": "lens mesh", "primitives": [lens] },
            { "name": "sill mesh", "primitives": [frame] }
        ],
        "materials": [
            { "name": "paint" },
            { "name": "pane", "alphaMode": "BLEND", "pbrMetallicRoughness": { "baseColorFactor": [1, 1, 1, 0.3] } },
            { "name": "lens", "extensions": { "KHR_materials_transmission": { "transmissionFactor": 0.9 } } }
        ]
    });
    builder
}

#[test]
fn glass_stays_and_its_frame_ages() {
    let builder = window();
    for stains in ALL {
        let (glb, warnings) = aged(built(&builder), &quick(0.9), stains);
        assert_eq!(warnings, [BakeWarning::Glass { count: 2 }]);
        assert_eq!(glb.root["meshes"][1], builder.root["meshes"][1], "the lens");
        let primitives = glb.root["meshes"][0]["primitives"].as_array().expect("primitives");
        assert_eq!(primitives[1..3], builder.root["meshes"][0]["primitives"].as_array().expect("primitives")[1..3]);
        assert!(primitives.len() > 3, "the frame has backs and metal: {primitives:?}");
        assert_eq!(
            glb.root["materials"].as_array().map(|all| all[1..3].to_vec()),
            Some(vec![builder.root["materials"][1].clone(), builder.root["materials"][2].clone(),])
        );
        let own = Glb::new(&builder.glb());
        let glass =
            |glb: &Glb, i: usize| glb.floats(index(&primitives_of(glb, 0)[i]["attributes"]["POSITION"]).expect("p"));
        assert_eq!(glass(&glb, 1), glass(&own, 1));
    }
}

fn primitives_of(glb: &Glb, mesh: usize) -> Vec<Value> {
    glb.root["meshes"][mesh]["primitives"].as_array().cloned().expect("primitives")
}

#[test]
fn what_is_excluded_stays() {
    let builder = window();
    for (pattern, mesh) in [("sil?", 2), ("sill mesh", 2), ("w*mesh", 0)] {
        let options = BakeOptions { exclude: vec![NamePattern::new(pattern)], ..quick(0.6) };
        let (glb, warnings) = aged(built(&builder), &options, SMALL);
        assert_eq!(primitives_of(&glb, mesh), *builder.root["meshes"][mesh]["primitives"].as_array().expect("some"));
        assert_eq!(warnings.len(), 1, "{warnings:?}");
        let other = 2 - mesh;
        assert_ne!(primitives_of(&glb, other), *builder.root["meshes"][other]["primitives"].as_array().expect("some"));
    }
    let options = BakeOptions { exclude: vec!["paint".into(), "nobody".into()], ..quick(0.6) };
    let error = bake(built(&builder), &options, Stopwatch::start(), &()).expect_err("nothing to age");
    assert!(matches!(error, BakeError::AllLeftAlone { .. }), "{error}");
    let options = BakeOptions { exclude: vec!["nobody".into()], ..quick(0.6) };
    let (_, warnings) = aged(built(&builder), &options, SMALL);
    assert!(warnings.contains(&BakeWarning::NothingExcluded { pattern: "nobody".into() }), "{warnings:?}");
}

#[test]
fn excluded_parts_of_a_model_without_a_document_are_written_too() {
    let obj = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
    let mut model = Model::from_obj(obj, "square", None, Images::Load).expect("a model");
    let mut glass = model.meshes[0].clone();
    glass.name = "pane".into();
    model.meshes.push(glass);
    let options = BakeOptions { exclude: vec!["pane".into()], ..quick(0.9) };
    let (glb, _) = aged(model, &options, SMALL);
    let names: Vec<_> = glb.list("nodes").iter().map(|node| node["name"].as_str().expect("a name")).collect();
    assert_eq!(names, ["square", "pane"]);
    assert_eq!(drawn(&glb).iter().filter(|(node, ..)| *node == 1).count(), 2);
}
