//! Random hours of a game in a minute: thirty props are spawned, cloned, despawned, changed, broken and mended in
//! random order, and after every frame the state of the app is compared with what the clock and the hierarchy say.
//!
//! `COATING_SOAK_SEED=7` runs one seed, `COATING_SOAK_WITHOUT=Clone,Swap` leaves actions out, to find the one that is
//! to blame. `COATING_SOAK_MINUTES=60` goes on for an hour, and tells how much memory the program takes.

mod actions;
mod oracle;
mod props;

use std::{
    collections::VecDeque,
    time::{Duration, Instant},
};

use bevy::{prelude::*, time::TimeUpdateStrategy};
use bevy_coating::prelude::*;
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use self::{oracle::Oracle, props::Palette};
use crate::common::*;

/// Seeds that run in one test, each with an app of its own.
const SEEDS: std::ops::Range<u64> = 1..5;
/// Times that each app is brought to rest and looked at.
const EPISODES: u32 = 10;
/// Frames between two rests.
const FRAMES: u32 = 150;

#[test]
fn props_survive_whatever_happens_to_them() {
    let seeds = match std::env::var("COATING_SOAK_SEED") {
        Ok(seed) => vec![seed.parse().expect("a number in COATING_SOAK_SEED")],
        Err(_) => SEEDS.collect(),
    };
    if let Ok(minutes) = std::env::var("COATING_SOAK_MINUTES") {
        let minutes: f32 = minutes.parse().expect("a number in COATING_SOAK_MINUTES");
        return go_on(Duration::from_secs_f32(60.0 * minutes));
    }
    for seed in seeds {
        // Shown when the test fails.
        println!("seed {seed}: run it alone with COATING_SOAK_SEED={seed}");
        run(seed);
    }
}

/// Runs one app after the other until `time` is over. The memory of the program must not grow.
fn go_on(time: Duration) {
    let begin = Instant::now();
    let mut most = Vec::new();
    for seed in 1000.. {
        if begin.elapsed() > time {
            break;
        }
        run(seed);
        let bytes = memory();
        println!("{:5} s, seed {seed}: {} MiB", begin.elapsed().as_secs(), bytes >> 20);
        most.push(bytes);
    }
    // The first apps warm up allocator and pools.
    let half = most.len() / 2;
    let [early, late] = [&most[..half], &most[half..]].map(|half| half.iter().copied().max().unwrap_or_default());
    assert!(half < 4 || late < early + early / 4, "memory grows: {} to {} MiB", early >> 20, late >> 20);
}

/// Bytes of memory that this process takes; 0 where nobody knows.
fn memory() -> usize {
    let pages = std::fs::read_to_string("/proc/self/statm").ok();
    pages.and_then(|pages| pages.split(' ').nth(1)?.parse::<usize>().ok()).unwrap_or_default() * 4096
}

/// An app that is looked at from outside, with what is expected of it.
struct Soak {
    app: App,
    rng: ChaCha8Rng,
    palette: Palette,
    oracle: Oracle,
    /// Films that were saved, with the prop that they are of.
    saved: Vec<(Entity, CoatingSnapshot)>,
    journal: Journal,
}

/// What happened last, printed if the test fails: what depends on when a background task is done does not come back
/// with the seed.
#[derive(Default)]
struct Journal(VecDeque<String>);

impl Journal {
    /// Number of entries that are kept.
    const KEPT: usize = 400;

    fn note(&mut self, entry: String) {
        if self.0.len() == Self::KEPT {
            self.0.pop_front();
        }
        self.0.push_back(entry);
    }
}

impl Drop for Journal {
    fn drop(&mut self) {
        if std::thread::panicking() {
            self.0.iter().for_each(|entry| println!("{entry}"));
        }
    }
}

fn run(seed: u64) {
    let mut app = app();
    #[cfg(feature = "render")]
    app.init_asset::<Image>().init_asset::<StandardMaterial>();
    let palette = Palette::new(&mut app);
    let allowed = actions::allowed();
    for _ in 0..3 {
        app.update();
    }
    let baseline = counts(&app);
    let mut soak = Soak {
        app,
        rng: ChaCha8Rng::seed_from_u64(seed),
        palette,
        oracle: Oracle::default(),
        saved: Vec::new(),
        journal: Journal::default(),
    };
    for _ in 0..EPISODES {
        for _ in 0..FRAMES {
            if soak.rng.random_bool(0.4) {
                let action = allowed[soak.rng.random_range(0..allowed.len())];
                soak.act(action);
            }
            soak.frame();
        }
        soak.rest();
    }
    soak.despawn_all();
    // More than the half second over which the pace is averaged.
    for _ in 0..40 {
        soak.frame();
    }
    assert_eq!(counts(&soak.app), baseline, "entities and assets that are left when all props are gone");
    assert_eq!(*soak.app.world().resource::<CoatingStatus>(), CoatingStatus::default());
}

/// Numbers of entities, meshes, settings and materials.
fn counts(app: &App) -> Vec<usize> {
    let world = app.world();
    let mut counts = vec![world.entities().count_spawned() as usize];
    counts.push(world.resource::<Assets<Mesh>>().len());
    counts.push(world.resource::<Assets<CoatingSettings>>().len());
    #[cfg(feature = "render")]
    {
        counts.push(world.resource::<Assets<StandardMaterial>>().len());
        counts.push(world.get_resource::<Assets<bevy_coating::StainedMaterial>>().map_or(0, Assets::len));
    }
    counts
}

impl Soak {
    /// Updates the app by one frame of a random length, and compares the ages with those that the clock gives.
    fn frame(&mut self) {
        let frame = Duration::from_millis(self.rng.random_range(5..100));
        self.app.insert_resource(TimeUpdateStrategy::ManualDuration(frame));
        self.oracle.expect(&mut self.app, frame);
        let clock = self.app.world().resource::<CoatingClock>().clone();
        self.app.update();
        // Builds and rays run in the background.
        std::thread::sleep(Duration::from_micros(500));
        let status = self.app.world().resource::<CoatingStatus>();
        let films = self.oracle.describe(&self.app);
        self.journal.note(format!("frame of {frame:?}, {clock:?}, {status:?}, {films}"));
        self.oracle.compare(&mut self.app);
    }

    /// Mends what is broken, waits until all films are built and all rays cast, and looks at everything.
    fn rest(&mut self) {
        self.mend_all();
        self.wait("films to be built", |status| (status.waiting, status.refused, status.renewing) == (0, 0, 0));
        self.app.world_mut().resource_mut::<CoatingClock>().paused = false;
        self.wait("rays to be cast", |status| {
            [status.casting, status.waiting, status.renewing, status.seeking] == [0; 4]
        });
        self.oracle.compare_at_rest(&mut self.app);
        self.oracle.look_at_everything(&mut self.app);
    }

    fn wait(&mut self, what: &str, done: impl Fn(&CoatingStatus) -> bool) {
        // A change acts in the frame after it at the latest.
        self.frame();
        self.frame();
        for _ in 0..10_000 {
            if done(self.app.world().resource::<CoatingStatus>()) {
                return;
            }
            self.frame();
        }
        let status = self.app.world().resource::<CoatingStatus>();
        panic!("waited in vain for {what}: {status:?}; refused before were {:#?}", self.oracle.refusals);
    }
}

/// A random one of `choices`.
fn one<T: Clone>(rng: &mut impl Rng, choices: &[T]) -> Option<T> {
    (!choices.is_empty()).then(|| choices[rng.random_range(0..choices.len())].clone())
}
