//! Moves a surface that lies far from its origin to it, so that rounding hurts neither cleaning nor remeshing.

use bevy_math::Vec3;

use super::film::BuiltFilm;
use crate::surface::{BuildError, Surface};

/// Smallest and largest size of a surface, in metres. Between them no product of lengths leaves single precision.
const SIZES: [f64; 2] = [1e-4, 1e6];
/// Distance from the origin, over the size, from which a surface is moved. Nearer ones are computed where they are, as
/// moving them would change their bits and gain little.
const FAR: f64 = 16.0;
/// Smallest mean edge of a film, in steps of single precision at its place.
const LEAST_STEPS: f32 = 16.0;

/// Place in which a film is built.
pub(super) struct Frame {
    /// Middle of the surface if it is far from its origin, or zero. Coordinates of the surface less these are exact.
    middle: Vec3,
}

impl Frame {
    /// Measures the positions that triangles use. Those that are missing or not finite are left to cleaning.
    ///
    /// # Errors
    /// [`BuildError::Size`].
    pub fn of(surface: &Surface) -> Result<Self, BuildError> {
        let (mut low, mut high) = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        for &v in surface.triangles.iter().flatten() {
            if let Some(p) = surface.positions.get(v as usize).filter(|p| p.is_finite()) {
                (low, high) = (low.min(*p), high.max(*p));
            }
        }
        let (low, high) = (low.as_dvec3(), high.as_dvec3());
        let size = (high - low).max_element();
        // Without any extent there is no triangle, which cleaning reports.
        if size.is_finite() && size > 0.0 && !(SIZES[0]..=SIZES[1]).contains(&size) {
            return Err(BuildError::Size { size, least: SIZES[0], most: SIZES[1] });
        }
        let middle = 0.5 * (low + high);
        let is_far = size.is_finite() && middle.abs().max_element() > FAR * size;
        Ok(Self { middle: if is_far { middle.as_vec3() } else { Vec3::ZERO } })
    }

    /// Returns the surface around zero if it is far from its origin.
    pub fn enter(&self, surface: &Surface) -> Option<Surface> {
        (self.middle != Vec3::ZERO).then(|| {
            let positions = surface.positions.iter().map(|&p| p - self.middle).collect();
            Surface { positions, ..surface.clone() }
        })
    }

    /// Returns where a point of the surface is in the frame.
    pub fn inside(&self, p: Vec3) -> Vec3 {
        p - self.middle
    }

    /// Returns where a point in the frame is in the surface's own space.
    pub fn outside(&self, p: Vec3) -> Vec3 {
        p + self.middle
    }

    /// Returns the film at the surface's own place.
    ///
    /// # Errors
    /// [`BuildError::FarFromOrigin`].
    pub fn leave(&self, mut film: BuiltFilm) -> Result<BuiltFilm, BuildError> {
        if self.middle == Vec3::ZERO {
            return Ok(film);
        }
        let distance = film.positions.iter().fold(0.0, |d: f32, &p| d.max((p + self.middle).abs().max_element()));
        let rounding = distance.next_up() - distance;
        let edge = mean_edge(&film);
        if edge < LEAST_STEPS * rounding {
            return Err(BuildError::FarFromOrigin { distance, rounding, edge });
        }
        for p in &mut film.positions {
            *p += self.middle;
        }
        Ok(film)
    }
}

fn mean_edge(film: &BuiltFilm) -> f32 {
    let point = |v: u32| film.positions.get(v as usize).copied().unwrap_or_default();
    let perimeter = |&[a, b, c]: &[u32; 3]| {
        let [a, b, c] = [a, b, c].map(point);
        f64::from(a.distance(b) + b.distance(c) + c.distance(a))
    };
    (film.triangles.iter().map(perimeter).sum::<f64>() / (3 * film.triangles.len().max(1)) as f64) as f32
}
