//! The command line.

use bevy::prelude::Resource;
use bevy_coating::settings::CoatingSettings;
use clap::{Parser, ValueEnum};
use std::path::PathBuf;

/// A painted street sign on a corner of a ruined city, ageing.
#[derive(Parser, Resource, Clone, Debug)]
#[command(name = "city_sign", about)]
pub struct Options {
    /// Render PNG files instead of opening a window (the default where there is no display).
    #[arg(long)]
    pub headless: bool,
    /// Where the pictures go.
    #[arg(long, value_name = "DIR", default_value = "output/city_sign")]
    pub output: PathBuf,
    /// Size of the pictures or of the window.
    #[arg(long, value_name = "WxH", default_value = "1280x720", value_parser = parse_size)]
    pub size: (u32, u32),
    /// Ages of the pictures: 0 is fresh paint, 1 the end of the reference run.
    #[arg(long, value_name = "AGE,..", value_delimiter = ',', default_value = "0,0.25,0.5,0.75,1", value_parser = parse_age)]
    pub ages: Vec<f64>,
    /// What the camera looks at.
    #[arg(long, value_enum, default_value_t = View::Sign)]
    pub view: View,
    /// How the paint behaves: default, few_cracks, gentle or heavy.
    #[arg(long, value_name = "NAME", default_value = "default", value_parser = parse_preset)]
    pub preset: (String, CoatingSettings),
    /// Another seed, other cracks.
    #[arg(long, default_value_t = 7)]
    pub seed: u64,
    /// Triangles of the film on the sign's plate.
    #[arg(long, default_value_t = 8000, value_parser = clap::value_parser!(u32).range(100..=200_000))]
    pub triangles: u32,
}

#[derive(ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
pub enum View {
    /// The sign on its corner.
    Sign,
    /// The lettering from a hand's breadth away.
    Close,
    /// The whole street.
    Street,
    /// Each of them (pictures only; the window starts with the sign).
    All,
}

fn parse_size(text: &str) -> Result<(u32, u32), String> {
    let parsed = text.split_once(['x', 'X']).and_then(|(w, h)| Some((w.trim().parse().ok()?, h.trim().parse().ok()?)));
    match parsed {
        Some((w, h)) if (16..=8192).contains(&w) && (16..=8192).contains(&h) => Ok((w, h)),
        _ => Err(format!("`{text}` is not WIDTHxHEIGHT with sides from 16 to 8192, such as 1280x720")),
    }
}

fn parse_age(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(age) if (0.0..=4.0).contains(&age) => Ok(age),
        _ => Err(format!("`{text}` is not an age from 0 to 4")),
    }
}

fn parse_preset(name: &str) -> Result<(String, CoatingSettings), String> {
    CoatingSettings::preset(name).map(|settings| (name.to_owned(), settings)).map_err(|error| error.to_string())
}
