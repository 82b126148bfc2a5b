//! Measures what a film lost of its prop's shape.

use bevy_math::{DVec3, Vec3};

use super::film::BuiltFilm;
use crate::surface::{BuildWarning, CleanSurface, twins};

/// Change of area above which there is a warning, in percent.
const AREA: f64 = 3.0;
/// Change of the enclosed volume above which there is a warning, in percent.
const VOLUME: f64 = 8.0;

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

/// Returns a warning if the film's area, or the volume inside, differs much from that of the surface.
///
/// Both errors shrink with the square of the edge, so with the number of triangles.
pub(super) fn shape_loss(clean: &CleanSurface, film: &BuiltFilm, target: u32) -> Option<BuildWarning> {
    let before = Measure::of(&clean.positions, &clean.triangles);
    let after = Measure::of(&film.positions, &film.triangles);
    let percent = |before: f64, after: f64| 100.0 * (after - before) / before.abs().max(f64::MIN_POSITIVE);
    let area = percent(before.area, after.area);
    let is_closed = !twins(&clean.triangles).contains(&u32::MAX);
    let volume = if is_closed { percent(before.volume, after.volume) } else { 0.0 };
    let excess = (area.abs() / AREA).max(volume.abs() / VOLUME);
    (excess > 1.0).then(|| BuildWarning::ShapeCoarse {
        target,
        area: area as f32,
        volume: volume as f32,
        triangles: (excess * f64::from(target)).ceil() as u32,
    })
}
