//! The recorded strokes, and when they are painted.

use crate::stage::{HEIGHT, WIDTH};
use bevy::prelude::*;
use bevy_coating::touch::{Change, Effect};
use bevy_coating::{HeatMapView, heat::HeatMap, prelude::*};
use std::f32::consts::TAU;

pub struct StrokesPlugin;

impl Plugin for StrokesPlugin {
    fn build(&self, app: &mut App) {
        app.add_systems(Update, (paint, show_heat_map));
    }
}

/// A stroke: what it does, how wide it is, and the places that it goes through on the sheet, in metres from its middle.
pub struct Stroke {
    pub effect: Effect,
    pub radius: f32,
    pub places: Vec<Vec2>,
}

/// All strokes, in the order in which they are painted.
pub fn strokes() -> Vec<Stroke> {
    let along = |count: usize, place: &dyn Fn(f32) -> Vec2| -> Vec<Vec2> {
        (0..=count).map(|i| place(i as f32 / count as f32)).collect()
    };
    let protect = Effect::Adhesion(Change::Multiply(1.8));
    let weaken = Effect::Adhesion(Change::Multiply(0.82));
    let ring = |t: f32| Vec2::new(-0.38, 0.05) + 0.2 * Vec2::from_angle(t * TAU);
    let wave = |t: f32| Vec2::new(0.02 + 0.62 * t, 0.12 * (t * 1.5 * TAU).sin());
    let corner = |t: f32| Vec2::new(0.66 - 0.5 * t, -0.42);
    let line = |t: f32| Vec2::new(-0.62 + 1.24 * t, 0.38);
    vec![
        Stroke { effect: protect, radius: 0.075, places: along(24, &ring) },
        Stroke { effect: protect, radius: 0.075, places: along(24, &wave) },
        Stroke { effect: weaken, radius: 0.12, places: along(8, &corner) },
        Stroke { effect: Effect::Binding(Change::Multiply(0.15)), radius: 0.02, places: along(80, &line) },
    ]
}

/// Paints all strokes on films that are ready.
fn paint(mut commands: Commands, mut ready: MessageReader<FilmReady>, places: Query<&GlobalTransform>) {
    for film in ready.read() {
        let Ok(place) = places.get(film.entity) else { continue };
        for (number, Stroke { effect, radius, places }) in strokes().into_iter().enumerate() {
            for at in places {
                let at = place.transform_point(at.extend(0.0));
                let touch = TouchAt::new(at, radius, effect).with_hardness(0.8).in_stroke(number as u32 + 1);
                commands.entity(film.root).touch_at(touch);
            }
        }
    }
}

/// Age at which the heat map is shown in pictures.
pub const HEAT_AGE: f64 = 0.02;

/// Shows the heat map at its age in pictures, and on M in a window.
fn show_heat_map(
    mut commands: Commands,
    keyboard: Res<ButtonInput<KeyCode>>,
    windows: Query<&Window>,
    props: Query<(Entity, Has<HeatMapView>), With<Coating>>,
    films: Query<(&CoatedBy, &FilmClock)>,
) {
    for (root, shown) in &props {
        let age = films.iter().find(|(coated_by, _)| coated_by.0 == root).map_or(0.0, |(_, clock)| clock.age());
        let wanted = if windows.is_empty() {
            (age - HEAT_AGE).abs() < 0.01
        } else {
            shown != keyboard.just_pressed(KeyCode::KeyM)
        };
        if wanted && !shown {
            commands.entity(root).insert(HeatMapView::new(HeatMap::Adhesion));
        } else if shown && !wanted {
            commands.entity(root).remove::<HeatMapView>();
        }
    }
}

/// Returns whether a place of the sheet lies on it.
pub fn is_on_sheet(at: Vec2) -> bool {
    at.x.abs() <= 0.5 * WIDTH && at.y.abs() <= 0.5 * HEIGHT
}
