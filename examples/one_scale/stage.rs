//! The ground, and what the camera looks at.

use crate::cli::{Options, View};
use crate::common_scene::camera::Orbit;
use crate::common_scene::headless::Shot;
use crate::common_scene::window::Views;
use bevy::light::NotShadowCaster;
use bevy::prelude::*;

pub struct StagePlugin;

impl Plugin for StagePlugin {
    fn build(&self, app: &mut App) {
        app.add_systems(Startup, lay_ground);
    }
}

/// From where the sun shines, a unit vector: the left, and the camera.
pub fn sun_direction() -> Vec3 {
    Vec3::new(-0.55, 0.65, 0.5).normalize()
}

fn lay_ground(
    mut commands: Commands,
    mut meshes: ResMut<Assets<Mesh>>,
    mut materials: ResMut<Assets<StandardMaterial>>,
) {
    let ground = materials.add(StandardMaterial {
        base_color: Color::linear_rgb(0.30, 0.30, 0.295),
        perceptual_roughness: 0.9,
        reflectance: 0.3,
        ..default()
    });
    let plain = meshes.add(Plane3d::default().mesh().size(60.0, 60.0));
    commands.spawn((Mesh3d(plain), MeshMaterial3d(ground), NotShadowCaster));
}

/// Of a picture or the window.
pub const SIZE: UVec2 = UVec2::new(1280, 720);

/// Names of the views, in the order of their keys.
pub const NAMES: [&str; 2] = ["scene", "close"];

fn orbit(view: View) -> Orbit {
    match view {
        View::Scene | View::All => {
            Orbit { centre: Vec3::new(-0.1, 0.82, 0.0), distance: 9.0, yaw: 0.0, pitch: 0.17, field_of_view: 0.38 }
        }
        View::Close => {
            Orbit { centre: Vec3::new(0.1, 0.52, 1.0), distance: 4.2, yaw: -0.05, pitch: 0.16, field_of_view: 0.36 }
        }
    }
}

/// The views of the window, in the order of their keys. The first is the one asked for.
pub fn views(options: &Options) -> Views {
    let views = [View::Scene, View::Close];
    let first = views.iter().position(|view| *view == options.view).unwrap_or(0);
    Views { list: NAMES.into_iter().zip(views.map(orbit)).collect(), first }
}

/// One picture for each age and view.
pub fn shots(options: &Options) -> Vec<Shot> {
    let views: &[View] = match options.view {
        View::All => &[View::Scene, View::Close],
        View::Scene => &[View::Scene],
        View::Close => &[View::Close],
    };
    let shot = |age: f64, view: View| {
        let name = if view == View::Close { "close" } else { "scene" };
        let rules = format!("{:?}", options.rules).to_lowercase();
        Shot { age, orbit: orbit(view), size: SIZE, file: format!("one_scale_{rules}_{name}_age_{age:.2}.png") }
    };
    let ages = options.scene.ages(&options.ages);
    ages.into_iter().flat_map(|age| views.iter().map(move |view| shot(age, *view))).collect()
}
