//! Tears edges and cuts out faces that somebody from outside chose, with the same upkeep as the stages.

use bevy_math::Vec3;

use super::{
    forces::FilmForces,
    relief::relieve_torn,
    scratch::FractureScratch,
    separation::let_go,
    stripping::{debris, strip, strip_if_free},
    tear_edge::{open_edge, tear_edge},
};
use crate::{
    film::{FaceId, FilmChanges, FilmMesh, HalfEdgeId, Topology, VertexId},
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
    cut_out(mesh, forces, settings, gravity, age, &[f], changes, scratch)
}

/// Does what [`strip_by_hand`] does to several faces at once. Returns whether there was any of them.
pub(crate) fn cut_out(
    mesh: &mut FilmMesh,
    forces: &mut FilmForces,
    settings: &CoatingSettings,
    gravity: Vec3,
    age: f32,
    faces: &[FaceId],
    changes: &mut FilmChanges,
    scratch: &mut FractureScratch,
) -> bool {
    let is_there = |mesh: &FilmMesh, f: FaceId| f.index() < mesh.topology.face_count() && mesh.topology.is_live(f);
    if !faces.iter().any(|&f| is_there(mesh, f)) {
        return false;
    }
    forces.find_pieces(&mesh.topology);
    for &f in faces {
        if !is_there(mesh, f) {
            continue;
        }
        let (torn, separated) = (changes.torn.len(), changes.separated.len());
        for v in mesh.topology.corners(f) {
            let_go(&mesh.topology, forces, v, age, changes);
        }
        for h in f.half_edges() {
            let Some(h) = bound_edge(&mesh.topology, h) else { continue };
            open_edge(mesh, forces, &settings.tearing, h, gravity, changes, &mut scratch.pieces);
        }
        if !mesh.topology.is_cut_out(f) {
            // It was a piece of its own already, without an edge that could tear.
            changes.debris.push(debris(mesh, &[f]));
            changes.removed.push(f);
            mesh.topology.drop_piece(&[f]);
            for v in mesh.topology.corners(f) {
                forces.tips[v.index()] = Vec3::ZERO;
            }
        } else if changes.torn.len() == torn && changes.separated.len() == separated {
            // It was cut out and loose already, and waited for its time to fall.
            strip_if_free(mesh, forces, f, changes);
        }
    }
    relieve_torn(mesh, forces, &settings.tearing, &changes.torn, &mut scratch.relief);
    strip(mesh, forces, &settings.stripping, age, changes, scratch);
    forces.loose.retain_live(&mesh.topology, &mut scratch.pieces);
    true
}

/// Strikes the film: `blow` is a force on each original vertex, in units of the initial contraction, 0 where it is not
/// struck; `faces` are those that feel any.
///
/// - A vertex lets go where the blow is stronger than its adhesion.
/// - A face is knocked out where the mean blow on it is stronger than the mean adhesion of its corners and the weakest
///   binding that holds it, together.
/// - An edge between two faces tears where blow and pull are stronger than its binding and both of its ends have let
///   go: cracks begin there, and go on in the next steps.
///
/// Returns whether anything gave way.
pub(crate) fn strike(
    mesh: &mut FilmMesh,
    forces: &mut FilmForces,
    settings: &CoatingSettings,
    gravity: Vec3,
    age: f32,
    blow: &[f32],
    faces: &[FaceId],
    changes: &mut FilmChanges,
    scratch: &mut FractureScratch,
) -> bool {
    forces.find_pieces(&mesh.topology);
    let topology = &mesh.topology;
    let on = |v: VertexId| blow.get(topology.original(v).index()).copied().unwrap_or(0.0);
    let knocked: Vec<FaceId> = faces
        .iter()
        .copied()
        .filter(|&f| topology.is_live(f))
        .filter(|&f| {
            let corners = topology.corners(f);
            let held: f32 = corners.iter().filter(|&&v| forces.is_attached(v)).map(|&v| forces.adhesion(v)).sum();
            let bindings = f.half_edges().into_iter().filter_map(|h| forces.pull_and_binding(topology, h));
            let weakest = bindings.map(|(_, binding)| binding).fold(f32::INFINITY, f32::min);
            let weakest = if weakest < f32::INFINITY { weakest } else { 0.0 };
            corners.iter().map(|&v| on(v)).sum::<f32>() > held + 3.0 * weakest
        })
        .collect();
    let before = changes.separated.len();
    for &f in faces.iter().filter(|&&f| topology.is_live(f)) {
        for v in topology.corners(f) {
            if on(v) > forces.adhesion(v) {
                let_go(topology, forces, v, age, changes);
            }
        }
    }
    let mut torn: Vec<HalfEdgeId> = Vec::new();
    for h in faces.iter().flat_map(|f| f.half_edges()).filter(|&h| topology.edge(h) == h) {
        let ends = [topology.origin(h), topology.target(h)];
        let Some((pull, binding)) = forces.pull_and_binding(topology, h) else { continue };
        let struck = 0.5 * (on(ends[0]) + on(ends[1]));
        if struck > 0.0 && pull + struck > binding && !ends.iter().any(|&v| forces.is_attached(v)) {
            torn.push(h);
        }
    }
    for h in torn {
        open_edge(mesh, forces, &settings.tearing, h, gravity, changes, &mut scratch.pieces);
    }
    if cut_out(mesh, forces, settings, gravity, age, &knocked, changes, scratch) {
        return true;
    }
    let gave = changes.separated.len() > before || !changes.torn.is_empty();
    if gave {
        relieve_torn(mesh, forces, &settings.tearing, &changes.torn, &mut scratch.relief);
        strip(mesh, forces, &settings.stripping, age, changes, scratch);
    }
    gave
}

/// Tears the `edges`, whatever holds them, and separates their ends: a cut with a knife. Returns whether any was whole.
pub(crate) fn cut(
    mesh: &mut FilmMesh,
    forces: &mut FilmForces,
    settings: &CoatingSettings,
    gravity: Vec3,
    age: f32,
    edges: &[HalfEdgeId],
    changes: &mut FilmChanges,
    scratch: &mut FractureScratch,
) -> bool {
    forces.find_pieces(&mesh.topology);
    for &h in edges {
        let Some(edge) = bound_edge(&mesh.topology, h).filter(|h| mesh.topology.is_live(h.face())) else { continue };
        for v in [mesh.topology.origin(edge), mesh.topology.target(edge)] {
            let_go(&mesh.topology, forces, v, age, changes);
        }
        open_edge(mesh, forces, &settings.tearing, edge, gravity, changes, &mut scratch.pieces);
    }
    let cut = !changes.torn.is_empty();
    if cut {
        relieve_torn(mesh, forces, &settings.tearing, &changes.torn, &mut scratch.relief);
        strip(mesh, forces, &settings.stripping, age, changes, scratch);
    }
    cut
}

/// Returns the edge of `h` if it is there and bound.
fn bound_edge(topology: &Topology, h: HalfEdgeId) -> Option<HalfEdgeId> {
    let is_there = h.index() < topology.half_edge_count() && topology.bound_twin(h).is_some();
    is_there.then(|| topology.edge(h))
}
