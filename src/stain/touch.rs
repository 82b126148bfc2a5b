//! Lets somebody from outside change the stains at one vertex.

use super::fields::StainFields;
use crate::film::{Topology, VertexId};

/// Stains at one vertex, of the film or of open metal.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Stain {
    /// Wet rust, in layers.
    pub wet: f32,
    /// Rust that has stained, in layers.
    pub stained: f32,
    /// Dust, from 0 to 1.
    pub dust: f32,
    /// Moisture, from 0 to 1.
    pub moisture: f32,
    /// Corrosion of the metal, from 0 to 1; 0 for film.
    pub corrosion: f32,
}

impl StainFields {
    /// Changes the stains of the film at `v`, and those of the metal under it where that lies open. Rust that comes
    /// or goes is counted in the [budget](super::RustBudget).
    pub(crate) fn change_at(&mut self, topology: &Topology, v: VertexId, change: impl Fn(&mut Stain)) {
        let (i, original) = (v.index(), topology.original(v));
        let is_film = topology.has_faces(v);
        let is_metal = v == original && self.openness[i] > 0.0;
        for (layer, is_there, of_metal) in [(&mut self.film, is_film, false), (&mut self.metal, is_metal, true)] {
            if !is_there {
                continue;
            }
            let corrosion = if of_metal { self.corrosion[i] } else { 0.0 };
            let (wet, stained) = (layer.wet[i], layer.stained[i]);
            let mut stain = Stain { wet, stained, dust: layer.dust[i], moisture: layer.moisture[i], corrosion };
            change(&mut stain);
            (layer.wet[i], layer.stained[i]) = (stain.wet, stain.stained);
            (layer.dust[i], layer.moisture[i]) = (stain.dust, stain.moisture);
            if of_metal {
                self.corrosion[i] = stain.corrosion;
            }
            let more = f64::from(layer.areas[i]) * (f64::from(stain.wet) - f64::from(wet));
            let more = more + f64::from(layer.areas[i]) * (f64::from(stain.stained) - f64::from(stained));
            if more > 0.0 {
                self.budget.emitted += more;
            } else {
                self.budget.dripped -= more;
            }
            self.damp |= stain.moisture > 0.0;
            if stain.wet > 0.0 {
                self.flow.wake(original);
            }
        }
    }

    /// Counts stains as changed, however little they differ.
    pub(crate) fn revise(&mut self) {
        self.revision = self.revision.wrapping_add(1);
    }
}
