//! Edits of films from outside, as commands: damage that a game does.

use bevy::{
    ecs::{
        change_detection::DetectChangesMut,
        entity::Entity,
        message::MessageWriter,
        system::{Commands, EntityCommand, In, Query},
        world::EntityWorldMut,
    },
    log::warn,
    transform::components::GlobalTransform,
};

use super::report::{FilmInWorld, Tellers};
use crate::{
    api::{
        debris::FallenPieces,
        film_pace::FilmPace,
        links::{CoatedBy, FilmSource},
        messages::FilmRepainted,
    },
    appearance::DisplayChanges,
    deform::FilmConstraints,
    film::{FaceId, FilmMesh, HalfEdgeId},
    fracture::FilmForces,
    history::Event,
    sim::{
        FilmClock, StepScratch,
        edit::{FilmParts, strip_face, tear_edge},
    },
    stain::StainFields,
    timeline::{FilmHistory, FilmJourney, Goal},
    touch::{Touch, Touched, touch},
};

/// Edit of a film by a game, as a command for the film's entity. All parts of the film follow it, and it is told and
/// shown like what happens in a step.
///
/// An edit that is not possible, because the film has no such edge or face or it is gone already, does nothing. On an
/// entity without a film it warns.
///
/// ```
/// use bevy::prelude::*;
/// use bevy_coating::{FilmEdit, film::FilmMesh, prelude::*};
///
/// /// Knocks the face that is nearest to the origin off every film.
/// fn knock(mut commands: Commands, films: Query<(Entity, &FilmMesh)>) {
///     for (film, mesh) in &films {
///         let distance = |face| {
///             let corners = mesh.topology.corners(face);
///             corners.iter().map(|v| mesh.geometry.positions[v.index()].length()).fold(f32::MAX, f32::min)
///         };
///         let faces = mesh.topology.live_faces();
///         if let Some(face) = faces.min_by(|&a, &b| distance(a).total_cmp(&distance(b))) {
///             commands.entity(film).queue(FilmEdit::StripFace(face));
///         }
///     }
/// }
/// # let mut app = App::new();
/// # app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin));
/// # app.add_plugins(CoatingWeatheringPlugin::default());
/// app.add_systems(Update, knock);
/// app.update();
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FilmEdit {
    /// Tears the edge of a half-edge and separates its ends from the metal; see [`tear_edge`].
    TearEdge(HalfEdgeId),
    /// Cuts out a face and removes it; see [`strip_face`].
    StripFace(FaceId),
    /// A brush or a blow at a place of the film; see [`touch`](crate::touch::touch()). The number is that of the stroke
    /// which the touch is part of. [`TouchCommands`](crate::TouchCommands) finds the place.
    Touch(Touch, u32),
}

impl EntityCommand for FilmEdit {
    type Out = ();

    fn apply(self, mut entity: EntityWorldMut) {
        let film = entity.id();
        entity.world_scope(|world| {
            if let Err(error) = world.run_system_cached_with(edit_film, (film, self)) {
                warn!("entity {film} cannot be edited: {error}");
            }
        });
    }
}

/// Edits one film.
fn edit_film(
    In((entity, edit)): In<(Entity, FilmEdit)>,
    mut films: Query<(
        (&mut FilmMesh, &mut FilmForces, &mut FilmConstraints, &mut StainFields, &FilmClock, &mut StepScratch),
        (&mut FilmPace, &mut DisplayChanges, &FilmSource, &CoatedBy, &GlobalTransform),
        (Option<&mut FilmHistory>, Option<&mut FallenPieces>),
    )>,
    journeys: Query<&FilmJourney>,
    mut commands: Commands,
    mut tellers: Tellers,
    mut repainted: MessageWriter<FilmRepainted>,
) {
    let Ok((film, (mut pace, mut display, source, coated_by, transform), (history, mut fallen))) =
        films.get_mut(entity)
    else {
        warn!("entity {entity} has no film that could be edited");
        return;
    };
    let (mut mesh, mut forces, mut constraints, mut stains, clock, mut scratch) = film;
    let parts = FilmParts {
        mesh: &mut mesh,
        forces: &mut forces,
        constraints: &mut constraints,
        stains: &mut stains,
        clock,
        scratch: &mut scratch,
    };
    let pace = pace.bypass_change_detection();
    let changes = match edit {
        FilmEdit::TearEdge(edge) => tear_edge(parts, &pace.settings, &pace.environment, edge),
        FilmEdit::StripFace(face) => strip_face(parts, &pace.settings, &pace.environment, face),
        FilmEdit::Touch(with, _) => match touch(parts, &pace.settings, &pace.environment, &with) {
            Ok(Touched { changes, repainted: is_new, renewed }) => {
                if renewed {
                    display.bypass_change_detection().restart();
                }
                if is_new {
                    pace.know(&forces);
                    repainted.write(FilmRepainted::of(entity, coated_by.0, &mesh, &forces));
                }
                Some(changes)
            }
            Err(error) => {
                warn!("film {entity} stays as it is: {error}");
                None
            }
        },
    };
    let Some(changes) = changes else { return };
    if let Some(mut history) = history {
        let event = match edit {
            FilmEdit::TearEdge(edge) => Event::TearEdge(edge),
            FilmEdit::StripFace(face) => Event::StripFace(face),
            FilmEdit::Touch(with, stroke) => Event::Touch(with, stroke),
        };
        history.record(clock.steps, event);
    }
    // A way that has begun without this begins again with it.
    if journeys.get(entity).is_ok_and(|journey| journey.goal != Goal::Saved) {
        commands.entity(entity).try_remove::<FilmJourney>();
    }
    let film = FilmInWorld { entity, mesh: &mesh, clock, source, transform };
    film.tell(pace, &changes, fallen.as_deref_mut(), &mut tellers);
    display.bypass_change_detection().record(&changes, &stains);
}
