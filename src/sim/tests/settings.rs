//! Tests that every setting acts on a film under way.

use bevy_math::Vec3;

use super::quick;
use crate::{
    film::FilmMesh,
    remesh::sample,
    settings::{CoatingSettings, Field, Rules},
    sim::state::FilmState,
    stain::{Environment, StainLayer},
};

/// Settings in whose effect a film of ages 0.4 to 0.9 shows, and weather in which it does.
fn weather() -> Environment {
    Environment { rain: Vec3::new(0.5, -0.6, 0.2), sun: Vec3::new(-0.5, -0.2, -0.7), ..Environment::default() }
}

/// Makes a curved film, so that its shape counts too.
fn curved(triangles: u32, seed: u64, settings: &CoatingSettings) -> FilmState {
    let piece = sample::curved_plate(triangles, seed).unwrap();
    FilmState::new(&piece.film, settings, seed, 100).unwrap()
}

/// Returns a value of `field` that is not that of `settings`, and far enough from it to be seen.
fn other(field: &Field, settings: &CoatingSettings) -> f32 {
    let (value, range) = (field.get(settings), field.range);
    let other = match (range.min, range.max) {
        (0.0, 1.0) if (value - 0.5).abs() < 0.1 => 0.1,
        (0.0, 1.0) => 1.0 - value,
        (-1.0, 1.0) => -value,
        // A little wider a neck need not find another flap on a film of 800 triangles.
        _ if field.path == "tearing.neck_width" => 3.0 * value,
        _ if range.whole => 2.0 * value,
        _ if value == 0.0 => 5.0,
        _ => 1.6 * value,
    };
    assert!(range.contains(other) && other != value, "{}: {other}", field.path);
    other
}

/// Returns quick settings with the rules by which `field` acts, and a grain of about the mean edge of [`curved`].
fn rules_of(field: &Field) -> CoatingSettings {
    let by_grain =
        ["scale.grain", "adhesion.wavelength", "tearing.relief", "tearing.memory", "tearing.neck", "deform.curl_reach"];
    let by_grain = by_grain.iter().any(|path| field.path.starts_with(path)) || field.path.starts_with("stripping.hold");
    let mut settings = quick();
    settings.scale.grain = 0.055;
    settings.scale.rules = if by_grain { Rules::Grain } else { Rules::Paper };
    settings
}

/// Returns cracks, shape and stains of a film: everything that can be seen of it.
fn looks(film: &FilmState) -> (&FilmMesh, [&StainLayer; 2], &[f32]) {
    (&film.mesh, [&film.stains.film, &film.stains.metal], &film.stains.corrosion)
}

#[test]
fn every_setting_acts_on_a_film_under_way() {
    for rules in [Rules::Paper, Rules::Grain] {
        let fields: Vec<_> = CoatingSettings::fields().filter(|field| rules_of(field).scale.rules == rules).collect();
        let settings = rules_of(fields[0]);
        let mut start = curved(800, 4, &settings);
        start.age_to(0.4, &settings, &weather());
        let mut unchanged = start.clone();
        unchanged.age_to(0.9, &settings, &weather());
        for field in fields {
            let mut changed = settings.clone();
            field.set(&mut changed, other(field, &settings)).unwrap();
            let mut film = start.clone();
            film.age_to(0.9, &changed, &weather());
            film.validate().unwrap_or_else(|error| panic!("{}: {error}", field.path));
            assert!(looks(&film) != looks(&unchanged), "{} changes nothing", field.path);
        }
    }
}

#[test]
fn a_change_there_and_back_changes_no_bit() {
    let settings = quick();
    let mut film = curved(800, 4, &settings);
    film.age_to(0.6, &settings, &weather());
    film.forces.set_adhesion(crate::film::VertexId(5), 3.0);
    let before = film.digest();
    let mut all = settings.clone();
    // By the grain, some edges do not decay; what decayed until then is rounded another way after a change there and
    // back.
    for field in CoatingSettings::fields().filter(|field| !field.path.starts_with("scale.")) {
        let mut changed = settings.clone();
        field.set(&mut changed, other(field, &settings)).unwrap();
        field.set(&mut all, other(field, &settings)).unwrap();
        film.forces.follow_settings(&film.mesh, &changed);
        film.forces.follow_settings(&film.mesh, &settings);
        assert_eq!(film.digest(), before, "{}", field.path);
    }
    film.forces.follow_settings(&film.mesh, &all);
    assert_ne!(film.digest(), before);
    film.forces.follow_settings(&film.mesh, &settings);
    assert_eq!(film.digest(), before, "all at once");
}

#[test]
fn settings_that_change_all_the_time_heal_nothing_and_break_nothing() {
    for seed in 1..=3u64 {
        let mut settings = quick();
        let mut film = curved(400, seed, &settings);
        let fields: Vec<&Field> = CoatingSettings::fields().collect();
        let (mut torn, mut separated) = (Vec::new(), Vec::new());
        let mut draw = crate::deform::tests::draw::Draw(seed);
        for step in 0..150 {
            if step % 5 == 0 {
                let field = fields[draw.below(fields.len() as u32) as usize];
                let defaults = quick();
                let value = if draw.below(3) == 0 { field.get(&defaults) } else { other(field, &defaults) };
                field.set(&mut settings, value).unwrap();
            }
            film.step(&settings, &weather());
            film.validate().unwrap_or_else(|error| panic!("seed {seed}, step {step}: {error}"));
            let topology = &film.mesh.topology;
            assert!(
                torn.iter().all(|&h| topology.is_torn(h)) && separated.iter().all(|&v| !film.forces.is_attached(v))
            );
            torn.extend(film.changes.torn.iter().copied());
            separated.extend(film.changes.separated.iter().copied());
        }
        assert!(torn.len() > 20);
    }
}
