//! Ages a painted prop without a window or a graphics adapter.
//!
//! ```text
//! cargo run --example bake -- hydrant.glb --out aged.glb --stats aged.json
//! cargo run --example bake -- plate:3012 --set stripping.fall_faces=0 --seed 3 --stats plate.json
//! ```
//!
//! Exit code 0; or 1, with one line on the standard error that says what is wrong with which file and what to do
//! about it; or 2 for bad usage: options, numbers out of range, unknown presets and settings. A file of settings
//! that cannot be read counts as bad input (1). Output files are written whole or not at all.

mod args;
#[path = "../common/mod.rs"]
mod common;
mod report;

use std::process::ExitCode;

use args::Args;
use common::{BakeError, Staged, Stopwatch};

fn main() -> ExitCode {
    let stopwatch = Stopwatch::start();
    let args = Args::parse_or_exit();
    match run(&args, stopwatch) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            report::error(&error);
            ExitCode::from(1)
        }
    }
}

fn run(args: &Args, stopwatch: Stopwatch) -> Result<(), Failure> {
    let options = args.options()?;
    for path in args.outputs() {
        Staged::check(path)?;
    }
    let model = common::read(&args.input, options.seed, args.out.is_some())?;
    let progress = report::Bar::default();
    let mut baked = common::bake(model, &options, stopwatch, &progress)?;
    progress.finish();

    let mut files = Staged::default();
    if let Some(path) = &args.out {
        files.add(path, &common::aged_glb(&mut baked, args.stains())?)?;
    }
    if let Some(path) = &args.dump {
        files.add(path, common::dump_csv(&baked.props, &baked.films).as_bytes())?;
    }
    let stats = baked.stats();
    if let Some(path) = &args.stats {
        files.add(path, stats.to_json().as_bytes())?;
    }
    files.commit()?;
    report::warnings(&baked.warnings);
    report::summary(&baked.origin, &stats, args.outputs());
    Ok(())
}

/// Why the run failed.
#[derive(Debug, thiserror::Error)]
enum Failure {
    /// The model, or a file to be written.
    #[error(transparent)]
    Bake(#[from] BakeError),
    /// The file of settings cannot be read.
    #[error("{file}: cannot be read: {source}")]
    Preset { file: String, source: std::io::Error },
    /// The file of settings is wrong.
    #[error(transparent)]
    Settings(#[from] bevy_coating::settings::SettingsError),
}
