//! What is shown: one theme a picture, one setting of it a row.

use crate::cli::Options;
use bevy::prelude::*;
use bevy_coating::prelude::*;
use clap::ValueEnum;

#[derive(ValueEnum, Clone, Copy, Debug, PartialEq, Eq)]
pub enum Theme {
    /// Black stains by height, by direction, by curvature, by all three.
    Dust,
    /// Rust that runs off below cracks, without and with wind.
    Rust,
    /// Paint without moisture, in rain from one side, and under a roof.
    Moisture,
}

/// Four pieces with the same settings.
#[derive(Clone, Debug)]
pub struct Row {
    /// Of its files.
    pub name: &'static str,
    pub title: &'static str,
    /// What is set.
    pub detail: String,
    pub settings: CoatingSettings,
    pub windy: bool,
    pub roof: bool,
}

/// Where the rain comes from: the left.
pub const RAIN: Vec3 = Vec3::new(0.55, -0.72, -0.32);
/// Where the wind blows to.
pub const WIND: Vec3 = Vec3::new(0.8, 0.0, 0.0);
pub const GUSTS: f32 = 0.06;

impl Theme {
    pub const ALL: [Self; 3] = [Self::Dust, Self::Rust, Self::Moisture];

    pub fn name(self) -> &'static str {
        match self {
            Self::Dust => "dust",
            Self::Rust => "rust",
            Self::Moisture => "moisture",
        }
    }

    /// Colour of the paint: what the stains are seen on best.
    pub fn paint(self) -> Color {
        match self {
            Self::Dust => Color::srgb(0.80, 0.76, 0.66),
            Self::Rust => Color::srgb(0.70, 0.78, 0.76),
            Self::Moisture => Color::srgb(0.30, 0.54, 0.62),
        }
    }

    /// From top to bottom.
    pub fn rows(self, options: &Options) -> Vec<Row> {
        let mut settings = options.preset.1.clone();
        // Flakes that lie flat hide less of what runs off below them.
        settings.deform.sweeps_per_age *= 0.3;
        settings.deform.bend_limit *= 0.7;
        let plain = Row { name: "", title: "", detail: String::new(), settings, windy: false, roof: false };
        match self {
            Self::Dust => dust(&plain),
            Self::Rust => rust(&plain),
            Self::Moisture => moisture(&plain),
        }
    }
}

fn dust(plain: &Row) -> Vec<Row> {
    let row = |name, title, height, direction, curvature| {
        let mut settings = plain.settings.clone();
        // Sound paint, that nothing but dust is seen.
        settings.adhesion.mean = 100.0;
        settings.tearing.weak_probability = 0.0;
        settings.tearing.binding = 1e6;
        settings.moisture.wetting = 0.0;
        settings.dust.rate *= 1.6;
        (settings.dust.height, settings.dust.direction, settings.dust.curvature) = (height, direction, curvature);
        let detail = format!("dust.height {height}   direction {direction}   curvature {curvature}");
        Row { name, title, detail, settings, ..plain.clone() }
    };
    let all = &plain.settings.dust;
    vec![
        row("height", "Dust by height", 1.0, 0.0, 0.0),
        row("direction", "Dust by direction", 0.0, 1.0, 0.0),
        row("curvature", "Dust by curvature", 0.0, 0.0, 1.0),
        row("all", "Dust by all three", all.height, all.direction, all.curvature),
    ]
}

fn rust(plain: &Row) -> Vec<Row> {
    let row = |name, title, detail: String, windy| {
        let mut settings = plain.settings.clone();
        settings.dust.rate = 0.0;
        settings.moisture.wetting = 0.0;
        Row { name, title, detail, settings, windy, ..plain.clone() }
    };
    let wind = format!("wind {} to the right, gusts {}", WIND.x, GUSTS);
    vec![
        row("still", "Rust in still air", "wind 0, gusts 0".into(), false),
        row("wind", "Rust in the wind", wind, true),
    ]
}

fn moisture(plain: &Row) -> Vec<Row> {
    let row = |name, title, detail: &str, wet: bool, roof: bool| {
        let mut settings = plain.settings.clone();
        if !wet {
            settings.moisture.wetting = 0.0;
        }
        Row { name, title, detail: detail.into(), settings, roof, ..plain.clone() }
    };
    vec![
        row("roof", "Under a roof", "the same rain, kept off by what stands around", true, true),
        row("rain", "In the rain", "from the left; the sun stands on the right", true, false),
        row("off", "Without moisture", "moisture.wetting 0", false, false),
    ]
}
