//! A figure of the paper: what it says, what is shown of ours beside it, and what is measured.

use bevy_coating::heat::HeatMap;

use super::{
    claim::Claim,
    exhibit::{Exhibit, NoFilm},
};

/// How a film is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Look {
    /// As paint.
    #[default]
    Paint,
    /// Coloured by a quantity.
    Heat(HeatMap),
    /// As paint, with lines along cracks and marks at the sources of rust.
    Cracks,
    /// As paint, with the triangles of the simulation and those that are drawn as lines.
    Wires,
}

/// A film in a picture.
#[derive(Clone, Debug)]
pub struct Panel {
    pub exhibit: Exhibit,
    pub age: f64,
    pub look: Look,
    /// How finely it is drawn: each triangle of the film by 4 to this power.
    pub level: u32,
}

impl Panel {
    pub fn new(exhibit: Exhibit, age: f64) -> Self {
        Self { exhibit, age, look: Look::Paint, level: 0 }
    }
}

/// From where the panels are seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum View {
    /// From the front, on a wall.
    Wall,
    /// Standing free, from a side, by so many radians around the vertical and from above.
    Free { yaw: f32, pitch: f32 },
    /// From so many metres, at so many radians from the front, at a place in metres from the middle of the only panel.
    Close { distance: f32, yaw: f32, at: [f32; 2] },
}

/// A figure of the paper.
pub struct Figure {
    /// As the paper has it.
    pub number: &'static str,
    /// Of its files.
    pub file: &'static str,
    pub title: &'static str,
    /// What the paper states, in our words.
    pub paper: &'static str,
    /// What is shown here, and with what settings.
    pub here: &'static str,
    pub view: View,
    pub columns: usize,
    /// Width of the picture, in pixels.
    pub width: u32,
    /// Films in the picture, row by row. No picture if there are none.
    pub panels: fn() -> Vec<Panel>,
    /// What is measured, without an engine.
    pub claims: fn() -> Result<Vec<Claim>, NoFilm>,
}

/// Any value: for numbers that are only told.
pub const ANY: [f64; 2] = [f64::NEG_INFINITY, f64::INFINITY];

/// Returns the band from `low` on.
pub const fn at_least(low: f64) -> [f64; 2] {
    [low, f64::INFINITY]
}

/// Returns the band up to `high`.
pub const fn at_most(high: f64) -> [f64; 2] {
    [f64::NEG_INFINITY, high]
}

/// Returns the band of `middle` give or take `by`.
pub const fn around(middle: f64, by: f64) -> [f64; 2] {
    [middle - by, middle + by]
}
