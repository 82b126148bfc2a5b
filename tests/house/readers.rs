//! What reads data from outside denies what panics on it.

use crate::{Source, assert_none, read, sources};

/// Rooms and files that read data from outside, besides all files `saved.rs`.
const READERS: [&str; 14] = [
    "bake/glb/mod.rs",
    "bake/gltf/mod.rs",
    "bake/images.rs",
    "bake/media.rs",
    "bake/obj/mod.rs",
    "bake/textures/texture.rs",
    "coding/mod.rs",
    "extras/mod.rs",
    "files/mod.rs",
    "history/mod.rs",
    "masks/mod.rs",
    "mesh_reader.rs",
    "settings/mod.rs",
    "snapshot/mod.rs",
];

const LINTS: [&str; 3] = ["clippy::indexing_slicing", "clippy::cast_possible_truncation", "clippy::cast_sign_loss"];

/// Returns whether a file denies the lints, but in tests, for itself and the modules in it.
fn denies(source: &str) -> bool {
    let attribute =
        source.split_once("#![cfg_attr(\n    not(test),\n    deny(").and_then(|(_, rest)| rest.split_once(')'));
    attribute.is_some_and(|(lints, _)| LINTS.iter().all(|lint| lints.contains(lint)))
}

#[test]
fn what_reads_from_outside_denies_indexing_and_casts() {
    let files = sources("src");
    let is_reader = |file: &str| READERS.contains(&file) || file.ends_with("/saved.rs");
    let of = |wanted: bool| files.iter().filter(move |(file, _)| is_reader(file) == wanted);
    let names = |found: Vec<&Source>| found.into_iter().map(|(file, _)| format!("src/{file}")).collect::<Vec<_>>();
    let open = of(true).filter(|(_, source)| !denies(source)).collect();
    assert_none(&names(open), "what reads from outside denies what panics on it");
    let more = of(false).filter(|(_, source)| denies(source)).collect();
    assert_none(&names(more), "what denies the lints of readers is on their list");
    assert!(of(true).count() > READERS.len() + 10, "the readers were found");
    let page = read("docs/bad_input.md");
    let is_named = |file: &&str| page.contains(&format!("`{}`", file.trim_end_matches("/mod.rs")));
    let missing: Vec<String> = READERS.iter().filter(|file| !is_named(file)).map(|file| (*file).into()).collect();
    assert_none(&missing, "docs/bad_input.md names what reads from outside");
}
