//! The command line.

use std::{ffi::OsString, path::PathBuf};

use bevy_coating::{
    bake::{Input, TestPiece},
    deform::SolverQuality,
};
use clap::{
    Parser,
    builder::{OsStringValueParser, TypedValueParser},
};

/// The paper's Table 1: seconds of ageing and what they were spent on, ours beside the paper's
#[derive(Debug, Parser)]
#[command(name = "table1", version)]
pub struct Args {
    /// .glb, .gltf or .obj files, taken as they are, or test pieces; by default plate:3012 and curved:3005
    #[arg(value_parser = OsStringValueParser::new().try_map(|text: OsString| Input::parse(&text)))]
    models: Vec<Input>,
    /// Write the table
    #[arg(long, value_name = "FILE.json")]
    pub json: Option<PathBuf>,
    /// Steps, which make one unit of age
    #[arg(long, default_value_t = 1000, value_parser = clap::value_parser!(u32).range(1..=1_000_000))]
    pub steps: u32,
    /// How bending is solved: reference, high, default or fast
    #[arg(long, value_name = "NAME", default_value = "default", value_parser = parse_quality)]
    pub quality: SolverQuality,
    /// Seed of everything random
    #[arg(long, default_value_t = 0)]
    pub seed: u64,
    /// Runs of each model, of which the median counts
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = clap::value_parser!(u32).range(1..=99))]
    pub repeat: u32,
}

impl Args {
    /// The models asked for.
    pub fn models(&self) -> Vec<Input> {
        if self.models.is_empty() {
            vec![Input::Piece(TestPiece::Plate, 3012), Input::Piece(TestPiece::Curved, 3005)]
        } else {
            self.models.clone()
        }
    }
}

fn parse_quality(text: &str) -> Result<SolverQuality, &'static str> {
    SolverQuality::named(text).ok_or("not reference, high, default or fast")
}
