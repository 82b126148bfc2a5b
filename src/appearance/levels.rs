//! Keeps what a film is shown with at every level, so that levels can be changed while it ages.

use std::sync::Arc;

use super::{
    FilmAppearance, Shown,
    coarse::CoarseSurface,
    corners::CornerAttributes,
    detail::Detail,
    face_slots::FaceSlots,
    fine::{Base, FineSurface},
    wedges::RestWedges,
};
use crate::{
    film::FilmMesh,
    fracture::FilmForces,
    remesh::BuiltFilm,
    rest::{NoRest, Rest, at_once},
    stain::StainFields,
    surface::{BuildError, Surface},
};

/// The prop's own surface under a film, sampled as finely as [`Detail::level`] says: with it the film can be shown at
/// that level and at all below.
///
/// It is cheap to clone, and needs neither the prop nor the appearance that it came from, so a film can be prepared at
/// another level in the background.
///
/// ```
/// use bevy_coating::{
///     appearance::{Detail, FilmAppearance}, remesh::sample, settings::CoatingSettings, sim::FilmState,
/// };
///
/// let (piece, settings) = (sample::plate(200, 1)?, CoatingSettings::default());
/// let film = FilmState::new(&piece.film, &settings, 0, 100).ok_or("an empty film")?;
/// let detail = Detail { level: 2, ..Detail::default() };
/// let fine = FilmAppearance::with_detail(
///     &piece.film, &piece.surface, &film.mesh, &film.forces, &film.stains, detail,
/// )?;
/// let coarse = fine.levels().appearance(1, &film.mesh, &film.forces, &film.stains);
/// assert_eq!((fine.level(), coarse.level()), (2, 1));
/// assert_eq!(coarse.front(0).map(|front| front.triangles().count()), Some(4 * 200));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct FilmLevels {
    attributes: Arc<CornerAttributes>,
    wedges: Arc<RestWedges>,
    /// Surface at the points of the finest level; `None` if that is 0.
    finest: Option<Arc<Base>>,
    detail: Detail,
    /// Length of the film's grain, in metres.
    grain: f32,
    pub(super) face_slots: FaceSlots,
    pub(super) epoch: u32,
}

impl FilmLevels {
    /// Samples `surface`.
    pub(super) async fn sample(
        built: &BuiltFilm,
        surface: &Surface,
        mesh: &FilmMesh,
        forces: &FilmForces,
        detail: Detail,
        rest: &mut impl Rest,
    ) -> Result<Self, BuildError> {
        let attributes = CornerAttributes::sample(built, surface, mesh);
        rest.rest().await;
        let mut levels = Self::coarse(built, attributes, mesh, forces);
        rest.rest().await;
        levels.detail = detail;
        if detail.level > 0 {
            let Self { attributes, wedges, face_slots, .. } = &levels;
            let wedges = wedges.clone();
            let base = Base::sample(built, surface, mesh, attributes, wedges, face_slots, detail.level, rest).await?;
            levels.finest = Some(Arc::new(base));
        }
        Ok(levels)
    }

    /// Returns level 0 alone.
    pub(super) fn coarse(
        built: &BuiltFilm,
        attributes: CornerAttributes,
        mesh: &FilmMesh,
        forces: &FilmForces,
    ) -> Self {
        let face_slots = FaceSlots::new(built, mesh.topology.face_count());
        Self {
            wedges: Arc::new(RestWedges::new(mesh, &attributes, &face_slots)),
            attributes: Arc::new(attributes),
            finest: None,
            detail: Detail::default(),
            grain: forces.grain().map_or(mesh.geometry.mean_edge, |grain| grain.length),
            face_slots,
            epoch: 0,
        }
    }

    /// Returns the distance up to which a vertex may lie beside where it is shown, in metres.
    pub(super) fn tolerance(&self, mesh: &FilmMesh) -> f32 {
        self.detail.tolerance * mesh.geometry.mean_edge
    }

    /// Returns the attributes of the film's corners.
    pub(super) fn attributes(&self) -> &CornerAttributes {
        &self.attributes
    }

    /// Returns the finest level.
    pub fn finest(&self) -> u32 {
        self.finest.as_ref().map_or(0, |base| base.layout.grid.level())
    }

    /// Returns the appearance of the film in the state of `mesh`, `forces` and `stains` at `level`, or at the finest
    /// that there is.
    pub fn appearance(&self, level: u32, mesh: &FilmMesh, forces: &FilmForces, stains: &StainFields) -> FilmAppearance {
        at_once(self.appearance_in_pieces(level, mesh, forces, stains, &mut NoRest))
    }

    /// Does what [`appearance`](Self::appearance) does, with rests between its pieces.
    pub(crate) async fn appearance_in_pieces(
        &self,
        level: u32,
        mesh: &FilmMesh,
        forces: &FilmForces,
        stains: &StainFields,
        rest: &mut impl Rest,
    ) -> FilmAppearance {
        FilmAppearance::begin(self.clone(), level, mesh, forces, stains, rest).await
    }

    /// Returns the surface that shows a film at `level`, or at the finest that there is.
    pub(super) async fn surface(&self, level: u32, mesh: &FilmMesh, rest: &mut impl Rest) -> Shown {
        let slots = self.face_slots.slot_count();
        match &self.finest {
            Some(finest) if level > 0 => {
                let base = match level < self.finest() {
                    true => Arc::new(finest.coarser(mesh, level, rest).await),
                    false => finest.clone(),
                };
                let [chips, thickness] = [self.detail.chips, self.detail.thickness].map(|grains| grains * self.grain);
                Shown::Fine(Box::new(FineSurface::new(mesh, base, slots, chips, thickness)))
            }
            _ => Shown::Coarse(Box::new(CoarseSurface::new(self.attributes.clone(), self.wedges.clone(), slots))),
        }
    }
}
