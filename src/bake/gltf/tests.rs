//! Reads small files made here.

use base64::{Engine, engine::general_purpose::STANDARD};
use bevy_math::{Vec2, Vec3};
use serde_json::{Value, json};

use super::*;

/// Bytes of a .glb.
fn glb(document: &Value, binary: &[u8]) -> Vec<u8> {
    let mut json = document.to_string().into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut bytes = b"glTF\x02\0\0\0".to_vec();
    bytes.extend((28 + json.len() as u32 + binary.len() as u32).to_le_bytes());
    for (kind, chunk) in [(b"JSON", json.as_slice()), (b"BIN\0", binary)] {
        bytes.extend((chunk.len() as u32).to_le_bytes());
        bytes.extend(kind);
        bytes.extend(chunk);
    }
    bytes
}

fn read(document: &Value, binary: &[u8]) -> Result<Model, GltfError> {
    super::read(&glb(document, binary), None, Images::Load)
}

fn floats(values: &[f32]) -> Vec<u8> {
    values.iter().flat_map(|x| x.to_le_bytes()).collect()
}

/// A square of four vertices in the xy plane, 0 to 1, drawn with `mode` from `indices` (bytes).
fn square(mode: u32, indices: &[u8]) -> (Value, Vec<u8>) {
    let mut binary = floats(&[0., 0., 0., 1., 0., 0., 0., 1., 0., 1., 1., 0.]);
    binary.extend(indices);
    let length = binary.len();
    binary.resize(length.next_multiple_of(4), 0);
    let document = json!({
        "asset": { "version": "2.0" },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "name": "square", "mesh": 0 }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 }, "indices": 1, "mode": mode }] }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3" },
            { "bufferView": 1, "componentType": 5121, "count": indices.len(), "type": "SCALAR" }
        ],
        "bufferViews": [
            { "buffer": 0, "byteLength": 48 },
            { "buffer": 0, "byteOffset": 48, "byteLength": indices.len() }
        ],
        "buffers": [{ "byteLength": length }]
    });
    (document, binary)
}

/// Positions in the scene of the first mesh.
fn in_scene(model: &Model) -> Vec<Vec3> {
    model.meshes[0].surface.positions.iter().map(|&p| p + model.meshes[0].origin).collect()
}

/// Sum of the triangles' normals, twice the area long.
fn area_vector(model: &Model) -> Vec3 {
    let surface = &model.meshes[0].surface;
    let corner = |v: u32| surface.positions[v as usize];
    surface.triangles.iter().map(|t| (corner(t[1]) - corner(t[0])).cross(corner(t[2]) - corner(t[0]))).sum()
}

#[test]
fn lists_strips_and_fans_wind_alike() {
    for (mode, indices) in [(4, &[0, 1, 2, 2, 1, 3][..]), (5, &[0, 1, 2, 3]), (6, &[0, 1, 3, 2])] {
        let (document, binary) = square(mode, indices);
        let model = read(&document, &binary).unwrap();
        assert_eq!(model.meshes[0].surface.triangles.len(), 2, "mode {mode}");
        assert_eq!(area_vector(&model), Vec3::Z * 2.0, "mode {mode}");
    }
}

#[test]
fn missing_indices_take_vertices_in_order() {
    let (mut document, binary) = square(5, &[]);
    document["meshes"][0]["primitives"][0].as_object_mut().unwrap().remove("indices");
    assert_eq!(area_vector(&read(&document, &binary).unwrap()), Vec3::Z * 2.0);
}

#[test]
fn nested_transforms_lead_into_scene_space() {
    let (mut document, binary) = square(4, &[0, 1, 2]);
    let half = std::f32::consts::FRAC_1_SQRT_2;
    document["nodes"] = json!([
        { "children": [1], "translation": [10.0, 0.0, 0.0] },
        { "mesh": 0, "rotation": [0.0, 0.0, half, half], "scale": [2.0, 1.0, 1.0] }
    ]);
    let model = read(&document, &binary).unwrap();
    let positions = in_scene(&model);
    // Twice as long along x, turned to y, moved along x.
    assert!(positions[1].abs_diff_eq(Vec3::new(10.0, 2.0, 0.0), 1e-5), "{}", positions[1]);
    assert!(positions[2].abs_diff_eq(Vec3::new(9.0, 0.0, 0.0), 1e-5), "{}", positions[2]);
}

#[test]
fn far_meshes_lose_no_precision() {
    let (mut document, binary) = square(4, &[0, 1, 2]);
    document["nodes"][0]["scale"] = json!([1e-3, 1e-3, 1e-3]);
    document["nodes"][0]["translation"] = json!([1e4, 0.0, -3e4]);
    let model = read(&document, &binary).unwrap();
    let p = &model.meshes[0].surface.positions;
    assert!((p[1] - p[0]).abs_diff_eq(Vec3::X * 1e-3, 1e-9) && (p[2] - p[0]).abs_diff_eq(Vec3::Y * 1e-3, 1e-9));
    assert_eq!(in_scene(&model)[0], Vec3::new(1e4, 0.0, -3e4));
}

#[test]
fn mirrored_meshes_keep_their_outside() {
    let (mut document, mut binary) = square(4, &[0, 1, 2]);
    let start = binary.len();
    binary.extend(floats(&[0., 0., 1.].repeat(4)));
    binary.extend(floats(&[1., 0., 0., 1.].repeat(4)));
    document["buffers"][0]["byteLength"] = binary.len().into();
    let views = document["bufferViews"].as_array_mut().unwrap();
    views.push(json!({ "buffer": 0, "byteOffset": start, "byteLength": 48 }));
    views.push(json!({ "buffer": 0, "byteOffset": start + 48, "byteLength": 64 }));
    let accessors = document["accessors"].as_array_mut().unwrap();
    accessors.push(json!({ "bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC3" }));
    accessors.push(json!({ "bufferView": 3, "componentType": 5126, "count": 4, "type": "VEC4" }));
    let attributes = &mut document["meshes"][0]["primitives"][0]["attributes"];
    attributes["NORMAL"] = 2.into();
    attributes["TANGENT"] = 3.into();
    document["nodes"][0]["scale"] = json!([-3.0, 1.0, 1.0]);
    let model = read(&document, &binary).unwrap();
    let surface = &model.meshes[0].surface;
    assert_eq!(area_vector(&model), Vec3::Z * 3.0, "winding follows the mirror");
    assert_eq!(surface.normals, [Vec3::Z; 3]);
    assert!(surface.tangents.iter().all(|t| t.truncate() == Vec3::NEG_X && t.w == -1.0), "{:?}", surface.tangents);
}

#[test]
fn quantised_and_sparse_accessors() {
    // Positions as normalised 16-bit integers, eight bytes apart; the last one replaced.
    let mut binary = Vec::new();
    for v in [[0i16, 0, 0], [32767, 0, 0], [0, 32767, 0]] {
        v.iter().for_each(|x| binary.extend(x.to_le_bytes()));
        binary.extend([0, 0]);
    }
    binary.extend([2, 0, 0, 0]);
    [0i16, -32767, 0, 0].iter().for_each(|x| binary.extend(x.to_le_bytes()));
    let document = json!({
        "asset": { "version": "2.0" },
        "extensionsRequired": ["KHR_mesh_quantization"],
        "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 } }] }],
        "accessors": [{
            "bufferView": 0, "componentType": 5122, "normalized": true, "count": 3, "type": "VEC3",
            "sparse": {
                "count": 1,
                "indices": { "bufferView": 1, "componentType": 5121 },
                "values": { "bufferView": 2 }
            }
        }],
        "bufferViews": [
            { "buffer": 0, "byteLength": 24, "byteStride": 8 },
            { "buffer": 0, "byteOffset": 24, "byteLength": 1 },
            { "buffer": 0, "byteOffset": 28, "byteLength": 8 }
        ],
        "buffers": [{ "byteLength": binary.len() }]
    });
    let model = read(&document, &binary).unwrap();
    assert_eq!(in_scene(&model), [Vec3::ZERO, Vec3::X, Vec3::NEG_Y]);
}

#[test]
fn primitives_share_vertices_and_fill_in_what_one_lacks() {
    let (mut document, mut binary) = square(4, &[0, 1, 2, 2, 1, 3]);
    let start = binary.len();
    binary.extend(floats(&[0., 0., 1., 0., 0., 1., 1., 1.]));
    document["buffers"][0]["byteLength"] = binary.len().into();
    let views = document["bufferViews"].as_array_mut().unwrap();
    views.push(json!({ "buffer": 0, "byteOffset": start, "byteLength": 32 }));
    document["accessors"] = json!([
        { "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3" },
        { "bufferView": 1, "componentType": 5121, "count": 3, "type": "SCALAR" },
        { "bufferView": 1, "byteOffset": 3, "componentType": 5121, "count": 3, "type": "SCALAR" },
        { "bufferView": 2, "componentType": 5126, "count": 4, "type": "VEC2" }
    ]);
    document["materials"] = json!([{}, { "extensions": { "VENDOR_glitter": { "amount": 3 } } }]);
    document["meshes"][0]["primitives"] = json!([
        { "attributes": { "POSITION": 0, "TEXCOORD_0": 3 }, "indices": 1, "material": 1 },
        { "attributes": { "POSITION": 0 }, "indices": 2 },
        { "attributes": { "POSITION": 0 }, "mode": 1 }
    ]);
    let model = read(&document, &binary).unwrap();
    let mesh = &model.meshes[0];
    assert_eq!(mesh.surface.positions.len(), 4, "one set of positions");
    assert_eq!(mesh.surface.slots, [0, 1]);
    assert_eq!(mesh.surface.uvs, [Vec2::ZERO, Vec2::X, Vec2::Y, Vec2::ZERO, Vec2::ZERO, Vec2::ZERO]);
    assert_eq!(mesh.slots[0], crate::bake::model::Slot { material: Some(1), uvs: true, ..Default::default() });
    assert_eq!(mesh.slots[1], crate::bake::model::Slot::default());
    assert_eq!(model.materials.materials[1]["extensions"]["VENDOR_glitter"]["amount"], 3);
    assert!(model.warnings.is_empty(), "lines go on as they are: {:?}", model.warnings);
    assert_eq!(mesh.place.as_ref().map(|place| place.primitives.clone()), Some(vec![Some(0), Some(1)]));
}

#[test]
fn buffers_in_data_uris() {
    let (mut document, binary) = square(4, &[0, 1, 2]);
    let text = STANDARD.encode(&binary);
    document["buffers"][0]["uri"] = format!("data:application/octet-stream;base64,{text}").into();
    let model = super::read(document.to_string().as_bytes(), None, Images::Skip).unwrap();
    assert_eq!(area_vector(&model), Vec3::Z);
}

/// Programs declare `image/jpg`, or one kind for the bytes of the other. Files begin with a byte order mark.
#[test]
fn images_are_known_by_their_bytes() {
    let (mut document, binary) = square(4, &[0, 1, 2]);
    let uri = |media: &str, bytes: &[u8]| format!("data:{media};base64,{}", STANDARD.encode(bytes));
    let jpeg = [0xff, 0xd8, 0xff, 0xe0];
    document["images"] = json!([
        { "uri": uri("image/jpg", &jpeg), "mimeType": "image/jpg" },
        { "uri": uri("image/png", &jpeg), "mimeType": "image/png" },
        { "uri": uri("image/jpeg", b"\x89PNG\r\n\x1a\n") },
        { "uri": uri("image/vendor", b"what nobody knows") }
    ]);
    document["buffers"][0]["uri"] = uri("", &binary).into();
    let text = format!("\u{feff}{document}");
    let model = super::read(text.as_bytes(), None, Images::Load).unwrap();
    let types: Vec<&str> = model.materials.images.iter().map(|image| image.mime_type.as_str()).collect();
    assert_eq!(types, ["image/jpeg", "image/jpeg", "image/png", "image/vendor"]);
}

/// Files beside the folder are the user's own; images are not worth an error.
#[test]
fn files_lead_out_of_the_folder_and_images_may_be_missing() {
    let folder = tempfile::tempdir().unwrap();
    let models = folder.path().join("models");
    std::fs::create_dir(&models).unwrap();
    let (mut document, binary) = square(4, &[0, 1, 2]);
    std::fs::write(folder.path().join("a b.bin"), &binary).unwrap();
    std::fs::write(folder.path().join("there.png"), b"\x89PNG").unwrap();
    document["buffers"][0]["uri"] = "../a%20b.bin".into();
    document["images"] = json!([{ "uri": "../there.png" }, { "uri": "../gone.png" }, { "uri": "/gone.png" }]);
    let read = |images| super::read(document.to_string().as_bytes(), Some(&models), images).unwrap();
    let model = read(Images::Load);
    let lengths: Vec<usize> = model.materials.images.iter().map(|image| image.bytes.len()).collect();
    assert_eq!(lengths, [4, 0, 0]);
    assert_eq!(model.materials.images[1].rest["uri"], "../gone.png");
    let [warning] = model.warnings.as_slice() else { panic!("{:?}", model.warnings) };
    assert!(warning.to_string().starts_with("2 images cannot be read"), "{warning}");
    assert_eq!(model.files.len(), 3, "{:?}", model.files);
    assert!(read(Images::Skip).warnings.is_empty());
}

/// Every way to be wrong is an error that says what is wrong.
#[test]
fn faults_are_named() {
    let (good, binary) = square(4, &[0, 1, 2]);
    assert!(read(&good, &binary).is_ok());
    let fault = |change: &dyn Fn(&mut Value)| {
        let mut document = good.clone();
        change(&mut document);
        read(&document, &binary).expect_err("a fault").to_string()
    };
    let cases: [(&dyn Fn(&mut Value), &str); 17] = [
        (&|d| d["asset"]["version"] = "1.0".into(), "is glTF 1.0"),
        (&|d| d["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]), "KHR_draco_mesh_compression"),
        (&|d| d["scene"] = 7.into(), "refers to scene 7"),
        (&|d| d["nodes"][0]["mesh"] = 3.into(), "refers to mesh 3"),
        (&|d| d["nodes"][0]["children"] = json!([0]), "its own ancestor"),
        (
            &|d| {
                d["nodes"] = json!([
                    { "children": [1], "scale": [1e38, 1, 1] },
                    { "mesh": 0, "scale": [1e38, 1, 1], "name": "far" }
                ])
            },
            "node far: vertex 1 is not at a finite place",
        ),
        (&|d| d["meshes"][0]["primitives"][0]["attributes"] = json!({}), "has no POSITION"),
        (&|d| d["meshes"][0]["primitives"][0]["material"] = 0.into(), "refers to material 0"),
        (&|d| d["accessors"][0]["count"] = 5.into(), "is cut off"),
        (&|d| d["accessors"][0]["count"] = 2.into(), "refers to vertex 2"),
        (&|d| d["accessors"][0]["count"] = 1_000_000_000_000u64.into(), "more than"),
        (&|d| d["accessors"][0]["type"] = "VEC2".into(), "not VEC3"),
        (&|d| d["accessors"][1]["componentType"] = 5126.into(), "no unsigned integers"),
        (&|d| d["bufferViews"][0]["byteOffset"] = u64::MAX.into(), "is cut off"),
        (&|d| d["buffers"][0]["uri"] = "/etc/passwd".into(), "no relative path"),
        (&|d| d["buffers"][0]["uri"] = "https://example.com/a.bin".into(), "no relative path"),
        (&|d| d["buffers"][0]["uri"] = "../a.bin".into(), "the model is none"),
    ];
    for (change, expected) in cases {
        let message = fault(change);
        assert!(message.contains(expected), "{message:?} does not say {expected:?}");
    }
}

/// Cut off or damaged anywhere, a file is an error or another model, never a panic.
#[test]
fn damaged_files_do_not_panic() {
    let (document, binary) = square(4, &[0, 1, 2, 2, 1, 3]);
    let bytes = glb(&document, &binary);
    for end in 0..bytes.len() {
        assert!(super::read(&bytes[..end], None, Images::Load).is_err(), "cut at {end}");
    }
    for at in 0..bytes.len() {
        for value in [0, b'9', b'-', 0x7f, 0xff] {
            let mut damaged = bytes.clone();
            damaged[at] = value;
            let _ = super::read(&damaged, None, Images::Load);
        }
    }
}
