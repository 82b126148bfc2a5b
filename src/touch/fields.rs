//! Changes the forces and stains that a touch reaches.

use super::{
    effect::{Change, Touch},
    reach::{Reach, originals_of},
};
use crate::{
    film::{FaceId, HalfEdgeId, Topology, VertexId},
    sim::edit::FilmParts,
    stain::Stain,
};

impl Change {
    /// Returns what becomes of `value` where the change has this strength, from 0 to 1.
    fn of(self, value: f32, strength: f32) -> f32 {
        match self {
            // To and from infinity there is no way between.
            Self::Set(to) if to == f32::INFINITY || value == f32::INFINITY => [value, to][usize::from(strength >= 0.5)],
            // Exactly.
            Self::Set(to) if strength >= 1.0 => to,
            Self::Set(to) => value + (to - value) * strength,
            Self::Add(more) => value + more * strength,
            Self::Multiply(_) => value * self.factor(strength),
        }
    }

    /// Returns the factor of a [`Change::Multiply`] of this strength; 1 for other changes.
    fn factor(self, strength: f32) -> f32 {
        match self {
            Self::Multiply(factor) => 1.0 + (factor - 1.0) * strength,
            _ => 1.0,
        }
    }
}

/// Changes the adhesion of the film that lies within reach.
pub(super) fn change_adhesion(parts: &mut FilmParts, touch: &Touch, reach: &Reach, by: Change) {
    let forces = &mut *parts.forces;
    for &v in &reach.vertices {
        let strength = touch.strength(reach.distances[v.index()]);
        match by {
            _ if strength == 0.0 || !forces.is_attached(v) => {}
            Change::Set(_) => forces.set_adhesion(v, by.of(forces.adhesion(v), strength)),
            Change::Add(more) => forces.add_adhesion(v, more * strength),
            Change::Multiply(_) => forces.scale_adhesion(v, by.factor(strength)),
        }
    }
}

/// Changes the binding of edges within reach.
pub(super) fn change_binding(parts: &mut FilmParts, touch: &Touch, reach: &Reach, by: Change) {
    let (topology, forces) = (&parts.mesh.topology, &mut *parts.forces);
    let distance = |h: HalfEdgeId| {
        let ends = [topology.origin(h), topology.target(h)].map(|v| reach.distances[topology.original(v).index()]);
        0.5 * (ends[0] + ends[1])
    };
    for h in reach.faces.iter().flat_map(|f| f.half_edges()) {
        // Once for each edge. An edge whose other face is out of reach has an end that is, too.
        if topology.edge(h) != h || topology.bound_twin(h).is_none() {
            continue;
        }
        let strength = touch.strength(distance(h));
        if strength == 0.0 {
            continue;
        }
        match by {
            Change::Multiply(_) => forces.scale_binding(topology, h, by.factor(strength)),
            _ => forces.set_binding(topology, h, by.of(forces.binding(topology, h), strength).max(0.0)),
        }
    }
}

/// Changes the contraction of faces within reach.
pub(super) fn change_contraction(parts: &mut FilmParts, touch: &Touch, reach: &Reach, by: Change) {
    let (topology, forces) = (&parts.mesh.topology, &mut *parts.forces);
    for &f in reach.faces.iter().filter(|&&f| topology.is_live(f)) {
        let strength = touch.strength(reach.distance_of(topology, f));
        if strength == 0.0 {
            continue;
        }
        match by {
            Change::Multiply(_) => forces.scale_contraction(topology, f, by.factor(strength)),
            _ => forces.set_contraction(topology, f, by.of(forces.contraction(f), strength).max(0.0)),
        }
    }
}

/// Changes stains within reach, of the film and of the metal where it lies open. `change` gets what there is at a
/// vertex and the strength of the touch.
pub(super) fn change_stains(parts: &mut FilmParts, touch: &Touch, reach: &Reach, change: impl Fn(&mut Stain, f32)) {
    let topology = &parts.mesh.topology;
    let strengths = |v: VertexId| touch.strength(reach.distances[v.index()]);
    // Duplicates lie at the corners of faces.
    let mut vertices: Vec<VertexId> = reach.faces.iter().flat_map(|&f| topology.corners(f)).collect();
    vertices.extend(&reach.vertices);
    vertices.sort_unstable();
    vertices.dedup();
    for v in vertices {
        let strength = strengths(topology.original(v));
        if strength > 0.0 {
            parts.stains.change_at(topology, v, |stain| change(stain, strength));
        }
    }
    parts.stains.revise();
}

/// Returns the faces of `reach` on which the touch has at least half of its strength, and that of the touch itself.
pub(super) fn faces_under(topology: &Topology, touch: &Touch, reach: &Reach) -> Vec<FaceId> {
    let felt = |f: FaceId| f == touch.site.face || touch.strength(reach.distance_of(topology, f)) >= 0.5;
    reach.faces.iter().copied().filter(|&f| felt(f)).collect()
}

/// Returns whether each face of the film has a corner on which the touch has at least half of its strength.
pub(super) fn faces_to_renew(topology: &Topology, touch: &Touch, reach: &Reach) -> Vec<bool> {
    let mut renewed = vec![false; topology.face_count()];
    for &f in &reach.faces {
        let felt = |v: VertexId| touch.strength(reach.distances[v.index()]) >= 0.5;
        renewed[f.index()] = f == touch.site.face || originals_of(topology, f).into_iter().any(felt);
    }
    renewed
}

impl Stain {
    /// Washes with this thoroughness.
    pub(super) fn wash(&mut self, share: f32) {
        self.dust *= 1.0 - share;
        self.wet *= 1.0 - share;
        self.stained *= 1.0 - 0.5 * share;
        self.moisture = self.moisture.max(share);
    }

    /// Sands with this thoroughness.
    pub(super) fn sand(&mut self, share: f32) {
        self.dust *= 1.0 - share;
        self.wet *= 1.0 - share;
        self.stained *= 1.0 - share;
        self.corrosion *= 1.0 - share;
    }

    /// Changes the dust.
    pub(super) fn change_dust(&mut self, by: Change, strength: f32) {
        self.dust = by.of(self.dust, strength).clamp(0.0, 1.0);
    }

    /// Changes the moisture.
    pub(super) fn change_moisture(&mut self, by: Change, strength: f32) {
        self.moisture = by.of(self.moisture, strength).clamp(0.0, 1.0);
    }
}
