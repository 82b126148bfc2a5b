//! Ages a painted prop without a window or a graphics adapter.
//!
//! ```text
//! coating-bake hydrant.glb --out aged.glb --stats aged.json
//! coating-bake props/ sign.obj --age 0.7 --out-dir aged
//! coating-bake plate:3012 --set stripping.fall_faces=0 --seed 3 --stats plate.json
//! ```
//!
//! Exit code 0; or 1, with one line on the standard error for each input that says what is wrong with which file and
//! what to do about it; or 2 for bad usage: options, numbers out of range, unknown presets and settings, two inputs
//! with one name; or 130 if it was interrupted. A file of settings that cannot be read counts as bad input (1). Output
//! files are written whole or not at all, and never over a file that is read.
//!
//! The program needs the feature `bake` and no engine: `cargo install --path . --no-default-features --features bake`.

#![deny(clippy::expect_used, clippy::panic, clippy::unwrap_used, clippy::unreachable)]

mod args;
mod jobs;
mod report;
mod values;

use std::{path::PathBuf, process::ExitCode};

use bevy_coating::{
    bake::{BakeError, BakeOptions, Images, StagedFiles, Stopwatch, bake},
    settings::SettingsError,
};
use clap::Parser;

use args::Args;
use jobs::Job;

/// Exit code of a program that Ctrl+C ended, as shells have it.
const INTERRUPTED: i32 = 130;

fn main() -> ExitCode {
    let stopwatch = Stopwatch::start();
    let args = Args::parse();
    // Where there can be no handler, temporary files may stay behind.
    let _ = ctrlc::set_handler(|| StagedFiles::abandon_all(|| std::process::exit(INTERRUPTED)));
    match run_all(&args, stopwatch) {
        Ok(true) => ExitCode::SUCCESS,
        Ok(false) => ExitCode::from(1),
        Err(error) => {
            report::error(&error);
            ExitCode::from(1)
        }
    }
}

/// Bakes all inputs; returns whether none failed.
fn run_all(args: &Args, stopwatch: Stopwatch) -> Result<bool, Failure> {
    let masks = args.masks()?;
    let mask_files = masks.files.clone();
    let options = args.options(masks)?;
    let jobs = jobs::list(args, &mask_files)?;
    if !jobs::is_batch(args) {
        jobs.iter().try_for_each(|job| run(args, job, &options, stopwatch))?;
        return Ok(true);
    }
    let mut failed = 0;
    for job in &jobs {
        if let Err(error) = run(args, job, &options, Stopwatch::start()) {
            report::error(&error);
            failed += 1;
        }
    }
    report::batch(jobs.len(), failed);
    Ok(failed == 0)
}

/// Bakes one input.
fn run(args: &Args, job: &Job, options: &BakeOptions, stopwatch: Stopwatch) -> Result<(), Failure> {
    let images = if job.out.is_some() { Images::Load } else { Images::Skip };
    let model = job.input.read(options.seed, images)?;
    let mut files = StagedFiles::default();
    model.files.iter().for_each(|file| files.guard(file));
    job.outputs().try_for_each(|path| files.claim(path))?;
    let progress = report::Bar::default();
    let mut baked = bake(model, options, stopwatch, &progress)?;
    progress.finish();

    if let Some(path) = &job.out {
        files.add(path, &baked.glb(args.stains())?)?;
    }
    if let Some(path) = &job.dump {
        files.add(path, baked.csv().as_bytes())?;
    }
    let stats = baked.stats();
    if let Some(path) = &job.stats {
        files.add(path, stats.to_json().as_bytes())?;
    }
    files.commit()?;
    // One input needs no name before each line.
    let origin = jobs::is_batch(args).then_some(baked.origin.as_str());
    report::warnings(origin, &baked.warnings);
    report::summary(&baked.origin, &stats, job.outputs());
    Ok(())
}

/// Why the run failed.
#[derive(Debug, thiserror::Error)]
enum Failure {
    /// The model, or a file to be written.
    #[error(transparent)]
    Bake(#[from] BakeError),
    /// One input is a folder.
    #[error("{}: is a folder; say with --out-dir where its models shall go", .0.display())]
    Folder(PathBuf),
    /// A folder holds nothing to bake.
    #[error("{}: holds no .glb, .gltf or .obj file", .0.display())]
    NoModels(PathBuf),
    /// The file of settings cannot be read.
    #[error("{file}: cannot be read: {source}")]
    Preset { file: String, source: std::io::Error },
    /// The file of settings is wrong.
    #[error(transparent)]
    Settings(#[from] SettingsError),
}
