//! How much memory a prop of 4,000 faces takes with what is shown of it: its front and, where it has separated, backs
//! and metal.

use std::{
    alloc::{GlobalAlloc, Layout, System},
    cell::Cell,
};

use bevy_coating::{
    appearance::{Detail, FilmAppearance, MeshPart},
    remesh::sample::{self, TestPiece},
    settings::CoatingSettings,
    sim::FilmState,
    stain::Environment,
};

const FACES: u32 = 4_000;
const MIB: f64 = 1024.0 * 1024.0;

thread_local! {
    static HELD: Cell<i64> = const { Cell::new(0) };
}

/// The system's allocator, counting the bytes that this thread holds.
struct Counting;

fn count(bytes: i64) {
    HELD.with(|held| held.set(held.get() + bytes));
}

#[allow(unsafe_code, reason = "an allocator can be written in no other way")]
// SAFETY: everything is handed on to the system's allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count(layout.size() as i64);
        // SAFETY: the caller's.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        count(-(layout.size() as i64));
        // SAFETY: the caller's.
        unsafe { System.dealloc(at, layout) }
    }

    unsafe fn realloc(&self, at: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count(size as i64 - layout.size() as i64);
        // SAFETY: the caller's.
        unsafe { System.realloc(at, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Makes a value, and returns it with the MiB that it holds.
fn held<T>(make: impl FnOnce() -> T) -> (T, f64) {
    let before = HELD.with(Cell::get);
    let made = make();
    (made, (HELD.with(Cell::get) - before) as f64 / MIB)
}

/// MiB of the arrays of a part.
fn arrays(part: Option<&MeshPart>) -> f64 {
    let MeshPart { positions, normals, uvs, uvs_1, tangents, colors, stains, rest, rest_normals, indices } =
        part.expect("one slot");
    let of_three = [positions, normals, rest, rest_normals].map(|values| 12 * values.capacity());
    let of_two = [uvs, uvs_1].map(|values| 8 * values.capacity());
    let of_four = [tangents, colors, stains].map(|values| 16 * values.capacity());
    let bytes = of_three.iter().chain(&of_two).chain(&of_four).sum::<usize>() + 4 * indices.capacity();
    bytes as f64 / MIB
}

fn shown(piece: &TestPiece, film: &FilmState, level: u32) -> FilmAppearance {
    let FilmState { mesh, forces, stains, .. } = film;
    let detail = Detail { level, ..Detail::default() };
    FilmAppearance::with_detail(&piece.film, &piece.surface, mesh, forces, stains, detail).expect("a clean plate")
}

/// State of a film.
#[derive(Clone, Copy, Debug)]
enum State {
    Fresh,
    /// At age 1: much has separated, and some has fallen.
    Old,
    /// Nothing holds anywhere, and nothing has fallen: as much to show as there can be.
    Loose,
}

#[test]
fn props_keep_to_their_memory() {
    let piece = sample::plate(FACES, 1).expect("a plate");
    let settings = CoatingSettings::default();
    for state in [State::Fresh, State::Old, State::Loose] {
        let (mut film, _) = held(|| FilmState::new(&piece.film, &settings, 1, 500).expect("a manifold"));
        match state {
            State::Fresh => {}
            State::Old => film.age_to(1.0, &settings, &Environment::default()),
            State::Loose => {
                film.forces.separated_age.fill(0.0);
                film.forces.touch_all();
            }
        }
        let (film, of_film) = held(|| film.clone());
        for (level, most) in [(0, 5.0), (2, if matches!(state, State::Loose) { 14.0 } else { 12.5 })] {
            let (shown, all) = held(|| shown(&piece, &film, level));
            let parts = [shown.front(0), shown.backs(0), shown.metal(0)].map(arrays);
            let [front, backs, metal] = parts;
            let lookups = all - parts.iter().sum::<f64>();
            println!(
                "{state:?}, level {level}: film {of_film:.2}, front {front:.2}, backs {backs:.2}, metal {metal:.2}, \
                 lookups {lookups:.2}, together {:.2} MiB",
                of_film + all
            );
            assert!(of_film + all <= most, "{} MiB at level {level}, of {most}", of_film + all);
            assert!(lookups > 0.0 && front > 0.1, "something is counted");
        }
    }
}
