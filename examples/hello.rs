//! The smallest scene: a painted barrel whose paint cracks, curls, falls off and rusts before your eyes.
//!
//! `cargo run --example hello`

use bevy::prelude::*;
use bevy_coating::prelude::*;

fn main() {
    App::new()
        .add_plugins(DefaultPlugins)
        // Ages the paint of every entity that has a `Coating`.
        .add_plugins(CoatingWeatheringPlugin::default())
        // From fresh to ruined in 25 seconds.
        .insert_resource(CoatingClock { age_per_second: 0.04, ..default() })
        .add_systems(Startup, setup)
        .run();
}

fn setup(mut commands: Commands, mut meshes: ResMut<Assets<Mesh>>, mut materials: ResMut<Assets<StandardMaterial>>) {
    // The barrel: any mesh will do, and its material is the paint. The `Coating` is all that makes it age.
    commands.spawn((
        Mesh3d(meshes.add(Cylinder::new(0.3, 0.9))),
        MeshMaterial3d(materials.add(Color::srgb(0.15, 0.4, 0.35))),
        Coating::default(),
    ));
    // Light from one side, and a little from everywhere, so that shadows are not black.
    let sun = DirectionalLight { illuminance: 8_000.0, shadow_maps_enabled: true, ..default() };
    commands.spawn((sun, Transform::from_xyz(-1.0, 1.5, 2.0).looking_at(Vec3::ZERO, Vec3::Y)));
    commands.insert_resource(GlobalAmbientLight { brightness: 300.0, ..default() });
    // The camera looks down on the barrel from the front.
    commands.spawn((Camera3d::default(), Transform::from_xyz(0.0, 0.7, 1.5).looking_at(Vec3::ZERO, Vec3::Y)));
}
