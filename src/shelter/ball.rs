//! Encloses films and shelters in balls, and tells which films a shelter may keep dry.

use bevy::math::{Affine3A, Vec3};

use crate::stain::exposure::SPREAD;

/// Share by which radii are enlarged, so that rounding never leaves anything out.
const SLACK: f32 = 1e-4;

/// Ball around a film or a shelter, in the world.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Ball {
    pub center: Vec3,
    pub radius: f32,
}

impl Ball {
    /// Returns a ball around the box from `min` to `max`, transformed by `place`. `None` if `place` is not finite or
    /// cannot be inverted.
    pub fn around((min, max): (Vec3, Vec3), place: &Affine3A) -> Option<Self> {
        if !(place.is_finite() && place.inverse().is_finite()) {
            return None;
        }
        // No less than half the diagonal of the transformed box.
        let (axes, size) = (place.matrix3, (max - min) / 2.0);
        let radius = axes.x_axis.length() * size.x + axes.y_axis.length() * size.y + axes.z_axis.length() * size.z;
        Some(Self { center: place.transform_point3((min + max) / 2.0), radius })
    }

    /// Returns a ball around both.
    pub fn join(self, other: Self) -> Self {
        let apart = other.center - self.center;
        let distance = apart.length();
        if distance + other.radius <= self.radius {
            return self;
        }
        if distance + self.radius <= other.radius {
            return other;
        }
        let radius = 0.5 * (distance + self.radius + other.radius);
        let center = self.center + apart * ((radius - self.radius) / distance);
        Self { center, radius: radius * (1.0 + SLACK) }
    }

    /// Returns whether something in this ball may hold off rays towards `up`, a unit vector, from something in the ball
    /// `film`. Rays spread by [`SPREAD`].
    ///
    /// If it is true of two balls, it is true of all balls around them, so whole branches of a tree can be left out.
    pub fn may_shelter(&self, film: &Self, up: Vec3) -> bool {
        let apart = self.center - film.center;
        let radii = (self.radius + film.radius) * (1.0 + SLACK) + SLACK * SLACK * apart.length();
        let along = apart.dot(up);
        let aside = (apart - up * along).length();
        along >= -radii && aside <= radii + SPREAD * (along + radii)
    }
}
