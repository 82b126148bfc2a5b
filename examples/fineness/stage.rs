//! The wall that the plates hang on, and what the camera looks at.

use crate::cli::Options;
use crate::common_scene::camera::Orbit;
use crate::common_scene::headless::Shot;
use crate::common_scene::label::Pen;
use crate::common_scene::paint::{Loading, Paint};
use crate::common_scene::wall;
use crate::common_scene::window::Views;
use crate::plates::{Plate, plates};
use bevy::light::NotShadowCaster;
use bevy::prelude::*;

/// From plate to plate.
const COLUMN: f32 = 1.16;
const ROW: f32 = 1.24;
/// Width and height of the picture, in metres.
const FRAME: Vec2 = Vec2::new(3.0 * COLUMN, 2.0 * ROW);
/// Of a picture or the window.
pub const SIZE: UVec2 = UVec2::new(1680, 1200);
/// Height of a line.
const LINE: f32 = 0.078;

pub struct StagePlugin;

impl Plugin for StagePlugin {
    fn build(&self, app: &mut App) {
        app.add_systems(Startup, build);
    }
}

/// Middle of a plate.
fn place(plate: &Plate) -> Vec3 {
    let (x, y) = (plate.column as f32 - 1.0, 0.5 - plate.row as f32);
    // Lower edges have room for two lines of writing.
    Vec3::new(x * COLUMN, y * ROW + LINE, 0.0)
}

fn build(
    mut commands: Commands,
    mut meshes: ResMut<Assets<Mesh>>,
    mut materials: ResMut<Assets<StandardMaterial>>,
    mut images: ResMut<Assets<Image>>,
    mut loading: ResMut<Loading>,
    options: Res<Options>,
) {
    let wall = materials.add(wall::plaster());
    let board = meshes.add(Rectangle::new(30.0, 30.0));
    let behind = Transform::from_xyz(0.0, 0.0, -0.02);
    commands.spawn((Mesh3d(board), MeshMaterial3d(wall), behind, NotShadowCaster));
    let paint = materials.add(wall::paint(wall::PALE_GREEN));
    let pen = Pen::default();
    for plate in plates(&options) {
        let middle = place(&plate);
        match plate.mesh(&options) {
            Ok(mesh) => {
                commands.spawn((
                    Name::new(plate.name),
                    Mesh3d(meshes.add(mesh)),
                    MeshMaterial3d(paint.clone()),
                    Transform::from_translation(middle),
                    Paint(plate.coating(&options)),
                ));
            }
            Err(error) => error!("{}: {error}", plate.name),
        }
        for (line, text) in [&plate.title, &plate.detail].into_iter().enumerate() {
            let label = pen.write(text, &mut images);
            let width = LINE * label.aspect;
            let at = Vec3::new(width / 2.0 - 0.5, -0.5 - LINE * (0.7 + line as f32), -0.018);
            let sheet = wall::sheet(label, LINE, &mut meshes, &mut materials);
            commands.spawn((sheet, Transform::from_translation(middle + at)));
        }
    }
    (loading.props, loading.loaded) = (1, 1);
}

/// A long lens, so that all plates are seen alike.
const FIELD_OF_VIEW: f32 = 0.3;

/// Names of the views, in the order of their keys.
pub const NAMES: [&str; 3] = ["all", "coarse", "fine"];

fn orbit(centre: Vec2, height: f32) -> Orbit {
    let distance = height / 2.0 / (FIELD_OF_VIEW / 2.0).tan();
    Orbit { centre: centre.extend(0.0), distance, yaw: 0.0, pitch: 0.0, field_of_view: FIELD_OF_VIEW }
}

/// All plates; and the coarse pair and the fine pair, the paper's rules above and rules by the grain below.
pub fn views() -> Views {
    let pair = |x: f32| orbit(Vec2::new(x, 0.0), FRAME.y);
    let orbits = [orbit(Vec2::ZERO, FRAME.y), pair(-COLUMN), pair(0.0)];
    Views { list: NAMES.into_iter().zip(orbits).collect(), first: 0 }
}

/// One picture of all plates for each age.
pub fn shots(options: &Options) -> Vec<Shot> {
    let ages = options.scene.ages(&options.ages);
    let size = options.scene.size.map_or(SIZE, UVec2::from);
    let height = FRAME.y.max(FRAME.x * size.y as f32 / size.x as f32);
    let shot =
        |age: f64| Shot { age, orbit: orbit(Vec2::ZERO, height), size, file: format!("fineness_age_{age:.2}.png") };
    ages.into_iter().map(shot).collect()
}
