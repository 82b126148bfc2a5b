//! The program `coating-bake`, and a small model for it.
#![allow(dead_code, reason = "each test binary uses its part")]

use std::{
    fs,
    path::{Path, PathBuf},
    process::{Command, Output},
};

use serde_json::{Value, json};
use tempfile::TempDir;

/// The program, which cargo builds before it runs tests.
pub fn tool() -> PathBuf {
    env!("CARGO_BIN_EXE_coating-bake").into()
}

pub fn bake(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(tool()).args(arguments).current_dir(folder).output().expect("the tool starts")
}

/// Runs the tool, which must succeed.
pub fn baked(folder: &Path, arguments: &[&str]) -> Output {
    let output = bake(folder, arguments);
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    output
}

pub fn stats(folder: &Path, arguments: &[&str]) -> Value {
    baked(folder, &[arguments, &["--stats", "stats.json"]].concat());
    serde_json::from_slice(&fs::read(folder.join("stats.json")).expect("figures")).expect("JSON")
}

pub fn folder() -> TempDir {
    TempDir::new().expect("a folder")
}

/// Names of the files in a folder.
pub fn files(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    entries.map(|entry| entry.expect("a file").file_name().to_string_lossy().into_owned()).collect()
}

pub fn keys(value: &Value) -> Vec<&str> {
    value.as_object().expect("an object").keys().map(String::as_str).collect()
}

pub fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

/// Few steps and sweeps, for tests that need some cracks but no beauty.
pub const QUICK: [&str; 4] = ["--steps", "60", "--set", "deform.sweeps_per_age=300"];

/// Two squares, the second three times as large, mirrored and far away; a texture, and an extension nobody knows.
pub fn write_two_squares(folder: &Path) {
    let mut binary: Vec<u8> = Vec::new();
    for x in [0., 0., 0., 1., 0., 0., 1., 1., 0., 0., 1., 0., 0., 1., 1., 1., 1., 0., 0., 0f32] {
        binary.extend(x.to_le_bytes());
    }
    binary.extend([0u8, 1, 2, 0, 2, 3]);
    let document = json!({
        "asset": { "version": "2.0", "copyright": "nobody" },
        "extensionsUsed": ["KHR_texture_transform", "VENDOR_glitter"],
        "scene": 0,
        "scenes": [{ "nodes": [0, 1] }],
        "nodes": [
            { "name": "small", "mesh": 0 },
            { "name": "large", "mesh": 0, "scale": [-3.0, 3.0, 3.0], "translation": [-5.0, 0.0, 0.0] }
        ],
        "meshes": [{ "primitives": [
            { "attributes": { "POSITION": 0, "TEXCOORD_0": 1 }, "indices": 2, "material": 0 }
        ] }],
        "materials": [{
            "name": "enamel",
            "doubleSided": true,
            "pbrMetallicRoughness": { "baseColorTexture": {
                "index": 0, "extensions": { "KHR_texture_transform": { "scale": [2.0, 2.0] } }
            } },
            "extensions": { "VENDOR_glitter": { "amount": 3 } }
        }],
        "textures": [{ "sampler": 0, "source": 0 }],
        "samplers": [{ "wrapS": 33071 }],
        "images": [{ "uri": "a%20texture.png", "name": "enamel" }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0] },
            { "bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2" },
            { "bufferView": 2, "componentType": 5121, "count": 6, "type": "SCALAR" }
        ],
        "bufferViews": [
            { "buffer": 0, "byteLength": 48 },
            { "buffer": 0, "byteOffset": 48, "byteLength": 32 },
            { "buffer": 0, "byteOffset": 80, "byteLength": 6 }
        ],
        "buffers": [{ "uri": "two.bin", "byteLength": 86 }]
    });
    fs::write(folder.join("two.gltf"), document.to_string()).expect("a file");
    fs::write(folder.join("two.bin"), binary).expect("a file");
    fs::write(folder.join("a texture.png"), TEXTURE).expect("a file");
}

/// Not an image; nobody looks.
pub const TEXTURE: &[u8] = b"\x89PNG\r\n\x1a\n and the rest";

/// A grey image of 4 by 4 texels.
pub fn grey_png() -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, 4, 4);
    encoder.set_color(png::ColorType::Grayscale);
    encoder.write_header().and_then(|mut writer| writer.write_image_data(&[190; 16])).expect("a PNG");
    bytes
}

/// The JSON of a .glb.
pub fn json_of(path: &Path) -> Value {
    let bytes = fs::read(path).expect("a model");
    let length = u32::from_le_bytes(bytes[12..16].try_into().expect("four bytes")) as usize;
    serde_json::from_slice(&bytes[20..20 + length]).expect("JSON")
}
