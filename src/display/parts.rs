//! Writes the backs of flakes and the bare metal of each primitive to two children of the primitive's entity, which are
//! spawned when there is first something to draw.

use bevy::{
    asset::{Assets, Handle},
    ecs::{
        change_detection::{DetectChanges, DetectChangesMut},
        entity::Entity,
        hierarchy::ChildOf,
        lifecycle::Remove,
        name::Name,
        observer::On,
        system::{Commands, Query, Res, ResMut, SystemParam},
    },
    mesh::{Mesh, Mesh3d},
    pbr::{MeshMaterial3d, StandardMaterial},
    prelude::Visibility,
    transform::components::{GlobalTransform, Transform},
};

use super::{
    canvas::{StainCanvas, StainCarrier, StainWriter},
    film_display::FilmDisplay,
    material::extension::StainedMaterial,
    mesh::{new_mesh, patch_part, write_part},
    outline::Outline,
    part_handles::{PartHandle, PartMaterial, SlotParts},
    part_material,
};
use crate::{
    api::{
        diagnostics::CoatingTimings,
        display_cost::DisplayCost,
        links::{CoatingPart, FilmSource},
        stain_display::StainDisplay,
    },
    appearance::{DisplayChanges, shading::StainPart},
    sim::Stage,
};

/// Returns whether the app has standard materials at all; a server may not.
pub(super) fn has_materials(materials: Option<Res<Assets<StandardMaterial>>>) -> bool {
    materials.is_some()
}

/// Writes the backs and the metal of the films that changed, and spawns them when there is first something to draw.
pub(super) fn write_parts(
    mut films: Query<(&FilmSource, &mut FilmDisplay)>,
    mut assets: PartAssets,
    mut timings: ResMut<CoatingTimings>,
    mut cost: ResMut<DisplayCost>,
) {
    timings.measure(Stage::MeshGeneration, || {
        cost.measure(|| {
            for (source, mut display) in &mut films {
                // A film that was aged before it was put on its prop has backs and metal from its first frame on.
                let new = display.is_added();
                let display = display.bypass_change_detection();
                let changes = if new { DisplayChanges::everything() } else { display.changes };
                let outdated = std::mem::take(&mut display.parts.outdated);
                if changes.is_empty() && !outdated && !display.parts.slots.iter().any(|slot| slot.outdated) {
                    continue;
                }
                let mut slots = std::mem::take(&mut display.parts.slots);
                for (slot, (parts, &entity)) in slots.iter_mut().zip(&source.slots).enumerate() {
                    let outdated = outdated || std::mem::take(&mut parts.outdated);
                    assets.show(parts, &Show { display, slot, entity, changes, outdated });
                }
                display.parts.slots = slots;
            }
        })
    });
}

/// Primitive whose parts are to be shown.
struct Show<'a> {
    display: &'a FilmDisplay,
    /// Number of the primitive.
    slot: usize,
    /// Entity of the primitive.
    entity: Entity,
    changes: DisplayChanges,
    /// Whether materials must be made again.
    outdated: bool,
}

/// Assets and commands with which parts are written.
#[derive(SystemParam)]
pub(super) struct PartAssets<'w, 's> {
    commands: Commands<'w, 's>,
    places: Query<'w, 's, &'static GlobalTransform>,
    meshes: ResMut<'w, Assets<Mesh>>,
    plain: ResMut<'w, Assets<StandardMaterial>>,
    stained: Option<ResMut<'w, Assets<StainedMaterial>>>,
}

impl PartAssets<'_, '_> {
    /// Brings the parts of a primitive up to date.
    fn show(&mut self, parts: &mut SlotParts, show: &Show) {
        let SlotParts { backs, metal, outline, .. } = parts;
        for (kind, part) in [(StainPart::Back, backs), (StainPart::Metal, metal)] {
            match outline {
                Some(outline) => self.show_part(kind, part, outline, show),
                // Without a material the primitive is not drawn.
                None => self.despawn(part.take()),
            }
        }
    }

    /// Brings one part up to date.
    fn show_part(&mut self, kind: StainPart, part: &mut Option<PartHandle>, outline: &Outline, show: &Show) {
        let Show { display, slot, .. } = show;
        let appearance = &display.appearance;
        let (arrays, changes) = match kind {
            StainPart::Back => (appearance.backs(*slot), appearance.back_changes(*slot)),
            _ => (appearance.metal(*slot), appearance.metal_changes(*slot)),
        };
        let (Some(arrays), Some(changes), Some(own)) = (arrays, changes, display.slots.get(*slot)) else { return };
        // Vertex colours and a texture would be multiplied, and only the alpha of a mask is wanted.
        let in_detail = display.paint.display == StainDisplay::Material || outline.is_masked();
        let by_material = in_detail && self.stained.is_some();
        let carrier = if by_material { StainCarrier::Attributes } else { StainCarrier::Colors };
        let stains = StainWriter { part: kind, paint: &display.paint, carrier, edge: display.edge };
        // Another way of drawing stains needs another mesh layout and another type of material, so another entity.
        self.despawn(part.take_if(|old| matches!(old.material, PartMaterial::Stained(_)) != by_material));
        let attributes = outline.attributes(own.attributes);
        let Some(part) = part else {
            if arrays.is_empty() {
                return;
            }
            let mut mesh = new_mesh();
            let canvas = StainCanvas::new(arrays, stains);
            let shown = write_part(&mut mesh, arrays, attributes, display.space, &canvas);
            let mesh = self.meshes.add(mesh);
            let material = self.add_material(kind, outline, by_material, display);
            let entity = self.spawn(kind, &mesh, &material, show.entity);
            *part = entity.map(|entity| PartHandle { entity, mesh, material, attributes, canvas, shown });
            return;
        };
        if show.outdated {
            self.renew_material(part, kind, outline, display);
        }
        let whole = changes.whole || part.canvas.take_relaid() || !part.shown;
        // What the last update changed is written once.
        let whole = (whole && !show.changes.is_empty()) || part.attributes != attributes;
        let unchanged = show.changes.is_empty() || (changes.is_stained_only() && part.canvas.changed().is_empty());
        if unchanged && !whole {
            return;
        }
        let Some(mut mesh) = self.meshes.get_mut(&part.mesh) else { return };
        if whole {
            part.attributes = attributes;
            part.shown = write_part(&mut mesh, arrays, attributes, display.space, &part.canvas);
        } else {
            patch_part(&mut mesh, arrays, changes, attributes, display.space, &part.canvas);
        }
    }

    /// Adds the material of a part.
    fn add_material(
        &mut self,
        kind: StainPart,
        outline: &Outline,
        by_material: bool,
        display: &FilmDisplay,
    ) -> PartMaterial {
        let (paint, mirrored) = (&display.paint, display.space.is_mirrored());
        match &mut self.stained {
            Some(stained) if by_material => {
                PartMaterial::Stained(stained.add(part_material::stained(paint, kind, outline, mirrored)))
            }
            _ => PartMaterial::Plain(self.plain.add(part_material::plain(paint, kind, outline, mirrored))),
        }
    }

    /// Makes the material of a part again. The quantity that it draws stays.
    fn renew_material(&mut self, part: &PartHandle, kind: StainPart, outline: &Outline, display: &FilmDisplay) {
        let (paint, mirrored) = (&display.paint, display.space.is_mirrored());
        match &part.material {
            PartMaterial::Stained(handle) => {
                let Some(mut material) = self.stained.as_mut().and_then(|stained| stained.get_mut(handle)) else {
                    return;
                };
                let view = material.extension.view;
                *material = part_material::stained(paint, kind, outline, mirrored);
                material.extension.view = view;
            }
            PartMaterial::Plain(handle) => {
                if let Some(mut material) = self.plain.get_mut(handle) {
                    *material = part_material::plain(paint, kind, outline, mirrored);
                }
            }
        }
    }

    /// Spawns the entity of a part as a child of the primitive's entity; `None` if that is gone.
    fn spawn(
        &mut self,
        kind: StainPart,
        mesh: &Handle<Mesh>,
        material: &PartMaterial,
        primitive: Entity,
    ) -> Option<Entity> {
        let transform = *self.places.get(primitive).ok()?;
        let name = if kind == StainPart::Back { "paint backs" } else { "bare metal" };
        let place = (Transform::IDENTITY, transform, Visibility::Inherited, ChildOf(primitive));
        let mut part = self.commands.spawn((CoatingPart, Name::new(name), Mesh3d(mesh.clone()), place));
        match material {
            PartMaterial::Stained(handle) => part.insert(MeshMaterial3d(handle.clone())),
            PartMaterial::Plain(handle) => part.insert(MeshMaterial3d(handle.clone())),
        };
        Some(part.id())
    }

    /// Despawns a part that was shown.
    fn despawn(&mut self, part: Option<PartHandle>) {
        if let Some(part) = part {
            self.commands.entity(part.entity).try_despawn();
        }
    }
}

/// Despawns the parts of a film that is taken off.
pub(super) fn on_display_removed(removed: On<Remove, FilmDisplay>, mut commands: Commands, films: Query<&FilmDisplay>) {
    let Ok(display) = films.get(removed.entity) else { return };
    for part in display.parts.entities().chain(display.heat.as_ref().map(|heat| heat.part)) {
        commands.entity(part).try_despawn();
    }
}
