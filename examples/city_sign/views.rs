//! What the camera looks at, and the pictures that are taken.

use crate::cli::{Options, View};
use crate::common_scene::camera::Orbit;
use crate::common_scene::headless::Shot;
use crate::common_scene::window::Views;
use bevy::prelude::*;

/// Of a picture or the window.
pub const SIZE: UVec2 = UVec2::new(1280, 720);

fn orbit(view: View) -> Orbit {
    match view {
        View::Sign | View::All => {
            Orbit { centre: Vec3::new(-0.36, 1.68, 0.0), distance: 1.85, yaw: -0.20, pitch: -0.05, field_of_view: 0.90 }
        }
        View::Close => {
            Orbit { centre: Vec3::new(-0.10, 1.72, 0.0), distance: 0.55, yaw: -0.45, pitch: 0.10, field_of_view: 0.75 }
        }
        View::Street => {
            Orbit { centre: Vec3::new(-1.8, 1.7, -3.0), distance: 7.5, yaw: 0.10, pitch: 0.02, field_of_view: 0.90 }
        }
    }
}

/// Names of the views, in the order of their keys.
pub const NAMES: [&str; 3] = ["sign", "close", "street"];

/// The views of the window, in the order of their keys. The first is the one asked for.
pub fn views(options: &Options) -> Views {
    let views = [View::Sign, View::Close, View::Street];
    let first = views.iter().position(|view| *view == options.view).unwrap_or(0);
    Views { list: NAMES.into_iter().zip(views.map(orbit)).collect(), first }
}

/// One picture for each age and view.
pub fn shots(options: &Options) -> Vec<Shot> {
    let views: &[View] = match options.view {
        View::All => &[View::Sign, View::Close, View::Street],
        View::Sign => &[View::Sign],
        View::Close => &[View::Close],
        View::Street => &[View::Street],
    };
    let shot = |age: f64, view: View| {
        let name = if views.len() > 1 { format!("_{view:?}").to_lowercase() } else { String::new() };
        Shot { age, orbit: orbit(view), size: SIZE, file: format!("city_sign{name}_age_{age:.2}.png") }
    };
    let ages = options.scene.ages(&options.ages);
    ages.into_iter().flat_map(|age| views.iter().map(move |view| shot(age, *view))).collect()
}
