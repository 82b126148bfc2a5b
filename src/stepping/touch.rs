//! Touches of props at places of the world, as commands.

use bevy::{
    ecs::{
        change_detection::DetectChangesMut,
        entity::Entity,
        system::{Commands, EntityCommand, EntityCommands, In, Query},
        world::EntityWorldMut,
    },
    log::warn,
    math::Vec3,
    transform::components::GlobalTransform,
};

use super::edit::FilmEdit;
use crate::{
    api::links::{CoatedBy, FilmSource},
    film::FilmMesh,
    fracture::FilmForces,
    stain::StainFields,
    survey::FilmView,
    timeline::{FilmHistory, FilmJourney, Goal},
    touch::{Effect, Site, Touch},
};

/// Touch of a prop at a place of the world, as a command for the entity with its [`Coating`](crate::Coating), or for
/// that of one film. [`TouchCommands`] has short forms.
///
/// Every film of the coating that comes within the radius of the place is touched, at its nearest place. A touch in the
/// air does nothing.
///
/// ```
/// use bevy::prelude::*;
/// use bevy_coating::{prelude::*, touch::{Change, Effect}};
///
/// /// A mechanic seals the seam of a door.
/// fn seal(mut commands: Commands, doors: Query<(Entity, &GlobalTransform), With<Coating>>) {
///     for (door, transform) in &doors {
///         let seam = transform.transform_point(Vec3::new(0.4, 0.0, 0.02));
///         let touch = TouchAt::new(seam, 0.1, Effect::Binding(Change::Multiply(4.0)));
///         commands.entity(door).touch_at(touch);
///     }
/// }
/// # let mut app = App::new();
/// # app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin));
/// # app.add_plugins(CoatingWeatheringPlugin::default());
/// app.add_systems(Update, seal);
/// app.update();
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TouchAt {
    /// Place in world space.
    pub position: Vec3,
    /// Place in world space at which a scratch ends. With one, the effect is that scratch.
    pub to: Option<Vec3>,
    /// Radius along the surface, in units of the world: above 0.
    pub radius: f32,
    /// Share of the radius that feels the touch at its full strength: 0 (soft) to 1 (hard). Default 0.5.
    pub hardness: f32,
    /// Effect on the film there.
    pub effect: Effect,
    /// Number of the stroke that the touch is part of. Strokes are taken back as a whole; let numbers grow. Default 0.
    pub stroke: u32,
}

impl TouchAt {
    /// Returns a touch of medium hardness.
    pub fn new(position: Vec3, radius: f32, effect: Effect) -> Self {
        Self { position, to: None, radius, hardness: 0.5, effect, stroke: 0 }
    }

    /// Sets the hardness.
    pub fn with_hardness(self, hardness: f32) -> Self {
        Self { hardness, ..self }
    }

    /// Sets the number of the stroke that the touch is part of.
    pub fn in_stroke(self, stroke: u32) -> Self {
        Self { stroke, ..self }
    }
}

impl EntityCommand for TouchAt {
    type Out = ();

    fn apply(self, mut entity: EntityWorldMut) {
        let root = entity.id();
        entity.world_scope(|world| match world.run_system_cached_with(find_touches, (root, self)) {
            Ok(edits) => {
                for (film, edit) in edits {
                    if let Ok(film) = world.get_entity_mut(film) {
                        edit.apply(film);
                    }
                }
            }
            Err(error) => warn!("entity {root} cannot be touched: {error}"),
        });
    }
}

/// Finds the films of a coating that a touch reaches, and where.
fn find_touches(
    In((root, touch)): In<(Entity, TouchAt)>,
    films: Query<(Entity, &CoatedBy, &FilmMesh, &FilmForces, &StainFields, &FilmSource, &GlobalTransform)>,
) -> Vec<(Entity, FilmEdit)> {
    let mut found = Vec::new();
    let of_root = films.iter().filter(|(film, coated_by, ..)| *film == root || coated_by.0 == root);
    for (film, _, mesh, forces, stains, source, transform) in of_root {
        let into_film = source.place(transform).inverse();
        let view = FilmView { mesh, forces, stains, hidden: &source.hidden };
        let radius = touch.radius * source.metres_per_unit;
        let site = |place: Vec3, within: f32| {
            let point = view.nearest(into_film.transform_point3(place), within)?;
            Some(Site::new(point.face, point.barycentric))
        };
        let Some(at) = site(touch.position, radius) else { continue };
        // A scratch goes on as far as this film does.
        let end = touch.to.and_then(|to| site(to, f32::INFINITY));
        let effect = end.map_or(touch.effect, Effect::Scratch);
        let touch_film = Touch { site: at, radius, hardness: touch.hardness, effect };
        found.push((film, FilmEdit::Touch(touch_film, touch.stroke)));
    }
    // Queries have no order of their own.
    found.sort_unstable_by_key(|&(film, _)| film);
    found
}

/// Commands with which a game touches the paint of a prop, for the entity with its [`Coating`](crate::Coating) or for
/// that of one film. Positions are in world space, lengths in units of the world.
///
/// Where the coating has a [`CoatingHistory`](crate::CoatingHistory), touches are part of the past of its films: they
/// are saved with it, happen again when a film goes to another age, and can be taken back.
///
/// ```
/// use bevy::prelude::*;
/// use bevy_coating::prelude::*;
///
/// /// A bullet chips the paint, and starts cracks.
/// fn shoot(mut commands: Commands, signs: Query<(Entity, &GlobalTransform), With<Coating>>) {
///     for (sign, transform) in &signs {
///         commands.entity(sign).hit(transform.translation(), 0.08, 9.0);
///     }
/// }
/// # let mut app = App::new();
/// # app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin));
/// # app.add_plugins(CoatingWeatheringPlugin::default());
/// app.add_systems(Update, shoot);
/// app.update();
/// ```
pub trait TouchCommands {
    /// Touches the paint.
    fn touch_at(&mut self, touch: TouchAt) -> &mut Self;

    /// Strikes the paint with a `force` in units of the initial contraction: see [`Effect::Hit`].
    fn hit(&mut self, position: Vec3, radius: f32, force: f32) -> &mut Self {
        self.touch_at(TouchAt::new(position, radius, Effect::Hit(force)))
    }

    /// Cuts the paint along a line with a blade. The first place must be within `reach` of the paint.
    fn scratch(&mut self, from: Vec3, to: Vec3, reach: f32) -> &mut Self {
        self.touch_at(TouchAt { to: Some(to), ..TouchAt::new(from, reach, Effect::Strip) })
    }

    /// Washes dust and wet rust away with a `thoroughness` from 0 to 1.
    fn wash(&mut self, position: Vec3, radius: f32, thoroughness: f32) -> &mut Self {
        self.touch_at(TouchAt::new(position, radius, Effect::Wash(thoroughness)))
    }

    /// Sands loose paint, stains and rust away with a `thoroughness` from 0 to 1.
    fn sand(&mut self, position: Vec3, radius: f32, thoroughness: f32) -> &mut Self {
        self.touch_at(TouchAt::new(position, radius, Effect::Sand(thoroughness)))
    }

    /// Paints afresh. [`FilmRepainted`](crate::FilmRepainted) tells how far the work has come.
    fn repaint(&mut self, position: Vec3, radius: f32) -> &mut Self {
        self.touch_at(TouchAt::new(position, radius, Effect::Repaint))
    }

    /// Takes the last stroke back, on all films that it touched: the one with the highest number. All else that
    /// happened since happens again, in the background; [`AgeReached`](crate::AgeReached) tells when a film is there.
    /// Warns if there is no history to go back in.
    fn undo_touch(&mut self) -> &mut Self;

    /// Lets the stroke happen again that was taken back last.
    fn redo_touch(&mut self) -> &mut Self;
}

impl TouchCommands for EntityCommands<'_> {
    fn touch_at(&mut self, touch: TouchAt) -> &mut Self {
        self.queue_silenced(touch)
    }

    fn undo_touch(&mut self) -> &mut Self {
        self.queue_silenced(Rewrite::Undo)
    }

    fn redo_touch(&mut self) -> &mut Self {
        self.queue_silenced(Rewrite::Redo)
    }
}

/// Command that takes a stroke back, or lets it happen again.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Rewrite {
    Undo,
    Redo,
}

impl EntityCommand for Rewrite {
    type Out = ();

    fn apply(self, mut entity: EntityWorldMut) {
        let root = entity.id();
        entity.world_scope(|world| {
            if let Err(error) = world.run_system_cached_with(rewrite, (root, self)) {
                warn!("no stroke of {root} can be taken back: {error}");
            }
        });
    }
}

fn rewrite(
    In((root, what)): In<(Entity, Rewrite)>,
    mut films: Query<(Entity, &CoatedBy, &mut FilmHistory, Option<&FilmJourney>)>,
    mut commands: Commands,
) {
    let number = |history: &FilmHistory| match what {
        Rewrite::Undo => history.last_stroke(),
        Rewrite::Redo => history.last_undone(),
    };
    let is_of = |film: Entity, coated_by: &CoatedBy| film == root || coated_by.0 == root;
    let mut any = false;
    let mut strokes = Vec::new();
    for (_, _, history, _) in films.iter().filter(|(film, coated_by, ..)| is_of(*film, coated_by)) {
        any = true;
        strokes.extend(number(history));
    }
    if !any {
        warn!("no stroke of {root} can be taken back: insert `CoatingHistory` beside its `Coating` before touching it");
    }
    // The last one that was done, and the last one that was taken back.
    let stroke = match what {
        Rewrite::Undo => strokes.into_iter().max(),
        Rewrite::Redo => strokes.into_iter().min(),
    };
    let Some(stroke) = stroke else { return };
    for (film, coated_by, mut history, journey) in &mut films {
        if !is_of(film, coated_by) || number(&history) != Some(stroke) {
            continue;
        }
        match what {
            Rewrite::Undo => history.bypass_change_detection().undo(stroke),
            Rewrite::Redo => history.bypass_change_detection().redo(stroke),
        }
        // A way along the other past begins again.
        if journey.is_some_and(|journey| journey.goal != Goal::Saved) {
            commands.entity(film).try_remove::<FilmJourney>();
        }
    }
}
