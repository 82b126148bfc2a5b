//! Black stains over whole runs: where dust gathers, and that it follows film that moves.

use super::*;
use crate::settings::DustSettings;

#[test]
fn dust_gathers_low_and_on_top_of_things() {
    let (positions, triangles) = crate::film::tests::sphere(3);
    let mesh = FilmMesh::new(positions, &triangles).unwrap();
    let mut settings = held();
    let aged = |settings: &CoatingSettings, environment: &Environment| {
        let mut film = film_of(mesh.clone(), settings, 50);
        film.age_to(1.0, settings, environment);
        film.validate().unwrap();
        film
    };
    settings.dust.height = 0.0;
    let film = aged(&settings, &Environment::default());
    let at = |film: &FilmState, place: Vec3| film.stains.film.dust[nearest(film, place).index()];
    assert!(at(&film, Vec3::Y) > 1.5 * at(&film, Vec3::NEG_Y), "soot lies on top");
    let turned = aged(&settings, &Environment::still(Vec3::Z));
    assert!(at(&turned, Vec3::NEG_Z) > 1.5 * at(&turned, Vec3::Z), "and gravity says where that is");
    (settings.dust.height, settings.dust.direction) = (1.0, 0.0);
    let film = aged(&settings, &Environment::default());
    assert!(at(&film, Vec3::NEG_Y) > 1.5 * at(&film, Vec3::Y), "or at the foot");
}

#[test]
fn dust_follows_film_that_moves() {
    let mut settings = held();
    settings.deform.sweeps_per_age = 4000.0;
    settings.dust.height = 0.0;
    let mut film = plate(400, &settings, 100);
    crack(&mut film, Vec3::new(-0.2, 0.0, 0.0), Vec3::new(0.2, 0.0, 0.0));
    film.age_to(0.6, &settings, &Environment::default());
    let dust = &film.stains.film.dust;
    let (least, most) = dust.iter().fold((1.0f32, 0.0f32), |(low, high), &d| (low.min(d), high.max(d)));
    assert!(most > 1.3 * least, "flakes face up and down: {least} to {most}");
    let flat = {
        settings.deform.sweeps_per_age = 0.0;
        let mut film = plate(400, &settings, 100);
        film.age_to(0.6, &settings, &Environment::default());
        film.stains.film.dust.clone()
    };
    assert!(flat.iter().all(|d| (d - flat[0]).abs() < 1e-5), "a flat plate is dusty all alike");
}

#[test]
fn gravity_of_any_length_keeps_dust_in_its_range() {
    let settings = CoatingSettings { dust: DustSettings { direction: 1.0, ..DustSettings::default() }, ..held() };
    let (positions, triangles) = crate::film::tests::sphere(2);
    let mesh = FilmMesh::new(positions, &triangles).unwrap();
    let aged = |gravity: Vec3| {
        let mut film = film_of(mesh.clone(), &settings, 50);
        crack(&mut film, Vec3::Y, Vec3::X);
        film.age_to(0.5, &settings, &Environment::still(gravity));
        film.validate().unwrap_or_else(|error| panic!("{gravity}: {error}"));
        film
    };
    let unit = aged(Vec3::NEG_Y);
    for length in [1e-30, 0.1, 9.81, 1e20] {
        assert_eq!(aged(Vec3::NEG_Y * length).stains.film.dust, unit.stains.film.dust, "gravity {length}");
    }
    for odd in [Vec3::NAN, Vec3::splat(f32::INFINITY)] {
        assert_eq!(aged(odd).digest(), aged(Vec3::ZERO).digest(), "gravity {odd}");
    }
}
