//! The `table1` example from outside: its table, its JSON and its exit codes.

use std::{
    fs,
    path::{Path, PathBuf},
    process::{Command, Output},
};

use serde_json::Value;

/// The example, which cargo builds before it runs tests: beside the folder of this test.
fn table1(folder: &Path, arguments: &[&str]) -> Output {
    let test = std::env::current_exe().expect("a path of the test");
    let profile = test.ancestors().nth(2).expect("a folder of the profile");
    let tool: PathBuf = profile.join("examples").join(format!("table1{}", std::env::consts::EXE_SUFFIX));
    assert!(tool.is_file(), "{} is missing: cargo build --example table1", tool.display());
    Command::new(tool).args(arguments).current_dir(folder).output().expect("the tool starts")
}

#[test]
fn the_table_has_its_rows_and_its_json_agrees() {
    let folder = tempfile::tempdir().expect("a folder");
    let arguments = ["plate:300", "curved:300", "--steps", "100", "--repeat", "2", "--json", "table.json"];
    let output = table1(folder.path(), &arguments);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8(output.stdout).expect("text");
    let json: Value =
        serde_json::from_slice(&fs::read(folder.path().join("table.json")).expect("a file")).expect("JSON");
    let rows = json["rows"].as_array().expect("rows");
    assert_eq!(rows.len(), 2);
    for (row, name) in rows.iter().zip(["plate:300", "curved:300"]) {
        let mut keys: Vec<&str> = row.as_object().expect("an object").keys().map(String::as_str).collect();
        keys.sort_unstable();
        let expected = [
            "lift_p90",
            "mean_active",
            "model",
            "paper_seconds",
            "seconds",
            "shares",
            "simd",
            "steps",
            "strain_rms",
            "sweeps_per_step",
            "triangles",
        ];
        assert_eq!(keys, expected);
        assert_eq!((&row["model"], &row["triangles"], &row["steps"]), (&name.into(), &300.into(), &100.into()));
        let number = |value: &Value| value.as_f64().expect("a number");
        let shares = row["shares"].as_object().expect("shares");
        assert_eq!(shares.len(), 5);
        let sum: f64 = ["fracture", "deformation", "mesh", "stains", "other"].map(|k| number(&shares[k])).iter().sum();
        assert!((sum - 1.0).abs() < 1e-6, "{row}");
        assert_eq!(number(&row["sweeps_per_step"]), 20.0);
        assert!((0.05..1.0).contains(&number(&row["mean_active"])), "{row}");
        assert!(number(&row["lift_p90"]) > 0.05 && number(&row["strain_rms"]) > 0.0, "{row}");
        assert!(row["paper_seconds"].is_null(), "the paper has no such model");
        let line = text.lines().find(|line| line.starts_with(name)).unwrap_or_else(|| panic!("{name} in {text}"));
        assert!(line.contains(&format!("{:.3}", number(&row["seconds"]))), "{line}");
    }
}

#[test]
fn the_papers_figures_stand_beside_its_models() {
    let folder = tempfile::tempdir().expect("a folder");
    let output = table1(folder.path(), &["plate:3012", "--json", "table.json"]);
    let text = String::from_utf8(output.stdout).expect("text");
    assert!(text.contains("paper: flat plate") && text.contains("15.4") && text.contains("times faster"), "{text}");
    let json: Value =
        serde_json::from_slice(&fs::read(folder.path().join("table.json")).expect("a file")).expect("JSON");
    assert_eq!(json["rows"][0]["paper_seconds"], 15.4);
    assert_eq!(json["rows"][0]["sweeps_per_step"], 2.0);
}

#[test]
fn bad_input_is_one_line_and_writes_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    for (arguments, code) in [
        (&["nothing.glb", "--json", "table.json"][..], 1),
        (&["plate:300", "--json", "missing/table.json"], 1),
        (&["plate:none"], 2),
        (&["--quality", "best"], 2),
        (&["--steps", "0"], 2),
    ] {
        let output = table1(folder.path(), arguments);
        let text = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(code), "{arguments:?}: {text}");
        assert!(!text.is_empty() && !text.contains("panicked"), "{text}");
        if code == 1 {
            assert_eq!(text.lines().count(), 1, "{text}");
        }
    }
    assert_eq!(fs::read_dir(folder.path()).expect("a folder").count(), 0);
}
