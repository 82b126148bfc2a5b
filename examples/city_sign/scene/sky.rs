//! Dusk under a dusty sky: the visible sky, the light it gives (an environment map filtered here on the
//! CPU, so that no compute shader is needed), the low sun, and the haze.

use bevy::asset::RenderAssetUsages;
use bevy::camera::Exposure;
use bevy::light::{CascadeShadowConfigBuilder, DirectionalLightShadowMap, EnvironmentMapLight, Skybox};
use bevy::pbr::{DistanceFog, FogFalloff};
use bevy::prelude::*;
use bevy::render::render_resource::{
    Extent3d, TextureDimension, TextureFormat, TextureViewDescriptor, TextureViewDimension,
};
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

/// What lights and veils the view; belongs on the camera.
#[derive(Resource, Clone)]
pub struct Sky {
    backdrop: Handle<Image>,
    diffuse: Handle<Image>,
    specular: Handle<Image>,
}

impl Sky {
    pub fn paint(images: &mut Assets<Image>) -> Self {
        let clouds = Fbm::<Perlin>::new(11).set_octaves(5).set_frequency(1.0);
        let backdrop = cubemap(&[(512, &|direction: Vec3| cloudy(direction, &clouds))]);
        let diffuse = cubemap(&[(16, &|direction: Vec3| filtered(direction, 1.0))]);
        // Mip level against roughness as the engine reads it: even steps of perceptual roughness.
        let rough = |level: usize| move |direction: Vec3| filtered(direction, (level as f32 / 6.0).powi(2));
        let levels = [rough(0), rough(1), rough(2), rough(3), rough(4), rough(5), rough(6)];
        let chain: Vec<(usize, &(dyn Fn(Vec3) -> Vec3 + Sync))> =
            levels.iter().enumerate().map(|(i, f)| (64 >> i, f as &(dyn Fn(Vec3) -> Vec3 + Sync))).collect();
        let specular = cubemap(&chain);
        Self { backdrop: images.add(backdrop), diffuse: images.add(diffuse), specular: images.add(specular) }
    }

    /// The camera's share of the sky.
    pub fn view(&self) -> impl Bundle {
        (
            Skybox { image: Some(self.backdrop.clone()), brightness: BRIGHTNESS, ..default() },
            EnvironmentMapLight {
                diffuse_map: self.diffuse.clone(),
                specular_map: self.specular.clone(),
                intensity: BRIGHTNESS,
                ..default()
            },
            // Without an environment-independent floor the deepest shadows of the curls would be black.
            AmbientLight { color: Color::linear_rgb(0.8, 0.85, 1.0), brightness: 60.0, ..default() },
            DistanceFog {
                color: linear(HAZE * BRIGHTNESS * Exposure::default().exposure()),
                directional_light_color: Color::linear_rgb(0.9, 0.5, 0.2),
                directional_light_exponent: 14.0,
                falloff: FogFalloff::ExponentialSquared { density: 0.0125 },
            },
        )
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

/// [`radiance`] seen through a GGX lobe of width `alpha` (1: close to the cosine lobe of matt surfaces).
fn filtered(direction: Vec3, alpha: f32) -> Vec3 {
    const SAMPLES: u32 = 96;
    if alpha == 0.0 {
        return radiance(direction);
    }
    let (tangent, bitangent) = direction.any_orthonormal_pair();
    let (mut sum, mut weight) = (Vec3::ZERO, 0.0);
    for i in 0..SAMPLES {
        let u = (i as f32 + 0.5) / SAMPLES as f32;
        // The golden angle spreads the samples evenly without a table.
        let (sin, cos) = (i as f32 * 2.399_963).sin_cos();
        let cos_half = ((1.0 - u) / (1.0 + (alpha * alpha - 1.0) * u)).sqrt();
        let sin_half = (1.0 - cos_half * cos_half).max(0.0).sqrt();
        let half = (tangent * cos + bitangent * sin) * sin_half + direction * cos_half;
        let light = half * (2.0 * half.dot(direction)) - direction;
        let cosine = light.dot(direction);
        if cosine > 0.0 {
            sum += radiance(light) * cosine;
            weight += cosine;
        }
    }
    sum / weight.max(1e-6)
}

/// A cube of the given levels (side, colour by direction), finest first, each half the one before.
fn cubemap(levels: &[(usize, &(dyn Fn(Vec3) -> Vec3 + Sync))]) -> Image {
    // The faces +x, -x, +y, -y, +z, -z in the order and orientation of the graphics APIs, whose cubes are
    // left-handed: the engine mirrors z when it samples.
    let direction = |face: usize, u: f32, v: f32| {
        let d = match face {
            0 => Vec3::new(1.0, -v, -u),
            1 => Vec3::new(-1.0, -v, u),
            2 => Vec3::new(u, 1.0, v),
            3 => Vec3::new(u, -1.0, -v),
            4 => Vec3::new(u, -v, 1.0),
            _ => Vec3::new(-u, -v, -1.0),
        };
        (d * Vec3::new(1.0, 1.0, -1.0)).normalize()
    };
    let face = |index: usize| {
        let mut data = Vec::new();
        for (side, colour) in levels {
            for i in 0..side * side {
                let at = |k: usize| 2.0 * (k as f32 + 0.5) / *side as f32 - 1.0;
                let texel = colour(direction(index, at(i % side), at(i / side)));
                data.extend(shared_exponent(texel).to_le_bytes());
            }
        }
        data
    };
    let data = std::thread::scope(|scope| {
        let faces: Vec<_> = (0..6).map(|i| scope.spawn(move || face(i))).collect();
        faces.into_iter().flat_map(|f| f.join().unwrap_or_default()).collect::<Vec<u8>>()
    });
    let side = levels.first().map_or(1, |l| l.0) as u32;
    let extent = Extent3d { width: side, height: side, depth_or_array_layers: 6 };
    let format = TextureFormat::Rgb9e5Ufloat;
    let mut image = Image::new_uninit(extent, TextureDimension::D2, format, RenderAssetUsages::RENDER_WORLD);
    image.texture_descriptor.mip_level_count = levels.len() as u32;
    image.data = Some(data);
    image.texture_view_descriptor =
        Some(TextureViewDescriptor { dimension: Some(TextureViewDimension::Cube), ..default() });
    image
}

/// Three nine-bit mantissas with one five-bit exponent (`Rgb9e5Ufloat`).
fn shared_exponent(rgb: Vec3) -> u32 {
    let rgb = rgb.clamp(Vec3::ZERO, Vec3::splat(65_408.0));
    let largest = rgb.max_element().max(1e-6);
    let exponent = (largest.log2().floor() as i32 + 1).clamp(-15, 16);
    let scale = 2f32.powi(9 - exponent);
    let mantissa = (rgb * scale + 0.5).min(Vec3::splat(511.0)).as_uvec3();
    mantissa.x | mantissa.y << 9 | mantissa.z << 18 | ((exponent + 15) as u32) << 27
}
