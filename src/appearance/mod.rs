//! Turns a film into the meshes that are drawn, as plain arrays: the front of the paint, the backs of its flakes, and
//! the bare metal under it.
//!
//! | part | triangles | moves |
//! |---|---|---|
//! | [`FilmAppearance::front`] | all faces that are left, with the prop's own attributes at their corners | with the
//! film |
//! | [`FilmAppearance::backs`] | faces that are left and have separated, seen from behind | with the film |
//! | [`FilmAppearance::metal`] | faces that have separated or are gone, at rest, just under the film | never |
//!
//! A face has separated when any of its vertices has. Faces that are still attached have neither back nor metal, so
//! a fresh film looks exactly like the prop that it was made of. Each slot, which is a primitive of the prop with a
//! material of its own, has its own front, backs and metal. The plugin's meshes and baked models are made of the
//! same arrays. Colours, roughness and relief of stained surfaces are computed in [`shading`].
//!
//! ```
//! use bevy_coating::{
//!     appearance::FilmAppearance, remesh::sample, settings::CoatingSettings, sim::FilmState, stain::Environment,
//! };
//!
//! let (piece, settings) = (sample::plate(200, 1)?, CoatingSettings::default());
//! let mut film = FilmState::new(&piece.film, &settings, 0, 100).ok_or("an empty film")?;
//! let fresh = FilmAppearance::new(&piece.film, &piece.surface, &film.mesh, &film.forces, &film.stains);
//! assert_eq!(fresh.slot_count(), 1, "the plate is one primitive");
//! assert!(fresh.metal(0).is_some_and(|metal| metal.is_empty()), "fresh paint hides the metal");
//!
//! film.age_to(1.0, &settings, &Environment::default());
//! let aged = FilmAppearance::new(&piece.film, &piece.surface, &film.mesh, &film.forces, &film.stains);
//! assert!(aged.metal(0).is_some_and(|metal| !metal.is_empty()), "aged paint has separated");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod blocks;
mod changes;
mod coarse;
mod corners;
mod detail;
mod face_slots;
mod fine;
mod in_slots;
mod levels;
mod part;
mod part_changes;
mod pieces;
mod seen;
pub mod shading;
#[cfg(test)]
mod tests;
mod turn;
mod wedges;

pub use changes::DisplayChanges;
pub use corners::CornerAttributes;
pub use detail::Detail;
pub use levels::FilmLevels;
pub use part::MeshPart;
pub use part_changes::{IndexRanges, PartChanges};
pub use pieces::PieceParts;

use crate::{
    film::FilmMesh,
    fracture::FilmForces,
    remesh::BuiltFilm,
    rest::{NoRest, Rest, at_once},
    stain::StainFields,
    surface::{BuildError, Surface},
};
use coarse::CoarseSurface;
use fine::FineSurface;
use seen::Seen;

/// Distance between a flake's front and its back, the thickness of the paint, in mean edge lengths of the film.
pub const FILM_THICKNESS: f32 = 0.01;
/// Depth of the bare metal under the film at rest, in mean edge lengths of the film. It is more than
/// [`FILM_THICKNESS`], so that the metal does not show through the back of a flake that has only just separated.
pub const METAL_DEPTH: f32 = 0.02;

/// Front, backs and bare metal of one film as [`MeshPart`]s, and the lookups that bring them up to date.
///
/// The module's page has an [example](self).
#[derive(Clone, Debug)]
pub struct FilmAppearance {
    /// [`FilmLevels::epoch`] is the [`DisplayChanges::epoch`] of the state that the parts show.
    levels: FilmLevels,
    level: u32,
    seen: Seen,
    shown: Shown,
    /// Whether the parts must be made again.
    outdated: bool,
}

/// Surface by which a film is shown.
#[derive(Clone, Debug)]
enum Shown {
    Coarse(Box<CoarseSurface>),
    Fine(Box<FineSurface>),
}

impl FilmAppearance {
    /// Builds the parts of a film in the state of `mesh`, `forces` and `stains`. `built` is the film at rest that this
    /// state began with, and `surface` the prop's surface that `built` was made of.
    pub fn new(
        built: &BuiltFilm,
        surface: &Surface,
        mesh: &FilmMesh,
        forces: &FilmForces,
        stains: &StainFields,
    ) -> Self {
        let attributes = CornerAttributes::sample(built, surface, mesh);
        FilmLevels::coarse(built, attributes, mesh, forces).appearance(0, mesh, forces, stains)
    }

    /// Does the same as [`new`](Self::new), with the film shown as finely as `detail` says.
    ///
    /// Above level 0 the points of the fine triangles lie on the prop's own surface, so details of the prop that are
    /// finer than the film are there; the time that takes is that of a part of building the film.
    ///
    /// # Errors
    /// The errors of [`fine_sites`](crate::remesh::fine_sites): `surface` is not the one that `built` was made of, or
    /// there would be too many triangles.
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
    /// assert_eq!(fine.front(0).map(|front| front.indices.len() / 3), Some(16 * 200));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn with_detail(
        built: &BuiltFilm,
        surface: &Surface,
        mesh: &FilmMesh,
        forces: &FilmForces,
        stains: &StainFields,
        detail: Detail,
    ) -> Result<Self, BuildError> {
        at_once(Self::in_pieces(built, surface, mesh, forces, stains, detail, &mut NoRest))
    }

    /// Does what [`with_detail`](Self::with_detail) does, with rests between its pieces.
    ///
    /// # Errors
    /// See [`with_detail`](Self::with_detail).
    pub(crate) async fn in_pieces(
        built: &BuiltFilm,
        surface: &Surface,
        mesh: &FilmMesh,
        forces: &FilmForces,
        stains: &StainFields,
        detail: Detail,
        rest: &mut impl Rest,
    ) -> Result<Self, BuildError> {
        let levels = FilmLevels::sample(built, surface, mesh, forces, detail, rest).await?;
        Ok(levels.appearance_in_pieces(detail.level, mesh, forces, stains, rest).await)
    }

    async fn begin(
        levels: FilmLevels,
        level: u32,
        mesh: &FilmMesh,
        forces: &FilmForces,
        stains: &StainFields,
        rest: &mut impl Rest,
    ) -> Self {
        let (shown, level) = (levels.surface(level, mesh, rest).await, level.min(levels.finest()));
        let seen = Seen::new(levels.tolerance(mesh));
        let mut appearance = Self { levels, level, seen, shown, outdated: true };
        let changes = DisplayChanges::everything_in(appearance.levels.epoch);
        appearance.update_in_pieces(mesh, forces, stains, changes, rest).await;
        appearance
    }

    /// Returns the level at which the film is shown.
    pub fn level(&self) -> u32 {
        self.level
    }

    /// Returns the finest level at which the film can be shown.
    pub fn finest_level(&self) -> u32 {
        self.levels.finest()
    }

    /// Returns what the film can be shown with at other levels.
    pub fn levels(&self) -> FilmLevels {
        self.levels.clone()
    }

    /// Returns the number of slots. Each primitive of the prop is a slot and has a material of its own.
    pub fn slot_count(&self) -> usize {
        self.levels.face_slots.slot_count()
    }

    /// Returns the front of the paint in one slot; `None` if `slot` is not below [`slot_count`](Self::slot_count).
    pub fn front(&self, slot: usize) -> Option<&MeshPart> {
        self.all_fronts().get(slot)
    }

    /// Returns the backs of the flakes in one slot, without tangents; `None` if `slot` is not below
    /// [`slot_count`](Self::slot_count).
    pub fn backs(&self, slot: usize) -> Option<&MeshPart> {
        self.all_backs().get(slot)
    }

    /// Returns the bare metal in one slot, without tangents; `None` if `slot` is not below
    /// [`slot_count`](Self::slot_count).
    pub fn metal(&self, slot: usize) -> Option<&MeshPart> {
        self.all_metal().get(slot)
    }

    /// Returns what the last update changed of [`front`](Self::front).
    pub fn front_changes(&self, slot: usize) -> Option<&PartChanges> {
        match &self.shown {
            Shown::Coarse(coarse) => coarse.fronts.changes.get(slot),
            Shown::Fine(fine) => fine.fronts.changes.get(slot),
        }
    }

    /// Returns what the last update changed of [`backs`](Self::backs).
    pub fn back_changes(&self, slot: usize) -> Option<&PartChanges> {
        match &self.shown {
            Shown::Coarse(coarse) => coarse.backs.changes.get(slot),
            Shown::Fine(fine) => fine.backs.changes.get(slot),
        }
    }

    /// Returns what the last update changed of [`metal`](Self::metal).
    pub fn metal_changes(&self, slot: usize) -> Option<&PartChanges> {
        match &self.shown {
            Shown::Coarse(coarse) => coarse.metal.changes.get(slot),
            Shown::Fine(fine) => fine.metal.changes.get(slot),
        }
    }

    /// Hides slot `slot` for good: its faces have no front, no back and no metal from the next update on.
    pub fn hide_slot(&mut self, slot: usize) {
        self.levels.face_slots.hide(slot);
        self.outdated = true;
    }

    /// Hides the slots that `other`, an appearance of the same film, hides.
    pub fn hide_as(&mut self, other: &Self) {
        self.outdated |= self.levels.face_slots.hide_as(&other.levels.face_slots);
    }

    /// Returns whether each face is in a slot that is [hidden](Self::hide_slot).
    pub fn hidden_faces(&self) -> Vec<bool> {
        self.levels.face_slots.hidden_faces()
    }

    /// Brings the parts up to date with the film, which has undergone `changes` since the last update.
    ///
    /// Faces and vertices keep their places in the parts' arrays, and only what changed is written. Under
    /// `changes` of another [epoch](DisplayChanges::epoch) than the last update's, everything is made again.
    pub fn update(&mut self, mesh: &FilmMesh, forces: &FilmForces, stains: &StainFields, changes: DisplayChanges) {
        at_once(self.update_in_pieces(mesh, forces, stains, changes, &mut NoRest));
    }

    /// Does what [`update`](Self::update) does, with rests between its pieces.
    pub(crate) async fn update_in_pieces(
        &mut self,
        mesh: &FilmMesh,
        forces: &FilmForces,
        stains: &StainFields,
        changes: DisplayChanges,
        rest: &mut impl Rest,
    ) {
        let Self { levels: FilmLevels { face_slots, epoch, .. }, seen, shown, outdated, .. } = self;
        let replaced = std::mem::replace(epoch, changes.epoch) != changes.epoch;
        let whole = std::mem::take(outdated) || replaced;
        let changes = if whole { DisplayChanges::everything() } else { changes };
        seen.follow(mesh, forces, stains, changes, whole);
        rest.rest().await;
        match shown {
            Shown::Coarse(coarse) => coarse.update(mesh, forces, face_slots, seen, rest).await,
            Shown::Fine(fine) => fine.update(mesh, forces, face_slots, seen, rest).await,
        }
    }

    /// Returns the fronts of each slot.
    fn all_fronts(&self) -> &[MeshPart] {
        match &self.shown {
            Shown::Coarse(coarse) => &coarse.fronts.parts,
            Shown::Fine(fine) => &fine.fronts.parts,
        }
    }

    /// Returns the backs of each slot.
    fn all_backs(&self) -> &[MeshPart] {
        match &self.shown {
            Shown::Coarse(coarse) => &coarse.backs.parts,
            Shown::Fine(fine) => &fine.backs.parts,
        }
    }

    /// Returns the bare metal of each slot.
    fn all_metal(&self) -> &[MeshPart] {
        match &self.shown {
            Shown::Coarse(coarse) => &coarse.metal.parts,
            Shown::Fine(fine) => &fine.metal.parts,
        }
    }
}
