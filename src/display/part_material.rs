//! Makes the materials of backs and bare metal.

use bevy::{
    color::{Color, ColorToComponents, LinearRgba},
    pbr::StandardMaterial,
};

use super::{
    film_paint::FilmPaint,
    material::{
        extension::{StainExtension, StainedMaterial},
        view::StainView,
    },
    outline::Outline,
};
use crate::appearance::shading::StainPart;

/// Returns the material that draws the stains of a part in detail.
pub(super) fn stained(paint: &FilmPaint, part: StainPart, outline: &Outline, mirrored: bool) -> StainedMaterial {
    let base = outline.apply(part, mirrored, clean(paint, part));
    let extension = StainExtension {
        part,
        shading: paint.shading.clone(),
        pattern: paint.pattern,
        view: StainView::Lit,
        alpha_only: outline.is_masked(),
    };
    StainedMaterial { base, extension }
}

/// Returns the material of a part whose stains are vertex colours, with the primer's colour among them.
pub(super) fn plain(paint: &FilmPaint, part: StainPart, outline: &Outline, mirrored: bool) -> StandardMaterial {
    outline.apply(part, mirrored, StandardMaterial { base_color: Color::WHITE, ..clean(paint, part) })
}

/// Returns the material of a part without stains.
fn clean(paint: &FilmPaint, part: StainPart) -> StandardMaterial {
    let shading = &paint.shading;
    if part == StainPart::Back {
        let primer = shading.primer.surface();
        return StandardMaterial {
            base_color: Color::LinearRgba(LinearRgba::from_vec3(primer.base_color)),
            perceptual_roughness: primer.roughness,
            reflectance: primer.reflectance,
            ..StandardMaterial::default()
        };
    }
    // Stains give metal its shading. Where they are vertex colours only, metalness and roughness are halfway between
    // steel and rust.
    StandardMaterial {
        base_color: Color::WHITE,
        metallic: 0.5 * shading.metal.metallic,
        perceptual_roughness: 0.5 * (shading.metal.roughness + shading.stains.rust_roughness),
        ..StandardMaterial::default()
    }
}
