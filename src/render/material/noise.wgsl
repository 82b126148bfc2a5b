// Gradient noise with its slope, and patterns made of it: the twin of `src/shown/look/noise.rs`.
#define_import_path bevy_coating::noise

// Standard deviation of the noise, and the logistic curve that is closest to the normal distribution.
const DEVIATION: f32 = 0.1887;
const LOGISTIC: f32 = 1.702;

// Three octaves of grains: size in metres and weight of each.
struct Octaves {
    sizes: vec3<f32>,
    weights: vec3<f32>,
}

// A pattern at one place: spread evenly over 0 to 1, its slope in the metric that the place was given in, and the share
// of it that can be seen.
struct Grain {
    value: f32,
    slope: vec3<f32>,
    kept: f32,
}

// A random number for three.
fn hash(p: vec3<u32>) -> u32 {
    var h = (p.x * 0x9e3779b1u) ^ (p.y * 0x85ebca77u) ^ (p.z * 0xc2b2ae3du);
    h = (h ^ (h >> 16u)) * 0x85ebca6bu;
    h = (h ^ (h >> 13u)) * 0xc2b2ae35u;
    return h ^ (h >> 16u);
}

fn of_level(level: f32) -> f32 {
    return f32(hash(vec3<u32>(u32(i32(level)), 7u, 13u)) & 1023u) / 1023.0;
}

fn gradient(p: vec3<u32>) -> vec3<f32> {
    let h = hash(p);
    return vec3<f32>(vec3<u32>(h & 1023u, (h >> 10u) & 1023u, (h >> 20u) & 1023u)) / 511.5 - 1.0;
}

// Slope and value.
fn noise(p: vec3<f32>) -> vec4<f32> {
    let cell = floor(p);
    let f = p - cell;
    let t = f * f * f * (f * (f * 6.0 - 15.0) + 10.0);
    let dt = 30.0 * f * f * (f * (f - 2.0) + 1.0);
    let c = vec3<u32>(vec3<i32>(cell));
    let g000 = gradient(c);
    let g100 = gradient(c + vec3<u32>(1u, 0u, 0u));
    let g010 = gradient(c + vec3<u32>(0u, 1u, 0u));
    let g110 = gradient(c + vec3<u32>(1u, 1u, 0u));
    let g001 = gradient(c + vec3<u32>(0u, 0u, 1u));
    let g101 = gradient(c + vec3<u32>(1u, 0u, 1u));
    let g011 = gradient(c + vec3<u32>(0u, 1u, 1u));
    let g111 = gradient(c + vec3<u32>(1u, 1u, 1u));
    let v000 = vec4<f32>(g000, dot(g000, f));
    let v100 = vec4<f32>(g100, dot(g100, f - vec3<f32>(1.0, 0.0, 0.0)));
    let v010 = vec4<f32>(g010, dot(g010, f - vec3<f32>(0.0, 1.0, 0.0)));
    let v110 = vec4<f32>(g110, dot(g110, f - vec3<f32>(1.0, 1.0, 0.0)));
    let v001 = vec4<f32>(g001, dot(g001, f - vec3<f32>(0.0, 0.0, 1.0)));
    let v101 = vec4<f32>(g101, dot(g101, f - vec3<f32>(1.0, 0.0, 1.0)));
    let v011 = vec4<f32>(g011, dot(g011, f - vec3<f32>(0.0, 1.0, 1.0)));
    let v111 = vec4<f32>(g111, dot(g111, f - vec3<f32>(1.0, 1.0, 1.0)));
    let x00 = mix(v000, v100, t.x);
    let x10 = mix(v010, v110, t.x);
    let x01 = mix(v001, v101, t.x);
    let x11 = mix(v011, v111, t.x);
    let y0 = mix(x00, x10, t.y);
    let y1 = mix(x01, x11, t.y);
    let along_x = mix(mix(v100.w - v000.w, v110.w - v010.w, t.y), mix(v101.w - v001.w, v111.w - v011.w, t.y), t.z);
    let along_y = mix(x10.w - x00.w, x11.w - x01.w, t.z);
    let along_z = y1.w - y0.w;
    return mix(y0, y1, t.z) + vec4<f32>(dt * vec3<f32>(along_x, along_y, along_z), 0.0);
}

// A pattern at `p`, whose grains are `stretch` times as long along `direction`, a unit vector or zero.
fn grain(p: vec3<f32>, direction: vec3<f32>, stretch: f32, octaves: Octaves, footprint: f32) -> Grain {
    return sum_octaves(p, direction, 1.0, stretch, octaves, footprint);
}

// A pattern at `p`, whose grains are `stretch` times as long along all that is at right angles to `direction`.
fn level_grain(p: vec3<f32>, direction: vec3<f32>, stretch: f32, octaves: Octaves, footprint: f32) -> Grain {
    return sum_octaves(p, direction, stretch, 1.0, octaves, footprint);
}

// Grains `across` as wide and `along` as long along `direction` as their size.
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

// Share that something of amount 0 to 1 covers here.
fn cover(g: Grain, amount: f32, softness: f32) -> f32 {
    let soft = min(softness, min(amount, 1.0 - amount)) + 1e-4;
    let threshold = 1.0 - g.value;
    return mix(amount, smoothstep(threshold - soft, threshold + soft, amount), g.kept);
}

fn around(g: Grain, middle: f32, swing: f32) -> f32 {
    return middle + swing * (2.0 * g.value - 1.0);
}
