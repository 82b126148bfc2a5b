//! Stains over whole runs: on any mesh, and on test pieces with cracks at chosen places.

mod dust;
mod moisture;
mod properties;
mod revisions;
mod rust;

use bevy_math::Vec3;

use crate::{
    film::{FilmMesh, HalfEdgeId, VertexId},
    remesh::sample,
    settings::{CoatingSettings, Preset},
    sim::state::FilmState,
    stain::{Environment, RustSource, StainLayer},
};

/// Makes settings under which every vertex separates at once, and nothing tears or moves by itself.
fn held() -> CoatingSettings {
    let mut settings = CoatingSettings::from(Preset::Paper);
    settings.adhesion.mean = 0.0;
    settings.adhesion.deviation = 0.0;
    settings.tearing.binding = 1e6;
    settings.tearing.weak_probability = 0.0;
    settings.tearing.contraction_growth = 0.0;
    settings.deform.sweeps_per_age = 0.0;
    settings
}

fn film_of(mesh: FilmMesh, settings: &CoatingSettings, steps_per_age: u32) -> FilmState {
    FilmState::from_mesh(mesh, settings, 1, steps_per_age)
}

/// Makes the test plate: side 1 in the xy plane, facing +z, centred on the origin.
fn plate(triangles: u32, settings: &CoatingSettings, steps_per_age: u32) -> FilmState {
    let piece = sample::plate(triangles, 1).unwrap();
    FilmState::new(&piece.film, settings, 1, steps_per_age).unwrap()
}

fn nearest(film: &FilmState, place: Vec3) -> VertexId {
    let rest = &film.mesh.geometry.rest_positions;
    let originals = 0..film.mesh.topology.original_vertex_count();
    let best = originals.min_by(|&a, &b| rest[a].distance_squared(place).total_cmp(&rest[b].distance_squared(place)));
    VertexId::new(best.unwrap())
}

/// Makes a chain of edges from about `from` to about `to` so weak that they tear in the next step.
fn crack(film: &mut FilmState, from: Vec3, to: Vec3) -> Vec<HalfEdgeId> {
    let (mut v, end) = (nearest(film, from), nearest(film, to));
    let mut edges = Vec::new();
    while v != end {
        let rest = &film.mesh.geometry.rest_positions;
        let distance = |h: HalfEdgeId| rest[film.mesh.topology.target(h).index()].distance(rest[end.index()]);
        let around = film.mesh.topology.fan(v).flat_map(|h| [Some(h), film.mesh.topology.bound_twin(h.previous())]);
        let h = around.flatten().min_by(|&a, &b| distance(a).total_cmp(&distance(b))).unwrap();
        film.forces.set_binding(&film.mesh.topology, h, 0.0);
        edges.push(h);
        v = film.mesh.topology.target(h);
    }
    edges
}

fn sources(film: &FilmState) -> Vec<VertexId> {
    let is_source = |v: &VertexId| film.stains.sources[v.index()] == RustSource::Present;
    film.mesh.topology.all_vertices().filter(is_source).collect()
}

/// Returns the amount of rust on film and metal at each original vertex.
fn amounts(film: &FilmState) -> Vec<f64> {
    let stains = &film.stains;
    let mut amounts: Vec<f64> = (0..film.mesh.topology.original_vertex_count())
        .map(|v| f64::from(stains.metal.rust(v)) * f64::from(stains.metal.areas[v]))
        .collect();
    for v in film.mesh.topology.all_vertices() {
        amounts[film.mesh.topology.original(v).index()] +=
            f64::from(stains.film.rust(v.index())) * f64::from(stains.film.areas[v.index()]);
    }
    amounts
}

/// Returns the mean of `value` over the rust of a film, weighted by amount.
fn mean(film: &FilmState, value: impl Fn(Vec3) -> f32) -> f64 {
    let amounts = amounts(film);
    let places = amounts.iter().zip(&film.mesh.geometry.rest_positions);
    places.map(|(amount, &p)| amount * f64::from(value(p))).sum::<f64>() / amounts.iter().sum::<f64>()
}
