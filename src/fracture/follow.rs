//! Draws the initial forces of a film from its seed, and draws them again when settings change.
//!
//! Initial forces are functions of seed, settings and place. What became of them since is stored apart from them, so
//! that it stays when they are drawn again: the adhesion that a wet vertex lost, the share of the contraction that a
//! face kept, the share of its binding that an edge kept.

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::{adhesion::adhesion_field, binding::Binding, drawn::Drawn, forces::FilmForces};
use crate::{
    film::{FilmMesh, Grain, HalfEdgeId},
    settings::{AdhesionSettings, CoatingSettings, TearingSettings},
};

/// Stream of the random numbers that choose weak edges. It keeps them independent of those that draw adhesion.
const WEAK_EDGE_STREAM: u64 = 1;

impl FilmForces {
    /// Makes the initial forces those that `settings` give, if they are not: adhesion (mean, deviation, octaves and
    /// frequency), contraction, binding and weak edges.
    ///
    /// They are drawn again with the film's seed. What was lost since stays lost: the adhesion that wore off, the share
    /// of its contraction that a face beside a crack gave up, and the share of its binding that an edge there lost. So
    /// a film follows as if it had had these settings and the same cracks from the start; what has torn stays torn, and
    /// what has separated stays separated. Forces that were set by hand stay as they are. Changing settings and
    /// changing them back leaves every bit as it was, except for those of
    /// [`ScaleSettings`](crate::settings::ScaleSettings) after a tear.
    ///
    /// [`age_forces`](super::age_forces) calls this in every step. Where nothing has changed it takes no time;
    /// otherwise the time is proportional to the size of the film (about a millisecond for 5,000 faces).
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
    /// let mut forces = FilmForces::new(&mesh, &settings, 7);
    /// let before = forces.clone();
    /// forces.set_adhesion(VertexId(2), f32::INFINITY); // a rivet
    ///
    /// settings.adhesion.mean += 1.0;
    /// forces.follow_settings(&mesh, &settings);
    /// assert!((forces.adhesion(VertexId(0)) - before.adhesion(VertexId(0)) - 1.0).abs() < 1e-6);
    /// assert_eq!(forces.adhesion(VertexId(2)), f32::INFINITY, "set by hand");
    /// # Ok::<(), bevy_coating::film::TopologyError>(())
    /// ```
    pub fn follow_settings(&mut self, mesh: &FilmMesh, settings: &CoatingSettings) {
        let drawn = Drawn::new(self.drawn.seed, &mesh.geometry, settings);
        if drawn == self.drawn {
            return;
        }
        let before = std::mem::replace(&mut self.drawn, drawn);
        let rules = before.grain != self.drawn.grain;
        if rules || before.adhesion != self.drawn.adhesion {
            self.draw_adhesion(mesh, &settings.adhesion);
        }
        if rules || before.binding != self.drawn.binding {
            self.draw_bindings(mesh, &settings.tearing);
        }
        let contraction = self.drawn.contraction;
        self.contractions.iter_mut().for_each(|face| face.renew(contraction));
        self.predictions.void_events();
    }

    /// Draws the initial adhesion of every vertex but those whose adhesion was set by hand. A duplicate gets that of
    /// its original, whose place it has.
    pub(super) fn draw_adhesion(&mut self, mesh: &FilmMesh, settings: &AdhesionSettings) {
        let field = adhesion_field(&mesh.geometry.rest_positions, settings, self.drawn.grain, self.drawn.seed);
        let shares = self.adhesion_share.iter().copied().chain(std::iter::repeat(1.0));
        let adhesion = self.adhesion_drawn.iter_mut().zip(&self.adhesion_by_hand);
        for ((adhesion, by_hand), (drawn, share)) in adhesion.zip(field.into_iter().zip(shares)) {
            if !by_hand {
                *adhesion = drawn * share;
            }
        }
    }

    /// Draws the initial binding of every edge but those that have torn or whose binding was set by hand.
    ///
    /// By the grain an edge is a defect with a probability in proportion to the area of its faces, so that there are as
    /// many on an area whatever the triangles. And an edge shorter than the grain decays beside a crack with a
    /// probability of the root of its length in grains: fine films have more edges beside each crack, and would branch
    /// more (junctions of a plate at age 1 with all edges decaying, h = s, s/2, s/4: 138, 201, 210; so: 127, 153, 144).
    pub(super) fn draw_bindings(&mut self, mesh: &FilmMesh, settings: &TearingSettings) {
        let topology = &mesh.topology;
        let mut draws = EdgeDraws::new(self, settings);
        let weak = settings.binding * settings.weak_factor;
        for h in topology.all_edges() {
            let Drawing { is_weak, decays } = draws.draw(mesh, h);
            if self.bindings[h.index()].decays() != decays {
                self.bindings[h.index()].set_decays(decays);
                self.update_decay(topology, h);
            }
            if !topology.is_torn(h) {
                self.bindings[h.index()].redraw(if is_weak { weak } else { settings.binding });
            }
        }
    }

    /// Draws the bindings of the `edges`, in ascending order, as those of a fresh film. `keep` is called with each.
    pub(super) fn draw_fresh_bindings(
        &mut self,
        mesh: &FilmMesh,
        settings: &TearingSettings,
        edges: impl Iterator<Item = HalfEdgeId>,
        mut keep: impl FnMut(&mut Self, HalfEdgeId, Binding),
    ) {
        let mut draws = EdgeDraws::new(self, settings);
        let weak = settings.binding * settings.weak_factor;
        let mut all = mesh.topology.all_edges();
        for h in edges {
            all.by_ref().take_while(|&other| other != h).for_each(|other| draws.pass_over(mesh, other));
            let Drawing { is_weak, decays } = draws.draw(mesh, h);
            let mut binding = Binding::new(if is_weak { weak } else { settings.binding });
            binding.set_decays(decays);
            keep(self, h, binding);
        }
    }
}

/// Random numbers of the edges of a fresh film, which are drawn in their order.
struct EdgeDraws {
    rng: ChaCha8Rng,
    /// Numbers that were drawn or passed over so far.
    count: u128,
    grain: Option<Grain>,
    weak_probability: f32,
}

/// What is drawn for an edge.
struct Drawing {
    is_weak: bool,
    /// Whether it decays beside a crack.
    decays: bool,
}

impl EdgeDraws {
    fn new(forces: &FilmForces, settings: &TearingSettings) -> Self {
        let mut rng = ChaCha8Rng::seed_from_u64(forces.drawn.seed);
        rng.set_stream(WEAK_EDGE_STREAM);
        Self { rng, count: 0, grain: forces.drawn.grain, weak_probability: settings.weak_probability }
    }

    /// Draws the next edge, `h`.
    fn draw(&mut self, mesh: &FilmMesh, h: HalfEdgeId) -> Drawing {
        if self.rng.get_word_pos() != self.count {
            self.rng.set_word_pos(self.count);
        }
        self.pass_over(mesh, h);
        let topology = &mesh.topology;
        let probability = |h: HalfEdgeId, twin: HalfEdgeId| match self.grain {
            Some(grain) => {
                let area = |h: HalfEdgeId| mesh.geometry.rest_area_of(topology, h.face());
                self.weak_probability / (2.0 * grain.face_area()) * (area(h) + area(twin))
            }
            None => self.weak_probability,
        };
        // Border edges never tear, so no number is drawn for them.
        let is_weak = topology.rest_twin(h).is_some_and(|twin| self.rng.random::<f32>() < probability(h, twin));
        let decays = match self.grain {
            Some(grain) => {
                let length = mesh.geometry.rest_lengths[h.index()] / grain.length;
                self.rng.random::<f32>() < length.sqrt()
            }
            None => true,
        };
        Drawing { is_weak, decays }
    }

    /// Passes over the next edge, `h`.
    fn pass_over(&mut self, mesh: &FilmMesh, h: HalfEdgeId) {
        self.count += u128::from(mesh.topology.rest_twin(h).is_some()) + u128::from(self.grain.is_some());
    }
}
