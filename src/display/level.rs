//! Shows each film at the level that its distance from the cameras asks for. The other level is prepared in the
//! background, and what happened to the film meanwhile follows when it is put on.

use bevy::{
    asset::Assets,
    camera::Camera,
    ecs::{
        change_detection::DetectChangesMut,
        entity::Entity,
        query::With,
        system::{Query, ResMut},
    },
    math::Vec3,
    mesh::Mesh,
    tasks::{AsyncComputeTaskPool, futures::check_ready},
    transform::components::GlobalTransform,
};

use super::{
    film_display::FilmDisplay,
    prepared::{LevelChange, PreparedLevel},
};
use crate::{
    api::{
        coating::Coating,
        film_pace::FilmPace,
        heat_map_view::HeatMapView,
        links::{CoatedBy, FilmSource},
        turn::Turn,
    },
    appearance::{Detail, DisplayChanges},
    film::FilmMesh,
    fracture::FilmForces,
    mesh_reader::SlotAttributes,
    stain::StainFields,
};

/// Largest number of films whose change of level begins in one frame: each film's state is copied for it.
const BEGINNINGS: usize = 4;

/// What decides how large things are in the image of a camera.
struct View {
    eye: Vec3,
    /// Length in pixels of what is one unit long and, in perspective, one unit away.
    pixels: f32,
    perspective: bool,
}

impl View {
    /// Returns the view of a camera that draws something.
    fn of(camera: &Camera, at: &GlobalTransform) -> Option<Self> {
        let height = camera.physical_viewport_size().filter(|_| camera.is_active)?.y as f32;
        let projection = camera.clip_from_view();
        let pixels = 0.5 * height * projection.y_axis.y.abs();
        Some(Self { eye: at.translation(), pixels, perspective: projection.w_axis.w == 0.0 })
    }

    /// Returns the length in pixels of a unit in the nearest point of a sphere.
    fn pixels_at(&self, middle: Vec3, radius: f32) -> f32 {
        let near = (self.eye.distance(middle) - radius).max(f32::MIN_POSITIVE);
        if self.perspective { self.pixels / near } else { self.pixels }
    }
}

/// Puts the levels on that have been prepared, and begins to prepare others.
pub(super) fn follow_distances(
    mut films: Query<(
        Entity,
        (&FilmMesh, &FilmForces, &StainFields),
        (&CoatedBy, &FilmSource, &FilmPace, &GlobalTransform),
        &mut DisplayChanges,
        &mut FilmDisplay,
    )>,
    coatings: Query<&Coating>,
    heat_maps: Query<(), With<HeatMapView>>,
    cameras: Query<(&Camera, &GlobalTransform)>,
    mut assets: ResMut<Assets<Mesh>>,
) {
    let views: Vec<View> = cameras.iter().filter_map(|(camera, at)| View::of(camera, at)).collect();
    let mut beginnings = 0;
    for (film, (mesh, forces, stains), (coated_by, source, pace, transform), mut changes, mut display) in &mut films {
        let display = display.bypass_change_detection();
        if display.appearance.finest_level() == 0 {
            continue;
        }
        if let Some(prepared) = display.next.as_mut().and_then(|next| check_ready(&mut next.task)) {
            display.next = None;
            display.take_level(prepared, &mut assets);
            changes.bypass_change_detection().mark_everything();
        }
        let Ok(coating) = coatings.get(coated_by.0) else { continue };
        let level = coating.detail.level.min(display.appearance.finest_level());
        let detail = Detail { level, ..coating.detail };
        let (middle, radius) = pace.sphere(transform);
        let largest = views.iter().map(|view| view.pixels_at(middle, radius)).reduce(f32::max);
        let (shown, under_way) = (display.appearance.level(), display.next.as_ref().map(|next| next.level));
        let wanted = largest.map_or(level, |pixels| {
            detail.level_at(pixels * display.film_edge / source.metres_per_unit, under_way.unwrap_or(shown))
        });
        // A heat map has the film's own triangles, beyond which those of a finer level would bulge.
        let is_heated = heat_maps.contains(film) || heat_maps.contains(coated_by.0);
        let wanted = if is_heated { 0 } else { wanted };
        if wanted == shown {
            display.next = None;
        } else if under_way != Some(wanted) && beginnings < BEGINNINGS {
            beginnings += 1;
            display.next = Some(begin(display, wanted, (mesh.clone(), forces.clone(), stains.clone())));
        }
    }
}

/// Begins to prepare a film in this state at `level`.
fn begin(
    display: &FilmDisplay,
    level: u32,
    (mesh, forces, stains): (FilmMesh, FilmForces, StainFields),
) -> LevelChange {
    let (levels, paint) = (display.appearance.levels(), display.paint.clone());
    let (edge, space) = (display.film_edge, display.space);
    let attributes: Vec<SlotAttributes> = display.slots.iter().map(|slot| slot.attributes).collect();
    let task = AsyncComputeTaskPool::get().spawn(async move {
        let mut turn = Turn::begin().await;
        let appearance = levels.appearance_in_pieces(level, &mesh, &forces, &stains, &mut turn).await;
        PreparedLevel::new(appearance, &attributes, paint, edge, space, &mut turn).await
    });
    LevelChange { level, task }
}
