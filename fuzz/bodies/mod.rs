//! What each fuzz target does with its bytes. Public functions alone, so that the same runs in tests and in fuzzers.
#![allow(dead_code, unused_imports, reason = "each fuzz target uses one of these")]

mod input;
mod journey;
mod saved;
mod texts;

use bevy_coating::{
    bake::{Images, Model},
    remesh::{FilmTarget, build_film},
    settings::CoatingSettings,
    sim::FilmState,
    stain::Environment,
    surface::{Surface, clean},
};

use input::Input;

pub use journey::journey;
pub use saved::{recording, snapshot};
pub use texts::{extras, masks};

/// Makes a film of a mesh, and lets it age a little.
pub fn film(bytes: &[u8]) {
    let mut input = Input(bytes);
    let (vertices, target, seed) = (usize::from(input.byte() % 64), input.byte(), u64::from(input.byte()));
    let positions = (0..vertices).map(|_| input.vector()).collect();
    let mut triangles = Vec::new();
    while !input.is_empty() && triangles.len() < 200 {
        // Now and then a vertex that does not exist.
        triangles.push([(); 3].map(|()| u32::from(input.byte()) % (vertices as u32 + 1)));
    }
    let surface = Surface { positions, triangles, ..Surface::default() };
    let target = if target % 4 == 0 { FilmTarget::Keep } else { FilmTarget::Triangles(u32::from(target) * 4) };
    let Ok(built) = build_film(&surface, target, seed) else { return };
    let settings = CoatingSettings::default();
    let mut film = FilmState::new(&built, &settings, seed, 20).expect("built films are manifolds");
    film.age_to(0.5, &settings, &Environment::default());
    film.validate().expect("a film in order");
}

/// Reads settings.
pub fn settings(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    match CoatingSettings::from_ron(&text, "fuzz.coating.ron") {
        Ok(settings) => settings.validate().expect("what was read is in range"),
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}

/// Reads a Wavefront file.
pub fn obj(bytes: &[u8]) {
    if let Ok(model) = Model::from_obj(bytes, "fuzz", None, Images::Skip) {
        check(&model);
    }
}

/// Reads a glTF file.
pub fn gltf(bytes: &[u8]) {
    if let Ok(model) = Model::from_gltf(bytes, None, Images::Load) {
        check(&model);
    }
}

/// Checks what readers promise of surfaces, and cleans them: positions that are not finite are named there.
fn check(model: &Model) {
    for mesh in &model.meshes {
        let count = mesh.surface.positions.len();
        assert!(mesh.surface.triangles.iter().flatten().all(|&v| (v as usize) < count), "{}: indices", mesh.name);
        match clean(&mesh.surface) {
            Ok(clean) => assert!(clean.positions.iter().all(|p| p.is_finite()), "{}: positions", mesh.name),
            Err(error) => assert!(!error.to_string().is_empty()),
        }
    }
}
