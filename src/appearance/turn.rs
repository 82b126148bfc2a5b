//! The smallest rotation between two directions, by which what lies on a face turns with it.

use bevy_math::{Mat3A, Vec3, Vec3A};

/// Rotation (1 - cosine) below which a face counts as not turned: its normals are then exactly the prop's.
const STILL: f32 = 1e-7;

/// Returns `v` scaled to unit length, or zero if its length is zero.
///
/// `Vec3::normalize` calls a library function for the square root where it is built for the same bits on every
/// platform. A square root is exact everywhere, so the processor's own is used here.
#[inline]
pub(super) fn unit(v: Vec3) -> Vec3 {
    let length = v.length_squared().sqrt();
    if length > 0.0 { v * (1.0 / length) } else { Vec3::ZERO }
}

/// Smallest rotation between two unit vectors with cross product `c`: `v + c x v + c x (c x v) / (1 + cosine)`.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Turn {
    cross: Vec3,
    /// `1 / (1 + cosine)`; 0 stands for no rotation.
    scale: f32,
}

impl Turn {
    /// Returns the rotation from `rest` to `now`, or none where it is below [`STILL`] or a vector is zero.
    pub fn between(rest: Vec3, now: Vec3) -> Self {
        let cosine = rest.dot(now);
        if cosine > 1.0 - STILL || rest == Vec3::ZERO || now == Vec3::ZERO {
            return Self::default();
        }
        // A face that was turned over has no unique smallest rotation; a half turn about any axis in its plane will do.
        if cosine < -0.9999 {
            let axis = rest.any_orthonormal_vector();
            return Self { cross: axis * 2e-2, scale: 5e3 };
        }
        Self { cross: rest.cross(now), scale: 1.0 / (1.0 + cosine) }
    }

    pub fn apply(self, v: Vec3) -> Vec3 {
        let once = self.cross.cross(v);
        v + once + self.cross.cross(once) * self.scale
    }

    pub fn is_still(self) -> bool {
        self.scale == 0.0
    }

    /// Returns the rotation as a matrix.
    pub fn matrix(self) -> Mat3A {
        let [x, y, z] = Vec3::AXES.map(|axis| Vec3A::from(self.apply(axis)));
        Mat3A::from_cols(x, y, z)
    }
}
