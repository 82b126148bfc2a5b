//! The sheet on its wall, and what the camera looks at.

use crate::cli::Options;
use crate::common_scene::camera::Orbit;
use crate::common_scene::headless::Shot;
use crate::common_scene::keys::{Own, RIGHT_DRAG};
use crate::common_scene::paint::{Loading, Paint};
use crate::common_scene::window::Views;
use crate::strokes::HEAT_AGE;
use bevy::light::NotShadowCaster;
use bevy::picking::pointer::PointerButton;
use bevy::prelude::*;
use bevy_coating::{
    CoatingBrush,
    touch::{Change, Effect},
};

/// Size of the sheet, in metres.
pub const WIDTH: f32 = 1.5;
pub const HEIGHT: f32 = 1.0;
/// Of a picture or the window.
pub const SIZE: UVec2 = UVec2::new(1280, 860);

pub struct StagePlugin;

impl Plugin for StagePlugin {
    fn build(&self, app: &mut App) {
        app.add_systems(Startup, build);
    }
}

/// From where the sun shines, a unit vector: the upper left, so low that curled film casts shadows.
pub fn sun_direction() -> Vec3 {
    Vec3::new(-0.60, 0.50, 0.62).normalize()
}

/// Keys of this scene alone.
pub const KEYS: Own = &[("M", "show or hide the heat map"), (RIGHT_DRAG, "weaken the paint")];

/// In the window the right button weakens the paint.
pub fn take_brush(mut brush: ResMut<CoatingBrush>) {
    brush.effect = Some(Effect::Adhesion(Change::Multiply(0.7)));
    brush.radius = 0.06;
    brush.button = PointerButton::Secondary;
}

fn build(
    mut commands: Commands,
    mut meshes: ResMut<Assets<Mesh>>,
    mut materials: ResMut<Assets<StandardMaterial>>,
    mut loading: ResMut<Loading>,
    options: Res<Options>,
) {
    let matt = |base_color: Color, roughness: f32| StandardMaterial {
        base_color,
        perceptual_roughness: roughness,
        reflectance: 0.3,
        ..default()
    };
    let wall = materials.add(matt(Color::linear_rgb(0.42, 0.42, 0.415), 0.9));
    let paint = materials.add(matt(Color::srgb(0.62, 0.75, 0.74), 0.45));
    let behind = Transform::from_xyz(0.0, 0.0, -0.02);
    commands.spawn((Mesh3d(meshes.add(Rectangle::new(30.0, 30.0))), MeshMaterial3d(wall), behind, NotShadowCaster));
    let sheet = meshes.add(Rectangle::new(WIDTH, HEIGHT));
    commands.spawn((Name::new("sheet"), Mesh3d(sheet), MeshMaterial3d(paint), Paint(options.coating())));
    (loading.props, loading.loaded) = (1, 1);
}

/// Names of the views, in the order of their keys.
pub const NAMES: [&str; 2] = ["sheet", "close"];

fn orbit(centre: Vec2, height: f32) -> Orbit {
    let field_of_view = 0.3;
    let distance = height / 2.0 / (field_of_view / 2.0f32).tan();
    Orbit { centre: centre.extend(0.0), distance, yaw: 0.0, pitch: 0.0, field_of_view }
}

/// The whole sheet, and the ring from nearby.
pub fn views() -> Views {
    let orbits = [orbit(Vec2::ZERO, 1.2 * HEIGHT), orbit(Vec2::new(-0.38, 0.05), 0.6)];
    Views { list: NAMES.into_iter().zip(orbits).collect(), first: 0 }
}

/// The sheet before, its heat map, and the sheet after; or all ages of a moving picture.
pub fn shots(options: &Options) -> Vec<Shot> {
    let shot = |age: f64, file: String| Shot { age, orbit: orbit(Vec2::ZERO, 1.12 * HEIGHT), size: SIZE, file };
    if options.scene.animate.is_some() {
        return options.scene.ages(&[]).into_iter().map(|age| shot(age, format!("paint_brush_{age:.2}.png"))).collect();
    }
    let shots = [(0.0, "before"), (HEAT_AGE, "heat_map"), (options.age.max(0.1), "after")];
    shots.into_iter().map(|(age, name)| shot(age, format!("paint_brush_{name}.png"))).collect()
}
