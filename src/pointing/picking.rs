//! Backend of Bevy's picking: rays against films as they are now.

use bevy::{
    camera::{
        Camera,
        primitives::Aabb,
        visibility::{InheritedVisibility, RenderLayers},
    },
    ecs::{
        entity::Entity,
        message::MessageWriter,
        system::{Query, Res},
    },
    math::Vec3A,
    picking::{
        Pickable,
        backend::{HitData, PointerHits, ray::RayMap},
    },
    transform::components::GlobalTransform,
};

use crate::{
    api::links::{CoatedBy, FilmSource},
    film::FilmMesh,
    fracture::FilmForces,
    inspect::FilmHit,
    stain::StainFields,
    survey::FilmView,
};

/// Everything of a film that a ray asks for.
type Film<'a> = (
    Entity,
    &'a CoatedBy,
    &'a FilmMesh,
    &'a FilmForces,
    &'a StainFields,
    &'a FilmSource,
    &'a GlobalTransform,
    Option<&'a Pickable>,
    Option<&'a RenderLayers>,
    Option<&'a InheritedVisibility>,
);

/// Tells Bevy's picking which films the rays of pointers hit.
pub(super) fn hit_films(
    rays: Res<RayMap>,
    cameras: Query<(&Camera, Option<&RenderLayers>)>,
    films: Query<Film>,
    bounds: Query<(&Aabb, &GlobalTransform)>,
    mut hits: MessageWriter<PointerHits>,
) {
    for (&id, &ray) in rays.iter() {
        let Ok((camera, seen)) = cameras.get(id.camera) else { continue };
        let seen = seen.cloned().unwrap_or_default();
        let mut picks = Vec::new();
        for (film, coated_by, mesh, forces, stains, source, transform, pickable, layers, visibility) in &films {
            let is_shown = visibility.is_none_or(|visibility| visibility.get())
                && seen.intersects(&layers.cloned().unwrap_or_default())
                && pickable.is_none_or(|pickable| pickable.is_hoverable);
            let mut boxes = source.live_slots().filter_map(|slot| bounds.get(slot).ok()).peekable();
            // Without boxes, as in an app without a renderer, every film is looked at.
            let is_near = boxes.peek().is_none() || boxes.any(|(aabb, at)| meets(ray.origin, *ray.direction, aabb, at));
            if !is_shown || !is_near {
                continue;
            }
            let place = source.place(transform);
            let into_film = place.inverse();
            let origin = into_film.transform_point3(ray.origin);
            let direction = into_film.transform_vector3(*ray.direction);
            let view = FilmView { mesh, forces, stains, hidden: &source.hidden };
            let Some(point) = view.along_ray(origin, direction, f32::INFINITY) else { continue };
            let point = point.placed(&place);
            let hit = FilmHit { entity: film, root: coated_by.0, point };
            let (position, normal) = (Some(point.position), Some(point.normal));
            picks.push((film, HitData::new_with_extra(id.camera, point.distance, position, normal, hit)));
        }
        if !picks.is_empty() {
            hits.write(PointerHits::new(id.pointer, picks, camera.order as f32));
        }
    }
}

/// Share of a box by which film may stick out of it, before the box has followed.
const SLACK: f32 = 0.1;

/// Returns whether a ray of the world meets a box of a mesh.
fn meets(origin: bevy::math::Vec3, direction: bevy::math::Vec3, aabb: &Aabb, at: &GlobalTransform) -> bool {
    let into = at.affine().inverse();
    let (origin, direction) =
        (Vec3A::from(into.transform_point3(origin)), Vec3A::from(into.transform_vector3(direction)));
    let half = aabb.half_extents + Vec3A::splat(SLACK * aabb.half_extents.max_element());
    let inverse = direction.recip();
    let (a, b) = ((aabb.center - half - origin) * inverse, (aabb.center + half - origin) * inverse);
    let (enter, leave) = (a.min(b).max_element(), a.max(b).min_element());
    // A ray in the plane of a side gives no number, and counts as one that meets it.
    !(enter > leave) && !(leave < 0.0)
}
