//! Keeps stains in step with fracture: duplicates, areas, sources of rust and open metal.

use bevy_math::Vec3;

use super::{
    duplicates::Duplicates,
    fields::{RustSource, StainFields},
    sources::{end_source, judge},
};
use crate::film::{FilmChanges, FilmMesh, HalfEdgeId, TearEnd, Topology, VertexId, direction::unit_or_zero};

/// Openness of the metal beside a crack or beside a bare place: rust creeps under the film.
const BESIDE: f32 = 0.15;
/// Openness of the metal in a crack.
const IN_CRACK: f32 = 0.5;
/// Openness of the metal beside a removed face.
const BARE: f32 = 1.0;

/// Brings the stains up to date with the fracture of one step. Call it in every step, before
/// [`run_off`](super::run_off).
///
/// A duplicate gets the stains of its vertex. Both ends of each tear are judged in turn as sources of rust (VC 6.1,
/// fig. 9). Rust on faces that were removed leaves with them and is counted in
/// [`RustBudget::dripped`](super::RustBudget::dripped). Metal in cracks, beside them and under removed faces counts as
/// open from now on.
///
/// `mesh` is the film after the step, `changes` what the step changed, and `gravity` a direction in the film's
/// space, or zero.
///
/// The stages of a step and [`FilmState::tear_edge`](crate::sim::FilmState::tear_edge) call it.
pub fn update_stains(mesh: &FilmMesh, stains: &mut StainFields, changes: &FilmChanges, gravity: Vec3) {
    if changes.torn.is_empty() && changes.removed.is_empty() {
        return;
    }
    let gravity = unit_or_zero(gravity);
    let topology = &mesh.topology;
    for (&edge, &ends) in changes.torn.iter().zip(&changes.torn_ends) {
        for end in ends {
            if let TearEnd::Split { kept, .. } = end {
                stains.duplicate(kept, topology.original(kept));
            }
        }
        let places = ends.map(|end| match end {
            TearEnd::Opened(v) | TearEnd::Split { kept: v, .. } => topology.original(v),
        });
        judge(stains, mesh, ends, gravity, mesh.geometry.rest_lengths[edge.index()]);
        places.into_iter().for_each(|v| stains.flow.wake(v));
    }
    for &f in &changes.removed {
        let third = f64::from(mesh.geometry.rest_area_of(topology, f)) / 3.0;
        for v in topology.corners(f) {
            stains.budget.dripped += f64::from(stains.film.rust(v.index())) * third;
            if !topology.has_faces(v) {
                end_source(&mut stains.sources[v.index()]);
            }
        }
    }
    let torn = changes.torn_ends.iter().flatten().map(|&end| match end {
        TearEnd::Opened(v) | TearEnd::Split { kept: v, .. } => v,
    });
    let removed = changes.removed.iter().flat_map(|&f| topology.corners(f));
    let mut places = std::mem::take(&mut stains.places);
    torn.chain(removed).for_each(|v| places.touch(topology.original(v)));
    places.take(|original| update_place(mesh, stains, original));
    stains.places = places;
    // What the stains look like need not be noted again: they are the same, on other faces.
    stains.revision = stains.revision.wrapping_add(1);
}

impl StainFields {
    /// Appends a duplicate of `kept` to all fields of the film. A duplicate of a source is a past one.
    fn duplicate(&mut self, kept: VertexId, original: VertexId) {
        let was_source = self.sources[kept.index()] != RustSource::Never;
        self.append(kept.index(), original, if was_source { RustSource::Past } else { RustSource::Never });
    }

    /// Appends a duplicate of `original` with the stains of vertex `i`.
    pub(super) fn append(&mut self, i: usize, original: VertexId, source: RustSource) {
        self.film.duplicate(i);
        self.sources.push(source);
        self.duplicates.append(original);
        self.flow.append(original);
    }
}

/// Returns the openness of the metal at `original` as the film is: what [`update_stains`] leads to where things only
/// tear.
pub(super) fn openness_at(topology: &Topology, duplicates: &Duplicates, original: VertexId) -> f32 {
    let openness_of = |v: VertexId| {
        let mut openness = 0.0;
        for h in duplicates.rest_fan(topology, v) {
            if !topology.is_live(h.face()) {
                return BARE;
            }
            if topology.is_torn(h) || topology.is_torn(h.previous()) {
                openness = IN_CRACK;
            }
        }
        openness
    };
    let openness = openness_of(original);
    if openness > 0.0 {
        return openness;
    }
    // Two faces that follow each other share a neighbour; beyond the last one there is another only at the border.
    let last = duplicates.rest_fan(topology, original).last().map(|h| topology.apex(h));
    let around = duplicates.rest_fan(topology, original).map(|h| topology.target(h));
    let beside = around.chain(last).map(|v| topology.original(v)).any(|v| openness_of(v) > 0.0);
    if beside { BESIDE } else { 0.0 }
}

/// Updates what depends on connectivity at `original`: the areas of its film vertices, the openness of its metal, and
/// the ways of run-off there and at its neighbours.
fn update_place(mesh: &FilmMesh, stains: &mut StainFields, original: VertexId) {
    let topology = &mesh.topology;
    let StainFields { film, duplicates, openness, open, flow, dust_rates, .. } = stains;
    for v in duplicates.of(original) {
        let faces = topology.fan(v).map(|h| mesh.geometry.rest_area_of(topology, h.face()));
        film.areas[v.index()] = faces.sum::<f32>() / 3.0;
        dust_rates.mark_stale(v);
    }
    let bare = duplicates.rest_fan(topology, original).any(|h| !topology.is_live(h.face()));
    let mut raise = |v: VertexId, to: f32| {
        let openness = &mut openness[v.index()];
        if *openness == 0.0 {
            open.push(v.0);
        }
        if *openness < to {
            *openness = to;
        }
    };
    raise(original, if bare { BARE } else { IN_CRACK });
    flow.mark_stale(duplicates, original);
    // Two faces that follow each other share a neighbour.
    let mut fan = duplicates.rest_fan(topology, original).peekable();
    let first = fan.peek().map(|h| h.next());
    for side in first.into_iter().chain(fan.map(HalfEdgeId::previous)) {
        let neighbour = topology.original(topology.origin(side));
        raise(neighbour, BESIDE);
        flow.mark_renamed(duplicates, neighbour);
    }
}
