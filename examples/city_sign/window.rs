//! The window: orbit camera, keys, and a small read-out.

use crate::camera::{self, Orbit};
use crate::cli::{Options, View};
use crate::graphics;
use crate::scene::sky::Sky;
use crate::weathering::{Progress, Repaint};
use bevy::anti_alias::fxaa::Fxaa;
use bevy::input::mouse::{AccumulatedMouseMotion, AccumulatedMouseScroll, MouseScrollUnit};
use bevy::prelude::*;
use bevy::window::WindowResolution;
use bevy_coating::prelude::*;
use bevy_egui::{EguiContexts, EguiPlugin, EguiPrimaryContextPass, egui};

pub fn add(app: &mut App, options: &Options) {
    let (width, height) = options.size;
    let window = Window { title: "City sign".into(), resolution: WindowResolution::new(width, height), ..default() };
    let window = WindowPlugin { primary_window: Some(window), ..default() };
    app.add_plugins(DefaultPlugins.set(window).set(graphics::assets()).set(graphics::renderer(false)))
        .add_plugins(EguiPlugin::default())
        .init_resource::<Help>()
        .add_systems(Startup, spawn_camera)
        .add_systems(Update, (keys, orbit))
        .add_systems(EguiPrimaryContextPass, read_out);
}

const KEYS: [(&str, &str); 8] = [
    ("Space", "pause"),
    ("S, N", "one step"),
    ("Up, Down", "faster, slower"),
    ("R", "fresh paint"),
    ("1, 2, 3", "sign, close, street"),
    ("Drag, wheel", "turn, zoom"),
    ("Right drag", "shift"),
    ("H", "this list"),
];

/// Whether the list of keys is open.
#[derive(Resource)]
struct Help(bool);

impl Default for Help {
    fn default() -> Self {
        Self(true)
    }
}

fn spawn_camera(mut commands: Commands, sky: Res<Sky>, options: Res<Options>) {
    commands.spawn((camera::view(&sky, Orbit::of(options.view)), Fxaa::default()));
}

/// Age per second.
const SLOWEST: f64 = 0.001;
const FASTEST: f64 = 1.0;

fn step(clock: &mut CoatingClock) {
    clock.paused = true;
    clock.request_steps(1);
}

fn keys(
    keyboard: Res<ButtonInput<KeyCode>>,
    mut clock: ResMut<CoatingClock>,
    mut commands: Commands,
    mut help: ResMut<Help>,
    mut cameras: Query<(&mut Orbit, &mut Projection)>,
    mut exit: MessageWriter<AppExit>,
) {
    for key in keyboard.get_just_pressed() {
        match key {
            KeyCode::Space => clock.paused = !clock.paused,
            KeyCode::KeyS | KeyCode::KeyN => step(&mut clock),
            KeyCode::ArrowUp | KeyCode::Equal | KeyCode::NumpadAdd => {
                clock.age_per_second = (clock.age_per_second * 1.5).min(FASTEST);
            }
            KeyCode::ArrowDown | KeyCode::Minus | KeyCode::NumpadSubtract => {
                clock.age_per_second = (clock.age_per_second / 1.5).max(SLOWEST);
            }
            KeyCode::KeyR => commands.trigger(Repaint),
            KeyCode::KeyH => help.0 = !help.0,
            KeyCode::Escape => {
                exit.write(AppExit::Success);
            }
            _ => {}
        }
        let view = match key {
            KeyCode::Digit1 => View::Sign,
            KeyCode::Digit2 => View::Close,
            KeyCode::Digit3 => View::Street,
            _ => continue,
        };
        for (mut orbit, mut projection) in &mut cameras {
            *orbit = Orbit::of(view);
            *projection = orbit.projection();
        }
    }
}

fn orbit(
    buttons: Res<ButtonInput<MouseButton>>,
    motion: Res<AccumulatedMouseMotion>,
    scroll: Res<AccumulatedMouseScroll>,
    mut contexts: EguiContexts,
    mut cameras: Query<(&mut Orbit, &mut Transform)>,
) {
    // What happens over the read-out belongs to it.
    let taken = contexts.ctx_mut().is_ok_and(|context| context.egui_wants_pointer_input());
    for (mut orbit, mut transform) in &mut cameras {
        if !taken && buttons.pressed(MouseButton::Left) {
            orbit.yaw -= motion.delta.x * 0.005;
            orbit.pitch = (orbit.pitch + motion.delta.y * 0.005).clamp(-0.6, 1.4);
        }
        if !taken && (buttons.pressed(MouseButton::Right) || buttons.pressed(MouseButton::Middle)) {
            let pan = transform.rotation * Vec3::new(-motion.delta.x, motion.delta.y, 0.0) * orbit.distance * 0.0012;
            orbit.centre += pan;
        }
        let lines = match scroll.unit {
            MouseScrollUnit::Line => scroll.delta.y,
            MouseScrollUnit::Pixel => scroll.delta.y / 40.0,
        };
        if !taken && lines != 0.0 {
            orbit.distance = (orbit.distance * (-0.12 * lines).exp()).clamp(0.15, 40.0);
        }
        let mut place = orbit.transform();
        // Never below the ground.
        place.translation.y = place.translation.y.max(0.12);
        if *transform != place {
            *transform = place;
        }
    }
}

fn read_out(
    mut contexts: EguiContexts,
    mut clock: ResMut<CoatingClock>,
    mut commands: Commands,
    progress: Progress,
    help: Res<Help>,
) -> Result {
    let context = contexts.ctx_mut()?;
    egui::Window::new("Weathering").default_pos([16.0, 16.0]).resizable(false).show(context, |ui| {
        ui.heading(format!("age {:.3}", progress.age()));
        let (films, wanted) = progress.films();
        ui.label(if films < wanted || wanted == 0 {
            format!("building films: {films} of {wanted}")
        } else if clock.paused {
            "paused".to_owned()
        } else {
            format!("{:.3} a second", clock.age_per_second)
        });
        ui.horizontal(|ui| {
            if ui.button(if clock.paused { "Run" } else { "Pause" }).clicked() {
                clock.paused = !clock.paused;
            }
            if ui.button("Step").clicked() {
                step(&mut clock);
            }
            if ui.button("Reset").clicked() {
                commands.trigger(Repaint);
            }
        });
        let mut speed = clock.age_per_second;
        let slider = egui::Slider::new(&mut speed, SLOWEST..=FASTEST).logarithmic(true).text("age per second");
        if ui.add(slider).changed() {
            clock.age_per_second = speed;
        }
        if help.0 {
            ui.separator();
            egui::Grid::new("keys").num_columns(2).show(ui, |ui| {
                for (key, meaning) in KEYS {
                    ui.monospace(key);
                    ui.label(meaning);
                    ui.end_row();
                }
            });
        }
    });
    Ok(())
}
