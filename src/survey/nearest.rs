//! Finds the place of a film that is nearest to a point.

use bevy_math::Vec3;

use super::{
    point::FilmPoint,
    triangle,
    view::{Face, FilmView},
};

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
        let mut best = self.nearest_vertex(point).min(within * within);
        let mut found: Option<(Face, Vec3)> = None;
        for face in self.faces() {
            let corners = if face.live { self.now(face.corners) } else { self.at_rest(face.corners) };
            let [a, b, c] = corners;
            let beside = (a.min(b).min(c) - point).max(point - a.max(b).max(c)).max(Vec3::ZERO);
            if beside.length_squared() > best {
                continue;
            }
            let at = triangle::nearest(point, corners);
            let distance = triangle::at(corners, at).distance_squared(point);
            // Until one is found, what is as far away as the nearest vertex will do.
            let nearer = match found {
                Some((other, _)) => distance < best || (distance == best && face.live && !other.live),
                None => distance <= best,
            };
            if nearer {
                (best, found) = (distance, Some((face, at)));
            }
        }
        let (Face { id, corners, live }, at) = found?;
        let distance = best.sqrt();
        if !live {
            return Some(self.metal_point(id, corners, at, distance));
        }
        let now = self.now(corners);
        let below = (point - triangle::at(now, at)).dot(triangle::normal(now)) < 0.0;
        let loose = corners.iter().any(|&v| self.has_separated(v));
        Some(self.film_point(id, corners, at, below && loose, distance))
    }

    /// Returns a bound of the squared distance to the nearest place: a little more than that of the nearest vertex of
    /// the film.
    fn nearest_vertex(&self, point: Vec3) -> f32 {
        // Vertices of hidden faces tell nothing.
        if !self.hidden.is_empty() {
            return f32::INFINITY;
        }
        let topology = &self.mesh.topology;
        let vertices = topology.all_vertices().zip(&self.mesh.geometry.positions);
        let squares = vertices.map(|(v, p)| {
            let square = p.distance_squared(point);
            if topology.has_faces(v) { square } else { f32::INFINITY }
        });
        // The same vertex as a corner of a face may be rounded to be farther away.
        squares.fold(f32::INFINITY, f32::min) * 1.0001
    }
}
