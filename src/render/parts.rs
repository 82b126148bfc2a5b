//! The backs of flakes and the bare metal: two children of a film's entity, spawned when they are first seen.

use bevy::{
    asset::{Assets, Handle},
    camera::visibility::RenderLayers,
    color::Color,
    ecs::{
        change_detection::DetectChangesMut,
        entity::Entity,
        hierarchy::ChildOf,
        name::Name,
        query::Changed,
        system::{Commands, Query, Res, ResMut},
        world::{EntityRef, World},
    },
    light::{NotShadowCaster, NotShadowReceiver},
    mesh::{Mesh, Mesh3d},
    pbr::{MeshMaterial3d, StandardMaterial},
    prelude::{AlphaMode, Visibility},
    render::render_resource::Face,
    transform::components::{GlobalTransform, Transform},
};

use super::{
    FilmDisplay,
    mesh::{PartSpace, insert, move_part, new_mesh, write_part},
    patina::patina,
};
use crate::{
    film::FilmMesh,
    plugin::{CoatedBy, Coating, CoatingFault, CoatingPart, CoatingTimings, FilmSource, SlotAttributes},
    sim::Stage,
};

/// Size of a patch of rust on the metal, in mean film edges.
const PATCH: f32 = 5.0;

/// Assets of a film's backs and metal.
#[derive(Default)]
pub(super) struct PartHandles {
    backs: Option<(Handle<Mesh>, Handle<StandardMaterial>)>,
    metal: Option<(Handle<Mesh>, Handle<StandardMaterial>)>,
}

/// Whether the app has standard materials at all: a server may not.
pub(super) fn has_materials(materials: Option<Res<Assets<StandardMaterial>>>) -> bool {
    materials.is_some()
}

/// Whether the material of a mesh is known; refuses blended ones.
///
/// # Errors
/// [`CoatingFault::AlphaBlended`].
pub(crate) fn is_material_ready(world: &World, entity: EntityRef) -> Result<bool, CoatingFault> {
    let Some(MeshMaterial3d(handle)) = entity.get::<MeshMaterial3d<StandardMaterial>>() else { return Ok(true) };
    if !world.contains_resource::<Assets<StandardMaterial>>() {
        return Ok(true);
    }
    let fault = CoatingFault::MaterialNotLoaded;
    let Some(material) = crate::plugin::loaded(world, handle, fault)? else { return Ok(false) };
    match material.alpha_mode {
        AlphaMode::Opaque | AlphaMode::Mask(_) | AlphaMode::AlphaToCoverage => Ok(true),
        _ => Err(CoatingFault::AlphaBlended),
    }
}

/// How the prop's own materials show their sides.
struct Sides {
    cull_mode: Option<Face>,
    double_sided: bool,
    /// Side that is not shown where only one is.
    hidden: Face,
}

impl Sides {
    /// Those of the first primitive with a standard material; two-sided if any is. `None` without a material: then
    /// nothing is drawn of the prop, either.
    fn of(
        slots: &[Entity],
        props: &Query<PropParts>,
        materials: &Assets<StandardMaterial>,
        space: PartSpace,
    ) -> Option<Self> {
        let mut sides: Option<Self> = None;
        for &slot in slots {
            let Some(material) = props.get(slot).ok().and_then(|parts| materials.get(&parts.0?.0)) else { continue };
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

/// What the children take over from the prop.
type PropParts = (
    Option<&'static MeshMaterial3d<StandardMaterial>>,
    Option<&'static RenderLayers>,
    Option<&'static NotShadowCaster>,
    Option<&'static NotShadowReceiver>,
);

/// Writes the backs and the metal of the films that changed, and spawns them when there are some for the first time.
pub(super) fn write_parts(
    mut commands: Commands,
    mut films: Query<(Entity, &FilmMesh, &CoatedBy, &FilmSource, &GlobalTransform, &mut FilmDisplay)>,
    coatings: Query<&Coating>,
    props: Query<PropParts>,
    mut meshes: ResMut<Assets<Mesh>>,
    mut materials: ResMut<Assets<StandardMaterial>>,
    mut timings: ResMut<CoatingTimings>,
) {
    timings.measure(Stage::MeshGeneration, || {
        for (film, mesh, coated_by, source, transform, mut display) in &mut films {
            let display = display.bypass_change_detection();
            let Some(change) = display.pending_parts.take() else { continue };
            let Ok(coating) = coatings.get(coated_by.0) else { continue };
            let space = display.space;
            let mut spawn = |name: &'static str, mesh: &Handle<Mesh>, material: &Handle<StandardMaterial>| {
                let look = (Mesh3d(mesh.clone()), MeshMaterial3d(material.clone()));
                let place = (Transform::IDENTITY, *transform, Visibility::Inherited, ChildOf(film));
                let mut part = commands.spawn((CoatingPart, Name::new(name), look, place));
                let Some(Ok((_, layers, no_shadow, unshadowed))) = source.slots.first().map(|&slot| props.get(slot))
                else {
                    return;
                };
                layers.map(|layers| part.insert(layers.clone()));
                no_shadow.map(|_| part.insert(NotShadowCaster));
                unshadowed.map(|_| part.insert(NotShadowReceiver));
            };
            let (backs, metal) = (display.shown.backs(), display.shown.metal());
            if let Some((handle, _)) = &display.parts.backs {
                if let Some(mut mesh) = meshes.get_mut(handle) {
                    if change.topology || change.exposure {
                        write_part(&mut mesh, backs, SlotAttributes::default(), space);
                    } else {
                        move_part(&mut mesh, backs, space);
                    }
                }
            } else if !backs.is_empty()
                && let Some(sides) = Sides::of(&source.slots, &props, &materials, space)
            {
                let mut mesh = new_mesh();
                write_part(&mut mesh, backs, SlotAttributes::default(), space);
                let handles = (meshes.add(mesh), materials.add(primer(coating, &sides)));
                spawn("paint backs", &handles.0, &handles.1);
                display.parts.backs = Some(handles);
            }
            let patch = mesh.geometry.mean_edge * PATCH;
            let write_metal = |mesh: &mut Mesh| {
                write_part(mesh, metal, SlotAttributes::default(), space);
                let [steel, rust] = [coating.metal.steel, coating.metal.rust].map(|color| color.to_linear());
                if !metal.is_empty() {
                    insert(mesh, Mesh::ATTRIBUTE_COLOR, patina(&metal.positions, steel, rust, patch, coating.seed));
                }
            };
            if let Some((handle, _)) = &display.parts.metal {
                if change.exposure
                    && let Some(mut mesh) = meshes.get_mut(handle)
                {
                    write_metal(&mut mesh);
                }
            } else if !metal.is_empty()
                && let Some(sides) = Sides::of(&source.slots, &props, &materials, space)
            {
                let mut mesh = new_mesh();
                write_metal(&mut mesh);
                let handles = (meshes.add(mesh), materials.add(bare_metal(coating, &sides)));
                spawn("bare metal", &handles.0, &handles.1);
                display.parts.metal = Some(handles);
            }
        }
    });
}

/// Hands changed colours to the materials. The patches of the metal follow with its next change.
pub(super) fn follow_looks(
    changed: Query<(), Changed<Coating>>,
    coatings: Query<&Coating>,
    films: Query<(&CoatedBy, &FilmDisplay)>,
    mut materials: ResMut<Assets<StandardMaterial>>,
) {
    if changed.is_empty() {
        return;
    }
    for (coated_by, display) in &films {
        let Ok(coating) = coatings.get(coated_by.0) else { continue };
        if !changed.contains(coated_by.0) {
            continue;
        }
        let [backs, metal] = [&display.parts.backs, &display.parts.metal].map(|part| part.as_ref().map(|part| &part.1));
        if let Some(mut material) = backs.and_then(|handle| materials.get_mut(handle))
            && material.base_color != coating.primer
        {
            material.base_color = coating.primer;
        }
        let look = (coating.metal.metallic, coating.metal.roughness);
        if let Some(mut material) = metal.and_then(|handle| materials.get_mut(handle))
            && (material.metallic, material.perceptual_roughness) != look
        {
            (material.metallic, material.perceptual_roughness) = look;
        }
    }
}

/// The back of the paint. Its triangles are wound against the prop's, so one side is enough.
fn primer(coating: &Coating, sides: &Sides) -> StandardMaterial {
    StandardMaterial {
        base_color: coating.primer,
        perceptual_roughness: 0.85,
        reflectance: 0.3,
        cull_mode: Some(sides.hidden),
        ..StandardMaterial::default()
    }
}

/// Bare metal: vertex colours carry the rust. Shown from the sides from which the prop is.
fn bare_metal(coating: &Coating, sides: &Sides) -> StandardMaterial {
    StandardMaterial {
        base_color: Color::WHITE,
        metallic: coating.metal.metallic,
        perceptual_roughness: coating.metal.roughness,
        cull_mode: sides.cull_mode,
        double_sided: sides.double_sided,
        ..StandardMaterial::default()
    }
}
