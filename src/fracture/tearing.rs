//! Tearing: edges give way where contraction exceeds binding, and cracks run straight on (VC 5.2).

use bevy_math::Vec3;

use super::{
    FilmForces,
    balance::{Balance, direction},
};
use crate::{
    film::{FilmChanges, FilmMesh, HalfEdgeId, PieceScratch, TearEnd, Topology, VertexId},
    settings::TearingSettings,
};

/// Room for what tearing and stripping work with, kept between steps.
#[derive(Clone, Debug, Default)]
pub struct FractureScratch {
    pub(super) candidates: Vec<Candidate>,
    pub(super) pieces: PieceScratch,
}

/// An edge that would tear in the state at the start of the step.
#[derive(Clone, Copy, Debug)]
pub(super) struct Candidate {
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
/// whole batch as judged at the start would double the torn edges and make cracks crooked. What a tear overloads
/// waits for the next step.
///
/// Looks only at edges that may be due: predictions hold until an end separates, a crack's tip comes to an end, or one
/// of the two faces gets its first torn edge, and then the edge is looked at in the next step.
///
/// `gravity` is a unit vector in the film's space; it decides which side of a split keeps the vertex.
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
    let basis = forces.predictions.basis_of_tears(settings.alpha, settings.beta);
    let queue = &mut forces.predictions.tears;
    let due = if queue.rests_on(basis, elements) {
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

/// Judges an edge that is due; puts it off if it holds.
fn candidate(
    mesh: &FilmMesh,
    forces: &mut FilmForces,
    settings: &TearingSettings,
    edge: HalfEdgeId,
) -> Option<Candidate> {
    let balance = Balance::new(mesh, forces, settings, edge)?;
    let Some(overload) = balance.overload() else {
        let steps = balance.steps_until_tear(forces, edge);
        forces.predictions.tears.put_off(edge.0, steps);
        return None;
    };
    Some(Candidate { edge, alignment: balance.alignment, overload })
}

/// What [`tear`] does, by a look at every edge.
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
        Some(Candidate { edge, alignment: balance.alignment, overload: balance.overload()? })
    }));
    tear_in_order(mesh, forces, settings, gravity, changes, scratch);
}

/// Tears the candidates, best first, as far as they are still overloaded when their turn comes.
fn tear_in_order(
    mesh: &mut FilmMesh,
    forces: &mut FilmForces,
    settings: &TearingSettings,
    gravity: Vec3,
    changes: &mut FilmChanges,
    scratch: &mut FractureScratch,
) {
    let FractureScratch { candidates, pieces } = scratch;
    candidates.sort_unstable_by(|a, b| {
        let aligned = |c: &Candidate| c.alignment.unwrap_or(f32::NEG_INFINITY);
        aligned(b).total_cmp(&aligned(a)).then(b.overload.total_cmp(&a.overload)).then(a.edge.cmp(&b.edge))
    });
    for &Candidate { edge, .. } in candidates.iter() {
        let overloaded = Balance::new(mesh, forces, settings, edge).is_some_and(|b| b.overload().is_some());
        if overloaded {
            tear_edge(mesh, forces, settings, edge, gravity, changes, pieces);
        } else {
            forces.predictions.tears.touch(edge.0);
        }
    }
}

fn tear_edge(
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
    let Some(ends) = mesh.tear(edge, gravity) else { return };
    for h in [edge, twin] {
        forces.relieve(h.face(), settings.contraction_kept);
        for h in h.face().half_edges() {
            forces.follow_decay(&mesh.topology, h);
        }
    }
    for (end, other) in ends.into_iter().zip([b, a]) {
        match end {
            // The crack now ends here and points on, away from the other end.
            TearEnd::Opened(tip) => {
                forces.tips[tip.index()] = direction(mesh, other, tip);
                forces.touch_edges_at(&mesh.topology, tip);
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

impl FilmForces {
    /// Has the edges at `v` looked at in the next step, or in this one if tearing is yet to come.
    pub(super) fn touch_edges_at(&mut self, topology: &Topology, v: VertexId) {
        // No two faces are bound along any other edge of the fan.
        for h in topology.fan(v).filter(|&h| topology.bound_twin(h).is_some()) {
            if !self.is_attached(topology.target(h)) {
                self.predictions.tears.touch(topology.edge(h).0);
            }
        }
    }

    /// Lets the binding of the edge of `h` decay as its faces have it now.
    pub(super) fn follow_decay(&mut self, topology: &Topology, h: HalfEdgeId) {
        let (edge, faces) = (topology.edge(h), topology.torn_faces(h));
        let binding = &mut self.bindings[edge.index()];
        if binding.torn_faces() != faces {
            binding.set_torn_faces(faces, self.decay);
            self.predictions.tears.touch(edge.0);
        }
    }
}
