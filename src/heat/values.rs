//! Computes the values of heat maps.

use super::map::HeatMap;
use crate::{
    film::{FaceId, FilmMesh, PieceScratch, VertexId},
    fracture::{FilmForces, age_until_separation, bending_force},
    settings::CoatingSettings,
    stain::{RustSource, StainFields},
};

/// Parts of a film that heat maps read.
#[derive(Clone, Copy, Debug)]
pub struct HeatFilm<'a> {
    /// Mesh of the film.
    pub mesh: &'a FilmMesh,
    /// Forces and fracture state.
    pub forces: &'a FilmForces,
    /// Stains, with the exposure to rain.
    pub stains: &'a StainFields,
    /// Settings with which the film steps.
    pub settings: &'a CoatingSettings,
}

/// Values of a heat map on one film, and the buffers with which they are computed. Keep it between updates to save
/// allocations; the default is empty. The module's page has an [example](super).
#[derive(Clone, Debug, Default)]
pub struct HeatValues {
    corners: Vec<f32>,
    vertices: Vec<f32>,
    faces: Vec<f32>,
    pieces: PieceScratch,
}

impl HeatValues {
    /// Computes the values of `map` on a film. The time is proportional to the size of the film.
    pub fn update(&mut self, map: HeatMap, film: HeatFilm<'_>) {
        let topology = &film.mesh.topology;
        if self.of_faces(map, film) {
            self.corners.clear();
            self.corners.extend(self.faces.iter().flat_map(|&value| [value; 3]));
            return;
        }
        self.vertices.clear();
        self.vertices.extend(topology.all_vertices().map(|v| of_vertex(map, film, v)));
        self.corners.clear();
        for f in topology.all_faces() {
            let live = topology.is_live(f);
            let value = |v: VertexId| if live { self.vertices[v.index()] } else { f32::NAN };
            self.corners.extend(topology.corners(f).map(value));
        }
    }

    /// Returns the value at each half-edge of the film: of its face, at its start. Three of them make a face. NaN where
    /// there is no value: on faces that are gone, and where what the map shows does not apply any more.
    pub fn corners(&self) -> &[f32] {
        &self.corners
    }

    /// Computes one value a face, if the map has such. Returns whether it has.
    fn of_faces(&mut self, map: HeatMap, film: HeatFilm<'_>) -> bool {
        let topology = &film.mesh.topology;
        let Self { faces, pieces, .. } = self;
        faces.clear();
        match map {
            HeatMap::Binding => faces.extend(topology.all_faces().map(|f| binding_margin(film, f))),
            HeatMap::Strain => faces.extend(topology.all_faces().map(|f| strain(film.mesh, f))),
            HeatMap::Pieces => {
                faces.resize(topology.face_count(), f32::NAN);
                for seed in topology.live_faces() {
                    if faces[seed.index()].is_nan() {
                        for &f in pieces.piece_of(topology, seed) {
                            faces[f.index()] = seed.0 as f32;
                        }
                    }
                }
            }
            _ => return false,
        }
        true
    }
}

/// Returns the value of a map at a vertex.
fn of_vertex(map: HeatMap, film: HeatFilm<'_>, v: VertexId) -> f32 {
    let HeatFilm { mesh, forces, stains, settings } = film;
    let topology = &mesh.topology;
    if !topology.has_faces(v) {
        return f32::NAN;
    }
    match map {
        HeatMap::Adhesion | HeatMap::Separation if !forces.is_attached(v) => f32::NAN,
        HeatMap::Adhesion => forces.adhesion(v) - bending_force(mesh, forces, v, settings.bending.gain),
        HeatMap::Separation => {
            let moisture = stains.film.moisture.get(v.index()).copied().unwrap_or_default();
            age_until_separation(mesh, forces, v, settings, moisture)
        }
        HeatMap::Sources => match stains.sources.get(v.index()) {
            Some(RustSource::Present) => 1.0,
            Some(RustSource::Past) => 0.5,
            _ => 0.0,
        },
        // A missing entry, or one that is not finite, counts as exposed.
        HeatMap::Rain => {
            let rain = stains.exposure.rain.get(topology.original(v).index()).copied();
            rain.filter(|rain| rain.is_finite()).unwrap_or(1.0)
        }
        HeatMap::Binding | HeatMap::Strain | HeatMap::Pieces => f32::NAN,
    }
}

/// Returns by how much the binding of the weakest bound edge of `f` exceeds the pull on it; NaN without such an edge.
fn binding_margin(film: HeatFilm<'_>, f: FaceId) -> f32 {
    let topology = &film.mesh.topology;
    if !topology.is_live(f) {
        return f32::NAN;
    }
    let margins = f.half_edges().into_iter().filter_map(|h| film.forces.pull_and_binding(topology, h));
    margins.map(|(pull, binding)| binding - pull).reduce(f32::min).unwrap_or(f32::NAN)
}

/// Returns the largest strain of the edges of `f`; NaN for a face that is gone.
fn strain(mesh: &FilmMesh, f: FaceId) -> f32 {
    let (topology, geometry) = (&mesh.topology, &mesh.geometry);
    if !topology.is_live(f) {
        return f32::NAN;
    }
    let of_edge = |h: crate::film::HalfEdgeId| {
        let [a, b] = [topology.origin(h), topology.target(h)].map(|v| geometry.positions[v.index()]);
        let rest = geometry.rest_lengths[h.index()];
        if rest > 0.0 { (a.distance(b) - rest).abs() / rest } else { 0.0 }
    };
    f.half_edges().into_iter().map(of_edge).fold(0.0, f32::max)
}
