//! Shades bare metal: bright steel, first dark rust, then layers of orange scale with pits and grit, and stains on top.

use bevy_math::Vec3;

use super::{
    noise::{Grain, mix, of_level, smoothstep},
    pattern::StainPattern,
    sample::StainSample,
    settings::FilmShading,
    surface::SurfaceShading,
};
use crate::stain::shown::FIRST_RUST;

/// Number of layers in thick rust.
const LEVELS: f32 = 4.0;

/// Share of the run-off that stays visible on fully rusted metal; the rest cannot be told from the rust under it.
const SUNK: f32 = 0.4;

/// Patterns of the metal at one place, each with grains of another size.
struct Patterns {
    patches: Grain,
    scales: Grain,
    grit: Grain,
    streak: Grain,
}

impl FilmShading {
    /// Returns the shading of the metal at a place with the stains `s`: steel that has rusted by `s.corrosion`, under
    /// run-off, dust and water.
    ///
    /// ```
    /// use bevy_coating::appearance::shading::{FilmShading, StainPattern, StainSample};
    /// use bevy_math::Vec3;
    ///
    /// let (shading, pattern) = (FilmShading::default(), StainPattern::new(7, Vec3::NEG_Y));
    /// let bright = shading.metal(&StainSample::default(), &pattern);
    /// let rusted = shading.metal(&StainSample { corrosion: 1.0, ..StainSample::default() }, &pattern);
    /// assert!(rusted.metallic < bright.metallic && rusted.roughness > bright.roughness);
    /// ```
    pub fn metal(&self, s: &StainSample, p: &StainPattern) -> SurfaceShading {
        let own = self.corroded(s, p);
        let stained = self.run_off(own, s, p, mix(1.0, SUNK, s.corrosion));
        let dusty = self.dusty(stained, s, p);
        self.wet(dusty, s, p, s.corrosion.max(s.dust))
    }

    /// Returns bright steel with fine scratches from brushing.
    fn steel(&self, rest: Vec3, p: &StainPattern) -> SurfaceShading {
        let scratches = p.brushed(rest, [(0.0011, 0.4), (0.0005, 0.4), (0.00025, 0.3)], 90.0);
        SurfaceShading {
            base_color: self.metal.steel * scratches.around(1.0, 0.12),
            metallic: self.metal.metallic,
            roughness: (self.metal.roughness * scratches.around(1.0, 0.25)).clamp(0.089, 1.0),
            reflectance: 0.5,
            height: 0.0,
        }
    }

    /// Returns steel that has rusted by `s.corrosion`.
    fn corroded(&self, s: &StainSample, p: &StainPattern) -> SurfaceShading {
        let steel = self.steel(s.rest, p);
        if s.corrosion <= 0.0 {
            return steel;
        }
        let patterns = self.patterns(s, p);
        let Patterns { patches, scales, grit, streak } = &patterns;
        // Some patches rust earlier than others; bright and fully rusted metal are even.
        let spread = s.corrosion * (1.0 - s.corrosion);
        let age = (s.corrosion + spread * patches.around(0.0, 1.1)).clamp(0.0, 1.0);
        // Spots of first rust grow together, then layers cover them.
        let first = grit.cover((age * FIRST_RUST).min(1.0), 0.2);
        let layered = scales.cover(smoothstep(0.22, 0.95, age), 0.14);
        let step = Step::of(scales.value * LEVELS);
        // The foot of a layer's edge lies in the shadow of the layer.
        let shade = 1.0 - 0.45 * step.edge * scales.kept;
        let level = mix(0.5, step.tint, scales.kept);
        let dark = self.metal.first_rust * grit.around(1.25, 0.7);
        let ochre = Vec3::new(1.4, 1.6, 1.65);
        let orange = self.metal.rust * (Vec3::splat(0.34)).lerp(ochre, level * level);
        let tone = grit.around(0.95, 0.34) * streak.around(0.95, 0.3) * patches.around(1.0, 0.25) * shade;
        let pits = smoothstep(0.8, 0.93, 1.0 - grit.value) * grit.kept * smoothstep(0.1, 0.5, age);
        let color = dark.lerp(orange * tone, 0.92 * layered) * (1.0 - 0.65 * pits);
        let rough = mix(0.62, 0.95, layered) - 0.1 * (1.0 - layered) * grit.around(0.0, 1.0);
        SurfaceShading {
            base_color: steel.base_color.lerp(color, first),
            metallic: steel.metallic * (1.0 - first) + 0.25 * steel.metallic * first * (1.0 - layered),
            roughness: mix(steel.roughness, rough, first),
            reflectance: mix(steel.reflectance, 0.32, first),
            height: self.metal.relief
                * first
                * (layered * (step.height / LEVELS + 0.12 * grit.around(0.0, 1.0)) - 0.3 * pits),
        }
    }

    /// Evaluates the patterns of the metal at a place.
    fn patterns(&self, s: &StainSample, p: &StainPattern) -> Patterns {
        let (size, rest) = (self.metal.patch_size, s.rest);
        Patterns {
            patches: p.grain(rest, [(size * 2.1, 0.5), (size, 0.42), (size * 0.4, 0.25)]),
            scales: p.grain(rest, [(size * 0.5, 0.5), (size * 0.21, 0.36), (size * 0.08, 0.2)]),
            grit: p.grain(rest, [(size * 0.11, 0.4), (size * 0.045, 0.42), (size * 0.02, 0.34)]),
            streak: self.streaks(s, p),
        }
    }
}

/// Place in a stack of layers with steep edges.
struct Step {
    /// Number of layers beneath, which rises smoothly across an edge.
    height: f32,
    /// Random tint of the layer, 0 to 1.
    tint: f32,
    /// Closeness to the foot of an edge: 1 at the foot, 0 away from it.
    edge: f32,
}

impl Step {
    /// Returns the place after `layers` layers; the fraction is the way to the next edge.
    fn of(layers: f32) -> Self {
        let level = layers.floor();
        let within = layers - level;
        let rise = smoothstep(0.78, 1.0, within);
        Self {
            height: level + rise,
            tint: mix(of_level(level), of_level(level + 1.0), rise),
            edge: smoothstep(0.55, 0.8, within) * (1.0 - rise),
        }
    }
}
