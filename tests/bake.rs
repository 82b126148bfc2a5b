//! The `bake` example from outside: exit codes, figures, files, and the aged model in another reader. Includes the
//! example's modules too, so that their unit tests run.

#[path = "../examples/common/mod.rs"]
mod common;

use std::{
    collections::BTreeSet,
    fs,
    path::{Path, PathBuf},
    process::{Command, Output},
};

use serde_json::{Value, json};
use tempfile::TempDir;

/// The example, which cargo builds before it runs tests: beside the folder of this test.
fn tool() -> PathBuf {
    let test = std::env::current_exe().expect("a path of the test");
    let profile = test.ancestors().nth(2).expect("a folder of the profile");
    let tool = profile.join("examples").join(format!("bake{}", std::env::consts::EXE_SUFFIX));
    assert!(tool.is_file(), "{} is missing: cargo build --example bake", tool.display());
    tool
}

fn bake(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(tool()).args(arguments).current_dir(folder).output().expect("the tool starts")
}

/// Runs the tool, which must succeed.
fn baked(folder: &Path, arguments: &[&str]) -> Output {
    let output = bake(folder, arguments);
    assert!(output.status.success(), "{arguments:?}: {}", String::from_utf8_lossy(&output.stderr));
    output
}

fn stats(folder: &Path, arguments: &[&str]) -> Value {
    baked(folder, &[arguments, &["--stats", "stats.json"]].concat());
    serde_json::from_slice(&fs::read(folder.join("stats.json")).expect("figures")).expect("JSON")
}

fn folder() -> TempDir {
    TempDir::new().expect("a folder")
}

/// Names of the files in a folder.
fn files(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    entries.map(|entry| entry.expect("a file").file_name().to_string_lossy().into_owned()).collect()
}

fn keys(value: &Value) -> Vec<&str> {
    value.as_object().expect("an object").keys().map(String::as_str).collect()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

/// Few steps and sweeps, for tests that need some cracks but no beauty.
const QUICK: [&str; 4] = ["--steps", "60", "--set", "deform.sweeps_per_age=300"];

#[test]
fn figures_have_their_layout_and_agree_with_each_other() {
    let folder = folder();
    let stats = stats(folder.path(), &[&["plate:800", "--age", "0.93", "--seed", "2"], &QUICK[..]].concat());
    assert_eq!(keys(&stats), ["digest", "film", "input", "run", "schema", "seconds", "timeline"]);
    assert_eq!(stats["schema"], 1);
    assert_eq!(keys(&stats["input"]), ["triangles", "vertices"]);
    assert_eq!(stats["input"]["triangles"], 800);
    let film = &stats["film"];
    let expected =
        ["border_loops", "components", "edge_cv", "euler", "mean_edge", "min_angle_deg", "triangles", "vertices"];
    assert_eq!(keys(film), expected);
    assert_eq!([&film["triangles"], &film["components"], &film["border_loops"], &film["euler"]], [800, 1, 1, 1]);
    assert!(number(&film["edge_cv"]) < 0.25 && number(&film["min_angle_deg"]) > 20.0, "{film}");
    let run = json!({ "age": 0.93, "steps": 60, "seed": 2, "preset": "default", "sweeps_per_age": 300.0 });
    assert_eq!(stats["run"], run);

    let seconds = &stats["seconds"];
    assert_eq!(keys(seconds), ["build", "deform", "fracture", "mesh", "other", "stain", "total"]);
    let parts: f64 =
        ["build", "fracture", "deform", "mesh", "stain", "other"].iter().map(|k| number(&seconds[k])).sum();
    assert!((parts - number(&seconds["total"])).abs() < 1e-6, "{seconds}");

    let timeline = stats["timeline"].as_array().expect("entries");
    // Ages 0, 1/20 ... 18/20 and 0.93: the first step at or past each.
    assert_eq!(timeline.len(), 20);
    for (i, entry) in timeline.iter().enumerate() {
        let asked = if i == 19 { 0.93 } else { i as f64 / 20.0 };
        let age = number(&entry["age"]);
        assert!(age >= asked - 1e-6 && age < asked + 1.0 / 60.0, "entry {i} has age {age}");
    }
    let names: BTreeSet<&str> = keys(&timeline[0]).into_iter().collect();
    let expected = [
        "age",
        "separated",
        "torn",
        "stripped",
        "fallen",
        "vertices",
        "crack_tips",
        "junctions",
        "straightness",
        "crack_length",
        "pieces",
        "loose_pieces",
        "strain_rms",
        "strain_max",
        "lift_p90",
        "rust_emitted",
        "rust_wet",
        "rust_stained",
        "rust_dripped",
        "sources",
        "dust_mean",
        "moisture_mean",
    ];
    assert_eq!(names, expected.into_iter().collect());
    for name in ["straightness", "strain_rms", "strain_max", "lift_p90"] {
        assert_eq!(timeline[0][name], Value::Null, "{name} of a fresh film");
        assert!(timeline[19][name].is_number(), "{name} of an aged film");
    }
    for name in ["separated", "torn", "stripped", "fallen", "crack_length"] {
        let grows = timeline.windows(2).all(|pair| number(&pair[0][name]) <= number(&pair[1][name]));
        assert!(grows && number(&timeline[0][name]) == 0.0, "{name} is cumulative");
    }
    assert!(number(&timeline[19]["separated"]) > 0.3, "{}", timeline[19]);
    let digest = stats["digest"].as_str().expect("text");
    assert!(digest.len() == 64 && digest.bytes().all(|c| c.is_ascii_hexdigit()), "{digest}");
}

#[test]
fn the_same_run_gives_the_same_digest() {
    let folder = folder();
    let run = |seed: &str| stats(folder.path(), &[&["curved:400", "--seed", seed], &QUICK[..]].concat());
    let (first, second, other) = (run("7"), run("7"), run("8"));
    assert_eq!(first["digest"], second["digest"]);
    assert_eq!(first["timeline"], second["timeline"]);
    assert_ne!(first["digest"], other["digest"]);
}

#[test]
fn bad_usage_is_2() {
    let folder = folder();
    let cases: &[&[&str]] = &[
        &[],
        &["plate:many"],
        &["plate:0"],
        &["disk:4294967297"],
        &["plate:100", "--preset", "no_such_preset"],
        &["plate:100", "--set", "tearing.bta=1"],
        &["plate:100", "--set", "tearing.beta=much"],
        &["plate:100", "--set", "tearing.beta=-7"],
        &["plate:100", "--set", "tearing.beta"],
        &["plate:100", "--age", "-1"],
        &["plate:100", "--age", "NaN"],
        &["plate:100", "--steps", "0"],
        &["plate:100", "--steps", "-5"],
        &["plate:100", "--seed", "-1"],
        &["plate:100", "--triangles", "3"],
        &["plate:100", "--triangles", "all"],
        &["plate:100", "--gravity", "0,0,0"],
        &["plate:100", "--gravity", "0,-1"],
        &["plate:100", "--gravity", "0,nan,1"],
        &["plate:100", "--wind", "0,1"],
        &["plate:100", "--wind", "0,200,0"],
        &["plate:100", "--gusts", "-0.1"],
        &["plate:100", "--gusts", "11"],
        &["plate:100", "--rain", "0,-1.1,0"],
        &["plate:100", "--rain", "0,inf,0"],
        &["plate:100", "--sun", "1,1,1"],
        &["plate:100", "--texture-size", "63"],
        &["plate:100", "--texture-size", "8193"],
        &["plate:100", "--texture-size", "-256"],
        &["plate:100", "--texture-size", "big"],
        &["plate:100", "--texture-size", "256", "--vertex-colors"],
        &["plate:100", "--no-stains", "--vertex-colors"],
        &["plate:100", "--out", "model.gltf"],
        &["plate:100", "--out", "same", "--stats", "same"],
        &["plate:100", "plate:100"],
        &["plate:100", "--unknown"],
    ];
    for case in cases {
        let output = bake(folder.path(), case);
        assert_eq!(output.status.code(), Some(2), "{case:?}: {}", String::from_utf8_lossy(&output.stderr));
        assert!(!output.stderr.is_empty() && output.stdout.is_empty(), "{case:?}");
    }
    assert!(files(folder.path()).is_empty());
}

#[test]
fn numbers_may_be_negative_where_they_make_sense() {
    let folder = folder();
    let quick = ["plate:20", "--age", "0"];
    baked(folder.path(), &[&quick[..], &["--gravity", "-3,0.5,0"]].concat());
    baked(folder.path(), &[&quick[..], &["--gravity=0,-1e38,1e38"]].concat());
}

#[test]
fn bad_input_is_1_and_one_line_and_writes_nothing() {
    let folder = folder();
    let inputs: &[(&str, &[u8])] = &[
        ("empty.glb", b""),
        ("noise.glb", b"\x00\x01\x02 no model at all"),
        ("header.glb", b"glTF\x02\0\0\0\xff\0\0\0"),
        ("broken.gltf", b"{ \"asset\": { \"version\": \"2.0\" }, \n \"nodes\": [ }"),
        ("nothing.gltf", b"{ \"asset\": { \"version\": \"2.0\" } }"),
        ("missing.gltf", br#"{"asset":{"version":"2.0"},"buffers":[{"byteLength":4,"uri":"gone.bin"}]}"#),
        ("line.obj", b"v 0 0 0\nv 1 0 0\nf 1 2 3\n"),
        ("nan.obj", b"v 0 0 0\nv 1 0 0\nv nan 1 0\nf 1 2 3\n"),
        ("flat.obj", b"v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"),
        ("points.obj", b"v 0 0 0\n"),
        ("model.stl", b"solid"),
    ];
    for (name, bytes) in inputs {
        fs::write(folder.path().join(name), bytes).expect("a file");
    }
    fs::write(folder.path().join("bad.ron"), "(tearing: (beta: 7.0))").expect("a file");
    fs::create_dir(folder.path().join("a_folder.glb")).expect("a folder");
    let before = files(folder.path()).len();
    let mut cases: Vec<Vec<&str>> = inputs.iter().map(|(name, _)| vec![*name]).collect();
    cases.push(vec!["no_such_file.glb"]);
    cases.push(vec!["a_folder.glb"]);
    cases.push(vec!["plate:20", "--preset", "bad.ron"]);
    cases.push(vec!["plate:20", "--preset", "no_such_file.ron"]);
    cases.push(vec!["plate:20", "--dump", "no_such_folder/dump.csv"]);
    for case in &cases {
        let arguments = [&case[..], &["--out", "out.glb", "--stats", "out.json"]].concat();
        let output = bake(folder.path(), &arguments);
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{case:?}: {error}");
        assert!(error.ends_with('\n') && error.lines().count() == 1, "{case:?}: {error:?}");
        let named = case.last().expect("an argument");
        assert!(error.contains(named), "{case:?}: {error:?} does not name the file");
        assert!(output.stdout.is_empty());
        assert_eq!(files(folder.path()).len(), before, "{case:?} left files behind");
    }
}

#[test]
fn a_file_that_fails_to_be_written_keeps_the_old_one() {
    let folder = folder();
    fs::write(folder.path().join("out.glb"), "old").expect("a file");
    fs::create_dir(folder.path().join("stats.json")).expect("a folder in the way");
    let output = bake(folder.path(), &["plate:20", "--age", "0", "--out", "out.glb", "--stats", "stats.json"]);
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(fs::read(folder.path().join("out.glb")).expect("the old file"), b"old");
    assert_eq!(files(folder.path()).len(), 2);
}

#[test]
fn the_dump_has_one_row_a_vertex_in_one_id_space() {
    let folder = folder();
    write_two_squares(folder.path());
    let arguments = [&["two.gltf", "--triangles", "600", "--dump", "dump.csv", "--age", "0.8"], &QUICK[..]].concat();
    let stats = stats(folder.path(), &arguments);
    let text = fs::read_to_string(folder.path().join("dump.csv")).expect("a dump");
    let mut lines = text.lines();
    let header = "id,original,live,rest_x,rest_y,rest_z,normal_x,normal_y,normal_z,x,y,z,separated_age,border,\
                  mean_dihedral";
    assert_eq!(lines.next(), Some(header));
    let rows: Vec<Vec<&str>> = lines.map(|line| line.split(',').collect()).collect();
    let field = |row: &[&str], i: usize| row[i].parse::<f64>().expect("a number");
    let (mut originals, mut live, mut separated) = (0, 0, BTreeSet::new());
    for (i, row) in rows.iter().enumerate() {
        assert_eq!(row.len(), 15, "row {i}");
        assert_eq!(field(row, 0), i as f64, "ids count up");
        let original = field(row, 1) as usize;
        assert!(original <= i && rows[original][1] == rows[original][0], "row {i}");
        assert_eq!(row[3..9], rows[original][3..9], "rest state of row {i}");
        originals += u64::from(original == i);
        live += u64::from(row[2] == "1");
        if !row[12].is_empty() {
            assert!((0.0..=0.8 + 1e-6).contains(&field(row, 12)));
            separated.insert(original);
        } else {
            assert_eq!(row[3..6], row[9..12], "row {i} is attached and has not moved");
        }
        assert!(original == i || row[13] == "1", "duplicates are border");
        // Flat squares: every inner edge has an angle of pi.
        assert!(row[14].is_empty() || (field(row, 14) - std::f64::consts::PI).abs() < 1e-3, "row {i}");
    }
    let last = stats["timeline"].as_array().and_then(|t| t.last()).expect("an entry").clone();
    assert_eq!(originals, stats["film"]["vertices"].as_u64().expect("a count"));
    assert_eq!(live, last["vertices"].as_u64().expect("a count"));
    assert!((separated.len() as f64 / originals as f64 - number(&last["separated"])).abs() < 1e-9);
}

#[test]
fn figures_of_several_meshes_are_added_up() {
    let folder = folder();
    write_two_squares(folder.path());
    let keep = stats(folder.path(), &["two.gltf", "--triangles", "keep", "--age", "0"]);
    assert_eq!(keep["input"], json!({ "triangles": 4, "vertices": 8 }));
    let film = &keep["film"];
    assert_eq!([&film["triangles"], &film["vertices"], &film["components"], &film["euler"]], [4, 8, 2, 2]);
    // Two squares of sides 1 and 3: four sides and a diagonal each.
    let mean = 4.0 * (4.0 + 2f64.sqrt()) / 10.0;
    assert!((number(&film["mean_edge"]) - mean).abs() < 1e-6, "{film}");
    // The budget is for both, shared by area.
    let film = &stats(folder.path(), &["two.gltf", "--triangles", "1000", "--age", "0"])["film"];
    assert!((900.0..1100.0).contains(&number(&film["triangles"])), "{film}");
    assert_eq!(film["border_loops"], 2);
}

/// Two squares, the second three times as large, mirrored and far away; a texture, and an extension nobody knows.
fn write_two_squares(folder: &Path) {
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
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0, "TEXCOORD_0": 1 }, "indices": 2, "material": 0 }] }],
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
const TEXTURE: &[u8] = b"\x89PNG\r\n\x1a\n and the rest";

/// The aged model in the `gltf` crate, which validates what it reads.
fn read_back(path: &Path) -> (gltf::Document, Vec<u8>) {
    let bytes = fs::read(path).expect("a model");
    let gltf::Gltf { document, blob } = gltf::Gltf::from_slice(&bytes).expect("valid glTF");
    (document, blob.expect("a binary chunk"))
}

/// Checks every vertex of an aged model; gives the number of triangles of each material.
fn check_model(document: &gltf::Document, blob: &[u8]) -> Vec<(String, usize)> {
    let mut triangles = Vec::new();
    for node in document.default_scene().expect("a scene").nodes() {
        for primitive in node.mesh().expect("a mesh").primitives() {
            let reader = primitive.reader(|_| Some(blob));
            let positions: Vec<_> = reader.read_positions().expect("positions").collect();
            let normals: Vec<_> = reader.read_normals().expect("normals").collect();
            let indices: Vec<_> = reader.read_indices().expect("indices").into_u32().collect();
            assert!(indices.iter().all(|&i| (i as usize) < positions.len()) && indices.len() % 3 == 0);
            assert_eq!(positions.len(), normals.len());
            assert!(positions.iter().flatten().all(|x| x.is_finite()));
            let unit = |n: &[f32; 3]| (n.iter().map(|x| x * x).sum::<f32>() - 1.0).abs() < 1e-3;
            assert!(normals.iter().all(unit));
            let bounds = primitive.bounding_box();
            for axis in 0..3 {
                let lowest = positions.iter().map(|p| p[axis]).fold(f32::INFINITY, f32::min);
                let highest = positions.iter().map(|p| p[axis]).fold(f32::NEG_INFINITY, f32::max);
                assert_eq!((bounds.min[axis], bounds.max[axis]), (lowest, highest));
            }
            let material = primitive.material().name().unwrap_or("").to_owned();
            triangles.push((material, indices.len() / 3));
        }
    }
    triangles
}

#[test]
fn the_aged_model_opens_elsewhere_with_its_texture() {
    let folder = folder();
    write_two_squares(folder.path());
    let arguments = ["two.gltf", "--triangles", "600", "--out", "out.glb", "--age", "0.8"];
    baked(folder.path(), &[&arguments[..], &QUICK[..]].concat());
    let (document, blob) = read_back(&folder.path().join("out.glb"));
    assert_eq!(document.as_json().asset.copyright.as_deref(), Some("nobody"));
    let names: Vec<_> = document.nodes().map(|node| node.name().unwrap_or("").to_owned()).collect();
    assert_eq!(names, ["small", "large"]);
    let triangles = check_model(&document, &blob);
    let of = |name: &str| triangles.iter().filter(|(material, _)| material == name).map(|(_, n)| n).sum::<usize>();
    let (paint, primer, metal) = (of("enamel"), of("primer"), of("rusted metal"));
    assert!(primer > 0 && primer <= paint && metal >= primer, "{triangles:?}");

    // The texture, its transform and what nobody knows came along.
    let image = document.images().next().expect("an image");
    let gltf::image::Source::View { view, mime_type } = image.source() else { panic!("the image is not embedded") };
    assert_eq!((&blob[view.offset()..][..view.length()], mime_type), (TEXTURE, "image/png"));
    let enamel = document.materials().next().expect("a material");
    let texture = enamel.pbr_metallic_roughness().base_color_texture().expect("a texture");
    assert_eq!(texture.texture_transform().expect("a transform").scale(), [2.0, 2.0]);
    let text = fs::read(folder.path().join("out.glb")).expect("a model");
    assert!(String::from_utf8_lossy(&text).contains("VENDOR_glitter"));

    // The prop lies where it lay: the large square on the far side, and textures on their place.
    let large = document.nodes().nth(1).and_then(|node| node.mesh()).expect("a mesh");
    let paint = large.primitives().next().expect("paint");
    let (translation, ..) = document.nodes().nth(1).expect("a node").transform().decomposed();
    let reader = paint.reader(|_| Some(&blob));
    let uvs = reader.read_tex_coords(0).expect("texture coordinates").into_f32();
    for (p, [u, v]) in reader.read_positions().expect("positions").zip(uvs) {
        let p = [p[0] + translation[0], p[1] + translation[1]];
        assert!(p[0] < -4.5 && p[0] > -8.5, "{p:?}");
        // The film bends, but not by half of the plate.
        assert!((-5.0 - 3.0 * u - p[0]).abs() < 0.5 && (3.0 * (1.0 - v) - p[1]).abs() < 0.5, "{p:?} has {u} {v}");
    }
}

/// Rounding far from the scene's origin once broke the rule that nothing lies below its plane.
#[test]
fn props_far_from_the_origin_age_like_near_ones() {
    let folder = folder();
    write_two_squares(folder.path());
    let text = fs::read_to_string(folder.path().join("two.gltf")).expect("a model");
    fs::write(folder.path().join("far.gltf"), text.replace("-5.0", "70000.0")).expect("a file");
    let run = |input: &str| stats(folder.path(), &[&[input, "--triangles", "600"], &QUICK[..]].concat());
    assert_eq!(run("two.gltf")["digest"], run("far.gltf")["digest"]);
}

#[test]
fn a_fresh_model_has_neither_primer_nor_metal() {
    let folder = folder();
    baked(folder.path(), &["plate:200", "--age", "0", "--out", "fresh.glb"]);
    let (document, blob) = read_back(&folder.path().join("fresh.glb"));
    assert_eq!(check_model(&document, &blob), [("paint".to_owned(), 200)]);
}

/// Every model of the project's data, if it is there.
#[test]
fn real_models_age_and_open_elsewhere() {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data");
    let Ok(entries) = fs::read_dir(&data) else {
        eprintln!("skipped: {} is not there", data.display());
        return;
    };
    let folder = folder();
    for entry in entries {
        let path = entry.expect("a file").path();
        if !path.extension().is_some_and(|ending| ending == "glb" || ending == "obj") {
            continue;
        }
        let input = path.to_str().expect("a name");
        for triangles in ["keep", "1500"] {
            let arguments = [input, "--triangles", triangles, "--out", "out.glb", "--steps", "25"];
            let stats = stats(folder.path(), &[&arguments[..], &["--set", "deform.sweeps_per_age=100"]].concat());
            let last = stats["timeline"].as_array().and_then(|t| t.last()).expect("an entry").clone();
            assert!(number(&last["separated"]) > 0.3, "{input} {triangles}: {last}");
            let (document, blob) = read_back(&folder.path().join("out.glb"));
            assert!(check_model(&document, &blob).len() >= 2, "{input} {triangles}");
        }
    }
}
