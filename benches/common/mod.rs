//! Films to measure, made once per process.
#![allow(dead_code, reason = "each bench uses its part")]

use std::{
    collections::BTreeMap,
    sync::{Arc, Mutex, PoisonError},
};

use bevy_coating::{
    appearance::{DisplayChanges, FilmAppearance},
    deform::{FilmConstraints, update_constraints},
    film::{FilmChanges, FilmMesh, VertexId},
    remesh::sample::{self, TestPiece},
    settings::CoatingSettings,
    sim::FilmState,
    stain::Environment,
};
use divan::{Bencher, counter::ItemsCount};

/// Returns the flat test piece of so many triangles, with sides of 1.
pub fn plate(triangles: u32) -> Arc<TestPiece> {
    static PLATES: Mutex<BTreeMap<u32, Arc<TestPiece>>> = Mutex::new(BTreeMap::new());
    let mut plates = PLATES.lock().unwrap_or_else(PoisonError::into_inner);
    let make = || Arc::new(sample::plate(triangles, 1).expect("a plate"));
    plates.entry(triangles).or_insert_with(make).clone()
}

/// Makes the film of that plate, at rest.
pub fn film(triangles: u32) -> FilmMesh {
    let film = &plate(triangles).film;
    FilmMesh::new(film.positions.clone(), &film.triangles).expect("a manifold")
}

/// Returns the vertices on so large a share of a plate, from the left.
pub fn left_share(mesh: &FilmMesh, share: f32) -> impl Iterator<Item = VertexId> + '_ {
    let right = move |v: &VertexId| mesh.geometry.rest_positions[v.index()].x < share - 0.5;
    mesh.topology.all_vertices().filter(move |v| share >= 1.0 || (share > 0.0 && right(v)))
}

/// Makes the film of a plate and its constraints, after that share of it has separated from the metal.
pub fn separated(triangles: u32, share: f32) -> (FilmMesh, FilmConstraints) {
    let mesh = film(triangles);
    let mut constraints = FilmConstraints::new(&mesh);
    let mut changes = FilmChanges::default();
    changes.separated.extend(left_share(&mesh, share));
    update_constraints(&mesh, &mut constraints, &changes);
    (mesh, constraints)
}

/// Measures bringing `shown` up to date after each of so many further steps of the film. `items` are counted for all.
pub fn follow(
    bencher: Bencher,
    mut film: FilmState,
    shown: FilmAppearance,
    settings: &CoatingSettings,
    steps: usize,
    items: usize,
) {
    let steps: Vec<(FilmState, DisplayChanges)> = (0..steps)
        .map(|_| {
            let mut changes = DisplayChanges::default();
            changes.record(&film.changes, &film.stains);
            changes.take();
            film.step(settings, &Environment::default());
            changes.record(&film.changes, &film.stains);
            (film.clone(), changes.take())
        })
        .collect();
    bencher.counter(ItemsCount::new(items)).with_inputs(|| shown.clone()).bench_local_values(|mut shown| {
        for (film, changes) in &steps {
            shown.update(&film.mesh, &film.forces, &film.stains, *changes);
        }
        shown
    });
}
