//! From a `Coating` to films on the meshes below it, and back.
//!
//! ```text
//! mesh found --AwaitingFilm--> assets loaded --FilmBuild--> task done --> film components, Mesh3d swapped
//!      ^                                                        |                        |
//!      +---------------- handle swapped, coating changed -------+------------------------+
//! ```
//!
//! All of it runs in `PostUpdate` once transforms are known, and nothing waits for a build.

mod begin;
mod build;
mod detach;
mod discover;
mod finish;
mod surface;

use bevy::{
    app::{App, PostUpdate},
    ecs::schedule::{IntoScheduleConfigs, SystemSet},
    transform::TransformSystems,
};

use super::shelter::{self, ShelterScene};

#[cfg(feature = "render")]
pub(crate) use begin::loaded;
pub(crate) use surface::{SlotAttributes, shape_of};

/// In `PostUpdate`: finished films are put on their props, meshes to be coated are found, builds are begun.
#[derive(SystemSet, Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct CoatingAttach;

pub(super) fn add_attachment(app: &mut App) {
    app.configure_sets(PostUpdate, CoatingAttach.after(TransformSystems::Propagate));
    app.init_resource::<ShelterScene>();
    app.add_systems(
        PostUpdate,
        (
            finish::finish_builds,
            discover::find_meshes,
            discover::follow_coatings,
            shelter::survey,
            begin::begin_builds,
            shelter::cast,
        )
            .chain()
            .in_set(CoatingAttach),
    );
    app.add_observer(detach::on_coating_removed);
}
