//! The paper's Table 1, and ours beside it: where the time of ageing goes.
//!
//! ```text
//! cargo run --example table1
//! cargo run --example table1 -- plate:3012 bunny.glb --quality high --json table1.json
//! ```
//!
//! Each model is aged on one thread, and what is shown of it is brought up to date after every step. Files are taken as
//! they are, welded; test pieces have exactly the triangles asked for. Exit code 0; or 1, with one line on the
//! standard error, on bad input; or 2 for bad usage.

mod args;
mod report;
mod run;

use std::process::ExitCode;

use args::Args;
use bevy_coating::bake::{BakeError, StagedFiles};
use clap::Parser;

fn main() -> ExitCode {
    match run(&Args::parse()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            report::error(&error);
            ExitCode::from(1)
        }
    }
}

fn run(args: &Args) -> Result<(), BakeError> {
    if let Some(path) = &args.json {
        StagedFiles::check(path)?;
    }
    // All models are read first: a wrong name should not be found after a minute of work.
    let models = args.models().iter().map(|input| run::load(input, args)).collect::<Result<Vec<_>, _>>()?;
    let rows: Vec<_> = models.iter().map(|model| run::measure(model, args)).collect();
    if let Some(path) = &args.json {
        let mut files = StagedFiles::default();
        files.add(path, report::json(&rows).as_bytes())?;
        files.commit()?;
    }
    report::table(&rows);
    Ok(())
}
