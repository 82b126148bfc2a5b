//! Pictures without a window: one PNG for each shot, or one GIF of them all.

use super::animation::Animation;
use super::camera::{self, Orbit};
use super::paint::Progress;
use super::picture::{self, SUPERSAMPLING};
use super::sky::Sky;
use super::{cli::SceneArgs, graphics};
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
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// Frames between showing a state and taking its picture: meshes and pipelines reach the screen late.
const SETTLING_FRAMES: u32 = 6;

/// A picture to take.
#[derive(Clone, Debug)]
pub struct Shot {
    /// Of the films.
    pub age: f64,
    pub orbit: Orbit,
    /// In pixels, where the command line asks for no other.
    pub size: UVec2,
    /// Name of the file.
    pub file: String,
}

/// Takes `shots`, which are in order of age, into `folder`, or into the moving picture that is asked for.
pub fn add(app: &mut App, args: &SceneArgs, folder: PathBuf, shots: Vec<Shot>) {
    app.add_plugins(
        DefaultPlugins
            .set(WindowPlugin { primary_window: None, exit_condition: ExitCondition::DontExit, ..default() })
            .set(graphics::renderer(true))
            .set(LogPlugin { level: Level::WARN, ..default() })
            .set(graphics::assets())
            .disable::<WinitPlugin>(),
    )
    .add_plugins(ScheduleRunnerPlugin::run_loop(Duration::ZERO))
    .insert_resource(Session::new(args, folder, shots))
    // Films grow as fast as they can to the age of the next picture, seconds at a time: a frame in
    // between costs a software renderer a second.
    .add_systems(PreStartup, |mut clock: ResMut<CoatingClock>| {
        clock.age_per_second = 1e3;
        clock.target_age = Some(0.0);
    })
    .insert_resource(CoatingBudget { max_time: Duration::from_secs(4), max_steps: 1_000, ..CoatingBudget::default() })
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
    /// Still to take, in order.
    shots: VecDeque<Shot>,
    folder: PathBuf,
    /// The moving picture so far and its file, if there is to be one.
    animation: Option<(Animation, PathBuf)>,
    started: Instant,
    /// Last tenth of age told.
    told: u32,
    failed: bool,
}

impl Session {
    fn new(args: &SceneArgs, folder: PathBuf, shots: Vec<Shot>) -> Self {
        let sized = |shot: Shot| Shot { size: args.size.map_or(shot.size, UVec2::from), ..shot };
        let mut shots: Vec<Shot> = shots.into_iter().map(sized).collect();
        if let Some(orbit) = args.camera() {
            shots.dedup_by_key(|shot| shot.age);
            shots.iter_mut().for_each(|shot| shot.orbit = orbit);
        }
        let animation = args.animate.clone().zip(shots.first().map(|shot| shot.size)).map(|(file, size)| {
            // The first view of each age.
            shots.dedup_by_key(|shot| shot.age);
            (Animation::new(size.x as u16, size.y as u16), file)
        });
        Self {
            stage: Stage::Loading,
            shots: shots.into(),
            folder,
            animation,
            started: Instant::now(),
            told: 0,
            failed: false,
        }
    }

    /// Tells of every tenth that was passed on the way to the next picture.
    fn say_age(&mut self, age: f64) {
        let tenth = (age * 10.0) as u32;
        if tenth > self.told {
            self.told = tenth;
            self.say(format_args!("age {age:.2}"));
        }
    }

    /// Writes a picture, or adds it to the moving picture, which is written after its last frame. Returns the file that
    /// was written.
    fn save(&mut self, image: &Image, shot: &Shot) -> Result<Option<PathBuf>, Box<dyn std::error::Error>> {
        let pixels = picture::pixels(image, shot.size)?;
        let Some((animation, file)) = &mut self.animation else {
            let file = self.folder.join(&shot.file);
            picture::write(&pixels, shot.size, &file)?;
            return Ok(Some(file));
        };
        animation.push(&pixels);
        if !self.shots.is_empty() {
            return Ok(None);
        }
        if let Some(folder) = file.parent() {
            std::fs::create_dir_all(folder)?;
        }
        std::fs::write(&*file, animation.encode()?)?;
        Ok(Some(file.clone()))
    }

    fn say(&self, what: std::fmt::Arguments) {
        println!("[{:6.1} s] {what}", self.started.elapsed().as_secs_f32());
    }
}

/// What is drawn while there is no picture to take: a software renderer needs seconds for a full frame, and
/// the ageing needs the processor. (Switching the camera off instead would leave the renderer with stale
/// material slots.)
///
/// Of the picture's proportions, so that the same things are in view.
fn corner(size: UVec2) -> Viewport {
    Viewport { physical_size: (size * SUPERSAMPLING / 40).max(UVec2::ONE), ..default() }
}

/// What all pictures are drawn on, each from its upper left corner.
#[derive(Component)]
struct Canvas(Handle<Image>);

fn spawn_camera(mut commands: Commands, mut images: ResMut<Assets<Image>>, sky: Res<Sky>, session: Res<Session>) {
    let Some(first) = session.shots.front() else { return };
    let largest = session.shots.iter().fold(UVec2::ONE, |largest, shot| largest.max(shot.size)) * SUPERSAMPLING;
    let canvas = Image::new_target_texture(largest.x, largest.y, TextureFormat::Rgba8UnormSrgb, None);
    let canvas = images.add(canvas);
    commands.spawn((
        camera::view(&sky, first.orbit),
        Camera { viewport: Some(corner(first.size)), ..default() },
        RenderTarget::Image(canvas.clone().into()),
        Canvas(canvas),
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
    let Some(shot) = session.shots.front().cloned() else {
        exit.write(if session.failed { AppExit::error() } else { AppExit::Success });
        return;
    };
    let Ok((mut camera, mut transform, mut projection, canvas)) = cameras.single_mut() else { return };
    match session.stage {
        Stage::Loading => {
            if progress.is_ready() {
                session.say(format_args!("scene loaded, {} films built", progress.films().0));
                session.stage = Stage::Ageing;
            }
        }
        Stage::Ageing => {
            clock.target_age = Some(shot.age);
            if progress.has_reached(shot.age) {
                *transform = shot.orbit.transform();
                *projection = shot.orbit.projection();
                camera.viewport = Some(corner(shot.size));
                session.told = (shot.age * 10.0) as u32;
                session.say(format_args!("age {:.2}: drawing", shot.age));
                session.stage = Stage::Settling(SETTLING_FRAMES);
            } else {
                session.say_age(progress.age());
            }
        }
        Stage::Settling(0) => {
            session.stage = Stage::Shooting;
            camera.viewport = Some(Viewport { physical_size: shot.size * SUPERSAMPLING, ..default() });
            commands.spawn(Screenshot::image(canvas.0.clone())).observe(keep);
        }
        Stage::Settling(frames) => session.stage = Stage::Settling(frames - 1),
        // The picture was drawn at the end of the frame before; only its way back takes time.
        Stage::Shooting => camera.viewport = Some(corner(shot.size)),
    }
}

fn keep(captured: On<ScreenshotCaptured>, mut session: ResMut<Session>) {
    let Some(shot) = session.shots.pop_front() else { return };
    match session.save(&captured.image, &shot) {
        Ok(Some(file)) => {
            let full = std::fs::canonicalize(&file).unwrap_or(file);
            session.say(format_args!("{}", full.display()));
        }
        Ok(None) => {}
        Err(error) => {
            eprintln!("{}: {error}", shot.file);
            session.failed = true;
        }
    }
    session.stage = Stage::Ageing;
}
