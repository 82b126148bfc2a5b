// Gradient noise with its slope, and patterns made of it. The same functions in Rust:
// `src/appearance/shading/noise.rs`.
#define_import_path bevy_coating::noise

// Standard deviation of the noise, and slope of the logistic curve that is closest to the cumulative normal
// distribution.
const DEVIATION: f32 = 0.1887;
const LOGISTIC: f32 = 1.702;

// Three octaves of grains: size in metres and weight of each.
struct Octaves {
    sizes: vec3<f32>,
    weights: vec3<f32>,
}

// Value of a pattern at one place, evenly distributed over 0 to 1; its slope per metre; and the share of the pattern
// that can be seen (0 where all grains are smaller than the footprint).
struct Grain {
    value: f32,
    slope: vec3<f32>,
    kept: f32,
}

// Hashes a number that was mixed of three.
fn scramble(mixed: u32) -> u32 {
    var h = mixed;
    h = (h ^ (h >> 16u)) * 0x85ebca6bu;
    h = (h ^ (h >> 13u)) * 0xc2b2ae35u;
    return h ^ (h >> 16u);
}

// Factors of the three numbers that are mixed.
const MIX: vec3<u32> = vec3<u32>(0x9e3779b1u, 0x85ebca77u, 0xc2b2ae3du);

// Random number from 0 to 1 for a whole number.
fn of_level(level: f32) -> f32 {
    let p = vec3<u32>(u32(i32(level)), 7u, 13u) * MIX;
    return f32(scramble(p.x ^ p.y ^ p.z) & 1023u) / 1023.0;
}

// Gradient at a corner of the grid: each component evenly distributed over -1 to 1.
fn gradient(mixed: u32) -> vec3<f32> {
    let h = scramble(mixed);
    return vec3<f32>(vec3<u32>(h & 1023u, (h >> 10u) & 1023u, (h >> 20u) & 1023u)) / 511.5 - 1.0;
}

// Noise at `p`: its slope and, in `w`, its value. Only metal has relief, so for other parts the slope is zero.
fn noise(p: vec3<f32>) -> vec4<f32> {
    let cell = floor(p);
    let f = p - cell;
    let g = f - 1.0;
    let t = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    // The product for the next cell is the product for this cell plus the factor.
    let a = vec3<u32>(vec3<i32>(cell)) * MIX;
    let b = a + MIX;
    let g000 = gradient(a.x ^ a.y ^ a.z);
    let g100 = gradient(b.x ^ a.y ^ a.z);
    let g010 = gradient(a.x ^ b.y ^ a.z);
    let g110 = gradient(b.x ^ b.y ^ a.z);
    let g001 = gradient(a.x ^ a.y ^ b.z);
    let g101 = gradient(b.x ^ a.y ^ b.z);
    let g011 = gradient(a.x ^ b.y ^ b.z);
    let g111 = gradient(b.x ^ b.y ^ b.z);
    let v000 = dot(g000, f);
    let v100 = dot(g100, vec3<f32>(g.x, f.y, f.z));
    let v010 = dot(g010, vec3<f32>(f.x, g.y, f.z));
    let v110 = dot(g110, vec3<f32>(g.x, g.y, f.z));
    let v001 = dot(g001, vec3<f32>(f.x, f.y, g.z));
    let v101 = dot(g101, vec3<f32>(g.x, f.y, g.z));
    let v011 = dot(g011, vec3<f32>(f.x, g.y, g.z));
    let v111 = dot(g111, g);
    let x00 = mix(v000, v100, t.x);
    let x10 = mix(v010, v110, t.x);
    let x01 = mix(v001, v101, t.x);
    let x11 = mix(v011, v111, t.x);
    let y0 = mix(x00, x10, t.y);
    let y1 = mix(x01, x11, t.y);
    let value = mix(y0, y1, t.z);
#ifdef STAIN_METAL
    let dt = 30.0 * f * f * (f * (f - 2.0) + 1.0);
    let s0 = mix(mix(g000, g100, t.x), mix(g010, g110, t.x), t.y);
    let s1 = mix(mix(g001, g101, t.x), mix(g011, g111, t.x), t.y);
    let along_x = mix(mix(v100 - v000, v110 - v010, t.y), mix(v101 - v001, v111 - v011, t.y), t.z);
    let along_y = mix(x10 - x00, x11 - x01, t.z);
    let along_z = y1 - y0;
    return vec4<f32>(mix(s0, s1, t.z) + dt * vec3<f32>(along_x, along_y, along_z), value);
#else
    return vec4<f32>(vec3<f32>(0.0), value);
#endif
}

// Pattern at `p` with grains that are `stretch` times as long along `direction`, a unit vector or zero.
fn grain(p: vec3<f32>, direction: vec3<f32>, stretch: f32, octaves: Octaves, footprint: f32) -> Grain {
    return sum_octaves(p, direction, 1.0, stretch, octaves, footprint);
}

// Pattern at `p` with grains that are `stretch` times as long at right angles to `direction`.
fn level_grain(p: vec3<f32>, direction: vec3<f32>, stretch: f32, octaves: Octaves, footprint: f32) -> Grain {
    return sum_octaves(p, direction, stretch, 1.0, octaves, footprint);
}

// Sums three octaves. Grains are `along` times their size along `direction`, and `across` times their size at right
// angles to it.
fn sum_octaves(
    p: vec3<f32>,
    direction: vec3<f32>,
    across: f32,
    along: f32,
    octaves: Octaves,
    footprint: f32,
) -> Grain {
    let p_along = direction * dot(direction, p);
    let p_across = p - p_along;
    var sum = vec4<f32>(0.0);
    var kept = 0.0;
    var all = 0.0;
    for (var i = 0u; i < 3u; i++) {
        let size = octaves.sizes[i];
        let weight = octaves.weights[i];
        let seen = weight * (1.0 - smoothstep(0.35, 1.0, footprint / size));
        if seen > 0.0 {
            let n = noise(p_across / (size * across) + p_along / (size * along) + 19.37 * f32(i));
            let slope_along = direction * dot(direction, n.xyz);
            let slope = (n.xyz - slope_along) / (size * across) + slope_along / (size * along);
            sum += seen * vec4<f32>(slope, n.w);
        }
        kept += seen * seen;
        all += weight * weight;
    }
    let scale = LOGISTIC / (DEVIATION * sqrt(all));
    let value = 1.0 / (1.0 + exp(-scale * sum.w));
    return Grain(value, value * (1.0 - value) * scale * sum.xyz, kept / all);
}

// Share of the place that a stain of `amount` (0 to 1) covers.
fn cover(g: Grain, amount: f32, softness: f32) -> f32 {
    let soft = min(softness, min(amount, 1.0 - amount)) + 1e-4;
    let threshold = 1.0 - g.value;
    return mix(amount, smoothstep(threshold - soft, threshold + soft, amount), g.kept);
}

// Value of a pattern, scaled to the range from `middle - swing` to `middle + swing`.
fn around(g: Grain, middle: f32, swing: f32) -> f32 {
    return middle + swing * (2.0 * g.value - 1.0);
}
