//! Draws films: turns the [appearance](crate::appearance) of each film into Bevy meshes, materials and child entities.
//!
//! - The prop's [`Mesh3d`](bevy::mesh::Mesh3d) is replaced by a mesh of the film with the prop's own attributes. The
//!   prop's material stays in use, with stains over it as
//!   [`StainDisplay`](crate::api::stain_display::StainDisplay) says. Every prop has its own mesh asset, so that
//!   instances age independently.
//! - With feature `render`, once some film has separated, two children of each primitive's entity
//!   ([`CoatingPart`](crate::api::links::CoatingPart)) draw the backs of flakes and the bare metal, with their stains.
//!   They have the sides and holes of the primitive's material, its layers, shadow flags and visibility. Without that
//!   feature there are no materials for them, and they are left out.
//! - Where a [`HeatMapView`](crate::api::heat_map_view::HeatMapView) asks for it, a further child shows the film in
//!   the colours of a quantity.
//!
//! Films are shown at the level that their distance asks for ([`level`]). Assets are changed only in frames in which
//! the film changed, and then only where it did ([`mesh`]).

mod canvas;
#[cfg(feature = "render")]
mod custom_materials;
mod film_display;
mod film_paint;
#[cfg(feature = "render")]
mod heat;
#[cfg(feature = "render")]
mod heat_overlay;
mod level;
#[cfg(feature = "render")]
mod material;
mod mesh;
#[cfg(feature = "render")]
mod mirror;
#[cfg(feature = "render")]
mod outline;
#[cfg(feature = "render")]
mod outlines;
mod paint;
#[cfg(feature = "render")]
mod part_handles;
#[cfg(feature = "render")]
mod part_material;
#[cfg(feature = "render")]
mod parts;
mod prepared;
mod share;

use bevy::{
    app::{App, Plugin, PostUpdate},
    asset::AssetEventSystems,
    camera::visibility::VisibilitySystems,
    ecs::schedule::IntoScheduleConfigs,
};

pub(crate) use film_display::FilmDisplay;
pub(crate) use film_paint::FilmPaint;
#[cfg(feature = "render")]
pub use material::{
    dress::CoatedMaterial,
    extension::{StainExtension, StainedMaterial},
    view::StainView,
};
#[cfg(feature = "render")]
pub(crate) use material::{
    dress::undress,
    ready::{material_of, transparency_of},
};
pub use mesh::{ATTRIBUTE_REST, ATTRIBUTE_REST_NORMAL, ATTRIBUTE_STAINS};

use crate::api::{
    display_cost::DisplayCost,
    system_sets::{CoatingAttach, CoatingDisplay},
};

/// Plugin that draws films.
pub(crate) struct FilmDisplayPlugin;

impl Plugin for FilmDisplayPlugin {
    fn build(&self, app: &mut App) {
        app.init_resource::<DisplayCost>();
        app.configure_sets(
            PostUpdate,
            (CoatingAttach, CoatingDisplay)
                .chain()
                .before(AssetEventSystems)
                .before(VisibilitySystems::CalculateBounds)
                .before(VisibilitySystems::VisibilityPropagate),
        );
        app.add_systems(
            PostUpdate,
            (
                paint::follow_coatings,
                level::follow_distances,
                share::choose_films,
                film_display::follow_films,
                film_display::write_fronts,
                #[cfg(feature = "render")]
                (outlines::follow_outlines, parts::write_parts, heat::show_heat_maps)
                    .chain()
                    .run_if(parts::has_materials),
            )
                .chain()
                .in_set(CoatingDisplay),
        );
        #[cfg(feature = "render")]
        {
            mirror::add_mirrors(app);
            app.add_observer(parts::on_display_removed);
        }
        #[cfg(feature = "render")]
        if material::add_material(app) {
            app.add_systems(
                PostUpdate,
                (
                    material::dress::undress_props,
                    material::dress::dress_props,
                    material::follow::follow_standard_materials,
                    material::follow::follow_paint,
                )
                    .chain()
                    .after(parts::write_parts)
                    .in_set(CoatingDisplay),
            );
        }
    }

    /// Warns if the plugin was added before the renderer and so could not add its material.
    #[cfg(feature = "render")]
    fn finish(&self, app: &mut App) {
        if material::can_draw(app) && !material::is_added(app) {
            bevy::log::warn!(
                "stains are not drawn on paint: add `CoatingWeatheringPlugin` after `DefaultPlugins` (or `PbrPlugin`)"
            );
        }
    }
}
