//! Snapshots as files and as serde data.

use std::fs;

use super::plate;
use crate::{
    settings::CoatingSettings,
    snapshot::{Snapshot, SnapshotError},
};

fn snapshot() -> Snapshot {
    Snapshot::of(&plate(100, &CoatingSettings::default(), 3, 100)).expect("a snapshot")
}

#[test]
fn files_are_whole_and_nothing_else_is_left() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("film.snapshot");
    fs::write(&path, b"an old file").expect("a file");
    let saved = snapshot();
    saved.write(&path).expect("a file");
    assert_eq!(Snapshot::read(&path).expect("a snapshot"), saved);
    assert_eq!(fs::read_dir(&folder).expect("a folder").count(), 1, "no temporary file stays behind");

    let nowhere = folder.path().join("missing/film.snapshot");
    let error = saved.write(&nowhere).expect_err("no folder");
    assert!(matches!(error, SnapshotError::Write { .. }) && error.to_string().contains("missing"), "{error}");
    // A folder in its place.
    let taken = folder.path().join("taken");
    fs::create_dir(&taken).expect("a folder");
    fs::write(taken.join("file"), b"").expect("a file");
    assert!(matches!(saved.write(&taken), Err(SnapshotError::Write { .. })));
    assert!(matches!(Snapshot::read(&taken), Err(SnapshotError::Read { .. })));
    assert!(matches!(Snapshot::read(&nowhere), Err(SnapshotError::Read { .. })));
    assert_eq!(fs::read_dir(&folder).expect("a folder").count(), 2);
}

#[test]
fn snapshots_are_serde_data() {
    let saved = snapshot();
    let json = serde_json::to_string(&saved).expect("JSON");
    assert_eq!(serde_json::from_str::<Snapshot>(&json).expect("a snapshot"), saved);
    let ron = ron::to_string(&saved).expect("RON");
    assert_eq!(ron::from_str::<Snapshot>(&ron).expect("a snapshot"), saved);
    let error = serde_json::from_str::<Snapshot>("[1, 2, 3]").expect_err("no snapshot");
    assert!(error.to_string().contains("no snapshot of a film"), "{error}");
}
