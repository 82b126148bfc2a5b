//! Defines how often stains advance.

/// Number of ticks per unit age: stains advance, and their display follows, this often.
///
/// Stains change slowly, so they need not advance in every step of the film. A film whose steps are longer than a tick
/// advances its stains in every step.
///
/// ```
/// use bevy_coating::stain::TICKS_PER_AGE;
///
/// let tick = 1.0 / TICKS_PER_AGE as f32;
/// assert_eq!(tick, 0.01, "the age between two ticks");
/// ```
pub const TICKS_PER_AGE: u64 = 100;
