//! The ground's and the walls' textures, painted at start-up: colour and normal map with all mip levels.

use super::tiling::{cell, crack_distance, fractal, gradient};
use bevy::asset::RenderAssetUsages;
use bevy::image::{ImageAddressMode, ImageFilterMode, ImageSampler, ImageSamplerDescriptor};
use bevy::math::IVec2;
use bevy::prelude::*;
use bevy::render::render_resource::{Extent3d, TextureDimension, TextureFormat};

/// What one texel of a surface is.
#[derive(Clone, Copy, Default)]
struct Texel {
    /// Linear reflectance.
    colour: Vec3,
    /// Metres over the mean surface.
    height: f32,
}

/// A repeating surface: base colour and normals, `size` metres wide.
pub struct Surface {
    pub colour: Handle<Image>,
    pub normals: Handle<Image>,
    pub size: f32,
}

impl Surface {
    pub fn material(&self, roughness: f32) -> StandardMaterial {
        StandardMaterial {
            base_color_texture: Some(self.colour.clone()),
            normal_map_texture: Some(self.normals.clone()),
            perceptual_roughness: roughness,
            reflectance: 0.3,
            ..default()
        }
    }
}

pub struct Surfaces {
    pub asphalt: Surface,
    pub pavement: Surface,
    pub plaster: Surface,
    pub concrete: Surface,
}

impl Surfaces {
    pub fn paint(images: &mut Assets<Image>) -> Self {
        // Each is a second of one core's work at most; side by side they take less than the window to open.
        let [asphalt, pavement, plaster, concrete] = std::thread::scope(|scope| {
            [
                scope.spawn(|| draw(512, 3.2, asphalt)),
                scope.spawn(|| draw(1024, 3.0, pavement)),
                scope.spawn(|| draw(512, 5.0, plaster)),
                scope.spawn(|| draw(512, 2.0, concrete)),
            ]
            .map(|thread| {
                thread.join().unwrap_or_else(|_| draw(1, 1.0, |_| Texel { colour: Vec3::splat(0.3), height: 0.0 }))
            })
        });
        let mut add = |(colour, normals, size): (Image, Image, f32)| Surface {
            colour: images.add(colour),
            normals: images.add(normals),
            size,
        };
        Self { asphalt: add(asphalt), pavement: add(pavement), plaster: add(plaster), concrete: add(concrete) }
    }
}

fn smooth(low: f32, high: f32, x: f32) -> f32 {
    let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

const DUST: Vec3 = Vec3::new(0.30, 0.245, 0.18);

fn asphalt(at: Vec2) -> Texel {
    let grain = gradient(at, 256, 1) * 0.5 + gradient(at, 128, 2) * 0.5;
    let worn = fractal(at, 5, 5, 3);
    let warp = Vec2::new(fractal(at, 8, 4, 4), fractal(at, 8, 4, 5)) * 0.02;
    // Long cracks that fade out, and crazing where the surface is worn most.
    let wide = crack_distance(at + warp * 1.5, 3, 6) + smooth(-0.05, 0.3, fractal(at, 4, 3, 38)) * 0.2;
    let fine = crack_distance(at + warp * 0.6, 13, 7) + smooth(-0.42, -0.22, worn) * 0.6;
    let crack = (1.0 - smooth(0.003, 0.014, wide)).max((1.0 - smooth(0.02, 0.07, fine)) * 0.8);
    let colour = Vec3::splat(0.085) * (1.0 + 0.35 * grain + 0.35 * worn);
    let dusty = smooth(-0.25, 0.7, fractal(at, 3, 5, 8) + 0.25 * grain) * 0.7;
    let colour = colour.lerp(DUST * (0.9 + 0.2 * grain), dusty);
    Texel { colour: colour.lerp(Vec3::splat(0.022), crack), height: 0.003 * grain + 0.008 * worn - 0.016 * crack }
}

fn pavement(at: Vec2) -> Texel {
    // Slabs of 0.6 by 0.5 m in a running bond.
    let (columns, rows) = (5, 6);
    let row = (at.y * rows as f32).floor();
    let shifted = at.x * columns as f32 + if row.rem_euclid(2.0) > 0.5 { 0.5 } else { 0.0 };
    let slab = IVec2::new((shifted.floor() as i32).rem_euclid(columns), row as i32);
    let inside = Vec2::new(shifted.rem_euclid(1.0) * 0.6, (at.y * rows as f32).rem_euclid(1.0) * 0.5);
    let wobble = gradient(at, 40, 9) * 0.003;
    let edge = inside.x.min(0.6 - inside.x).min(inside.y).min(0.5 - inside.y) + wobble;
    let joint = 1.0 - smooth(0.004, 0.012, edge);
    let tone = cell(slab, 64, 10);
    let grain = gradient(at, 200, 11) * 0.6 + gradient(at, 90, 12) * 0.4;
    let worn = fractal(at, 6, 5, 13);
    let warp = Vec2::new(fractal(at, 9, 3, 14), fractal(at, 9, 3, 15)) * 0.03;
    // Some slabs only are cracked.
    let broken = crack_distance(at + warp, 6, 16) + if cell(slab, 64, 17) > 0.16 { 1.0 } else { 0.0 };
    let crack = 1.0 - smooth(0.003, 0.016, broken);
    let colour = Vec3::new(0.30, 0.285, 0.26) * (0.75 + 0.35 * tone + 0.16 * worn + 0.12 * grain);
    let dirt = smooth(0.05, 0.8, fractal(at, 4, 5, 18) + 0.3 * joint);
    let colour = colour.lerp(DUST * 0.7, dirt * 0.6).lerp(Vec3::new(0.06, 0.05, 0.035), joint.max(crack) * 0.85);
    let tilt = (inside - Vec2::new(0.3, 0.25)).dot(Vec2::new(cell(slab, 64, 19), cell(slab, 64, 20)) - 0.5) * 0.03;
    Texel { colour, height: 0.0015 * grain + 0.003 * worn + tilt + (tone - 0.5) * 0.006 - 0.014 * joint.max(crack) }
}

/// Bricks 0.25 by 0.0833 m, as seen where plaster is gone.
fn brick(at: Vec2, columns: i32, rows: i32) -> Texel {
    let row = (at.y * rows as f32).floor();
    let shifted = at.x * columns as f32 + if row.rem_euclid(2.0) > 0.5 { 0.5 } else { 0.0 };
    let id = IVec2::new((shifted.floor() as i32).rem_euclid(columns), row as i32);
    let inside = Vec2::new(shifted.rem_euclid(1.0) * 0.25, (at.y * rows as f32).rem_euclid(1.0) * 0.0833);
    let edge = inside.x.min(0.25 - inside.x).min(inside.y).min(0.0833 - inside.y) + gradient(at, 96, 21) * 0.003;
    let mortar = 1.0 - smooth(0.003, 0.010, edge);
    let tone = cell(id, 128, 22);
    let grain = gradient(at, 200, 23);
    let clay = Vec3::new(0.30, 0.115, 0.07).lerp(Vec3::new(0.20, 0.09, 0.065), tone) * (0.9 + 0.25 * grain);
    let colour = clay.lerp(Vec3::new(0.30, 0.275, 0.24) * (0.9 + 0.2 * grain), mortar);
    Texel { colour, height: -0.014 * mortar + 0.002 * grain + (tone - 0.5) * 0.005 }
}

fn plaster(at: Vec2) -> Texel {
    let grain = gradient(at, 220, 24) * 0.5 + gradient(at, 110, 25) * 0.5;
    let worn = fractal(at, 5, 6, 26);
    let gone = fractal(at, 3, 6, 27) + 0.12 * grain;
    let warp = Vec2::new(fractal(at, 8, 4, 28), fractal(at, 8, 4, 29)) * 0.025;
    let cracked = smooth(-0.12, 0.25, fractal(at, 4, 3, 39)) * 0.25;
    let crack = 1.0 - smooth(0.004, 0.02, crack_distance(at + warp * 2.0, 5, 30) + cracked);
    // Rain has drawn dirt down the wall.
    let streak = fractal(Vec2::new(at.x, at.y * 0.0625), 48, 3, 31) * 0.5 + 0.5 * fractal(at, 4, 4, 32);
    let coat = Vec3::new(0.46, 0.42, 0.36) * (0.95 + 0.14 * worn + 0.08 * grain);
    let coat = coat.lerp(Vec3::new(0.17, 0.145, 0.115), smooth(-0.05, 0.75, streak) * 0.75);
    let coat = coat.lerp(Vec3::splat(0.09), crack * 0.7);
    let bare = smooth(0.20, 0.235, gone);
    let bricks = brick(at, 20, 60);
    let colour = coat.lerp(bricks.colour * (1.0 - 0.4 * (1.0 - smooth(0.23, 0.30, gone))), bare);
    let height = 0.018 * (1.0 - bare) + 0.002 * grain + 0.005 * worn - 0.006 * crack * (1.0 - bare);
    Texel { colour, height: height + bricks.height * bare }
}

fn concrete(at: Vec2) -> Texel {
    let grain = gradient(at, 128, 33) * 0.5 + gradient(at, 64, 34) * 0.5;
    let worn = fractal(at, 4, 6, 35);
    let pores = smooth(0.45, 0.7, gradient(at, 48, 36)) * smooth(0.0, 0.4, gradient(at, 9, 37));
    let colour = Vec3::new(0.36, 0.335, 0.30) * (0.95 + 0.22 * worn + 0.14 * grain) * (1.0 - 0.5 * pores);
    Texel { colour, height: 0.004 * grain + 0.010 * worn - 0.006 * pores }
}

/// Paints a surface of `size` metres on `width` texels: colour, normals, size.
fn draw(width: usize, size: f32, paint: impl Fn(Vec2) -> Texel) -> (Image, Image, f32) {
    let at = |i: usize| (Vec2::new((i % width) as f32, (i / width) as f32) + 0.5) / width as f32;
    let texels: Vec<Texel> = (0..width * width).map(|i| paint(at(i))).collect();
    let height = |x: usize, y: usize| texels[(y % width) * width + x % width].height;
    let step = 2.0 * size / width as f32;
    let normals = (0..width * width).map(|i| {
        let (x, y) = (i % width, i / width);
        let dx = (height(x + 1, y) - height(x + width - 1, y)) / step;
        let dy = (height(x, y + 1) - height(x, y + width - 1)) / step;
        // The picture's y runs downwards, a normal map's green upwards.
        Vec3::new(-dx, dy, 1.0).normalize()
    });
    let colour = mipmapped(width, texels.iter().map(|t| t.colour).collect(), TextureFormat::Rgba8UnormSrgb);
    let normals = mipmapped(width, normals.collect(), TextureFormat::Rgba8Unorm);
    (colour, normals, size)
}

/// An image with its mip chain: colours are averaged as light, normals as vectors.
fn mipmapped(width: usize, mut level: Vec<Vec3>, format: TextureFormat) -> Image {
    let srgb = format == TextureFormat::Rgba8UnormSrgb;
    // The transfer function once for each of 4,096 steps, not four million times.
    let table: Vec<u8> =
        (0..4096).map(|i| (Srgba::gamma_function_inverse(i as f32 / 4095.0) * 255.0 + 0.5) as u8).collect();
    let encode = |v: &Vec3| {
        let [r, g, b] = if srgb {
            (*v * 4095.0).to_array().map(|c| table[(c as usize).min(4095)])
        } else {
            (v.normalize_or(Vec3::Z) * 127.5 + 128.0).to_array().map(|c| c as u8)
        };
        [r, g, b, 255]
    };
    let mut data = Vec::new();
    let (mut side, mut levels) = (width, 0);
    loop {
        data.extend(level.iter().flat_map(encode));
        levels += 1;
        if side == 1 {
            break;
        }
        let half = side / 2;
        level = (0..half * half)
            .map(|i| {
                let first = (i / half) * 2 * side + (i % half) * 2;
                (level[first] + level[first + 1] + level[first + side] + level[first + side + 1]) * 0.25
            })
            .collect();
        side = half;
    }
    let extent = Extent3d { width: width as u32, height: width as u32, depth_or_array_layers: 1 };
    let mut image = Image::new_uninit(extent, TextureDimension::D2, format, RenderAssetUsages::RENDER_WORLD);
    image.texture_descriptor.mip_level_count = levels;
    image.data = Some(data);
    image.sampler = ImageSampler::Descriptor(ImageSamplerDescriptor {
        address_mode_u: ImageAddressMode::Repeat,
        address_mode_v: ImageAddressMode::Repeat,
        mag_filter: ImageFilterMode::Linear,
        min_filter: ImageFilterMode::Linear,
        mipmap_filter: ImageFilterMode::Linear,
        anisotropy_clamp: 8,
        ..default()
    });
    image
}
