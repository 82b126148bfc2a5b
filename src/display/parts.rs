//! Writes the backs of flakes and the bare metal to two children of a film's entity, which are spawned when there is
//! first something to draw.

use bevy::{
    asset::{Assets, Handle},
    camera::visibility::RenderLayers,
    color::{Color, ColorToComponents, LinearRgba},
    ecs::{
        change_detection::{DetectChanges, DetectChangesMut},
        entity::Entity,
        hierarchy::ChildOf,
        name::Name,
        system::{Commands, Query, Res, ResMut, SystemParam},
    },
    light::{NotShadowCaster, NotShadowReceiver},
    mesh::{Mesh, Mesh3d},
    pbr::{MeshMaterial3d, StandardMaterial},
    prelude::Visibility,
    render::render_resource::Face,
    transform::components::{GlobalTransform, Transform},
};

use super::{
    film_display::FilmDisplay,
    film_paint::FilmPaint,
    material::{
        dress::CoatedMaterial,
        extension::{StainExtension, StainedMaterial},
        view::StainView,
    },
    mesh::{PartSpace, StainCarrier, StainWriter, move_part, new_mesh, write_part, write_stains},
    part_handles::{PartHandle, PartMaterial},
};
use crate::{
    api::{
        diagnostics::CoatingTimings,
        links::{CoatingPart, FilmSource},
        stain_display::StainDisplay,
    },
    appearance::{DisplayChanges, MeshPart, shading::StainPart},
    mesh_reader::SlotAttributes,
    sim::Stage,
};

/// Returns whether the app has standard materials at all; a server may not.
pub(super) fn has_materials(materials: Option<Res<Assets<StandardMaterial>>>) -> bool {
    materials.is_some()
}

/// Sides of the prop's faces that its own materials draw.
struct MaterialSides {
    cull_mode: Option<Face>,
    double_sided: bool,
    /// Side that is not drawn where only one is.
    hidden: Face,
}

impl MaterialSides {
    /// Returns the sides of the first primitive with a standard material, or of the first one that is two-sided. `None`
    /// without such a material: then the prop is not drawn, either.
    fn of(
        slots: &[Entity],
        props: &Query<PropParts<'static>>,
        materials: &Assets<StandardMaterial>,
        space: PartSpace,
    ) -> Option<Self> {
        let mut sides: Option<Self> = None;
        for &slot in slots {
            let Ok((plain, coated, ..)) = props.get(slot) else { continue };
            let own = plain.map(|own| &own.0).or(coated.map(|own| &own.0));
            let Some(material) = own.and_then(|own| materials.get(own)) else { continue };
            let other_side = if space.is_mirrored() { Face::Front } else { Face::Back };
            let this = Self {
                cull_mode: material.cull_mode,
                double_sided: material.double_sided,
                hidden: material.cull_mode.unwrap_or(other_side),
            };
            if sides.as_ref().is_none_or(|sides| sides.cull_mode.is_some() && this.cull_mode.is_none()) {
                sides = Some(this);
            }
        }
        sides
    }
}

/// Components of the prop that the children take over.
type PropParts<'a> = (
    Option<&'a MeshMaterial3d<StandardMaterial>>,
    Option<&'a CoatedMaterial>,
    Option<&'a RenderLayers>,
    Option<&'a NotShadowCaster>,
    Option<&'a NotShadowReceiver>,
);

/// Writes the backs and the metal of the films that changed, and spawns them when there is first something to draw.
pub(super) fn write_parts(
    mut films: Query<(Entity, &FilmSource, &GlobalTransform, &mut FilmDisplay)>,
    mut assets: PartAssets,
    mut timings: ResMut<CoatingTimings>,
) {
    timings.measure(Stage::MeshGeneration, || {
        for (film, source, transform, mut display) in &mut films {
            // A film that was aged before it was put on its prop has backs and metal from its first frame on.
            let new = display.is_added();
            let display = display.bypass_change_detection();
            let changes = if new { DisplayChanges::everything() } else { display.changes };
            if changes.is_empty() {
                continue;
            }
            let mut parts = std::mem::take(&mut display.parts);
            let home = Home { film, transform, source };
            assets.show(display, StainPart::Back, &mut parts.backs, changes, &home);
            assets.show(display, StainPart::Metal, &mut parts.metal, changes, &home);
            display.parts = parts;
        }
    });
}

/// Place where a part is spawned.
struct Home<'a> {
    film: Entity,
    transform: &'a GlobalTransform,
    source: &'a FilmSource,
}

/// Assets and commands with which parts are written.
#[derive(SystemParam)]
pub(super) struct PartAssets<'w, 's> {
    commands: Commands<'w, 's>,
    props: Query<'w, 's, PropParts<'static>>,
    meshes: ResMut<'w, Assets<Mesh>>,
    plain: ResMut<'w, Assets<StandardMaterial>>,
    stained: Option<ResMut<'w, Assets<StainedMaterial>>>,
}

impl PartAssets<'_, '_> {
    /// Brings one part up to date.
    fn show(
        &mut self,
        display: &FilmDisplay,
        kind: StainPart,
        part: &mut Option<PartHandle>,
        changes: DisplayChanges,
        home: &Home,
    ) {
        let arrays = if kind == StainPart::Back { display.appearance.backs() } else { display.appearance.metal() };
        let paint = &display.paint;
        let by_material = paint.display == StainDisplay::Material && self.stained.is_some();
        let carrier = if by_material { StainCarrier::Attributes } else { StainCarrier::Colors };
        let stains = StainWriter { part: kind, paint, carrier, edge: display.edge };
        // Another way of drawing stains needs another mesh layout and another type of material, so another entity.
        if let Some(old) = part.take_if(|old| matches!(old.material, PartMaterial::Stained(_)) != by_material) {
            self.commands.entity(old.entity).try_despawn();
        }
        if let Some(part) = part {
            self.write(part, arrays, stains, changes, display.space);
        } else if !arrays.is_empty()
            && let Some(sides) = MaterialSides::of(&home.source.slots, &self.props, &self.plain, display.space)
        {
            let mut mesh = new_mesh();
            write_part(&mut mesh, arrays, SlotAttributes::default(), display.space, stains);
            let mesh = self.meshes.add(mesh);
            let base = if kind == StainPart::Back { primer(paint, &sides) } else { bare_metal(paint, &sides) };
            let material = self.add_material(base, kind, paint, by_material);
            let entity = self.spawn(kind, &mesh, &material, home);
            *part = Some(PartHandle { entity, mesh, material });
        }
    }

    /// Writes what changed of one part to its mesh.
    fn write(
        &mut self,
        part: &PartHandle,
        arrays: &MeshPart,
        stains: StainWriter,
        changes: DisplayChanges,
        space: PartSpace,
    ) {
        let moves = stains.part == StainPart::Back;
        let whole = changes.exposure || (changes.topology && moves);
        let moved = moves && changes.moved;
        if !(whole || changes.stains || moved) {
            return;
        }
        let Some(mut mesh) = self.meshes.get_mut(&part.mesh) else { return };
        if whole {
            write_part(&mut mesh, arrays, SlotAttributes::default(), space, stains);
            return;
        }
        if moved {
            move_part(&mut mesh, arrays, space);
        }
        if changes.stains {
            write_stains(&mut mesh, arrays, stains);
        }
    }

    /// Adds the material of a part.
    fn add_material(
        &mut self,
        base: StandardMaterial,
        part: StainPart,
        paint: &FilmPaint,
        by_material: bool,
    ) -> PartMaterial {
        match &mut self.stained {
            Some(stained) if by_material => {
                let (shading, pattern) = (paint.shading.clone(), paint.pattern);
                let extension = StainExtension { part, shading, pattern, view: StainView::Lit };
                PartMaterial::Stained(stained.add(StainedMaterial { base, extension }))
            }
            _ => PartMaterial::Plain(self.plain.add(StandardMaterial { base_color: Color::WHITE, ..base })),
        }
    }

    /// Spawns the entity of a part as a child of the film.
    fn spawn(&mut self, kind: StainPart, mesh: &Handle<Mesh>, material: &PartMaterial, home: &Home) -> Entity {
        let name = if kind == StainPart::Back { "paint backs" } else { "bare metal" };
        let place = (Transform::IDENTITY, *home.transform, Visibility::Inherited, ChildOf(home.film));
        let mut part = self.commands.spawn((CoatingPart, Name::new(name), Mesh3d(mesh.clone()), place));
        match material {
            PartMaterial::Stained(handle) => part.insert(MeshMaterial3d(handle.clone())),
            PartMaterial::Plain(handle) => part.insert(MeshMaterial3d(handle.clone())),
        };
        let slot = home.source.slots.first();
        if let Some((.., layers, no_shadow, unshadowed)) = slot.and_then(|&slot| self.props.get(slot).ok()) {
            layers.map(|layers| part.insert(layers.clone()));
            no_shadow.map(|_| part.insert(NotShadowCaster));
            unshadowed.map(|_| part.insert(NotShadowReceiver));
        }
        part.id()
    }
}

/// Returns the material of the backs. Their triangles are wound against the prop's, so one side is enough.
fn primer(paint: &FilmPaint, sides: &MaterialSides) -> StandardMaterial {
    let shading = paint.shading.primer.surface();
    StandardMaterial {
        base_color: Color::LinearRgba(LinearRgba::from_vec3(shading.base_color)),
        perceptual_roughness: shading.roughness,
        reflectance: shading.reflectance,
        cull_mode: Some(sides.hidden),
        ..StandardMaterial::default()
    }
}

/// Returns the material of the bare metal, drawn from the same sides as the prop. Its stains give it its shading; where
/// they are drawn as vertex colours only, metalness and roughness are halfway between steel and rust.
fn bare_metal(paint: &FilmPaint, sides: &MaterialSides) -> StandardMaterial {
    StandardMaterial {
        base_color: Color::WHITE,
        metallic: 0.5 * paint.shading.metal.metallic,
        perceptual_roughness: 0.5 * (paint.shading.metal.roughness + paint.shading.stains.rust_roughness),
        cull_mode: sides.cull_mode,
        double_sided: sides.double_sided,
        ..StandardMaterial::default()
    }
}
