//! A step in which nothing fractures allocates nothing.

use std::{
    alloc::{GlobalAlloc, Layout, System},
    cell::Cell,
};

use bevy_coating::{
    deform::SolverQuality, remesh::sample, settings::CoatingSettings, sim::FilmState, stain::Environment,
};

thread_local! {
    static ALLOCATIONS: Cell<u64> = const { Cell::new(0) };
}

/// The system's allocator, counting what this thread asks for.
struct Counting;

#[allow(unsafe_code, reason = "an allocator can be written in no other way")]
// SAFETY: everything is handed on to the system's allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        ALLOCATIONS.with(|count| count.set(count.get() + 1));
        // SAFETY: the caller's.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        // SAFETY: the caller's.
        unsafe { System.dealloc(at, layout) }
    }

    unsafe fn realloc(&self, at: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        ALLOCATIONS.with(|count| count.set(count.get() + 1));
        // SAFETY: the caller's.
        unsafe { System.realloc(at, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

fn allocations(work: impl FnOnce()) -> u64 {
    let before = ALLOCATIONS.with(Cell::get);
    work();
    ALLOCATIONS.with(Cell::get) - before
}

#[test]
fn a_step_without_fracture_allocates_nothing() {
    assert!(allocations(|| drop(std::hint::black_box(vec![1, 2, 3]))) > 0, "the count works");
    let piece = sample::plate(2000, 1).unwrap();
    for quality in [SolverQuality::High, SolverQuality::Default] {
        let mut settings = CoatingSettings::default();
        let mut film = FilmState::new(&piece.film, &settings, 1, 1000).unwrap();
        film.quality = quality;
        film.age_to(0.6, &settings, &Environment::default());
        assert!(film.measure().torn > Some(0.02));
        // Fracture stops here; flakes go on curling, rust on running.
        settings.adhesion.decay = 0.0;
        settings.tearing.contraction_growth = 0.0;
        settings.tearing.binding_decay = 0.0;
        for _ in 0..30 {
            film.step(&settings, &Environment::default());
        }
        let mut moved = 0;
        for step in 0..100 {
            let count = allocations(|| film.step(&settings, &Environment::default()));
            if !film.changes.fractured() {
                assert_eq!(count, 0, "{quality:?}, step {step}");
                moved += u32::from(film.changes.moved);
            }
        }
        assert!(moved > 50, "{moved} steps");
    }
}
