//! Packs: constraints that share no point, side by side, to be solved at once.
//!
//! A pack is 32 constraints wide whatever the machine, so that the order of solving is the same everywhere. Unused
//! lanes refer to the null point, which nothing moves.

use super::point::PointOffset;

/// Number of constraints in a pack.
pub const LANES: usize = 32;

/// Array of one value for each lane of a pack.
pub type PerLane<T> = [T; LANES];

/// Bend constraints as the sweeps read them.
#[derive(Clone, Debug, PartialEq)]
#[repr(C, align(64))]
pub struct BendPack {
    /// Ends of the edge and tips of the two wings: p1, p2, p3, p4.
    pub points: [PerLane<PointOffset>; 4],
    /// Cosine at which each wing rests: `skew cos(phi0 / 2)`.
    pub folds: [PerLane<f32>; 2],
    /// Square of each wing's median at rest.
    pub medians: [PerLane<f32>; 2],
}

/// Angles and shapes that the folds of a [`BendPack`] are made of.
#[derive(Clone, Debug, PartialEq)]
#[repr(C, align(64))]
pub struct BendTargets {
    /// Rest altitude over rest median of each wing, in 0..=1.
    pub skews: [PerLane<f32>; 2],
    /// Angle at which each constraint began, in radians.
    pub starts: PerLane<f32>,
    /// Target angle phi0 now, in radians.
    pub targets: PerLane<f32>,
    /// Share of what the settings say by which each target narrows.
    pub shares: PerLane<f32>,
}

/// Length constraints as the sweeps read them.
#[derive(Clone, Debug, PartialEq)]
#[repr(C, align(64))]
pub struct LengthPack {
    /// Two ends of the edge.
    pub points: [PerLane<PointOffset>; 2],
    /// Rest length.
    pub rest: PerLane<f32>,
}

impl BendPack {
    /// Pack of null constraints.
    pub const NULL: Self =
        Self { points: [[PointOffset::NULL; LANES]; 4], folds: [[0.0; LANES]; 2], medians: [[0.0; LANES]; 2] };
}

impl BendTargets {
    /// Pack of null constraints.
    pub const NULL: Self =
        Self { skews: [[0.0; LANES]; 2], starts: [0.0; LANES], targets: [0.0; LANES], shares: [1.0; LANES] };
}

impl LengthPack {
    /// Pack of null constraints.
    pub const NULL: Self = Self { points: [[PointOffset::NULL; LANES]; 2], rest: [0.0; LANES] };
}
