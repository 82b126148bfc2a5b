//! A brush at the pointer.

use bevy::{
    ecs::message::Messages,
    ecs::{
        message::MessageReader,
        resource::Resource,
        system::{Commands, Res, ResMut},
        world::World,
    },
    math::Vec3,
    picking::{
        backend::HitData,
        events::{Move, Pointer, Press, Release},
        pointer::{PointerButton, PointerId},
    },
};

use crate::{
    inspect::FilmHit,
    stepping::{TouchAt, TouchCommands},
    touch::Effect,
};

/// Brush in the hand of whoever points at paint. Needs [`CoatingPointingPlugin`](super::CoatingPointingPlugin).
///
/// From press to release of the button it touches the paint under the pointer, at equal distances, in one stroke:
/// [`TouchCommands::undo_touch`](crate::TouchCommands::undo_touch) takes back all of it.
#[derive(Resource, Clone, Debug, PartialEq)]
pub struct CoatingBrush {
    /// Effect of the brush. `None`, the default: it is put away, and nothing is painted or drawn.
    pub effect: Option<Effect>,
    /// Radius along the surface, in units of the world: above 0. Default 0.1.
    pub radius: f32,
    /// Share of the radius that paints at full strength: 0 (soft) to 1 (hard). Default 0.5.
    pub hardness: f32,
    /// Distance between two touches of a stroke, as a share of the radius: 0.05 to 2, default 0.25.
    pub spacing: f32,
    /// Button of the pointer that paints. Default: the primary one.
    pub button: PointerButton,
    /// Whether pointers belong to something else at the moment, like a panel over the film: no stroke begins, and one
    /// under way waits. Default false. The panel of this crate sets it.
    pub blocked: bool,
}

impl Default for CoatingBrush {
    fn default() -> Self {
        Self { effect: None, radius: 0.1, hardness: 0.5, spacing: 0.25, button: PointerButton::Primary, blocked: false }
    }
}

/// Most touches between two positions of the pointer. One that jumps farther leaves gaps.
const MOST_BETWEEN: f32 = 64.0;

/// Stroke under way.
#[derive(Resource, Debug, Default)]
pub(super) struct Stroke {
    /// Number of strokes so far.
    number: u32,
    /// Pointer that draws, and where it touched last.
    drawing: Option<(PointerId, Vec3)>,
}

/// Returns whether there are events of pointers.
pub(super) fn has_pointers(world: &World) -> bool {
    world.contains_resource::<Messages<Pointer<Press>>>()
}

/// Touches paint under pointers.
pub(super) fn paint(
    brush: Res<CoatingBrush>,
    mut stroke: ResMut<Stroke>,
    mut presses: MessageReader<Pointer<Press>>,
    mut moves: MessageReader<Pointer<Move>>,
    mut releases: MessageReader<Pointer<Release>>,
    mut commands: Commands,
) {
    let mut touch = |hit: &FilmHit, position: Vec3, number: u32| {
        if let Some(effect) = brush.effect
            && let Ok(mut root) = commands.get_entity(hit.root)
        {
            let touch = TouchAt::new(position, brush.radius, effect).with_hardness(brush.hardness).in_stroke(number);
            root.touch_at(touch);
        }
    };
    let may_paint = brush.effect.is_some() && !brush.blocked;
    for press in presses.read().filter(|press| press.event.button == brush.button && may_paint) {
        let Some((hit, position)) = film_hit(&press.event.hit) else { continue };
        stroke.number += 1;
        stroke.drawing = Some((press.pointer_id, position));
        touch(hit, position, stroke.number);
    }
    for moved in moves.read().filter(|_| may_paint) {
        let Some((pointer, last)) = stroke.drawing.filter(|&(pointer, _)| pointer == moved.pointer_id) else {
            continue;
        };
        let Some((hit, position)) = film_hit(&moved.event.hit) else { continue };
        let gap = brush.radius * brush.spacing.clamp(0.05, 2.0);
        let count = ((position - last).length() / gap).floor();
        if count >= 1.0 {
            let count = count.min(MOST_BETWEEN);
            // The last one where the pointer is, the others at equal distances before it.
            for i in 1..=count as u32 {
                touch(hit, last.lerp(position, i as f32 / count), stroke.number);
            }
            stroke.drawing = Some((pointer, position));
        }
    }
    for release in releases.read().filter(|release| release.event.button == brush.button) {
        stroke.drawing = stroke.drawing.filter(|&(pointer, _)| pointer != release.pointer_id);
    }
}

/// Returns what was hit of a film, and where.
fn film_hit(hit: &HitData) -> Option<(&FilmHit, Vec3)> {
    hit.extra_as::<FilmHit>().zip(hit.position)
}
