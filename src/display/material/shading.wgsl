// Computes how stained surfaces are shaded. The same functions in Rust, where the numbers are explained:
// `src/appearance/shading`.
#define_import_path bevy_coating::shading

#import bevy_coating::noise::{Grain, Octaves, around, cover, grain, level_grain, of_level}

// Colours, strengths and patterns of a part. The same layout in Rust: `StainUniform` in uniform.rs.
struct StainUniform {
    rust_thin: vec3<f32>,
    rust_strength: f32,
    rust_thick: vec3<f32>,
    rust_roughness: f32,
    dust: vec3<f32>,
    dust_strength: f32,
    steel: vec3<f32>,
    steel_metallic: f32,
    first_rust: vec3<f32>,
    steel_roughness: f32,
    rust: vec3<f32>,
    relief: f32,
    streaks: vec3<f32>,
    streak_width: f32,
    offset: vec3<f32>,
    streak_stretch: f32,
    dust_dulling: f32,
    dust_size: f32,
    wet_darkening: f32,
    wet_roughness: f32,
    creep: f32,
    patch_size: f32,
    view: u32,
    alpha_only: u32,
}

// Material inputs at one place. Bevy's materials have a reflectance for each channel. `slope` is the slope of the
// height.
struct SurfaceShading {
    base_color: vec3<f32>,
    metallic: f32,
    roughness: f32,
    reflectance: vec3<f32>,
    slope: vec3<f32>,
}

// Stains of a place, its position and normal at rest, and the size of a pixel there in metres.
struct StainSample {
    rust: f32,
    dust: f32,
    moisture: f32,
    corrosion: f32,
    rest: vec3<f32>,
    normal: vec3<f32>,
    footprint: f32,
}

const THREAD_EDGE: f32 = 0.18;
const MEAN_CRUST: f32 = 0.225;
const DARKEST: f32 = 1e-3;
const RUST_REFLECTANCE: f32 = 0.3;
const WATER_REFLECTANCE: f32 = 0.36;
const LEVELS: f32 = 4.0;
const SUNK: f32 = 0.4;
const FRAC_PI_4: f32 = 0.78539816;

// Pattern of round grains.
fn round_grain(u: StainUniform, s: StainSample, sizes: vec3<f32>, weights: vec3<f32>) -> Grain {
    return grain(s.rest + u.offset, vec3<f32>(0.0), 1.0, Octaves(sizes, weights), s.footprint);
}

// Streaks on one of eight upright planes: number `plane` faces along the level axes `x` and `y` turned by that many
// eighths of a full turn. Their width is measured along the level line of the plane.
fn facing(
    u: StainUniform,
    s: StainSample,
    x: vec3<f32>,
    y: vec3<f32>,
    plane: f32,
    octaves: Octaves,
    stretch: f32,
) -> Grain {
    let level = cross(u.streaks, x * cos(plane * FRAC_PI_4) + y * sin(plane * FRAC_PI_4));
    return level_grain(s.rest + u.offset, level, stretch, octaves, s.footprint);
}

// Pattern of grains that are `stretch` times as long down the surface as they are wide.
fn streak_grain(u: StainUniform, s: StainSample, octaves: Octaves, stretch: f32) -> Grain {
    let down = u.streaks;
    let outwards = s.normal - down * dot(down, s.normal);
    if dot(outwards, outwards) < 1e-4 || all(down == vec3<f32>(0.0)) {
        return grain(s.rest + u.offset, down, stretch, octaves, s.footprint);
    }
    let aside = select(vec3<f32>(0.0, 0.0, 1.0), vec3<f32>(1.0, 0.0, 0.0), abs(down.x) < 0.8);
    let x = normalize(aside - down * dot(down, aside));
    let y = cross(down, x);
    let turn = atan2(dot(outwards, y), dot(outwards, x)) / FRAC_PI_4;
    let plane = floor(turn);
    let share = smoothstep(0.25, 0.75, turn - plane);
    var found: Grain;
    // A loop instead of two calls keeps the compiled shader small.
    for (var i = 0u; i < 2u; i++) {
        let weight = select(1.0 - share, share, i == 1u);
        if weight > 0.0 {
            let g = facing(u, s, x, y, plane + f32(i), octaves, stretch);
            found.value += weight * g.value;
            found.slope += weight * g.slope;
            found.kept += weight * g.kept;
        }
    }
    return found;
}

// Surface of which the share `covered` is hidden under rust of `color`.
fn rusted(u: StainUniform, base: SurfaceShading, color: vec3<f32>, covered: f32) -> SurfaceShading {
    var shading = base;
    let own = base.base_color;
    let filtered = own * pow(max(color, vec3<f32>(DARKEST)) / max(own, vec3<f32>(DARKEST)), vec3<f32>(covered));
    shading.base_color = select(filtered, mix(own, color, covered), color >= own);
    shading.metallic = base.metallic * (1.0 - covered);
    shading.roughness = mix(base.roughness, u.rust_roughness, covered);
    shading.reflectance = mix(base.reflectance, vec3<f32>(RUST_REFLECTANCE), covered);
    return shading;
}

// Pattern of the threads in which rust runs off.
fn threads(u: StainUniform, s: StainSample, blotch: Grain) -> Grain {
    let octaves = Octaves(u.streak_width * vec3<f32>(3.2, 1.1, 0.4), vec3<f32>(0.45, 0.45, 0.2));
    var aside = s;
    aside.rest += vec3<f32>(0.14 * u.streak_width * (blotch.value - 0.5));
    return streak_grain(u, aside, octaves, 2.5 * u.streak_stretch);
}

// Surface under run-off rust.
fn run_off(
    u: StainUniform,
    base: SurfaceShading,
    s: StainSample,
    streak: Grain,
    blotch: Grain,
    hold: f32,
) -> SurfaceShading {
    let amount = 1.0 - exp(-3.0 * s.rust);
    let thread = threads(u, s, blotch);
    let share = amount * (0.22 + 0.3 * amount);
    let strength = min(0.5 + 0.5 * sqrt(amount), 20.0 * amount);
    let core = cover(thread, share, THREAD_EDGE) * strength;
    let hidden = share * strength;
    let even = (amount - hidden) / (1.0 - hidden);
    let veil = even * around(thread, 1.0, 0.3) * around(streak, 1.0, 0.2) * around(blotch, 1.0, 0.3);
    let covered = clamp(mix(veil, 1.0, core), 0.0, 1.0) * u.rust_strength * hold;
    let inside = mix(0.75 * share, smoothstep(-0.12, 0.3, thread.value - 1.0 + share), thread.kept);
    let crust = mix(MEAN_CRUST, smoothstep(0.6, 0.95, blotch.value), blotch.kept);
    let depth = inside * around(streak, 1.15, 0.35) * around(blotch, 1.0, 0.3) + 0.4 * crust;
    let thick = smoothstep(0.15, 1.1, amount * depth + 0.25 * smoothstep(0.6, 1.0, amount));
    let color = mix(u.rust_thin, u.rust_thick, thick) * around(blotch, 1.0, 0.16);
    return rusted(u, base, color, covered);
}

// Surface under dust.
fn dusty(u: StainUniform, base: SurfaceShading, s: StainSample, streak: Grain) -> SurfaceShading {
    let patches = round_grain(u, s, u.dust_size * vec3<f32>(3.0, 0.9, 0.12), vec3<f32>(0.5, 0.35, 0.2));
    let gathered = min(s.dust * around(patches, 1.0, 0.18) * around(streak, 1.0, 0.15), 1.0);
    let covered = u.dust_strength * gathered;
    var shading = base;
    shading.base_color = mix(base.base_color, u.dust, covered);
    shading.metallic = base.metallic * (1.0 - covered);
    shading.roughness = mix(base.roughness, max(base.roughness, 0.95), min(1.3 * covered, 1.0));
    shading.reflectance = base.reflectance * (1.0 - u.dust_dulling * gathered);
    return shading;
}

// Surface under water.
fn wet(u: StainUniform, base: SurfaceShading, s: StainSample, porous: f32) -> SurfaceShading {
    let sizes = Octaves(u.dust_size * vec3<f32>(2.4, 0.8, 0.25), vec3<f32>(0.5, 0.4, 0.2));
    let sheets = streak_grain(u, s, sizes, 5.0);
    let covered = mix(s.moisture, cover(sheets, s.moisture, 0.5), 0.25);
    let darkening = min(u.wet_darkening * (1.0 + 0.5 * min(porous, 1.0)), 1.0);
    var shading = base;
    shading.base_color = base.base_color * (1.0 - darkening * covered);
    shading.roughness = mix(base.roughness, min(base.roughness, u.wet_roughness), 0.9 * covered);
    shading.reflectance = mix(base.reflectance, max(base.reflectance, vec3<f32>(WATER_REFLECTANCE)), covered);
    shading.slope = base.slope * (1.0 - 0.5 * covered);
    return shading;
}

#ifdef STAIN_BACK
// Back of a flake with rust that creeps in from the metal.
fn creeping(u: StainUniform, base: SurfaceShading, s: StainSample, blotch: Grain) -> SurfaceShading {
    let covered = u.creep * cover(blotch, s.corrosion, 0.12);
    let thick = smoothstep(0.5, 1.0, s.corrosion * around(blotch, 0.9, 0.4));
    return rusted(u, base, mix(u.rust_thin, u.rust_thick, thick), covered);
}
#endif

#ifdef STAIN_METAL
// Bright steel with scratches.
fn steel(u: StainUniform, s: StainSample) -> SurfaceShading {
    let lines = Octaves(vec3<f32>(0.0011, 0.0005, 0.00025), vec3<f32>(0.4, 0.4, 0.3));
    let up = select(u.streaks, vec3<f32>(0.0, 1.0, 0.0), all(u.streaks == vec3<f32>(0.0)));
    let scratches = level_grain(s.rest + u.offset, up, 90.0, lines, s.footprint);
    var shading: SurfaceShading;
    shading.base_color = u.steel * around(scratches, 1.0, 0.12);
    shading.metallic = u.steel_metallic;
    shading.roughness = clamp(u.steel_roughness * around(scratches, 1.0, 0.25), 0.089, 1.0);
    shading.reflectance = vec3<f32>(0.5);
    shading.slope = vec3<f32>(0.0);
    return shading;
}

// Steel that has rusted.
fn corroded(u: StainUniform, bright: SurfaceShading, s: StainSample, streak: Grain) -> SurfaceShading {
    let size = u.patch_size;
    let patches = round_grain(u, s, size * vec3<f32>(2.1, 1.0, 0.4), vec3<f32>(0.5, 0.42, 0.25));
    let scales = round_grain(u, s, size * vec3<f32>(0.5, 0.21, 0.08), vec3<f32>(0.5, 0.36, 0.2));
    let grit = round_grain(u, s, size * vec3<f32>(0.11, 0.045, 0.02), vec3<f32>(0.4, 0.42, 0.34));
    let spread = s.corrosion * (1.0 - s.corrosion);
    let age = clamp(s.corrosion + spread * around(patches, 0.0, 1.1), 0.0, 1.0);
    let first = cover(grit, min(age * 3.2, 1.0), 0.2);
    let layered = cover(scales, smoothstep(0.22, 0.95, age), 0.14);
    // Place in a stack of layers with steep edges.
    let level = floor(scales.value * LEVELS);
    let within = scales.value * LEVELS - level;
    let rise = smoothstep(0.78, 1.0, within);
    let tint = mix(0.5, mix(of_level(level), of_level(level + 1.0), rise), scales.kept);
    let edge = smoothstep(0.55, 0.8, within) * (1.0 - rise);
    let shade = 1.0 - 0.45 * edge * scales.kept;
    let dark = u.first_rust * around(grit, 1.25, 0.7);
    let orange = u.rust * mix(vec3<f32>(0.34), vec3<f32>(1.4, 1.6, 1.65), tint * tint);
    let tone = around(grit, 0.95, 0.34) * around(streak, 0.95, 0.3) * around(patches, 1.0, 0.25) * shade;
    let pits = smoothstep(0.8, 0.93, 1.0 - grit.value) * grit.kept * smoothstep(0.1, 0.5, age);
    let color = mix(dark, orange * tone, 0.92 * layered) * (1.0 - 0.65 * pits);
    let rough = mix(0.62, 0.95, layered) - 0.1 * (1.0 - layered) * around(grit, 0.0, 1.0);
    // Slope of the height; cover and age are taken to be even.
    let t = clamp((within - 0.78) / 0.22, 0.0, 1.0);
    let pit = clamp((0.2 - grit.value) / 0.13, 0.0, 1.0);
    let rise_slope = 6.0 * t * (1.0 - t) / 0.22 * scales.slope;
    let pit_slope = -6.0 * pit * (1.0 - pit) / 0.13 * grit.slope * grit.kept * smoothstep(0.1, 0.5, age);
    var shading: SurfaceShading;
    shading.base_color = mix(bright.base_color, color, first);
    shading.metallic = bright.metallic * (1.0 - first) + 0.25 * bright.metallic * first * (1.0 - layered);
    shading.roughness = mix(bright.roughness, rough, first);
    shading.reflectance = mix(bright.reflectance, vec3<f32>(0.32), first);
    shading.slope = u.relief * first * (layered * (rise_slope + 0.24 * grit.slope) - 0.3 * pit_slope);
    return shading;
}

#endif

// Shading of a place. `base` is the shading by the standard material; metal does not use it.
fn stained(u: StainUniform, base: SurfaceShading, s: StainSample) -> SurfaceShading {
    var shading = base;
    var porous = s.rust;
    var hold = 1.0;
    var streak: Grain;
    if s.rust > 0.0 || s.dust > 0.0 || s.corrosion > 0.0 {
        let widths = Octaves(u.streak_width * vec3<f32>(2.5, 1.0, 0.42), vec3<f32>(0.5, 0.42, 0.26));
        streak = streak_grain(u, s, widths, u.streak_stretch);
    }
    var blotch: Grain;
    if s.rust > 0.0 || s.corrosion > 0.0 {
        blotch = round_grain(u, s, u.patch_size * vec3<f32>(0.35, 0.12, 0.04), vec3<f32>(0.5, 0.35, 0.25));
    }
#ifdef STAIN_METAL
    shading = steel(u, s);
    porous = s.corrosion;
    hold = mix(1.0, SUNK, s.corrosion);
    if s.corrosion > 0.0 {
        shading = corroded(u, shading, s, streak);
    }
#endif
#ifdef STAIN_BACK
    if s.corrosion > 0.0 {
        shading = creeping(u, shading, s, blotch);
    }
#endif
    if s.rust > 0.0 {
        shading = run_off(u, shading, s, streak, blotch, hold);
    }
    if s.dust > 0.0 {
        shading = dusty(u, shading, s, streak);
    }
    if s.moisture > 0.0 {
        shading = wet(u, shading, s, max(porous, s.dust));
    }
    return shading;
}
