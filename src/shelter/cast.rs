//! Begins the casts of rays for films whose exposure is out of date.

use std::sync::Arc;

use bevy::{
    ecs::{
        change_detection::DetectChangesMut,
        system::{Query, Res},
    },
    math::Vec3,
    tasks::AsyncComputeTaskPool,
    transform::components::GlobalTransform,
};

use super::{
    film::{FilmShelter, RESTLESS, Seen},
    key::falls,
    scene::ShelterScene,
};
use crate::{
    api::{
        clock::CoatingGravity,
        links::{CoatedBy, FilmSource},
        shelter::Shelter,
        weather::CoatingWeather,
    },
    film::FilmMesh,
    stain::{Exposure, StainFields, exposure::ExposedSurface},
};

/// Distance by which a film may move against its shelters before rays are cast again, in mean edge lengths.
const TOLERANCE: f32 = 0.25;

/// Begins a cast for every film whose exposure is out of date.
pub(crate) fn cast(
    weather: Res<CoatingWeather>,
    gravity: Res<CoatingGravity>,
    scene: Res<ShelterScene>,
    mut films: Query<(&mut FilmShelter, &mut StainFields, &FilmMesh, &FilmSource, &CoatedBy, &GlobalTransform)>,
) {
    for (mut shelter, mut stains, mesh, source, coated_by, transform) in &mut films {
        let shelter = shelter.bypass_change_detection();
        if shelter.choice != Shelter::Scene {
            if shelter.choice == Shelter::Open && !(stains.exposure.rain.is_empty() && stains.exposure.sun.is_empty()) {
                stains.bypass_change_detection().exposure = Exposure::default();
            }
            continue;
        }
        let environment = weather.environment(*gravity, transform);
        let seen = Seen { revision: scene.revision(), place: transform.affine(), falls: falls(&environment) };
        if seen.falls == [Vec3::ZERO; 2] {
            (shelter.under_way, shelter.overdue, shelter.settled, shelter.restless) = (None, false, false, 0);
            continue;
        }
        let moved = shelter.seen.replace(seen) != Some(seen);
        shelter.restless = if moved { shelter.restless.saturating_add(1) } else { 0 };
        if !moved && shelter.settled {
            continue;
        }
        (shelter.settled, shelter.overdue) = (false, true);
        let Some(mut order) = scene.order(&environment, source.place(transform), coated_by.0, &source.slots) else {
            continue;
        };
        let surface = shelter.surface.get_or_insert_with(|| Arc::new(ExposedSurface::new(mesh)));
        order.cull(surface);
        let tolerance = TOLERANCE * mesh.geometry.mean_edge;
        let known = shelter.under_way.as_ref().map(|(_, key)| key).or(shelter.cast.as_ref());
        if known.is_some_and(|key| key.holds(&order.key, surface.sphere(), tolerance)) {
            (shelter.settled, shelter.overdue) = (true, false);
        } else if shelter.under_way.is_some() && moved {
            // A cast that was called off whenever something moved would never finish while things keep moving.
            shelter.overdue = shelter.restless < RESTLESS;
        } else {
            let (surface, key) = (surface.clone(), order.key.clone());
            let task = AsyncComputeTaskPool::get().spawn(async move { order.cast(&surface) });
            shelter.under_way = Some((task, key));
            (shelter.settled, shelter.overdue) = (true, false);
        }
    }
}
