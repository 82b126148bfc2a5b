//! Shades stained paint, front and back: run-off rust, dust and water.

use bevy_math::{Vec3, ops};

use super::{
    noise::{Grain, mix, smoothstep},
    pattern::StainPattern,
    sample::StainSample,
    settings::FilmShading,
    surface::SurfaceShading,
};

/// Softness of the edges of threads, as a share of the noise's range.
const THREAD_EDGE: f32 = 0.18;
/// Mean of the crust over all places.
const MEAN_CRUST: f32 = 0.225;
/// Linear colour that a channel counts as at least, where rust is mixed by ratio.
const DARKEST: f32 = 1e-3;
/// Reflectance of rust, which scatters light.
const RUST_REFLECTANCE: f32 = 0.3;
/// Reflectance of a film of water: 2 % at normal incidence.
const WATER_REFLECTANCE: f32 = 0.36;

impl FilmShading {
    /// Returns the shading of paint at a place with the stains `s`. `base` is the shading of the clean paint, and is
    /// returned unchanged where there are no stains.
    ///
    /// ```
    /// use bevy_coating::appearance::shading::{FilmShading, StainPattern, StainSample, SurfaceShading};
    /// use bevy_math::Vec3;
    ///
    /// let paint =
    ///     SurfaceShading { base_color: Vec3::ONE, metallic: 0.0, roughness: 0.4, reflectance: 0.5, height: 0.0 };
    /// let (shading, pattern) = (FilmShading::default(), StainPattern::new(7, Vec3::NEG_Y));
    /// assert_eq!(shading.film(paint, &StainSample::default(), &pattern), paint);
    ///
    /// let wet = StainSample { moisture: 1.0, ..StainSample::default() };
    /// assert!(shading.film(paint, &wet, &pattern).roughness < paint.roughness);
    /// ```
    pub fn film(&self, base: SurfaceShading, s: &StainSample, p: &StainPattern) -> SurfaceShading {
        let stained = self.run_off(base, s, p, 1.0);
        let dusty = self.dusty(stained, s, p);
        self.wet(dusty, s, p, s.rust.max(s.dust))
    }

    /// Returns the shading of the back of a flake at a place with the stains `s`. `base` is the shading of the clean
    /// primer.
    ///
    /// Rust creeps over the back as far as the metal under the place has corroded
    /// ([`StainShading::creep`](super::StainShading::creep)); run-off, dust and water lie over it as on the front.
    ///
    /// ```
    /// use bevy_coating::appearance::shading::{FilmShading, StainPattern, StainSample};
    /// use bevy_math::Vec3;
    ///
    /// let shading = FilmShading::default();
    /// let pattern = StainPattern::new(7, Vec3::NEG_Y).with_footprint(1.0);
    /// let rusty = StainSample { corrosion: 0.8, ..StainSample::default() };
    /// let primer = shading.primer.surface();
    /// let back = shading.back(primer, &rusty, &pattern);
    /// assert!(back.base_color.x / back.base_color.z > primer.base_color.x / primer.base_color.z, "redder");
    /// ```
    pub fn back(&self, base: SurfaceShading, s: &StainSample, p: &StainPattern) -> SurfaceShading {
        let mut shading = base;
        if s.corrosion > 0.0 {
            let blotches = p.grain(s.rest, self.blotches());
            let cover = self.stains.creep * blotches.cover(s.corrosion, 0.12);
            let thick = smoothstep(0.5, 1.0, s.corrosion * blotches.around(0.9, 0.4));
            shading = self.rusted(shading, self.stains.rust_thin.lerp(self.stains.rust_thick, thick), cover);
        }
        self.film(shading, s, p)
    }

    /// Adds run-off rust (VC 6.1). Its mean cover is 0.85 (1 - exp(-3 layers)), gathered into threads.
    ///
    /// A few uneven threads run down the surface, each as far as there is rust enough for it, so that they thin out and
    /// end one after the other. What they do not take lies between them as a translucent veil. Close to the source the
    /// threads are dark brown and the veil has a crust; their edges, and where there is little rust, are orange.
    ///
    /// `hold` is the share of the run-off that stays visible on the surface: 1 on paint, less on rusty metal.
    pub(super) fn run_off(&self, base: SurfaceShading, s: &StainSample, p: &StainPattern, hold: f32) -> SurfaceShading {
        if s.rust <= 0.0 {
            return base;
        }
        let amount = 1.0 - ops::exp(-3.0 * s.rust);
        let streak = self.streaks(s, p);
        let blotches = p.grain(s.rest, self.blotches());
        let threads = self.threads(s, p, blotches);
        // Share of the surface under threads, and how much they hide.
        let share = amount * (0.22 + 0.3 * amount);
        let strength = (0.5 + 0.5 * amount.sqrt()).min(20.0 * amount);
        let thread = threads.cover(share, THREAD_EDGE) * strength;
        // The veil hides what the threads leave of the amount, so that the mean is right.
        let hidden = share * strength;
        let even = (amount - hidden) / (1.0 - hidden);
        let veil = even * threads.around(1.0, 0.3) * streak.around(1.0, 0.2) * blotches.around(1.0, 0.3);
        let cover = mix(veil, 1.0, thread).clamp(0.0, 1.0) * self.stains.rust_strength * hold;
        let inside = mix(0.75 * share, smoothstep(-0.12, 0.3, threads.value - 1.0 + share), threads.kept);
        let crust = mix(MEAN_CRUST, smoothstep(0.6, 0.95, blotches.value), blotches.kept);
        let depth = inside * streak.around(1.15, 0.35) * blotches.around(1.0, 0.3) + 0.4 * crust;
        let thick = smoothstep(0.15, 1.1, amount * depth + 0.25 * smoothstep(0.6, 1.0, amount));
        let color = self.stains.rust_thin.lerp(self.stains.rust_thick, thick) * blotches.around(1.0, 0.16);
        self.rusted(base, color, cover)
    }

    /// Adds dust and soot (VC 6.2), which darken the surface and lower its reflectance.
    pub(super) fn dusty(&self, base: SurfaceShading, s: &StainSample, p: &StainPattern) -> SurfaceShading {
        if s.dust <= 0.0 {
            return base;
        }
        let size = self.stains.dust_size;
        let patches = p.grain(s.rest, [(size * 3.0, 0.5), (size * 0.9, 0.35), (size * 0.12, 0.2)]);
        let washed = self.streaks(s, p);
        let gathered = (s.dust * patches.around(1.0, 0.18) * washed.around(1.0, 0.15)).min(1.0);
        let cover = self.stains.dust_strength * gathered;
        SurfaceShading {
            base_color: base.base_color.lerp(self.stains.dust, cover),
            metallic: base.metallic * (1.0 - cover),
            roughness: mix(base.roughness, base.roughness.max(0.95), (1.3 * cover).min(1.0)),
            reflectance: base.reflectance * (1.0 - self.stains.dust_dulling * gathered),
            height: base.height,
        }
    }

    /// Adds water, which makes the surface darker and glossier. `porous` is the amount of rust or dust that soaks it
    /// up: 0 or more, full effect at 1.
    pub(super) fn wet(&self, base: SurfaceShading, s: &StainSample, p: &StainPattern, porous: f32) -> SurfaceShading {
        if s.moisture <= 0.0 {
            return base;
        }
        let size = self.stains.dust_size;
        // Sheets of water, without edges: nearly even where all is wet.
        let sheets = p.streak(s.rest, s.normal, [(size * 2.4, 0.5), (size * 0.8, 0.4), (size * 0.25, 0.2)], 5.0);
        let wet = mix(s.moisture, sheets.cover(s.moisture, 0.5), 0.25);
        let darkening = (self.stains.wet_darkening * (1.0 + 0.5 * porous.min(1.0))).min(1.0);
        SurfaceShading {
            base_color: base.base_color * (1.0 - darkening * wet),
            metallic: base.metallic,
            roughness: mix(base.roughness, base.roughness.min(self.stains.wet_roughness), 0.9 * wet),
            reflectance: mix(base.reflectance, base.reflectance.max(WATER_REFLECTANCE), wet),
            height: base.height * (1.0 - 0.5 * wet),
        }
    }

    /// Hides the share `cover` (0 to 1) of the surface under rust of `color`.
    ///
    /// In each channel in which the rust is darker than the surface, it works as a filter (the colours are mixed by
    /// their ratio): thin rust on light paint is then orange, not pink. Where it is lighter the colours are mixed
    /// evenly, as rust on blue paint would otherwise be green.
    pub(super) fn rusted(&self, base: SurfaceShading, color: Vec3, cover: f32) -> SurfaceShading {
        let stained = |base: f32, rust: f32| {
            if rust >= base {
                return mix(base, rust, cover);
            }
            base * ops::powf(rust.max(DARKEST) / base.max(DARKEST), cover)
        };
        let (from, to) = (base.base_color, color);
        SurfaceShading {
            base_color: Vec3::new(stained(from.x, to.x), stained(from.y, to.y), stained(from.z, to.z)),
            metallic: base.metallic * (1.0 - cover),
            roughness: mix(base.roughness, self.stains.rust_roughness, cover),
            reflectance: mix(base.reflectance, RUST_REFLECTANCE, cover),
            height: base.height,
        }
    }

    /// Returns the pattern of streaks in which dust is washed, metal rusts and the veil of run-off varies.
    pub(super) fn streaks(&self, s: &StainSample, p: &StainPattern) -> Grain {
        let width = self.stains.streak_width;
        let octaves = [(width * 2.5, 0.5), (width, 0.42), (width * 0.42, 0.26)];
        p.streak(s.rest, s.normal, octaves, self.stains.streak_stretch)
    }

    /// Returns the pattern of the threads in which rust runs off. Their edges waver with the `blotches`, the pattern of
    /// [`FilmShading::blotches`] at the same place.
    fn threads(&self, s: &StainSample, p: &StainPattern, blotches: Grain) -> Grain {
        let width = self.stains.streak_width;
        let octaves = [(width * 3.2, 0.45), (width * 1.1, 0.45), (width * 0.4, 0.2)];
        let aside = Vec3::splat(0.14 * width * (blotches.value - 0.5));
        p.streak(s.rest + aside, s.normal, octaves, 2.5 * self.stains.streak_stretch)
    }

    /// Returns the octaves of the blotches in run-off and in creeping rust.
    fn blotches(&self) -> [(f32, f32); 3] {
        let size = self.metal.patch_size;
        [(size * 0.35, 0.5), (size * 0.12, 0.35), (size * 0.04, 0.25)]
    }
}
