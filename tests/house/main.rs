//! The house in order: which file may import from which, and how text is written. Reads the sources as text, so that it
//! needs neither the engine nor the crate: `cargo core --test house`.

mod imports;
mod links;
mod parse;
mod readers;
mod readme;
mod rooms;
mod text;
mod tokens;

use std::{fs, path::PathBuf};

/// A file of the package: its path from the folder it was found in, with `/`, and its text.
type Source = (String, String);

/// Path of a file or folder of the package, from its root, where cargo runs tests. Not the path known when this was
/// compiled: clones that share a target folder share this program too.
fn path(of: &str) -> PathBuf {
    PathBuf::from(of)
}

fn read(file: &str) -> String {
    fs::read_to_string(path(file)).unwrap_or_else(|error| panic!("{file}: {error}"))
}

/// Every `.rs` file below a folder of the package, sorted by path.
fn sources(folder: &str) -> Vec<Source> {
    let root = path(folder);
    let (mut found, mut folders) = (Vec::new(), vec![root.clone()]);
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).expect("a folder") {
            let entry = entry.expect("an entry").path();
            if entry.is_dir() {
                folders.push(entry);
            } else if entry.extension().is_some_and(|ending| ending == "rs") {
                let name = entry.strip_prefix(&root).expect("below the root").to_string_lossy().replace('\\', "/");
                found.push((name, fs::read_to_string(&entry).expect("UTF-8")));
            }
        }
    }
    found.sort();
    found
}

/// Asserts that no rule was broken.
#[track_caller]
fn assert_none(broken: &[String], rule: &str) {
    assert!(broken.is_empty(), "{rule}:\n  {}", broken.join("\n  "));
}
