//! Rules that hold on any mesh at any time.

use bevy_math::Quat;
use proptest::prelude::*;

use super::*;

/// Makes a closed or open bumpy piece: a sphere or a plate, pushed in and out.
fn piece(open: bool, seed: u64, bumps: f32) -> FilmMesh {
    let (mut positions, triangles) = if open {
        let film = sample::plate(500, seed % 7).unwrap().film;
        (film.positions, film.triangles)
    } else {
        crate::film::tests::sphere(3)
    };
    let phase = seed as f32 * 0.37;
    for p in &mut positions {
        let wave = bevy_math::ops::sin(7.0 * p.x + phase) * bevy_math::ops::sin(6.0 * p.y + 2.0 * phase);
        let outwards = if open { Vec3::Z } else { p.normalize_or_zero() };
        *p += outwards * wave * bumps;
    }
    FilmMesh::new(positions, &triangles).unwrap()
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn stains_keep_their_rules_on_any_mesh(
        open in any::<bool>(),
        seed in 0u64..1000,
        bumps in 0.0f32..0.12,
        turn in prop::array::uniform4(-1.0f32..1.0),
        into_cracks in 0.0f32..=1.0,
        spread in 0.0f32..0.3,
        fall_faces in 0u32..10,
    ) {
        let gravity = (Quat::from_vec4(bevy_math::Vec4::from_array(turn) + 1e-3).normalize() * Vec3::NEG_Y).normalize();
        let environment = Environment::still(gravity);
        let mut settings = CoatingSettings::preset("heavy").unwrap();
        settings.deform.sweeps_per_age = 300.0;
        settings.rust.into_cracks = into_cracks;
        settings.rust.spread = spread;
        settings.stripping.fall_faces = fall_faces;
        let mut film = FilmState::from_mesh(piece(open, seed, bumps), &settings, seed, 100);
        let mut before = film.stains.clone();
        for _ in 0..100 {
            film.step(&settings, &environment);
            prop_assert_eq!(film.validate(), Ok(()));
            let stains = &film.stains;
            if film.forces.torn_edges == 0 {
                prop_assert!(amounts(&film).iter().all(|&amount| amount == 0.0) && sources(&film).is_empty());
                prop_assert!(stains.corrosion.iter().all(|&c| c == 0.0));
            }
            for (layer, earlier) in [(&stains.film, &before.film), (&stains.metal, &before.metal)] {
                for (v, &stained) in earlier.stained.iter().enumerate() {
                    prop_assert!(layer.stained[v] >= stained, "stains never fade by themselves");
                    prop_assert!(layer.dust[v] >= earlier.dust[v]);
                }
            }
            before = stains.clone();
        }
        // A small, flat piece without a weak edge may come off whole.
        prop_assume!(film.forces.torn_edges > 0);
        let depth = |v: VertexId| film.mesh.geometry.rest_positions[v.index()].dot(gravity);
        let known = |v: &VertexId| film.stains.sources[v.index()] != RustSource::Never;
        let highest = film.mesh.topology.all_vertices().filter(known).map(depth).fold(f32::INFINITY, f32::min);
        for v in film.mesh.topology.all_vertices() {
            let metal = film.stains.metal.stained.get(v.index()).copied().unwrap_or(0.0);
            if film.stains.film.stained[v.index()] > 0.0 || metal > 0.0 {
                prop_assert!(depth(v) >= highest, "stained above every source");
            }
        }
    }
}

#[test]
fn nothing_bleeds_on_a_plate_perpendicular_to_gravity() {
    for gravity in [Vec3::Z, Vec3::NEG_Z, Vec3::ZERO] {
        let mut settings = CoatingSettings::preset("heavy").unwrap();
        settings.deform.sweeps_per_age = 300.0;
        let mut film = plate(800, &settings, 100);
        film.age_to(1.0, &settings, &Environment::still(gravity));
        film.validate().unwrap();
        let m = film.measure();
        assert!(m.torn > Some(0.1), "{m:?}");
        assert_eq!((m.rust_emitted, m.rust_wet, m.rust_stained), (0.0, 0.0, 0.0), "{gravity}");
        assert_eq!(m.sources, 0);
    }
}

#[test]
fn the_same_seed_stains_to_the_same_bits() {
    let mut settings = CoatingSettings::from(Preset::Paper);
    settings.deform.sweeps_per_age = 300.0;
    let environment = Environment { rain: Vec3::new(0.2, -0.5, -0.5), ..Environment::default() };
    let run = || {
        let mut film = plate(600, &settings, 100);
        film.age_to(1.0, &settings, &environment);
        film.stains
    };
    assert_eq!(run(), run());
}

/// Run-off keeps a way when only a neighbour was split, and looks up by what name the neighbour goes now.
#[test]
fn ways_that_are_kept_are_those_that_would_be_found() {
    let mut settings = CoatingSettings::preset("heavy").unwrap();
    settings.deform.sweeps_per_age = 0.0;
    let environment = Environment { wind: Vec3::new(0.3, 0.0, 0.2), ..Environment::default() };
    for seed in 1..=3 {
        let mut kept = film_of(piece(false, seed, 0.05), &settings, 100);
        let mut found = kept.clone();
        for _ in 0..100 {
            kept.step(&settings, &environment);
            found.stains.forget_ways();
            found.step(&settings, &environment);
            assert_eq!((&kept.stains.film, &kept.stains.metal), (&found.stains.film, &found.stains.metal));
        }
        assert!(kept.stains.budget.emitted > 0.0 && kept.stains.budget == found.stains.budget);
    }
}
