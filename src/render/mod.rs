//! Display: the [shown parts](crate::shown) of each film become Bevy meshes, materials and children.
//!
//! - The prop's [`Mesh3d`](bevy::mesh::Mesh3d) is swapped for a mesh of the film that wears the prop's surface; the
//!   material stays. Every prop has a mesh asset of its own, so instances age apart.
//! - With feature `render`, once some film has separated, two children of the film's entity
//!   ([`CoatingPart`](crate::plugin::CoatingPart)) show the backs of flakes in the primer's colour, and the bare
//!   metal. Without it there are no materials to show them with, and they are left out.
//!
//! Assets are touched only in frames in which the film changed.

mod film_display;
mod mesh;
#[cfg(feature = "render")]
mod parts;
#[cfg(feature = "render")]
mod patina;

use bevy::{
    app::{App, Plugin, PostUpdate},
    asset::AssetEventSystems,
    camera::visibility::VisibilitySystems,
    ecs::schedule::{IntoScheduleConfigs, SystemSet},
};

pub(crate) use film_display::FilmDisplay;
#[cfg(feature = "render")]
pub(crate) use parts::is_material_ready;

use crate::plugin::CoatingAttach;

/// In `PostUpdate`: the meshes of films that changed are brought up to date, in time for bounds, visibility and
/// extraction.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct CoatingDisplay;

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
                film_display::follow_films,
                film_display::write_fronts,
                #[cfg(feature = "render")]
                parts::write_parts.run_if(parts::has_materials),
                #[cfg(feature = "render")]
                parts::follow_looks.run_if(parts::has_materials),
            )
                .chain()
                .in_set(CoatingDisplay),
        );
    }
}
