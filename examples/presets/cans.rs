//! The cans: one for each preset, in a colour that such paint often has.

use crate::cli::Options;
use crate::common_scene::wall::PALE_GREEN;
use crate::rounded_box::{Shape, rounded_box};
use bevy::prelude::*;
use bevy_coating::prelude::*;

/// Half the size of a can, in metres.
pub const HALF: Vec3 = Vec3::new(0.24, 0.3, 0.14);
/// Rounding of its edges.
const ROUNDING: f32 = 0.025;
/// From can to can.
const COLUMN: f32 = 0.72;
const ROW: f32 = 0.96;
/// Number of cans in a row.
pub const COLUMNS: usize = 6;

/// Real paints below the paper's own, each with its colour.
const CANS: [(Preset, Color); 12] = [
    (Preset::Paper, PALE_GREEN),
    (Preset::FewCracks, PALE_GREEN),
    (Preset::Gentle, PALE_GREEN),
    (Preset::Default, PALE_GREEN),
    (Preset::Heavy, PALE_GREEN),
    (Preset::Harsh, PALE_GREEN),
    (Preset::FreshEnamel, Color::srgb(0.62, 0.08, 0.06)),
    (Preset::OldLeadPaint, Color::srgb(0.36, 0.46, 0.34)),
    (Preset::ChalkyWhitewash, Color::srgb(0.86, 0.84, 0.79)),
    (Preset::PowderCoat, Color::srgb(0.10, 0.25, 0.50)),
    (Preset::Marine, Color::srgb(0.24, 0.32, 0.38)),
    (Preset::DesertSun, Color::srgb(0.74, 0.62, 0.40)),
];

/// A can with its paint.
#[derive(Clone, Copy, Debug)]
pub struct Can {
    pub preset: Preset,
    pub color: Color,
    /// Its middle.
    pub place: Vec3,
    seed: u64,
}

/// All cans, row by row from the upper left.
pub fn cans() -> impl Iterator<Item = Can> {
    CANS.into_iter().enumerate().map(|(i, (preset, color))| {
        let (column, row) = (i % COLUMNS, i / COLUMNS);
        let x = (column as f32 - (COLUMNS as f32 - 1.0) / 2.0) * COLUMN;
        let place = Vec3::new(x, (0.5 - row as f32) * ROW, 0.0);
        Can { preset, color, place, seed: i as u64 }
    })
}

impl Can {
    /// Its paint, with the masks that belong to it.
    pub fn coating(&self, options: &Options) -> Coating {
        let coating = Coating::new(self.preset).with_seed(options.scene.seed.wrapping_add(self.seed));
        Coating { detail: options.scene.detail(options.level), ..coating }
    }
}

/// The shape of all cans, around zero.
pub fn shape() -> Shape {
    rounded_box(Vec3::ZERO, HALF, ROUNDING, 3)
}
