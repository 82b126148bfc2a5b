//! Forces in the film (VC 3.3).
//!
//! With age every vertex loses adhesion at one rate and every face gains contraction at one rate (VC 5.1, 5.2). Both are
//! kept once for the whole film; what is stored of a vertex or face is only how it differs from that.

use bevy_math::Vec3;
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::{adhesion_field, binding::Binding, predictions::Predictions, sigmoid};
use crate::{
    film::{FaceId, FilmMesh, FilmPieces, HalfEdgeId, InvariantError, LoosePieces, Topology, VertexId},
    settings::CoatingSettings,
};

/// Keeps the draw of weak edges apart from that of adhesion.
const WEAK_EDGE_STREAM: u64 = 1;

/// Forces and fracture state of a film, in units of the initial contraction.
///
/// After changing one of the public fields by hand, call [`FilmForces::touch_all`]; the methods that set forces see to
/// that themselves.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "plugin", derive(bevy::ecs::component::Component))]
pub struct FilmForces {
    /// Age at which each vertex separated; infinite while attached.
    pub separated_age: Vec<f32>,
    /// Unit direction of the crack that ends at each vertex, at rest; zero where none does.
    pub tips: Vec<Vec3>,
    /// Loose pieces that are too large to fall.
    pub loose: LoosePieces,
    /// Number of torn edges so far.
    pub torn_edges: u32,
    /// Number of separations so far.
    pub separations: u32,
    /// Adhesion of each vertex, but for `adhesion_lost`; where that is more, nothing is left.
    pub(super) adhesion_bases: Vec<f32>,
    /// Adhesion that every vertex has lost so far.
    pub(super) adhesion_lost: f64,
    /// Contraction of each face, but for `grown`.
    pub(super) contraction_bases: Vec<f32>,
    /// Contraction that every face has gained so far.
    pub(super) grown: f64,
    /// Binding of each edge, at its lower half-edge.
    pub(super) bindings: Vec<Binding>,
    /// Decay of binding so far: the sum of rate times age.
    pub(super) decay: f64,
    /// Sigmoid of each half-edge's rest dihedral (VC eq. 4); 0 at the open border, which exerts no force.
    pub(super) bend_weights: Vec<f32>,
    /// The gamma that `bend_weights` was computed with.
    pub(super) gamma: f32,
    pub(super) predictions: Predictions,
}

impl FilmForces {
    /// The forces of a fresh film. `seed` draws the adhesion and the weak edges.
    pub fn new(mesh: &FilmMesh, settings: &CoatingSettings, seed: u64) -> Self {
        let topology = &mesh.topology;
        let mut forces = Self {
            separated_age: vec![f32::INFINITY; topology.vertex_count()],
            tips: vec![Vec3::ZERO; topology.vertex_count()],
            adhesion_bases: adhesion_field(&mesh.geometry.rest_positions, &settings.adhesion, seed),
            contraction_bases: vec![settings.tearing.contraction; topology.face_count()],
            bindings: vec![Binding::new(settings.tearing.binding); topology.half_edge_count()],
            gamma: f32::NAN,
            ..Self::default()
        };
        forces.weaken_edges(topology, settings, seed);
        forces.set_gamma(mesh, settings.bending.gamma);
        forces.find_pieces(topology);
        forces
    }

    fn weaken_edges(&mut self, topology: &Topology, settings: &CoatingSettings, seed: u64) {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        rng.set_stream(WEAK_EDGE_STREAM);
        for h in topology.all_edges().filter(|&h| topology.rest_twin(h).is_some()) {
            if rng.random::<f32>() < settings.tearing.weak_probability {
                self.bindings[h.index()] = Binding::new(settings.tearing.binding * settings.tearing.weak_factor);
            }
        }
    }

    /// Recomputes what depends on gamma; does nothing when it has not changed.
    pub fn set_gamma(&mut self, mesh: &FilmMesh, gamma: f32) {
        if self.gamma == gamma {
            return;
        }
        self.gamma = gamma;
        self.bend_weights.clear();
        self.bend_weights.extend(mesh.topology.all_half_edges().map(|h| {
            let inner = mesh.topology.rest_twin(h).is_some();
            if inner { sigmoid(mesh.geometry.rest_dihedrals[h.index()], gamma) } else { 0.0 }
        }));
    }

    /// Whether `v` still holds on to the metal.
    #[inline]
    pub fn is_attached(&self, v: VertexId) -> bool {
        self.separated_age[v.index()] == f32::INFINITY
    }

    /// Adhesion of `v` to the metal: 0 or more.
    #[inline]
    pub fn adhesion(&self, v: VertexId) -> f32 {
        (self.adhesion_bases[v.index()] - self.adhesion_lost as f32).max(0.0)
    }

    /// Sets the adhesion of `v` now; it goes on falling with age. Infinite: `v` never separates.
    pub fn set_adhesion(&mut self, v: VertexId, adhesion: f32) {
        self.adhesion_bases[v.index()] = adhesion + self.adhesion_lost as f32;
        self.predictions.separations.touch(v.0);
    }

    /// Contraction of `f`.
    #[inline]
    pub fn contraction(&self, f: FaceId) -> f32 {
        self.contraction_bases[f.index()] + self.grown as f32
    }

    /// Sets the contraction of `f` now; it goes on growing with age.
    pub fn set_contraction(&mut self, topology: &Topology, f: FaceId, contraction: f32) {
        self.contraction_bases[f.index()] = contraction - self.grown as f32;
        for h in f.half_edges() {
            self.predictions.separations.touch(topology.origin(h).0);
            self.predictions.tears.touch(topology.edge(h).0);
        }
    }

    /// Leaves the share `kept` of the contraction of `f`.
    pub(super) fn relieve(&mut self, f: FaceId, kept: f32) {
        self.contraction_bases[f.index()] = self.contraction(f) * kept - self.grown as f32;
    }

    /// Binding of the edge of `h`; of an edge that has torn, the last that it had.
    #[inline]
    pub fn binding(&self, topology: &Topology, h: HalfEdgeId) -> f32 {
        self.bindings[topology.edge(h).index()].force(self.decay)
    }

    /// Sets the binding of the edge of `h` now; it goes on decaying next to torn edges. Infinite: it never tears.
    pub fn set_binding(&mut self, topology: &Topology, h: HalfEdgeId, binding: f32) {
        let edge = topology.edge(h);
        self.bindings[edge.index()].set_force(binding, self.decay);
        self.predictions.tears.touch(edge.0);
    }

    /// Direction of the crack that ends at `v`.
    #[inline]
    pub fn tip(&self, v: VertexId) -> Option<Vec3> {
        let d = self.tips[v.index()];
        (d != Vec3::ZERO).then_some(d)
    }

    /// Contraction that pulls at the edge of `h`, and the binding that holds it (VC 5.2); `None` when the
    /// edge is no longer, or never was, between two faces.
    #[inline]
    pub fn pull_and_binding(&self, topology: &Topology, h: HalfEdgeId) -> Option<(f32, f32)> {
        let twin = topology.bound_twin(h)?;
        let pull = self.contraction(h.face()) + self.contraction(twin.face());
        Some((pull, self.binding(topology, h)))
    }

    /// Has every vertex, edge and face looked at in the next step, whatever was predicted.
    pub fn touch_all(&mut self) {
        self.predictions = Predictions { rates: self.predictions.rates, ..Predictions::default() };
    }

    /// Finds out which faces hang together, where that is not known.
    pub(super) fn find_pieces(&mut self, topology: &Topology) {
        if !self.predictions.pieces.fits(topology) {
            self.predictions.pieces = FilmPieces::new(topology, |v| self.separated_age[v.index()] == f32::INFINITY);
            self.loose = LoosePieces::default();
        }
    }

    /// Copies all that belongs to `v` to a new vertex at the end. A split vertex is no crack tip.
    pub(super) fn duplicate_vertex(&mut self, v: VertexId) {
        self.adhesion_bases.push(self.adhesion_bases[v.index()]);
        self.separated_age.push(self.separated_age[v.index()]);
        self.tips[v.index()] = Vec3::ZERO;
        self.tips.push(Vec3::ZERO);
    }

    /// Checks the forces against their film: one entry an element; decay of binding as torn edges have it; pieces as they
    /// are found from scratch.
    ///
    /// # Errors
    /// The first [`InvariantError`] found.
    pub fn validate(&self, topology: &Topology) -> Result<(), InvariantError> {
        let (vertices, half_edges) = (topology.vertex_count(), topology.half_edge_count());
        for (name, found, expected) in [
            ("adhesion", self.adhesion_bases.len(), vertices),
            ("separated_age", self.separated_age.len(), vertices),
            ("tips", self.tips.len(), vertices),
            ("contraction", self.contraction_bases.len(), topology.face_count()),
            ("bindings", self.bindings.len(), half_edges),
            ("bend_weights", self.bend_weights.len(), half_edges),
        ] {
            if found != expected {
                return Err(InvariantError::ArrayLength(name));
            }
        }
        for h in topology.all_edges() {
            let decaying = topology.torn_faces(h);
            if self.bindings[h.index()].torn_faces() != decaying {
                return Err(InvariantError::Decay(h));
            }
        }
        let known = self.predictions.pieces.fits(topology);
        if known && !self.predictions.pieces.agrees(topology, &self.loose, |v| self.is_attached(v)) {
            return Err(InvariantError::Pieces);
        }
        Ok(())
    }
}
