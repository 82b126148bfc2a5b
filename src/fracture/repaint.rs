//! Forces of new paint on a film whose connectivity stays what it is.

use bevy_math::Vec3;

use super::{adhesion::adhesion_at, forces::FilmForces};
use crate::{
    coding::Damage,
    film::{FilmMesh, Repaint, VertexId},
};

impl FilmForces {
    /// Returns the corners of new faces that are to be attached again, if these forces follow with the connectivity as
    /// it is, or `None` if they do not: where the film hangs loose, or where a free edge at the open border ends to be
    /// one.
    pub(crate) fn find_attachable(&mut self, mesh: &FilmMesh, repaint: &Repaint) -> Option<Vec<VertexId>> {
        self.find_pieces(&mesh.topology);
        if repaint.faces.iter().any(|&f| self.predictions.pieces.attached_of(f) == 0) {
            return None;
        }
        let loose: Vec<VertexId> = repaint.corners.iter().copied().filter(|&v| !self.is_attached(v)).collect();
        (!loose.iter().any(|&v| mesh.topology.is_border(v))).then_some(loose)
    }

    /// Gives the new faces and their corners the forces of fresh paint: those that were drawn there at first. `attach`
    /// are the corners that had separated.
    ///
    /// # Errors
    /// [`Damage`], with nothing changed, if the settings that the forces were drawn with were changed by hand so that
    /// there are none such.
    pub(crate) fn repaint(&mut self, mesh: &FilmMesh, repaint: &Repaint, attach: &[VertexId]) -> Result<(), Damage> {
        let (topology, geometry) = (&mesh.topology, &mesh.geometry);
        let settings = self.settings_drawn_with(geometry)?;
        for &v in attach {
            self.separated_age[v.index()] = f32::INFINITY;
            self.separations = self.separations.saturating_sub(1);
            self.predictions.pieces.vertex_attached(topology, v);
        }
        let lost = self.adhesion_lost as f32;
        self.rebound.resize(topology.vertex_count(), false);
        let rest = geometry.rest_positions.get(..topology.original_vertex_count()).unwrap_or_default();
        let places = repaint.corners.iter().map(|v| rest[v.index()]);
        let drawn = adhesion_at(rest, places, &settings.adhesion, self.drawn.grain, self.drawn.seed);
        for (&v, drawn) in repaint.corners.iter().zip(drawn) {
            let i = v.index();
            self.adhesion_drawn[i] = drawn;
            self.adhesion_by_hand[i] = false;
            // It has lost nothing yet of what all have.
            self.adhesion_lost_wet[i] = -lost;
            if let Some(share) = self.adhesion_share.get_mut(i) {
                *share = 1.0;
            }
            self.rebound[i] = true;
            self.tips[i] = Vec3::ZERO;
            self.predictions.separations.make_due(v.0);
        }
        self.renew_faces(repaint.faces.iter().copied());
        let decay = self.binding_decay;
        self.draw_fresh_bindings(mesh, &settings.tearing, repaint.new_edges(mesh), |forces, h, mut binding| {
            binding.set_torn_faces(if binding.decays() { topology.torn_faces(h) } else { 0 }, decay);
            forces.bindings[h.index()] = binding;
        });
        for h in repaint.faces.iter().flat_map(|f| f.half_edges()) {
            self.predictions.tears.make_due(topology.edge(h).0);
        }
        self.necks.retain(|neck| ![neck.at, neck.held_by[0], neck.held_by[1]].into_iter().any(|v| repaint.has(v)));
        Ok(())
    }
}
