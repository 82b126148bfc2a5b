//! Tears one edge and keeps everything else in step.

use bevy_math::{Vec3, ops};

use super::{
    balance::direction,
    forces::FilmForces,
    relief::{ReliefScratch, relieve_torn},
};
use crate::{
    film::{FilmChanges, FilmMesh, HalfEdgeId, PieceScratch, TearEnd, VertexId},
    settings::TearingSettings,
};

/// Tears `edge`, relieves the film beside it, and keeps forces, predictions and `changes` in step.
pub(super) fn tear_edge(
    mesh: &mut FilmMesh,
    forces: &mut FilmForces,
    settings: &TearingSettings,
    edge: HalfEdgeId,
    gravity: Vec3,
    changes: &mut FilmChanges,
    scratch: &mut PieceScratch,
    relief: &mut ReliefScratch,
) {
    let torn = changes.torn.len();
    open_edge(mesh, forces, settings, edge, gravity, changes, scratch);
    relieve_torn(mesh, forces, settings, changes.torn.get(torn..).unwrap_or_default(), relief);
}

/// Does what [`tear_edge`] does, but relieves nothing by the grain's rules: where many edges tear at once,
/// [`relieve_torn`] does that for all of them when all are torn.
pub(super) fn open_edge(
    mesh: &mut FilmMesh,
    forces: &mut FilmForces,
    settings: &TearingSettings,
    edge: HalfEdgeId,
    gravity: Vec3,
    changes: &mut FilmChanges,
    scratch: &mut PieceScratch,
) {
    let (a, b) = (mesh.topology.origin(edge), mesh.topology.target(edge));
    let Some(twin) = mesh.topology.bound_twin(edge) else { return };
    let cracks = [a, b].map(|end| forces.tips[end.index()]);
    let Some(ends) = mesh.tear(edge, gravity) else { return };
    for h in [edge, twin] {
        if forces.grain().is_none() {
            forces.relieve(h.face(), settings.contraction_kept);
        }
        for h in h.face().half_edges() {
            forces.update_decay(&mesh.topology, h);
        }
    }
    for (end, (other, crack)) in ends.into_iter().zip([(b, cracks[1]), (a, cracks[0])]) {
        match end {
            // The crack ends here now and points away from the other end.
            TearEnd::Opened(tip) => {
                let ahead = direction(mesh, other, tip);
                forces.tips[tip.index()] = match forces.grain() {
                    Some(grain) => {
                        let run = mesh.geometry.rest_lengths[edge.index()];
                        remember(crack, ahead, run / (settings.memory * grain.length))
                    }
                    None => ahead,
                };
                forces.make_edges_due(&mesh.topology, tip);
            }
            TearEnd::Split { kept, duplicate } => {
                forces.duplicate_vertex(kept);
                changes.duplicates.push(duplicate);
            }
        }
    }
    let FilmForces { predictions, separated_age, .. } = forces;
    let is_attached = |v: VertexId| separated_age[v.index()] == f32::INFINITY;
    predictions.pieces.edge_torn(&mesh.topology, edge, &ends, scratch, is_attached);
    forces.torn_edges += 1;
    changes.torn.push(edge);
    changes.torn_ends.push(ends);
}

/// Returns the direction of a crack that came along `crack` (zero for one that begins) and ran on along `ahead` by
/// `run`, in lengths over which it forgets by the factor e. So a crack keeps its direction over the same distance
/// whatever the length of its edges.
pub(super) fn remember(crack: Vec3, ahead: Vec3, run: f32) -> Vec3 {
    let kept = ops::exp(-run);
    let direction = (crack * kept + ahead * (1.0 - kept)).normalize_or_zero();
    if crack == Vec3::ZERO || direction == Vec3::ZERO { ahead } else { direction }
}
