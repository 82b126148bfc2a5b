//! Sums up an area of a film.

use super::shares::share;

/// Contents of an area, of one film or of several together.
///
/// Shares and means are over all of the area, film and bare metal, each place counted by its area at rest.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FilmArea {
    /// Size of the area at rest, in square metres.
    pub area: f64,
    /// Share on which there is film, from 0 to 1.
    pub paint: f64,
    /// Share on which there is film that has come off the metal, from 0 to 1; part of [`paint`](Self::paint).
    pub loose: f64,
    /// Share of bare metal, from 0 to 1.
    pub bare: f64,
    /// Share of rusted metal, from 0 to 1; part of [`bare`](Self::bare).
    pub rusted: f64,
    /// Mean moisture, from 0 (dry) to 1 (wet).
    pub wetness: f64,
    /// Mean dust and soot, from 0 (clean) to 1 (black).
    pub dust: f64,
    /// Share that run-off rust covers, from 0 to 1.
    pub rust_stain: f64,
}

impl FilmArea {
    /// Returns both areas together.
    ///
    /// ```
    /// use bevy_coating::survey::FilmArea;
    ///
    /// let painted = FilmArea { area: 3.0, paint: 1.0, ..FilmArea::default() };
    /// let bare = FilmArea { area: 1.0, bare: 1.0, ..FilmArea::default() };
    /// assert_eq!(painted.merged(&bare), FilmArea { area: 4.0, paint: 0.75, bare: 0.25, ..FilmArea::default() });
    /// ```
    pub fn merged(&self, other: &Self) -> Self {
        let area = self.area + other.area;
        let mean = |of: fn(&Self) -> f64| share(of(self) * self.area + of(other) * other.area, area);
        Self {
            area,
            paint: mean(|a| a.paint),
            loose: mean(|a| a.loose),
            bare: mean(|a| a.bare),
            rusted: mean(|a| a.rusted),
            wetness: mean(|a| a.wetness),
            dust: mean(|a| a.dust),
            rust_stain: mean(|a| a.rust_stain),
        }
    }
}
