//! The numbers of the gallery: each is in its band, and `docs/gallery.md` has those that are measured here. Needs no
//! engine: `cargo core --test gallery -- --nocapture` prints them.
//!
//! `GALLERY=write cargo core --test gallery` writes the page's text, `cargo run --example gallery -- --page` the page
//! and its pictures.

#[path = "../../examples/gallery/measure/mod.rs"]
mod measure;

use std::fs;

use measure::page::{self, FILE, TIMES};

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
    assert!(TIMES.iter().all(|mark| fs::read_to_string(FILE).is_ok_and(|page| page.contains(mark))));
}
