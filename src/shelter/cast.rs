//! Begins the casts of rays for films whose exposure is out of date.
//!
//! Only films that have moved, and those that something that moved may shelter, are looked at. Casts begin a few a
//! frame, those that have waited longest first: what is cast does not depend on when.

use std::sync::Arc;

use bevy::{
    ecs::{
        change_detection::{DetectChanges, DetectChangesMut},
        entity::Entity,
        lifecycle::RemovedComponents,
        system::{Local, Query, Res, ResMut},
    },
    math::Vec3,
    tasks::AsyncComputeTaskPool,
    transform::components::GlobalTransform,
};

use super::{
    ball::Ball,
    film::{Cast, FilmShelter, RESTLESS, Seen},
    films::ShelteredFilms,
    key::{CastOrder, falls},
    scene::ShelterScene,
};
use crate::{
    api::{
        clock::CoatingGravity,
        film_pace::FilmPace,
        links::{CoatedBy, FilmSource},
        shelter::Shelter,
        turn::Turn,
        weather::CoatingWeather,
    },
    film::FilmMesh,
    stain::{Exposure, StainFields, exposure::ExposedSurface},
};

/// Distance by which a film may move against its shelters before rays are cast again, in mean edge lengths.
const TOLERANCE: f32 = 0.25;
/// Most casts that begin in one frame.
const MOST_BEGUN: usize = 8;
/// Most casts that are under way, as a multiple of the number of threads. Each holds a copy of its film.
const MOST_UNDER_WAY: usize = 4;

/// Query of the films.
type Films<'w, 's> = Query<
    'w,
    's,
    (
        Entity,
        &'static mut FilmShelter,
        &'static mut StainFields,
        &'static FilmMesh,
        &'static FilmPace,
        &'static FilmSource,
        &'static CoatedBy,
        &'static GlobalTransform,
    ),
>;

/// Begins casts for films whose exposure is out of date.
pub(crate) fn cast(
    weather: Res<CoatingWeather>,
    gravity: Res<CoatingGravity>,
    mut scene: ResMut<ShelterScene>,
    mut index: ResMut<ShelteredFilms>,
    mut films: Films,
    mut gone: RemovedComponents<FilmShelter>,
    mut waiting: Local<Vec<(u32, Entity)>>,
) {
    index.looked_at = 0;
    let come = films.iter_mut().any(|(_, shelter, ..)| shelter.is_added());
    index.stale |= come || gone.read().count() > 0;
    let own = films.iter().filter(|(_, shelter, ..)| shelter.choice == Shelter::Scene);
    let own = own.filter_map(|(.., pace, _, _, _)| pace.weather);
    let mut falling: Vec<Vec3> = Vec::new();
    for weather in std::iter::once(*weather).chain(own) {
        for fall in falls(&weather.environment(*gravity, &GlobalTransform::IDENTITY)) {
            if fall != Vec3::ZERO && !falling.contains(&fall) {
                falling.push(fall);
            }
        }
    }
    if falling.is_empty() {
        // Until there is rain or sun again nothing is followed.
        index.stale = true;
        scene.take_touched();
    } else {
        if index.stale {
            index.renew(films.iter().map(|(film, .., pace, _, _, transform)| (film, ball(pace, transform))));
        }
        let ups: Vec<Vec3> = falling.iter().map(|&fall| -fall).collect();
        for piece in scene.take_touched() {
            let mut touched = Vec::new();
            index.touched_by(&piece, &ups, |film| touched.push(film));
            for film in touched {
                if let Ok((_, mut shelter, ..)) = films.get_mut(film) {
                    shelter.bypass_change_detection().touched = true;
                }
            }
        }
    }
    waiting.clear();
    let mut under_way = 0;
    for (film, mut shelter, mut stains, mesh, pace, source, coated_by, transform) in &mut films {
        let shelter = shelter.bypass_change_detection();
        if shelter.choice != Shelter::Scene {
            if shelter.choice == Shelter::Open && !(stains.exposure.rain.is_empty() && stains.exposure.sun.is_empty()) {
                stains.bypass_change_detection().exposure = Exposure::default();
            }
            continue;
        }
        let environment = pace.weather.unwrap_or(*weather).environment(*gravity, transform);
        let seen = Seen { place: transform.affine(), falls: falls(&environment) };
        if seen.falls == [Vec3::ZERO; 2] {
            (shelter.under_way, shelter.overdue, shelter.settled, shelter.restless) = (None, false, false, 0);
            (shelter.touched, shelter.waited) = (false, 0);
            continue;
        }
        if shelter.seen.is_none_or(|before| before.place != seen.place) {
            index.set(film, ball(pace, transform));
        }
        let moved = (shelter.seen.replace(seen) != Some(seen)) | std::mem::take(&mut shelter.touched);
        shelter.restless = if moved { shelter.restless.saturating_add(1) } else { 0 };
        if moved || !shelter.settled {
            (shelter.settled, shelter.overdue) = (false, true);
            let tolerance = TOLERANCE * mesh.geometry.mean_edge;
            // A film that waits for its turn need not be looked at again until it moves.
            if moved || shelter.waited == 0 {
                let order = || scene.order(&environment, source.place(transform), coated_by.0, &source.slots);
                index.looked_at += judge(shelter, order, sphere(pace, source), tolerance, moved);
            }
            if shelter.waited > 0 {
                waiting.push((shelter.waited, film));
                shelter.waited = shelter.waited.saturating_add(1);
            }
        }
        under_way += usize::from(shelter.under_way.is_some());
    }
    let most = (MOST_UNDER_WAY * AsyncComputeTaskPool::get().thread_num().max(1)).saturating_sub(under_way);
    // Ties are decided by entity, so that the order is always the same.
    waiting.sort_unstable_by(|a, b| b.0.cmp(&a.0).then(a.1.cmp(&b.1)));
    for &(_, film) in waiting.iter().take(most.min(MOST_BEGUN)) {
        let Ok((_, mut shelter, _, mesh, pace, source, coated_by, transform)) = films.get_mut(film) else { continue };
        let environment = pace.weather.unwrap_or(*weather).environment(*gravity, transform);
        let Some(order) = scene.order(&environment, source.place(transform), coated_by.0, &source.slots) else {
            continue;
        };
        index.looked_at += begin(shelter.bypass_change_detection(), order, mesh, sphere(pace, source));
    }
}

/// Returns a ball around a film in the world.
fn ball(pace: &FilmPace, transform: &GlobalTransform) -> Ball {
    let (_, rotation, translation) = transform.to_scale_rotation_translation();
    Ball { center: translation + rotation * pace.bounds.0, radius: pace.bounds.1 }
}

/// Returns the centre and radius of a sphere around a film, in the film's space.
fn sphere(pace: &FilmPace, source: &FilmSource) -> (Vec3, f32) {
    let (center, radius) = pace.bounds;
    (center * source.metres_per_unit - source.origin, radius * source.metres_per_unit)
}

/// Finds out whether a film needs another cast, and puts it in line if so. Returns the number of meshes and groups of
/// meshes that were looked at.
fn judge(
    shelter: &mut FilmShelter,
    order: impl FnOnce() -> Option<CastOrder>,
    sphere: (Vec3, f32),
    tolerance: f32,
    moved: bool,
) -> usize {
    shelter.waited = 0;
    let known = shelter.under_way.as_ref().map(|(_, key)| key).or(shelter.cast.as_ref());
    let Some(known) = known else {
        shelter.waited = 1;
        return 0;
    };
    let Some(mut order) = order() else { return 0 };
    let looked_at = order.cull(sphere);
    if known.holds(&order.key, sphere, tolerance) {
        (shelter.settled, shelter.overdue) = (true, false);
    } else if shelter.under_way.is_some() && moved {
        // A cast that was called off whenever something moved would never finish while things keep moving.
        shelter.overdue = shelter.restless < RESTLESS;
    } else {
        shelter.waited = 1;
    }
    looked_at
}

/// Begins a cast in the background, where the film's surface is prepared, too, when it is first needed. Returns the
/// number of meshes and groups of meshes that were looked at.
fn begin(shelter: &mut FilmShelter, mut order: CastOrder, mesh: &FilmMesh, sphere: (Vec3, f32)) -> usize {
    let looked_at = order.cull(sphere);
    let (key, surface) = (order.key.clone(), shelter.surface.clone());
    let mesh = surface.is_none().then(|| mesh.clone());
    let task = AsyncComputeTaskPool::get().spawn(async move {
        let mut turn = Turn::begin().await;
        let surface = match surface {
            Some(surface) => surface,
            None => Arc::new(ExposedSurface::new_in_pieces(&mesh.unwrap_or_default(), &mut turn).await),
        };
        Cast { exposure: order.cast(&surface, &mut turn).await, surface }
    });
    shelter.under_way = Some((task, key));
    (shelter.settled, shelter.overdue, shelter.waited) = (true, false, 0);
    looked_at
}
