//! Ranges of what can be asked for.

use std::ops::RangeInclusive;

use crate::remesh;

/// Greatest age that [`bake`](super::bake()) ages to.
pub const MAX_AGE: f64 = 100.0;
/// Most steps per unit age that [`bake`](super::bake()) takes.
pub const MAX_STEPS_PER_AGE: u32 = 1_000_000;
/// Most triangles that can be asked for, of films and of test pieces.
pub const MAX_TRIANGLES: u32 = remesh::MAX_FILM_TRIANGLES as u32;
/// Least and most metres that a unit of a model is long.
pub const UNITS: RangeInclusive<f32> = 1e-4..=1e4;
/// Least and most texels along the side of a texture.
pub const TEXTURE_SIZES: RangeInclusive<u32> = 64..=8192;
