//! Light from all around: a visible sky, and the environment map that it gives (filtered here on the CPU, so that no
//! compute shader is needed).

use bevy::asset::RenderAssetUsages;
use bevy::light::{EnvironmentMapLight, Skybox};
use bevy::pbr::DistanceFog;
use bevy::prelude::*;
use bevy::render::render_resource::{
    Extent3d, TextureDimension, TextureFormat, TextureViewDescriptor, TextureViewDimension,
};

/// What lights and veils the view; belongs on the camera.
#[derive(Resource, Clone)]
pub struct Sky {
    pub backdrop: Handle<Image>,
    pub diffuse: Handle<Image>,
    pub specular: Handle<Image>,
    /// Luminance of radiance 1, cd/m².
    pub brightness: f32,
    /// Light that comes from everywhere alike.
    pub ambient: AmbientLight,
    pub fog: DistanceFog,
    /// Intensity of the bloom.
    pub bloom: f32,
}

impl Sky {
    /// `radiance` is the light from each direction; `seen` is drawn behind everything, on six squares of `side` pixels.
    pub fn paint(
        images: &mut Assets<Image>,
        side: usize,
        radiance: impl Fn(Vec3) -> Vec3 + Sync,
        seen: impl Fn(Vec3) -> Vec3 + Sync,
    ) -> Self {
        let radiance = &radiance;
        let backdrop = cubemap(&[(side, &seen)]);
        let diffuse = cubemap(&[(16, &|direction: Vec3| filtered(radiance, direction, 1.0))]);
        // Mip level against roughness as the engine reads it: even steps of perceptual roughness.
        let rough = |level: usize| move |direction: Vec3| filtered(radiance, direction, (level as f32 / 6.0).powi(2));
        let levels = [rough(0), rough(1), rough(2), rough(3), rough(4), rough(5), rough(6)];
        let chain: Vec<(usize, &(dyn Fn(Vec3) -> Vec3 + Sync))> =
            levels.iter().enumerate().map(|(i, f)| (64 >> i, f as &(dyn Fn(Vec3) -> Vec3 + Sync))).collect();
        let specular = cubemap(&chain);
        Self {
            backdrop: images.add(backdrop),
            diffuse: images.add(diffuse),
            specular: images.add(specular),
            brightness: 1_000.0,
            ambient: AmbientLight { brightness: 0.0, ..default() },
            fog: DistanceFog::default(),
            bloom: 0.0,
        }
    }

    /// The camera's share of the sky.
    pub fn view(&self) -> impl Bundle {
        (
            Skybox { image: Some(self.backdrop.clone()), brightness: self.brightness, ..default() },
            EnvironmentMapLight {
                diffuse_map: self.diffuse.clone(),
                specular_map: self.specular.clone(),
                intensity: self.brightness,
                ..default()
            },
            self.ambient.clone(),
            self.fog.clone(),
        )
    }
}

/// `radiance` seen through a GGX lobe of width `alpha` (1: close to the cosine lobe of matt surfaces).
fn filtered(radiance: &(impl Fn(Vec3) -> Vec3 + Sync), direction: Vec3, alpha: f32) -> Vec3 {
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
