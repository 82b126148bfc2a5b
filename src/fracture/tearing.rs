//! Tearing: edges give way where contraction exceeds binding, and cracks run straight on (VC 5.2).

use bevy_math::Vec3;

use super::FilmForces;
use crate::{
    film::{FilmChanges, FilmMesh, HalfEdgeId, TearEnd, VertexId},
    settings::TearingSettings,
};

/// Room for the candidates of a step, kept between steps.
#[derive(Clone, Debug, Default)]
pub struct TearScratch {
    candidates: Vec<Candidate>,
}

/// An edge that would tear in the state at the start of the step.
#[derive(Clone, Copy, Debug)]
struct Candidate {
    edge: HalfEdgeId,
    /// Largest cosine between the edge and a crack that ends at it; `None` at no tip.
    alignment: Option<f32>,
    /// Contraction over binding.
    overload: f32,
}

/// Tears edges whose ends have both separated and whose two faces pull harder than the edge binds.
///
/// Candidates are collected first, then judged again one by one: best aligned with a crack first, edges at no
/// tip last, then by the largest overload, then by edge. Each tear relieves its neighbours, so tearing the
/// whole batch as judged at the start would double the torn edges and make cracks crooked.
///
/// `gravity` is a unit vector in the film's space; it decides which side of a split keeps the vertex.
pub fn tear(
    mesh: &mut FilmMesh,
    forces: &mut FilmForces,
    settings: &TearingSettings,
    gravity: Vec3,
    changes: &mut FilmChanges,
    scratch: &mut TearScratch,
) {
    let candidates = &mut scratch.candidates;
    candidates.clear();
    candidates.extend(mesh.topology.all_edges().filter_map(|edge| {
        let alignment = alignment(mesh, forces, edge);
        overload(mesh, forces, settings, edge, alignment).map(|overload| Candidate { edge, alignment, overload })
    }));
    candidates.sort_unstable_by(|a, b| {
        let aligned = |c: &Candidate| c.alignment.unwrap_or(f32::NEG_INFINITY);
        aligned(b).total_cmp(&aligned(a)).then(b.overload.total_cmp(&a.overload)).then(a.edge.cmp(&b.edge))
    });
    for &Candidate { edge, .. } in candidates.iter() {
        let alignment = alignment(mesh, forces, edge);
        if overload(mesh, forces, settings, edge, alignment).is_some() {
            tear_edge(mesh, forces, settings, edge, gravity, changes);
        }
    }
}

/// Largest cosine between the edge and the direction of a crack that ends at one of its ends; `None` where
/// no crack does. At rest, as all directions of this section.
fn alignment(mesh: &FilmMesh, forces: &FilmForces, edge: HalfEdgeId) -> Option<f32> {
    let (a, b) = (mesh.topology.origin(edge), mesh.topology.target(edge));
    let at = |tip: VertexId, other: VertexId| forces.tip(tip).map(|crack| direction(mesh, tip, other).dot(crack));
    match (at(a, b), at(b, a)) {
        (Some(x), Some(y)) => Some(if x > y { x } else { y }),
        (x, y) => x.or(y),
    }
}

/// Unit vector between two vertices at rest; zero where they coincide.
fn direction(mesh: &FilmMesh, from: VertexId, to: VertexId) -> Vec3 {
    let rest = &mesh.geometry.rest_positions;
    (rest[to.index()] - rest[from.index()]).normalize_or_zero()
}

/// Contraction over binding if the edge is to tear now, with relief where it runs on from a crack tip.
fn overload(
    mesh: &FilmMesh,
    forces: &FilmForces,
    settings: &TearingSettings,
    edge: HalfEdgeId,
    alignment: Option<f32>,
) -> Option<f32> {
    let (pull, binding) = forces.pull_and_binding(&mesh.topology, edge)?;
    let live = mesh.topology.is_live(edge.face());
    let separated = !forces.is_attached(mesh.topology.origin(edge)) && !forces.is_attached(mesh.topology.target(edge));
    let relieved = alignment.is_some_and(|cosine| cosine > settings.alpha);
    let binding = if relieved { settings.beta * binding } else { binding };
    // A binding that has decayed to nothing must still order by pull, not divide by zero.
    (live && separated && pull > binding).then(|| pull / binding.max(f32::MIN_POSITIVE))
}

fn tear_edge(
    mesh: &mut FilmMesh,
    forces: &mut FilmForces,
    settings: &TearingSettings,
    edge: HalfEdgeId,
    gravity: Vec3,
    changes: &mut FilmChanges,
) {
    let (a, b) = (mesh.topology.origin(edge), mesh.topology.target(edge));
    let Some(twin) = mesh.topology.bound_twin(edge) else { return };
    let Some(ends) = mesh.tear(edge, gravity) else { return };
    for f in [edge.face(), twin.face()] {
        forces.contraction[f.index()] *= settings.contraction_kept;
    }
    for (end, other) in ends.into_iter().zip([b, a]) {
        match end {
            // The crack now ends here and points on, away from the other end.
            TearEnd::Opened(tip) => forces.tips[tip.index()] = direction(mesh, other, tip),
            TearEnd::Split { kept, duplicate } => {
                forces.duplicate_vertex(kept);
                changes.duplicates.push(duplicate);
            }
        }
    }
    forces.torn_edges += 1;
    changes.torn.push(edge);
    changes.torn_ends.push(ends);
}
