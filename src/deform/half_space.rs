//! Contact with the metal: no vertex goes below the plane through its rest position.

use bevy_math::Vec3;

/// Returns `p`, or the nearest point to it on the plane through `rest` if `p` lies below (VC 5). There is no other
/// contact. `normal` is the unit normal at rest.
#[inline]
pub fn above_plane(p: Vec3, rest: Vec3, normal: Vec3) -> Vec3 {
    let height = (p - rest).dot(normal);
    if height < 0.0 { p - height * normal } else { p }
}
