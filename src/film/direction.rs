//! Makes directions of vectors of any length.

use bevy_math::Vec3;

/// Returns the unit vector along `v`, which may have any length; zero if `v` is zero or not finite. A unit vector keeps
/// its bits.
pub(crate) fn unit_or_zero(v: Vec3) -> Vec3 {
    let largest = v.abs().max_element();
    if v.is_normalized() {
        v
    } else if v.is_finite() && largest > 0.0 {
        // Squares of very long and very short vectors leave the range of floats.
        (v / largest).normalize_or_zero()
    } else {
        Vec3::ZERO
    }
}
