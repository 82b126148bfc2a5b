//! The films: a plate, a curved plate in the weather, and a prop as games have them.

use bevy_coating::{
    bake::{BakeOptions, Images, Input, coat},
    remesh::{FilmResolution, sample},
    settings::{CoatingSettings, Preset},
    sim::FilmState,
    stain::Environment,
};
use bevy_math::Vec3;

pub const AGES: [f64; 3] = [0.25, 0.5, 1.0];

const STEPS_PER_AGE: u32 = 500;
const SEED: u64 = 7;

pub struct Film {
    pub name: &'static str,
    pub settings: CoatingSettings,
    pub environment: Environment,
    /// Makes the film, fresh.
    pub make: fn() -> FilmState,
}

pub fn all() -> [Film; 3] {
    let weather = Environment {
        wind: Vec3::new(0.4, 0.0, 0.1),
        gusts: 0.02,
        rain: Vec3::new(0.3, -0.8, -0.2),
        sun: Vec3::new(0.0, -0.5, -0.6),
        ..Environment::default()
    };
    [
        Film {
            name: "plate",
            settings: CoatingSettings::default(),
            environment: Environment::default(),
            make: || {
                let piece = sample::plate(1500, SEED).expect("a plate");
                FilmState::new(&piece.film, &CoatingSettings::default(), SEED, STEPS_PER_AGE).expect("a manifold")
            },
        },
        Film {
            name: "curved",
            settings: CoatingSettings::from(Preset::Heavy),
            environment: weather,
            make: || {
                let (piece, settings) = (sample::curved_plate(1000, SEED).expect("a plate"), Preset::Heavy.into());
                FilmState::new(&piece.film, &settings, SEED, STEPS_PER_AGE).expect("a manifold")
            },
        },
        Film { name: "hydrant", settings: Preset::Paper.into(), environment: weather, make: hydrant },
    ]
}

/// The largest part of a prop: read, cleaned and remeshed as for a game.
fn hydrant() -> FilmState {
    let input = Input::parse("assets/props/prop_firehydrant.glb".as_ref()).expect("a path");
    let model = input.read(SEED, Images::Skip).expect("a prop");
    let options = BakeOptions {
        resolution: FilmResolution::Triangles(2000),
        settings: Preset::Paper.into(),
        steps: STEPS_PER_AGE,
        seed: SEED,
        ..BakeOptions::default()
    };
    let films = coat(&model.origin, model.meshes, &options).expect("films").films;
    films.into_iter().max_by_key(|film| film.mesh.topology.face_count()).expect("a film")
}
