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

/// Crack length over size, and the shares that have separated and that are gone.
type Figures = [f64; 3];

/// Figures at age 1 of a plate with sides of `size`, with its middle at `offset` along each axis.
fn figures(size: f32, offset: f32, rules: Rules, seed: u64) -> Figures {
    let mut settings = CoatingSettings::default();
    settings.scale.rules = rules;
    settings.scale.grain = 0.1 * size;
    let piece = sample::plate(1500, seed).expect("a plate");
    let positions = piece.film.positions.iter().map(|&p| size * p + Vec3::splat(offset)).collect();
    let mesh = FilmMesh::new(positions, &piece.film.triangles).expect("a manifold");
    let mut film = FilmState::from_mesh(mesh, &settings, seed, 500);
    film.age_to(1.0, &settings, &Environment::default());
    film.validate().unwrap_or_else(|error| panic!("{size} m at {offset} m: {error}"));
    let figures = film.measure();
    let gone = figures.stripped.unwrap_or_default() + figures.fallen.unwrap_or_default();
    [figures.crack_length.unwrap_or_default(), figures.separated.unwrap_or_default(), gone]
}

/// Compares plates of sizes and at places with those of 1 m at the origin, over so many seeds, and says what differs by
/// more than 2 % and `errors` standard errors of the mean difference.
fn compare(places: &[(f32, f32)], seeds: u64, errors: f64) {
    let mut wrong = Vec::new();
    for rules in [Rules::Grain, Rules::Paper] {
        let all = |size, offset| (1..=seeds).map(|seed| figures(size, offset, rules, seed)).collect::<Vec<_>>();
        let mean = |of: &dyn Fn(usize) -> f64| (0..seeds as usize).map(of).sum::<f64>() / seeds as f64;
        let home = all(1.0, 0.0);
        let metre: Figures = std::array::from_fn(|k| mean(&|i| home[i][k]));
        assert!(metre[0] > 2.0 && metre[1] > 0.5 && metre[2] > 0.01, "it cracks: {metre:?}");
        for &(size, offset) in places {
            let found = all(size, offset);
            for (k, name) in ["crack length", "separated", "gone"].into_iter().enumerate() {
                let more = mean(&|i| found[i][k] - home[i][k]);
                let variance = mean(&|i| (found[i][k] - home[i][k] - more).powi(2));
                let [more, error] = [more, (variance / (seeds - 1) as f64).sqrt()].map(|x| 100.0 * x / metre[k]);
                let line = format!("{rules:?}, {size} m at {offset} m, {name}: {more:+.1} % +- {error:.1} %");
                eprintln!("{line}");
                if more.abs() > 2.0 + errors * error {
                    wrong.push(line);
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn the_size_and_the_place_of_a_prop_do_not_matter() {
    compare(&[(1e-4, 0.0), (1e4, 0.0), (1e4, 1e5), (1e3, 1e5)], 6, 0.0);
}

/// Edges of 4 m to 0.4 m where coordinates are told apart by 8 mm. What is rounded by so much cracks elsewhere, as with
/// another seed, so that few films would differ by chance. `COATING_SCALE_SEEDS` sets the number of seeds.
#[test]
fn a_prop_of_ten_metres_at_a_hundred_kilometres_cracks_elsewhere_but_as_much() {
    let seeds = std::env::var("COATING_SCALE_SEEDS").map_or(24, |seeds| seeds.parse().expect("a number of seeds"));
    compare(&[(100.0, 1e5), (50.0, 1e5), (25.0, 1e5), (10.0, 1e5)], seeds, 2.0);
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
