//! Light for looking at paint: a bright, even sky, and a sun that casts shadows.

use super::sky::Sky;
use bevy::light::{CascadeShadowConfigBuilder, DirectionalLightShadowMap};
use bevy::pbr::{DistanceFog, FogFalloff};
use bevy::prelude::*;

/// Luminance of 1 in [`radiance`], cd/m².
const BRIGHTNESS: f32 = 850.0;

/// The light of the studio.
#[derive(Resource, Clone, Copy, Debug)]
pub struct StudioPlugin {
    /// Where the sun stands, a unit vector.
    pub sun: Vec3,
}

impl Plugin for StudioPlugin {
    fn build(&self, app: &mut App) {
        app.insert_resource(*self).add_systems(PreStartup, paint_sky).add_systems(Startup, spawn_sun);
    }
}

fn paint_sky(mut commands: Commands, mut images: ResMut<Assets<Image>>) {
    let sky = Sky {
        brightness: BRIGHTNESS,
        fog: DistanceFog { falloff: FogFalloff::Linear { start: 1e4, end: 2e4 }, ..default() },
        ..Sky::paint(&mut images, 128, radiance, backdrop)
    };
    commands.insert_resource(sky);
}

fn spawn_sun(mut commands: Commands, studio: Res<StudioPlugin>) {
    commands.insert_resource(DirectionalLightShadowMap { size: 4096 });
    commands.insert_resource(GlobalAmbientLight { brightness: 0.0, ..default() });
    commands.spawn((
        DirectionalLight {
            color: Color::linear_rgb(1.0, 0.95, 0.87),
            illuminance: 6_000.0,
            shadow_maps_enabled: true,
            shadow_depth_bias: 0.01,
            shadow_normal_bias: 1.0,
            ..default()
        },
        // The first cascade is for a camera that has come close.
        CascadeShadowConfigBuilder {
            num_cascades: 2,
            minimum_distance: 0.2,
            first_cascade_far_bound: 4.0,
            maximum_distance: 34.0,
            overlap_proportion: 0.1,
        }
        .build(),
        Transform::default().looking_to(-studio.sun, Vec3::Y),
    ));
}

/// An overcast sky, brighter above, with two soft windows that wet paint mirrors.
fn radiance(direction: Vec3) -> Vec3 {
    let window = |from: Vec3, width: f32| {
        let away = 1.0 - direction.dot(from.normalize()).max(0.0);
        (-away / width).exp()
    };
    let up = direction.y;
    let sky = Vec3::new(0.42, 0.45, 0.50).lerp(Vec3::new(0.78, 0.82, 0.88), (up * 1.2).clamp(0.0, 1.0));
    let ground = Vec3::new(0.30, 0.29, 0.27);
    let below = (-up * 6.0).clamp(0.0, 1.0);
    let lamps = 2.2 * window(Vec3::new(0.7, 0.5, 0.5), 0.03) + 1.3 * window(Vec3::new(-0.8, 0.5, 0.35), 0.05);
    sky.lerp(ground, below) + lamps * (1.0 - below)
}

/// What is seen behind the stage: nothing but grey, darker below.
fn backdrop(direction: Vec3) -> Vec3 {
    Vec3::new(0.34, 0.36, 0.39) * (0.85 + 0.5 * direction.y.clamp(-0.4, 0.8))
}
