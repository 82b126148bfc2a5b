//! When an edge gives way (VC 5.2).

use bevy_math::{Vec3, ops};

use super::FilmForces;
use crate::{
    film::{FilmMesh, HalfEdgeId, VertexId},
    settings::TearingSettings,
};

/// Steps of Newton's method for one prediction: each is closer by far, and a further look at an edge costs more.
const NEWTON_STEPS: usize = 3;

/// Balance of an edge between two separated ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct Balance {
    /// Largest cosine between the edge and a crack that ends at it; `None` at no tip.
    pub alignment: Option<f32>,
    /// Contraction of its two faces.
    pull: f32,
    /// What holds against that: its binding, less where it runs on from a crack's tip.
    hold: f32,
}

impl Balance {
    /// Balance of `edge`; `None` where it is not between two faces or an end is attached.
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

    /// Contraction over binding if the edge is to tear now.
    pub fn overload(&self) -> Option<f32> {
        // A binding that has decayed to nothing must still order by pull, not divide by zero.
        (self.pull > self.hold).then(|| self.pull / self.hold.max(f32::MIN_POSITIVE))
    }

    /// In how many steps `edge`, which holds now, can tear at the earliest, as long as nothing tears around it.
    ///
    /// `hold exp(-faces decay n) - pull - 2 growth n` is convex and falls with the steps n, so Newton's method comes
    /// closer from the left and never goes beyond the root; what rounding may bring forward is taken off first.
    pub fn steps_until_tear(&self, forces: &FilmForces, edge: HalfEdgeId) -> f64 {
        let rates = forces.predictions.rates;
        let (pull, hold) = (f64::from(self.pull), f64::from(self.hold));
        let decay = f64::from(forces.bindings[edge.index()].torn_faces()) * rates.decay;
        let growth = 2.0 * rates.growth;
        if hold == f64::INFINITY || (growth == 0.0 && decay == 0.0) {
            return f64::INFINITY;
        }
        let rounding = f64::from(8.0 * f32::EPSILON);
        let slack = rounding * (hold * (1.0 + forces.decay) + pull + 2.0 * forces.grown);
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
pub(super) fn direction(mesh: &FilmMesh, from: VertexId, to: VertexId) -> Vec3 {
    let rest = &mesh.geometry.rest_positions;
    (rest[to.index()] - rest[from.index()]).normalize_or_zero()
}
