//! Pointing at paint: Bevy's picking hits films as they are, and a brush follows the pointer.
//!
//! ```text
//! rays of pointers --picking--> hits on films --brush--> touches, in strokes
//!                                      \--ring--> the rim of the brush, on the surface
//! ```

mod brush;
mod picking;
mod ring;

use bevy::{
    app::{App, Plugin, PostUpdate, PreUpdate, Update},
    ecs::schedule::IntoScheduleConfigs,
    gizmos::{AppGizmoBuilder, GizmoPlugin},
    picking::{PickingSystems, backend::ray::RayMap},
    prelude::resource_exists,
    transform::TransformSystems,
};

pub use brush::CoatingBrush;
pub use ring::BrushGizmos;

/// Plugin that lets Bevy's pointers hit films, moved and curled as they are, and paints with a [`CoatingBrush`].
///
/// Hits are on the entities of films, with a [`FilmHit`](crate::FilmHit) as their extra data. Add it after
/// `DefaultPlugins`, with Bevy's feature `bevy_picking`; the rim of the brush is drawn where Bevy's gizmos are
/// (`bevy_gizmos_render`).
///
/// ```
/// use bevy::{picking::{DefaultPickingPlugins, input::PointerInputPlugin}, prelude::*};
/// use bevy_coating::{CoatingBrush, CoatingPointingPlugin, prelude::*, touch::{Change, Effect}};
///
/// fn take_brush(mut brush: ResMut<CoatingBrush>) {
///     brush.effect = Some(Effect::Adhesion(Change::Multiply(0.5)));
///     brush.radius = 0.05;
/// }
///
/// let mut app = App::new();
/// // In a game: DefaultPlugins.
/// # app.add_plugins((bevy::input::InputPlugin, bevy::window::WindowPlugin::default()));
/// app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin))
///     .add_plugins(DefaultPickingPlugins)
///     .add_plugins((CoatingWeatheringPlugin::default(), CoatingPointingPlugin))
///     .add_systems(Startup, take_brush)
///     .update();
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct CoatingPointingPlugin;

impl Plugin for CoatingPointingPlugin {
    fn build(&self, app: &mut App) {
        app.init_resource::<CoatingBrush>().init_resource::<brush::Stroke>();
        app.add_systems(
            PreUpdate,
            picking::hit_films.in_set(PickingSystems::Backend).run_if(resource_exists::<RayMap>),
        );
        app.add_systems(Update, brush::paint.run_if(brush::has_pointers));
        if app.is_plugin_added::<GizmoPlugin>() {
            app.init_gizmo_group::<BrushGizmos>();
            app.add_systems(PostUpdate, ring::draw_ring.after(TransformSystems::Propagate).run_if(brush::has_pointers));
        }
    }
}
