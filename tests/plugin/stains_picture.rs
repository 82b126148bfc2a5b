//! Stains as they are drawn: the shader against its twin, and in each pass. Needs a graphics adapter, be it a software
//! renderer.

use bevy::{core_pipeline::prepass::*, pbr::DefaultOpaqueRendererMethod, prelude::*};
use bevy_coating::{
    StainExtension, StainView, StainedMaterial,
    appearance::shading::{FilmShading, StainPart, StainPattern, StainSample, SurfaceShading},
};

use crate::{
    stained::*,
    studio::{Picture, Studio},
};

const SIZE: (u32, u32) = (320, 240);
const BASE: SurfaceShading = SurfaceShading {
    base_color: Vec3::new(0.5, 0.55, 0.45),
    metallic: 0.1,
    roughness: 0.4,
    reflectance: 0.5,
    height: 0.0,
};

fn base_material() -> StandardMaterial {
    StandardMaterial {
        base_color: LinearRgba::from_vec3(BASE.base_color).into(),
        metallic: BASE.metallic,
        perceptual_roughness: BASE.roughness,
        reflectance: BASE.reflectance,
        ..default()
    }
}

/// Fields that have every stain somewhere on the plate.
fn fields(p: Vec3) -> [f32; 4] {
    let ramp = |x: f32| x.clamp(0.0, 1.0);
    [1.2 * ramp(p.x * 4.0 + 0.2), ramp(p.y * 3.0), ramp(-p.y * 3.0 - 0.1), ramp(0.5 - p.x * 5.0)]
}

fn pattern() -> StainPattern {
    StainPattern::new(5, Vec3::new(0.1, -1.0, 0.0))
}

/// Mean and largest difference, in 1/255, between a picture and what `expected` says of each place.
fn difference(picture: &Picture, eye: f32, encode: bool, expected: impl Fn(Vec3, f32) -> Vec3) -> (f32, f32) {
    let (mut sum, mut largest, mut count) = (0.0, 0.0f32, 0.0);
    for (place, pixel_size, pixel) in picture.places(eye) {
        let wanted = expected(place, pixel_size);
        for i in 0..3 {
            let value = if encode { Color::linear_rgb(wanted[i], 0.0, 0.0).to_srgba().red } else { wanted[i] };
            let difference = (value.clamp(0.0, 1.0) * 255.0 - f32::from(pixel[i])).abs();
            sum += difference;
            largest = largest.max(difference);
            count += 1.0;
        }
    }
    (sum / count, largest)
}

#[test]
fn the_shader_draws_what_its_twin_says() {
    let Some(mut studio) = Studio::open(SIZE.0, SIZE.1, ".") else { return };
    for eye in [0.25, 1.0] {
        for part in [StainPart::Film, StainPart::Back, StainPart::Metal] {
            let shading = FilmShading::default();
            for view in [StainView::BaseColor, StainView::Surface] {
                let extension =
                    StainExtension { part, shading: shading.clone(), pattern: pattern(), view, ..default() };
                let material = StainedMaterial { base: base_material(), extension };
                let plate = spawn_stained(&mut studio.app, stained_plate(1.2, 240, fields), material);
                let picture = studio.shoot(Vec3::Z * eye, Vec3::ZERO);
                save(&picture, &format!("twin_{part:?}_{view:?}_{eye}"));
                let expected = |place: Vec3, footprint| {
                    let s = StainSample::new(fields(place), place, Vec3::Z);
                    let found = shading.part(part, BASE, &s, &pattern().with_footprint(footprint));
                    if view == StainView::BaseColor {
                        found.base_color
                    } else {
                        Vec3::new(found.metallic, found.roughness, found.reflectance)
                    }
                };
                let (mean, largest) = difference(&picture, eye, true, expected);
                println!("{part:?} {view:?} at {eye} m: {mean:.2} mean, {largest:.0} largest difference of 255");
                assert!(mean < 1.0 && largest < 12.0, "{part:?} {view:?} at {eye} m");
                studio.app.world_mut().entity_mut(plate).despawn();
            }
        }
    }
    assert_eq!(studio.broken_pipelines(), Vec::<String>::new());
}

#[test]
fn relief_bends_the_normal_as_the_height_says() {
    let Some(mut studio) = Studio::open(SIZE.0, SIZE.1, ".") else { return };
    let shading = FilmShading::default();
    let part = StainPart::Metal;
    let view = StainView::Normal;
    let extension = StainExtension { part, shading: shading.clone(), pattern: pattern(), view, ..default() };
    let material = StainedMaterial { base: base_material(), extension };
    spawn_stained(&mut studio.app, stained_plate(1.2, 120, |_| [0.0, 0.0, 0.0, 1.0]), material);
    let picture = studio.shoot(Vec3::Z * 0.2, Vec3::ZERO);
    save(&picture, "relief");
    let (mut bent, mut wrong, mut count) = (0, 0, 0);
    for (place, footprint, pixel) in picture.places(0.2) {
        let height = |p: Vec3| {
            let s = StainSample { corrosion: 1.0, rest: p, normal: Vec3::Z, ..default() };
            shading.metal(&s, &pattern().with_footprint(footprint)).height
        };
        let step = 2e-5;
        let slope = |d: Vec3| (height(place + d * step) - height(place - d * step)) / (2.0 * step);
        let normal = Vec3::new(-slope(Vec3::X), -slope(Vec3::Y), 1.0).normalize();
        let found = Vec3::from_array([0, 1, 2].map(|i| Color::srgb_u8(pixel[i], 0, 0).to_linear().red * 2.0 - 1.0));
        bent += usize::from(normal.z < 0.95);
        wrong += usize::from(!found.abs_diff_eq(normal, 0.1));
        count += 1;
    }
    println!("{bent} of {count} normals are bent, {wrong} are not those of the twin");
    assert!(bent * 20 > count, "there is relief: {bent} of {count}");
    assert!(wrong * 100 < count, "{wrong} of {count}");
}

#[test]
fn forward_prepass_and_deferred_draw_the_same() {
    let mut pictures = Vec::new();
    for (i, deferred) in [false, false, true].into_iter().enumerate() {
        let Some(mut studio) = Studio::open(SIZE.0, SIZE.1, ".") else { return };
        if deferred {
            studio.app.insert_resource(DefaultOpaqueRendererMethod::deferred());
            studio.camera_mut().insert((DepthPrepass, DeferredPrepass, NormalPrepass, MotionVectorPrepass));
        } else if i == 1 {
            studio.camera_mut().insert((DepthPrepass, NormalPrepass, MotionVectorPrepass));
        }
        studio.app.world_mut().query::<&mut DirectionalLight>().iter_mut(studio.app.world_mut()).for_each(
            |mut light| {
                light.shadow_maps_enabled = true;
            },
        );
        for (x, part) in [(-0.11, StainPart::Film), (0.0, StainPart::Back), (0.11, StainPart::Metal)] {
            let extension = StainExtension { part, pattern: pattern(), ..default() };
            let material = StainedMaterial { base: base_material(), extension };
            let plate = spawn_stained(&mut studio.app, stained_plate(0.1, 40, |p| fields(p * 3.0)), material);
            studio.app.world_mut().entity_mut(plate).insert(Transform::from_xyz(x, 0.0, 0.0));
        }
        let picture = studio.shoot(Vec3::new(0.0, 0.1, 0.45), Vec3::ZERO);
        save(&picture, &format!("pass_{i}"));
        assert_eq!(studio.broken_pipelines(), Vec::<String>::new());
        pictures.push(picture);
    }
    for (name, picture) in [("prepass", &pictures[1]), ("deferred", &pictures[2])] {
        let (psnr, pixels) = pictures[0].psnr(picture);
        println!("{name}: {psnr:.1} dB over {pixels} pixels");
        // The deferred pass keeps 8 bits of colour and roughness.
        assert!(psnr > 32.0 && pixels > 10_000, "{name}: {psnr:.1} dB");
    }
}
