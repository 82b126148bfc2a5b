//! Edits of the film: tear with fan split (VC 5.2), strip (VC 5.3).
//!
//! No edit moves or renumbers anything: tearing switches a flag and may append duplicates of vertices,
//! removing faces switches them off.

use super::{
    handles::{FaceId, HalfEdgeId, VertexId},
    topology::{FaceFate, Fan, Topology},
};

/// What a tear did to one end of the torn edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TearEnd {
    /// The closed fan at an interior vertex opened: the vertex is now the tip of a crack.
    Opened(VertexId),
    /// An open fan fell into two: a junction, or a vertex on the border.
    Split {
        /// Keeps its id and the fan that the caller chose.
        kept: VertexId,
        /// The new vertex of the other fan: the highest id there is.
        duplicate: VertexId,
    },
}

impl Topology {
    /// Tears the edge of `h`. Gives what became of `h`'s origin and of its target, in this order, or `None`
    /// (nothing changed) if the edge has no two bound faces.
    ///
    /// Where the fan of an end falls into two, `keep_first` is asked which one keeps the vertex: it gets the
    /// first half-edge of each (walk them with [`Topology::fan_at`]) and answers whether it is the first.
    pub fn tear(
        &mut self,
        h: HalfEdgeId,
        mut keep_first: impl FnMut(&Self, HalfEdgeId, HalfEdgeId) -> bool,
    ) -> Option<[TearEnd; 2]> {
        let twin = self.bound_twin(h)?;
        if !self.is_live(h.face()) || !self.is_live(twin.face()) {
            return None;
        }
        // Taken before the flag is set: a closed fan has a bound half-edge in front.
        let closed = [self.is_closed_fan(self.origin(h)), self.is_closed_fan(self.origin(twin))];
        self.torn[h.index()] = true;
        self.torn[twin.index()] = true;
        Some([(h, closed[0]), (twin, closed[1])].map(|(outgoing, closed)| {
            let v = self.origin(outgoing);
            if closed {
                self.fans[v.index()] = outgoing;
                return TearEnd::Opened(v);
            }
            let first = self.fans[v.index()];
            let moved = if keep_first(self, first, outgoing) { outgoing } else { first };
            self.fans[v.index()] = if moved == outgoing { first } else { outgoing };
            TearEnd::Split { kept: v, duplicate: self.duplicate(v, moved) }
        }))
    }

    /// The half-edges of the fan that starts at `first`, counter-clockwise: for `keep_first` of
    /// [`Topology::tear`].
    pub fn fan_at(&self, first: HalfEdgeId) -> Fan<'_> {
        self.fan_from(first)
    }

    /// Gives the fan that starts at `first` a vertex of its own.
    fn duplicate(&mut self, v: VertexId, first: HalfEdgeId) -> VertexId {
        let duplicate = VertexId::new(self.fans.len());
        self.fans.push(first);
        self.originals.push(self.originals[v.index()]);
        self.border.push(true);
        let mut next = Some(first);
        while let Some(h) = next {
            self.origins[h.index()] = duplicate;
            // The moved fan is open, so this ends.
            next = self.bound_twin(h.previous());
        }
        duplicate
    }

    /// Whether `f` is to be stripped: all its edges torn or, at the film's open border, all its inner edges
    /// and at least one. (That the vertices have separated follows for torn edges; border edges are the
    /// caller's to check.)
    pub fn is_cut_out(&self, f: FaceId) -> bool {
        let mut torn = false;
        let mut bound = false;
        for h in f.half_edges() {
            torn |= self.is_torn(h);
            bound |= self.bound_twin(h).is_some();
        }
        self.is_live(f) && torn && !bound
    }

    /// Removes live face `f`, which must be cut out, as stripped. Its vertices are left without faces.
    pub fn strip(&mut self, f: FaceId) -> bool {
        let cut_out = self.is_cut_out(f);
        if cut_out {
            self.remove(f, FaceFate::Stripped);
        }
        cut_out
    }

    /// Removes the faces of a whole piece (all live faces joined across bound edges) as fallen. Faces that
    /// are gone already are passed over.
    pub fn drop_piece(&mut self, piece: &[FaceId]) {
        debug_assert!(
            piece.iter().all(|f| {
                f.half_edges().iter().all(|&h| self.bound_twin(h).is_none_or(|t| piece.contains(&t.face())))
            })
        );
        for &f in piece {
            if self.is_live(f) {
                self.remove(f, FaceFate::Fallen);
            }
        }
    }

    fn remove(&mut self, f: FaceId, fate: FaceFate) {
        self.fates[f.index()] = fate;
        self.removed_faces += 1;
        for v in self.corners(f) {
            self.fans[v.index()] = HalfEdgeId::NONE;
        }
    }
}
