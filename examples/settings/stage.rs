//! The walls before which the pieces hang, one for each stage, and what the camera looks at.

use crate::cli::Options;
use crate::common_scene::camera::Orbit;
use crate::common_scene::headless::Shot;
use crate::common_scene::label::{Label, Pen};
use crate::common_scene::paint::{Loading, Paint};
use crate::common_scene::wall;
use crate::common_scene::window::Views;
use crate::rounded_box::{Shape, rounded_box};
use crate::rows::{Page, Row};
use bevy::light::{NotShadowCaster, NotShadowReceiver};
use bevy::prelude::*;
use bevy_coating::prelude::*;

/// Of the window.
pub const SIZE: UVec2 = UVec2::new(1280, 900);
/// Half the size of a piece, in metres.
const HALF: Vec3 = Vec3::new(0.2, 0.2, 0.07);
/// Rounding of its edges.
const ROUNDING: f32 = 0.025;
/// From piece to piece, and from row to row.
const COLUMN: f32 = 0.47;
const ROW: f32 = 0.68;
/// Rows side by side, and the distance from one to the next.
const ABREAST: usize = 2;
const BLOCK: f32 = 3.0 * COLUMN + 0.22;
/// Height of a line of values, and of a title.
const LINE: f32 = 0.055;
const TITLE: f32 = 0.07;
/// Degrees by which pieces are turned, so that two sides are seen.
const TURN: f32 = 16.0;
/// A long lens, so that all pieces are seen alike.
const FIELD_OF_VIEW: f32 = 0.22;
/// From wall to wall.
const WALLS: f32 = 30.0;
/// Pixels of a metre in a picture.
const PIXELS: f32 = 380.0;

pub struct StagePlugin;

impl Plugin for StagePlugin {
    fn build(&self, app: &mut App) {
        app.add_systems(Startup, build);
    }
}

/// The shape of all pieces, around zero.
pub fn shape() -> Shape {
    rounded_box(Vec3::ZERO, HALF, ROUNDING, 3)
}

/// A row with the middle of its pieces.
struct Placed {
    row: Row,
    at: Vec3,
}

/// Number of lines of rows on a wall.
fn lines(page: Page) -> usize {
    page.rows().count().div_ceil(ABREAST)
}

/// Rows of a wall, from the upper left.
fn placed(page: Page) -> impl Iterator<Item = Placed> {
    let height = (lines(page) as f32 - 1.0) * ROW;
    page.rows().enumerate().map(move |(i, row)| {
        let (block, line) = (i % ABREAST, i / ABREAST);
        let x = (block as f32 - 0.5 * (ABREAST as f32 - 1.0)) * BLOCK;
        Placed { row, at: centre(page) + Vec3::new(x, 0.5 * height - line as f32 * ROW, 0.0) }
    })
}

fn centre(page: Page) -> Vec3 {
    let index = Page::ALL.iter().position(|one| *one == page).unwrap_or_default();
    Vec3::X * WALLS * index as f32
}

fn build(
    mut commands: Commands,
    mut meshes: ResMut<Assets<Mesh>>,
    mut materials: ResMut<Assets<StandardMaterial>>,
    mut images: ResMut<Assets<Image>>,
    mut loading: ResMut<Loading>,
    options: Res<Options>,
) -> Result {
    let plaster = materials.add(wall::plaster());
    let mesh = meshes.add(shape().mesh());
    let turn = Quat::from_rotation_y(TURN.to_radians());
    let pen = Pen::default();
    for page in options.pages() {
        // Shadows of pieces on the wall would say nothing of their paint.
        let shadowless = (NotShadowCaster, NotShadowReceiver);
        let behind = Transform::from_translation(centre(page) - 0.3 * Vec3::Z);
        let wall = meshes.add(Rectangle::new(0.8 * WALLS, 40.0));
        commands.spawn((Mesh3d(wall), MeshMaterial3d(plaster.clone()), behind, shadowless));
        for Placed { row, at } in placed(page) {
            let mut write = |label: Label, height, at| {
                commands
                    .spawn((wall::sheet(label, height, &mut meshes, &mut materials), Transform::from_translation(at)));
            };
            write(pen.write(&row.title(), &mut images), TITLE, at + Vec3::Y * (HALF.y + 0.85 * TITLE));
            let columns = [-COLUMN, 0.0, COLUMN].map(|x| at + x * Vec3::X);
            let settings = row.settings()?;
            for (place, (value, _)) in columns.iter().zip(&settings) {
                write(pen.write(value, &mut images), LINE, *place - Vec3::Y * (HALF.y + 0.8 * LINE));
            }
            for (place, (value, settings)) in columns.into_iter().zip(settings) {
                let coating = Coating::new(settings).with_seed(options.scene.seed);
                commands.spawn((
                    Name::new(format!("{} {value}", row.path)),
                    Mesh3d(mesh.clone()),
                    MeshMaterial3d(materials.add(wall::paint(wall::PALE_GREEN))),
                    Transform::from_translation(place).with_rotation(turn),
                    PropWeather(page.weather()),
                    Paint(coating.with_detail(options.scene.detail(options.level))),
                ));
            }
        }
    }
    (loading.props, loading.loaded) = (1, 1);
    Ok(())
}

/// Size of what is seen of a wall, in metres.
fn extent(page: Page) -> Vec2 {
    Vec2::new(ABREAST as f32 * BLOCK + 0.1, lines(page) as f32 * ROW + 0.02)
}

fn orbit(page: Page) -> Orbit {
    let distance = extent(page).y / 2.0 / (FIELD_OF_VIEW / 2.0).tan();
    let centre = centre(page) + 0.01 * Vec3::Y;
    Orbit { centre, distance, yaw: 0.0, pitch: 0.0, field_of_view: FIELD_OF_VIEW }
}

/// The views of the window, in the order of their keys.
pub fn views(options: &Options) -> Views {
    Views { list: options.pages().into_iter().map(|page| (page.name(), orbit(page))).collect(), first: 0 }
}

/// A picture of each wall; of the first alone for a moving picture.
pub fn shots(options: &Options) -> Vec<Shot> {
    let mut shots = Vec::new();
    for age in options.scene.ages(&[options.age]) {
        shots.extend(options.pages().into_iter().map(|page| {
            let size = (extent(page) * PIXELS).as_uvec2();
            Shot { age, orbit: orbit(page), size, file: format!("settings_{}.png", page.name()) }
        }));
    }
    shots
}
