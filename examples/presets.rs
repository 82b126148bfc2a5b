//! The presets side by side: twelve ways in which paint grows old.
//!
//! `cargo run --example presets`. When all are ruined they get fresh paint with another seed, and it begins again;
//! Space begins again at once.

use bevy::prelude::*;
use bevy_coating::prelude::*;
use bevy_egui::{EguiContexts, EguiPlugin, EguiPrimaryContextPass, egui};

fn main() {
    App::new()
        .add_plugins((DefaultPlugins, EguiPlugin::default(), CoatingWeatheringPlugin::default()))
        .insert_resource(CoatingClock { age_per_second: 0.04, ..default() })
        .add_systems(Startup, setup)
        .add_systems(Update, restart)
        .add_systems(EguiPrimaryContextPass, write_labels)
        .run();
}

/// The preset of the paint on a sphere.
#[derive(Component)]
struct Shows(Preset);

fn setup(mut commands: Commands, mut meshes: ResMut<Assets<Mesh>>, mut materials: ResMut<Assets<StandardMaterial>>) {
    let sphere = meshes.add(Sphere::new(0.5));
    let paint = materials.add(Color::srgb(0.65, 0.2, 0.15));
    let rows = [0.85, -0.85].map(|y| [-3.0, -1.8, -0.6, 0.6, 1.8, 3.0].map(|x| Vec3::new(x, y, 0.0)));
    for (preset, place) in Preset::ALL.into_iter().zip(rows.concat()) {
        commands.spawn((
            Shows(preset),
            Mesh3d(sphere.clone()),
            MeshMaterial3d(paint.clone()),
            Transform::from_translation(place),
            // A preset is a set of settings. For some of your own: `Coating::new(CoatingSettings { .. })`, or the
            // handle of a `.coating.ron` asset.
            Coating::new(preset),
        ));
    }
    let sun = DirectionalLight { illuminance: 8_000.0, shadow_maps_enabled: true, ..default() };
    commands.spawn((sun, Transform::from_xyz(-1.0, 1.5, 2.0).looking_at(Vec3::ZERO, Vec3::Y)));
    commands.insert_resource(GlobalAmbientLight { brightness: 300.0, ..default() });
    commands.spawn((Camera3d::default(), Transform::from_xyz(0.0, 0.3, 6.4).looking_at(Vec3::ZERO, Vec3::Y)));
}

/// Gives every sphere fresh paint when the youngest film has come to age 1, or when Space is pressed.
fn restart(
    keys: Res<ButtonInput<KeyCode>>,
    status: Res<CoatingStatus>,
    mut spheres: Query<&mut Coating>,
    mut seed: Local<u64>,
) {
    let ruined = status.films > 0 && status.youngest >= 1.0;
    if ruined || keys.just_pressed(KeyCode::Space) {
        *seed += 1;
        for mut coating in &mut spheres {
            // Another seed needs another film: the plugin builds it anew, and it starts at age 0.
            coating.seed = Some(*seed);
        }
    }
}

/// Writes the name of each preset below its sphere, where the camera sees it.
fn write_labels(
    mut contexts: EguiContexts,
    status: Res<CoatingStatus>,
    camera: Single<(&Camera, &GlobalTransform)>,
    spheres: Query<(&Shows, &GlobalTransform)>,
) -> Result {
    let painter = contexts.ctx_mut()?.layer_painter(egui::LayerId::background());
    let write = |place: egui::Pos2, text: String| {
        painter.text(place, egui::Align2::CENTER_TOP, text, egui::FontId::proportional(20.0), egui::Color32::WHITE);
    };
    let (camera, eye) = *camera;
    for (shows, sphere) in &spheres {
        let below = sphere.translation() - 0.6 * Vec3::Y;
        if let Ok(place) = camera.world_to_viewport(eye, below) {
            write(egui::pos2(place.x, place.y), shows.0.to_string());
        }
    }
    let middle = painter.clip_rect().center_top() + egui::vec2(0.0, 24.0);
    write(middle, format!("age {:.2}   Space: fresh paint", status.youngest));
    Ok(())
}
