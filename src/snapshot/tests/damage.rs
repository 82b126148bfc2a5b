//! Bytes that are no snapshot are refused, whatever they are.

use proptest::prelude::*;

use super::plate;
use crate::{
    settings::CoatingSettings,
    sim::FilmState,
    snapshot::{Snapshot, SnapshotError, film_snapshot::SNAPSHOT, header},
    stain::Environment,
};

fn aged() -> FilmState {
    let settings = CoatingSettings::default();
    let mut film = plate(300, &settings, 3, 100);
    film.age_to(0.9, &settings, &Environment::default());
    film
}

/// Random numbers, always the same (SplitMix64).
struct Random(u64);

impl Random {
    fn below(&mut self, end: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((mixed ^ (mixed >> 31)) % end as u64) as usize
    }
}

#[test]
fn every_truncation_is_refused() {
    let bytes = Snapshot::of(&aged()).expect("a snapshot").into_bytes();
    for length in 0..bytes.len() {
        match Snapshot::from_bytes(&bytes[..length]) {
            Err(SnapshotError::NotASnapshot) if length == 0 => {}
            Err(SnapshotError::Length { found, .. }) if found == length && length > 0 => {}
            other => panic!("{length} bytes: {other:?}"),
        }
    }
    let longer = [bytes, vec![0]].concat();
    assert!(matches!(Snapshot::from_bytes(longer), Err(SnapshotError::Length { .. })));
}

#[test]
fn every_flipped_byte_is_refused() {
    let bytes = Snapshot::of(&aged()).expect("a snapshot").into_bytes();
    let mut random = Random(1);
    for _ in 0..1000 {
        let mut flipped = bytes.clone();
        let place = random.below(bytes.len());
        flipped[place] ^= 1 << random.below(8);
        let error = Snapshot::from_bytes(flipped).expect_err("damage");
        match place {
            0..6 => assert!(matches!(error, SnapshotError::NotASnapshot), "{place}: {error}"),
            6..8 => assert!(matches!(error, SnapshotError::Version { .. }), "{place}: {error}"),
            48..52 => assert!(matches!(error, SnapshotError::Length { .. }), "{place}: {error}"),
            _ => assert!(matches!(error, SnapshotError::Checksum), "{place}: {error}"),
        }
    }
}

/// Whoever writes a checksum over anything can make snapshots that no film was saved in.
#[test]
fn foreign_states_are_refused_or_are_films() {
    let film = aged();
    let bytes = Snapshot::of(&film).expect("a snapshot").into_bytes();
    let (name, state) = header::unwrap(SNAPSHOT, &bytes).expect("a snapshot");
    let (settings, mut random) = (CoatingSettings::default(), Random(2));
    let (mut refused, mut films) = (0, 0);
    for _ in 0..400 {
        let mut changed = state.to_vec();
        for _ in 0..=random.below(3) {
            let place = random.below(changed.len());
            changed[place] = random.below(256) as u8;
        }
        match Snapshot(header::wrap(SNAPSHOT, &name, &changed).expect("a state")).restore(&film.mesh) {
            Err(SnapshotError::Inconsistent { .. }) => refused += 1,
            Err(other) => panic!("{other}"),
            Ok(mut restored) => {
                films += 1;
                if restored.clock == film.clock {
                    restored.step(&settings, &Environment::default());
                }
            }
        }
    }
    assert!(refused > 100 && films > 0, "{refused} refused, {films} films");
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 300, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn random_bytes_are_refused(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        prop_assert!(Snapshot::from_bytes(bytes.clone()).is_err());
        // As the state of a film, with header and checksum in order.
        let film = plate(20, &CoatingSettings::default(), 3, 100);
        let saved = Snapshot::of(&film).expect("a snapshot").into_bytes();
        let (name, _) = header::unwrap(SNAPSHOT, &saved).expect("a snapshot");
        let refused = Snapshot(header::wrap(SNAPSHOT, &name, &bytes).expect("a state")).restore(&film.mesh);
        let is_named = matches!(refused, Err(SnapshotError::Inconsistent { .. }));
        prop_assert!(is_named);
    }
}

#[test]
fn other_versions_and_other_films_are_named() {
    let mut film = aged();
    let digest = film.digest();
    let saved = Snapshot::of(&film).expect("a snapshot");
    let mut bytes = saved.as_bytes().to_vec();
    bytes[6] += 1;
    let error = Snapshot::from_bytes(bytes).expect_err("another version").to_string();
    assert!(error.contains("version 3") && error.contains("reads version 2"), "{error}");

    let settings = CoatingSettings::default();
    let other = Snapshot::of(&plate(302, &settings, 3, 100)).expect("a snapshot");
    let error = film.restore(&other).expect_err("another film").to_string();
    assert!(error.contains("302 triangles") && error.contains("and 300"), "{error}");
    // As many triangles, elsewhere.
    let other = Snapshot::of(&plate(300, &settings, 4, 100)).expect("a snapshot");
    assert!(matches!(film.restore(&other), Err(SnapshotError::OtherFilm { .. })));
    assert_eq!(film.digest(), digest, "the film stays as it was");
}

#[test]
fn films_that_were_changed_by_hand_are_refused() {
    let changes: [fn(&mut FilmState); 4] = [
        |film| film.forces.tips.truncate(1),
        |film| film.stains.film.dust.push(0.0),
        |film| film.clock.steps = u64::MAX,
        |film| film.mesh.geometry.rest_positions.clear(),
    ];
    for change in changes {
        let mut film = aged();
        change(&mut film);
        assert!(matches!(Snapshot::of(&film), Err(SnapshotError::Unsaveable { .. })));
    }
}
