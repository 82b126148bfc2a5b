//! Computes stains as vertex colours, for props whose textures must stay what they are.

use bevy_math::{Vec2, Vec3, Vec4};

use super::{
    finish::{Finish, Place},
    sheet::Stains,
};
use crate::appearance::{
    MeshPart,
    shading::{StainPattern, StainSample, SurfaceShading},
};

/// Colours of a part of one colour all over, and its mean metalness and roughness.
#[derive(Clone, Debug, PartialEq)]
pub struct Colored {
    /// Linear colours, one a vertex.
    pub colors: Vec<[f32; 4]>,
    /// 0 to 1.
    pub metallic: f32,
    /// 0 to 1.
    pub roughness: f32,
}

/// Colours of paint: its own, times what stains let through where it has a colour texture, which the colours are
/// multiplied with; else the whole colour.
pub fn film(part: &MeshPart, finish: &Finish, stains: &Stains, footprint: f32) -> Vec<[f32; 4]> {
    let pattern = stains.pattern.with_footprint(footprint);
    let color = |i: usize| {
        let own = part.colors.get(i).map_or(Vec4::ONE, |&c| c.into());
        let uv = |uvs: &[[f32; 2]]| uvs.get(i).map_or(Vec2::ZERO, |&uv| uv.into());
        let place = Place { uvs: [uv(&part.uvs), uv(&part.uvs_1)], steps: [0.0; 2], color: own };
        let (base, alpha) = finish.shading(&place);
        let stained = stains.shading.film(base, &sample(part, i), &pattern).base_color;
        if finish.is_textured() {
            (own.truncate() * ratio(stained, base.base_color)).extend(own.w).to_array()
        } else {
            stained.clamp(Vec3::ZERO, Vec3::ONE).extend(alpha).to_array()
        }
    };
    (0..part.positions.len()).map(color).collect()
}

/// Colours of backs or metal, which `shading` computes.
pub fn bare(
    part: &MeshPart,
    stains: &Stains,
    footprint: f32,
    shading: impl Fn(&StainSample, &StainPattern) -> SurfaceShading,
) -> Colored {
    let pattern = stains.pattern.with_footprint(footprint);
    let shadings: Vec<SurfaceShading> =
        (0..part.positions.len()).map(|i| shading(&sample(part, i), &pattern)).collect();
    let mean = |of: fn(&SurfaceShading) -> f32| shadings.iter().map(of).sum::<f32>() / shadings.len().max(1) as f32;
    let color = |shading: &SurfaceShading| shading.base_color.clamp(Vec3::ZERO, Vec3::ONE).extend(1.0).to_array();
    Colored {
        metallic: mean(|shading| shading.metallic).clamp(0.0, 1.0),
        roughness: mean(|shading| shading.roughness).clamp(0.0, 1.0),
        colors: shadings.iter().map(color).collect(),
    }
}

fn sample(part: &MeshPart, i: usize) -> StainSample {
    part.sample(i).unwrap_or_default()
}

/// Factor from `base` to `stained`. Colours cannot make a surface brighter than its texture.
fn ratio(stained: Vec3, base: Vec3) -> Vec3 {
    let part = |s: f32, b: f32| if b > 1e-4 { (s / b).clamp(0.0, 1.0) } else { 1.0 };
    Vec3::new(part(stained.x, base.x), part(stained.y, base.y), part(stained.z, base.z))
}
