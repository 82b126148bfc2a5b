//! Where the pieces stand: for each theme a flight of steps with a row on each, its name on the step's front.

use crate::cli::Options;
use crate::common_scene::camera::Orbit;
use crate::common_scene::headless::Shot;
use crate::common_scene::label::Pen;
use crate::common_scene::paint::{Loading, Paint};
use crate::common_scene::window::Views;
use crate::pieces::Piece;
use crate::themes::{Row, Theme};
use crate::weather::{self, InWind};
use bevy::light::NotShadowCaster;
use bevy::prelude::*;
use bevy_coating::prelude::*;

/// From piece to piece.
pub const COLUMN: f32 = 1.2;
/// From step to step, upwards and backwards.
const RISE: f32 = 1.14;
const TREAD: f32 = 1.0;
/// Height of the lowest step.
const BASE: f32 = 0.32;
const WIDTH: f32 = 4.0 * COLUMN + 0.3;
/// Of a piece.
const TALL: f32 = 0.95;
/// From stage to stage.
const APART: f32 = 40.0;
const PIXELS_PER_METRE: f32 = 270.0;

pub struct StagePlugin;

impl Plugin for StagePlugin {
    fn build(&self, app: &mut App) {
        app.add_systems(Startup, build);
    }
}

/// Top of the step, its middle.
fn place(theme: usize, step: usize) -> Vec3 {
    Vec3::new(APART * theme as f32, BASE + RISE * step as f32, -TREAD * step as f32)
}

fn build(
    mut commands: Commands,
    mut meshes: ResMut<Assets<Mesh>>,
    mut materials: ResMut<Assets<StandardMaterial>>,
    mut images: ResMut<Assets<Image>>,
    mut loading: ResMut<Loading>,
    assets: Res<AssetServer>,
    options: Res<Options>,
) {
    let stone = materials.add(StandardMaterial {
        base_color: Color::linear_rgb(0.36, 0.36, 0.355),
        perceptual_roughness: 0.9,
        reflectance: 0.3,
        ..default()
    });
    let sheet = materials.add(StandardMaterial {
        base_color: Color::linear_rgb(0.16, 0.17, 0.18),
        perceptual_roughness: 0.6,
        ..default()
    });
    let pen = Pen::default();
    let themes = options.themes();
    let rate = weather::rate(themes.iter().flat_map(|theme| theme.rows(&options)).map(|row| row.windy));
    for (index, theme) in themes.iter().enumerate() {
        let rows = theme.rows(&options);
        let paint =
            materials.add(StandardMaterial { base_color: theme.paint(), perceptual_roughness: 0.45, ..default() });
        let floor = Transform::from_translation(place(index, 0).with_y(0.0));
        let plain = meshes.add(Plane3d::default().mesh().size(APART, APART));
        commands.spawn((Mesh3d(plain), MeshMaterial3d(stone.clone()), floor, NotShadowCaster));
        for (step, row) in rows.iter().rev().enumerate() {
            let top = place(index, step);
            let block = meshes.add(Cuboid::new(WIDTH, top.y, TREAD));
            let middle = Transform::from_translation(top.with_y(top.y / 2.0));
            commands.spawn((Mesh3d(block), MeshMaterial3d(stone.clone()), middle));
            if row.roof {
                shelter(&mut commands, &mut meshes, &sheet, top);
            }
            for (text, height, right, grey) in [(row.title, 0.17, false, 0.02), (&*row.detail, 0.115, true, 0.06)] {
                let label = pen.write(text, &mut images);
                let ink = materials.add(StandardMaterial {
                    base_color: Color::linear_rgb(grey, grey, grey * 1.1),
                    base_color_texture: Some(label.image),
                    alpha_mode: AlphaMode::Blend,
                    perceptual_roughness: 0.9,
                    ..default()
                });
                let width = height * label.aspect;
                let edge = WIDTH / 2.0 - 0.16 - width / 2.0;
                let at = Vec3::new(if right { edge } else { -edge }, -0.155, TREAD / 2.0 + 0.002);
                let board = meshes.add(Rectangle::new(width, height));
                let at = Transform::from_translation(top + at);
                commands.spawn((Mesh3d(board), MeshMaterial3d(ink), at, NotShadowCaster));
            }
            for (column, piece) in Piece::ALL.into_iter().enumerate() {
                let mesh = piece.mesh(&mut meshes, &assets);
                if piece == Piece::Hydrant {
                    loading.files.push(mesh.clone().untyped());
                }
                let at = top + Vec3::X * COLUMN * (column as f32 - 1.5);
                let coating = Coating::new(row.settings.clone())
                    // The same cracks in every row, so that rows differ by what they show alone.
                    .with_seed(options.scene.seed.wrapping_add(column as u64))
                    .with_triangles(options.triangles)
                    .with_rate(rate);
                commands.spawn((
                    Name::new(format!("{} {}", row.name, piece.name())),
                    Mesh3d(mesh),
                    MeshMaterial3d(paint.clone()),
                    piece.stance().with_translation(at),
                    Paint(coating),
                    InWind(row.windy),
                ));
            }
        }
    }
    (loading.props, loading.loaded) = (1, 1);
}

/// A sheet of metal over the step whose top is at `top`, on posts, and bent down on the side where the rain comes from.
fn shelter(commands: &mut Commands, meshes: &mut Assets<Mesh>, sheet: &Handle<StandardMaterial>, top: Vec3) {
    let mut slab = |size: Vec3, at: Vec3| {
        let mesh = meshes.add(Cuboid::from_size(size));
        let at = Transform::from_translation(top + at);
        commands.spawn((Mesh3d(mesh), MeshMaterial3d(sheet.clone()), at, RainShelter));
    };
    let (height, depth) = (TALL + 0.2, TREAD + 0.5);
    slab(Vec3::new(WIDTH, 0.03, depth), Vec3::new(0.0, height, 0.1));
    for x in [-1.0, 1.0] {
        for z in [-0.42, 0.42] {
            slab(Vec3::new(0.04, height, 0.04), Vec3::new(x * (WIDTH / 2.0 - 0.04), height / 2.0, z));
        }
    }
    slab(Vec3::new(0.02, height * 0.75, depth), Vec3::new(-WIDTH / 2.0, height * 0.625, 0.1));
}

/// Width and height of a theme's picture, in metres, and where its middle is.
fn frame(theme: usize, rows: &[Row]) -> (Vec2, Vec3) {
    let last = place(theme, rows.len() - 1);
    let roof = if rows.iter().any(|row| row.roof) { 0.25 } else { 0.0 };
    // Seen from a little above, depth counts as height.
    let (sin, cos) = PITCH.sin_cos();
    let top = (last.y + TALL + roof - 0.06) * cos - (last.z - TREAD / 2.0) * sin;
    let bottom = -0.12 * cos - TREAD / 2.0 * sin;
    let across = (top + bottom) / 2.0;
    (Vec2::new(WIDTH + 0.3, top - bottom), Vec3::new(last.x, across / cos, 0.0))
}

const PITCH: f32 = 0.24;
/// A long lens, so that all rows are about as large.
const FIELD_OF_VIEW: f32 = 0.32;

/// The view of a theme, for pictures of width to height `aspect` (its own if `None`).
fn orbit(theme: usize, rows: &[Row], aspect: Option<f32>) -> Orbit {
    let (size, centre) = frame(theme, rows);
    let height = aspect.map_or(size.y, |aspect| size.y.max(size.x / aspect));
    let distance = height / 2.0 / (FIELD_OF_VIEW / 2.0).tan();
    Orbit { centre, distance, yaw: 0.0, pitch: PITCH, field_of_view: FIELD_OF_VIEW }
}

/// One for each theme.
pub fn views(options: &Options, size: UVec2) -> Views {
    let aspect = Some(size.x as f32 / size.y as f32);
    let themes = options.themes();
    let view = |(index, theme): (usize, &Theme)| (theme.name(), orbit(index, &theme.rows(options), aspect));
    Views { list: themes.iter().enumerate().map(view).collect(), first: 0 }
}

/// One for each age and theme.
pub fn shots(options: &Options) -> Vec<Shot> {
    let ages = options.scene.ages(&options.ages);
    let themes = options.themes();
    let shot = |age: f64, index: usize, theme: Theme| {
        let rows = theme.rows(options);
        let size = (frame(index, &rows).0 * PIXELS_PER_METRE / 2.0).as_uvec2() * 2;
        let size = options.scene.size.map_or(size, UVec2::from);
        let aspect = Some(size.x as f32 / size.y as f32);
        let when = if ages.len() > 1 { format!("_age_{age:.2}") } else { String::new() };
        let file = format!("stains_{}{when}.png", theme.name());
        Shot { age, orbit: orbit(index, &rows, aspect), size, file }
    };
    let all = ages.iter().flat_map(|age| themes.iter().enumerate().map(move |(index, theme)| (*age, index, *theme)));
    all.map(|(age, index, theme)| shot(age, index, theme)).collect()
}
