//! Link between static simulation and bending: constraints follow fracture (VC 5, fig. 7).

use super::FilmConstraints;
use crate::film::{FaceId, FilmChanges, FilmMesh, VertexId};

/// Brings the constraints up to date with what fractured in this step.
///
/// - A vertex that separated gets length constraints on all its edges and bend constraints on the edges that
///   pushed it, those opposite to it.
/// - A torn edge loses its bend constraint and has a length constraint for each of its half-edges.
/// - A removed face takes its constraints with it.
/// - Where a vertex was duplicated, the constraints of the moved fan follow.
pub fn follow_fracture(mesh: &FilmMesh, constraints: &mut FilmConstraints, changes: &FilmChanges) {
    if !changes.fractured() {
        return;
    }
    // A duplicate's state is that of its vertex: it has separated, in this step or before.
    constraints.inverse_masses.resize(mesh.topology.vertex_count(), 1.0);
    for &v in &changes.separated {
        constraints.inverse_masses[v.index()] = 1.0;
    }
    for &h in &changes.torn {
        constraints.remove_bend(mesh.topology.edge(h));
        for side in [Some(h), mesh.topology.rest_twin(h)].into_iter().flatten() {
            constraints.ensure_length(mesh, side);
        }
    }
    for &f in &changes.removed {
        remove_face(constraints, f);
    }
    for &v in &changes.separated {
        constrain_ring(mesh, constraints, v);
    }
    for &v in &changes.duplicates {
        // If the vertex separated in this same step, part of its ring is the duplicate's now.
        constrain_ring(mesh, constraints, v);
        for h in mesh.topology.fan(v) {
            for side in h.face().half_edges() {
                constraints.refresh(mesh, mesh.topology.edge(side));
                constraints.refresh(mesh, side);
            }
        }
    }
    constraints.settle();
}

fn constrain_ring(mesh: &FilmMesh, constraints: &mut FilmConstraints, v: VertexId) {
    for h in mesh.topology.fan(v) {
        constraints.ensure_length(mesh, h);
        constraints.ensure_length(mesh, h.previous());
        constraints.ensure_bend(mesh, h.next());
    }
}

fn remove_face(constraints: &mut FilmConstraints, f: FaceId) {
    for h in f.half_edges() {
        constraints.remove_length(h);
        constraints.remove_bend(h);
    }
}
