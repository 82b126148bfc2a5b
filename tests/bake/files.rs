//! Files as people bring them: materials, textures, names and marks of other programs.

use std::{fs, path::Path};

use bevy_coating::bake::{Images, Input, Model};
use serde_json::{Value, json};

use crate::tool::{baked, folder, grey_png, json_of, stats, write_two_squares};

fn read(path: &Path) -> Model {
    Input::File(path.into()).read(0, Images::Load).expect("a model")
}

fn area(model: &Model) -> f64 {
    let surface = &model.meshes[0].surface;
    let corner = |v: u32| surface.positions[v as usize].as_dvec3();
    let twice = |&[a, b, c]: &[u32; 3]| (corner(b) - corner(a)).cross(corner(c) - corner(a)).length();
    surface.triangles.iter().map(twice).sum::<f64>() / 2.0
}

/// An arrow with a notch on each side of its shaft, as one face of nine corners, and the same behind it: cut like a
/// convex face it once had 1.6 times its area.
#[test]
fn concave_faces_keep_their_area() {
    let folder = folder();
    let outline = [[0., 0.], [2., 0.], [2., 9.], [5., 6.], [5., 9.], [1., 13.], [-3., 9.], [-3., 6.], [0., 9.0f64]];
    let side = |z: f64| outline.map(|[x, y]| format!("v {} {} {z}\n", x / 10.0, y / 10.0)).concat();
    let mut text = format!("{}{}f 1 2 3 4 5 6 7 8 9\nf 18 17 16 15 14 13 12 11 10\n", side(0.0), side(-0.04));
    let mut around = 0.0;
    for i in 0..9 {
        let ([x, y], [to_x, to_y]) = (outline[i], outline[(i + 1) % 9]);
        around += (to_x - x).hypot(to_y - y) / 10.0;
        text += &format!("f {} {} {} {}\n", i + 1, i + 10, (i + 1) % 9 + 10, (i + 1) % 9 + 1);
    }
    let path = folder.path().join("arrow.obj");
    fs::write(&path, text).expect("a file");
    let expected = 2.0 * 0.43 + 0.04 * around;
    assert!((area(&read(&path)) - expected).abs() < 1e-5, "{} {expected}", area(&read(&path)));
}

/// Three squares of three materials.
fn write_squares_of_three_materials(folder: &Path, library: &str) {
    let mut text = String::from("mtllib my colours.mtl\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n");
    for (i, material) in ["metalRed", "metal Dark", "wood"].into_iter().enumerate() {
        let (x, first) = (2 * i, 4 * i + 1);
        text += &format!("o part {i}\nv {x} 0 0\nv {} 0 0\nv {} 1 0\nv {x} 1 0\nusemtl {material}\n", x + 1, x + 1);
        text += &format!("f {first}/1 {}/2 {}/3 {}/4\n", first + 1, first + 2, first + 3);
    }
    fs::write(folder.join("three.obj"), text).expect("a file");
    fs::write(folder.join("my colours.mtl"), library).expect("a file");
}

#[test]
fn materials_of_an_obj_come_along() {
    let folder = folder();
    let library = "\u{feff}newmtl metalRed\r\nKd 1 0 0\r\n\r\nnewmtl metal Dark\r\nKd 0.12 0.12 0.14\r\nNs 250\r\n\r\n\
                   newmtl wood\r\nKd 0.8 0.8 0.8\r\nmap_Kd ..\\maps\\wood.png\r\n";
    fs::create_dir(folder.path().join("maps")).expect("a folder");
    fs::create_dir(folder.path().join("models")).expect("a folder");
    fs::write(folder.path().join("maps/wood.png"), grey_png()).expect("a file");
    write_squares_of_three_materials(&folder.path().join("models"), library);
    let arguments = ["models/three.obj", "--triangles", "300", "--age", "0", "--out", "out.glb"];
    let output = baked(folder.path(), &[&arguments[..], &["--no-stains"]].concat());
    assert!(output.stderr.is_empty(), "{}", String::from_utf8_lossy(&output.stderr));
    let document = json_of(&folder.path().join("out.glb"));
    let names: Vec<&Value> = document["materials"].as_array().expect("materials").iter().map(|m| &m["name"]).collect();
    assert_eq!(names, ["metalRed", "metal Dark", "wood"]);
    let factor = |i: usize| &document["materials"][i]["pbrMetallicRoughness"]["baseColorFactor"];
    assert_eq!(*factor(0), json!([1.0, 0.0, 0.0, 1.0]));
    // sRGB, as most programs show it.
    assert!((factor(1)[0].as_f64().expect("a number") - 0.0135).abs() < 1e-4, "{}", factor(1));
    assert_eq!(*factor(2), json!([1.0, 1.0, 1.0, 1.0]));
    assert_eq!(document["materials"][2]["pbrMetallicRoughness"]["baseColorTexture"]["index"], 0);
    assert_eq!(document["images"].as_array().map(Vec::len), Some(1));

    // With stains, each square has a texture of its own material.
    let output = baked(folder.path(), &[&arguments[..], &["--texture-size", "64"]].concat());
    assert!(output.stderr.is_empty(), "{}", String::from_utf8_lossy(&output.stderr));
    let document = json_of(&folder.path().join("out.glb"));
    let names: Vec<&Value> = document["materials"].as_array().expect("materials").iter().map(|m| &m["name"]).collect();
    assert_eq!(names, ["metalRed", "metal Dark", "wood"]);
}

#[test]
fn a_missing_material_file_is_one_warning() {
    let folder = folder();
    write_squares_of_three_materials(folder.path(), "");
    fs::remove_file(folder.path().join("my colours.mtl")).expect("a file");
    fs::write(folder.path().join("three.obj"), {
        let text = fs::read_to_string(folder.path().join("three.obj")).expect("a file");
        text.replace("my colours.mtl", "gone.mtl")
    })
    .expect("a file");
    let output = baked(folder.path(), &["three.obj", "--age", "0", "--out", "out.glb", "--texture-size", "64"]);
    let text = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(text.lines().count() == 1 && text.starts_with("warning: gone.mtl: cannot be read: "), "{text}");
    assert_eq!(json_of(&folder.path().join("out.glb"))["materials"].as_array().map(Vec::len), Some(3));
}

/// The layout of packs: models/two.gltf and textures/. Refused once, because of `..`.
#[test]
fn textures_beside_the_folder_are_read_and_not_always_needed() {
    let folder = folder();
    let (models, textures) = (folder.path().join("models"), folder.path().join("textures"));
    [&models, &textures].into_iter().for_each(|folder| fs::create_dir(folder).expect("a folder"));
    write_two_squares(&models);
    fs::remove_file(models.join("a texture.png")).expect("a file");
    fs::write(textures.join("shared.png"), grey_png()).expect("a file");
    let text = fs::read_to_string(models.join("two.gltf")).expect("a model");
    fs::write(models.join("two.gltf"), text.replace("a%20texture.png", "../textures/shared.png")).expect("a file");
    let quick = ["models/two.gltf", "--triangles", "200", "--age", "0"];
    let run = |more: &[&str]| {
        let output = baked(folder.path(), &[&quick[..], more].concat());
        String::from_utf8_lossy(&output.stderr).into_owned()
    };
    assert_eq!(run(&["--out", "out.glb", "--texture-size", "64"]), "");
    assert_eq!(run(&["--out", "out.glb", "--no-stains"]), "");
    assert!(json_of(&folder.path().join("out.glb"))["images"][0]["bufferView"].is_number());

    fs::remove_file(textures.join("shared.png")).expect("a file");
    assert_eq!(run(&["--stats", "stats.json"]), "");
    let warning = run(&["--out", "out.glb", "--no-stains"]);
    assert!(warning.lines().count() == 1 && warning.contains("shared.png"), "{warning}");
    // What cannot be read stays where it is.
    assert_eq!(json_of(&folder.path().join("out.glb"))["images"][0]["uri"], "../textures/shared.png");
}

#[test]
fn wrongly_declared_images_are_read() {
    let folder = folder();
    write_two_squares(folder.path());
    let text = fs::read_to_string(folder.path().join("two.gltf")).expect("a model");
    let mut document: Value = serde_json::from_str(&text).expect("JSON");
    fs::write(folder.path().join("a texture.png"), grey_png()).expect("a file");
    for declared in ["image/jpg", "image/jpeg", "png"] {
        document["images"][0]["mimeType"] = declared.into();
        fs::write(folder.path().join("two.gltf"), document.to_string()).expect("a file");
        let arguments = ["two.gltf", "--triangles", "200", "--age", "0", "--out", "out.glb", "--texture-size", "64"];
        let output = baked(folder.path(), &arguments);
        assert!(output.stderr.is_empty(), "{declared}: {}", String::from_utf8_lossy(&output.stderr));
        baked(folder.path(), &[&arguments[..7], &["--no-stains"]].concat());
        assert_eq!(json_of(&folder.path().join("out.glb"))["images"][0]["mimeType"], "image/png", "{declared}");
    }
}

/// Three bytes that editors of another system put before a text.
#[test]
fn byte_order_marks_are_skipped() {
    let folder = folder();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).expect("a file");
    write("marked.obj", "\u{feff}v 0 0 0\r\nv 1 0 0\r\nv 1 1 0\r\nv 0 1 0\r\nf 1 2 3 4\r\n");
    write("marked.ron", "\u{feff}(\r\n    tearing: (alpha: 0.6),\r\n)\r\n");
    write_two_squares(folder.path());
    let text = fs::read_to_string(folder.path().join("two.gltf")).expect("a model");
    write("two.gltf", &format!("\u{feff}{text}"));
    for (input, triangles) in [("marked.obj", 2), ("two.gltf", 4)] {
        let stats = stats(folder.path(), &[input, "--triangles", "100", "--age", "0", "--preset", "marked.ron"]);
        assert_eq!(stats["input"]["triangles"], triangles, "{input}");
    }
}

/// A line break in a name would tear a line of the output in two, an escape code colour what follows.
#[test]
fn odd_names_are_escaped_in_the_terminal() {
    let folder = folder();
    write_two_squares(folder.path());
    let text = fs::read_to_string(folder.path().join("two.gltf")).expect("a model");
    let odd = "small\\nline two \\u001b[31mred\\u202e";
    fs::write(folder.path().join("two.gltf"), text.replace("small", odd)).expect("a file");
    let bare = |bytes: &[u8]| {
        let text = String::from_utf8(bytes.to_vec()).expect("text");
        assert!(text.chars().all(|c| c == '\n' || !c.is_control() && c != '\u{202e}'), "{text:?}");
        text
    };
    // Its texture is no image, and one warning says so for each mesh.
    let output = baked(folder.path(), &["two.gltf", "--triangles", "100", "--age", "0", "--out", "out.glb"]);
    let warnings = bare(&output.stderr);
    assert!(warnings.lines().next().is_some_and(|line| line.contains("small\\nline two \\u{1b}[31mred")), "{warnings}");
    assert!(warnings.lines().all(|line| line.starts_with("warning: ")), "{warnings}");

    let broken = "broken\u{1b}[31m\nname.obj";
    if cfg!(unix) {
        fs::write(folder.path().join(broken), "f 1 2 3").expect("a file");
        let output = crate::tool::bake(folder.path(), &[broken]);
        assert!(bare(&output.stderr).starts_with("bake: broken\\u{1b}[31m"), "{}", bare(&output.stderr));
    }
}
