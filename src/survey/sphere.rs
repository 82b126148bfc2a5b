//! Sums up what lies in a sphere.

use std::f64::consts::PI;

use bevy_math::Vec3;

use super::{
    area::FilmArea,
    point::FilmPoint,
    shares::share,
    triangle,
    view::{Face, FilmView},
};

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
        for face in self.faces() {
            let corners = if face.live { self.now(face.corners) } else { self.at_rest(face.corners) };
            let [a, b, c] = corners;
            let beside = (a.min(b).min(c) - centre).max(centre - a.max(b).max(c)).max(Vec3::ZERO);
            if beside.length_squared() > square {
                continue;
            }
            let area = f64::from(self.mesh.geometry.rest_area_of(&self.mesh.topology, face.id));
            let is_in = |p: Vec3| p.distance_squared(centre) <= square;
            let cuts = if corners.into_iter().all(is_in) { 1 } else { cuts(corners, radius) };
            let part = area / f64::from(cuts * cuts);
            for at in middles(cuts).filter(|&at| is_in(triangle::at(corners, at))) {
                sums.add(&self.place(face, at), part);
            }
        }
        if sums.area == 0.0 {
            let place = self.nearest(centre, radius)?;
            sums.add(&place, PI * f64::from(square));
        }
        Some(sums.finish())
    }

    /// Describes a place of a face: of the film, or of the metal where it is gone.
    fn place(&self, face: Face, at: Vec3) -> FilmPoint {
        let Face { id, corners, live } = face;
        if live { self.film_point(id, corners, at, false, 0.0) } else { self.metal_point(id, corners, at, 0.0) }
    }
}

/// Returns into how many parts to cut the sides of a triangle, so that samples lie about half a radius apart.
fn cuts([a, b, c]: [Vec3; 3], radius: f32) -> u32 {
    let longest = a.distance_squared(b).max(b.distance_squared(c)).max(c.distance_squared(a)).sqrt();
    // A radius of 0 gives an infinite number or NaN, which the bounds and the conversion take care of.
    (2.0 * longest / radius).ceil().clamp(CUTS.0, CUTS.1) as u32
}

/// Returns the middles of the equal triangles into which a triangle falls when its sides are cut into `n` parts.
fn middles(n: u32) -> impl Iterator<Item = Vec3> {
    let whole = n as f32;
    (0..n).flat_map(move |j| {
        (0..n - j).flat_map(move |i| {
            let upright = Some(1.0 / 3.0);
            let inverted = (i + j + 1 < n).then_some(2.0 / 3.0);
            upright.into_iter().chain(inverted).map(move |third| {
                let (v, w) = ((i as f32 + third) / whole, (j as f32 + third) / whole);
                Vec3::new(1.0 - v - w, v, w)
            })
        })
    })
}

/// Sums over places, each times its area.
#[derive(Default)]
struct Sums {
    area: f64,
    loose: f64,
    bare: f64,
    rusted: f64,
    wetness: f64,
    dust: f64,
    rust_stain: f64,
}

impl Sums {
    fn add(&mut self, place: &FilmPoint, area: f64) {
        self.area += area;
        if place.surface.is_metal() {
            self.bare += area;
        } else if !place.attached {
            self.loose += area;
        }
        self.rusted += area * f64::from(place.rusted);
        self.wetness += area * f64::from(place.wetness);
        self.dust += area * f64::from(place.dust);
        self.rust_stain += area * f64::from(place.rust_stain);
    }

    fn finish(&self) -> FilmArea {
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
            let all: Vec<Vec3> = middles(n).collect();
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
