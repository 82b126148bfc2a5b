//! Ages a painted prop without a window or a graphics adapter.
//!
//! ```text
//! coating-bake hydrant.glb --out aged.glb --stats aged.json
//! coating-bake plate:3012 --set stripping.fall_faces=0 --seed 3 --stats plate.json
//! ```
//!
//! Exit code 0; or 1, with one line on the standard error that says what is wrong with which file and what to do
//! about it; or 2 for bad usage: options, numbers out of range, unknown presets and settings. A file of settings
//! that cannot be read counts as bad input (1). Output files are written whole or not at all.
//!
//! The program needs the feature `bake` and no engine: `cargo install --path . --no-default-features --features bake`.

mod args;
mod report;

use std::process::ExitCode;

use bevy_coating::{
    bake::{BakeError, Images, StagedFiles, Stopwatch, bake},
    settings::SettingsError,
};

use args::Args;

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
        StagedFiles::check(path)?;
    }
    let images = if args.out.is_some() { Images::Load } else { Images::Skip };
    let model = args.input.read(options.seed, images)?;
    let progress = report::Bar::default();
    let mut baked = bake(model, &options, stopwatch, &progress)?;
    progress.finish();

    let mut files = StagedFiles::default();
    if let Some(path) = &args.out {
        files.add(path, &baked.glb(args.stains())?)?;
    }
    if let Some(path) = &args.dump {
        files.add(path, baked.csv().as_bytes())?;
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
    Settings(#[from] SettingsError),
}
