//! The panel: every setting, the clock, heat maps, a brush and figures, beside a barrel. F2 opens and closes it.
//!
//! `cargo run --example panel`

use bevy::prelude::*;
use bevy_coating::{CoatingPanel, CoatingPanelPlugin, CoatingPointingPlugin, prelude::*};
use bevy_egui::EguiPlugin;

fn main() {
    App::new()
        // Only the app adds `EguiPlugin`, as there can be but one.
        .add_plugins((DefaultPlugins, EguiPlugin::default()))
        .add_plugins((CoatingWeatheringPlugin::default(), CoatingPanelPlugin, CoatingPointingPlugin))
        .add_systems(Startup, setup)
        .add_systems(Update, toggle)
        .run();
}

fn toggle(keys: Res<ButtonInput<KeyCode>>, mut panel: ResMut<CoatingPanel>) {
    if keys.just_pressed(KeyCode::F2) {
        panel.open = !panel.open;
    }
}

fn setup(mut commands: Commands, mut meshes: ResMut<Assets<Mesh>>, mut materials: ResMut<Assets<StandardMaterial>>) {
    let paint = materials.add(Color::srgb(0.15, 0.4, 0.35));
    let barrel = (Mesh3d(meshes.add(Cylinder::new(0.3, 0.9))), MeshMaterial3d(paint.clone()));
    commands.spawn((Name::new("barrel"), barrel, Coating::new(Preset::Heavy), Transform::from_xyz(-0.2, 0.0, 0.0)));
    let ball = (Mesh3d(meshes.add(Sphere::new(0.2))), MeshMaterial3d(paint));
    commands.spawn((Name::new("ball"), ball, Coating::default(), Transform::from_xyz(0.4, -0.25, 0.1)));
    let sun = DirectionalLight { illuminance: 8_000.0, shadow_maps_enabled: true, ..default() };
    commands.spawn((sun, Transform::from_xyz(-1.0, 1.5, 2.0).looking_at(Vec3::ZERO, Vec3::Y)));
    commands.insert_resource(GlobalAmbientLight { brightness: 300.0, ..default() });
    commands.spawn((Camera3d::default(), Transform::from_xyz(0.0, 0.7, 2.2).looking_at(Vec3::ZERO, Vec3::Y)));
}
