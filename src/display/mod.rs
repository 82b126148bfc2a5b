//! Display: the [shown parts](crate::appearance) of each film become Bevy meshes, materials and children.
//!
//! - The prop's [`Mesh3d`](bevy::mesh::Mesh3d) is swapped for a mesh of the film that wears the prop's surface; the
//!   material goes on showing, with stains over it as [`StainDisplay`] says. Every prop has a mesh asset of its own, so
//!   instances age apart.
//! - With feature `render`, once some film has separated, two children of the film's entity
//!   ([`CoatingPart`](crate::plugin::CoatingPart)) show the backs of flakes in the primer's colour, and the bare
//!   metal, both with their stains. Without it there are no materials to show them with, and they are left out.
//!
//! Assets are touched only in frames in which the film changed.

mod film_display;
#[cfg(feature = "render")]
mod material;
mod mesh;
mod paint;
#[cfg(feature = "render")]
mod parts;

use bevy::{
    app::{App, Plugin, PostUpdate},
    asset::AssetEventSystems,
    camera::visibility::VisibilitySystems,
    ecs::schedule::IntoScheduleConfigs,
};

pub(crate) use film_display::FilmDisplay;
#[cfg(feature = "render")]
pub use material::{CoatedMaterial, StainExtension, StainView, StainedMaterial};
pub use mesh::{ATTRIBUTE_REST, ATTRIBUTE_REST_NORMAL, ATTRIBUTE_STAINS};
pub(crate) use paint::FilmPaint;
#[cfg(feature = "render")]
pub(crate) use parts::is_material_ready;

use crate::api::system_sets::{CoatingAttach, CoatingDisplay};

/// Shows films.
pub(crate) struct FilmDisplayPlugin;

impl Plugin for FilmDisplayPlugin {
    fn build(&self, app: &mut App) {
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
                film_display::follow_films,
                film_display::write_fronts,
                #[cfg(feature = "render")]
                parts::write_parts.run_if(parts::has_materials),
            )
                .chain()
                .in_set(CoatingDisplay),
        );
        #[cfg(feature = "render")]
        if material::add_material(app) {
            app.add_systems(
                PostUpdate,
                (
                    material::undress_props,
                    material::dress_props,
                    material::follow_standard_materials,
                    material::follow_paint,
                )
                    .chain()
                    .after(parts::write_parts)
                    .in_set(CoatingDisplay),
            );
        }
    }

    /// Tells when the plugin came before the renderer and so could not add its material.
    #[cfg(feature = "render")]
    fn finish(&self, app: &mut App) {
        if material::can_draw(app) && !material::is_added(app) {
            bevy::log::warn!(
                "stains are not drawn on paint: add `CoatingWeatheringPlugin` after `DefaultPlugins` (or `PbrPlugin`)"
            );
        }
    }
}
