//! Checks the shading of stains, place by place and on average.

use bevy_math::Vec3;

use super::*;

const PAINT: SurfaceShading = SurfaceShading {
    base_color: Vec3::new(0.6, 0.62, 0.58),
    metallic: 0.0,
    roughness: 0.4,
    reflectance: 0.5,
    height: 0.0,
};

fn pattern() -> StainPattern {
    StainPattern::new(11, Vec3::NEG_Y * 3.0)
}

/// Places on a plate of 40 cm.
fn plate() -> impl Iterator<Item = Vec3> {
    (0..80 * 80).map(|i| Vec3::new((i % 80) as f32 * 0.005 + 0.0013, (i / 80) as f32 * 0.005 + 0.0007, 0.01))
}

fn mean(shadings: impl Iterator<Item = SurfaceShading>) -> SurfaceShading {
    let mut sum =
        SurfaceShading { base_color: Vec3::ZERO, metallic: 0.0, roughness: 0.0, reflectance: 0.0, height: 0.0 };
    let mut count = 0.0;
    for shading in shadings {
        sum.base_color += shading.base_color;
        sum.metallic += shading.metallic;
        sum.roughness += shading.roughness;
        sum.reflectance += shading.reflectance;
        sum.height += shading.height;
        count += 1.0;
    }
    SurfaceShading {
        base_color: sum.base_color / count,
        metallic: sum.metallic / count,
        roughness: sum.roughness / count,
        reflectance: sum.reflectance / count,
        height: sum.height / count,
    }
}

fn stained(s: StainSample) -> SurfaceShading {
    let shading = FilmShading::default();
    mean(plate().map(|rest| shading.film(PAINT, &StainSample { rest, ..s }, &pattern())))
}

fn metal(corrosion: f32) -> SurfaceShading {
    let shading = FilmShading::default();
    mean(plate().map(|rest| shading.metal(&StainSample { corrosion, rest, ..StainSample::default() }, &pattern())))
}

#[test]
fn clean_paint_and_primer_are_what_they_were() {
    let shading = FilmShading::default();
    for rest in plate() {
        let s = StainSample { rest, ..StainSample::default() };
        assert_eq!(shading.film(PAINT, &s, &pattern()), PAINT);
        assert_eq!(shading.back(PAINT, &s, &pattern()), PAINT);
    }
}

#[test]
fn stains_begin_without_a_jump() {
    let shading = FilmShading::default();
    let little = StainSample { rust: 1e-4, dust: 1e-4, moisture: 1e-4, corrosion: 1e-4, ..StainSample::default() };
    for rest in plate() {
        let s = StainSample { rest, ..little };
        for found in [shading.film(PAINT, &s, &pattern()), shading.back(PAINT, &s, &pattern())] {
            assert!(found.base_color.abs_diff_eq(PAINT.base_color, 5e-3), "{found:?}");
        }
        let clean = StainSample { rest, ..StainSample::default() };
        let (steel, touched) = (shading.metal(&clean, &pattern()), shading.metal(&s, &pattern()));
        assert!(steel.base_color.abs_diff_eq(touched.base_color, 5e-3), "{steel:?} {touched:?}");
    }
}

#[test]
fn rust_turns_paint_orange_then_brown_and_rough() {
    let [thin, some, thick] = [0.05, 0.4, 2.0].map(|rust| stained(StainSample { rust, ..StainSample::default() }));
    let warmth = |shading: &SurfaceShading| shading.base_color.x / shading.base_color.z;
    assert!(warmth(&PAINT) < 1.1 && warmth(&thin) > warmth(&PAINT) && warmth(&some) > 1.5, "{thin:?} {some:?}");
    assert!(thick.base_color.x < 0.5 * PAINT.base_color.x, "dark where thick: {thick:?}");
    assert!(PAINT.roughness < thin.roughness && thin.roughness < thick.roughness);
}

#[test]
fn thin_rust_is_orange_on_white_and_never_green_on_blue() {
    let shading = FilmShading::default();
    for (name, paint) in [("white", Vec3::splat(0.8)), ("blue", Vec3::new(0.02, 0.08, 0.4))] {
        let base = SurfaceShading { base_color: paint, ..PAINT };
        for rust in [0.1, 0.3, 1.0] {
            for rest in plate() {
                let s = StainSample { rust, rest, ..StainSample::default() };
                let [r, g, b] = shading.film(base, &s, &pattern()).base_color.to_array();
                assert!(g <= r.max(b) + 1e-4, "{name}, {rust} layers: {r} {g} {b} is green");
                assert!(name == "blue" || (r >= g && g >= b), "{rust} layers: {r} {g} {b} is not orange");
            }
        }
    }
}

#[test]
fn cover_follows_the_papers_mix_on_average() {
    // Roughness shows how much is covered.
    let shading = FilmShading {
        stains: StainShading { rust_roughness: 1.0, ..StainShading::default() },
        ..FilmShading::default()
    };
    let smooth = SurfaceShading { roughness: 0.0, ..PAINT };
    for rust in [0.05f32, 0.2, 0.5, 1.5] {
        let s = |rest| StainSample { rust, rest, ..StainSample::default() };
        let covered = mean(plate().map(|rest| shading.film(smooth, &s(rest), &pattern()))).roughness;
        let expected = 0.85 * (1.0 - bevy_math::ops::exp(-3.0 * rust));
        assert!((covered - expected).abs() < 0.15 * expected, "{rust} layers: {covered} instead of {expected}");
    }
}

#[test]
fn run_off_is_streaked_down_the_surface() {
    let shading = FilmShading::default();
    // Upright, and leaning back by 45 degrees to where no upright plane of the pattern looks.
    let leaning = Vec3::new(0.6, 1.0, 0.8).normalize();
    for normal in [Vec3::Z, leaning] {
        let level = Vec3::NEG_Y.cross(normal).normalize();
        let down = level.cross(normal).normalize();
        let at = |p: Vec3| {
            let rest = level * p.x + down * p.y;
            let s = StainSample { rust: 0.25, rest, normal, ..StainSample::default() };
            shading.film(PAINT, &s, &pattern()).base_color
        };
        let change = |step: Vec3| -> f32 { plate().map(|p| (at(p) - at(p + step)).length()).sum() };
        let (along, across) = (change(Vec3::Y * 0.004), change(Vec3::X * 0.004));
        // The veil between the threads is mottled, on purpose, so that it does not read as the grain of wood.
        assert!(across > 2.0 * along, "{normal}: {along} along, {across} across");
    }
}

#[test]
fn dust_darkens_and_dulls_and_water_glosses() {
    let dusty = stained(StainSample { dust: 0.6, ..StainSample::default() });
    assert!(dusty.base_color.x < 0.7 * PAINT.base_color.x && dusty.reflectance < 0.8 * PAINT.reflectance, "{dusty:?}");
    let wet = stained(StainSample { moisture: 0.9, ..StainSample::default() });
    assert!(wet.base_color.x < 0.85 * PAINT.base_color.x && wet.roughness < 0.25, "{wet:?}");
}

#[test]
fn metal_goes_from_steel_through_dark_to_orange() {
    let [steel, dark, orange] = [0.0, 0.3, 1.0].map(metal);
    assert!(steel.metallic > 0.85 && dark.metallic < 0.5 && orange.metallic < 0.1, "{steel:?} {dark:?} {orange:?}");
    assert!(dark.base_color.x < 0.5 * steel.base_color.x);
    assert!(orange.base_color.x > 3.0 * orange.base_color.z && orange.roughness > 0.8 && orange.height > 5e-5);
}

#[test]
fn a_wide_footprint_gives_the_mean() {
    let shading = FilmShading::default();
    let wide = pattern().with_footprint(0.5);
    let s = StainSample { rust: 0.3, dust: 0.3, moisture: 0.2, corrosion: 0.6, ..StainSample::default() };
    let point = shading.film(PAINT, &s, &wide);
    let all = mean(plate().map(|rest| shading.film(PAINT, &StainSample { rest, ..s }, &pattern())));
    assert!(point.base_color.abs_diff_eq(all.base_color, 0.05), "{point:?} {all:?}");
    assert_eq!(
        point,
        shading.film(PAINT, &StainSample { rest: Vec3::ONE, ..s }, &wide),
        "nothing is left of the noise"
    );
}

#[test]
fn patterns_are_the_seeds() {
    assert_eq!(StainPattern::new(3, Vec3::Y * 2.0), StainPattern::new(3, Vec3::Y));
    assert_ne!(StainPattern::new(3, Vec3::Y).offset, StainPattern::new(4, Vec3::Y).offset);
    assert_eq!(StainPattern::new(3, Vec3::ZERO).streaks, Vec3::ZERO);
}

/// Returns the red light that run-off of `rust` layers takes away at each place of the plate.
fn darkening(rust: f32) -> Vec<f32> {
    let shading = FilmShading::default();
    let color = |rest| {
        let s = StainSample { rust, rest, normal: Vec3::Z, ..StainSample::default() };
        shading.film(PAINT, &s, &pattern()).base_color
    };
    plate().map(|rest| PAINT.base_color.x - color(rest).x).collect()
}

#[test]
fn threads_are_few_and_only_grow_with_the_rust() {
    let darks = [0.05, 0.15, 0.3, 0.8].map(darkening);
    for pair in darks.windows(2) {
        let kept = pair[0].iter().zip(&pair[1]).all(|(less, more)| less <= &(more + 1e-3));
        assert!(kept, "a thread that is there with less rust is there with more");
    }
    for (dark, most) in darks.iter().zip([0.15, 0.25, 0.35, 0.6]) {
        let deepest = dark.iter().copied().fold(0.0, f32::max);
        let thread = dark.iter().filter(|&&d| d > 0.5 * deepest).count() as f32 / dark.len() as f32;
        assert!(thread > 0.01 && thread < most, "threads take {thread}");
    }
}

#[test]
fn between_threads_lies_a_veil() {
    let mut dark = darkening(0.3);
    dark.sort_unstable_by(f32::total_cmp);
    let at = |share: f32| dark[(share * dark.len() as f32) as usize];
    assert!(at(0.02) > 0.02, "no place is clean");
    // Streaks of equal weight would be about as often dark as light.
    assert!(at(0.99) > 1.8 * at(0.5) && at(0.5) < 1.8 * at(0.1), "{} {} {}", at(0.1), at(0.5), at(0.99));
}

#[test]
fn threads_are_dark_inside_and_orange_at_their_edges() {
    let shading = FilmShading::default();
    let white = SurfaceShading { base_color: Vec3::splat(0.8), ..PAINT };
    let at = |rest| {
        let s = StainSample { rust: 0.5, rest, normal: Vec3::Z, ..StainSample::default() };
        shading.film(white, &s, &pattern()).base_color
    };
    // From the lightest to the darkest place, along a level line.
    let mut colors: Vec<Vec3> = (0..4000).map(|i| at(Vec3::new(i as f32 * 1e-4, 0.13, 0.01))).collect();
    colors.sort_unstable_by(|a, b| a.element_sum().total_cmp(&b.element_sum()));
    let chroma = |c: &Vec3| c.x - c.z;
    let (inside, edge) = (colors[40], colors[1600]);
    assert!(inside.x < 0.12, "brown-black: {inside}");
    assert!(chroma(&edge) > 3.0 * chroma(&inside) && edge.x > 1.5 * edge.y, "orange: {edge}, inside {inside}");
}
