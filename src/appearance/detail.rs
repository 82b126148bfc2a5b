//! How finely a film is shown.

#[cfg(feature = "plugin")]
use bevy::reflect::prelude::*;

use crate::film::FaceGrid;

/// Highest [`Detail::chips`] and [`Detail::thickness`], in grains.
const MOST: f64 = 1.0;

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
    /// Level: each face is shown by 4^level triangles. 0 to 4, default 0. At 0 faces are flat and edges straight and
    /// without thickness.
    pub level: u32,
    /// Amplitude of the chips along torn edges, in grains: 0 to 1, default 0.25. At 0 outlines follow the film's edges.
    /// However large it is, a chip takes no more than about a third of a face.
    pub chips: f32,
    /// Thickness of the paint, in grains: 0 to 1, default 0.03, which is 0.8 mm at the default grain.
    pub thickness: f32,
}

impl Default for Detail {
    fn default() -> Self {
        Self { level: 0, chips: 0.25, thickness: 0.03 }
    }
}

impl Detail {
    /// Returns the number of triangles by which a film of `faces` faces is shown.
    pub fn triangles(&self, faces: usize) -> usize {
        faces << (2 * self.level.min(FaceGrid::MOST))
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
            ("detail.chips", f64::from(self.chips), MOST, "0 to 1"),
            ("detail.thickness", f64::from(self.thickness), MOST, "0 to 1"),
        ];
        let found = fields.into_iter().find(|(_, found, most, _)| !(0.0..=*most).contains(found));
        found.map(|(path, found, _, range)| (path, found, range))
    }
}
