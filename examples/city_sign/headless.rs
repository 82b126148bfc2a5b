//! Pictures without a window: one PNG for each age and view.

use crate::camera::{self, Orbit};
use crate::cli::{Options, View};
use crate::graphics;
use crate::scene::sky::Sky;
use crate::weathering::{Loading, Pace};
use bevy::app::ScheduleRunnerPlugin;
use bevy::camera::{RenderTarget, Viewport};
use bevy::log::{Level, LogPlugin};
use bevy::prelude::*;
use bevy::render::RenderPlugin;
use bevy::render::render_resource::TextureFormat;
use bevy::render::view::screenshot::{Screenshot, ScreenshotCaptured};
use bevy::window::ExitCondition;
use bevy::winit::WinitPlugin;
use std::collections::VecDeque;
use std::fs::File;
use std::io::BufWriter;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Samples along each side of a pixel.
const SUPERSAMPLING: u32 = 2;
/// Frames between showing a state and taking its picture: meshes and pipelines reach the screen late.
const SETTLING_FRAMES: u32 = 6;
/// The last of them are drawn in full, the others on a corner of the canvas.
const FULL_FRAMES: u32 = 1;

pub fn add(app: &mut App, options: &Options) {
    app.add_plugins(
        DefaultPlugins
            .set(WindowPlugin { primary_window: None, exit_condition: ExitCondition::DontExit, ..default() })
            .set(RenderPlugin { synchronous_pipeline_compilation: true, ..default() })
            .set(LogPlugin { level: Level::WARN, ..default() })
            .set(graphics::assets())
            .disable::<WinitPlugin>(),
    )
    .add_plugins(ScheduleRunnerPlugin::run_loop(Duration::ZERO))
    .insert_resource(Session::new(options))
    .add_systems(Startup, spawn_camera)
    .add_systems(Last, run);
}

/// Without an adapter nothing can be drawn: the sign is aged all the same.
pub fn without_graphics(options: &Options) -> AppExit {
    println!("No graphics adapter was found, so nothing can be drawn.");
    println!("A software renderer is enough: on Debian and Ubuntu `apt install mesa-vulkan-drivers`,");
    println!("on Fedora `dnf install mesa-vulkan-drivers`, on Arch `pacman -S vulkan-swrast`.");
    let _ = options;
    AppExit::Success
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
    shots: VecDeque<(f32, View)>,
    folder: PathBuf,
    several_views: bool,
    started: Instant,
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
        ages.sort_by(f32::total_cmp);
        ages.dedup();
        Self {
            stage: Stage::Loading,
            shots: ages.iter().flat_map(|age| views.iter().map(|view| (*age, *view))).collect(),
            folder: options.output.clone(),
            several_views: views.len() > 1,
            started: Instant::now(),
            failed: false,
        }
    }

    fn file(&self, age: f32, view: View) -> PathBuf {
        let view = if self.several_views { format!("_{view:?}").to_lowercase() } else { String::new() };
        self.folder.join(format!("city_sign{view}_age_{age:.2}.png"))
    }

    fn say(&self, what: std::fmt::Arguments) {
        println!("[{:6.1} s] {what}", self.started.elapsed().as_secs_f32());
    }
}

/// What is drawn while there is no picture to take: a software renderer needs seconds for a full frame, and
/// the ageing needs the processor. (Switching the camera off instead would leave the renderer with stale
/// material slots.)
fn corner() -> Viewport {
    Viewport { physical_size: UVec2::new(16, 9), ..default() }
}

#[derive(Component)]
struct Canvas(Handle<Image>);

fn spawn_camera(mut commands: Commands, mut images: ResMut<Assets<Image>>, sky: Res<Sky>, options: Res<Options>) {
    let (width, height) = options.size;
    let canvas = Image::new_target_texture(
        width * SUPERSAMPLING,
        height * SUPERSAMPLING,
        TextureFormat::Rgba8UnormSrgb,
        None,
    );
    let canvas = images.add(canvas);
    commands.spawn((
        camera::view(&sky, Orbit::of(options.view)),
        Camera { viewport: Some(corner()), ..default() },
        RenderTarget::Image(canvas.clone().into()),
        Canvas(canvas),
    ));
}

fn run(
    mut commands: Commands,
    mut session: ResMut<Session>,
    mut pace: ResMut<Pace>,
    loading: Res<Loading>,
    mut cameras: Query<(&mut Camera, &mut Transform, &mut Projection, &Canvas)>,
    mut exit: MessageWriter<AppExit>,
) {
    let Ok((mut camera, mut transform, mut projection, canvas)) = cameras.single_mut() else { return };
    let Some(&(age, view)) = session.shots.front() else {
        exit.write(if session.failed { AppExit::error() } else { AppExit::Success });
        return;
    };
    eprintln!("DBG {:?} {:.2}", session.stage, session.started.elapsed().as_secs_f32());
    match session.stage {
        Stage::Loading => {
            pace.goal = Some(0.0);
            if loading.finished() && pace.films.0 == pace.films.1 {
                session.say(format_args!("{} props loaded, {} films built", loading.props, pace.films.0));
                session.stage = Stage::Ageing;
            }
        }
        Stage::Ageing => {
            if pace.goal != Some(age) {
                pace.goal = Some(age);
                pace.settled = false;
            } else if pace.settled {
                let orbit = Orbit::of(view);
                *transform = orbit.transform();
                *projection = orbit.projection();
                session.say(format_args!("age {age:.2}: drawing the {} view", format!("{view:?}").to_lowercase()));
                session.stage = Stage::Settling(SETTLING_FRAMES);
            }
        }
        Stage::Settling(0) => {
            session.stage = Stage::Shooting;
            commands.spawn(Screenshot::image(canvas.0.clone())).observe(keep);
        }
        Stage::Settling(frames) => {
            if frames <= FULL_FRAMES {
                camera.viewport = None;
            }
            session.stage = Stage::Settling(frames - 1);
        }
        // The picture was drawn at the end of the frame before; only its way back takes time.
        Stage::Shooting => camera.viewport = Some(corner()),
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
