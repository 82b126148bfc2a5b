//! Forces of a film that was mended in place.

use bevy_math::Vec3;

use super::{
    adhesion::adhesion_at,
    forces::{FilmForces, Neck},
    scratch::FractureScratch,
};
use crate::{
    coding::Damage,
    film::{FilmMesh, Mend, VertexId},
    settings::CoatingSettings,
};

impl FilmForces {
    /// Makes ready for a mend, before the mesh of the film is mended. Returns the settings that the forces of fresh
    /// paint are drawn with.
    ///
    /// # Errors
    /// [`Damage`] if the settings that the forces were drawn with were changed by hand so that there are none such.
    pub(crate) fn begin_mend(&mut self, mesh: &FilmMesh) -> Result<CoatingSettings, Damage> {
        self.find_pieces(&mesh.topology);
        self.settings_drawn_with(&mesh.geometry)
    }

    /// Makes these the forces of the film that was mended to `mesh`, as [`renew`](Self::renew) would. `settings` are
    /// those of [`begin_mend`](Self::begin_mend), and `age` is that of the film.
    pub(crate) fn mend(
        &mut self,
        mesh: &FilmMesh,
        mend: &Mend,
        settings: &CoatingSettings,
        age: f32,
        scratch: &mut FractureScratch,
    ) {
        let topology = &mesh.topology;
        let was_attached: Vec<VertexId> =
            mend.before.iter().map(|former| former.vertex).filter(|&v| self.is_attached(v)).collect();
        let separated = |forces: &Self| mend.places.iter().filter(|&&v| !forces.is_attached(v)).count() as u32;
        let separated_before = separated(self);
        mend.appended.iter().for_each(|&original| self.duplicate_vertex(original));
        self.rebound.resize(topology.vertex_count(), false);
        for &[from, to] in &mend.moved {
            self.move_vertex(from.index(), to.index(), age);
        }
        for v in mend.left.iter().chain(&mend.places) {
            self.tips[v.index()] = Vec3::ZERO;
        }
        self.renew_corners(mesh, mend, settings, age);
        self.separations = self.separations.saturating_sub(separated_before) + separated(self);
        self.torn_edges = (self.torn_edges + mend.torn.len() as u32).saturating_sub(mend.mended.len() as u32);
        self.renew_faces(mend.faces.iter().copied());
        self.mend_bindings(mesh, mend, settings);
        let renamed = |&Neck { at, held_by: [a, b] }: &Neck| {
            Some(Neck { at: mend.now(at)?, held_by: [mend.now(a)?, mend.now(b)?] })
        };
        self.necks = self.necks.iter().filter_map(renamed).collect();
        for v in &mend.originals {
            self.predictions.separations.make_due(v.0);
        }
        let (mut pieces, mut loose) = (std::mem::take(&mut self.predictions.pieces), std::mem::take(&mut self.loose));
        let was_attached = |v: VertexId| was_attached.binary_search(&v).is_ok();
        pieces.mend(topology, mend, &mut loose, &mut scratch.pieces, was_attached, |v| self.is_attached(v));
        (self.predictions.pieces, self.loose) = (pieces, loose);
    }

    /// Lets a duplicate have what vertex `from` had, whose fan it takes. No duplicate is ever attached: one that new
    /// paint has taken the place of lets go.
    fn move_vertex(&mut self, from: usize, to: usize, age: f32) {
        self.adhesion_drawn[to] = self.adhesion_drawn[from];
        self.adhesion_by_hand[to] = self.adhesion_by_hand[from];
        self.adhesion_lost_wet[to] = self.adhesion_lost_wet[from];
        if let Some(&share) = self.adhesion_share.get(from) {
            self.adhesion_share[to] = share;
        }
        self.rebound[to] = false;
        self.separated_age[to] = if self.separated_age[from] < f32::INFINITY { self.separated_age[from] } else { age };
        self.tips[to] = Vec3::ZERO;
    }

    /// Gives the corners of new faces the forces of fresh paint. It holds at original vertices; at others it hangs on
    /// its neighbours.
    fn renew_corners(&mut self, mesh: &FilmMesh, mend: &Mend, settings: &CoatingSettings, age: f32) {
        let originals = mesh.topology.original_vertex_count();
        let lost = self.adhesion_lost as f32;
        let rest = mesh.geometry.rest_positions.get(..originals).unwrap_or_default();
        let places = mend.fresh.iter().map(|&v| rest[mesh.topology.original(v).index()]);
        let drawn = adhesion_at(rest, places, &settings.adhesion, self.drawn.grain, self.drawn.seed);
        for (&v, drawn) in mend.fresh.iter().zip(drawn) {
            let i = v.index();
            let holds = i < originals;
            self.adhesion_drawn[i] = drawn;
            self.adhesion_by_hand[i] = false;
            // It has lost nothing yet of what all have.
            self.adhesion_lost_wet[i] = -lost;
            if let Some(share) = self.adhesion_share.get_mut(i) {
                *share = 1.0;
            }
            self.rebound[i] = holds;
            self.separated_age[i] = if holds { f32::INFINITY } else { age };
            self.tips[i] = Vec3::ZERO;
        }
    }

    /// Gives new edges their bindings, and has each edge beside them decay by the torn edges that there are now.
    fn mend_bindings(&mut self, mesh: &FilmMesh, mend: &Mend, settings: &CoatingSettings) {
        let topology = &mesh.topology;
        let decay = self.binding_decay;
        let new = mend.edges.iter().copied().filter(|&h| mend.is_new_edge(topology, h));
        self.draw_fresh_bindings(mesh, &settings.tearing, new, |forces, h, binding| {
            forces.bindings[h.index()] = binding;
        });
        for &h in &mend.edges {
            let binding = &mut self.bindings[h.index()];
            let faces = if binding.decays() { topology.torn_faces(h) } else { 0 };
            if binding.torn_faces() != faces || mend.is_new_edge(topology, h) {
                binding.set_torn_faces(faces, decay);
            }
            self.predictions.tears.make_due(h.0);
        }
    }
}
