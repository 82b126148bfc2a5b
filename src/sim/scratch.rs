//! Holds the buffers of a step.

use crate::{deform::BendScratch, fracture::FractureScratch};

/// Buffers of a step, kept between steps so that a step need not allocate. Their contents do not change any result, so
/// a film may start with the default at any time.
#[derive(Clone, Debug, Default)]
#[cfg_attr(feature = "plugin", derive(bevy::ecs::component::Component), component(clone_behavior = Ignore))]
pub struct StepScratch {
    /// Buffers of tearing and stripping.
    pub fracture: FractureScratch,
    /// Buffers of bending, and the instruction set that it uses.
    pub bend: BendScratch,
}
