//! Saved and restored films go on as if nothing had been, and bytes that are no snapshot are refused.

mod damage;
mod files;
mod goes_on;
mod parts;
mod size;

use crate::{remesh::sample, settings::CoatingSettings, sim::FilmState};

/// Returns a fresh film on a plate.
fn plate(triangles: u32, settings: &CoatingSettings, seed: u64, steps_per_age: u32) -> FilmState {
    let piece = sample::plate(triangles, seed).expect("a plate");
    FilmState::new(&piece.film, settings, seed, steps_per_age).expect("a manifold")
}
