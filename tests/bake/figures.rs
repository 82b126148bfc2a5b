//! The program `coating-bake` from outside: exit codes, figures and files.

use std::{collections::BTreeSet, fs};

use serde_json::{Value, json};

use crate::tool::{QUICK, bake, baked, files, folder, keys, number, stats, write_two_squares};

#[test]
fn figures_have_their_layout_and_agree_with_each_other() {
    let folder = folder();
    let stats = stats(folder.path(), &[&["plate:800", "--age", "0.93", "--seed", "2"], &QUICK[..]].concat());
    assert_eq!(keys(&stats), ["digest", "film", "input", "ratings", "run", "schema", "seconds", "timeline"]);
    assert_eq!(stats["schema"], 1);
    assert_eq!(keys(&stats["input"]), ["triangles", "vertices"]);
    assert_eq!(stats["input"]["triangles"], 800);
    let film = &stats["film"];
    let expected = [
        "border_loops",
        "components",
        "edge_cv",
        "euler",
        "grain",
        "mean_edge",
        "min_angle_deg",
        "triangles",
        "vertices",
    ];
    assert_eq!(keys(film), expected);
    assert_eq!([&film["triangles"], &film["components"], &film["border_loops"], &film["euler"]], [800, 1, 1, 1]);
    assert!(number(&film["edge_cv"]) < 0.25 && number(&film["min_angle_deg"]) > 20.0, "{film}");
    let run = json!({
        "age": 0.93, "steps": 60, "seed": 2, "preset": "default", "sweeps_per_age": 300.0, "quality": "default"
    });
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
        "crack_spacing",
        "pieces",
        "loose_pieces",
        "strain_rms",
        "strain_max",
        "lift_p90",
        "lift_area_p50_m",
        "lift_area_p90_m",
        "lift_area_p99_m",
        "rust_emitted",
        "rust_wet",
        "rust_stained",
        "rust_dripped",
        "sources",
        "dust_mean",
        "moisture_mean",
    ];
    assert_eq!(names, expected.into_iter().collect());
    for name in ["straightness", "strain_rms", "strain_max", "lift_p90", "lift_area_p50_m", "lift_area_p90_m"] {
        assert_eq!(timeline[0][name], Value::Null, "{name} of a fresh film");
        assert!(timeline[19][name].is_number(), "{name} of an aged film");
    }
    let lifts = ["lift_area_p50_m", "lift_area_p90_m", "lift_area_p99_m"].map(|name| number(&timeline[19][name]));
    assert!(lifts.is_sorted() && lifts[2] > 0.0, "{lifts:?}");
    for name in ["separated", "torn", "stripped", "fallen", "crack_length"] {
        let grows = timeline.windows(2).all(|pair| number(&pair[0][name]) <= number(&pair[1][name]));
        assert!(grows && number(&timeline[0][name]) == 0.0, "{name} is cumulative");
    }
    assert!(number(&timeline[19]["separated"]) > 0.3, "{}", timeline[19]);
    for entry in timeline {
        let of = |name: &str| number(&entry[name]);
        let accounted = of("rust_wet") + of("rust_stained") + of("rust_dripped");
        assert!((of("rust_emitted") - accounted).abs() <= 1e-3 * accounted, "{entry}");
        assert!((0.0..=1.0).contains(&of("dust_mean")) && of("moisture_mean") == 0.0, "{entry}");
    }
    assert!(number(&timeline[19]["rust_stained"]) > 0.0 && number(&timeline[19]["sources"]) > 0.0, "{}", timeline[19]);
    let digest = stats["digest"].as_str().expect("text");
    assert!(digest.len() == 64 && digest.bytes().all(|c| c.is_ascii_hexdigit()), "{digest}");
}

#[test]
fn films_are_aged_until_a_rating_is_reached() {
    let folder = folder();
    let run = |arguments: &[&str]| {
        let all = [&["plate:400", "--preset", "heavy", "--stats", "stats.json"], arguments, &QUICK[..]].concat();
        let output = baked(folder.path(), &all);
        let stats: Value = serde_json::from_slice(&fs::read(folder.path().join("stats.json")).expect("figures"))
            .expect("figures are JSON");
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        (stats, text(&output.stdout), text(&output.stderr))
    };
    let (stats, said, warned) = run(&["--until", "ri3"]);
    let until = &stats["run"]["until"];
    assert_eq!([&until["goal"], &until["reached"]], [&json!("Ri3"), &json!(true)]);
    let age = number(&until["age"]);
    assert!(age > 0.05 && age < 10.0 && said.contains(&format!("reached Ri3 at age {age}")), "{said}");
    assert!(said.contains("rated Ri3") && warned.is_empty(), "{said}{warned}");
    let rated = stats["ratings"].as_array().expect("entries");
    assert_eq!(rated.len(), stats["timeline"].as_array().expect("entries").len());
    assert_eq!(number(&rated[rated.len() - 1]["age"]), age);
    let before: Vec<&Value> = rated.iter().rev().skip(1).map(|entry| &entry["ratings"]["rust"]).collect();
    assert!(before.iter().all(|rust| ["Ri0", "Ri1", "Ri2"].contains(&rust.as_str().expect("text"))), "{before:?}");
    // The same age asked for gives the same film.
    let (same, ..) = run(&["--age", &age.to_string()]);
    assert_eq!(same["digest"], stats["digest"]);
    assert_eq!(same["ratings"][rated.len() - 1], rated[rated.len() - 1]);

    let (stats, said, warned) = run(&["--until", "gone=99%", "--age", "0.3"]);
    assert_eq!(stats["run"]["until"], json!({ "goal": "gone=99%", "reached": false, "age": 0.3 }));
    assert!(!said.contains("reached") && warned.contains("gone=99% was not reached by age 0.3"), "{said}{warned}");
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
        &["plate:100", "--until", "Ri7"],
        &["plate:100", "--until", "gone=120%"],
        &["plate:100", "--until", ""],
        &["plate:100", "--steps", "0"],
        &["plate:100", "--steps", "-5"],
        &["plate:100", "--seed", "-1"],
        &["plate:100", "--triangles", "3"],
        &["plate:100", "--triangles", "all"],
        &["plate:100", "--triangles", "100", "--edge", "0.1"],
        &["plate:100", "--triangles", "100", "--max-triangles", "100"],
        &["plate:100", "--edge", "0.1", "--max-triangles", "100"],
        &["plate:100", "--max-triangles", "3"],
        &["plate:100", "--max-triangles", "-1"],
        &["plate:100", "--edge", "0"],
        &["plate:100", "--edge", "-0.1"],
        &["plate:100", "--edge", "NaN"],
        &["plate:100", "--edge", "1cm"],
        &["plate:100", "--metres-per-unit", "0"],
        &["plate:100", "--metres-per-unit", "20000"],
        &["plate:100", "--metres-per-unit", "inch"],
        &["plate:100", "--grain", "0"],
        &["plate:100", "--grain", "-1"],
        &["plate:100", "--grain", "wide"],
        &["plate:100", "--grain", "0.1", "--set", "scale.grain=0.1"],
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
fn films_follow_the_grain_and_say_so_where_they_cannot() {
    let folder = folder();
    write_two_squares(folder.path());
    // 1 and 9 square metres. Edges of 0.7 x 0.1 m: 4,713 triangles.
    let run = |options: &[&str]| {
        let output = baked(folder.path(), &[&["two.gltf", "--age", "0", "--stats", "stats.json"], options].concat());
        let stats: Value = serde_json::from_slice(&fs::read(folder.path().join("stats.json")).expect("figures"))
            .expect("figures are JSON");
        (stats["film"].clone(), String::from_utf8_lossy(&output.stderr).into_owned())
    };
    let by_grain = ["--grain", "0.1", "--set", "scale.rules=grain"];
    let (film, said) = run(&by_grain);
    assert!((0.063..0.077).contains(&number(&film["mean_edge"])), "{film}");
    assert_eq!(film["grain"], json!([0.1, 0.1]));
    assert!(!said.contains("grain"), "{said}");
    // By the paper's rules, films follow the grain too, but have none.
    let (paper, said) = run(&["--set", "scale.grain=0.1", "--set", "scale.rules=paper"]);
    assert_eq!((&paper["mean_edge"], &paper["grain"]), (&film["mean_edge"], &json!([])));
    assert!(!said.contains("grain"), "{said}");

    let (film, said) = run(&[&by_grain[..], &["--max-triangles", "1000"]].concat());
    assert!((900.0..1100.0).contains(&number(&film["triangles"])), "{film}");
    assert!(said.contains("raise `max_triangles`") && said.contains("the same for 1 more"), "{said}");
    let (film, said) = run(&[&by_grain[..], &["--triangles", "200"]].concat());
    assert!(number(&film["grain"][0]) > 0.11 && number(&film["grain"][1]) > 0.11, "{film}");
    assert!(!said.contains("grain"), "who asks for a number of triangles gets it without a word: {said}");
    let (film, said) = run(&[&by_grain[..], &["--edge", "0.15"]].concat());
    assert!((0.135..0.165).contains(&number(&film["mean_edge"])), "{film}");
    assert!(!said.contains("grain"), "{said}");
}

#[test]
fn numbers_may_be_negative_where_they_make_sense() {
    let folder = folder();
    let quick = ["plate:20", "--age", "0"];
    baked(folder.path(), &[&quick[..], &["--gravity", "-3,0.5,0"]].concat());
    baked(folder.path(), &[&quick[..], &["--gravity=0,-1e38,1e38"]].concat());
    let weather = ["--wind", "-0.5,0,2", "--gusts", "0.3", "--rain", "0,-0.6,-0.8", "--sun", "-0.1,-0.2,0"];
    baked(folder.path(), &[&quick[..], &weather[..]].concat());
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
                  mean_dihedral,rust_wet,rust_stained,source,past_source,dust,moisture,area,metal_wet,metal_stained,\
                  metal_dust,metal_moisture,metal_area,corrosion";
    assert_eq!(lines.next(), Some(header));
    let column = |name: &str| header.split(',').position(|column| column == name).expect("a column");
    let rows: Vec<Vec<&str>> = lines.map(|line| line.split(',').collect()).collect();
    let field = |row: &[&str], i: usize| row[i].parse::<f64>().expect("a number");
    let (mut originals, mut live, mut separated) = (0, 0, BTreeSet::new());
    for (i, row) in rows.iter().enumerate() {
        assert_eq!(row.len(), 28, "row {i}");
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
    // Stains add up to the figures.
    let value = |row: &[&str], name: &str| field(row, column(name));
    let mut sums = [0.0f64; 5];
    for row in &rows {
        let is_live = row[2] == "1";
        assert!(is_live || value(row, "area") == 0.0, "what is gone stands for no film: {row:?}");
        sums[0] += value(row, "area") * value(row, "rust_wet");
        sums[1] += value(row, "area") * value(row, "rust_stained");
        sums[2] += value(row, "source");
        sums[3] += if is_live { value(row, "dust") } else { 0.0 };
        assert!(value(row, "source") <= value(row, "past_source"));
        let metal = &row[column("metal_wet")..];
        if row[0] == row[1] {
            sums[0] += value(row, "metal_area") * value(row, "metal_wet");
            sums[1] += value(row, "metal_area") * value(row, "metal_stained");
            sums[4] += value(row, "corrosion");
        } else {
            assert!(metal.iter().all(|cell| cell.is_empty()), "duplicates have no metal: {row:?}");
        }
    }
    let last = stats["timeline"].as_array().and_then(|t| t.last()).expect("an entry").clone();
    let expected = ["rust_wet", "rust_stained", "sources"].map(|name| number(&last[name]));
    for (sum, expected) in sums.iter().zip(expected) {
        assert!((sum - expected).abs() <= 1e-5 * expected.max(1e-6), "{sums:?} {last}");
    }
    assert!((sums[3] / live as f64 - number(&last["dust_mean"])).abs() < 1e-6 && sums[4] > 0.0, "{sums:?} {last}");
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

/// A square roof a metre over a square floor of half its size.
#[test]
fn a_model_shelters_itself_from_rain() {
    let folder = folder();
    let square = |y: f32, half: f32| {
        [[-half, -half], [-half, half], [half, half], [half, -half]].map(|[x, z]| format!("v {x} {y} {z}\n")).concat()
    };
    let obj = format!("o floor\n{}f 1 2 3 4\no roof\n{}f 5 6 7 8\n", square(0.0, 0.5), square(1.0, 1.0));
    fs::write(folder.path().join("roof.obj"), obj).expect("a file");
    let arguments = ["roof.obj", "--triangles", "600", "--age", "0.5", "--rain", "0,-1,0", "--dump", "dump.csv"];
    let stats = stats(folder.path(), &[&arguments[..], &QUICK[..]].concat());
    let last = stats["timeline"].as_array().and_then(|t| t.last()).expect("an entry").clone();
    assert!(number(&last["moisture_mean"]) > 0.1, "{last}");
    let text = fs::read_to_string(folder.path().join("dump.csv")).expect("a dump");
    let rows: Vec<Vec<&str>> = text.lines().skip(1).map(|line| line.split(',').collect()).collect();
    let moisture = |low: f64, high: f64| -> Vec<f64> {
        let number = |row: &[&str], i: usize| row[i].parse::<f64>().expect("a number");
        let there = rows.iter().filter(|row| row[2] == "1" && (low..high).contains(&number(row, 4)));
        there.map(|row| number(row, 20)).collect()
    };
    let (floor, roof) = (moisture(-0.1, 0.5), moisture(0.5, 1.1));
    assert!(floor.len() > 20 && floor.iter().all(|&m| m == 0.0), "{floor:?}");
    assert!(roof.len() > 20 && roof.iter().all(|&m| m > 0.3), "{roof:?}");
}
