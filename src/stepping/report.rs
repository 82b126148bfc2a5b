//! The end of a step: what happened becomes messages, and display learns that something changed.

use bevy::{
    ecs::{
        change_detection::DetectChangesMut,
        entity::Entity,
        message::MessageWriter,
        system::{Query, ResMut},
    },
    math::Vec3,
    transform::components::GlobalTransform,
};

use crate::{
    api::{
        diagnostics::CoatingTimings,
        film_pace::FilmPace,
        links::FilmSource,
        messages::{FirstCrack, PieceFallen},
    },
    appearance::DisplayChanges,
    film::{FaceId, FilmChanges, FilmMesh},
    sim::{FilmClock, Stage},
    stain::StainFields,
};
/// Reports the first crack and fallen pieces of the due films, and adds up what display has to follow.
pub(super) fn report(
    mut films: Query<(
        Entity,
        &mut FilmPace,
        &FilmMesh,
        &FilmClock,
        &FilmChanges,
        &StainFields,
        &FilmSource,
        &GlobalTransform,
        &mut DisplayChanges,
    )>,
    mut cracks: MessageWriter<FirstCrack>,
    mut pieces: MessageWriter<PieceFallen>,
    mut timings: ResMut<CoatingTimings>,
) {
    timings.measure(Stage::Other, || {
        for (entity, mut pace, mesh, clock, changes, stains, source, transform, mut display) in &mut films {
            if !pace.due {
                continue;
            }
            let world = FilmToWorld { transform, scale: source.scale, origin: source.origin };
            if let (false, Some(&edge)) = (pace.cracked, changes.torn.first()) {
                pace.cracked = true;
                let ends = [mesh.topology.origin(edge), mesh.topology.target(edge)];
                let [a, b] = ends.map(|v| mesh.geometry.positions[v.index()]);
                cracks.write(FirstCrack { entity, age: clock.age(), position: world.point((a + b) / 2.0) });
            }
            let is_hidden = |face: FaceId| source.hidden.get(face.index()).is_some_and(|&hidden| hidden);
            for debris in changes.debris.iter().filter(|debris| !is_hidden(debris.face)) {
                pieces.write(PieceFallen {
                    entity,
                    position: world.point(debris.position),
                    normal: world.direction(debris.normal),
                    size: debris.area.sqrt(),
                    faces: debris.faces,
                });
            }
            display.bypass_change_detection().record(changes, stains);
        }
    });
}

/// From a film's space, which has the world scale applied, to the world.
struct FilmToWorld<'a> {
    transform: &'a GlobalTransform,
    scale: Vec3,
    origin: Vec3,
}

impl FilmToWorld<'_> {
    fn point(&self, p: Vec3) -> Vec3 {
        self.transform.transform_point((p + self.origin) / self.scale)
    }

    fn direction(&self, d: Vec3) -> Vec3 {
        // Normals turn with the film, which is rotated but not scaled.
        self.transform.rotation() * d
    }
}
