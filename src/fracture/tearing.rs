//! Tears edges where contraction exceeds binding, so that cracks run nearly straight (VC 5.2).

use bevy_math::Vec3;

use super::{
    balance::Balance,
    forces::FilmForces,
    neck::tear_necks,
    scratch::{Candidate, FractureScratch},
    tear_edge::tear_edge,
};
use crate::{
    film::{FilmChanges, FilmMesh, HalfEdgeId},
    settings::TearingSettings,
};

/// Tears every edge between two separated vertices whose faces together contract harder than the edge binds (VC 5.2).
///
/// An edge that continues a crack binds less: if the cosine between it and the crack that ends at one of its vertices
/// is above [`alpha`](TearingSettings::alpha), only the share [`beta`](TearingSettings::beta) of its binding counts.
/// All directions are those at rest. A tear leaves its two faces the share
/// [`contraction_kept`](TearingSettings::contraction_kept) of their contraction.
///
/// Edges that may tear are collected first and then judged again one by one: first the edge that is best aligned with a
/// crack (edges at no crack tip come last), then the one with the largest ratio of contraction to binding, then the one
/// with the lower id. Because each tear relieves the faces beside it, tearing all edges at once would double the
/// number of torn edges and make cracks crooked. An edge that a tear brings beyond its binding waits for the next step.
///
/// By [`Rules::Grain`](crate::settings::Rules::Grain) flaps then break off that hang on by a neck of at most
/// [`neck_width`](TearingSettings::neck_width).
///
/// `gravity` is a unit vector in the film's space: where a tear splits a vertex, the faces that lie lower keep it. Torn
/// edges and new vertices are appended to [`FilmChanges::torn`], [`FilmChanges::torn_ends`] and
/// [`FilmChanges::duplicates`].
///
/// Only edges that are due are judged. A prediction holds until an end of the edge separates, a crack ends at one of
/// its ends, or one of its faces gets its first torn edge; any of these makes the edge due.
///
/// ```
/// use bevy_coating::{
///     film::{FilmChanges, FilmMesh, HalfEdgeId},
///     fracture::{FilmForces, FractureScratch, tear},
///     settings::CoatingSettings,
/// };
/// use bevy_math::Vec3;
///
/// let corners = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::new(1.0, 1.0, 0.0)];
/// let mut mesh = FilmMesh::new(corners, &[[0, 1, 2], [2, 1, 3]])?;
/// let settings = CoatingSettings::default();
/// let mut forces = FilmForces::new(&mesh, &settings, 7);
/// forces.separated_age.fill(0.0); // every vertex has separated
/// forces.touch_all();
/// forces.set_binding(&mesh.topology, HalfEdgeId(1), 1.9); // the contraction of its two faces is 2
///
/// let (mut changes, mut scratch) = (FilmChanges::default(), FractureScratch::default());
/// tear(&mut mesh, &mut forces, &settings.tearing, Vec3::NEG_Y, &mut changes, &mut scratch);
/// assert_eq!(changes.torn, [HalfEdgeId(1)]);
/// assert_eq!(forces.torn_edges, 1);
/// # Ok::<(), bevy_coating::film::TopologyError>(())
/// ```
pub fn tear(
    mesh: &mut FilmMesh,
    forces: &mut FilmForces,
    settings: &TearingSettings,
    gravity: Vec3,
    changes: &mut FilmChanges,
    scratch: &mut FractureScratch,
) {
    forces.find_pieces(&mesh.topology);
    let elements = mesh.topology.half_edge_count();
    let basis = forces.predictions.tear_basis(settings.alpha, settings.beta);
    let queue = &mut forces.predictions.tears;
    let due = if queue.is_valid(basis, elements) {
        queue.take_due()
    } else {
        queue.restart(basis, elements, mesh.topology.all_edges().map(|h| h.0))
    };
    scratch.candidates.clear();
    for &edge in &due {
        if let Some(candidate) = candidate(mesh, forces, settings, HalfEdgeId(edge)) {
            scratch.candidates.push(candidate);
        }
    }
    forces.predictions.tears.give_back(due);
    tear_in_order(mesh, forces, settings, gravity, changes, scratch);
}

/// Judges `edge`. Returns it as a candidate if it gives way, and schedules it again if it holds.
fn candidate(
    mesh: &FilmMesh,
    forces: &mut FilmForces,
    settings: &TearingSettings,
    edge: HalfEdgeId,
) -> Option<Candidate> {
    let balance = Balance::new(mesh, forces, settings, edge)?;
    let Some(excess) = balance.excess() else {
        let steps = balance.steps_until_tear(forces, edge);
        forces.predictions.tears.schedule(edge.0, steps);
        return None;
    };
    Some(Candidate { edge, alignment: balance.alignment, excess })
}

/// Does the same as [`tear`], but judges every edge.
#[cfg(test)]
pub(super) fn tear_everywhere(
    mesh: &mut FilmMesh,
    forces: &mut FilmForces,
    settings: &TearingSettings,
    gravity: Vec3,
    changes: &mut FilmChanges,
    scratch: &mut FractureScratch,
) {
    scratch.candidates.clear();
    scratch.candidates.extend(mesh.topology.all_edges().filter_map(|edge| {
        let balance = Balance::new(mesh, forces, settings, edge)?;
        Some(Candidate { edge, alignment: balance.alignment, excess: balance.excess()? })
    }));
    tear_in_order(mesh, forces, settings, gravity, changes, scratch);
}

/// Tears the candidates in their order, each only if it still gives way when its turn comes.
fn tear_in_order(
    mesh: &mut FilmMesh,
    forces: &mut FilmForces,
    settings: &TearingSettings,
    gravity: Vec3,
    changes: &mut FilmChanges,
    scratch: &mut FractureScratch,
) {
    let FractureScratch { candidates, pieces, relief, .. } = scratch;
    candidates.sort_unstable_by(|a, b| {
        let aligned = |c: &Candidate| c.alignment.unwrap_or(f32::NEG_INFINITY);
        aligned(b).total_cmp(&aligned(a)).then(b.excess.total_cmp(&a.excess)).then(a.edge.cmp(&b.edge))
    });
    for &Candidate { edge, .. } in candidates.iter() {
        let gives_way = Balance::new(mesh, forces, settings, edge).is_some_and(|b| b.excess().is_some());
        if gives_way {
            tear_edge(mesh, forces, settings, edge, gravity, changes, pieces, relief);
        } else {
            forces.predictions.tears.make_due(edge.0);
        }
    }
    tear_necks(mesh, forces, settings, gravity, changes, scratch);
}
