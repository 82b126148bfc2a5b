//! Shooting: a player shoots a sign, sees its paint chip and flakes fall, washes it, paints it anew, saves and loads.
//!
//! `cargo run --example shooting`. 1 to 4 choose what is in the hand: a gun, a hose, sandpaper, a paint brush; the left
//! mouse button uses it. Z takes the last stroke back and Y does it again, S saves and L loads, Space lets time pass.

use bevy::prelude::*;
use bevy_coating::{CoatingBrush, CoatingPointingPlugin, prelude::*, touch::Effect};
use bevy_egui::{EguiContexts, EguiPlugin, EguiPrimaryContextPass, egui};

/// What may be in the player's hand: its name, what it does to paint, and its radius in metres.
const TOOLS: [(&str, Effect, f32); 4] = [
    ("gun", Effect::Hit(9.0), 0.06),
    ("hose", Effect::Wash(0.3), 0.2),
    ("sandpaper", Effect::Sand(0.5), 0.12),
    ("paint brush", Effect::Repaint, 0.15),
];
const KEYS: [KeyCode; 4] = [KeyCode::Digit1, KeyCode::Digit2, KeyCode::Digit3, KeyCode::Digit4];

/// Tool in the hand, and what happened last.
#[derive(Resource, Default)]
struct Player {
    tool: usize,
    news: String,
}

fn main() {
    App::new()
        .add_plugins((DefaultPlugins, EguiPlugin::default()))
        .add_plugins((CoatingWeatheringPlugin::default(), CoatingPointingPlugin))
        .insert_resource(CoatingClock { age_per_second: 0.02, paused: true, ..default() })
        .init_resource::<Player>()
        .add_systems(Startup, setup)
        .add_systems(Update, (choose_tool, obey_keys, note_paint))
        .add_systems(EguiPrimaryContextPass, write_on_screen)
        .run();
}

fn setup(mut commands: Commands, mut meshes: ResMut<Assets<Mesh>>, mut materials: ResMut<Assets<StandardMaterial>>) {
    let debris = CoatingDebris { floor: Some(0.0), ..default() };
    commands.spawn((
        Mesh3d(meshes.add(Cuboid::new(1.4, 1.0, 0.02))),
        MeshMaterial3d(materials.add(Color::srgb(0.1, 0.3, 0.5))),
        Transform::from_xyz(0.0, 1.2, 0.0),
        (Coating::default().with_start_age(0.3), CoatingHistory::default(), debris),
    ));
    let ground = Mesh3d(meshes.add(Plane3d::default().mesh().size(20.0, 20.0)));
    commands.spawn((ground, MeshMaterial3d(materials.add(Color::srgb(0.4, 0.4, 0.37)))));
    let sun = DirectionalLight { illuminance: 8_000.0, shadow_maps_enabled: true, ..default() };
    commands.spawn((sun, Transform::from_xyz(-1.0, 1.5, 2.0).looking_at(Vec3::ZERO, Vec3::Y)));
    commands.insert_resource(GlobalAmbientLight { brightness: 300.0, ..default() });
    let eye = Transform::from_xyz(0.0, 1.5, 2.4).looking_at(Vec3::new(0.0, 1.1, 0.0), Vec3::Y);
    commands.spawn((Camera3d::default(), eye));
}

/// The brush does what the tool in the hand does.
fn choose_tool(keys: Res<ButtonInput<KeyCode>>, mut player: ResMut<Player>, mut brush: ResMut<CoatingBrush>) {
    if let Some(tool) = KEYS.iter().position(|key| keys.just_pressed(*key)) {
        player.tool = tool;
    }
    let (_, effect, radius) = TOOLS[player.tool];
    brush.set_if_neq(CoatingBrush { effect: Some(effect), radius, ..brush.clone() });
}

fn obey_keys(
    keys: Res<ButtonInput<KeyCode>>,
    mut clock: ResMut<CoatingClock>,
    mut commands: Commands,
    signs: Query<(Entity, Option<&CoatingSnapshot>), With<Coating>>,
) {
    if keys.just_pressed(KeyCode::Space) {
        clock.paused = !clock.paused;
    }
    for (sign, saved) in &signs {
        let mut sign = commands.entity(sign);
        if keys.just_pressed(KeyCode::KeyZ) {
            sign.undo_touch();
        }
        if keys.just_pressed(KeyCode::KeyY) {
            sign.redo_touch();
        }
        if keys.just_pressed(KeyCode::KeyS) {
            sign.save_films();
        }
        if let Some(saved) = saved.filter(|_| keys.just_pressed(KeyCode::KeyL)) {
            sign.restore_films(saved.clone());
        }
    }
}

/// The paint tells what happens to it.
fn note_paint(
    mut player: ResMut<Player>,
    mut fallen: MessageReader<PieceFallen>,
    mut painted: MessageReader<FilmRepainted>,
    mut reached: MessageReader<AgeReached>,
) {
    for piece in fallen.read() {
        player.news = format!("A flake of {:.0} mm falls.", piece.size * 1e3);
    }
    for film in painted.read() {
        player.news = format!("{:.0} % of the paint is whole.", film.whole * 100.0);
    }
    for film in reached.read() {
        player.news = format!("Back at age {:.2}.", film.age);
    }
}

fn write_on_screen(mut contexts: EguiContexts, player: Res<Player>, clock: Res<CoatingClock>) -> Result {
    egui::Window::new("Shooting").resizable(false).show(contexts.ctx_mut()?, |ui| {
        for (i, (name, ..)) in TOOLS.iter().enumerate() {
            ui.label(format!("{} {}: {name}", if i == player.tool { ">" } else { " " }, i + 1));
        }
        ui.label("Z: back, Y: again, S: save, L: load");
        ui.label(if clock.paused { "Space: let time pass" } else { "Space: stop time" });
        ui.label(&player.news);
    });
    Ok(())
}
