//! Forces in the film and how they age (VC 3.3, 5.1, 5.2).

use bevy_math::{Vec3, ops};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::{adhesion_field, sigmoid};
use crate::{
    film::{FilmMesh, HalfEdgeId, LoosePieces, Topology, VertexId},
    settings::CoatingSettings,
};

/// Keeps the draw of weak edges apart from that of adhesion.
const WEAK_EDGE_STREAM: u64 = 1;

/// Forces and fracture state of a film, in units of the initial contraction.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FilmForces {
    /// Adhesion of each vertex to the metal.
    pub adhesion: Vec<f32>,
    /// Age at which each vertex separated; infinite while attached.
    pub separated_age: Vec<f32>,
    /// Contraction of each face.
    pub contraction: Vec<f32>,
    /// Binding of each half-edge's edge; the same on both.
    pub binding: Vec<f32>,
    /// Sigmoid of each half-edge's rest dihedral (VC eq. 4); 0 at the open border, which exerts no force.
    pub bend_weights: Vec<f32>,
    /// The gamma that `bend_weights` was computed with.
    pub gamma: f32,
    /// Unit direction of the crack that ends at each vertex, at rest; zero where none does.
    pub tips: Vec<Vec3>,
    /// Loose pieces that are too large to fall.
    pub loose: LoosePieces,
    /// Number of torn edges so far.
    pub torn_edges: u32,
}

impl FilmForces {
    /// The forces of a fresh film. `seed` draws the adhesion and the weak edges.
    pub fn new(mesh: &FilmMesh, settings: &CoatingSettings, seed: u64) -> Self {
        let topology = &mesh.topology;
        let mut forces = Self {
            adhesion: adhesion_field(&mesh.geometry.rest_positions, &settings.adhesion, seed),
            separated_age: vec![f32::INFINITY; topology.vertex_count()],
            contraction: vec![settings.tearing.contraction; topology.face_count()],
            binding: vec![settings.tearing.binding; topology.half_edge_count()],
            bend_weights: Vec::new(),
            gamma: f32::NAN,
            tips: vec![Vec3::ZERO; topology.vertex_count()],
            loose: LoosePieces::default(),
            torn_edges: 0,
        };
        forces.weaken_edges(topology, settings, seed);
        forces.set_gamma(mesh, settings.bending.gamma);
        forces
    }

    fn weaken_edges(&mut self, topology: &Topology, settings: &CoatingSettings, seed: u64) {
        let mut rng = ChaCha8Rng::seed_from_u64(seed);
        rng.set_stream(WEAK_EDGE_STREAM);
        for h in topology.all_edges() {
            let Some(twin) = topology.rest_twin(h) else { continue };
            if rng.random::<f32>() < settings.tearing.weak_probability {
                let binding = settings.tearing.binding * settings.tearing.weak_factor;
                self.binding[h.index()] = binding;
                self.binding[twin.index()] = binding;
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
        let pull = self.contraction[h.face().index()] + self.contraction[twin.face().index()];
        Some((pull, self.binding[h.index()]))
    }

    /// Copies all that belongs to `v` to a new vertex at the end. A split vertex is no crack tip.
    pub(super) fn duplicate_vertex(&mut self, v: VertexId) {
        self.adhesion.push(self.adhesion[v.index()]);
        self.separated_age.push(self.separated_age[v.index()]);
        self.tips[v.index()] = Vec3::ZERO;
        self.tips.push(Vec3::ZERO);
    }
}

/// Ages the forces by `dt`: adhesion falls (VC 5.1), faster where the film is wet, contraction grows, and the bound
/// edges of a face that has a torn one lose binding, once for each such face (VC 5.2). `moisture` is that of each
/// vertex, or empty where all is dry.
pub fn age_forces(mesh: &FilmMesh, forces: &mut FilmForces, settings: &CoatingSettings, moisture: &[f32], dt: f32) {
    forces.set_gamma(mesh, settings.bending.gamma);
    let fall = settings.adhesion.decay * dt;
    for adhesion in &mut forces.adhesion {
        *adhesion = (*adhesion - fall).max(0.0);
    }
    let wet_fall = fall * settings.moisture.adhesion;
    if wet_fall > 0.0 {
        for (adhesion, &moisture) in forces.adhesion.iter_mut().zip(moisture) {
            *adhesion = (*adhesion - wet_fall * moisture).max(0.0);
        }
    }
    let growth = settings.tearing.contraction_growth * dt;
    for contraction in &mut forces.contraction {
        *contraction += growth;
    }
    if forces.torn_edges == 0 {
        return;
    }
    let topology = &mesh.topology;
    let kept = ops::exp(-settings.tearing.binding_decay * dt);
    for f in topology.live_faces() {
        if !topology.has_torn_edge(f) {
            continue;
        }
        for h in f.half_edges() {
            if let Some(twin) = topology.bound_twin(h) {
                let binding = forces.binding[h.index()] * kept;
                forces.binding[h.index()] = binding;
                forces.binding[twin.index()] = binding;
            }
        }
    }
}
