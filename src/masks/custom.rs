//! A mask that a function of the program gives.

use std::{fmt, sync::Arc};

use bevy_math::Vec3;

/// Function of a place and the unit normal there.
type Weigh = dyn Fn(Vec3, Vec3) -> f32 + Send + Sync;

/// Mask that a function gives. Clones share the function, and are equal to each other alone.
///
/// ```
/// use bevy_coating::masks::CustomMask;
/// use bevy_math::Vec3;
///
/// let top = CustomMask::new(|place, _| if place.y > 1.0 { 1.0 } else { 0.0 });
/// assert_eq!(top.weigh(Vec3::new(0.0, 2.0, 0.0), Vec3::Y), 1.0);
/// assert_eq!(top, top.clone());
/// ```
#[derive(Clone)]
pub struct CustomMask(Arc<Weigh>);

impl CustomMask {
    /// Creates a mask of `weigh`, which is given a place in the film's space, in metres, and the unit normal there. Its
    /// result is brought into 0 to 1; NaN counts as 0. It should return the same whenever it is asked the same, or
    /// films of one seed differ.
    pub fn new(weigh: impl Fn(Vec3, Vec3) -> f32 + Send + Sync + 'static) -> Self {
        Self(Arc::new(weigh))
    }

    /// Returns what the function gives for a place and a normal.
    pub fn weigh(&self, place: Vec3, normal: Vec3) -> f32 {
        (self.0)(place, normal)
    }
}

impl Default for CustomMask {
    /// Returns the mask that is 1 everywhere.
    fn default() -> Self {
        Self::new(|_, _| 1.0)
    }
}

impl PartialEq for CustomMask {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl fmt::Debug for CustomMask {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Different functions have different texts.
        write!(f, "CustomMask({:p})", Arc::as_ptr(&self.0))
    }
}
