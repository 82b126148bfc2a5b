//! Sums up what lies in a sphere.

use std::f64::consts::PI;

use bevy_math::Vec3;

use super::{
    area::FilmArea,
    covers,
    point::FilmPoint,
    shares::share,
    triangle,
    view::{Face, FilmView},
};
use crate::film::VertexId;

/// Fewest and most parts into which the sides of a face that is partly in a sphere are cut.
const CUTS: (f32, f32) = (4.0, 32.0);

impl FilmView<'_> {
    /// Returns what lies within `radius` of `centre`: film where it is now, and the metal that removed faces have left
    /// bare. `None` if there is nothing.
    ///
    /// Faces that are only partly in the sphere are sampled, with errors of a few percent of such a face. Where the
    /// sphere is so small that it falls between samples, the place nearest to its centre stands for it, with the area
    /// of a disc.
    ///
    /// A centre or a radius that is not finite, and a radius below 0, find nothing.
    ///
    /// ```
    /// use bevy_coating::{remesh::sample, settings::CoatingSettings, sim::FilmState};
    /// use bevy_math::Vec3;
    ///
    /// let piece = sample::plate(400, 7)?;
    /// let film = FilmState::new(&piece.film, &CoatingSettings::default(), 7, 100).expect("a plate is a manifold");
    /// let hand = film.view().in_sphere(Vec3::new(0.1, 0.1, 0.0), 0.1).expect("it lies on the plate");
    /// assert!((hand.area / (std::f64::consts::PI * 0.01) - 1.0).abs() < 0.02);
    /// assert!((hand.paint, hand.loose, hand.bare) == (1.0, 0.0, 0.0));
    /// # Ok::<(), bevy_coating::surface::BuildError>(())
    /// ```
    pub fn in_sphere(&self, centre: Vec3, radius: f32) -> Option<FilmArea> {
        if !(centre.is_finite() && radius.is_finite() && radius >= 0.0) {
            return None;
        }
        let mut sums = Sums::default();
        let square = radius * radius;
        let sides = self.sides_of_box(centre, square);
        for (face, corners) in self.places_near(&sides) {
            let [a, b, c] = corners;
            let beside = (a.min(b).min(c) - centre).max(centre - a.max(b).max(c)).max(Vec3::ZERO);
            if beside.length_squared() > square {
                continue;
            }
            let [a, b, c] = self.at_rest(face.corners);
            let area = f64::from((b - a).cross(c - a).length_squared().sqrt() * 0.5);
            let is_in = |p: Vec3| p.distance_squared(centre) <= square;
            let is_whole = is_in(corners[0]) && is_in(corners[1]) && is_in(corners[2]);
            let cuts = if is_whole { 1 } else { cuts(corners, radius) };
            let part = area / f64::from(cuts * cuts);
            let values = self.corner_values(face);
            for_middles(cuts, |at| {
                if is_in(triangle::at(corners, at)) {
                    sums.add(&values.at(at), part);
                }
            });
        }
        if sums.area == 0.0 {
            let place = self.nearest(centre, radius)?;
            sums.add(&Sample::from(&place), PI * f64::from(square));
        }
        Some(sums.finish())
    }

    /// Returns the values at the corners of a face: of the film, or of the metal where it is gone.
    fn corner_values(&self, face: Face) -> CornerValues {
        let Face { corners, live, .. } = face;
        let [a, b, c] = corners;
        let (layer, [d, e, f]) =
            if live { (&self.stains.film, corners) } else { (&self.stains.metal, self.metal(corners)) };
        let held = |v: VertexId| if self.has_separated(v) { 0.0 } else { 1.0 };
        let value = |values: &[f32], v: VertexId| values.get(v.index()).copied().unwrap_or_default();
        let of = |values: &[f32]| Vec3::new(value(values, d), value(values, e), value(values, f));
        CornerValues {
            live,
            held: Vec3::new(held(a), held(b), held(c)),
            corrosion: if live { Vec3::ZERO } else { of(&self.stains.corrosion) },
            wet: of(&layer.wet),
            stained: of(&layer.stained),
            moisture: of(&layer.moisture),
            dust: of(&layer.dust),
        }
    }
}

/// What a face shows at its corners, read once for all samples of the face.
struct CornerValues {
    live: bool,
    /// Whether the metal holds each corner: 1 or 0.
    held: Vec3,
    corrosion: Vec3,
    wet: Vec3,
    stained: Vec3,
    moisture: Vec3,
    dust: Vec3,
}

impl CornerValues {
    /// Returns the place with these barycentric coordinates.
    #[inline]
    fn at(&self, barycentric: Vec3) -> Sample {
        let blend = |values: Vec3| values.dot(barycentric);
        let held = blend(self.held);
        Sample {
            bare: !self.live,
            attached: self.live && held >= 0.5,
            rusted: if self.live { 0.0 } else { covers::rusted(blend(self.corrosion)) },
            wetness: blend(self.moisture),
            dust: blend(self.dust),
            rust_stain: covers::stained(blend(self.wet) + blend(self.stained)),
        }
    }
}

/// What of a place counts: see [`FilmPoint`], of which these are fields.
pub(super) struct Sample {
    bare: bool,
    attached: bool,
    rusted: f32,
    wetness: f32,
    dust: f32,
    rust_stain: f32,
}

impl From<&FilmPoint> for Sample {
    fn from(place: &FilmPoint) -> Self {
        Self {
            bare: place.surface.is_metal(),
            attached: place.attached,
            rusted: place.rusted,
            wetness: place.wetness,
            dust: place.dust,
            rust_stain: place.rust_stain,
        }
    }
}

/// Returns into how many parts to cut the sides of a triangle, so that samples lie about half a radius apart.
pub(super) fn cuts([a, b, c]: [Vec3; 3], radius: f32) -> u32 {
    let longest = a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a)).sqrt();
    // A radius of 0 gives an infinite number or NaN, which the bounds and the conversion take care of.
    (2.0 * longest / radius).ceil().clamp(CUTS.0, CUTS.1) as u32
}

/// Calls `with` for the middles of the equal triangles into which a triangle falls when its sides are cut into `n`
/// parts. A function and no iterator: nested iterators are not compiled into one loop.
#[inline]
pub(super) fn for_middles(n: u32, mut with: impl FnMut(Vec3)) {
    let whole = n as f32;
    let mut middle = |i: u32, j: u32, third: f32| {
        let (v, w) = ((i as f32 + third) / whole, (j as f32 + third) / whole);
        with(Vec3::new(1.0 - v - w, v, w));
    };
    for j in 0..n {
        for i in 0..n - j {
            middle(i, j, 1.0 / 3.0);
            if i + j + 1 < n {
                middle(i, j, 2.0 / 3.0);
            }
        }
    }
}

/// Sums over places, each times its area.
#[derive(Default)]
pub(super) struct Sums {
    pub area: f64,
    loose: f64,
    bare: f64,
    rusted: f64,
    wetness: f64,
    dust: f64,
    rust_stain: f64,
}

impl Sums {
    pub fn add(&mut self, place: &Sample, area: f64) {
        self.area += area;
        if place.bare {
            self.bare += area;
        } else if !place.attached {
            self.loose += area;
        }
        self.rusted += area * f64::from(place.rusted);
        self.wetness += area * f64::from(place.wetness);
        self.dust += area * f64::from(place.dust);
        self.rust_stain += area * f64::from(place.rust_stain);
    }

    pub fn finish(&self) -> FilmArea {
        let of = |part: f64| share(part, self.area);
        FilmArea {
            area: self.area,
            paint: of(self.area - self.bare),
            loose: of(self.loose),
            bare: of(self.bare),
            rusted: of(self.rusted),
            wetness: of(self.wetness),
            dust: of(self.dust),
            rust_stain: of(self.rust_stain),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn middles_cover_a_triangle_evenly() {
        for n in [1, 2, 5] {
            let mut all = Vec::new();
            for_middles(n, |at| all.push(at));
            assert_eq!(all.len(), (n * n) as usize);
            assert!(all.iter().all(|at| at.min_element() > 0.0 && (at.element_sum() - 1.0).abs() < 1e-6));
            let mean = all.iter().sum::<Vec3>() / (n * n) as f32;
            assert!(mean.abs_diff_eq(Vec3::splat(1.0 / 3.0), 1e-6), "{mean}");
        }
    }

    #[test]
    fn a_sphere_without_extent_is_cut_into_few_parts() {
        let corners = [Vec3::ZERO, Vec3::X, Vec3::Y];
        assert_eq!([cuts(corners, 0.0), cuts(corners, 0.2), cuts(corners, 9.0)], [32, 15, 4]);
        assert!(cuts([Vec3::ZERO; 3], 0.0) <= 32);
    }
}
