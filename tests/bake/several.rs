//! Several inputs in one command.

use std::{collections::BTreeSet, fs, path::Path};

use crate::tool::{QUICK, bake, baked, files, folder, write_two_squares};

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";

fn names(folder: &Path) -> BTreeSet<String> {
    files(folder).into_iter().collect()
}

/// So that a build farm may give each of its machines some of the inputs.
#[test]
fn each_input_comes_out_as_it_would_alone() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    fs::create_dir(at("props")).expect("a folder");
    write_two_squares(&at("props"));
    fs::write(at("props/square.OBJ"), SQUARE).expect("a file");
    fs::write(at("props/broken.obj"), "f 1 2 3\n").expect("a file");
    fs::write(at("props/notes.txt"), "no model").expect("a file");
    fs::create_dir(at("props/old.glb")).expect("a folder with the name of a model");
    let options = [&["--triangles", "200", "--age", "0.5", "--texture-size", "64"], &QUICK[..]].concat();
    let inputs = ["plate:60", "props", "--out-dir", "aged/models", "--stats-dir", "aged"];
    let output = bake(folder.path(), &[&inputs[..], &options[..]].concat());
    let (out, err) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert_eq!(output.status.code(), Some(1), "{err}");
    let failures: Vec<&str> = err.lines().filter(|line| line.starts_with("bake: ")).collect();
    assert!(failures.len() == 1 && failures[0].contains("broken.obj: line 1"), "{err}");
    assert!(err.lines().any(|line| line.starts_with("warning: props/two.gltf: ")), "{err}");
    assert!(out.ends_with("aged 3 of 4 models, 1 failed\n"), "{out}");
    let models = ["plate_60.glb", "square.glb", "two.glb"].map(str::to_owned);
    assert_eq!(names(&at("aged/models")), models.clone().into());
    let figures = ["models", "plate_60.json", "square.json", "two.json"].map(str::to_owned);
    assert_eq!(names(&at("aged")), figures.into());

    for (input, model) in ["plate:60", "props/square.OBJ", "props/two.gltf"].into_iter().zip(models) {
        baked(folder.path(), &[&[input, "--out", "alone.glb"], &options[..]].concat());
        let same = fs::read(at("alone.glb")).expect("a model") == fs::read(at("aged/models").join(model)).expect("one");
        assert!(same, "{input}");
    }
    let arguments = [&["props/two.gltf", "props/square.OBJ", "--out-dir", "again"], &options[..]].concat();
    let output = baked(folder.path(), &arguments);
    assert!(String::from_utf8_lossy(&output.stdout).ends_with("aged 2 models\n"));
}

#[test]
fn inputs_of_one_name_are_refused_before_anything_is_written() {
    let folder = folder();
    fs::create_dir(folder.path().join("sub")).expect("a folder");
    fs::write(folder.path().join("square.obj"), SQUARE).expect("a file");
    fs::write(folder.path().join("sub/SQUARE.obj"), SQUARE).expect("a file");
    let cases: &[&[&str]] = &[
        &["square.obj", "sub/SQUARE.obj", "--out-dir", "aged"],
        &["square.obj", "sub", "--stats-dir", "aged"],
        &["plate:60", "plate:60", "--out-dir", "aged"],
        &["square.obj", "plate:60"],
        &["square.obj", "plate:60", "--out", "aged.glb"],
        &["square.obj", "--out-dir", "aged", "--out", "aged.glb"],
        &["square.obj", "--out-dir", "aged", "--stats", "aged.json"],
        &["square.obj", "--stats-dir", "aged", "--dump", "aged.csv"],
    ];
    for case in cases {
        let output = bake(folder.path(), &[case, &["--age", "0"][..]].concat());
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{case:?}: {error}");
        assert_eq!(names(folder.path()), ["square.obj", "sub"].map(str::to_owned).into(), "{case:?}");
    }
}

#[test]
fn folders_without_models_or_without_a_place_are_bad_input() {
    let folder = folder();
    fs::create_dir(folder.path().join("empty")).expect("a folder");
    fs::write(folder.path().join("file"), "").expect("a file");
    fs::write(folder.path().join("square.obj"), SQUARE).expect("a file");
    let cases: &[&[&str]] = &[
        &["empty", "--out-dir", "aged"],
        &["empty"],
        &["square.obj", "--out-dir", "file/below"],
        &["square.obj", "--out-dir", "file"],
    ];
    for case in cases {
        let output = bake(folder.path(), &[case, &["--age", "0"][..]].concat());
        let error = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.code() == Some(1) && error.lines().count() == 1, "{case:?}: {error}");
        let named = if case[0] == "empty" { "empty" } else { "file" };
        assert!(error.contains(named), "{case:?}: {error}");
    }
}
