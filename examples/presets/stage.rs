//! The wall before which the cans hang, and what the camera looks at.

use crate::cans::{self, Can, HALF, cans};
use crate::cli::Options;
use crate::common_scene::camera::Orbit;
use crate::common_scene::headless::Shot;
use crate::common_scene::label::Pen;
use crate::common_scene::paint::{Loading, Paint};
use crate::common_scene::wall;
use crate::common_scene::window::Views;
use bevy::light::{NotShadowCaster, NotShadowReceiver};
use bevy::prelude::*;

/// Of a picture of all cans, or the window.
pub const SIZE: UVec2 = UVec2::new(1440, 700);
/// Of a picture of one can.
const ONE: UVec2 = UVec2::new(480, 560);
/// Height of a line.
const LINE: f32 = 0.075;
/// Degrees by which cans are turned, so that two sides are seen.
const TURN: f32 = 24.0;
/// A long lens, so that all cans are seen alike.
const FIELD_OF_VIEW: f32 = 0.22;

pub struct StagePlugin;

impl Plugin for StagePlugin {
    fn build(&self, app: &mut App) {
        app.add_systems(Startup, build);
    }
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
    // Shadows of cans on the wall would say nothing of their paint.
    let shadowless = (NotShadowCaster, NotShadowReceiver);
    let behind = Transform::from_xyz(0.0, 0.0, -0.4);
    commands.spawn((Mesh3d(meshes.add(Rectangle::new(40.0, 40.0))), MeshMaterial3d(wall), behind, shadowless));
    let mesh = meshes.add(cans::shape().mesh());
    let turn = Quat::from_rotation_y(TURN.to_radians());
    let pen = Pen::default();
    for can in cans() {
        commands.spawn((
            Name::new(can.preset.name()),
            Mesh3d(mesh.clone()),
            MeshMaterial3d(materials.add(wall::paint(can.color))),
            Transform::from_translation(can.place).with_rotation(turn),
            Paint(can.coating(&options)),
        ));
        let label = pen.write(can.preset.name(), &mut images);
        let sheet = wall::sheet(label, LINE, &mut meshes, &mut materials);
        let below = Transform::from_translation(can.place - Vec3::Y * (HALF.y + 1.5 * LINE));
        commands.spawn((sheet, below));
    }
    (loading.props, loading.loaded) = (1, 1);
}

fn orbit(centre: Vec3, height: f32) -> Orbit {
    let distance = height / 2.0 / (FIELD_OF_VIEW / 2.0).tan();
    Orbit { centre, distance, yaw: 0.0, pitch: 0.12, field_of_view: FIELD_OF_VIEW }
}

fn all() -> Orbit {
    orbit(Vec3::new(0.0, -0.02, 0.0), 2.1)
}

fn one(can: &Can) -> Orbit {
    orbit(can.place - Vec3::Y * 0.05, 0.92)
}

/// Names of the views, in the order of their keys: all cans, and the real paints one by one.
pub fn names() -> Vec<&'static str> {
    std::iter::once("all").chain(cans().skip(cans::COLUMNS).map(|can| can.preset.name())).collect()
}

/// The views of the window, in the order of their keys.
pub fn views() -> Views {
    let orbits = std::iter::once(all()).chain(cans().skip(cans::COLUMNS).map(|can| one(&can)));
    Views { list: names().into_iter().zip(orbits).collect(), first: 0 }
}

/// A picture of all cans and one of each real paint; of all alone for a moving picture.
pub fn shots(options: &Options) -> Vec<Shot> {
    let mut shots = Vec::new();
    for age in options.scene.ages(&[options.age]) {
        shots.push(Shot { age, orbit: all(), size: SIZE, file: format!("presets_age_{age:.2}.png") });
        let of_one = |can: Can| Shot { age, orbit: one(&can), size: ONE, file: format!("preset_{}.png", can.preset) };
        shots.extend(cans().skip(cans::COLUMNS).map(of_one));
    }
    shots
}
