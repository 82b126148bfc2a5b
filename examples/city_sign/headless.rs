//! Pictures without a window: one PNG for each age and view.

use crate::camera::{self, Orbit};
use crate::cli::{Options, View};
use crate::graphics;
use crate::scene::sky::Sky;
use crate::weathering::Progress;
use bevy::app::ScheduleRunnerPlugin;
use bevy::camera::{RenderTarget, Viewport};
use bevy::log::{Level, LogPlugin};
use bevy::prelude::*;
use bevy::render::render_resource::TextureFormat;
use bevy::render::view::screenshot::{Screenshot, ScreenshotCaptured};
use bevy::window::ExitCondition;
use bevy::winit::WinitPlugin;
use bevy_coating::prelude::*;
use std::collections::VecDeque;
use std::fs::File;
use std::io::BufWriter;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Samples along each side of a pixel.
const SUPERSAMPLING: u32 = 2;
/// Frames between showing a state and taking its picture: meshes and pipelines reach the screen late.
const SETTLING_FRAMES: u32 = 6;

pub fn add(app: &mut App, options: &Options) {
    app.add_plugins(
        DefaultPlugins
            .set(WindowPlugin { primary_window: None, exit_condition: ExitCondition::DontExit, ..default() })
            .set(graphics::renderer(true))
            .set(LogPlugin { level: Level::WARN, ..default() })
            .set(graphics::assets())
            .disable::<WinitPlugin>(),
    )
    .add_plugins(ScheduleRunnerPlugin::run_loop(Duration::ZERO))
    .insert_resource(Session::new(options))
    // Films grow as fast as they can to the age of the next picture, seconds at a time: a frame in
    // between costs a software renderer a second.
    .add_systems(PreStartup, |mut clock: ResMut<CoatingClock>| {
        clock.age_per_second = 1e3;
        clock.target_age = Some(0.0);
    })
    .insert_resource(CoatingBudget { max_time: Duration::from_secs(4), max_steps: 1_000 })
    .add_systems(Startup, spawn_camera)
    .add_systems(Last, run);
}

#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Stage {
    Loading,
    Ageing,
    /// Frames still to wait.
    Settling(u32),
    Shooting,
}

#[derive(Resource)]
struct Session {
    stage: Stage,
    /// Age and view of the pictures still to take, in order.
    shots: VecDeque<(f64, View)>,
    folder: PathBuf,
    several_views: bool,
    started: Instant,
    /// Last tenth of age told.
    told: u32,
    failed: bool,
}

impl Session {
    fn new(options: &Options) -> Self {
        let views: &[View] = match options.view {
            View::All => &[View::Sign, View::Close, View::Street],
            View::Sign => &[View::Sign],
            View::Close => &[View::Close],
            View::Street => &[View::Street],
        };
        // Paint does not grow back: the pictures are taken in order of age.
        let mut ages = options.ages.clone();
        ages.sort_by(f64::total_cmp);
        ages.dedup();
        Self {
            stage: Stage::Loading,
            shots: ages.iter().flat_map(|age| views.iter().map(|view| (*age, *view))).collect(),
            folder: options.output.clone(),
            several_views: views.len() > 1,
            started: Instant::now(),
            told: 0,
            failed: false,
        }
    }

    fn file(&self, age: f64, view: View) -> PathBuf {
        let view = if self.several_views { format!("_{view:?}").to_lowercase() } else { String::new() };
        self.folder.join(format!("city_sign{view}_age_{age:.2}.png"))
    }

    /// Tells of every tenth that was passed on the way to the next picture.
    fn say_age(&mut self, age: f64) {
        let tenth = (age * 10.0) as u32;
        if tenth > self.told {
            self.told = tenth;
            self.say(format_args!("age {age:.2}"));
        }
    }

    fn say(&self, what: std::fmt::Arguments) {
        println!("[{:6.1} s] {what}", self.started.elapsed().as_secs_f32());
    }
}

/// What is drawn while there is no picture to take: a software renderer needs seconds for a full frame, and
/// the ageing needs the processor. (Switching the camera off instead would leave the renderer with stale
/// material slots.)
///
/// Of the canvas's proportions, so that the same things are in view.
fn corner(canvas: &UVec2) -> Viewport {
    Viewport { physical_size: (*canvas / 40).max(UVec2::ONE), ..default() }
}

/// The picture and its size.
#[derive(Component)]
struct Canvas(Handle<Image>, UVec2);

fn spawn_camera(mut commands: Commands, mut images: ResMut<Assets<Image>>, sky: Res<Sky>, options: Res<Options>) {
    let size = UVec2::from(options.size) * SUPERSAMPLING;
    let canvas = Image::new_target_texture(size.x, size.y, TextureFormat::Rgba8UnormSrgb, None);
    let canvas = images.add(canvas);
    commands.spawn((
        camera::view(&sky, Orbit::of(options.view)),
        Camera { viewport: Some(corner(&size)), ..default() },
        RenderTarget::Image(canvas.clone().into()),
        Canvas(canvas, size),
    ));
}

fn run(
    mut commands: Commands,
    mut session: ResMut<Session>,
    mut clock: ResMut<CoatingClock>,
    progress: Progress,
    mut cameras: Query<(&mut Camera, &mut Transform, &mut Projection, &Canvas)>,
    mut exit: MessageWriter<AppExit>,
) {
    let Ok((mut camera, mut transform, mut projection, canvas)) = cameras.single_mut() else { return };
    let Some(&(age, view)) = session.shots.front() else {
        exit.write(if session.failed { AppExit::error() } else { AppExit::Success });
        return;
    };
    match session.stage {
        Stage::Loading => {
            if progress.is_ready() {
                session.say(format_args!("scene loaded, {} films built", progress.films().0));
                session.stage = Stage::Ageing;
            }
        }
        Stage::Ageing => {
            clock.target_age = Some(age);
            if progress.has_reached(age) {
                let orbit = Orbit::of(view);
                *transform = orbit.transform();
                *projection = orbit.projection();
                session.told = (age * 10.0) as u32;
                session.say(format_args!("age {age:.2}: drawing"));
                session.stage = Stage::Settling(SETTLING_FRAMES);
            } else {
                session.say_age(progress.age());
            }
        }
        Stage::Settling(0) => {
            session.stage = Stage::Shooting;
            camera.viewport = None;
            commands.spawn(Screenshot::image(canvas.0.clone())).observe(keep);
        }
        Stage::Settling(frames) => session.stage = Stage::Settling(frames - 1),
        // The picture was drawn at the end of the frame before; only its way back takes time.
        Stage::Shooting => camera.viewport = Some(corner(&canvas.1)),
    }
}

fn keep(shot: On<ScreenshotCaptured>, mut session: ResMut<Session>) {
    let Some((age, view)) = session.shots.pop_front() else { return };
    let file = session.file(age, view);
    match write(&shot.image, &file) {
        Ok(()) => {
            let full = std::fs::canonicalize(&file).unwrap_or(file);
            session.say(format_args!("{}", full.display()));
        }
        Err(error) => {
            eprintln!("{}: {error}", file.display());
            session.failed = true;
        }
    }
    session.stage = Stage::Ageing;
}

/// Averages the samples of each pixel as light, and writes the picture.
fn write(image: &Image, file: &Path) -> Result<(), Box<dyn std::error::Error>> {
    let (width, height) = (image.width() / SUPERSAMPLING, image.height() / SUPERSAMPLING);
    let data = image.data.as_ref().ok_or("the picture came back without data")?;
    let linear: Vec<f32> = (0..=255u8).map(|c| Srgba::gamma_function(f32::from(c) / 255.0)).collect();
    let samples = (SUPERSAMPLING * SUPERSAMPLING) as f32;
    let mut pixels = Vec::with_capacity((width * height * 3) as usize);
    for y in 0..height {
        for x in 0..width {
            for channel in 0..3 {
                let sample = |i: u32| {
                    let (sx, sy) = (x * SUPERSAMPLING + i % SUPERSAMPLING, y * SUPERSAMPLING + i / SUPERSAMPLING);
                    let at = (sy * image.width() + sx) as usize * 4 + channel;
                    data.get(at).map_or(0.0, |c| linear[usize::from(*c)])
                };
                let mean = (0..SUPERSAMPLING * SUPERSAMPLING).map(sample).sum::<f32>() / samples;
                pixels.push((Srgba::gamma_function_inverse(mean) * 255.0 + 0.5) as u8);
            }
        }
    }
    if let Some(folder) = file.parent() {
        std::fs::create_dir_all(folder)?;
    }
    let mut encoder = png::Encoder::new(BufWriter::new(File::create(file)?), width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.write_header()?.write_image_data(&pixels)?;
    Ok(())
}
