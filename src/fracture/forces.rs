//! Keeps the forces in a film and its fracture state (VC 3.3).
//!
//! With age every vertex loses adhesion at one rate and every face gains contraction at one rate (VC 5.1, 5.2). Both
//! amounts are counted once for the whole film; what is stored for a vertex or a face is only the difference from them.

use bevy_math::Vec3;

use super::{
    binding::Binding,
    drawn::{Contraction, Drawn},
    predictions::Predictions,
    sigmoid::sigmoid,
};
use crate::{
    film::{FaceId, FilmMesh, Grain, HalfEdgeId, LoosePieces, Topology, VertexId},
    settings::CoatingSettings,
};

/// Forces and fracture state of one film (VC 3.3). Every force is in units of the initial contraction.
///
/// The methods that set a force make the next step judge the elements that it concerns. After changing a public field
/// by hand, call [`FilmForces::touch_all`]. Methods that take a handle panic if the film has no such element.
///
/// ```
/// use bevy_coating::{
///     film::{FilmMesh, HalfEdgeId, VertexId},
///     fracture::FilmForces,
///     settings::CoatingSettings,
/// };
/// use bevy_math::Vec3;
///
/// // Two triangles that share the edge from vertex 1 to vertex 2.
/// let corners = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::new(1.0, 1.0, 0.0)];
/// let mesh = FilmMesh::new(corners, &[[0, 1, 2], [2, 1, 3]])?;
/// let shared = HalfEdgeId(1);
///
/// let mut forces = FilmForces::new(&mesh, &CoatingSettings::default(), 7);
/// forces.set_adhesion(VertexId(0), f32::INFINITY); // a rivet: the film never separates here
/// forces.set_binding(&mesh.topology, shared, 0.5); // a scratch: the film tears here first
///
/// assert!(forces.is_attached(VertexId(0)));
/// let (pull, binding) = forces.pull_and_binding(&mesh.topology, shared).expect("two faces share it");
/// assert_eq!((pull, binding), (2.0, 0.5));
/// # Ok::<(), bevy_coating::film::TopologyError>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "plugin", derive(bevy::ecs::component::Component), component(clone_behavior = Ignore))]
pub struct FilmForces {
    /// Age at which each vertex separated; infinite while it is attached.
    pub separated_age: Vec<f32>,
    /// Unit vector along which a crack ends at each vertex, in rest positions; zero where no crack ends.
    pub tips: Vec<Vec3>,
    /// Pieces of the film that hang loose but are too large to fall: no vertex of theirs is attached.
    pub loose: LoosePieces,
    /// Number of edges that have torn so far.
    pub torn_edges: u32,
    /// Number of vertices that have separated so far, duplicates not counted.
    pub separations: u32,
    /// Seed and settings that the initial forces were drawn with.
    pub(super) drawn: Drawn,
    /// Adhesion of each vertex before any loss: drawn with the film's seed, or set by hand.
    pub(super) adhesion_drawn: Vec<f32>,
    /// Whether the adhesion of each vertex was set by hand, so that it does not follow settings.
    pub(super) adhesion_by_hand: Vec<bool>,
    /// Adhesion that each vertex has lost by being wet or by hand, beyond what every vertex has lost. It is negative
    /// where adhesion was added.
    pub(super) adhesion_lost_wet: Vec<f32>,
    /// Share of the drawn adhesion that each vertex has got: 1 where nothing was done to it. Empty while it is 1
    /// everywhere.
    pub(super) adhesion_share: Vec<f32>,
    /// Whether each vertex was attached again with new paint and has not separated since. Only there may a vertex be
    /// attached at a torn edge. Empty while nothing was renewed.
    pub(super) rebound: Vec<bool>,
    /// Adhesion that every vertex has lost so far. Adhesion is 0 where more was lost than there was.
    pub(super) adhesion_lost: f64,
    /// Contraction of each face, less what every face has gained.
    pub(super) contractions: Vec<Contraction>,
    /// Contraction that all faces had gained before each was painted over: it has less by that. Empty while none was.
    pub(super) contraction_spared: Vec<f32>,
    /// Contraction that every face has gained so far.
    pub(super) contraction_gained: f64,
    /// Binding of each edge, at the index of its lower half-edge.
    pub(super) bindings: Vec<Binding>,
    /// Decay of binding so far: the sum of rate times age.
    pub(super) binding_decay: f64,
    /// Sigmoid of the rest dihedral angle of each half-edge (VC eq. 4); 0 at the open border, which exerts no force.
    pub(super) bend_weights: Vec<f32>,
    /// Gamma that `bend_weights` was computed with.
    pub(super) gamma: f32,
    /// Age at which each face came loose, with the piece that it is in; infinite before. Empty by the paper's rules.
    pub(super) loose_since: Vec<f32>,
    /// Necks that would tear if one of their sides were not held. None by the paper's rules.
    pub(super) necks: Vec<Neck>,
    /// Predicted events and connected pieces.
    pub(super) predictions: Predictions,
}

/// A neck that would tear if one of its two sides were not held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Neck {
    /// Vertex at the border of the film at which the neck ends.
    pub at: VertexId,
    /// An attached vertex on each side; the same twice where one side is too large for a flap.
    pub held_by: [VertexId; 2],
}

impl FilmForces {
    /// Creates the forces of a fresh film, on which every vertex is attached.
    ///
    /// `seed` draws the adhesion of each vertex ([`adhesion_field`](super::adhesion_field)) and the weak edges, each
    /// inner edge with the probability [`weak_probability`](crate::settings::TearingSettings::weak_probability) (VC
    /// 5.2). The same mesh, settings and seed give the same bits.
    ///
    /// ```
    /// use bevy_coating::{film::FilmMesh, fracture::FilmForces, settings::CoatingSettings};
    /// use bevy_math::Vec3;
    ///
    /// let mesh = FilmMesh::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y], &[[0, 1, 2]])?;
    /// let forces = FilmForces::new(&mesh, &CoatingSettings::default(), 7);
    /// assert!(mesh.topology.all_vertices().all(|v| forces.is_attached(v)));
    /// # Ok::<(), bevy_coating::film::TopologyError>(())
    /// ```
    pub fn new(mesh: &FilmMesh, settings: &CoatingSettings, seed: u64) -> Self {
        let topology = &mesh.topology;
        let vertices = topology.vertex_count();
        let mut forces = Self {
            separated_age: vec![f32::INFINITY; vertices],
            tips: vec![Vec3::ZERO; vertices],
            drawn: Drawn::new(seed, &mesh.geometry, settings),
            adhesion_drawn: vec![0.0; vertices],
            adhesion_by_hand: vec![false; vertices],
            adhesion_lost_wet: vec![0.0; vertices],
            contractions: vec![Contraction::new(settings.tearing.contraction); topology.face_count()],
            bindings: vec![Binding::new(0.0); topology.half_edge_count()],
            gamma: f32::NAN,
            ..Self::default()
        };
        forces.draw_adhesion(mesh, &settings.adhesion);
        forces.draw_bindings(mesh, &settings.tearing);
        forces.set_gamma(mesh, settings.bending.gamma);
        forces.find_pieces(topology);
        forces
    }

    /// Sets the steepness of the [`sigmoid`](super::sigmoid) in the bending force, per radian (VC eq. 4).
    ///
    /// Computes the weight of every half-edge again if `gamma` has changed and does nothing otherwise.
    /// [`age_forces`](super::age_forces) calls this in every step with the gamma of its settings.
    ///
    /// ```
    /// use bevy_coating::{
    ///     film::{FilmMesh, VertexId},
    ///     fracture::{FilmForces, bending_force},
    ///     settings::CoatingSettings,
    /// };
    /// use bevy_math::Vec3;
    ///
    /// // Two triangles that meet in a ridge.
    /// let corners = vec![Vec3::NEG_X, Vec3::new(0.0, -1.0, 1.0), Vec3::new(0.0, 1.0, 1.0), Vec3::X];
    /// let mesh = FilmMesh::new(corners, &[[0, 1, 2], [2, 1, 3]])?;
    /// let mut forces = FilmForces::new(&mesh, &CoatingSettings::default(), 7);
    /// let before = bending_force(&mesh, &forces, VertexId(0), 1.0);
    /// forces.set_gamma(&mesh, 4.0);
    /// assert!(bending_force(&mesh, &forces, VertexId(0), 1.0) > before, "ridges are lifted more");
    /// # Ok::<(), bevy_coating::film::TopologyError>(())
    /// ```
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

    /// Returns the grain by which the film's fracture is measured, or `None` by the paper's rules.
    pub fn grain(&self) -> Option<Grain> {
        self.drawn.grain
    }

    /// Returns the seed that the film's initial forces were drawn with.
    pub fn seed(&self) -> u64 {
        self.drawn.seed
    }

    /// Returns whether `v` is still attached to the metal.
    #[inline]
    pub fn is_attached(&self, v: VertexId) -> bool {
        self.separated_age[v.index()] == f32::INFINITY
    }

    /// Returns the adhesion of `v` to the metal, 0 or more (VC 5.1).
    #[inline]
    pub fn adhesion(&self, v: VertexId) -> f32 {
        let i = v.index();
        (self.adhesion_drawn[i] - self.adhesion_lost_wet[i] - self.adhesion_lost as f32).max(0.0)
    }

    /// Sets the present adhesion of `v`, which goes on falling with age but no longer follows settings. With an
    /// infinite adhesion `v` never separates.
    ///
    /// ```
    /// use bevy_coating::{
    ///     film::{FilmMesh, VertexId},
    ///     fracture::FilmForces,
    ///     settings::CoatingSettings,
    /// };
    /// use bevy_math::Vec3;
    ///
    /// let mesh = FilmMesh::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y], &[[0, 1, 2]])?;
    /// let mut forces = FilmForces::new(&mesh, &CoatingSettings::default(), 7);
    /// forces.set_adhesion(VertexId(2), 0.25);
    /// assert_eq!(forces.adhesion(VertexId(2)), 0.25);
    /// # Ok::<(), bevy_coating::film::TopologyError>(())
    /// ```
    pub fn set_adhesion(&mut self, v: VertexId, adhesion: f32) {
        let i = v.index();
        self.adhesion_drawn[i] = adhesion + self.adhesion_lost as f32;
        self.adhesion_lost_wet[i] = 0.0;
        self.adhesion_by_hand[i] = true;
        if let Some(share) = self.adhesion_share.get_mut(i) {
            *share = 1.0;
        }
        self.predictions.separations.make_due(v.0);
    }

    /// Multiplies the adhesion that was drawn for `v` by `factor`, from 0 to 1,000: as if the paint had been put on so
    /// from the start. Unlike [`set_adhesion`](Self::set_adhesion), it goes on following settings.
    ///
    /// ```
    /// use bevy_coating::{
    ///     film::{FilmMesh, VertexId},
    ///     fracture::FilmForces,
    ///     settings::CoatingSettings,
    /// };
    /// use bevy_math::Vec3;
    ///
    /// let mesh = FilmMesh::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y], &[[0, 1, 2]])?;
    /// let mut settings = CoatingSettings::default();
    /// settings.adhesion.deviation = 0.0;
    /// let mut forces = FilmForces::new(&mesh, &settings, 7);
    /// forces.scale_adhesion(VertexId(2), 2.0);
    /// settings.adhesion.mean = 1.5;
    /// forces.follow_settings(&mesh, &settings);
    /// assert_eq!([0, 2].map(|v| forces.adhesion(VertexId(v))), [1.5, 3.0]);
    /// # Ok::<(), bevy_coating::film::TopologyError>(())
    /// ```
    pub fn scale_adhesion(&mut self, v: VertexId, factor: f32) {
        let i = v.index();
        self.adhesion_share.resize(self.adhesion_drawn.len(), 1.0);
        self.adhesion_share[i] *= factor;
        self.adhesion_drawn[i] *= factor;
        self.predictions.separations.make_due(v.0);
    }

    /// Adds `force` to the adhesion of `v`, which goes on following settings. Adhesion never falls below 0.
    pub fn add_adhesion(&mut self, v: VertexId, force: f32) {
        self.adhesion_lost_wet[v.index()] -= force;
        self.predictions.separations.make_due(v.0);
    }

    /// Returns the contraction of `f` (VC 3.3).
    #[inline]
    pub fn contraction(&self, f: FaceId) -> f32 {
        self.contractions[f.index()].less_gained(self.drawn.contraction) + self.contraction_gained as f32
    }

    /// Sets the present contraction of `f`, which goes on growing with age but no longer follows settings.
    ///
    /// ```
    /// use bevy_coating::{
    ///     film::{FaceId, FilmMesh},
    ///     fracture::FilmForces,
    ///     settings::CoatingSettings,
    /// };
    /// use bevy_math::Vec3;
    ///
    /// let mesh = FilmMesh::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y], &[[0, 1, 2]])?;
    /// let mut forces = FilmForces::new(&mesh, &CoatingSettings::default(), 7);
    /// assert_eq!(forces.contraction(FaceId(0)), 1.0);
    /// forces.set_contraction(&mesh.topology, FaceId(0), 1.5);
    /// assert_eq!(forces.contraction(FaceId(0)), 1.5);
    /// # Ok::<(), bevy_coating::film::TopologyError>(())
    /// ```
    pub fn set_contraction(&mut self, topology: &Topology, f: FaceId, contraction: f32) {
        let (base, drawn) = (contraction - self.contraction_gained as f32, self.drawn.contraction);
        self.contractions[f.index()] = Contraction { base, share: 0.0, drawn };
        for h in f.half_edges() {
            self.predictions.separations.make_due(topology.origin(h).0);
            self.predictions.tears.make_due(topology.edge(h).0);
        }
    }

    /// Multiplies the present contraction of `f` by `factor`, from 0 to 1,000. It goes on following settings.
    pub fn scale_contraction(&mut self, topology: &Topology, f: FaceId, factor: f32) {
        self.relieve(f, factor);
        for h in f.half_edges() {
            self.predictions.separations.make_due(topology.original(topology.origin(h)).0);
            self.predictions.tears.make_due(topology.edge(h).0);
        }
    }

    /// Multiplies the present binding of the edge of `h` by `factor`, from 0 to 1,000. It goes on following settings,
    /// and decaying beside torn edges.
    pub fn scale_binding(&mut self, topology: &Topology, h: HalfEdgeId, factor: f32) {
        let edge = topology.edge(h);
        self.bindings[edge.index()].scale(factor);
        self.predictions.tears.make_due(edge.0);
    }

    /// Returns the binding of the edge of `h` (VC 3.3). Once the edge has torn, returns the last binding that it had.
    #[inline]
    pub fn binding(&self, topology: &Topology, h: HalfEdgeId) -> f32 {
        self.bindings[topology.edge(h).index()].force(self.binding_decay)
    }

    /// Sets the present binding of the edge of `h`, which goes on decaying beside torn edges but no longer follows
    /// settings. With an infinite binding the edge never tears.
    ///
    /// ```
    /// use bevy_coating::{
    ///     film::{FilmMesh, HalfEdgeId},
    ///     fracture::FilmForces,
    ///     settings::CoatingSettings,
    /// };
    /// use bevy_math::Vec3;
    ///
    /// let mesh = FilmMesh::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y], &[[0, 1, 2]])?;
    /// let mut forces = FilmForces::new(&mesh, &CoatingSettings::default(), 7);
    /// forces.set_binding(&mesh.topology, HalfEdgeId(0), 3.0);
    /// assert_eq!(forces.binding(&mesh.topology, HalfEdgeId(0)), 3.0);
    /// # Ok::<(), bevy_coating::film::TopologyError>(())
    /// ```
    pub fn set_binding(&mut self, topology: &Topology, h: HalfEdgeId, binding: f32) {
        let edge = topology.edge(h);
        self.bindings[edge.index()].set_force(binding, self.binding_decay);
        self.predictions.tears.make_due(edge.0);
    }

    /// Returns the unit vector along which a crack ends at `v`, in rest positions, or `None` if no crack ends there.
    #[inline]
    pub fn tip(&self, v: VertexId) -> Option<Vec3> {
        let d = self.tips[v.index()];
        (d != Vec3::ZERO).then_some(d)
    }

    /// Returns the sum of the contractions of the two faces at the edge of `h`, and the binding that holds them
    /// together (VC 5.2). Returns `None` if the edge is not between two bound faces.
    #[inline]
    pub fn pull_and_binding(&self, topology: &Topology, h: HalfEdgeId) -> Option<(f32, f32)> {
        let twin = topology.bound_twin(h)?;
        let pull = self.contraction(h.face()) + self.contraction(twin.face());
        Some((pull, self.binding(topology, h)))
    }

    /// Discards all predictions, so that the next step judges every vertex and every edge. Needed after a public field
    /// was changed by hand.
    ///
    /// ```
    /// use bevy_coating::{
    ///     film::{FilmMesh, VertexId},
    ///     fracture::FilmForces,
    ///     settings::CoatingSettings,
    /// };
    /// use bevy_math::Vec3;
    ///
    /// let mesh = FilmMesh::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y], &[[0, 1, 2]])?;
    /// let mut forces = FilmForces::new(&mesh, &CoatingSettings::default(), 7);
    /// forces.separated_age.fill(0.0);
    /// forces.touch_all();
    /// assert!(!forces.is_attached(VertexId(0)));
    /// # Ok::<(), bevy_coating::film::TopologyError>(())
    /// ```
    pub fn touch_all(&mut self) {
        self.predictions = Predictions { rates: self.predictions.rates, ..Predictions::default() };
    }
}
