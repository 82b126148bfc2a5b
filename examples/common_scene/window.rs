//! The window: orbit camera, keys, and a small read-out.

use super::camera::{self, Orbit};
use super::graphics;
use super::keys::{self, Command, DIGITS, Own};
use super::paint::{Paint, Progress, Repaint};
use super::sky::Sky;
use bevy::anti_alias::fxaa::Fxaa;
use bevy::camera::SubCameraView;
use bevy::input::mouse::{AccumulatedMouseMotion, AccumulatedMouseScroll, MouseScrollUnit};
use bevy::prelude::*;
use bevy::window::WindowResolution;
use bevy_coating::{FilmHistory, prelude::*};
use bevy_egui::{EguiContexts, EguiPlugin, EguiPrimaryContextPass, egui};

/// What the window looks at: the first view, until a digit key chooses another.
#[derive(Resource, Clone, Debug)]
pub struct Views {
    /// Names and places, in the order of their keys.
    pub list: Vec<(&'static str, Orbit)>,
    /// Index of the first, and then of the one that was chosen last.
    pub first: usize,
}

impl Views {
    /// Returns these views from so far that all of what was `designed` for a picture of that size is in one of the size
    /// `free`, as the whole height is anyway.
    pub fn fit(mut self, designed: UVec2, free: UVec2) -> Self {
        let aspect = |size: UVec2| size.x as f32 / size.y as f32;
        let farther = (aspect(designed) / aspect(free)).max(1.0);
        self.list.iter_mut().for_each(|(_, orbit)| orbit.distance *= farther);
        self
    }
}

pub fn add(app: &mut App, title: &str, size: UVec2, views: Views, (keys, covered_below): (Own, f32)) {
    let window = Window { title: title.into(), resolution: WindowResolution::new(size.x, size.y), ..default() };
    let window = WindowPlugin { primary_window: Some(window), ..default() };
    app.add_plugins(DefaultPlugins.set(window).set(graphics::assets()).set(graphics::renderer(false)))
        .add_plugins(EguiPlugin::default())
        .insert_resource(views)
        .insert_resource(OfScene { keys, covered_below })
        .init_resource::<Help>()
        .add_systems(Startup, spawn_camera)
        .add_systems(Update, (keep_past, obey_keys, look, orbit, make_room))
        .add_systems(EguiPrimaryContextPass, read_out);
}

/// Whether the list of keys is open.
#[derive(Resource)]
struct Help(bool);

impl Default for Help {
    fn default() -> Self {
        Self(true)
    }
}

fn spawn_camera(mut commands: Commands, sky: Res<Sky>, views: Res<Views>) {
    if let Some((_, orbit)) = views.list.get(views.first) {
        commands.spawn((camera::view(&sky, *orbit), Fxaa::default()));
    }
}

/// Width of the read-out with the list of keys and the margin beside it, in logical pixels.
const READ_OUT: f32 = 372.0;

/// What only one scene has: its keys, and the height that it covers at the bottom of the window, in logical pixels.
#[derive(Resource, Clone, Copy, Debug)]
struct OfScene {
    keys: Own,
    covered_below: f32,
}

/// Returns the width and height of a window that its read-outs leave free. A window of which they would cover more than
/// half is taken to be free.
pub fn free_part(size: Vec2, covered_below: f32) -> Vec2 {
    let free = |whole: f32, covered: f32| if whole > 2.0 * covered { whole - covered } else { whole };
    Vec2::new(free(size.x, READ_OUT), free(size.y, covered_below))
}

/// Shifts the picture so that its middle is in the middle of what the read-outs leave free.
fn make_room(windows: Query<&Window>, own: Res<OfScene>, mut cameras: Query<&mut Camera, With<Orbit>>) {
    let Ok(window) = windows.single() else { return };
    let (full_size, covered) = (window.physical_size(), window.size() - free_part(window.size(), own.covered_below));
    let offset = 0.5 * window.scale_factor() * Vec2::new(-covered.x, covered.y);
    for mut camera in &mut cameras {
        let is_right =
            |view: &SubCameraView| (view.full_size, view.offset, view.size) == (full_size, offset, full_size);
        if full_size.min_element() > 0 && !camera.sub_camera_view.as_ref().is_some_and(is_right) {
            camera.sub_camera_view = Some(SubCameraView { full_size, offset, size: full_size });
        }
    }
}

/// Memory for the past of each film, which the bar goes through.
const PAST: CoatingHistory = CoatingHistory { keyframe_bytes: 4 << 20 };

fn keep_past(mut commands: Commands, painted: Query<Entity, (With<Paint>, Without<CoatingHistory>)>) {
    for prop in &painted {
        commands.entity(prop).insert(PAST);
    }
}

/// Age per second.
const SLOWEST: f64 = 0.001;
const FASTEST: f64 = 1.0;

fn step(clock: &mut CoatingClock) {
    clock.paused = true;
    clock.request_steps(1);
}

fn obey_keys(
    keyboard: Res<ButtonInput<KeyCode>>,
    mut clock: ResMut<CoatingClock>,
    mut commands: Commands,
    mut help: ResMut<Help>,
    mut exit: MessageWriter<AppExit>,
) {
    for command in keyboard.get_just_pressed().filter_map(|key| keys::command(*key)) {
        match command {
            Command::Pause => clock.paused = !clock.paused,
            Command::Step => step(&mut clock),
            Command::Faster => clock.age_per_second = (clock.age_per_second * 1.5).min(FASTEST),
            Command::Slower => clock.age_per_second = (clock.age_per_second / 1.5).max(SLOWEST),
            // Another system turns the camera.
            Command::Next | Command::Previous => {}
            Command::Repaint => commands.trigger(Repaint),
            Command::Help => help.0 = !help.0,
            Command::Close => {
                exit.write(AppExit::Success);
            }
        }
    }
}

fn look(
    keyboard: Res<ButtonInput<KeyCode>>,
    mut views: ResMut<Views>,
    mut cameras: Query<(&mut Orbit, &mut Projection)>,
) {
    let count = views.list.len();
    for key in keyboard.get_just_pressed() {
        let chosen = match keys::command(*key) {
            Some(Command::Next) => Some(views.first + 1),
            Some(Command::Previous) => Some(views.first + count.saturating_sub(1)),
            _ => DIGITS.iter().position(|digit| digit == key).filter(|digit| *digit < count),
        };
        let Some(chosen) = chosen.map(|chosen| chosen % count.max(1)) else { continue };
        let Some((_, view)) = views.list.get(chosen).cloned() else { continue };
        views.first = chosen;
        for (mut orbit, mut projection) in &mut cameras {
            *orbit = view;
            *projection = view.projection();
        }
    }
}

fn orbit(
    buttons: Res<ButtonInput<MouseButton>>,
    motion: Res<AccumulatedMouseMotion>,
    scroll: Res<AccumulatedMouseScroll>,
    mut contexts: EguiContexts,
    own: Res<OfScene>,
    mut cameras: Query<(&mut Orbit, &mut Transform)>,
) {
    // What happens over the read-out belongs to it.
    let taken = contexts.ctx_mut().is_ok_and(|context| context.egui_wants_pointer_input());
    for (mut orbit, mut transform) in &mut cameras {
        if !taken && buttons.pressed(MouseButton::Left) {
            orbit.yaw -= motion.delta.x * 0.005;
            orbit.pitch = (orbit.pitch + motion.delta.y * 0.005).clamp(-0.6, 1.4);
        }
        let right = buttons.pressed(MouseButton::Right) && !keys::right_is_taken(own.keys);
        if !taken && (right || buttons.pressed(MouseButton::Middle)) {
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
        // Never below the ground, unless that is where it looks.
        place.translation.y = place.translation.y.max(orbit.centre.y.min(0.12));
        if *transform != place {
            *transform = place;
        }
    }
}

/// A bar on which all films are drawn to an age, back and forward.
fn scrub(ui: &mut egui::Ui, clock: &mut CoatingClock, films: &mut Query<(&mut FilmClock, &FilmHistory)>) {
    let oldest = films.iter().map(|(film, history)| history.last_age(film)).fold(1.0, f64::max);
    let now = films.iter().map(|(film, _)| film.sought().unwrap_or(film.age())).fold(0.0, f64::max);
    let mut age = now;
    if ui.add(egui::Slider::new(&mut age, 0.0..=oldest).text("age")).changed() {
        clock.paused = true;
        for (mut film, _) in films {
            film.seek(age);
        }
    }
}

fn read_out(
    mut contexts: EguiContexts,
    mut clock: ResMut<CoatingClock>,
    mut commands: Commands,
    progress: Progress,
    mut past: Query<(&mut FilmClock, &FilmHistory)>,
    views: Res<Views>,
    own: Res<OfScene>,
    help: Res<Help>,
) -> Result {
    let context = contexts.ctx_mut()?;
    egui::Window::new("Weathering").default_pos([16.0, 16.0]).resizable(false).show(context, |ui| {
        ui.heading(format!("age {:.3}", progress.age()));
        let (films, wanted) = progress.films();
        ui.label(if films < wanted || wanted == 0 {
            format!("building films: {films} of {wanted}")
        } else if progress.seeking() > 0 {
            format!("films on their way to another age: {}", progress.seeking())
        } else if clock.paused {
            "paused".to_owned()
        } else {
            format!("{:.3} a second of {:.3} asked for", progress.age_per_second(), clock.age_per_second)
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
        scrub(ui, &mut clock, &mut past);
        let mut speed = clock.age_per_second;
        let slider = egui::Slider::new(&mut speed, SLOWEST..=FASTEST).logarithmic(true).text("age per second");
        if ui.add(slider).changed() {
            clock.age_per_second = speed;
        }
        if help.0 {
            ui.separator();
            egui::Grid::new("keys").num_columns(2).show(ui, |ui| {
                let names: Vec<&str> = views.list.iter().map(|(name, _)| *name).collect();
                for (key, meaning) in keys::list(&names, own.keys) {
                    ui.monospace(key);
                    ui.label(meaning);
                    ui.end_row();
                }
            });
        }
    });
    Ok(())
}
