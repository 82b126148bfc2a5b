//! Decides when an edge gives way: the balance of contraction and binding (VC 5.2).

use bevy_math::{Vec3, ops};

use super::forces::FilmForces;
use crate::{
    film::{FilmMesh, HalfEdgeId, VertexId},
    settings::TearingSettings,
};

/// Steps of Newton's method in one prediction. Each step makes the prediction much later and so spares judging the edge
/// again, which costs more than the step.
const NEWTON_STEPS: usize = 3;

/// Balance of forces at an edge between two separated vertices.
#[derive(Clone, Copy, Debug)]
pub(super) struct Balance {
    /// Largest cosine between the edge and a crack that ends at one of its ends; `None` if no crack does.
    pub alignment: Option<f32>,
    /// Sum of the contractions of the edge's two faces.
    pull: f32,
    /// Binding of the edge, multiplied by beta if the edge continues a crack.
    hold: f32,
}

impl Balance {
    /// Returns the balance of `edge`, or `None` if the edge cannot tear: an end is attached, or it does not lie between
    /// two faces.
    pub fn new(mesh: &FilmMesh, forces: &FilmForces, settings: &TearingSettings, edge: HalfEdgeId) -> Option<Self> {
        let topology = &mesh.topology;
        let separated = |v: VertexId| !forces.is_attached(v);
        if !separated(topology.origin(edge)) || !separated(topology.target(edge)) || !topology.is_live(edge.face()) {
            return None;
        }
        let (pull, binding) = forces.pull_and_binding(topology, edge)?;
        let alignment = alignment(mesh, forces, edge);
        let relieved = alignment.is_some_and(|cosine| cosine > settings.alpha);
        Some(Self { alignment, pull, hold: if relieved { settings.beta * binding } else { binding } })
    }

    /// Returns by which factor contraction exceeds binding, above 1, or `None` while the edge holds.
    pub fn excess(&self) -> Option<f32> {
        // Where the binding has decayed to 0 the excess must still order edges by their pull.
        (self.pull > self.hold).then(|| self.pull / self.hold.max(f32::MIN_POSITIVE))
    }

    /// Returns the number of steps before which `edge`, which holds now, cannot tear, as long as nothing tears around
    /// it.
    ///
    /// `hold exp(-faces decay n) - pull - 2 growth n` is convex in the number of steps n and falls with it, so Newton's
    /// method approaches the root from the left and never passes it. The error that rounding can cause is subtracted
    /// first.
    pub fn steps_until_tear(&self, forces: &FilmForces, edge: HalfEdgeId) -> f64 {
        let rates = forces.predictions.rates;
        let (pull, hold) = (f64::from(self.pull), f64::from(self.hold));
        let decay = f64::from(forces.bindings[edge.index()].torn_faces()) * rates.binding_decay;
        let growth = 2.0 * rates.contraction_growth;
        if hold == f64::INFINITY || (growth == 0.0 && decay == 0.0) {
            return f64::INFINITY;
        }
        let rounding = f64::from(8.0 * f32::EPSILON);
        let slack = rounding * (hold * (1.0 + forces.binding_decay) + pull + 2.0 * forces.contraction_gained);
        let mut steps = 0.0;
        let mut left = hold;
        for _ in 0..NEWTON_STEPS {
            let margin = left - pull - growth * steps - slack;
            let slope = (decay * left + growth) * (1.0 + rounding);
            if !(margin > 0.0 && slope > 0.0) {
                break;
            }
            steps += margin / slope;
            if decay == 0.0 {
                break;
            }
            left = hold * (f64::from(ops::exp((-decay * steps) as f32)) * (1.0 - rounding));
        }
        steps
    }
}

/// Returns the largest cosine between the edge and the direction of a crack that ends at one of its ends, or `None` if
/// no crack does. All directions are those at rest.
fn alignment(mesh: &FilmMesh, forces: &FilmForces, edge: HalfEdgeId) -> Option<f32> {
    let (a, b) = (mesh.topology.origin(edge), mesh.topology.target(edge));
    let at = |tip: VertexId, other: VertexId| forces.tip(tip).map(|crack| direction(mesh, tip, other).dot(crack));
    match (at(a, b), at(b, a)) {
        (Some(x), Some(y)) => Some(if x > y { x } else { y }),
        (x, y) => x.or(y),
    }
}

/// Returns the unit vector from one vertex to another at rest; zero where they coincide.
pub(super) fn direction(mesh: &FilmMesh, from: VertexId, to: VertexId) -> Vec3 {
    let rest = &mesh.geometry.rest_positions;
    (rest[to.index()] - rest[from.index()]).normalize_or_zero()
}
