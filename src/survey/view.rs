//! Borrows the parts of a film that questions are about.

use bevy_math::Vec3;

use crate::{
    film::{FaceFate, FaceId, FilmMesh, VertexId},
    fracture::FilmForces,
    sim::FilmState,
    stain::StainFields,
};

/// Parts of a film that questions are about, borrowed.
///
/// All points and distances are in the film's space, in metres.
///
/// ```
/// use bevy_coating::{remesh::sample, settings::CoatingSettings, sim::FilmState, survey::FilmView};
/// use bevy_math::Vec3;
///
/// let piece = sample::plate(100, 7)?;
/// let film = FilmState::new(&piece.film, &CoatingSettings::default(), 7, 100).expect("a plate is a manifold");
/// let view = FilmView { mesh: &film.mesh, forces: &film.forces, stains: &film.stains, hidden: &[] };
/// assert_eq!(view.nearest(Vec3::Z, 2.0), film.view().nearest(Vec3::Z, 2.0));
/// # Ok::<(), bevy_coating::surface::BuildError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct FilmView<'a> {
    /// Mesh of the film.
    pub mesh: &'a FilmMesh,
    /// Forces and fracture state.
    pub forces: &'a FilmForces,
    /// Stains of the film and the metal.
    pub stains: &'a StainFields,
    /// Whether each face is left out of all answers, as the part of the prop that it lay on is no more; a missing entry
    /// counts as false, so an empty slice leaves out none.
    pub hidden: &'a [bool],
}

impl FilmState {
    /// Returns a view of the film, to ask it questions.
    ///
    /// ```
    /// use bevy_coating::{remesh::sample, settings::CoatingSettings, sim::FilmState};
    /// use bevy_math::Vec3;
    ///
    /// let piece = sample::plate(100, 7)?;
    /// let film = FilmState::new(&piece.film, &CoatingSettings::default(), 7, 100).expect("a plate is a manifold");
    /// let point = film.view().nearest(Vec3::new(0.1, 0.2, 0.3), 1.0).expect("the plate is a metre wide");
    /// assert!((point.distance - 0.3).abs() < 1e-5);
    /// # Ok::<(), bevy_coating::surface::BuildError>(())
    /// ```
    pub fn view(&self) -> FilmView<'_> {
        FilmView { mesh: &self.mesh, forces: &self.forces, stains: &self.stains, hidden: &[] }
    }
}

/// A face with its corners, for loops over all faces.
#[derive(Clone, Copy, Debug)]
pub(super) struct Face {
    pub id: FaceId,
    pub corners: [VertexId; 3],
    /// Whether the face is still part of the film.
    pub live: bool,
}

impl<'a> FilmView<'a> {
    /// Returns all faces that are not hidden.
    #[inline]
    pub(super) fn faces(&self) -> impl Iterator<Item = Face> + use<'a> {
        let (topology, hidden) = (&self.mesh.topology, self.hidden);
        let corners = topology.origins().as_chunks::<3>().0;
        let all = corners.iter().zip(topology.fates()).enumerate();
        let shown = all.filter(|(f, _)| !hidden.get(*f).is_some_and(|&hidden| hidden));
        shown.map(|(f, (&corners, &fate))| Face { id: FaceId::new(f), corners, live: fate == FaceFate::Live })
    }

    /// Returns whether a face is left out.
    pub(super) fn is_hidden(&self, f: FaceId) -> bool {
        self.hidden.get(f.index()).is_some_and(|&hidden| hidden)
    }

    /// Returns the corners of a face as they are now.
    #[inline]
    pub(super) fn now(&self, corners: [VertexId; 3]) -> [Vec3; 3] {
        corners.map(|v| self.mesh.geometry.positions[v.index()])
    }

    /// Returns the corners of a face at rest, which are the metal under it.
    #[inline]
    pub(super) fn at_rest(&self, corners: [VertexId; 3]) -> [Vec3; 3] {
        corners.map(|v| self.mesh.geometry.rest_positions[v.index()])
    }

    /// Returns whether a vertex has separated from the metal.
    #[inline]
    pub(super) fn has_separated(&self, v: VertexId) -> bool {
        self.forces.separated_age.get(v.index()).is_some_and(|&age| age < f32::INFINITY)
    }

    /// Returns a value of the three corners of a face at the barycentric coordinates `at`; a vertex without a value
    /// counts as 0.
    pub(super) fn blend(values: &[f32], corners: [VertexId; 3], at: Vec3) -> f32 {
        let [a, b, c] = corners.map(|v| values.get(v.index()).copied().unwrap_or_default());
        a * at.x + b * at.y + c * at.z
    }

    /// Returns the original vertices at the corners of a face, which are the vertices of the metal.
    pub(super) fn metal(&self, corners: [VertexId; 3]) -> [VertexId; 3] {
        corners.map(|v| self.mesh.topology.original(v))
    }
}
