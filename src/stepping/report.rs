//! The end of a step: what happened becomes messages, and display learns that something changed.

use bevy::{
    ecs::{
        change_detection::DetectChangesMut,
        entity::Entity,
        message::MessageWriter,
        system::{Query, ResMut, SystemParam},
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
        messages::{FirstCrack, FirstSeparation, PieceFallen},
    },
    appearance::DisplayChanges,
    film::{FaceId, FilmChanges, FilmMesh},
    sim::{FilmClock, Stage},
    stain::StainFields,
};

/// Writers of the messages about what happens in a step.
#[derive(SystemParam)]
pub(super) struct Tellers<'w> {
    separations: MessageWriter<'w, FirstSeparation>,
    cracks: MessageWriter<'w, FirstCrack>,
    pieces: MessageWriter<'w, PieceFallen>,
}

/// Reports what happens for the first time and the fallen pieces of the due films, and adds up what display has to
/// follow.
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
    mut tellers: Tellers,
    mut timings: ResMut<CoatingTimings>,
) {
    timings.measure(Stage::Other, || {
        for (entity, mut pace, mesh, clock, changes, stains, source, transform, mut display, mut fallen) in &mut films {
            if !pace.due {
                continue;
            }
            let film = FilmInWorld { entity, mesh, clock, source, transform };
            film.tell(pace.bypass_change_detection(), changes, fallen.as_deref_mut(), &mut tellers);
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
    /// Tells of the first vertex that let go and of the first crack, unless the film had any before, and of the pieces
    /// that fell.
    pub fn tell(
        &self,
        pace: &mut FilmPace,
        changes: &FilmChanges,
        fallen: Option<&mut FallenPieces>,
        tellers: &mut Tellers,
    ) {
        let Self { entity, mesh, clock, source, .. } = *self;
        if let (false, Some(v)) = (pace.separated, changes.separated.first()) {
            pace.separated = true;
            let position = self.point(mesh.geometry.positions[v.index()]);
            tellers.separations.write(FirstSeparation { entity, age: clock.age(), position });
        }
        if let (false, Some(&edge)) = (pace.cracked, changes.torn.first()) {
            pace.cracked = true;
            let ends = [mesh.topology.origin(edge), mesh.topology.target(edge)];
            let [a, b] = ends.map(|v| mesh.geometry.positions[v.index()]);
            tellers.cracks.write(FirstCrack { entity, age: clock.age(), position: self.point((a + b) / 2.0) });
        }
        if let Some(fallen) = fallen.filter(|_| !changes.debris.is_empty()) {
            fallen.faces.extend_from_slice(&changes.removed);
            fallen.counts.extend(changes.debris.iter().map(|debris| debris.faces));
        }
        let is_hidden = |face: FaceId| source.hidden.get(face.index()).is_some_and(|&hidden| hidden);
        for debris in changes.debris.iter().filter(|debris| !is_hidden(debris.face)) {
            tellers.pieces.write(PieceFallen {
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
