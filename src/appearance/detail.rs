//! How finely a film is shown.

#[cfg(feature = "plugin")]
use bevy::reflect::prelude::*;

use crate::film::FaceGrid;

/// Highest [`Detail::chips`] and [`Detail::thickness`], in grains.
const MOST: f64 = 1.0;
/// Highest [`Detail::tolerance`], in mean edges. As `f32` has it.
const MOST_TOLERANCE: f64 = 0.1_f32 as f64;
/// Highest [`Detail::pixels`].
const MOST_PIXELS: f64 = 100.0;
/// Share of [`Detail::pixels`] below which the distance must fall before a film is shown at a lower level, so that one
/// whose distance wavers does not change its level to and fro.
const CALM: f32 = 0.6;
/// Radius of a tight curl, in edges of the film: what curls tighter than that folds.
const CURL: f32 = 1.0;

/// How finely a film is shown, whatever it is simulated with (VC 8).
///
/// ```
/// use bevy_coating::appearance::Detail;
///
/// assert_eq!(Detail::default().level, 0, "as the film is simulated");
/// let close = Detail { level: 2, ..Detail::default() };
/// assert_eq!(close.triangles(4000), 64_000);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(
    feature = "plugin",
    derive(Reflect),
    reflect(Default, Debug, Clone, PartialEq),
    type_path = "bevy_coating::appearance"
)]
pub struct Detail {
    /// Finest level: each face is shown by 4^level triangles. 0 to 4, default 0. At 0 faces are flat and edges straight
    /// and without thickness.
    pub level: u32,
    /// Largest distance between a curl and the triangles that show it in an image, in pixels: 0 to 100, default 0.5. A
    /// film that is far from all cameras is shown at a lower level, as long as the distance would be no larger. At 0,
    /// and without cameras, it is always shown at the finest level.
    pub pixels: f32,
    /// Amplitude of the chips along torn edges, in grains: 0 to 1, default 0.25. At 0 outlines follow the film's edges.
    /// However large it is, a chip takes no more than about a third of a face.
    pub chips: f32,
    /// Thickness of the paint, in grains: 0 to 1, default 0.03, which is 0.8 mm at the default grain.
    pub thickness: f32,
    /// Largest distance along each axis at which a vertex of the film may be shown beside where it is, in mean edges of
    /// the film: 0 to 0.1, default 0. Paint that curls slowly is then shown again every few steps instead of after
    /// each: at 0.01, which few images can tell, half as much or less is shown again. Small moves add up, so that paint
    /// never lies further beside. At 0 every move is shown.
    pub tolerance: f32,
}

impl Default for Detail {
    fn default() -> Self {
        Self { level: 0, pixels: 0.5, chips: 0.25, thickness: 0.03, tolerance: 0.0 }
    }
}

impl Detail {
    /// Returns the number of triangles by which a film of `faces` faces is shown.
    pub fn triangles(&self, faces: usize) -> usize {
        faces << (2 * self.level.min(FaceGrid::MOST))
    }

    /// Returns the level at which to show a film that is shown at `level` now, with edges of `edge` pixels in the
    /// nearest image.
    ///
    /// A chord of length e across a curl of radius r lies e^2 / 8r beside it, and each level halves e.
    ///
    /// ```
    /// use bevy_coating::appearance::Detail;
    ///
    /// let detail = Detail { level: 3, ..Detail::default() };
    /// assert_eq!(detail.level_at(100.0, 0), 3, "near");
    /// assert_eq!(detail.level_at(10.0, 0), 1);
    /// assert_eq!(detail.level_at(3.0, 0), 0, "far away");
    /// // It becomes coarser a little later than it became finer.
    /// assert_eq!([detail.level_at(3.9, 1), detail.level_at(2.0, 1)], [1, 0]);
    /// ```
    pub fn level_at(&self, edge: f32, level: u32) -> u32 {
        if !(self.pixels > 0.0) {
            return self.level;
        }
        let beside = |level: u32| edge / (8.0 * CURL) / (1u32 << (2 * level.min(FaceGrid::MOST))) as f32;
        let least = |most: f32| (0..self.level).find(|&level| beside(level) <= most).unwrap_or(self.level);
        // Both ends of the range in which the level may stay.
        level.clamp(least(self.pixels), least(self.pixels * CALM))
    }

    /// Returns the first field that is out of its range: its path from the owner of this, its value, and its range in
    /// words.
    ///
    /// ```
    /// use bevy_coating::appearance::Detail;
    ///
    /// assert_eq!(Detail::default().out_of_range(), None);
    /// let deep = Detail { level: 5, ..Detail::default() };
    /// assert_eq!(deep.out_of_range(), Some(("detail.level", 5.0, "0 to 4")));
    /// ```
    pub fn out_of_range(&self) -> Option<(&'static str, f64, &'static str)> {
        let fields = [
            ("detail.level", f64::from(self.level), f64::from(FaceGrid::MOST), "0 to 4"),
            ("detail.pixels", f64::from(self.pixels), MOST_PIXELS, "0 to 100"),
            ("detail.chips", f64::from(self.chips), MOST, "0 to 1"),
            ("detail.thickness", f64::from(self.thickness), MOST, "0 to 1"),
            ("detail.tolerance", f64::from(self.tolerance), MOST_TOLERANCE, "0 to 0.1"),
        ];
        let found = fields.into_iter().find(|(_, found, most, _)| !(0.0..=*most).contains(found));
        found.map(|(path, found, _, range)| (path, found, range))
    }
}
