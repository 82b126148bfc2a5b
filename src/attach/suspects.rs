//! Notes what a refusal may lie in, so that it can be seen when that changes.

use bevy::{
    asset::AssetId,
    ecs::{component::ComponentId, entity::Entity, world::World},
    mesh::Mesh3d,
    transform::components::GlobalTransform,
};

use crate::{
    api::{
        coating::Coating,
        links::{AwaitingFilm, CoatedBy, CoatingFilms, FilmRefused, FilmSlot, LeftAlone, Suspects},
        paint::SettingsSource,
        unit::CoatingUnit,
    },
    settings::CoatingSettings,
};

/// Returns everything that decides whether the mesh of `entity` can be coated by `root`, as it is now.
pub(super) fn suspects_of(world: &World, entity: Entity, root: Entity) -> Option<Suspects> {
    let found = world.get_entity(entity).ok()?;
    let coating = world.get::<Coating>(root)?;
    let own = own_components(world);
    let components = found.archetype().components().iter().copied().filter(|id| !own.contains(&Some(*id)));
    let scale = found.get::<GlobalTransform>().copied().unwrap_or_default().scale();
    let valid = coating.validate().is_ok();
    Some(Suspects {
        mesh: found.get::<Mesh3d>()?.id(),
        #[cfg(feature = "render")]
        material: crate::display::material_of(found),
        components: components.collect(),
        coating: (coating.key(), coating.stain_display, coating.shelter, valid),
        settings: bits_of(&coating.settings),
        scale: scale.to_array().map(f32::to_bits),
        unit: world.get_resource::<CoatingUnit>().copied().unwrap_or_default().metres.to_bits(),
    })
}

/// Returns the settings asset, or the bits of settings that are stored in the coating.
fn bits_of(source: &SettingsSource) -> (Option<AssetId<CoatingSettings>>, Vec<u32>) {
    match source {
        SettingsSource::Inline(settings) => {
            (None, CoatingSettings::fields().map(|field| field.get(settings).to_bits()).collect())
        }
        SettingsSource::Asset(handle) => (Some(handle.id()), Vec::new()),
    }
}

/// Returns the components with which the plugin itself marks meshes.
fn own_components(world: &World) -> [Option<ComponentId>; 6] {
    [
        world.component_id::<AwaitingFilm>(),
        world.component_id::<FilmRefused>(),
        world.component_id::<LeftAlone>(),
        world.component_id::<FilmSlot>(),
        world.component_id::<CoatedBy>(),
        world.component_id::<CoatingFilms>(),
    ]
}
