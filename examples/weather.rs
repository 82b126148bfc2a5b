//! Weather: rain, wind and sun work on paint, and a roof keeps rain and sun off.
//!
//! `cargo run --example weather`. Two barrels age side by side, one of them under a roof. R, W and S switch rain, wind
//! and sun on and off. Where rain reaches it the paint gets wet; wet paint comes off sooner and bleeds more rust.

use bevy::prelude::*;
use bevy_coating::{prelude::*, stain::StainFields};
use bevy_egui::{EguiContexts, EguiPlugin, EguiPrimaryContextPass, egui};

/// Rain falls in this direction: down, and to the left. Its length, 0 to 1, says how hard it rains.
const RAIN: Vec3 = Vec3::new(-0.4, -0.8, -0.2);
/// The wind blows to the left, almost as hard as gravity pulls. It slants the streaks of rust.
const WIND: Vec3 = Vec3::new(-0.8, 0.0, 0.0);
/// Sunlight falls in this direction. It dries what it reaches.
const SUN: Vec3 = Vec3::new(0.5, -0.6, -0.6);

fn main() {
    App::new()
        .add_plugins((DefaultPlugins, EguiPlugin::default(), CoatingWeatheringPlugin::default()))
        // From fresh to ruined in 40 seconds.
        .insert_resource(CoatingClock { age_per_second: 0.025, ..default() })
        // By default the air is still and dry, and there is no sun. Here it rains from the start.
        .insert_resource(CoatingWeather { rain: RAIN, ..default() })
        .add_systems(Startup, setup)
        .add_systems(Update, choose_weather)
        .add_systems(EguiPrimaryContextPass, write_on_screen)
        .run();
}

fn setup(mut commands: Commands, mut meshes: ResMut<Assets<Mesh>>, mut materials: ResMut<Assets<StandardMaterial>>) {
    let barrel = meshes.add(Cylinder::new(0.3, 0.9));
    let paint = materials.add(Color::srgb(0.75, 0.65, 0.4));
    for (name, x) in [("In the open", -0.6), ("Under the roof", 0.6)] {
        commands.spawn((
            Name::new(name),
            Mesh3d(barrel.clone()),
            MeshMaterial3d(paint.clone()),
            Transform::from_xyz(x, 0.45, 0.0),
            // The same seed gives both the same weak places: what differs comes from the weather alone.
            Coating::default().with_seed(3),
        ));
    }
    // A roof and a wall. The component tells the plugin that they keep rain and sun off whatever is behind them.
    let planks = materials.add(Color::srgb(0.3, 0.25, 0.2));
    let parts =
        [(Vec3::new(1.2, 0.04, 1.4), Vec3::new(0.7, 1.2, 0.1)), (Vec3::new(0.04, 1.2, 1.4), Vec3::new(1.3, 0.6, 0.1))];
    for (size, place) in parts {
        let mesh = Mesh3d(meshes.add(Cuboid::from_size(size)));
        commands.spawn((mesh, MeshMaterial3d(planks.clone()), Transform::from_translation(place), RainShelter));
    }
    // Ground, light and camera, as in any scene.
    let ground = Mesh3d(meshes.add(Plane3d::default().mesh().size(20.0, 20.0)));
    commands.spawn((ground, MeshMaterial3d(materials.add(Color::srgb(0.35, 0.36, 0.33)))));
    let light = DirectionalLight { illuminance: 7_000.0, shadow_maps_enabled: true, ..default() };
    commands.spawn((light, Transform::default().looking_to(SUN, Vec3::Y)));
    commands.insert_resource(GlobalAmbientLight { brightness: 400.0, ..default() });
    let eye = Transform::from_xyz(0.0, 1.2, 3.0).looking_at(Vec3::new(0.0, 0.55, 0.0), Vec3::Y);
    commands.spawn((Camera3d::default(), eye));
}

/// The weather is a resource: what is written into it takes effect at once, on every film.
fn choose_weather(keys: Res<ButtonInput<KeyCode>>, mut weather: ResMut<CoatingWeather>) {
    let switched = |now: Vec3, on: Vec3| if now == Vec3::ZERO { on } else { Vec3::ZERO };
    if keys.just_pressed(KeyCode::KeyR) {
        weather.rain = switched(weather.rain, RAIN);
    }
    if keys.just_pressed(KeyCode::KeyW) {
        weather.wind = switched(weather.wind, WIND);
    }
    if keys.just_pressed(KeyCode::KeyS) {
        weather.sun = switched(weather.sun, SUN.normalize());
    }
}

/// Says how the weather is, and how wet each barrel. A film's state is in components of its entity; those of
/// `StainFields` that end with a list have a value for every vertex of the film.
fn write_on_screen(
    mut contexts: EguiContexts,
    weather: Res<CoatingWeather>,
    status: Res<CoatingStatus>,
    barrels: Query<(&Name, &StainFields)>,
) -> Result {
    egui::Window::new("Weather").resizable(false).show(contexts.ctx_mut()?, |ui| {
        for (key, name, force) in [("R", "rain", weather.rain), ("W", "wind", weather.wind), ("S", "sun", weather.sun)]
        {
            ui.label(format!("{key}   {name} {}", if force == Vec3::ZERO { "off" } else { "on" }));
        }
        ui.separator();
        ui.label(format!("age {:.2}", status.youngest));
        for (name, stains) in &barrels {
            let moisture = &stains.film.moisture;
            let mean = moisture.iter().sum::<f32>() / moisture.len().max(1) as f32;
            ui.label(format!("{name}: {:.0} % wet", mean * 100.0));
        }
    });
    Ok(())
}
