//! How large snapshots are.

use super::plate;
use crate::{settings::CoatingSettings, snapshot::Snapshot, stain::Environment};

#[test]
fn snapshots_are_small() {
    let settings = CoatingSettings::default();
    let mut film = plate(3012, &settings, 7, 1000);
    for age in [0.0, 0.25, 0.5, 1.0] {
        film.age_to(age, &settings, &Environment::default());
        let saved = Snapshot::of(&film).expect("a snapshot");
        let bytes = saved.as_bytes().len() as f64 / film.mesh.topology.face_count() as f64;
        eprintln!("age {age}: {bytes:.1} bytes a triangle");
        assert!(bytes <= 40.0, "age {age}: {bytes} bytes a triangle");
    }
}
