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
        debris::FallenPieces,
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
        Option<&mut FallenPieces>,
    )>,
    mut cracks: MessageWriter<FirstCrack>,
    mut pieces: MessageWriter<PieceFallen>,
    mut timings: ResMut<CoatingTimings>,
) {
    timings.measure(Stage::Other, || {
        for (entity, mut pace, mesh, clock, changes, stains, source, transform, mut display, mut fallen) in &mut films {
            if !pace.due {
                continue;
            }
            let film = FilmInWorld { entity, mesh, clock, source, transform };
            film.tell(&mut pace.cracked, changes, fallen.as_deref_mut(), &mut cracks, &mut pieces);
            display.bypass_change_detection().record(changes, stains);
        }
    });
}

/// Film and its place in the world.
pub(super) struct FilmInWorld<'a> {
    pub entity: Entity,
    pub mesh: &'a FilmMesh,
    pub clock: &'a FilmClock,
    pub source: &'a FilmSource,
    pub transform: &'a GlobalTransform,
}

impl FilmInWorld<'_> {
    /// Tells of the first crack, unless the film has `cracked` before, and of the pieces that fell.
    pub fn tell(
        &self,
        cracked: &mut bool,
        changes: &FilmChanges,
        fallen: Option<&mut FallenPieces>,
        cracks: &mut MessageWriter<FirstCrack>,
        pieces: &mut MessageWriter<PieceFallen>,
    ) {
        let Self { entity, mesh, clock, source, .. } = *self;
        if let (false, Some(&edge)) = (*cracked, changes.torn.first()) {
            *cracked = true;
            let ends = [mesh.topology.origin(edge), mesh.topology.target(edge)];
            let [a, b] = ends.map(|v| mesh.geometry.positions[v.index()]);
            cracks.write(FirstCrack { entity, age: clock.age(), position: self.point((a + b) / 2.0) });
        }
        if let Some(fallen) = fallen.filter(|_| !changes.debris.is_empty()) {
            fallen.faces.extend_from_slice(&changes.removed);
            fallen.counts.extend(changes.debris.iter().map(|debris| debris.faces));
        }
        let is_hidden = |face: FaceId| source.hidden.get(face.index()).is_some_and(|&hidden| hidden);
        for debris in changes.debris.iter().filter(|debris| !is_hidden(debris.face)) {
            pieces.write(PieceFallen {
                entity,
                position: self.point(debris.position),
                // Normals turn with the film, which has the world scale applied already.
                normal: self.transform.rotation() * debris.normal,
                size: debris.area.sqrt() / self.source.metres_per_unit,
                faces: debris.faces,
            });
        }
    }

    /// Returns a point of the film's space, which has the world scale applied and is in metres, in the world.
    fn point(&self, p: Vec3) -> Vec3 {
        self.transform.transform_point((p + self.source.origin) / self.source.scale)
    }
}
