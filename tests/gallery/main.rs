//! The numbers of the gallery: each is in its band, and `docs/gallery.md` has those that are measured here. Needs no
//! engine: `cargo core --test gallery -- --nocapture` prints them.
//!
//! `GALLERY=write cargo core --test gallery` writes the page's text, `cargo run --example gallery -- --headless --page`
//! the page and its pictures.

#[path = "../../examples/gallery/measure/mod.rs"]
mod measure;

use std::fs;

use measure::{
    claim::Claim,
    figure::at_least,
    figures::FIGURES,
    page::{self, FILE, PICTURES, TIMES, without_times},
    spread::Spread,
};

#[test]
fn every_number_is_in_its_band_and_on_the_page() {
    let measured = page::measure().expect("films");
    let mut out = Vec::new();
    for (figure, claims) in &measured {
        println!("{}: {}", figure.number, figure.title);
        for claim in claims {
            println!("  {claim}");
            if !claim.holds() {
                out.push(format!("{}: {claim}", figure.number));
            }
        }
    }
    let written = fs::read_to_string(FILE).unwrap_or_default();
    if std::env::var_os("GALLERY").is_some_and(|value| value == "write") {
        let times = page::times().expect("films");
        fs::write(FILE, page::text(&measured, &times)).expect("the page is written");
    } else {
        let expected = page::without_times(&page::text(&measured, ""));
        let written = page::without_times(&written);
        let differs = expected.lines().zip(written.lines()).find(|(expected, written)| expected != written);
        assert!(
            expected == written,
            "{FILE} says other than what is measured, from here on: {differs:?}\nwrite it: GALLERY=write cargo core \
             --test gallery"
        );
    }
    assert!(out.is_empty(), "{}", out.join("\n"));
}

#[test]
fn the_page_has_its_times_and_pictures() {
    let page = fs::read_to_string(FILE).expect("the page");
    let times = page.split_once(TIMES[0]).and_then(|(_, rest)| rest.split_once(TIMES[1])).expect("times").0;
    let seconds: Vec<f64> = times.lines().filter_map(|row| row.split('|').nth(5)?.trim().parse().ok()).collect();
    assert!(seconds.len() == 3 && seconds.iter().all(|&s| s > 0.0), "seconds of three models: {seconds:?}");
    let mut bytes = 0;
    for figure in FIGURES.iter().filter(|figure| !(figure.panels)().is_empty()) {
        let picture = format!("{PICTURES}/{}.png", figure.file);
        assert!(page.contains(&picture), "{picture} is not on the page");
        bytes += fs::metadata(&picture).unwrap_or_else(|error| panic!("{picture}: {error}")).len();
    }
    assert!(bytes < 1_700_000, "pictures of {bytes} bytes are too large for a repository");
}

/// What would make the test of bands pass whatever is measured.
#[test]
fn numbers_outside_of_their_bands_are_found() {
    let claim = |found: f64, band| Claim::single("a number", found, band, 2);
    assert!(claim(0.5, [0.4, 0.6]).holds() && claim(0.4, [0.4, 0.6]).holds());
    for (found, band) in [(0.39, [0.4, 0.6]), (0.61, [0.4, 0.6]), (f64::NAN, [f64::NEG_INFINITY, f64::INFINITY])] {
        assert!(!claim(found, band).holds(), "{found} in {band:?}");
    }
    let spread = Spread::of(&[1.0, 2.0, 3.0]);
    assert_eq!((spread.mean, spread.deviation, spread.count), (2.0, 1.0, 3));
    assert_eq!(Claim::new("a mean", spread, at_least(1.5), 1).number(), "2.0 ± 1.0");
    assert_eq!(without_times(&format!("a{}b{}c", TIMES[0], TIMES[1])), "ac");
}
