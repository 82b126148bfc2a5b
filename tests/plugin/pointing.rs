//! Pointers over films: hits, strokes of a brush, and the rim of the brush.

use bevy::{
    camera::{Camera, ImageRenderTarget, NormalizedRenderTarget},
    picking::{
        InteractionPlugin, PickingPlugin, PickingSystems,
        backend::ray::{RayId, RayMap},
        events::{Pointer, Press},
        pointer::{Location, PointerAction, PointerButton, PointerId, PointerInput},
    },
    prelude::*,
};
use bevy_coating::{
    CoatingBrush, CoatingPointingPlugin, FilmHistory, FilmHit,
    film::FilmMesh,
    prelude::*,
    touch::{Change, Effect},
};

use crate::common::*;

/// Ray of the pointer in the world.
#[derive(Resource)]
struct Aim(Ray3d, Entity);

fn aim(aim: Res<Aim>, mut rays: ResMut<RayMap>) {
    rays.map.insert(RayId::new(aim.1, PointerId::Mouse), aim.0);
}

fn ray_to(x: f32, y: f32) -> Ray3d {
    Ray3d::new(Vec3::new(x, y, 3.0), Dir3::NEG_Z)
}

/// An app with a plate and a mouse before it.
fn pointed_app() -> (App, Entity) {
    let mut app = app();
    app.add_plugins((PickingPlugin, InteractionPlugin, CoatingPointingPlugin));
    app.add_systems(PreUpdate, aim.after(PickingSystems::ProcessInput).before(PickingSystems::Backend));
    app.world_mut().spawn(PointerId::Mouse);
    let camera = app.world_mut().spawn(Camera::default()).id();
    app.insert_resource(Aim(ray_to(0.5, 0.5), camera));
    let plate = spawn_plate(&mut app, 20, quick_coating());
    app.world_mut().entity_mut(plate).insert(CoatingHistory::default());
    wait_for_films(&mut app, 1);
    app.update();
    (app, plate)
}

fn point(app: &mut App, x: f32, y: f32, action: PointerAction) {
    app.world_mut().resource_mut::<Aim>().0 = ray_to(x, y);
    let target = NormalizedRenderTarget::Image(ImageRenderTarget { handle: Handle::default(), scale_factor: 1.0 });
    let location = Location { target, position: Vec2::new(x, y) };
    app.world_mut().write_message(PointerInput::new(PointerId::Mouse, location, action));
    app.update();
}

fn moved() -> PointerAction {
    PointerAction::Move { delta: Vec2::splat(0.1) }
}

#[test]
fn pointers_hit_films_where_they_are() {
    let (mut app, plate) = pointed_app();
    point(&mut app, 0.3, 0.6, PointerAction::Press(PointerButton::Primary));
    let presses = messages::<Pointer<Press>>(&mut app);
    let press = presses.iter().find(|press| press.entity == plate).expect("the plate is pressed");
    let hit = press.event.hit.extra_as::<FilmHit>().expect("a film");
    assert_eq!((hit.entity, hit.root), (plate, plate));
    let position = press.event.hit.position.expect("a place");
    assert!(position.distance(Vec3::new(0.3, 0.6, 0.0)) < 1e-3, "{position}");
    assert!((press.event.hit.depth - 3.0).abs() < 1e-3);
    // Past the plate, and on a hidden one, there is nothing.
    point(&mut app, 2.0, 0.6, PointerAction::Press(PointerButton::Primary));
    assert!(messages::<Pointer<Press>>(&mut app).iter().all(|press| press.entity != plate));
    app.world_mut().entity_mut(plate).insert(Pickable::IGNORE);
    point(&mut app, 0.3, 0.6, PointerAction::Press(PointerButton::Primary));
    assert!(messages::<Pointer<Press>>(&mut app).iter().all(|press| press.entity != plate));
}

#[test]
fn a_brush_paints_a_stroke_from_press_to_release() {
    let (mut app, plate) = pointed_app();
    let adhesions = |app: &App| {
        let film = film_state(app, plate);
        let vertices = film.mesh.topology.all_vertices();
        let at = |v: bevy_coating::film::VertexId| film.mesh.geometry.rest_positions[v.index()];
        vertices.map(|v| (at(v), film.forces.adhesion(v))).collect::<Vec<_>>()
    };
    let before = adhesions(&app);
    // No brush in the hand: nothing happens.
    point(&mut app, 0.2, 0.5, PointerAction::Press(PointerButton::Primary));
    point(&mut app, 0.2, 0.5, PointerAction::Release(PointerButton::Primary));
    assert_eq!(adhesions(&app), before);
    let mut brush = app.world_mut().resource_mut::<CoatingBrush>();
    brush.effect = Some(Effect::Adhesion(Change::Set(9.0)));
    (brush.radius, brush.hardness) = (0.08, 1.0);
    point(&mut app, 0.2, 0.5, PointerAction::Press(PointerButton::Primary));
    for i in 1..=3 {
        point(&mut app, 0.2 + 0.2 * i as f32, 0.5, moved());
    }
    point(&mut app, 0.8, 0.5, PointerAction::Release(PointerButton::Primary));
    // The button is up: the brush no longer paints.
    point(&mut app, 0.5, 0.9, moved());
    let after = adhesions(&app);
    let middle = app.world().get::<FilmMesh>(plate).expect("a film").geometry.rest_positions.iter().sum::<Vec3>()
        / before.len() as f32;
    let mut painted = 0;
    for ((place, old), (_, new)) in before.iter().zip(&after) {
        let place = *place - middle + Vec3::new(0.5, 0.5, 0.0);
        let beside = (place.y - 0.5).abs();
        let along = (0.2..=0.8).contains(&place.x);
        if along && beside < 0.06 {
            painted += 1;
            assert_eq!(*new, 9.0, "{place}");
        } else if beside > 0.1 {
            assert_eq!(new, old, "{place}");
        }
    }
    assert!(painted > 15, "{painted}");
    let history = app.world().get::<FilmHistory>(plate).expect("a history");
    assert!(history.log().len() > 10 && history.last_stroke() == Some(1), "one stroke of many touches");
    messages::<AgeReached>(&mut app);
    app.world_mut().commands().entity(plate).undo_touch();
    update_until(&mut app, |app| !messages::<AgeReached>(app).is_empty());
    app.update();
    assert_eq!(adhesions(&app), before);
}
