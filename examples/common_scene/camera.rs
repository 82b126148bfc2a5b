//! The camera of a scene: an orbit around what it looks at.

use super::sky::Sky;
use bevy::camera::Hdr;
use bevy::core_pipeline::tonemapping::{DebandDither, Tonemapping};
use bevy::post_process::bloom::Bloom;
use bevy::prelude::*;
use bevy::render::view::{ColorGrading, ColorGradingGlobal, ColorGradingSection};

/// A camera that circles a point.
#[derive(Component, Clone, Copy, Debug)]
pub struct Orbit {
    pub centre: Vec3,
    pub distance: f32,
    /// Around the vertical, radians; 0 looks along -z.
    pub yaw: f32,
    /// Upwards positive: the camera stands above the centre.
    pub pitch: f32,
    /// Vertical field of view, radians.
    pub field_of_view: f32,
}

impl Orbit {
    pub fn transform(&self) -> Transform {
        let turn = Quat::from_euler(EulerRot::YXZ, self.yaw, -self.pitch, 0.0);
        Transform::from_translation(self.centre + turn * Vec3::Z * self.distance).looking_at(self.centre, Vec3::Y)
    }

    pub fn projection(&self) -> Projection {
        Projection::Perspective(PerspectiveProjection { fov: self.field_of_view, near: 0.02, far: 400.0, ..default() })
    }
}

/// Everything a camera of a scene has, whatever it draws on.
pub fn view(sky: &Sky, orbit: Orbit) -> impl Bundle {
    (
        Camera3d::default(),
        Hdr,
        // The pictures are supersampled, and the window smoothed in post-processing: cheaper than MSAA on a
        // software renderer.
        Msaa::Off,
        // The other tone maps need look-up tables that the `tonemapping_luts` feature would bring.
        Tonemapping::AcesFitted,
        DebandDither::Enabled,
        Bloom { intensity: sky.bloom, ..Bloom::NATURAL },
        ColorGrading {
            global: ColorGradingGlobal { exposure: 0.0, post_saturation: 1.05, ..default() },
            shadows: ColorGradingSection { lift: 0.004, ..default() },
            ..default()
        },
        sky.view(),
        orbit.projection(),
        orbit.transform(),
        orbit,
    )
}
