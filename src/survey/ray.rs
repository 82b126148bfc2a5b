//! Finds what a ray meets.

use bevy_math::Vec3;

use super::{
    point::FilmPoint,
    sides::NearFace,
    triangle::{self, Hit},
    view::{Face, FilmView},
};
use crate::film::direction::unit_or_zero;

/// Depth in mean edges to which film may dip below the metal's surface and still hide it: between its vertices film
/// cuts corners of curved metal.
const DIP: f32 = 0.1;

impl FilmView<'_> {
    /// Returns the first place that a ray meets within the distance `within`: of the film as it is now, moved and
    /// curled, or of the metal where film is gone or has moved out of the way.
    ///
    /// `direction` may have any length. Film that has come off is met from both sides, and is [primer] from below. Film
    /// that holds all around and metal are met from outside only, as they are drawn: a ray from inside the prop passes
    /// them. Metal under film that is still there counts once it is more than a tenth of the mean edge before the film.
    ///
    /// A ray that is not finite, has no direction, or a distance that is NaN finds nothing.
    ///
    /// ```
    /// use bevy_coating::{remesh::sample, settings::CoatingSettings, sim::FilmState, survey::FilmSurface};
    /// use bevy_math::Vec3;
    ///
    /// let piece = sample::plate(100, 7)?;
    /// let mut film = FilmState::new(&piece.film, &CoatingSettings::default(), 7, 100).expect("a plate is a manifold");
    /// let (eye, down) = (Vec3::new(0.2, 0.1, 2.0), Vec3::NEG_Z);
    /// assert!((film.view().along_ray(eye, down, 5.0).expect("paint").distance - 2.0).abs() < 1e-5);
    /// assert_eq!(film.view().along_ray(eye, down, 1.0), None, "it is not that far");
    ///
    /// // All of it comes off and rises, so that one may look at it from below.
    /// film.forces.separated_age.fill(0.0);
    /// film.mesh.geometry.positions.iter_mut().for_each(|p| p.z = 0.3);
    /// let below = film.view().along_ray(Vec3::new(0.2, 0.1, 0.1), Vec3::Z, 5.0).expect("the back");
    /// assert_eq!((below.surface, below.normal), (FilmSurface::Primer, Vec3::NEG_Z));
    /// # Ok::<(), bevy_coating::surface::BuildError>(())
    /// ```
    ///
    /// [primer]: super::FilmSurface::Primer
    pub fn along_ray(&self, origin: Vec3, direction: Vec3, within: f32) -> Option<FilmPoint> {
        let direction = unit_or_zero(direction);
        if !origin.is_finite() || direction == Vec3::ZERO || !(within >= 0.0) {
            return None;
        }
        let (mut film, mut metal): (Option<(Face, Hit)>, Option<(Face, Hit)>) = (None, None);
        let (mut film_at, mut metal_at, mut hidden_at) = (within, within, within);
        let mut hidden: Option<(Face, Hit)> = None;
        let sides = self.sides_of_ray(origin, direction);
        for NearFace { face, now, rest } in self.faces_near(&sides) {
            if !face.live {
                if rest {
                    take(&mut metal, &mut metal_at, face, front(origin, direction, self.at_rest(face.corners)));
                }
                continue;
            }
            let loose = face.corners.iter().any(|&v| self.has_separated(v));
            if now {
                let hit = triangle::hit(origin, direction, self.now(face.corners)).filter(|hit| loose || !hit.back);
                take(&mut film, &mut film_at, face, hit);
            }
            if loose && rest {
                take(&mut hidden, &mut hidden_at, face, front(origin, direction, self.at_rest(face.corners)));
            }
        }
        self.first_of(film, metal, hidden)
    }

    /// Returns which place a ray meets first, of the first hits of film, of open metal, and of metal hidden under film
    /// that has come off.
    pub(super) fn first_of(
        &self,
        film: Option<(Face, Hit)>,
        metal: Option<(Face, Hit)>,
        hidden: Option<(Face, Hit)>,
    ) -> Option<FilmPoint> {
        let dip = DIP * self.mesh.geometry.mean_edge;
        let uncovered = hidden.filter(|(_, hit)| film.is_none_or(|(_, film)| hit.distance + dip < film.distance));
        let metal = match (metal, uncovered) {
            (Some(bare), Some(under)) if under.1.distance < bare.1.distance => Some(under),
            (bare, under) => bare.or(under),
        };
        match (film, metal) {
            (film, Some((face, hit))) if film.is_none_or(|(_, film)| hit.distance < film.distance) => {
                Some(self.metal_point(face.id, face.corners, hit.barycentric, hit.distance))
            }
            (Some((face, hit)), _) => {
                Some(self.film_point(face.id, face.corners, hit.barycentric, hit.back, hit.distance))
            }
            (None, _) => None,
        }
    }
}

/// Returns where a ray meets a triangle from the front.
#[inline]
pub(super) fn front(origin: Vec3, direction: Vec3, corners: [Vec3; 3]) -> Option<Hit> {
    triangle::hit(origin, direction, corners).filter(|hit| !hit.back)
}

/// Takes a hit that is nearer than the one so far.
#[inline]
pub(super) fn take(nearest: &mut Option<(Face, Hit)>, at: &mut f32, face: Face, hit: Option<Hit>) {
    if let Some(hit) = hit
        && (hit.distance < *at || (nearest.is_none() && hit.distance <= *at))
    {
        (*at, *nearest) = (hit.distance, Some((face, hit)));
    }
}
