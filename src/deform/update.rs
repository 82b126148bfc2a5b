//! Link between static simulation and bending: constraints follow fracture (VC 5, fig. 7).

use super::constraints::FilmConstraints;
use crate::film::{FaceId, FilmChanges, FilmMesh, TearEnd, VertexId};

/// Brings the constraints up to date with what fractured in this step.
///
/// - A vertex that separated gets length constraints on all its edges and bend constraints on the edges that
///   pushed it, those opposite to it.
/// - A torn edge loses its bend constraint and has a length constraint for each of its half-edges.
/// - A removed face takes its constraints with it.
/// - Where a vertex was duplicated, the constraints of the moved fan follow.
///
/// ```
/// use bevy_coating::{
///     deform::{FilmConstraints, update_constraints},
///     film::{FilmChanges, FilmMesh},
/// };
/// use bevy_math::Vec3;
///
/// let corners = vec![Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y];
/// let mesh = FilmMesh::new(corners, &[[0, 1, 2], [0, 2, 3]])?;
/// let mut constraints = FilmConstraints::new(&mesh);
/// let mut changes = FilmChanges::default();
/// changes.separated.extend(mesh.topology.all_vertices());
/// update_constraints(&mesh, &mut constraints, &changes);
/// // Five edges, of which the diagonal bends.
/// assert_eq!((constraints.length_count(), constraints.bend_count()), (5, 1));
/// # Ok::<(), bevy_coating::film::TopologyError>(())
/// ```
pub fn update_constraints(mesh: &FilmMesh, constraints: &mut FilmConstraints, changes: &FilmChanges) {
    if !changes.fractured() {
        return;
    }
    let topology = &mesh.topology;
    for &v in &changes.separated {
        constraints.free(v);
    }
    for end in changes.torn_ends.iter().flatten() {
        // A duplicate's state is that of its vertex: it has separated, in this step or before.
        if let TearEnd::Split { kept, .. } = *end {
            constraints.duplicate(kept);
        }
    }
    for &h in &changes.torn {
        constraints.remove_bend(topology, topology.edge(h));
    }
    for &f in &changes.removed {
        remove_face(mesh, constraints, f);
    }
    // Before any constraint is placed, all others refer to what they will be solved with.
    for &v in &changes.duplicates {
        for h in topology.fan(v) {
            for side in h.face().half_edges() {
                constraints.refresh(topology, topology.edge(side));
                constraints.refresh(topology, side);
            }
        }
    }
    for end in changes.torn_ends.iter().flatten() {
        match *end {
            TearEnd::Opened(v) => constraints.wake(mesh, v),
            TearEnd::Split { kept, duplicate } => {
                constraints.wake(mesh, kept);
                constraints.wake(mesh, duplicate);
            }
        }
    }
    for &h in &changes.torn {
        for side in [Some(h), topology.rest_twin(h)].into_iter().flatten() {
            constraints.ensure_length(mesh, side);
        }
    }
    for &v in &changes.separated {
        constrain_ring(mesh, constraints, v);
    }
    for &v in &changes.duplicates {
        // If the vertex separated in this same step, part of its ring is the duplicate's now.
        constrain_ring(mesh, constraints, v);
    }
    if !changes.removed.is_empty() {
        constraints.forget(mesh, &changes.removed);
    }
    if !(changes.torn.is_empty() && changes.removed.is_empty()) {
        constraints.compact(topology);
    }
}

fn constrain_ring(mesh: &FilmMesh, constraints: &mut FilmConstraints, v: VertexId) {
    constraints.unpark_around(mesh, v);
    for h in mesh.topology.fan(v) {
        constraints.ensure_length(mesh, h);
        constraints.ensure_length(mesh, h.previous());
        constraints.ensure_bend(mesh, h.next());
    }
}

fn remove_face(mesh: &FilmMesh, constraints: &mut FilmConstraints, f: FaceId) {
    for h in f.half_edges() {
        constraints.remove_length(&mesh.topology, h);
        constraints.remove_bend(&mesh.topology, h);
    }
}
