//! Writes the fronts of films: one mesh for each primitive of the prop, with the prop's own attributes.

use bevy::{
    asset::{Assets, Handle},
    ecs::{
        change_detection::DetectChangesMut,
        component::Component,
        entity::Entity,
        system::{Query, ResMut},
    },
    math::Vec3,
    mesh::Mesh,
};

use super::{
    canvas::StainCanvas,
    film_paint::FilmPaint,
    mesh::{PartSpace, patch_part, write_part},
    prepared::{FrontMesh, LevelChange, PreparedLevel, edge_at, front_writer, write_front},
};
use crate::{
    api::{diagnostics::CoatingTimings, display_cost::DisplayCost, stain_display::StainDisplay},
    appearance::{Detail, DisplayChanges, FilmAppearance},
    film::FilmMesh,
    fracture::FilmForces,
    mesh_reader::SlotAttributes,
    remesh::BuiltFilm,
    rest::Rest,
    sim::{FilmState, Stage},
    stain::StainFields,
    surface::{BuildError, Surface},
};

/// Work of colouring a vertex, in vertices that are moved.
const COLORING: u64 = 8;

/// Appearance of a film, on its entity, and the assets that draw it.
#[derive(Component)]
#[component(clone_behavior = Ignore)]
pub(crate) struct FilmDisplay {
    /// Front, backs and metal as arrays.
    pub(super) appearance: FilmAppearance,
    /// Transform from the film's space to the space of the prop's mesh.
    pub(super) space: PartSpace,
    /// Display mode, colours and patterns of the stains.
    pub(super) paint: FilmPaint,
    /// Mean edge of the film, in metres.
    pub(super) film_edge: f32,
    /// Mean distance between the vertices that are shown, in metres.
    pub(super) edge: f32,
    /// The film at another level, while that is prepared.
    pub(super) next: Option<LevelChange>,
    /// Whether the materials have not been updated to `paint` yet.
    #[cfg(feature = "render")]
    pub(super) materials_outdated: bool,
    /// Primitives of the prop.
    pub(super) slots: Vec<DisplaySlot>,
    /// Changes that were taken in this frame, to be written into assets.
    pub(super) changes: DisplayChanges,
    /// Whether `paint` has changed since stains were last drawn.
    pub(super) repainted: bool,
    /// Whether the film must be shown in this frame, whatever else there is to show.
    pub(super) urgent: bool,
    /// Whether the film is shown in this frame.
    pub(super) due: bool,
    /// Priority among the films that have something to show.
    pub(super) credit: f32,
    /// Backs and metal, as far as they have been spawned.
    #[cfg(feature = "render")]
    pub(super) parts: super::part_handles::PartHandles,
    /// Heat map, while one is shown.
    #[cfg(feature = "render")]
    pub(super) heat: Option<Box<super::heat_overlay::HeatOverlay>>,
}

impl FilmDisplay {
    /// Returns what the film looks like.
    pub(crate) fn appearance(&self) -> &FilmAppearance {
        &self.appearance
    }
}

/// Primitive of the prop.
pub(super) struct DisplaySlot {
    /// Attributes that its own mesh has.
    pub attributes: SlotAttributes,
    /// Mesh that was written while the film was built, until it is an asset.
    mesh: Option<Mesh>,
    handle: Option<Handle<Mesh>>,
    /// Stains as the mesh shows them.
    canvas: StainCanvas,
    /// Whether the mesh shows the part, and not a stand-in for one without triangles.
    shown: bool,
}

impl FilmDisplay {
    /// Returns the display of a film at rest, shown as finely as `detail` says, with rests between the pieces of the
    /// work.
    ///
    /// # Errors
    /// The errors of [`FilmAppearance::with_detail`].
    pub async fn new(
        film: &FilmState,
        surface: &Surface,
        built: &BuiltFilm,
        slots: Vec<SlotAttributes>,
        scale: Vec3,
        origin: Vec3,
        paint: FilmPaint,
        detail: Detail,
        rest: &mut impl Rest,
    ) -> Result<Self, BuildError> {
        let empty = |attributes| {
            let canvas = StainCanvas::default();
            DisplaySlot { attributes, mesh: None, handle: None, canvas, shown: false }
        };
        let FilmState { mesh, forces, stains, .. } = film;
        Ok(Self {
            appearance: FilmAppearance::in_pieces(built, surface, mesh, forces, stains, detail, rest).await?,
            space: PartSpace::new(scale, origin),
            paint,
            film_edge: mesh.geometry.mean_edge,
            edge: edge_at(mesh.geometry.mean_edge, detail.level),
            next: None,
            #[cfg(feature = "render")]
            // The prop may still wear the materials of an earlier film.
            materials_outdated: true,
            slots: slots.into_iter().map(empty).collect(),
            changes: DisplayChanges::default(),
            repainted: false,
            urgent: false,
            due: false,
            credit: 0.0,
            #[cfg(feature = "render")]
            parts: super::part_handles::PartHandles::default(),
            #[cfg(feature = "render")]
            heat: None,
        })
    }

    /// Brings the appearance up to date with the film as it is put on its prop, and writes the meshes. It runs in the
    /// background, as the end of a build, and rests in between.
    pub async fn prepare(&mut self, film: &FilmState, rest: &mut impl Rest) {
        let FilmState { mesh, forces, stains, .. } = film;
        self.appearance.update_in_pieces(mesh, forces, stains, DisplayChanges::everything(), rest).await;
        let Self { appearance, slots, paint, space, edge, .. } = self;
        for (slot, display) in slots.iter_mut().enumerate() {
            rest.rest().await;
            if let Some(new) = write_front(appearance, slot, display.attributes, paint, *edge, *space) {
                (display.mesh, display.canvas, display.shown) = (Some(new.mesh), new.canvas, new.shown);
            }
        }
    }

    /// Shows the film as it was prepared at another level, with `paint`. What has changed since then must follow.
    pub(super) fn take_level(&mut self, prepared: PreparedLevel, assets: &mut Assets<Mesh>) {
        let PreparedLevel { mut appearance, fronts, paint } = prepared;
        appearance.hide_as(&self.appearance);
        self.edge = edge_at(self.film_edge, appearance.level());
        self.appearance = appearance;
        self.repainted |= paint != self.paint;
        for (slot, front) in self.slots.iter_mut().zip(fronts) {
            let Some(FrontMesh { mesh, canvas, shown }) = front else { continue };
            (slot.canvas, slot.shown) = (canvas, shown);
            if let Some(mut asset) = slot.handle.as_ref().and_then(|handle| assets.get_mut(handle)) {
                *asset = mesh;
            }
        }
        #[cfg(feature = "render")]
        self.parts.forget();
        self.urgent = true;
    }

    /// Returns a display for a copy of the film, with meshes and parts of its own.
    pub fn copy(&self, assets: &Assets<Mesh>) -> Self {
        let mesh_of = |slot: &DisplaySlot| slot.handle.as_ref().and_then(|handle| assets.get(handle)).cloned();
        let copy = |slot: &DisplaySlot| DisplaySlot {
            attributes: slot.attributes,
            mesh: mesh_of(slot),
            handle: None,
            canvas: slot.canvas.clone(),
            shown: slot.shown,
        };
        Self {
            appearance: self.appearance.clone(),
            space: self.space,
            paint: self.paint.clone(),
            film_edge: self.film_edge,
            edge: self.edge,
            next: None,
            #[cfg(feature = "render")]
            materials_outdated: true,
            slots: self.slots.iter().map(copy).collect(),
            changes: self.changes,
            repainted: self.repainted,
            urgent: false,
            due: false,
            credit: 0.0,
            #[cfg(feature = "render")]
            parts: super::part_handles::PartHandles::default(),
            #[cfg(feature = "render")]
            heat: None,
        }
    }

    /// Hides slot `slot` for good: it has no front, no backs and no metal any more.
    pub fn hide_slot(&mut self, slot: usize) {
        self.appearance.hide_slot(slot);
        if let Some(slot) = self.slots.get_mut(slot) {
            (slot.mesh, slot.handle) = (None, None);
        }
    }

    /// Returns whether each face is in a slot that is hidden.
    pub fn hidden_faces(&self) -> Vec<bool> {
        self.appearance.hidden_faces()
    }

    /// Returns whether `entity` draws the film's backs or metal, or its heat map.
    pub fn has_part(
        &self,
        #[cfg_attr(not(feature = "render"), expect(unused_variables, reason = "no parts"))] entity: Entity,
    ) -> bool {
        #[cfg(feature = "render")]
        return self.parts.contains(entity) || self.heat.as_ref().is_some_and(|heat| heat.part == entity);
        #[cfg(not(feature = "render"))]
        false
    }

    /// Adds the meshes as assets and returns one handle a primitive; `None` for a primitive of which the film has no
    /// face.
    pub fn put_on(&mut self, assets: &mut Assets<Mesh>) -> Vec<Option<Handle<Mesh>>> {
        for slot in &mut self.slots {
            slot.handle = slot.mesh.take().map(|mesh| assets.add(mesh));
        }
        self.slots.iter().map(|slot| slot.handle.clone()).collect()
    }

    /// Returns how much work it is to show `changes`, in vertices that are moved.
    pub(super) fn work(&self, changes: DisplayChanges) -> u64 {
        let vertices: usize =
            (0..self.slots.len()).filter_map(|slot| Some(self.appearance.front(slot)?.positions.len())).sum();
        let stains = if self.paint.display == StainDisplay::VertexColor { COLORING } else { 1 };
        let parts = 2 * u64::from(changes.moved) + u64::from(changes.topology || changes.exposure);
        (parts + stains * u64::from(changes.stains)) * vertices as u64
    }

    /// Brings the stains that are drawn up to date with the appearance.
    fn follow_stains(&mut self) {
        let Self { appearance, slots, paint, edge, .. } = self;
        let repainted = std::mem::take(&mut self.repainted);
        for (slot, display) in slots.iter_mut().enumerate() {
            if let (Some(part), Some(changes)) = (appearance.front(slot), appearance.front_changes(slot)) {
                display.canvas.follow(part, front_writer(paint, *edge), changes, repainted);
            }
        }
        #[cfg(feature = "render")]
        self.parts.follow_stains(appearance, paint, *edge, repainted);
    }
}

/// Takes the changes of every film that is due and brings its appearance up to date, in parallel. Touches no asset.
pub(super) fn follow_films(
    mut films: Query<(&FilmMesh, &FilmForces, &StainFields, &mut DisplayChanges, &mut FilmDisplay)>,
    mut timings: ResMut<CoatingTimings>,
    mut cost: ResMut<DisplayCost>,
) {
    timings.measure(Stage::MeshGeneration, || {
        cost.measure(|| {
            films.par_iter_mut().for_each(|(mesh, forces, stains, mut changes, mut display)| {
                let display = display.bypass_change_detection();
                display.changes =
                    if display.due { changes.bypass_change_detection().take() } else { DisplayChanges::default() };
                if !display.changes.is_empty() {
                    display.appearance.update(mesh, forces, stains, display.changes);
                    display.follow_stains();
                }
            });
        })
    });
}

/// Writes the meshes of the films that changed.
pub(super) fn write_fronts(
    mut films: Query<&mut FilmDisplay>,
    mut assets: ResMut<Assets<Mesh>>,
    mut timings: ResMut<CoatingTimings>,
    mut cost: ResMut<DisplayCost>,
) {
    timings.measure(Stage::MeshGeneration, || {
        cost.measure(|| {
            for mut display in &mut films {
                let display = display.bypass_change_detection();
                if display.changes.is_empty() {
                    continue;
                }
                let FilmDisplay { appearance, slots, space, .. } = display;
                for (slot, front) in slots.iter_mut().enumerate() {
                    let (Some(part), Some(changes)) = (appearance.front(slot), appearance.front_changes(slot)) else {
                        continue;
                    };
                    let whole = changes.whole || front.canvas.take_relaid() || !front.shown;
                    if !whole && changes.is_stained_only() && front.canvas.changed().is_empty() {
                        continue;
                    }
                    let Some(mut mesh) = front.handle.as_ref().and_then(|handle| assets.get_mut(handle)) else {
                        continue;
                    };
                    if whole {
                        front.shown = write_part(&mut mesh, part, front.attributes, *space, &front.canvas);
                    } else {
                        patch_part(&mut mesh, part, changes, front.attributes, *space, &front.canvas);
                    }
                }
            }
        })
    });
}
