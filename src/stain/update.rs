//! Stains follow fracture: duplicates, areas, sources, and what lies open.

use bevy_math::Vec3;

use super::{
    RustSource, StainFields,
    sources::{end_source, judge},
};
use crate::film::{FilmChanges, FilmMesh, TearEnd, VertexId};

/// Openness of metal beside a crack or a bare place, where rust creeps under the film; in a crack; and laid bare.
const BESIDE: f32 = 0.15;
const IN_CRACK: f32 = 0.5;
const BARE: f32 = 1.0;

/// Brings the stains up to date with what fractured in this step: duplicates get the stains of their vertex, sources
/// are judged at each tear in turn, and rust on faces that fell leaves with them. `gravity` is a unit vector in the
/// film's space, or zero.
pub fn update_stains(mesh: &FilmMesh, stains: &mut StainFields, changes: &FilmChanges, gravity: Vec3) {
    if changes.torn.is_empty() && changes.removed.is_empty() {
        return;
    }
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
    for v in torn.chain(removed) {
        renew(mesh, stains, topology.original(v));
    }
    stains.revision = stains.revision.wrapping_add(1);
}

impl StainFields {
    fn duplicate(&mut self, kept: VertexId, original: VertexId) {
        self.film.duplicate(kept.index());
        let was_source = self.sources[kept.index()] != RustSource::Never;
        self.sources.push(if was_source { RustSource::Past } else { RustSource::Never });
        self.duplicates.append(original);
        self.flow.append();
    }
}

/// Renews what depends on connectivity at `original`: areas of its duplicates, how open its metal lies, and the ways of
/// run-off there and at its neighbours.
fn renew(mesh: &FilmMesh, stains: &mut StainFields, original: VertexId) {
    let topology = &mesh.topology;
    let StainFields { film, duplicates, openness, open, flow, dust_rates, .. } = stains;
    for v in duplicates.of(original) {
        let faces = topology.fan(v).map(|h| mesh.geometry.rest_area_of(topology, h.face()));
        film.areas[v.index()] = faces.sum::<f32>() / 3.0;
        dust_rates.stale(v);
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
    flow.stale(duplicates, original);
    for h in duplicates.rest_fan(topology, original) {
        for side in [h.next(), h.previous()] {
            let neighbour = topology.original(topology.origin(side));
            raise(neighbour, BESIDE);
            flow.stale(duplicates, neighbour);
        }
    }
}
