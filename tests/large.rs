//! Props of very many triangles, and of one, coated as they are by default: in how much memory and time. Needs no
//! engine: `cargo core --test large`, and with `-- --include-ignored --nocapture` also that of 2 million triangles.

use std::{
    alloc::{GlobalAlloc, Layout, System},
    f32::consts::TAU,
    sync::{
        Mutex,
        atomic::{AtomicUsize, Ordering::Relaxed},
    },
    time::Instant,
};

use bevy_coating::{
    bake::{BakeOptions, BakeWarning, ModelMesh, coat},
    surface::{BuildWarning, Surface},
};
use bevy_math::{Vec3, ops};

const MIB: f64 = 1024.0 * 1024.0;

static HELD: AtomicUsize = AtomicUsize::new(0);
static MOST: AtomicUsize = AtomicUsize::new(0);
/// One test at a time: memory is that of the whole program.
static ALONE: Mutex<()> = Mutex::new(());

/// The system's allocator, counting the bytes that are held, and the most that ever were.
struct Counting;

fn take(bytes: usize) {
    MOST.fetch_max(HELD.fetch_add(bytes, Relaxed) + bytes, Relaxed);
}

#[allow(unsafe_code, reason = "an allocator can be written in no other way")]
// SAFETY: everything is handed on to the system's allocator.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        take(layout.size());
        // SAFETY: the caller's.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, at: *mut u8, layout: Layout) {
        HELD.fetch_sub(layout.size(), Relaxed);
        // SAFETY: the caller's.
        unsafe { System.dealloc(at, layout) }
    }

    unsafe fn realloc(&self, at: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        take(size);
        HELD.fetch_sub(layout.size(), Relaxed);
        // SAFETY: the caller's.
        unsafe { System.realloc(at, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// Makes a torus with radii of 1 and 0.4 m, of 2 times `along` times `across` triangles.
fn torus(along: u32, across: u32) -> Surface {
    let point = |i: u32, j: u32| {
        let (sin_a, cos_a) = ops::sin_cos(TAU * i as f32 / along as f32);
        let (sin_b, cos_b) = ops::sin_cos(TAU * j as f32 / across as f32);
        let radius = 1.0 + 0.4 * cos_b;
        Vec3::new(radius * cos_a, 0.4 * sin_b, -radius * sin_a)
    };
    let cells = || (0..along).flat_map(move |i| (0..across).map(move |j| (i, j)));
    let index = |i: u32, j: u32| (i % along) * across + j % across;
    let quad = |(i, j)| {
        let [a, b, c, d] = [index(i, j), index(i + 1, j), index(i + 1, j + 1), index(i, j + 1)];
        [[a, b, c], [a, c, d]]
    };
    Surface {
        positions: cells().map(|(i, j)| point(i, j)).collect(),
        triangles: cells().flat_map(quad).collect(),
        ..Surface::default()
    }
}

/// Coats a prop as it is by default, and ages it by a step. Returns the number of triangles of its film, and the most
/// bytes that were held at a time for each triangle of the prop.
fn coated(surface: Surface) -> (usize, f64) {
    let triangles = surface.triangles.len();
    let options = BakeOptions::default();
    let mesh = ModelMesh { name: "prop".into(), surface, ..ModelMesh::default() };
    let before = HELD.load(Relaxed);
    MOST.store(before, Relaxed);
    let begin = Instant::now();
    let mut coated = coat("prop", vec![mesh], &options).expect("a film");
    let (time, most) = (begin.elapsed(), MOST.load(Relaxed) - before);
    // A film of as many triangles as there may be is coarser than its grain.
    let is_expected = |warning: &BakeWarning| {
        matches!(warning, BakeWarning::Build { warning: BuildWarning::CoarserThanGrain { .. }, .. })
    };
    assert!(coated.warnings.iter().all(is_expected), "{:?}", coated.warnings);
    let [film] = coated.films.as_mut_slice() else { panic!("one film") };
    film.step(&options.settings, &options.environment);
    film.validate().expect("a film in order");
    let faces = film.mesh.topology.face_count();
    println!("{triangles} triangles: a film of {faces} in {time:.1?}, with {:.0} MiB", most as f64 / MIB);
    (faces, most as f64 / triangles as f64)
}

fn large_prop_is_coated(along: u32, across: u32) {
    let _alone = ALONE.lock();
    let (faces, bytes) = coated(torus(along, across));
    assert!((8_000..=17_600).contains(&faces), "{faces} triangles, as many as for any other prop");
    assert!(bytes < 1024.0, "{bytes:.0} bytes for each triangle");
}

#[test]
fn a_prop_of_200_000_triangles_is_coated_with_as_many_as_any_other() {
    large_prop_is_coated(500, 200);
}

/// Too slow for every day.
#[test]
#[ignore = "takes 20 s and 600 MB"]
fn a_prop_of_2_million_triangles_is_coated_with_as_many_as_any_other() {
    large_prop_is_coated(1000, 1000);
}

#[test]
fn a_prop_of_one_triangle_is_coated() {
    let _alone = ALONE.lock();
    let surface =
        Surface { positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y], triangles: vec![[0, 1, 2]], ..Surface::default() };
    let (faces, _) = coated(surface);
    assert!((1_000..=17_600).contains(&faces), "{faces} triangles, as many as for any other prop");
}
