//! Whole frames of an app with coated props, without a GPU.
//!
//! Compared are frames with 1, 10, 100 and 500 props of 3,042 triangles each: `settled`, in which the clock stands
//! still and which must cost next to nothing, `ageing`, in which every film takes a step and is shown again, and
//! `bare`, the same props in an app without the plugin. The props are half way to age 1, so about half of their paint
//! is off. An item is a prop. The engine is not optimised in this profile, so its part of a frame is dearer than in a
//! game: compare frames with each other.
//!
//! Run with `cargo bench --profile dev --bench plugin`.

#[path = "../tests/common/mod.rs"]
mod common;

use std::{cell::RefCell, collections::BTreeMap};

use bevy::prelude::*;
use bevy_coating::prelude::*;
use divan::{Bencher, counter::ItemsCount};

const PROPS: [usize; 4] = [1, 10, 100, 500];
/// 3,042 triangles.
const SQUARES: u32 = 39;
const START_AGE: f64 = 0.5;

fn main() {
    divan::main();
}

/// Makes an app with so many aged props whose clock stands still.
fn coated(props: usize) -> App {
    let mut app = common::app();
    let mesh = common::add_mesh(&mut app, common::plate(SQUARES));
    for seed in 0..props as u64 {
        let coating = Coating::new(Preset::Default).with_resolution(FilmResolution::Keep);
        let coating = coating.with_seed(seed).with_start_age(START_AGE);
        app.world_mut().spawn((Mesh3d(mesh.clone()), coating));
    }
    common::wait_for_films(&mut app, props);
    app
}

/// Measures frames of the app with so many props, each begun with `begin`. Apps are kept: they take long to make.
fn frames(bencher: Bencher, props: usize, begin: impl Fn(&mut App)) {
    thread_local!(static APPS: RefCell<BTreeMap<usize, App>> = const { RefCell::new(BTreeMap::new()) });
    APPS.with_borrow_mut(|apps| {
        let app = apps.entry(props).or_insert_with(|| coated(props));
        let mut frame = || {
            begin(app);
            app.update();
        };
        // What the films that have just been made bring about is over after a few frames.
        (0..4).for_each(|_| frame());
        bencher.counter(ItemsCount::new(props)).bench_local(frame);
    });
}

#[divan::bench(args = PROPS)]
fn settled(bencher: Bencher, props: usize) {
    frames(bencher, props, |_| {});
}

#[divan::bench(args = PROPS, sample_count = 20, sample_size = 1)]
fn ageing(bencher: Bencher, props: usize) {
    frames(bencher, props, |app| app.world_mut().resource_mut::<CoatingClock>().request_steps(1));
}

#[divan::bench(args = PROPS)]
fn bare(bencher: Bencher, props: usize) {
    let mut app = common::bare_app();
    let mesh = common::add_mesh(&mut app, common::plate(SQUARES));
    app.world_mut().spawn_batch(vec![(Mesh3d(mesh), Transform::default()); props]);
    (0..4).for_each(|_| app.update());
    bencher.counter(ItemsCount::new(props)).bench_local(|| app.update());
}
