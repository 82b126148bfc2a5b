//! Reflection of types that know no engine.

use bevy::{
    math::Vec3,
    reflect::{impl_reflect, prelude::*},
};

use crate::{
    deform::SolverQuality,
    film::build::FilmResolution,
    shown::look::{StainLook, StainPart, StainPattern},
};

impl_reflect!(
    #[reflect(Debug, Clone, PartialEq)]
    #[type_path = "bevy_coating::film::build"]
    enum FilmResolution {
        Triangles(u32),
        EdgeLength(f32),
        Keep,
    }
);

impl_reflect!(
    #[reflect(Default, Debug, Clone, PartialEq, Hash)]
    #[type_path = "bevy_coating::deform"]
    enum SolverQuality {
        Reference,
        High,
        Default,
        Fast,
    }
);

impl_reflect!(
    #[reflect(Default, Debug, Clone, PartialEq)]
    #[type_path = "bevy_coating::shown::look"]
    enum StainPart {
        Film,
        Back,
        Metal,
    }
);

impl_reflect!(
    #[reflect(Default, Debug, Clone, PartialEq)]
    #[type_path = "bevy_coating::shown::look"]
    struct StainPattern {
        streaks: Vec3,
        offset: Vec3,
        footprint: f32,
    }
);

impl_reflect!(
    #[reflect(Default, Debug, Clone, PartialEq)]
    #[type_path = "bevy_coating::shown::look"]
    struct StainLook {
        rust_thin: Vec3,
        rust_thick: Vec3,
        rust_strength: f32,
        rust_roughness: f32,
        streak_width: f32,
        streak_stretch: f32,
        dust: Vec3,
        dust_strength: f32,
        dust_dulling: f32,
        dust_size: f32,
        wet_darkening: f32,
        wet_roughness: f32,
        creep: f32,
        steel: Vec3,
        steel_metallic: f32,
        steel_roughness: f32,
        first_rust: Vec3,
        rust: Vec3,
        patch_size: f32,
        relief: f32,
    }
);
