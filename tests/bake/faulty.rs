//! Odd and faulty files, and large ones: what is wrong is named, and what they cost stays in proportion.

use std::path::Path;

use bevy_coating::bake::{BakeWarning, Images, Input, Model, StainOutput};
use serde_json::{Value, json};

use crate::{
    build::Builder,
    carried::{ALL, SMALL, aged, built, data, drawn, quick},
    strict::Glb,
};

#[test]
fn names_are_kept_in_the_file_and_escaped_in_messages() {
    let model = data("odd_names.glb");
    let name = model.meshes[0].name.clone();
    let (glb, warnings) = aged(model, &quick(0.6), SMALL);
    assert_eq!(glb.root["nodes"][0]["name"], name.as_str());
    assert!(name.contains('\n') && name.contains('\u{1b}'));
    assert!(!warnings.is_empty());
    for text in warnings.iter().map(ToString::to_string) {
        assert!(!text.chars().any(char::is_control), "{text:?}");
        assert!(text.contains("line one\\nline two \"quoted\" \\u{1b}[31mred"), "{text:?}");
    }
}

#[test]
fn textures_without_coordinates_are_left_out_with_a_warning() {
    for stains in ALL {
        let (glb, warnings) = aged(data("normals_without_uvs.glb"), &quick(0.6), stains);
        let [BakeWarning::Repeated { first, more: 1 }] = &warnings[..] else { panic!("{warnings:?}") };
        assert!(matches!(**first, BakeWarning::TexturesWithoutCoordinates { count: 1, .. }), "{warnings:?}");
        assert!(drawn(&glb).len() > 500);
    }
}

#[test]
fn references_to_textures_that_do_not_exist_are_left_out_with_a_warning() {
    for stains in ALL {
        let (glb, warnings) = aged(data("dangling_texture.glb"), &quick(0.6), stains);
        assert_eq!(warnings[0], BakeWarning::DanglingTextures { count: 1 }, "{warnings:?}");
        // The rest of the material is there.
        assert_eq!(glb.root["materials"][0]["emissiveTexture"]["index"], 0);
    }
}

#[test]
fn accessors_of_nothing_do_not_take_memory() {
    let path = Path::new("tests/bake/data/zero_positions.glb");
    let error = Input::File(path.into()).read(0, Images::Load).expect_err("too many").to_string();
    assert!(error.contains("zero_positions.glb") && error.contains("more than 65536"), "{error}");
}

#[test]
fn images_that_share_bytes_share_them_to_the_end() {
    let mut builder = Builder::new();
    let plate = builder.plate(3, &["NORMAL", "TEXCOORD_0"]);
    let image = builder.view(&[b"\x89PNG\r\n\x1a\n".as_slice(), &[7; 100_000]].concat());
    let images = vec![json!({ "bufferView": image, "mimeType": "image/png" }); 8_000];
    builder.root = json!({
        "asset": { "version": "2.0" },
        "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [plate] }],
        "materials": [{}],
        "images": images
    });
    let model = built(&builder);
    assert!(model.materials.images.iter().all(|image| std::ptr::eq(&*image.bytes, &*model.materials.images[0].bytes)));
    let (glb, _) = aged(model, &quick(0.0), StainOutput::None);
    assert_eq!(glb.list("images").len(), 8_000);
    assert!(glb.binary.len() < 1_000_000, "{}", glb.binary.len());
}

/// References that lead nowhere are errors that name them.
#[test]
fn dangling_references_are_refused_by_name() {
    let mut builder = Builder::new();
    let plate = builder.plate(3, &["NORMAL"]);
    builder.root = json!({
        "asset": { "version": "2.0" }, "scene": 0, "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0 }, {}], "meshes": [{ "primitives": [plate] }], "materials": [{}],
        "animations": [{
            "channels": [{ "sampler": 0, "target": { "node": 0, "path": "scale" } }],
            "samplers": [{ "input": 0, "output": 0 }]
        }],
        "skins": [{ "joints": [1] }]
    });
    let cases: [(&dyn Fn(&mut Value), &str); 7] = [
        (&|d| d["nodes"][1]["camera"] = 0.into(), "node 1 refers to camera 0"),
        (&|d| d["nodes"][1]["mesh"] = 9.into(), "node 1 refers to mesh 9"),
        (&|d| d["skins"][0]["joints"] = json!([5]), "skin 0 refers to node 5"),
        (&|d| d["animations"][0]["samplers"][0]["output"] = 99.into(), "animation 0 refers to accessor 99"),
        (&|d| d["animations"][0]["channels"][0]["sampler"] = 3.into(), "animation 0 refers to sampler 3"),
        (&|d| d["scenes"] = json!([{ "nodes": [0] }, { "nodes": [7] }]), "scene 1 refers to node 7"),
        (
            &|d| d["meshes"] = json!([d["meshes"][0].clone(), { "primitives": [{ "attributes": { "_A": 77 } }] }]),
            "mesh 1 refers to accessor 77",
        ),
    ];
    for (change, expected) in cases {
        let mut faulty = builder.clone();
        change(&mut faulty.root);
        let error = Model::from_gltf(&faulty.glb(), None, Images::Load).expect_err(expected).to_string();
        assert!(error.contains(expected), "{error}");
        assert!(Model::from_gltf(&faulty.glb(), None, Images::Skip).is_ok(), "figures need none of it: {expected}");
    }
}

/// Returns the texels of all images of a file.
fn texels_of(glb: &Glb) -> u64 {
    (0..glb.list("images").len())
        .map(|i| png::Decoder::new(std::io::Cursor::new(glb.image(i))).read_info().expect("a PNG").info().size())
        .map(|(width, height)| u64::from(width) * u64::from(height))
        .sum()
}

/// Equal meshes are many small props, not many large ones.
#[test]
fn texels_are_shared_by_all_of_a_file() {
    let (glb, warnings) = aged(data("many_nodes_40.glb"), &quick(0.6), StainOutput::Textures(1024));
    assert!(warnings.len() <= 3 && warnings.iter().all(|w| matches!(w, BakeWarning::Repeated { .. })), "{warnings:?}");
    let texels = texels_of(&glb);
    // Three textures of paint and three of backs and metal, as of one prop; sides are multiples of 64.
    assert!(texels < 2 * 6 * 1024 * 1024, "{texels}");
    assert!(glb.binary.len() < 8 << 20, "{}", glb.binary.len());
    assert_eq!(glb.list("meshes").len(), 40, "each beam ages by itself");
}

/// Hundreds of equal beams take texels in proportion to their area.
#[test]
fn a_truss_of_many_beams_takes_no_more_texels_than_one_prop() {
    let mut builder = Builder::new();
    let beam = builder.plate(2, &["NORMAL", "TEXCOORD_0"]);
    let nodes =
        (0..300).map(|i| json!({ "mesh": 0, "name": format!("beam {i}"), "translation": [f64::from(i), 0, 0] }));
    builder.root = json!({
        "asset": { "version": "2.0" },
        "nodes": nodes.collect::<Vec<Value>>(),
        "meshes": [{ "name": "beam", "primitives": [beam] }],
        "materials": [{ "name": "paint" }]
    });
    let (glb, warnings) = aged(built(&builder), &quick(0.6), StainOutput::default());
    assert!(warnings.len() <= 2, "{warnings:?}");
    let size = glb.binary.len() + glb.root.to_string().len();
    assert!(size < 12_000_000, "{size}");
    // Time goes with the texels: large textures for each beam would take ten minutes.
    assert!(texels_of(&glb) < 4 * 6 * 1024 * 1024, "{}", texels_of(&glb));
}
