//! A prop has the same cracks whatever its size, and wherever it is. Needs no engine: `cargo core --test scales`.

use bevy_coating::{
    film::FilmMesh,
    remesh::{FilmTarget, build_film, sample},
    settings::{CoatingSettings, Rules},
    sim::FilmState,
    stain::Environment,
    surface::{BuildError, Surface},
};
use bevy_math::Vec3;

const SEEDS: std::ops::Range<u64> = 1..7;

/// Means over seeds at age 1 of a plate with sides of `size`, with its middle at `offset` along each axis: crack length
/// over size, and the shares that have separated and that are gone.
fn figures(size: f32, offset: f32, rules: Rules) -> [f64; 3] {
    let mut settings = CoatingSettings::default();
    settings.scale.rules = rules;
    settings.scale.grain = 0.1 * size;
    let mut sums = [0.0; 3];
    for seed in SEEDS {
        let piece = sample::plate(1500, seed).expect("a plate");
        let positions = piece.film.positions.iter().map(|&p| size * p + Vec3::splat(offset)).collect();
        let mesh = FilmMesh::new(positions, &piece.film.triangles).expect("a manifold");
        let mut film = FilmState::from_mesh(mesh, &settings, seed, 500);
        film.age_to(1.0, &settings, &Environment::default());
        film.validate().unwrap_or_else(|error| panic!("{size} m at {offset} m: {error}"));
        let figures = film.measure();
        let gone = figures.stripped.unwrap_or_default() + figures.fallen.unwrap_or_default();
        let found = [figures.crack_length.unwrap_or_default(), figures.separated.unwrap_or_default(), gone];
        sums.iter_mut().zip(found).for_each(|(sum, found)| *sum += found / SEEDS.count() as f64);
    }
    sums
}

#[test]
fn the_size_and_the_place_of_a_prop_do_not_matter() {
    let mut wrong = Vec::new();
    for rules in [Rules::Grain, Rules::Paper] {
        let metre = figures(1.0, 0.0, rules);
        assert!(metre[0] > 2.0 && metre[1] > 0.5 && metre[2] > 0.01, "it cracks: {metre:?}");
        for (size, offset) in [(1e-4, 0.0), (1e4, 0.0), (1e4, 1e5), (1e3, 1e5)] {
            let found = figures(size, offset, rules);
            eprintln!("{rules:?}, {size} m at {offset} m: {found:.4?}, 1 m at 0: {metre:.4?}");
            if found.iter().zip(metre).any(|(found, metre)| (found / metre - 1.0).abs() > 0.02) {
                wrong.push(format!("{rules:?}, {size} m at {offset} m: {found:?} for {metre:?}"));
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Coordinates so far away are told apart by 8 mm only.
#[test]
fn a_prop_of_a_metre_at_a_hundred_kilometres_is_refused_or_whole() {
    let at = |p: Vec3| p + Vec3::splat(1e5);
    let surface = Surface {
        positions: [Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y].map(at).to_vec(),
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        ..Surface::default()
    };
    let settings = CoatingSettings::default();
    for (triangles, is_taken) in [(20, true), (20_000, false)] {
        match build_film(&surface, FilmTarget::Triangles(triangles), 7) {
            Ok(built) => {
                assert!(is_taken, "{triangles} triangles");
                let mut film = FilmState::new(&built, &settings, 7, 100).expect("a manifold");
                film.age_to(1.0, &settings, &Environment::default());
                film.validate().expect("a film in order");
            }
            Err(BuildError::FarFromOrigin { .. }) => assert!(!is_taken, "{triangles} triangles"),
            Err(other) => panic!("{other}"),
        }
    }
}
