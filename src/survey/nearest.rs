//! Finds the place of a film that is nearest to a point.

use bevy_math::Vec3;

use super::{
    point::FilmPoint,
    triangle,
    view::{Face, FilmView},
};

/// Faces to each that is looked at for a first bound.
const SPREAD: usize = 16;

impl FilmView<'_> {
    /// Returns the place nearest to `point`, of the film as it is now or of the metal that removed faces have left
    /// bare, or `None` if there is none within the distance `within`.
    ///
    /// Film that has come off is seen from the side on which `point` lies, so it is [primer] from below. Metal under
    /// film that is still there is passed over, even where that film has lifted: [rays](Self::along_ray) find it. At a
    /// tie, the film goes before the metal, and the face with the lowest id before others.
    ///
    /// A point or distance that is NaN, and an infinite point, find nothing.
    ///
    /// ```
    /// use bevy_coating::{
    ///     remesh::sample,
    ///     settings::CoatingSettings,
    ///     sim::FilmState,
    ///     stain::Environment,
    ///     survey::FilmSurface,
    /// };
    /// use bevy_math::Vec3;
    ///
    /// let (settings, environment) = (CoatingSettings::default(), Environment::default());
    /// let piece = sample::plate(100, 7)?;
    /// let mut film = FilmState::new(&piece.film, &settings, 7, 100).expect("a plate is a manifold");
    /// let boot = Vec3::new(0.2, 0.1, 0.01);
    /// let paint = film.view().nearest(boot, 0.1).expect("the plate is below");
    /// assert_eq!(paint.surface, FilmSurface::Paint);
    ///
    /// film.strip_face(paint.face, &settings, &environment);
    /// assert_eq!(film.view().nearest(boot, 0.1).expect("the metal").surface, FilmSurface::BareMetal);
    /// # Ok::<(), bevy_coating::surface::BuildError>(())
    /// ```
    ///
    /// [primer]: super::FilmSurface::Primer
    pub fn nearest(&self, point: Vec3, within: f32) -> Option<FilmPoint> {
        if !(point.is_finite() && within >= 0.0) {
            return None;
        }
        let mut best = self.nearest_of_some(point).min(within * within);
        let mut found: Option<(Face, Vec3)> = None;
        let sides = self.sides_of_box(point, best);
        for (face, corners) in self.places_near(&sides) {
            let [a, b, c] = corners;
            let beside = (a.min(b).min(c) - point).max(point - a.max(b).max(c)).max(Vec3::ZERO);
            if beside.length_squared() > best {
                continue;
            }
            let at = triangle::nearest(point, corners);
            let distance = triangle::at(corners, at).distance_squared(point);
            // Until one is found, what is as far away as the bound will do.
            let nearer = match found {
                Some((other, _)) => distance < best || (distance == best && face.live && !other.live),
                None => distance <= best,
            };
            if nearer {
                (best, found) = (distance, Some((face, at)));
            }
        }
        let (face, at) = found?;
        Some(self.seen_from(point, face, at, best.sqrt()))
    }

    /// Describes the place `at` of a face as it is seen from a `point` in that distance.
    pub(super) fn seen_from(&self, point: Vec3, face: Face, at: Vec3, distance: f32) -> FilmPoint {
        let Face { id, corners, live } = face;
        if !live {
            return self.metal_point(id, corners, at, distance);
        }
        let now = self.now(corners);
        let below = (point - triangle::at(now, at)).dot(triangle::normal(now)) < 0.0;
        let loose = corners.iter().any(|&v| self.has_separated(v));
        self.film_point(id, corners, at, below && loose, distance)
    }

    /// Returns a bound of the squared distance to the nearest place: a little more than that of the nearest of some
    /// corners, which are spread over the film. It only saves time, whatever they are.
    fn nearest_of_some(&self, point: Vec3) -> f32 {
        let corners = self.faces().step_by(SPREAD).filter(|face| face.live).map(|face| face.corners[0]);
        let squares = corners.map(|v| self.mesh.geometry.positions[v.index()].distance_squared(point));
        let bound = squares.fold(f32::INFINITY, f32::min).sqrt() * 1.0001;
        // The place of the same corner in its face may be rounded to be farther away.
        let rounding = 1e-6 * point.abs().max_element();
        (bound + rounding) * (bound + rounding)
    }
}
