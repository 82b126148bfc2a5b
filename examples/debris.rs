//! Debris: flakes of paint fall as objects of the world. Those of the left drum flutter down by themselves; those of
//! the right one are handed to another physics, here a few lines that let them bounce.
//!
//! `cargo run --example debris`. Left mouse button: shoot at the paint.

use bevy::prelude::*;
use bevy_coating::{CoatingBrush, CoatingPointingPlugin, Flake, prelude::*, touch::Effect};

fn main() {
    let shots = CoatingBrush { effect: Some(Effect::Hit(9.0)), radius: 0.08, ..default() };
    App::new()
        .add_plugins((DefaultPlugins, CoatingWeatheringPlugin::default(), CoatingPointingPlugin))
        .insert_resource(CoatingClock { age_per_second: 0.03, ..default() })
        .insert_resource(shots)
        .add_systems(Startup, setup)
        .add_systems(Update, bounce)
        // The one line for a physics engine: insert its rigid body and its collider here.
        .add_observer(|flake: On<Add, Flake>, mut commands: Commands| {
            commands.entity(flake.entity).insert(Bouncy);
        })
        .run();
}

/// Moved by the physics of this example.
#[derive(Component)]
struct Bouncy;

fn setup(mut commands: Commands, mut meshes: ResMut<Assets<Mesh>>, mut materials: ResMut<Assets<StandardMaterial>>) {
    let drum = meshes.add(Cylinder::new(0.3, 0.9));
    // `flutters: false` leaves flakes where they came off: whatever moves them, they are for the game to despawn.
    let own = CoatingDebris { floor: Some(0.0), ..default() };
    let handed_over = CoatingDebris { flutters: false, least_size: 0.01, ..default() };
    for (x, color, debris) in
        [(-0.5, Color::srgb(0.6, 0.25, 0.1), own), (0.5, Color::srgb(0.1, 0.35, 0.5), handed_over)]
    {
        let paint = MeshMaterial3d(materials.add(color));
        let place = Transform::from_xyz(x, 0.9, 0.0);
        commands.spawn((Mesh3d(drum.clone()), paint, place, Coating::new(Preset::Harsh), debris));
    }
    let ground = Mesh3d(meshes.add(Plane3d::default().mesh().size(20.0, 20.0)));
    commands.spawn((ground, MeshMaterial3d(materials.add(Color::srgb(0.4, 0.4, 0.37)))));
    let sun = DirectionalLight { illuminance: 8_000.0, shadow_maps_enabled: true, ..default() };
    commands.spawn((sun, Transform::from_xyz(-1.0, 2.0, 2.0).looking_at(Vec3::ZERO, Vec3::Y)));
    commands.insert_resource(GlobalAmbientLight { brightness: 300.0, ..default() });
    let eye = Transform::from_xyz(0.0, 1.2, 2.8).looking_at(Vec3::new(0.0, 0.6, 0.0), Vec3::Y);
    commands.spawn((Camera3d::default(), eye));
}

/// Lets the right drum's flakes fall, spin and bounce, and despawns them in the end.
fn bounce(
    time: Res<Time>,
    mut commands: Commands,
    mut flakes: Query<(Entity, &mut Flake, &mut Transform), With<Bouncy>>,
    debris: Query<&CoatingDebris>,
) {
    let dt = time.delta_secs();
    for (entity, mut flake, mut place) in &mut flakes {
        if debris.get(flake.root).is_ok_and(|debris| debris.flutters) {
            continue;
        }
        flake.time += dt;
        flake.velocity.y -= 9.81 * dt;
        place.translation += flake.velocity * dt;
        place.rotate(Quat::from_scaled_axis(flake.spin * dt));
        if place.translation.y < 0.01 && flake.velocity.y < 0.0 {
            place.translation.y = 0.01;
            flake.velocity *= Vec3::new(0.6, -0.35, 0.6);
            flake.spin *= 0.5;
        }
        if flake.time > 6.0 {
            commands.entity(entity).despawn();
        }
    }
}
