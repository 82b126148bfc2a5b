//! Measures what a film lost of its prop's shape.

use bevy_math::{DVec3, Vec3};

use super::film::BuiltFilm;
use crate::{
    rest::Rest,
    surface::{BuildWarning, CleanSurface, twins_in_pieces},
};

/// Change of area above which there is a warning, in percent.
const AREA: f64 = 3.0;
/// Change of the enclosed volume above which there is a warning, in percent.
const VOLUME: f64 = 8.0;

/// Least volume of a solid, over its area to the power of 3/2.
const THINNEST: f64 = 1e-7;

/// Area and enclosed volume of triangles.
#[derive(Clone, Copy, Default)]
struct Measure {
    area: f64,
    volume: f64,
}

impl Measure {
    fn of(positions: &[Vec3], triangles: &[[u32; 3]]) -> Self {
        let point = |v: u32| positions.get(v as usize).map(|p| p.as_dvec3()).unwrap_or_default();
        let origin = triangles.first().map_or(DVec3::ZERO, |t| point(t[0]));
        let mut measure = Self::default();
        for t in triangles {
            let [a, b, c] = t.map(|v| point(v) - origin);
            measure.area += 0.5 * (b - a).cross(c - a).length();
            measure.volume += a.dot(b.cross(c)) / 6.0;
        }
        measure
    }
}

/// Changes from a surface to its film, in percent.
#[derive(Clone, Copy, Debug)]
pub(super) struct ShapeLoss {
    area: f64,
    /// Change of the enclosed volume, if the surface is closed.
    volume: Option<f64>,
}

impl ShapeLoss {
    /// Measures the film.
    pub async fn of(clean: &CleanSurface, film: &BuiltFilm, rest: &mut impl Rest) -> Self {
        let before = Measure::of(&clean.positions, &clean.triangles);
        let after = Measure::of(&film.positions, &film.triangles);
        let percent = |before: f64, after: f64| 100.0 * (after - before) / before.abs().max(f64::MIN_POSITIVE);
        // The volume of a sheet with two sides is nothing but rounding.
        let is_solid = before.volume.abs() > THINNEST * before.area * before.area.sqrt();
        rest.rest().await;
        let is_closed = is_solid && !twins_in_pieces(&clean.triangles, rest).await.contains(&u32::MAX);
        let volume = is_closed.then(|| percent(before.volume, after.volume));
        Self { area: percent(before.area, after.area), volume }
    }

    /// Returns the change over the one from which there is a warning.
    pub fn excess(self) -> f64 {
        (self.area.abs() / AREA).max(self.volume.unwrap_or_default().abs() / VOLUME)
    }

    /// Returns a warning if the change is large. Both errors shrink with the square of the edge, so with the number of
    /// triangles.
    pub fn warning(self, target: u32) -> Option<BuildWarning> {
        let excess = self.excess();
        (excess > 1.0).then(|| BuildWarning::ShapeCoarse {
            target,
            area: self.area as f32,
            volume: self.volume.map(|volume| volume as f32),
            triangles: (excess * f64::from(target)).ceil() as u32,
        })
    }
}
