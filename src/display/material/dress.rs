//! A coated prop wears its own material with stains on it, and gets its own back.
//!
//! The type of an entity's material is changed here and nowhere else: in `PostUpdate`, before Bevy looks for changed
//! materials, so that in the frame in which an entity has another material it also gets another pipeline. Later in the
//! frame would be too late, and on the GPU a pipeline would meet the bindings of another one (compare
//! bevyengine/bevy#21410, which was about off-screen entities).

use bevy::{
    asset::{Assets, Handle},
    ecs::{
        component::Component,
        entity::Entity,
        query::{Or, With},
        reflect::ReflectComponent,
        system::{Commands, Query, Res, ResMut},
    },
    pbr::{MeshMaterial3d, StandardMaterial},
    reflect::prelude::*,
};

use super::{StainExtension, StainView};
use crate::{
    api::{links::FilmSlot, stain_display::StainDisplay},
    appearance::shading::StainPart,
    display::{FilmDisplay, StainedMaterial},
};
/// The prop's own material, on a mesh entity that wears it with stains while it is coated. It comes back when the
/// coating goes. Changes of the asset show, and so does another handle put here or inserted as a
/// `MeshMaterial3d<StandardMaterial>`.
#[derive(Component, Clone, Debug, Default, PartialEq, Eq, Reflect)]
#[reflect(Component, Default, Debug, Clone, PartialEq)]
pub struct CoatedMaterial(pub Handle<StandardMaterial>);

/// Replaces the materials of props whose film shows its stains by a material. One that is not loaded yet is waited for.
pub(in crate::display) fn dress_props(
    mut commands: Commands,
    slots: Query<(Entity, &FilmSlot, &MeshMaterial3d<StandardMaterial>, Option<&MeshMaterial3d<StainedMaterial>>)>,
    films: Query<&FilmDisplay>,
    own: Res<Assets<StandardMaterial>>,
    mut stained: ResMut<Assets<StainedMaterial>>,
) {
    for (entity, slot, MeshMaterial3d(handle), worn) in &slots {
        let Some(display) = films.get(slot.film).ok().filter(|_| slot.shown.is_some()) else { continue };
        if display.paint.display != StainDisplay::Material {
            continue;
        }
        let Some(base) = own.get(handle).cloned() else { continue };
        let worn = worn.map_or_else(
            || {
                let (shading, pattern) = (display.paint.shading.clone(), display.paint.pattern);
                let extension = StainExtension { part: StainPart::Film, shading, pattern, view: StainView::Lit };
                stained.add(StainedMaterial { base: base.clone(), extension })
            },
            |worn| worn.0.clone(),
        );
        if let Some(mut material) = stained.get_mut(&worn) {
            material.base = base;
        }
        commands
            .entity(entity)
            .try_remove::<MeshMaterial3d<StandardMaterial>>()
            .try_insert((MeshMaterial3d(worn), CoatedMaterial(handle.clone())));
    }
}

/// Gives the materials back of props that have no film any more, or one that shows its stains otherwise.
pub(in crate::display) fn undress_props(
    mut commands: Commands,
    props: Query<
        (Entity, Option<&FilmSlot>, &CoatedMaterial, Option<&MeshMaterial3d<StandardMaterial>>),
        Or<(With<MeshMaterial3d<StainedMaterial>>, With<CoatedMaterial>)>,
    >,
    films: Query<&FilmDisplay>,
) {
    for (entity, slot, CoatedMaterial(own), other) in &props {
        let display = slot.filter(|slot| slot.shown.is_some()).and_then(|slot| films.get(slot.film).ok());
        if display.is_some_and(|display| display.paint.display == StainDisplay::Material) {
            continue;
        }
        let mut entity = commands.entity(entity);
        entity.try_remove::<(MeshMaterial3d<StainedMaterial>, CoatedMaterial)>();
        if other.is_none() {
            entity.try_insert(MeshMaterial3d(own.clone()));
        }
    }
}
