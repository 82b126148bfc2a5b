//! The bodies of the fuzz targets (`fuzz/`), on the files of their corpora and on random changes of them, so that they
//! are kept in order without a fuzzer.

#[path = "../fuzz/bodies/mod.rs"]
mod bodies;

use std::{fs, path::Path};

use proptest::{prelude::*, test_runner::TestRunner};

/// Runs `body` on all files of a corpus, on parts and changes of them, and on random bytes.
fn run(target: &str, most_cases: u32, body: fn(&[u8])) {
    let folder = Path::new("fuzz/corpus").join(target);
    let mut paths: Vec<_> =
        fs::read_dir(folder).expect("a corpus").map(|entry| entry.expect("an entry").path()).collect();
    paths.sort();
    assert!(!paths.is_empty(), "{target} has a corpus");
    let corpus: Vec<Vec<u8>> = paths.iter().map(|path| fs::read(path).expect("a file")).collect();
    corpus.iter().for_each(|bytes| body(bytes));
    let whole = prop::sample::select(corpus);
    let edits = prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..12);
    let changed =
        (whole, edits, any::<prop::sample::Index>(), any::<bool>()).prop_map(|(mut bytes, edits, end, cut)| {
            for (place, byte) in edits {
                if !bytes.is_empty() {
                    let place = place.index(bytes.len());
                    bytes[place] = byte;
                }
            }
            if cut && !bytes.is_empty() {
                bytes.truncate(end.index(bytes.len()));
            }
            bytes
        });
    let random = prop::collection::vec(any::<u8>(), 0..400);
    let config = ProptestConfig::default();
    let cases =
        config.cases.min(most_cases).max(if std::env::var_os("PROPTEST_CASES").is_some() { config.cases } else { 0 });
    let mut runner = TestRunner::new(ProptestConfig { cases, failure_persistence: None, ..config });
    let result = runner.run(&prop_oneof![3 => changed, 1 => random], |bytes| {
        body(&bytes);
        Ok(())
    });
    result.unwrap_or_else(|error| panic!("{target}: {error}"));
}

#[test]
fn film() {
    run("film", 256, bodies::film);
}

#[test]
fn settings() {
    run("settings", 256, bodies::settings);
}

#[test]
fn masks() {
    run("masks", 256, bodies::masks);
}

#[test]
fn extras() {
    run("extras", 256, bodies::extras);
}

#[test]
fn snapshot() {
    run("snapshot", 256, bodies::snapshot);
}

#[test]
fn recording() {
    run("recording", 256, bodies::recording);
}

#[test]
fn obj() {
    run("obj", 256, bodies::obj);
}

#[test]
fn gltf() {
    run("gltf", 256, bodies::gltf);
}

#[test]
fn journey() {
    run("journey", 128, bodies::journey);
}
