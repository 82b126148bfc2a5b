//! Puts films on the meshes below a `Coating`, and takes them off again.
//!
//! ```text
//! mesh found --AwaitingFilm--> assets loaded --FilmBuild--> task done --> film components, Mesh3d swapped
//!      ^                            |                           |                  |
//!      |                       FilmRefused, LeftAlone           |             FilmOutdated: another FilmBuild
//!      |                            |                           |                  |
//!      +-- cause mended ------------+      handle swapped ------+------------------+
//! ```
//!
//! The systems run in `PostUpdate` after transforms have been propagated. No frame waits for a build.

mod begin;
mod build;
mod copy;
mod detach;
mod discover;
#[cfg(feature = "gltf")]
mod extras;
mod finish;
mod follow;
mod group;
mod hierarchy;
mod masks;
mod order;
mod recheck;
mod share;
mod suspects;

use bevy::{
    app::{App, PostUpdate},
    ecs::schedule::IntoScheduleConfigs,
    transform::TransformSystems,
};

use crate::{
    api::system_sets::CoatingAttach,
    shelter::{self, ShelterScene, ShelteredFilms},
};

/// Adds the systems that put films on props, and the survey of shelters between them.
pub(crate) fn add_attachment(app: &mut App) {
    app.configure_sets(PostUpdate, CoatingAttach.after(TransformSystems::Propagate));
    app.init_resource::<ShelterScene>().init_resource::<ShelteredFilms>();
    app.add_systems(
        PostUpdate,
        (
            finish::finish_builds,
            copy::copy_clones,
            (discover::find_saved, discover::find_meshes).chain(),
            discover::find_outdated,
            recheck::recheck_refused,
            follow::follow_coatings,
            shelter::survey,
            begin::begin_builds,
            shelter::cast,
        )
            .chain()
            .in_set(CoatingAttach),
    );
    #[cfg(feature = "gltf")]
    app.add_systems(PostUpdate, extras::coat_by_extras.after(TransformSystems::Propagate).before(CoatingAttach));
    app.add_observer(detach::on_coating_removed).add_observer(detach::on_slot_removed);
}
