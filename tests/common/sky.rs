//! Things that lie in the rain, for tests of weather.
#![allow(dead_code, reason = "each test binary uses its part")]

use bevy::prelude::*;
use bevy_coating::{
    prelude::*,
    stain::{Exposure, StainFields},
};

use crate::common::*;

pub const RAIN: CoatingWeather = CoatingWeather { wind: Vec3::ZERO, gusts: 0.0, rain: Vec3::NEG_Y, sun: Vec3::ZERO };

/// Turns the plate, which faces +z, to face up.
pub fn lying() -> Transform {
    Transform::from_rotation(Quat::from_rotation_x(-std::f32::consts::FRAC_PI_2))
}

/// A plate that lies on the ground, over 0 to 1 in x and -1 to 0 in z.
pub fn spawn_lying(app: &mut App, n: u32, coating: Coating) -> Entity {
    let mesh = add_mesh(app, plate(n));
    app.world_mut().spawn((Mesh3d(mesh), lying(), coating)).id()
}

/// A roof over half of what lies on the ground, one metre up: over x from -1.5 to 0.5.
pub fn spawn_roof(app: &mut App) -> Entity {
    let mesh = add_mesh(app, Plane3d::new(Vec3::Y, Vec2::new(1.0, 2.0)).mesh().build());
    app.world_mut().spawn((Mesh3d(mesh), Transform::from_xyz(-0.5, 1.0, -0.5), RainShelter)).id()
}

pub fn exposure(app: &App, film: Entity) -> &Exposure {
    &app.world().get::<StainFields>(film).expect("a film").exposure
}

/// Requests `steps` steps and updates until all films that were ready have taken them.
pub fn take_steps_held(app: &mut App, steps: u64) {
    let clocks = |app: &mut App| {
        let world = app.world_mut();
        world.query::<&FilmClock>().iter(world).map(|clock| clock.steps).collect::<Vec<_>>()
    };
    let expected: Vec<u64> = clocks(app).iter().map(|taken| taken + steps).collect();
    app.world_mut().resource_mut::<CoatingClock>().request_steps(steps);
    update_until(app, |app| clocks(app) == expected);
}

/// Settings under which rain, sun, rust and dust all do something soon.
pub fn wet_coating() -> Coating {
    quick_coating().with_seed(11)
}
