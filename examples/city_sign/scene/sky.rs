//! Dusk under a dusty sky: the low sun, the clouds it lights from below, and the haze.

use crate::common_scene::sky::Sky;
use bevy::camera::Exposure;
use bevy::light::{CascadeShadowConfigBuilder, DirectionalLightShadowMap};
use bevy::pbr::{DistanceFog, FogFalloff};
use bevy::prelude::*;
use noise::{Fbm, MultiFractal, NoiseFn, Perlin};

/// Luminance of 1 in [`radiance`], cd/m².
const BRIGHTNESS: f32 = 1_500.0;
const HAZE: Vec3 = Vec3::new(0.56, 0.40, 0.27);
const ZENITH: Vec3 = Vec3::new(0.15, 0.20, 0.29);
const GLOW: Vec3 = Vec3::new(1.9, 1.15, 0.55);
const GROUND: Vec3 = Vec3::new(0.20, 0.16, 0.115);

/// Towards the sun: low, from the right, a little in front of the sign's face, so that its light rakes
/// across the paint.
pub fn sun_direction() -> Vec3 {
    Vec3::new(0.80, 0.40, 0.44).normalize()
}

pub fn paint(images: &mut Assets<Image>) -> Sky {
    let clouds = Fbm::<Perlin>::new(11).set_octaves(5).set_frequency(1.0);
    Sky {
        brightness: BRIGHTNESS,
        // Without an environment-independent floor the deepest shadows of the curls would be black.
        ambient: AmbientLight { color: Color::linear_rgb(0.8, 0.85, 1.0), brightness: 60.0, ..default() },
        fog: DistanceFog {
            color: linear(HAZE * BRIGHTNESS * Exposure::default().exposure()),
            directional_light_color: Color::linear_rgb(0.9, 0.5, 0.2),
            directional_light_exponent: 14.0,
            falloff: FogFalloff::ExponentialSquared { density: 0.0125 },
        },
        bloom: 0.06,
        ..Sky::paint(images, 512, radiance, |direction| cloudy(direction, &clouds))
    }
}

fn linear(rgb: Vec3) -> Color {
    Color::linear_rgb(rgb.x, rgb.y, rgb.z)
}

pub fn spawn_sun(mut commands: Commands) {
    commands.insert_resource(DirectionalLightShadowMap { size: 4096 });
    commands.insert_resource(GlobalAmbientLight { brightness: 0.0, ..default() });
    commands.spawn((
        DirectionalLight {
            color: Color::linear_rgb(1.0, 0.74, 0.46),
            illuminance: 19_000.0,
            shadow_maps_enabled: true,
            shadow_depth_bias: 0.01,
            shadow_normal_bias: 1.0,
            ..default()
        },
        // The first cascade covers the sign alone: a curl of paint is a centimetre high.
        CascadeShadowConfigBuilder {
            num_cascades: 3,
            minimum_distance: 0.2,
            first_cascade_far_bound: 3.6,
            maximum_distance: 75.0,
            overlap_proportion: 0.1,
        }
        .build(),
        Transform::default().looking_to(-sun_direction(), Vec3::Y),
    ));
}

/// The sky without clouds, sun included only as its glow.
fn radiance(direction: Vec3) -> Vec3 {
    let toward_sun = direction.dot(sun_direction()).max(0.0);
    let sky = HAZE.lerp(ZENITH, 1.0 - (-3.2 * direction.y.max(0.0)).exp());
    let glow = GLOW * (0.75 * toward_sun.powi(24) + 0.22 * toward_sun.powi(4));
    let above = sky + glow;
    // The ground is lit, and hazy towards the horizon.
    let below = HAZE.lerp(GROUND, 1.0 - (12.0 * direction.y.min(0.0)).exp());
    if direction.y >= 0.0 { above } else { below }
}

/// What the camera sees: bands of thin cloud lit from below, and haze below the horizon.
fn cloudy(direction: Vec3, clouds: &Fbm<Perlin>) -> Vec3 {
    let height = direction.y.max(0.0);
    let clear = radiance(Vec3::new(direction.x, height, direction.z).normalize());
    // A flat layer of cloud, stretched along the wind.
    let layer = Vec2::new(direction.x, direction.z) / (height + 0.12);
    let field = |offset: Vec2| {
        let p = layer + offset;
        clouds.get([f64::from(p.x) * 0.55, f64::from(p.y) * 1.3, 0.0]) as f32
    };
    let here = field(Vec2::ZERO);
    let cover = ((here + 0.12) * 2.2).clamp(0.0, 1.0) * (height * 7.0).clamp(0.0, 1.0);
    let towards = Vec2::new(sun_direction().x, sun_direction().z) * 0.18;
    let lit = ((here - field(towards)) * 2.4 + 0.45).clamp(0.0, 1.0);
    let cloud = Vec3::new(0.22, 0.205, 0.225).lerp(Vec3::new(0.95, 0.64, 0.40), lit);
    clear.lerp(cloud * (0.75 + 0.5 * clear.length()), cover * 0.7)
}
