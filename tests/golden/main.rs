//! Films whose bits are known: digests of three films at three ages. Needs no engine: `cargo core --test golden`.
//!
//! `digests.txt` holds each digest with the reason for which it became what it is. Where a change of the method is
//! meant to change them, this writes the new ones, with a reason:
//!
//! ```sh
//! GOLDEN_REASON="Cracks branch at half the angle" cargo core --test golden
//! ```

mod digests;
mod films;

use std::fs;

use bevy_coating::deform::SimdLevel;

use digests::{Digest, parse, write};
use films::AGES;

const FILE: &str = "tests/golden/digests.txt";

/// Digests of a film at all ages, computed with the instructions of `level`.
fn digests_of(film: &films::Film, level: SimdLevel) -> Vec<Digest> {
    let mut state = (film.make)();
    state.scratch.bend.level = level;
    let digest_at = |age| {
        state.age_to(age, &film.settings, &film.environment);
        Digest { film: film.name.into(), age, hex: state.digest(), reason: String::new() }
    };
    AGES.into_iter().map(digest_at).collect()
}

#[test]
fn films_have_the_bits_that_they_had() {
    let text = fs::read_to_string(FILE).expect("the file of digests");
    let known = parse(&text).unwrap_or_else(|error| panic!("{FILE}: {error}"));
    let found: Vec<Digest> = films::all().iter().flat_map(|film| digests_of(film, SimdLevel::best())).collect();
    if let Some(reason) = std::env::var_os("GOLDEN_REASON") {
        let reason = reason.into_string().expect("a reason in UTF-8");
        let text = write(&known, &found, &reason).unwrap_or_else(|error| panic!("GOLDEN_REASON: {error}"));
        fs::write(FILE, text).expect("the file of digests is written");
        return;
    }
    let names = |digests: &[Digest]| -> Vec<(String, f64)> {
        digests.iter().map(|digest| (digest.film.clone(), digest.age)).collect()
    };
    assert_eq!(names(&known), names(&found), "{FILE} has a line for each film and age, in their order");
    let changed: Vec<String> = known
        .iter()
        .zip(&found)
        .filter(|(known, found)| known.hex != found.hex)
        .map(|(known, found)| {
            let Digest { film, age, hex, .. } = known;
            format!("digest of {film} at age {age} was {hex}, is {}", found.hex)
        })
        .collect();
    assert!(
        changed.is_empty(),
        "{}:\nif that is meant, say why: GOLDEN_REASON=\"...\" cargo core --test golden",
        changed.join("\n")
    );
}

/// The unit tests compare kernels. This compares a whole life, with all that follows from every bit.
#[test]
fn every_instruction_set_gives_the_same_film() {
    let films = films::all();
    let film = &films[1];
    let best = digests_of(film, SimdLevel::best());
    for level in SimdLevel::ALL.into_iter().filter(|level| level.is_available()) {
        assert_eq!(digests_of(film, level), best, "{}", level.name());
    }
}
