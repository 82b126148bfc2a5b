//! What coated props cost the graphics card, pass by pass, beside the same props without coating.
//!
//! Pictures of 1920 by 1080 pixels are drawn into an image, with four samples a pixel and a light that casts shadows.
//! Two walls cover all of it: `close` is one plate of 10,000 triangles, where the cost of a pixel decides, `many` are
//! 144 plates of 3,042, where triangles and draws do. Half of the paint is off. `ageing` films take a step before every
//! picture, so that new positions are sent each time; `uncoated` plates have the prop's own material, but the number of
//! triangles of the film.
//!
//! Times are the card's own, medians of many pictures; where it tells none (Metal, browsers), only the last column is
//! filled: the time from one frame to the next, in which this profile's engine, which is not optimised, has a large
//! part. On a software renderer the card is the processor.
//!
//! Run with `cargo bench --profile dev --bench frames`. `--test` draws each once, small.

#[path = "../tests/common/mod.rs"]
mod common;
#[path = "../tests/common/studio.rs"]
mod studio;

use std::{
    collections::BTreeMap,
    time::{Duration, Instant},
};

use bevy::{
    diagnostic::DiagnosticsStore,
    light::{CascadeShadowConfigBuilder, DirectionalLightShadowMap},
    prelude::*,
    render::{diagnostic::RenderDiagnosticsPlugin, renderer::RenderAdapterInfo},
};
use bevy_coating::{appearance::Detail, prelude::*};
use studio::Studio;

const SIZE: (u32, u32) = (1920, 1080);
/// Pictures before the first that is measured: pipelines are made, buffers grow.
const WARM_UP: u32 = 20;
const PICTURES: u32 = 120;
const AGE: f64 = 0.7;
/// Pixels along a side of a shadow map.
const SHADOWS: usize = 2048;
/// How long films may take to be ready.
const PATIENCE: Duration = Duration::from_secs(300);

/// A wall of plates that covers the picture.
#[derive(Clone, Copy, PartialEq)]
struct Wall {
    name: &'static str,
    columns: u32,
    rows: u32,
    /// Squares along a side of a plate; each has two triangles.
    squares: u32,
}

const CLOSE: Wall = Wall { name: "close", columns: 1, rows: 1, squares: 71 };
const MANY: Wall = Wall { name: "many", columns: 16, rows: 9, squares: 39 };

/// What is on the plates.
#[derive(Clone, Copy, PartialEq)]
enum Paint {
    Uncoated,
    Coated { stains: StainDisplay, level: u32, ageing: bool },
}

impl Paint {
    fn name(self) -> String {
        match self {
            Self::Uncoated => "uncoated".into(),
            Self::Coated { stains, level, ageing } => {
                format!("{stains:?}, level {level}{}", if ageing { ", ageing" } else { "" })
            }
        }
    }
}

/// Medians of one wall, in milliseconds.
struct Cost {
    /// Each pass of the card.
    passes: BTreeMap<String, f64>,
    /// From one frame to the next.
    frame: f64,
    triangles: usize,
}

fn main() {
    let test = std::env::args().any(|argument| argument == "--test");
    let stained = |level| Paint::Coated { stains: StainDisplay::Material, level, ageing: false };
    let ageing = |level| Paint::Coated { stains: StainDisplay::Material, level, ageing: true };
    let plain = |stains| Paint::Coated { stains, level: 0, ageing: false };
    let all = [
        Paint::Uncoated,
        plain(StainDisplay::None),
        plain(StainDisplay::VertexColor),
        stained(0),
        stained(1),
        stained(2),
        ageing(0),
        ageing(2),
    ];
    let small = Wall { squares: 6, columns: 2, rows: 1, ..MANY };
    let (walls, paints) =
        if test { (&[small][..], &[Paint::Uncoated, ageing(2)][..]) } else { (&[CLOSE, MANY][..], &all[..]) };
    for &wall in walls {
        for &paint in paints {
            let Some(cost) = measure(wall, paint, test) else { return };
            let name = paint.name();
            println!("\n{:<6} {name:<28} {:>9} triangles, frame {:8.3} ms", wall.name, cost.triangles, cost.frame);
            for (pass, time) in &cost.passes {
                println!("    {pass:<40} {time:8.3} ms");
            }
            let sum: f64 = cost.passes.values().sum();
            println!("    {:<40} {sum:8.3} ms", "all passes");
        }
    }
}

/// Draws `wall` many times. `None` where nothing can be drawn.
fn measure(wall: Wall, paint: Paint, test: bool) -> Option<Cost> {
    let (width, height) = if test { (64, 36) } else { SIZE };
    let mut studio = Studio::open_with(width, height, "assets", |app| {
        app.add_plugins(RenderDiagnosticsPlugin);
    })?;
    build(&mut studio, wall, paint);
    let app = &mut studio.app;
    let (warm_up, pictures) = if test { (4, 8) } else { (WARM_UP, PICTURES) };
    let ageing = matches!(paint, Paint::Coated { ageing: true, .. });
    let mut passes: BTreeMap<String, Vec<f64>> = BTreeMap::new();
    let mut frames = Vec::new();
    for picture in 0..warm_up + pictures {
        if ageing {
            app.world_mut().resource_mut::<CoatingClock>().request_steps(1);
        }
        let begun = Instant::now();
        app.update();
        if picture < warm_up {
            continue;
        }
        frames.push(1e3 * begun.elapsed().as_secs_f64());
        for diagnostic in app.world().resource::<DiagnosticsStore>().iter() {
            let path = diagnostic.path().as_str();
            let pass = path.strip_prefix("render/").and_then(|path| path.strip_suffix("/elapsed_gpu"));
            if let (Some(pass), Some(time)) = (pass, diagnostic.value()) {
                passes.entry(pass.into()).or_default().push(time);
            }
        }
    }
    if paint == Paint::Uncoated {
        let adapter = app.world().resource::<RenderAdapterInfo>();
        println!("{} ({:?}, {}), {width} x {height}", adapter.name, adapter.backend, adapter.driver_info);
    }
    let passes = passes.into_iter().map(|(pass, times)| (pass, median(times))).collect();
    Some(Cost { passes, frame: median(frames), triangles: triangles(app) })
}

/// Puts the wall into the picture and waits for its films.
fn build(studio: &mut Studio, wall: Wall, paint: Paint) {
    let app = &mut studio.app;
    let mesh = common::add_mesh(app, common::plate(wall.squares));
    let color = Color::srgb(0.2, 0.35, 0.4);
    let material = StandardMaterial { base_color: color, perceptual_roughness: 0.5, ..default() };
    let material = app.world_mut().resource_mut::<Assets<StandardMaterial>>().add(material);
    let count = wall.columns * wall.rows;
    for index in 0..count {
        let place = Vec3::new((index % wall.columns) as f32, (index / wall.columns) as f32, 0.0);
        let plate = (Mesh3d(mesh.clone()), MeshMaterial3d(material.clone()), Transform::from_translation(place));
        let mut plate = app.world_mut().spawn(plate);
        if let Paint::Coated { stains, level, .. } = paint {
            let coating = Coating::new(Preset::Default)
                .with_resolution(FilmResolution::Keep)
                .with_seed(u64::from(index))
                .with_start_age(AGE)
                .with_stain_display(stains)
                .with_detail(Detail { level, pixels: 0.0, ..default() });
            plate.insert(coating);
        }
    }
    // A light of a street: its shadow maps cover the wall.
    app.insert_resource(DirectionalLightShadowMap { size: SHADOWS });
    let middle = Vec3::new(0.5 * wall.columns as f32, 0.5 * wall.rows as f32, 0.0);
    app.world_mut().spawn((
        DirectionalLight { illuminance: 4000.0, shadow_maps_enabled: true, ..default() },
        CascadeShadowConfigBuilder { maximum_distance: 40.0, ..default() }.build(),
        Transform::from_translation(middle + Vec3::new(2.0, 3.0, 4.0)).looking_at(middle, Vec3::Y),
    ));
    // The whole width of the wall, and of its height what fits.
    let distance = 0.5 * wall.columns as f32 * 9.0 / 16.0 / ops::tan(0.5 * studio::FIELD_OF_VIEW);
    let view = Transform::from_translation(middle + distance * Vec3::Z).looking_at(middle, Vec3::Y);
    studio.camera_mut().insert((view, Msaa::Sample4));
    if paint != Paint::Uncoated {
        let begun = Instant::now();
        while studio.app.world().resource::<CoatingStatus>().films < count as usize {
            studio.app.update();
            assert!(begun.elapsed() < PATIENCE, "the films were not ready in time");
        }
    }
}

/// Returns the number of triangles of all meshes that are drawn.
fn triangles(app: &mut App) -> usize {
    let mut drawn = app.world_mut().query::<&Mesh3d>();
    let meshes = app.world().resource::<Assets<Mesh>>();
    let corners = |mesh: &Mesh3d| meshes.get(&mesh.0).and_then(Mesh::indices).map_or(0, |indices| indices.len());
    drawn.iter(app.world()).map(corners).sum::<usize>() / 3
}

fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(f64::NAN)
}
