//! The grain: one length by which cracks, relief and curls are measured on every film.

use super::geometry::Geometry;

/// Mean edge of the coarsest film on which the grain that is asked for still shows, in grains.
const COARSEST: f32 = 2.0;

/// Length by which fracture and curls are measured: the scale of cracks and flakes, whatever the triangles.
///
/// On a film whose mean edge is the grain the paper's rules, which count in triangles, give much the same look.
///
/// ```
/// use bevy_coating::film::{Geometry, Grain, Topology};
/// use bevy_math::Vec3;
///
/// let topology = Topology::from_triangles(3, &[[0, 1, 2]])?;
/// let film = Geometry::at_rest(&topology, vec![Vec3::ZERO, 3.0 * Vec3::X, 4.0 * Vec3::Y]);
/// assert_eq!(Grain::of_film(&film, 2.5).length, 2.5);
/// // Its edges are 4 in the mean: cracks of a finer grain than 2 cannot be told apart on it.
/// assert_eq!(Grain::of_film(&film, 0.1).length, 2.0);
/// # Ok::<(), bevy_coating::film::TopologyError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grain {
    /// Length of the grain, in units of the film's space.
    pub length: f32,
}

impl Grain {
    /// Returns the grain of a film for which `asked` is asked, in units of the film's space: larger where the film is
    /// too coarse for it, that is where its mean edge is more than twice as long.
    pub fn of_film(geometry: &Geometry, asked: f32) -> Self {
        let finest = geometry.mean_edge / COARSEST;
        Self { length: if asked > finest { asked } else { finest } }
    }

    /// Returns the area of an equilateral triangle whose edges are as long as the grain, in square units of the film's
    /// space.
    pub fn face_area(self) -> f32 {
        self.length * self.length * (3f32.sqrt() * 0.25)
    }

    /// Returns how many times as long the grain is as the mean edge of a film; 1 where the film has no extent.
    pub fn in_edges(self, geometry: &Geometry) -> f32 {
        let ratio = self.length / geometry.mean_edge;
        if ratio.is_finite() && ratio > 0.0 { ratio } else { 1.0 }
    }
}
