//! Where the panels of each figure are: in rows across the line of sight, each figure far from the others.

use crate::cli::Options;
use crate::common_scene::camera::Orbit;
use crate::common_scene::headless::Shot;
use crate::common_scene::label::Pen;
use crate::common_scene::paint::{Loading, Paint};
use crate::common_scene::wall;
use crate::common_scene::window::Views;
use crate::films::Wanted;
use crate::labels;
use crate::measure::exhibit::Shape;
use crate::measure::figure::{Figure, Panel, View};
use crate::measure::figures::FIGURES;
use bevy::asset::RenderAssetUsages;
use bevy::light::NotShadowCaster;
use bevy::mesh::{Indices, PrimitiveTopology};
use bevy::prelude::*;
use bevy_coating::Shelter;
use bevy_coating::prelude::*;
use bevy_coating::remesh::{FilmResolution, FilmTarget};
use bevy_coating::surface::Surface;

/// From figure to figure, in metres.
const APART: f32 = 40.0;
/// Height of the middle of a figure over the ground, which the window's camera does not go below.
const MIDDLE: f32 = 4.0;
/// Free space around a panel, and height of what is written below it, in widths of a panel.
const GAP: f32 = 0.10;
const LINE: f32 = 0.085;
/// A long lens, so that all panels are seen alike.
const FIELD_OF_VIEW: f32 = 0.3;

pub struct StagePlugin;

impl Plugin for StagePlugin {
    fn build(&self, app: &mut App) {
        app.add_systems(Startup, build);
    }
}

/// Figures that have a picture, in the paper's order.
pub fn shown() -> Vec<&'static Figure> {
    FIGURES.into_iter().filter(|figure| figure.columns > 0).collect()
}

/// Names of the views, in the order of their keys.
pub fn names() -> Vec<&'static str> {
    shown().iter().map(|figure| figure.number).collect()
}

/// Panels that are shown: of a moving picture, those that are oldest in the end.
fn panels(figure: &Figure, options: &Options) -> Vec<Panel> {
    let mut panels = (figure.panels)();
    if options.scene.animate.is_some() {
        let last = last_age(figure);
        panels.retain(|panel| panel.age == last);
    }
    panels
}

fn last_age(figure: &Figure) -> f64 {
    (figure.panels)().iter().map(|panel| panel.age).fold(0.0, f64::max)
}

/// The line of sight of a figure: the way it is turned.
fn turn(figure: &Figure) -> Quat {
    match figure.view {
        View::Free { yaw, pitch } => Quat::from_euler(EulerRot::YXZ, yaw, -pitch, 0.0),
        View::Wall | View::Close { .. } => Quat::IDENTITY,
    }
}

/// Rows of panels across the line of sight.
struct Grid {
    middle: Vec3,
    turn: Quat,
    columns: usize,
    rows: usize,
    /// Of the largest panel, as it is seen.
    cell: Vec2,
    /// Around a panel, and below it.
    gap: f32,
    line: f32,
}

impl Grid {
    fn new(number: usize, figure: &Figure, panels: &[Panel], surfaces: &[Surface]) -> Self {
        let turn = turn(figure);
        let seen = |surface: &Surface| {
            let places = surface.positions.iter().map(|p| (turn.inverse() * *p).truncate());
            let bounds = places.map(|p| (p, p)).reduce(|(low, high), (p, _)| (low.min(p), high.max(p)));
            bounds.map_or(Vec2::ONE, |(low, high)| high - low)
        };
        let cell = surfaces.iter().map(seen).fold(Vec2::splat(0.1), Vec2::max);
        let columns = figure.columns.clamp(1, panels.len().max(1));
        let rows = panels.len().div_ceil(columns).max(1);
        let titled = panels.iter().any(|panel| !panel.exhibit.title.is_empty());
        let line = if titled { LINE * cell.x.max(0.8 * cell.y) } else { 0.0 };
        Self {
            middle: Vec3::new(APART * number as f32, MIDDLE, 0.0),
            turn,
            columns,
            rows,
            cell,
            gap: GAP * cell.x,
            line,
        }
    }

    /// Width and height, as they are seen.
    fn size(&self) -> Vec2 {
        let step = self.step();
        Vec2::new(self.columns as f32 * step.x + self.gap, self.rows as f32 * step.y + self.gap)
    }

    /// From panel to panel.
    fn step(&self) -> Vec2 {
        self.cell + Vec2::new(self.gap, self.gap + 1.6 * self.line)
    }

    /// Middle of a panel.
    fn place(&self, index: usize) -> Vec3 {
        let (column, row) = ((index % self.columns) as f32, (index / self.columns) as f32);
        let step = self.step();
        let x = (column - 0.5 * (self.columns - 1) as f32) * step.x;
        let y = (0.5 * (self.rows - 1) as f32 - row) * step.y + 0.8 * self.line;
        self.middle + self.turn * Vec3::new(x, y, 0.0)
    }

    /// Where a panel's title is written.
    fn title(&self, index: usize) -> Transform {
        let below = self.turn * Vec3::new(0.0, -0.5 * self.cell.y - self.line, 0.02);
        Transform::from_translation(self.place(index) + below).with_rotation(self.turn)
    }
}

/// The surfaces of panels; those that cannot be read are told when they are to be drawn.
fn surfaces(panels: &[Panel]) -> Vec<Surface> {
    panels.iter().map(|panel| panel.exhibit.shape.surface(panel.exhibit.seed).unwrap_or_default()).collect()
}

fn middle_of(surface: &Surface) -> Vec3 {
    let bounds = surface.positions.iter().map(|p| (*p, *p)).reduce(|(low, high), (p, _)| (low.min(p), high.max(p)));
    bounds.map_or(Vec3::ZERO, |(low, high)| 0.5 * (low + high))
}

/// The metal, with the triangles that the measured film is made of.
fn mesh_of(surface: Surface) -> Mesh {
    let indices = surface.triangles.into_iter().flatten().collect();
    let mut mesh = Mesh::new(PrimitiveTopology::TriangleList, RenderAssetUsages::default())
        .with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, surface.positions)
        .with_inserted_attribute(Mesh::ATTRIBUTE_NORMAL, surface.normals)
        .with_inserted_indices(Indices::U32(indices));
    if !surface.uvs.is_empty() {
        mesh.insert_attribute(Mesh::ATTRIBUTE_UV_0, surface.uvs);
    }
    mesh
}

fn coating(panel: &Panel, options: &Options) -> Coating {
    let resolution = match panel.exhibit.shape.target() {
        FilmTarget::Triangles(count) => FilmResolution::Triangles(count),
        FilmTarget::EdgeLength(length) => FilmResolution::EdgeLength(length),
        FilmTarget::Keep => FilmResolution::Keep,
    };
    let coating = Coating::new(panel.exhibit.settings.clone())
        .with_seed(panel.exhibit.seed)
        .with_resolution(resolution)
        .with_shelter(Shelter::Open);
    Coating { detail: options.scene.detail(panel.level), ..coating }
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
    let wall = materials.add(wall::plaster());
    let paint = materials.add(wall::paint(wall::PALE_GREEN));
    // Stains show best on a light one.
    let light = materials.add(wall::paint(Color::srgb(0.80, 0.76, 0.66)));
    let sign = materials.add(StandardMaterial {
        base_color_texture: Some(assets.load("city/street_sign.png")),
        perceptual_roughness: 0.38,
        ..default()
    });
    let pen = Pen::default();
    for (number, figure) in options.figures().into_iter().enumerate() {
        let panels = panels(figure, &options);
        let surfaces = surfaces(&panels);
        let grid = Grid::new(number, figure, &panels, &surfaces);
        if !matches!(figure.view, View::Free { .. }) {
            let board = meshes.add(Rectangle::new(16.0, 12.0));
            let behind = Transform::from_translation(grid.middle - 0.02 * Vec3::Z);
            commands.spawn((Mesh3d(board), MeshMaterial3d(wall.clone()), behind, NotShadowCaster));
        }
        for (index, (panel, surface)) in panels.into_iter().zip(surfaces).enumerate() {
            let place = Transform::from_translation(grid.place(index) - middle_of(&surface));
            let material = match (panel.exhibit.shape, panel.exhibit.name) {
                (Shape::Sign(_), _) => &sign,
                (_, "dust") => &light,
                _ => &paint,
            };
            let line = [grid.line, grid.cell.x];
            let title = &panel.exhibit.title;
            labels::write(
                &mut commands,
                &mut meshes,
                &mut materials,
                &mut images,
                &pen,
                title,
                grid.title(index),
                line,
            );
            commands.spawn((
                Name::new(format!("{} {}", figure.file, panel.exhibit.name)),
                Mesh3d(meshes.add(mesh_of(surface))),
                MeshMaterial3d(material.clone()),
                place,
                Paint(coating(&panel, &options)),
                Wanted { panel, figure: figure.file },
            ));
        }
    }
    // Loaded when all films are as they are wanted.
    (loading.props, loading.loaded) = (1, 0);
}

/// The view of a figure, for a picture or window of width to height `aspect`.
fn orbit(figure: &Figure, grid: &Grid, aspect: f32) -> Orbit {
    if let View::Close { distance, yaw, at: [x, y] } = figure.view {
        let centre = grid.middle + Vec3::new(x, y, 0.0);
        return Orbit { centre, distance, yaw, pitch: 0.25, field_of_view: 0.75 };
    }
    let (yaw, pitch) = match figure.view {
        View::Free { yaw, pitch } => (yaw, pitch),
        View::Wall | View::Close { .. } => (0.0, 0.0),
    };
    let height = grid.size().y.max(grid.size().x / aspect);
    let distance = height / 2.0 / (FIELD_OF_VIEW / 2.0).tan();
    Orbit { centre: grid.middle, distance, yaw, pitch, field_of_view: FIELD_OF_VIEW }
}

fn grids(options: &Options) -> Vec<(&'static Figure, Grid)> {
    let grid = |(number, figure): (usize, &'static Figure)| {
        let panels = panels(figure, options);
        let surfaces = surfaces(&panels);
        (figure, Grid::new(number, figure, &panels, &surfaces))
    };
    options.figures().into_iter().enumerate().map(grid).collect()
}

/// One view for each figure.
pub fn views(options: &Options, size: UVec2) -> Views {
    let aspect = size.x as f32 / size.y as f32;
    let view = |(figure, grid): &(&'static Figure, Grid)| (figure.number, orbit(figure, grid, aspect));
    Views { list: grids(options).iter().map(view).collect(), first: 0 }
}

/// One picture of each figure; or those of a moving picture.
pub fn shots(options: &Options) -> Vec<Shot> {
    let shot = |(figure, grid): &(&'static Figure, Grid), age: f64| {
        let shape = match figure.view {
            View::Close { .. } => Vec2::new(3.0, 2.0),
            View::Wall | View::Free { .. } => grid.size(),
        };
        // Even, as some encoders of moving pictures want it.
        let height = ((figure.width as f32 * shape.y / shape.x) as u32).clamp(200, figure.width) / 2 * 2;
        let size = options.scene.size.map_or(UVec2::new(figure.width, height), UVec2::from);
        let aspect = size.x as f32 / size.y as f32;
        Shot { age, orbit: orbit(figure, grid, aspect), size, file: format!("{}.png", figure.file) }
    };
    let grids = grids(options);
    if options.scene.animate.is_some() {
        let last = options.figures().first().map_or(1.0, |figure| last_age(figure));
        return grids.first().map_or_else(Vec::new, |first| {
            options.scene.ages(&[]).into_iter().map(|age| shot(first, age * last)).collect()
        });
    }
    grids.iter().map(|grid| shot(grid, 0.0)).collect()
}
