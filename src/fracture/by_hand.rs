//! Tears edges and cuts out faces that somebody from outside chose, with the same upkeep as the stages.

use bevy_math::Vec3;

use super::{
    forces::FilmForces,
    scratch::FractureScratch,
    separation::let_go,
    stripping::{debris, strip, strip_if_free},
    tear_edge::tear_edge,
};
use crate::{
    film::{FaceId, FilmChanges, FilmMesh, HalfEdgeId},
    settings::CoatingSettings,
};

/// Tears the edge of `h`, whatever holds it, and separates its ends from the metal. Faces and pieces that nothing holds
/// any more come off, as in [`strip`](super::strip).
///
/// `gravity` is a direction in the film's space and `age` that of the film; the ends get it as their
/// [`separated_age`](FilmForces::separated_age). What happened is appended to `changes`, which must be empty. Returns
/// `false`, and changes nothing, if there is no such edge, it has torn or lies on the border, or a face at it is gone.
///
/// Constraints and stains must follow: [`sim::edit::tear_edge`](crate::sim::edit::tear_edge) does all of it.
pub fn tear_by_hand(
    mesh: &mut FilmMesh,
    forces: &mut FilmForces,
    settings: &CoatingSettings,
    gravity: Vec3,
    age: f32,
    h: HalfEdgeId,
    changes: &mut FilmChanges,
    scratch: &mut FractureScratch,
) -> bool {
    let topology = &mesh.topology;
    if h.index() >= topology.half_edge_count() || topology.bound_twin(h).is_none() || !topology.is_live(h.face()) {
        return false;
    }
    forces.find_pieces(topology);
    for v in [topology.origin(h), topology.target(h)] {
        let_go(topology, forces, v, age, changes);
    }
    let edge = topology.edge(h);
    tear_edge(mesh, forces, &settings.tearing, edge, gravity, changes, &mut scratch.pieces, &mut scratch.relief);
    strip(mesh, forces, &settings.stripping, age, changes, scratch);
    true
}

/// Separates the corners of the face `f`, tears its edges and removes it. What else nothing holds any more comes off
/// with it, as in [`strip`](super::strip).
///
/// The parameters are those of [`tear_by_hand`]. Returns `false`, and changes nothing, if there is no such face or it
/// is gone.
pub fn strip_by_hand(
    mesh: &mut FilmMesh,
    forces: &mut FilmForces,
    settings: &CoatingSettings,
    gravity: Vec3,
    age: f32,
    f: FaceId,
    changes: &mut FilmChanges,
    scratch: &mut FractureScratch,
) -> bool {
    if f.index() >= mesh.topology.face_count() || !mesh.topology.is_live(f) {
        return false;
    }
    forces.find_pieces(&mesh.topology);
    for v in mesh.topology.corners(f) {
        let_go(&mesh.topology, forces, v, age, changes);
    }
    for h in f.half_edges() {
        if mesh.topology.bound_twin(h).is_some() {
            let edge = mesh.topology.edge(h);
            tear_edge(
                mesh,
                forces,
                &settings.tearing,
                edge,
                gravity,
                changes,
                &mut scratch.pieces,
                &mut scratch.relief,
            );
        }
    }
    if !mesh.topology.is_cut_out(f) {
        // It was a piece of its own already, without an edge that could tear.
        changes.debris.push(debris(mesh, &[f]));
        changes.removed.push(f);
        mesh.topology.drop_piece(&[f]);
        for v in mesh.topology.corners(f) {
            forces.tips[v.index()] = Vec3::ZERO;
        }
    } else if changes.torn.is_empty() && changes.separated.is_empty() {
        // It was cut out and loose already, and waited for its time to fall.
        strip_if_free(mesh, forces, f, changes);
    }
    strip(mesh, forces, &settings.stripping, age, changes, scratch);
    forces.loose.retain_live(&mesh.topology, &mut scratch.pieces);
    true
}
