//! Computes how stained surfaces are shaded: from stain fields to colour, roughness, metalness and relief.
//!
//! | surface | function | layers, from below |
//! |---|---|---|
//! | paint | [`FilmShading::film`] | the prop's own material, run-off rust, dust, water |
//! | backs of flakes | [`FilmShading::back`] | primer, rust that creeps in from the metal, and the same stains |
//! | bare metal | [`FilmShading::metal`] | steel, first rust, layered rust, and the same stains |
//!
//! The fields say how much of each stain there is at a vertex. Noise, whose grains have sizes in metres, adds detail
//! that is finer than the mesh: a stain covers the places where the noise is above a threshold that falls as the amount
//! rises. So stains break up into threads and patches instead of fading evenly, and the mean over an area is still the
//! amount of the field there.
//!
//! The functions here run on the CPU, for baked models and vertex colours. The shader of feature `render`
//! (`src/display/material/shading.wgsl`) does the same on the GPU, and a test compares the two.
//!
//! ```
//! use bevy_coating::appearance::shading::{FilmShading, StainPattern, StainSample, SurfaceShading};
//! use bevy_math::Vec3;
//!
//! let paint =
//!     SurfaceShading { base_color: Vec3::splat(0.8), metallic: 0.0, roughness: 0.3, reflectance: 0.5, height: 0.0 };
//! let shading = FilmShading::default();
//! // A wide footprint averages the detail.
//! let pattern = StainPattern::new(7, Vec3::NEG_Y).with_footprint(1.0);
//! let rusty = StainSample { rust: 0.5, normal: Vec3::Z, ..StainSample::default() };
//! let stained = shading.film(paint, &rusty, &pattern);
//! assert!(stained.base_color.x > stained.base_color.z, "rust is orange");
//! assert!(stained.roughness > paint.roughness, "and rough");
//! ```

mod film;
mod metal;
mod noise;
mod part;
mod pattern;
mod sample;
mod settings;
mod surface;
#[cfg(test)]
mod tests;

pub use part::StainPart;
pub use pattern::StainPattern;
pub use sample::StainSample;
pub use settings::{FilmShading, MetalShading, PrimerShading, StainShading};
pub use surface::SurfaceShading;
