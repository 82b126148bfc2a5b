//! Edits of the film: tear with fan split (VC 5.2), strip (VC 5.3).
//!
//! No edit moves a vertex or renumbers an element. Tearing sets a flag and may append duplicates of vertices; removing
//! a face marks it as removed.

use super::{
    handles::{FaceId, HalfEdgeId, VertexId},
    topology::{FaceFate, Fan, Topology},
};

/// Effect of a tear on the vertex at one end of the torn edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TearEnd {
    /// The faces went all the way round the vertex and now form one open fan: the vertex is the tip of a crack.
    Opened(VertexId),
    /// The faces formed an open fan (at a junction of cracks, or on the border) and now form two fans.
    Split {
        /// Vertex that was there before. It keeps its id and the fan that lies further along gravity.
        kept: VertexId,
        /// New vertex of the other fan. Its id is the highest of all vertices.
        duplicate: VertexId,
    },
}

impl Topology {
    /// Tears the edge of `h` (VC 5.2). [`FilmMesh::tear`](super::FilmMesh::tear) also keeps the positions in step.
    ///
    /// Returns what became of the origin and the target of `h`, in this order. Returns `None`, and changes nothing, if
    /// the edge does not join two live faces: on the border, where it is torn already, or where a face was removed.
    ///
    /// Where the fan of an end falls into two, `keep_first` decides which of the two keeps the vertex. It is called
    /// with the first half-edge of each fan, which can be walked with [`Topology::fan_at`], and returns whether the
    /// first fan keeps the vertex. The other fan gets a duplicate.
    ///
    /// Forces, constraints and stains must follow: outside this crate,
    /// [`FilmState::tear_edge`](crate::sim::FilmState::tear_edge) does all of it.
    pub(crate) fn tear(
        &mut self,
        h: HalfEdgeId,
        mut keep_first: impl FnMut(&Self, HalfEdgeId, HalfEdgeId) -> bool,
    ) -> Option<[TearEnd; 2]> {
        let twin = self.bound_twin(h)?;
        if !self.is_live(h.face()) || !self.is_live(twin.face()) {
            return None;
        }
        // Looked up before the flag is set, since the flag itself opens the fans.
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

    /// Iterates over the half-edges of the fan that starts at `first`, counter-clockwise. Meant for `keep_first` of
    /// [`Topology::tear`], where a vertex has two fans for a moment.
    pub(crate) fn fan_at(&self, first: HalfEdgeId) -> Fan<'_> {
        self.fan_from(first)
    }

    /// Appends a duplicate of `v` for the fan that starts at `first`, and returns it.
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

    /// Returns whether the live face `f` is joined to no other face and has at least one torn edge, so that it may be
    /// stripped (VC 5.3). Its other edges are torn or lie on the film's border.
    ///
    /// Both ends of a torn edge have separated. At the border, the caller must also check that all three corners have.
    pub fn is_cut_out(&self, f: FaceId) -> bool {
        let mut torn = false;
        let mut bound = false;
        for h in f.half_edges() {
            torn |= self.is_torn(h);
            bound |= self.bound_twin(h).is_some();
        }
        self.is_live(f) && torn && !bound
    }

    /// Removes the face `f` as [stripped](FaceFate::Stripped) if it [is cut out](Self::is_cut_out), and returns whether
    /// it was. The three vertices are left without faces; they keep their ids.
    pub(crate) fn strip(&mut self, f: FaceId) -> bool {
        let cut_out = self.is_cut_out(f);
        if cut_out {
            self.take_away(f, FaceFate::Stripped);
        }
        cut_out
    }

    /// Removes the faces of a piece as [fallen](FaceFate::Fallen). `piece` must hold all live faces that are joined to
    /// one another across bound edges. Faces that were removed before are skipped.
    pub(crate) fn drop_piece(&mut self, piece: &[FaceId]) {
        debug_assert!(
            piece.iter().all(|f| {
                f.half_edges().iter().all(|&h| self.bound_twin(h).is_none_or(|t| piece.contains(&t.face())))
            })
        );
        for &f in piece {
            if self.is_live(f) {
                self.take_away(f, FaceFate::Fallen);
            }
        }
    }

    /// Takes the live face `f` away for good, which must be bound to no face that stays.
    pub(super) fn take_away(&mut self, f: FaceId, fate: FaceFate) {
        self.fates[f.index()] = fate;
        self.removed_faces += 1;
        for v in self.corners(f) {
            self.fans[v.index()] = HalfEdgeId::NONE;
        }
    }
}
