//! Defines the weight of a dihedral angle in the bending force (VC eq. 4).

use core::f32::consts::PI;

use bevy_math::ops;

/// Returns the weight S(phi) = 1 / (1 + exp(-`gamma` (`phi` - pi))) of an edge in the bending force (VC 5.1, eq. 4).
///
/// `phi` is the dihedral angle of the edge in radians: pi where the film is flat, above pi on a convex edge, below pi
/// in a valley. The weight lies between 0 and 1, is 1/2 on a flat film, and grows with convexity, the more steeply the
/// larger `gamma` (per radian; default of [`gamma`](crate::settings::BendingSettings::gamma): 2).
///
/// ```
/// use std::f32::consts::PI;
///
/// use bevy_coating::fracture::sigmoid;
///
/// assert_eq!(sigmoid(PI, 2.0), 0.5);
/// assert!(sigmoid(PI + 0.5, 2.0) > 0.7, "a ridge is lifted more strongly");
/// assert!(sigmoid(PI - 0.5, 2.0) < 0.3, "a valley less");
/// ```
pub fn sigmoid(phi: f32, gamma: f32) -> f32 {
    1.0 / (1.0 + ops::exp(-gamma * (phi - PI)))
}
