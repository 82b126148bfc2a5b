//! Describes one place of a film or of the metal under it.

use bevy_math::{Affine3A, Vec3};

use super::{covers, triangle, view::FilmView};
use crate::{
    film::{FaceId, VertexId},
    stain::StainLayer,
};

/// Side or material that a place shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FilmSurface {
    /// Front of the paint.
    Paint,
    /// Back of paint that has come off, seen from below: the primer.
    Primer,
    /// Metal of which rust covers less than half.
    BareMetal,
    /// Metal of which rust covers at least half.
    RustedMetal,
}

impl FilmSurface {
    /// Returns whether it is metal, and not a side of the film.
    pub fn is_metal(self) -> bool {
        matches!(self, Self::BareMetal | Self::RustedMetal)
    }
}

/// One place of a film, or of the metal that a film has left bare.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FilmPoint {
    /// Side of the film or state of the metal that is there.
    pub surface: FilmSurface,
    /// Face of the film at the place; for metal the face that lay or lies over it.
    pub face: FaceId,
    /// Barycentric coordinates of the place in the three corners of the face: 0 or more, with the sum 1.
    pub barycentric: Vec3,
    /// Position of the place as it is now.
    pub position: Vec3,
    /// Position of the place at rest. Metal is always at rest.
    pub rest_position: Vec3,
    /// Normal of the face on the side that is seen: the front of paint and metal, the back of primer. It has unit
    /// length, or is zero where a face without area leaves none.
    pub normal: Vec3,
    /// Distance from the point or from the origin of the ray that was asked about.
    pub distance: f32,
    /// Whether film that holds on to the metal is there: at least half of the place, by its barycentric coordinates,
    /// belongs to corners that have not separated. False for metal.
    pub attached: bool,
    /// Moisture, from 0 (dry) to 1 (wet).
    pub wetness: f32,
    /// Dust and soot, from 0 (clean) to 1 (black).
    pub dust: f32,
    /// Share of the place that run-off rust covers, from 0 to 1: 1 - exp(-3 layers) (VC 6.1).
    pub rust_stain: f32,
    /// Share of the place that rusted metal covers, from 0 to 1; 0 on film.
    pub rusted: f32,
}

impl FilmPoint {
    /// Returns the point as it is in a space into which `place` turns the film's space. `place` may rotate, move and
    /// scale evenly, but not shear; where it cannot be turned back, the normal becomes zero.
    ///
    /// ```
    /// use bevy_coating::{remesh::sample, settings::CoatingSettings, sim::FilmState};
    /// use bevy_math::{Affine3A, Vec3};
    ///
    /// let piece = sample::plate(100, 7)?;
    /// let film = FilmState::new(&piece.film, &CoatingSettings::default(), 7, 100).expect("a plate is a manifold");
    /// let point = film.view().nearest(Vec3::Z, 2.0).expect("the plate is near");
    /// // Centimetres, a hundred to the metre.
    /// let there = point.placed(&Affine3A::from_scale(Vec3::splat(100.0)));
    /// assert_eq!((there.distance, there.normal), (100.0, Vec3::Z));
    /// # Ok::<(), bevy_coating::surface::BuildError>(())
    /// ```
    pub fn placed(self, place: &Affine3A) -> Self {
        Self {
            position: place.transform_point3(self.position),
            rest_position: place.transform_point3(self.rest_position),
            normal: place.transform_vector3(self.normal).normalize_or_zero(),
            distance: self.distance * scale_of(place),
            ..self
        }
    }
}

/// Returns the factor by which `place` stretches lengths.
fn scale_of(place: &Affine3A) -> f32 {
    place.matrix3.x_axis.length()
}

impl FilmView<'_> {
    /// Describes a place of the film as it is now, seen from the front or from the `back`.
    pub(super) fn film_point(
        &self,
        face: FaceId,
        corners: [VertexId; 3],
        barycentric: Vec3,
        back: bool,
        distance: f32,
    ) -> FilmPoint {
        let (now, rest) = (self.now(corners), self.at_rest(corners));
        let front = triangle::normal(now);
        let weights = barycentric.to_array();
        let held: f32 = (0..3).filter(|&i| !self.has_separated(corners[i])).map(|i| weights[i]).sum();
        let surface = if back { FilmSurface::Primer } else { FilmSurface::Paint };
        let [wetness, dust, rust_stain] = stains(&self.stains.film, corners, barycentric);
        FilmPoint {
            surface,
            face,
            barycentric,
            position: triangle::at(now, barycentric),
            rest_position: triangle::at(rest, barycentric),
            normal: if back { -front } else { front },
            distance,
            attached: held >= 0.5,
            wetness,
            dust,
            rust_stain,
            rusted: 0.0,
        }
    }

    /// Describes a place of the metal.
    pub(super) fn metal_point(
        &self,
        face: FaceId,
        corners: [VertexId; 3],
        barycentric: Vec3,
        distance: f32,
    ) -> FilmPoint {
        let rest = self.at_rest(corners);
        let originals = self.metal(corners);
        let position = triangle::at(rest, barycentric);
        let rusted = covers::rusted(Self::blend(&self.stains.corrosion, originals, barycentric));
        let [wetness, dust, rust_stain] = stains(&self.stains.metal, originals, barycentric);
        FilmPoint {
            surface: if rusted >= 0.5 { FilmSurface::RustedMetal } else { FilmSurface::BareMetal },
            face,
            barycentric,
            position,
            rest_position: position,
            normal: triangle::normal(rest),
            distance,
            attached: false,
            wetness,
            dust,
            rust_stain,
            rusted,
        }
    }
}

/// Returns moisture, dust and the cover of run-off rust at a place of a layer.
fn stains(layer: &StainLayer, corners: [VertexId; 3], at: Vec3) -> [f32; 3] {
    let blend = |values: &[f32]| FilmView::blend(values, corners, at);
    let rust = blend(&layer.wet) + blend(&layer.stained);
    [blend(&layer.moisture), blend(&layer.dust), covers::stained(rust)]
}
