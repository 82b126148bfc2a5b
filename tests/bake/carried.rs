//! What ageing does not change is carried over, and what must change is named.

use std::{fs, path::Path};

use bevy_coating::{
    bake::{BakeOptions, BakeWarning, Images, Input, Model, StainOutput, Stopwatch, bake},
    remesh::FilmResolution,
    settings::CoatingSettings,
};
use serde_json::{Value, json};

use crate::{
    build::Builder,
    strict::{Glb, index},
};

/// Quick options: some cracks, no beauty.
pub fn quick(age: f64) -> BakeOptions {
    let mut settings = CoatingSettings::default();
    settings.deform.sweeps_per_age = 100.0;
    BakeOptions { age, steps: 40, resolution: FilmResolution::Triangles(600), settings, ..BakeOptions::default() }
}

/// Ages a model; gives the strictly checked file and the warnings.
pub fn aged(model: Model, options: &BakeOptions, stains: StainOutput) -> (Glb, Vec<BakeWarning>) {
    let mut baked = bake(model, options, Stopwatch::start(), &()).expect("it ages");
    let bytes = baked.glb(stains).expect("it is written");
    (Glb::checked(&bytes), baked.warnings)
}

pub fn data(name: &str) -> Model {
    let path = Path::new("tests/bake/data").join(name);
    Input::File(path).read(0, Images::Load).expect("a model")
}

pub fn built(builder: &Builder) -> Model {
    Model::from_gltf(&builder.glb(), None, Images::Load).expect("a model")
}

pub const SMALL: StainOutput = StainOutput::Textures(64);
pub const ALL: [StainOutput; 3] = [SMALL, StainOutput::VertexColors, StainOutput::None];

/// Corners of everything that a file draws in its default scene, with the node and the name of the material.
pub fn drawn(glb: &Glb) -> Vec<(usize, String, [[f64; 3]; 3])> {
    let mut drawn = Vec::new();
    let scene = index(&glb.root["scene"]).unwrap_or(0);
    let roots = glb.list("scenes")[scene]["nodes"].as_array().cloned().unwrap_or_default();
    let (document, blob) = {
        let bytes = to_bytes(glb);
        let gltf::Gltf { document, blob } = gltf::Gltf::from_slice_without_validation(&bytes).expect("a model");
        (document, blob.expect("bytes"))
    };
    let mut walk: Vec<(gltf::Node, [[f64; 4]; 4])> =
        roots.iter().filter_map(index).filter_map(|i| Some((document.nodes().nth(i)?, identity()))).collect();
    while let Some((node, parent)) = walk.pop() {
        let own = node.transform().matrix().map(|column| column.map(f64::from));
        let matrix = times(&parent, &own);
        walk.extend(node.children().map(|child| (child, matrix)));
        for primitive in node.mesh().into_iter().flat_map(|mesh| mesh.primitives().collect::<Vec<_>>()) {
            if primitive.mode() != gltf::mesh::Mode::Triangles {
                continue;
            }
            let reader = primitive.reader(|_| Some(&blob));
            let positions: Vec<[f64; 3]> =
                reader.read_positions().expect("positions").map(|p| point(&matrix, p.map(f64::from))).collect();
            let indices: Vec<u32> = match reader.read_indices() {
                Some(indices) => indices.into_u32().collect(),
                None => (0..positions.len() as u32).collect(),
            };
            let name = primitive.material().name().unwrap_or("").to_owned();
            for t in indices.as_chunks::<3>().0 {
                drawn.push((node.index(), name.clone(), t.map(|v| positions[v as usize])));
            }
        }
    }
    drawn
}

fn to_bytes(glb: &Glb) -> Vec<u8> {
    crate::build::assemble(&glb.root, &glb.binary)
}

fn identity() -> [[f64; 4]; 4] {
    std::array::from_fn(|i| std::array::from_fn(|k| f64::from(u8::from(i == k))))
}

fn times(a: &[[f64; 4]; 4], b: &[[f64; 4]; 4]) -> [[f64; 4]; 4] {
    std::array::from_fn(|column| std::array::from_fn(|row| (0..4).map(|k| a[k][row] * b[column][k]).sum()))
}

fn point(m: &[[f64; 4]; 4], p: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|row| m[0][row] * p[0] + m[1][row] * p[1] + m[2][row] * p[2] + m[3][row])
}

fn bounds(corners: impl Iterator<Item = [f64; 3]>) -> [[f64; 3]; 2] {
    let none = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    corners.fold(none, |[low, high], p| {
        [std::array::from_fn(|k| low[k].min(p[k])), std::array::from_fn(|k| high[k].max(p[k]))]
    })
}

/// A file as it was before it aged.
pub fn input(name: &str) -> Glb {
    let path = Path::new("tests/bake/data").join(name);
    Glb::new(&fs::read(path).expect("a file"))
}

fn input_root(name: &str) -> Value {
    input(name).root
}

#[test]
fn author_licence_extras_and_sockets_are_kept() {
    let own = input_root("metadata.glb");
    let fresh = input("metadata.glb");
    for stains in ALL {
        let (glb, warnings) = aged(data("metadata.glb"), &quick(0.6), stains);
        assert!(warnings.is_empty(), "{warnings:?}");
        assert_eq!(glb.root["asset"]["extras"], own["asset"]["extras"]);
        let generator = glb.root["asset"]["generator"].as_str().expect("a generator");
        assert!(generator.starts_with("bevy_coating") && generator.ends_with("Sketchfab-16.60.0"), "{generator}");
        assert_eq!(glb.root["nodes"], own["nodes"], "the tree is what it was, pivots and sockets included");
        assert_eq!(glb.root["scenes"], own["scenes"]);
        assert_eq!(
            (&glb.root["meshes"][0]["name"], &glb.root["meshes"][0]["extras"]["lod"]),
            (&json!("Object_0"), &json!(0))
        );
        let paint = &glb.list("materials")[0];
        assert_eq!((&paint["name"], &paint["extras"]), (&json!("Mailbox_Mat"), &json!({ "surface": "metal" })));
        // It is as large in the scene as it was, but for flakes that stand off.
        let size = |glb: &Glb| bounds(drawn(glb).into_iter().flat_map(|(_, _, corners)| corners));
        let (was, is) = (size(&fresh), size(&glb));
        assert!((0..6).all(|i| (was[i / 3][i % 3] - is[i / 3][i % 3]).abs() < 0.05), "{was:?} {is:?}");
    }
}

/// Every part of a document that ageing has nothing to do with.
#[test]
fn animations_cameras_lights_and_all_that_nobody_knows_are_kept() {
    let mut builder = Builder::new();
    let plate = builder.plate(4, &["NORMAL", "TEXCOORD_0"]);
    let times = builder.accessor(&[0.0f32, 1.0], 1);
    let turns = builder.accessor(&[0.0f32, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0], 4);
    let spare = builder.view(b"spare bytes that only an extension knows");
    builder.root = json!({
        "asset": { "version": "2.0", "copyright": "us", "minVersion": "2.0" },
        "extensionsUsed": ["KHR_lights_punctual", "VENDOR_sound", "KHR_node_visibility"],
        "extensions": {
            "KHR_lights_punctual": { "lights": [{ "type": "point", "name": "lamp" }] },
            "VENDOR_sound": { "clip": { "bufferView": spare } }
        },
        "extras": { "level": 3 },
        "scene": 1,
        "scenes": [{ "name": "other", "nodes": [5] }, { "name": "shown", "nodes": [0], "extras": { "sky": "blue" } }],
        "nodes": [
            { "name": "root", "children": [1, 2, 3], "scale": [2.0, 2.0, 2.0] },
            { "name": "door", "mesh": 0, "rotation": [0.0, 0.0, 0.0, 1.0], "translation": [1.0, 0.0, 0.0],
              "extras": { "hinge": "left" }, "children": [4],
              "extensions": { "KHR_node_visibility": { "visible": true } } },
            { "name": "eye", "camera": 0 },
            { "name": "lamp", "extensions": { "KHR_lights_punctual": { "light": 0 } } },
            { "name": "handle" },
            { "name": "spare door", "mesh": 0 }
        ],
        "cameras": [{ "type": "perspective", "perspective": { "yfov": 1.0, "znear": 0.1 } }],
        "animations": [{
            "name": "opens",
            "channels": [{ "sampler": 0, "target": { "node": 1, "path": "rotation" } }],
            "samplers": [{ "input": times, "output": turns }]
        }],
        "meshes": [{ "name": "leaf", "primitives": [plate] }],
        "materials": [{ "name": "paint" }, { "name": "nobody wears it", "extras": { "old": true } }],
        "samplers": [{ "name": "sharp", "magFilter": 9728 }]
    });
    for stains in ALL {
        let (glb, warnings) = aged(built(&builder), &quick(0.6), stains);
        assert_eq!(warnings, [BakeWarning::OutsideScene { count: 1 }]);
        for key in ["extensions", "extras", "scene", "scenes", "cameras", "animations", "extensionsUsed"] {
            assert_eq!(glb.root[key], builder.root[key], "{key}");
        }
        for (i, node) in glb.list("nodes").iter().enumerate() {
            let mut own = builder.root["nodes"][i].clone();
            if i == 1 {
                own["mesh"] = node["mesh"].clone();
            }
            assert_eq!(*node, own, "node {i}");
        }
        assert_ne!(glb.root["nodes"][1]["mesh"], 0, "the other scene still has the fresh mesh");
        assert_eq!(glb.root["meshes"][0], builder.root["meshes"][0]);
        assert_eq!(glb.root["materials"][1], builder.root["materials"][1]);
        assert_eq!(glb.root["samplers"][0], builder.root["samplers"][0]);
        assert_eq!(glb.floats(turns)[1], [0.0, 0.0, 1.0, 0.0]);
        assert_eq!(glb.floats(times), [[0.0], [1.0]]);
        let view = &glb.list("bufferViews")[spare];
        let start = view["byteOffset"].as_u64().unwrap_or(0) as usize;
        assert!(glb.binary[start..].starts_with(b"spare bytes that only an extension knows"));
        assert_eq!(glb.root["asset"]["copyright"], "us");
    }
}

/// A fresh film lies exactly on the prop, whatever its node does with it: the aged mesh is in the node's own space.
#[test]
fn films_lie_in_the_space_of_their_nodes() {
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let turned =
        json!({ "rotation": [0.0, half, 0.0, half], "scale": [0.01, 0.02, 0.05], "translation": [3.0, -2.0, 1.0] });
    let sheared = json!({ "matrix": [1.0, 0.3, 0.0, 0.0, 0.2, 1.5, 0.0, 0.0, 0.0, 0.4, 0.7, 0.0, 5.0, 0.0, 0.0, 1.0] });
    let mirrored = json!({ "scale": [-3.0, 1.0, 1.0] });
    let far = json!({ "translation": [-70_000.0, 0.0, 0.0] });
    let flat = json!({ "scale": [1.0, 1.0, 0.0] });
    for (name, mut node) in
        [("turned", turned), ("sheared", sheared), ("mirrored", mirrored), ("far", far), ("flat", flat)]
    {
        let mut builder = Builder::new();
        let shift = if name == "far" { 70_000.0 } else { 0.0 };
        let plate = builder.plate_at(6, &["NORMAL", "TANGENT", "TEXCOORD_0"], [shift, 0.0, 0.0]);
        node["mesh"] = 0.into();
        node["name"] = name.into();
        builder.root = json!({
            "asset": { "version": "2.0" },
            "scene": 0,
            "scenes": [{ "nodes": [0] }],
            "nodes": [node],
            "meshes": [{ "primitives": [plate] }],
            "materials": [{ "name": "paint" }]
        });
        let own = Glb::new(&builder.glb());
        let [low, high] = bounds(drawn(&own).into_iter().flat_map(|(_, _, corners)| corners));
        let (glb, warnings) = aged(built(&builder), &quick(0.0), StainOutput::None);
        let all = drawn(&glb);
        assert!(all.len() > 100, "{name}");
        let [aged_low, aged_high] = bounds(all.iter().flat_map(|(_, _, corners)| *corners));
        let size = (0..3).map(|k| high[k] - low[k]).fold(0.0, f64::max);
        for k in 0..3 {
            let (low, high) = (aged_low[k] - low[k], aged_high[k] - high[k]);
            assert!(
                low.abs() < 2e-4 * size && high.abs() < 2e-4 * size,
                "{name}: {aged_low:?} {aged_high:?} {low} {high}"
            );
        }
        // Fronts are fronts: a plate that faces z does so on its node too, and mirrors turn triangles round.
        let facing = |glb: &Glb| -> [f64; 3] {
            drawn(glb).iter().fold([0.0; 3], |sum, (_, _, [a, b, c])| {
                let (e, f): ([f64; 3], [f64; 3]) =
                    (std::array::from_fn(|k| b[k] - a[k]), std::array::from_fn(|k| c[k] - a[k]));
                let cross = [e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0]];
                std::array::from_fn(|k| sum[k] + cross[k])
            })
        };
        let (was, is) = (facing(&own), facing(&glb));
        assert!((0..3).all(|k| (was[k] - is[k]).abs() < 1e-3 * size * size), "{name}: {was:?} {is:?}");
        let own_node = ["far", "flat"].contains(&name);
        assert_eq!(warnings.contains(&BakeWarning::OwnNode { mesh: name.into() }), own_node, "{name}: {warnings:?}");
        assert_eq!(glb.list("nodes").len(), if own_node { 2 } else { 1 });
        assert_eq!(glb.root["nodes"][0]["name"], name);
        let children = glb.root["nodes"][0]["children"].as_array().map_or(0, Vec::len);
        assert_eq!(children, usize::from(name == "far"), "what is far moves with its node");
    }
}

#[test]
fn each_instance_is_a_node_with_a_film() {
    let model = data("instanced_posts.glb");
    assert_eq!(model.meshes.len(), 8);
    let own: Vec<_> = model.meshes.iter().map(|mesh| mesh.origin).collect();
    let (glb, warnings) = aged(model, &quick(0.6), SMALL);
    assert_eq!(warnings, [BakeWarning::Instances { mesh: "posts".into(), count: 8, more: false }]);
    assert_eq!(glb.root["nodes"][0]["children"], json!([1, 2, 3, 4, 5, 6, 7, 8]));
    assert!(glb.root["extensionsUsed"].is_null() && glb.root["nodes"][0]["extensions"].is_null());
    for (i, origin) in own.iter().enumerate() {
        let corners = drawn(&glb).into_iter().filter(|(node, ..)| *node == i + 1).flat_map(|(_, _, corners)| corners);
        let [low, high] = bounds(corners);
        let middle =
            (0..3).map(|k| (low[k] + high[k]) / 2.0 - f64::from(origin[k])).fold(0.0f64, |a, b| a.max(b.abs()));
        assert!(middle < 0.1 && high[1] - low[1] > 0.5, "post {i}: {low:?} {high:?} {origin}");
    }
    let meshes: Vec<_> = (1..9).map(|i| index(&glb.root["nodes"][i]["mesh"])).collect();
    assert!((0..8).all(|i| (0..i).all(|k| meshes[i] != meshes[k])), "{meshes:?}");
}

#[test]
fn variants_are_kept_or_named() {
    let own = input_root("variants.glb");
    let (glb, warnings) = aged(data("variants.glb"), &quick(0.6), StainOutput::None);
    assert!(warnings.is_empty(), "{warnings:?}");
    let paint = &glb.root["meshes"][0]["primitives"][0];
    assert_eq!(paint["extensions"], own["meshes"][0]["primitives"][0]["extensions"]);
    assert_eq!(glb.root["materials"].as_array().map(|all| all[..3].to_vec()), own["materials"].as_array().cloned());
    assert_eq!(glb.root["extensions"], own["extensions"]);

    let (glb, warnings) = aged(data("variants.glb"), &quick(0.6), SMALL);
    assert_eq!(warnings, [BakeWarning::Variants { mesh: "locker".into() }]);
    assert_eq!(glb.root["extensions"], own["extensions"], "the names of the variants are kept");
    assert!(glb.root["meshes"][0]["primitives"][0]["extensions"].is_null());
}

#[test]
fn extensions_that_change_no_triangle_may_be_required() {
    let plate = |names: Value| {
        let mut builder = Builder::new();
        let plate = builder.plate(3, &["NORMAL"]);
        builder.root = json!({
            "asset": { "version": "2.0" }, "extensionsUsed": names, "extensionsRequired": names,
            "nodes": [{ "name": "x", "mesh": 0 }], "meshes": [{ "primitives": [plate] }], "materials": [{}]
        });
        builder
    };
    for name in [
        "KHR_animation_pointer",
        "KHR_lights_punctual",
        "KHR_node_visibility",
        "KHR_xmp_json_ld",
        "MSFT_texture_dds",
        "KHR_texture_transform",
        "VENDOR_materials_glitter",
    ] {
        let (glb, _) = aged(built(&plate(json!([name]))), &quick(0.3), SMALL);
        assert_eq!((&glb.root["extensionsRequired"], &glb.root["extensionsUsed"]), (&json!([name]), &json!([name])));
    }
    for (name, hint) in [
        ("KHR_draco_mesh_compression", "without mesh compression"),
        ("EXT_meshopt_compression", "without mesh compression"),
        ("VENDOR_shapes", "VENDOR_shapes, which is unknown and may change its meshes; export it without"),
    ] {
        let mut builder = plate(json!([name]));
        // The buffer of a compressed file need not be one that can be read.
        builder.root["buffers"] = json!([{ "byteLength": 1_000_000, "uri": "nowhere.bin" }]);
        let error =
            Model::from_gltf(builder.root.to_string().as_bytes(), None, Images::Load).expect_err(name).to_string();
        assert!(error.contains(name) && error.contains(hint), "{error}");
    }
}

#[test]
fn skins_and_morph_targets_go_with_a_warning_and_the_rest_of_them_stays() {
    let mut builder = Builder::new();
    let mut plate = builder.plate(4, &["NORMAL", "JOINTS_0", "WEIGHTS_0"]);
    plate["targets"] = json!([{ "POSITION": plate["attributes"]["POSITION"] }]);
    let times = builder.accessor(&[0.0f32, 1.0], 1);
    let weights = builder.accessor(&[0.0f32, 1.0], 1);
    let shift = builder.accessor(&[0.0f32, 0.0, 0.0, 1.0, 0.0, 0.0], 3);
    let sampler = |output: usize| json!({ "input": times, "output": output });
    builder.root = json!({
        "asset": { "version": "2.0" },
        "nodes": [{ "name": "flag", "mesh": 0, "skin": 0, "weights": [0.5] }, { "name": "joint" }],
        "meshes": [{ "primitives": [plate], "weights": [0.2] }],
        "skins": [{ "joints": [1] }],
        "materials": [{}],
        "animations": [
            {
                "channels": [{ "sampler": 0, "target": { "node": 0, "path": "weights" } }],
                "samplers": [sampler(weights)]
            },
            { "channels": [
                { "sampler": 0, "target": { "node": 0, "path": "weights" } },
                { "sampler": 1, "target": { "node": 1, "path": "translation" } }
            ], "samplers": [sampler(weights), sampler(shift)] }
        ]
    });
    let (glb, warnings) = aged(built(&builder), &quick(0.6), SMALL);
    let mesh = || "flag".to_owned();
    assert_eq!(warnings, [BakeWarning::Morphed { mesh: mesh() }, BakeWarning::Skinned { mesh: mesh() }]);
    let [animation] = glb.list("animations") else { panic!("one animation") };
    assert_eq!(animation["channels"], json!([{ "sampler": 1, "target": { "node": 1, "path": "translation" } }]));
    assert_eq!(glb.root["skins"], builder.root["skins"]);
    assert_eq!(glb.root["nodes"][0], json!({ "name": "flag", "mesh": 0 }));
}

/// A fresh film shows the prop's own texture at the middles of its triangles.
#[test]
fn a_colour_texture_on_a_third_set_of_coordinates_looks_right() {
    let model = data("third_uv_set.glb");
    let (own, uvs) = (model.materials.images[0].clone(), model.meshes[0].surface.uvs.clone());
    assert_eq!(model.meshes[0].slots[0].material, Some(1), "a material that uses the first coordinates");
    let places = model.meshes[0].surface.clone();
    let (glb, warnings) = aged(model, &quick(0.0), StainOutput::Textures(256));
    assert!(matches!(warnings[..], [BakeWarning::ExtraTextureCoordinates { .. }]), "{warnings:?}");
    let decode = |bytes: &[u8]| {
        let mut decoder = png::Decoder::new(std::io::Cursor::new(bytes));
        decoder.set_transformations(png::Transformations::EXPAND);
        let mut reader = decoder.read_info().expect("a PNG");
        let mut bytes = vec![0; reader.output_buffer_size().expect("a size")];
        let frame = reader.next_frame(&mut bytes).expect("texels");
        (frame.width as usize, frame.height as usize, frame.color_type.samples(), bytes)
    };
    let color = |(width, height, channels, bytes): &(usize, usize, usize, Vec<u8>), u: f64, v: f64| -> [f64; 3] {
        let (x, y) = ((u * *width as f64) as usize, (v * *height as f64) as usize);
        let at = (y.min(height - 1) * width + x.min(width - 1)) * channels;
        std::array::from_fn(|k| f64::from(bytes[at + k]))
    };
    let primitive = &glb.root["meshes"][0]["primitives"][0];
    let material = &glb.list("materials")[index(&primitive["material"]).expect("a material")];
    let texture = index(&material["pbrMetallicRoughness"]["baseColorTexture"]["index"]).expect("a texture");
    let baked = decode(glb.image(index(&glb.list("textures")[texture]["source"]).expect("an image")));
    let own = decode(&own.bytes);
    let attribute = |name: &str| glb.floats(index(&primitive["attributes"][name]).expect(name));
    let (positions, baked_uvs) = (attribute("POSITION"), attribute("TEXCOORD_0"));
    let (mut error, mut count) = (0.0, 0);
    for triangle in glb.triangles(primitive) {
        let middle = |of: &[Vec<f64>], k: usize| triangle.iter().map(|&v| of[v][k]).sum::<f64>() / 3.0;
        let p = [middle(&positions, 0), middle(&positions, 1)];
        // The place in the prop's own texture, from its own triangles. The square reaches from (-0.5, 0) to (0.5, 1).
        let place = places.triangles.iter().enumerate().find_map(|(t, corners)| {
            let c = corners.map(|v| places.positions[v as usize]);
            let q = bevy_math::Vec2::new(p[0] as f32, p[1] as f32 - 0.5);
            let cross = |a: bevy_math::Vec2, b: bevy_math::Vec2| a.perp_dot(b);
            let [a, b, c] = c.map(|c| c.truncate());
            let area = cross(b - a, c - a);
            let weights = [cross(b - q, c - q), cross(c - q, a - q), cross(a - q, b - q)].map(|w| w / area);
            let inside = weights.iter().all(|&w| w >= -1e-4);
            inside.then(|| (0..3).map(|k| uvs[t * 3 + k] * weights[k]).sum::<bevy_math::Vec2>())
        });
        let place = place.expect("a place");
        let (was, is) = (
            color(&own, f64::from(place.x).rem_euclid(1.0), f64::from(place.y).rem_euclid(1.0)),
            color(&baked, middle(&baked_uvs, 0), middle(&baked_uvs, 1)),
        );
        error += was.iter().zip(is).map(|(a, b)| (a - b).abs()).sum::<f64>() / 3.0;
        count += 1;
    }
    let mean = error / f64::from(count);
    assert!(mean < 4.0, "colours are {mean} of 255 off in the mean");
}

/// Every small case of the project's data, if it is there.
#[test]
fn cases_from_elsewhere_are_valid_once_aged() {
    let folder = Path::new("../shared/cases");
    let Ok(entries) = fs::read_dir(folder) else {
        eprintln!("skipped: {} is not there", folder.display());
        return;
    };
    let mut files: Vec<_> = entries.map(|entry| entry.expect("a file").path()).collect();
    files.sort();
    for file in files.iter().filter(|file| file.extension().is_some_and(|ending| ending == "glb")) {
        if fs::metadata(file).expect("a file").len() > 250_000 {
            continue;
        }
        for stains in [SMALL, StainOutput::None] {
            println!("{}", file.display());
            aged(Input::File(file.clone()).read(0, Images::Load).expect("a model"), &quick(0.6), stains);
        }
    }
}
