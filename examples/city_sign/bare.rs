//! Without a graphics adapter nothing can be drawn. The sign is aged all the same, and written as a model that
//! any viewer opens, with the figures of the run.

use crate::cli::Options;
use crate::common::{self, BakeError, BakeOptions, Input, Progress, Resolution, Staged, StainOutput, Stopwatch};
use crate::graphics;
use bevy::prelude::AppExit;
use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};

pub fn run(options: &Options) -> AppExit {
    println!("No graphics adapter was found, so nothing can be drawn: the sign is aged and written as a model.");
    println!("To see it drawn, a software renderer is enough:");
    println!("  Debian, Ubuntu:  apt install mesa-vulkan-drivers");
    println!("  Fedora:          dnf install mesa-vulkan-drivers");
    println!("  Arch:            pacman -S vulkan-swrast");
    match age(options) {
        Ok(()) => AppExit::Success,
        Err(error) => {
            eprintln!("{error}");
            AppExit::error()
        }
    }
}

fn age(options: &Options) -> Result<(), BakeError> {
    let stopwatch = Stopwatch::start();
    let (preset, settings) = options.preset.clone();
    let bake = BakeOptions {
        // The plate has about half of the sign's surface.
        resolution: Resolution::Triangles(options.triangles.saturating_mul(2)),
        settings,
        preset,
        age: options.ages.iter().copied().fold(0.0, f64::max),
        seed: options.seed,
        ..BakeOptions::default()
    };
    let sign = Path::new(graphics::ASSETS).join("city/street_sign.glb");
    let model = common::read(&Input::File(sign), options.seed, true)?;
    let mut baked = common::bake(model, &bake, stopwatch, &Told::default())?;
    for warning in &baked.warnings {
        println!("note: {warning}");
    }
    std::fs::create_dir_all(&options.output)
        .map_err(|source| BakeError::Write { path: options.output.clone(), source })?;
    let folder = std::fs::canonicalize(&options.output).unwrap_or_else(|_| options.output.clone());
    let (aged, figures) = (folder.join("street_sign_aged.glb"), folder.join("street_sign_aged.json"));
    let mut files = Staged::default();
    files.add(&aged, &common::aged_glb(&mut baked, StainOutput::default())?)?;
    files.add(&figures, baked.stats().to_json().as_bytes())?;
    files.commit()?;
    println!("{}", aged.display());
    println!("{}", figures.display());
    Ok(())
}

/// Tells of every tenth of the work.
#[derive(Default)]
struct Told {
    all: AtomicU64,
    done: AtomicU64,
}

impl Progress for Told {
    fn begin(&self, work: u64) {
        self.all.store(work.max(1), Ordering::Relaxed);
    }

    fn advance(&self, work: u64) {
        let all = self.all.load(Ordering::Relaxed);
        let before = self.done.fetch_add(work, Ordering::Relaxed);
        let (old, new) = (before * 10 / all, (before + work) * 10 / all);
        if new > old {
            println!("aged {} %", new * 10);
        }
    }
}
