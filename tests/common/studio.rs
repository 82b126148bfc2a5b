//! A studio without a window: props in even light before a plain backdrop, and a camera that can be put anywhere.
#![allow(dead_code, reason = "each test binary uses its part")]

use std::{
    path::Path,
    sync::{Arc, Mutex},
    time::{Duration, Instant},
};

use bevy::{
    asset::AssetPlugin,
    camera::RenderTarget,
    log::{Level, LogPlugin},
    prelude::*,
    render::{
        Render, RenderApp, RenderPlugin, RenderSystems,
        render_resource::{CachedPipelineState, PipelineCache, TextureFormat},
        renderer::{RenderInstance, WgpuWrapper},
        settings::{Backends, WgpuSettings},
        view::screenshot::{Screenshot, ScreenshotCaptured},
    },
    tasks::block_on,
    window::ExitCondition,
    winit::WinitPlugin,
};
use bevy_coating::prelude::*;

/// Frames from a change of the scene to its picture: new meshes reach the screen late.
const SETTLING_FRAMES: u32 = 5;

/// How long a picture may take.
const PATIENCE: Duration = Duration::from_secs(60);

/// Vertical field of view of the camera, in radians.
pub const FIELD_OF_VIEW: f32 = 0.6;

/// The backdrop, which no prop is.
const BACKDROP: Color = Color::srgb(1.0, 0.0, 1.0);

/// Set to anything where tests must not be skipped.
const NO_SKIPPING: &str = "CI";

/// Returns whether there is an adapter to draw with, be it a software renderer. Bevy panics where there is none.
fn adapter_exists() -> bool {
    let backends = WgpuSettings::default().backends.unwrap_or(Backends::empty());
    let instance = RenderInstance(Arc::new(WgpuWrapper::new(Default::default())));
    !block_on(instance.enumerate_adapters(backends)).is_empty()
}

/// A picture: 8 bits a channel, RGBA.
pub struct Picture {
    pub width: u32,
    pub height: u32,
    pub pixels: Vec<[u8; 4]>,
}

impl Picture {
    /// Writes a PNG.
    pub fn save(&self, path: &Path) {
        let file = std::fs::File::create(path).expect("a file");
        let mut encoder = png::Encoder::new(std::io::BufWriter::new(file), self.width, self.height);
        encoder.set_color(png::ColorType::Rgba);
        let bytes: Vec<u8> = self.pixels.iter().flatten().copied().collect();
        encoder.write_header().and_then(|mut writer| writer.write_image_data(&bytes)).expect("a PNG");
    }

    /// Peak signal to noise ratio in dB between this picture and `other`, over the pixels that are not backdrop in
    /// either; and the number of these.
    pub fn psnr(&self, other: &Self) -> (f64, usize) {
        let backdrop = self.pixels[0];
        let (mut squares, mut count) = (0.0, 0usize);
        for (a, b) in self.pixels.iter().zip(&other.pixels).filter(|&(a, b)| *a != backdrop || *b != backdrop) {
            count += 1;
            squares += (0..3).map(|i| (f64::from(a[i]) - f64::from(b[i])).powi(2)).sum::<f64>();
        }
        let mean = squares / (3 * count) as f64;
        (10.0 * (255.0 * 255.0 / mean.max(1e-9)).log10(), count)
    }
}

#[derive(Resource, Default)]
struct Captured(Option<Picture>);

/// An app that draws.
pub struct Studio {
    pub app: App,
    camera: Entity,
    canvas: Handle<Image>,
    broken: Arc<Mutex<Vec<String>>>,
}

/// What is wrong with pipelines, as the render world last saw it.
#[derive(Resource)]
struct BrokenPipelines(Arc<Mutex<Vec<String>>>);

fn note_broken(cache: Res<PipelineCache>, broken: Res<BrokenPipelines>) {
    let errors = cache.pipelines().filter_map(|pipeline| match &pipeline.state {
        CachedPipelineState::Err(error) => Some(error.to_string()),
        _ => None,
    });
    *broken.0.lock().expect("unpoisoned") = errors.collect();
}

impl Studio {
    /// Opens a studio where something can be drawn. Elsewhere the test that asks is to be skipped, which is an error in
    /// CI. Pictures are `width` by `height`, assets come from `assets`.
    pub fn open(width: u32, height: u32, assets: &str) -> Option<Self> {
        Self::open_with(width, height, assets, |_| ())
    }

    /// Does the same, with what `add` adds to the app.
    pub fn open_with(width: u32, height: u32, assets: &str, add: impl FnOnce(&mut App)) -> Option<Self> {
        if adapter_exists() {
            return Some(Self::new(width, height, assets, add));
        }
        let missing = "no graphics adapter was found; install a software renderer (on Debian: mesa-vulkan-drivers)";
        let skipping = std::env::var_os(NO_SKIPPING).is_none_or(|value| value.is_empty());
        assert!(skipping, "{missing}");
        println!("skipped: {missing}");
        None
    }

    /// A studio with the coating plugin.
    fn new(width: u32, height: u32, assets: &str, add: impl FnOnce(&mut App)) -> Self {
        let mut app = App::new();
        app.add_plugins(
            DefaultPlugins
                .set(WindowPlugin { primary_window: None, exit_condition: ExitCondition::DontExit, ..default() })
                .set(RenderPlugin { synchronous_pipeline_compilation: true, ..default() })
                .set(LogPlugin { level: Level::WARN, ..default() })
                .set(AssetPlugin { file_path: assets.into(), ..default() })
                .disable::<WinitPlugin>(),
        );
        app.add_plugins(CoatingWeatheringPlugin::default()).insert_resource(CoatingBudget::UNLIMITED);
        app.world_mut().resource_mut::<CoatingClock>().paused = true;
        app.insert_resource(ClearColor(BACKDROP)).init_resource::<Captured>();
        add(&mut app);
        let broken = Arc::default();
        app.sub_app_mut(RenderApp)
            .insert_resource(BrokenPipelines(Arc::clone(&broken)))
            .add_systems(Render, note_broken.in_set(RenderSystems::Cleanup));
        app.finish();
        app.cleanup();
        let canvas = Image::new_target_texture(width, height, TextureFormat::Rgba8UnormSrgb, None);
        let canvas = app.world_mut().resource_mut::<Assets<Image>>().add(canvas);
        let lens = PerspectiveProjection { fov: FIELD_OF_VIEW, near: 0.01, ..default() };
        let camera = app
            .world_mut()
            .spawn((
                Camera3d::default(),
                Projection::Perspective(lens),
                Msaa::Off,
                RenderTarget::Image(canvas.clone().into()),
                AmbientLight { brightness: 400.0, ..default() },
                bevy::core_pipeline::tonemapping::Tonemapping::None,
            ))
            .id();
        for (from, illuminance) in [(Vec3::new(2.0, 2.0, 1.5), 4000.0), (Vec3::new(-1.0, -1.5, -1.0), 1500.0)] {
            app.world_mut().spawn((
                DirectionalLight { illuminance, shadow_maps_enabled: false, ..default() },
                Transform::from_translation(from).looking_at(Vec3::ZERO, Vec3::Y),
            ));
        }
        Self { app, camera, canvas, broken }
    }

    /// The camera's entity.
    pub fn camera_mut(&mut self) -> EntityWorldMut<'_> {
        self.app.world_mut().entity_mut(self.camera)
    }

    /// Errors of pipelines that could not be made: of shaders that do not compile.
    pub fn broken_pipelines(&self) -> Vec<String> {
        self.broken.lock().expect("unpoisoned").clone()
    }

    /// Takes a picture of what is at `target`, seen from `eye`.
    pub fn shoot(&mut self, eye: Vec3, target: Vec3) -> Picture {
        let view = Transform::from_translation(eye).looking_at(target, Vec3::Y);
        self.app.world_mut().entity_mut(self.camera).insert(view);
        for _ in 0..SETTLING_FRAMES {
            self.app.update();
        }
        let shot = Screenshot::image(self.canvas.clone());
        self.app.world_mut().spawn(shot).observe(|captured: On<ScreenshotCaptured>, mut store: ResMut<Captured>| {
            let image = &captured.image;
            let bytes = image.data.as_deref().expect("pixels");
            let pixels = bytes.as_chunks::<4>().0.to_vec();
            store.0 = Some(Picture { width: image.width(), height: image.height(), pixels });
        });
        // It comes from a pool of threads that all tests of this process share.
        let begun = Instant::now();
        loop {
            self.app.update();
            if let Some(picture) = self.app.world_mut().resource_mut::<Captured>().0.take() {
                return picture;
            }
            assert!(begun.elapsed() < PATIENCE, "the picture never came");
            std::thread::sleep(Duration::from_millis(1));
        }
    }
}
