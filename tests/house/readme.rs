//! The README is short, and agrees with the crate's documentation and `Cargo.toml`.

use std::collections::BTreeSet;

use crate::{assert_none, read};

const MOST_LINES: usize = 150;

/// Features that are not for users.
const INNER_FEATURES: [&str; 2] = ["default", "bench"];

/// Value of the first `key = "value"` of a line of `Cargo.toml` that begins with `start`.
fn quoted<'a>(manifest: &'a str, start: &str) -> &'a str {
    let line = manifest.lines().find(|line| line.starts_with(start)).unwrap_or_else(|| panic!("no line {start}"));
    let mut parts = line[start.len()..].split('"');
    parts.nth(1).unwrap_or_else(|| panic!("no value in {line}"))
}

/// Names of the features in `Cargo.toml` that are for users.
fn features(manifest: &str) -> BTreeSet<&str> {
    let section = manifest.split("\n[").find_map(|section| section.strip_prefix("features]")).expect("features");
    let keys = section.lines().filter(|line| line.starts_with(|c: char| c.is_alphabetic()));
    keys.filter_map(|line| Some(line.split_once(" =")?.0)).filter(|key| !INNER_FEATURES.contains(key)).collect()
}

/// Cells of a row of a table, or none.
fn cells(line: &str) -> Vec<&str> {
    let line = line.trim_start_matches("//!").trim();
    let Some(row) = line.strip_prefix('|').and_then(|row| row.strip_suffix('|')) else { return Vec::new() };
    row.split('|').map(str::trim).collect()
}

/// Rows below the first table whose head has this cell; the head comes first.
fn table<'a>(text: &'a str, head: &str) -> Vec<Vec<&'a str>> {
    let rows = text.lines().map(cells).skip_while(|cells| !cells.contains(&head));
    let rows = rows.take_while(|cells| !cells.is_empty());
    rows.filter(|cells| !cells[0].starts_with(['-', ':'])).collect()
}

/// Names in the first column of the table of features; other words there are none.
fn listed_features(text: &str) -> BTreeSet<&str> {
    table(text, "feature").iter().filter_map(|row| row[0].strip_prefix('`')?.strip_suffix('`')).collect()
}

/// Returns whether a version in a table, the first word of its cell, covers that of `Cargo.toml`: `0.19` covers
/// `0.19.1`.
fn covers(cell: &str, version: &str) -> bool {
    let listed = cell.split(' ').next().unwrap_or_default().trim_matches('`');
    !listed.is_empty() && format!("{version}.").starts_with(&format!("{listed}."))
}

#[test]
fn the_readme_is_short() {
    let lines = read("README.md").lines().count();
    assert!(lines <= MOST_LINES, "README.md has {lines} lines, not at most {MOST_LINES}");
}

#[test]
fn the_readme_names_the_versions() {
    let (readme, manifest) = (read("README.md"), read("Cargo.toml"));
    let rows = table(&readme, "bevy_coating");
    let column = |name: &str| rows[0].iter().position(|cell| *cell == name).expect("a column");
    let newest = rows.get(1).expect("a row of versions");
    let own = quoted(&manifest, "version =");
    assert!(covers(newest[column("bevy_coating")], own), "{newest:?}: the package is {own}");
    let engine = quoted(&manifest, "bevy =");
    assert!(covers(newest[column("bevy")], engine), "{newest:?}: bevy is {engine}");
    assert_eq!(quoted(&manifest, "bevy_math ="), engine);
    // What a user is told to write, once it is on a registry.
    for line in readme.lines().filter(|line| line.starts_with("bevy_coating = \"")) {
        assert!(covers(quoted(line, "bevy_coating ="), own), "{line}: the package is {own}");
    }
}

#[test]
fn the_readme_and_the_documentation_list_all_features() {
    let manifest = read("Cargo.toml");
    let expected = features(&manifest);
    assert!(expected.contains("plugin"), "{expected:?}");
    let mut found = Vec::new();
    for file in ["README.md", "src/lib.rs"] {
        let text = read(file);
        let listed = listed_features(&text);
        if listed != expected {
            found.push(format!("{file} lists {listed:?}, Cargo.toml has {expected:?}"));
        }
    }
    assert_none(&found, "the tables of features are complete");
}

#[test]
fn tables_are_read() {
    let text =
        "//! | bevy | feature |\n//! |---|---|\n//! | `a` | b |\n//! | `c` | d |\n//! | none | |\n//!\n//! | e | f |";
    assert_eq!(table(text, "feature"), [["bevy", "feature"], ["`a`", "b"], ["`c`", "d"], ["none", ""]]);
    assert_eq!(listed_features(text), BTreeSet::from(["a", "c"]));
    assert!(
        covers("0.19 (or newer)", "0.19.1")
            && covers("0.1", "0.1.0")
            && !covers("0.1", "0.19.0")
            && !covers("", "0.1.0")
    );
    assert_eq!(
        features("[package]\na = 1\n[features]\nx = []\n# y = []\nz = [\n  \"x\",\n]\n[b]"),
        BTreeSet::from(["x", "z"])
    );
}

#[test]
fn every_kind_of_bad_input_has_a_test() {
    let (page, mut sources) = (read("docs/bad_input.md"), crate::sources("src"));
    sources.extend(crate::sources("tests"));
    let rows = table(&page, "test");
    let is_test = |name: &str| {
        let head = format!("fn {name}(");
        sources.iter().any(|(_, source)| source.contains(&head))
    };
    let unknown = |row: &Vec<&str>| {
        let mut names = row[2].split('`').skip(1).step_by(2);
        names.clone().next().is_none() || names.any(|name| name != "fuzz" && !is_test(name))
    };
    let found: Vec<String> = rows.iter().skip(1).filter(|row| unknown(row)).map(|row| row.join(" | ")).collect();
    assert_none(&found, "docs/bad_input.md names tests that there are, in each row");
    assert!(rows.len() > 20, "the table was not found");
}
