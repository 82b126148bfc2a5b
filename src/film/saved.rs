//! Codes a film's mesh for snapshots: how it differs from the mesh at rest.

#![cfg_attr(
    not(test),
    deny(
        clippy::indexing_slicing,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "what is read here comes from outside"
    )
)]

use bevy_math::Vec3;

use super::{
    handles::{FaceId, HalfEdgeId, VertexId},
    mesh::FilmMesh,
    topology::{FaceFate, Topology, TopologyError},
};
use crate::coding::{Coder, Damage, Differences, Odds};

/// Number of neighbours from which the way of a vertex is guessed.
const NEIGHBOURS: usize = 4;

impl FilmMesh {
    /// Returns the mesh as it was built, whatever has torn, moved or fallen since.
    ///
    /// # Errors
    /// [`TopologyError`] if the fields of this were changed by hand so that they are no film any more.
    pub(crate) fn at_rest(&self) -> Result<Self, TopologyError> {
        let topology = &self.topology;
        let positions = self.geometry.rest_positions.iter().take(topology.original_vertex_count()).copied().collect();
        let triangles: Vec<[u32; 3]> =
            topology.all_faces().map(|f| topology.corners(f).map(|v| topology.original(v).0)).collect();
        Self::new(positions, &triangles)
    }

    /// Codes how this mesh differs from `rest`, the same mesh at rest. To read, begin with a clone of `rest`.
    ///
    /// # Errors
    /// [`Damage`] if the mesh that is read is none.
    pub(crate) fn code_state<C: Coder>(&mut self, rest: &Self, coder: &mut C) -> Result<(), Damage> {
        let topology = &mut self.topology;
        topology.code_duplicates(coder)?;
        topology.code_torn(coder);
        topology.code_origins(&rest.topology, coder)?;
        topology.code_fates(coder);
        topology.code_fans(&rest.topology, coder)?;
        let geometry = &mut self.geometry;
        if C::READS {
            for v in topology.all_vertices().skip(rest.topology.vertex_count()) {
                geometry.duplicate_vertex(topology.original(v));
            }
        }
        code_positions(topology, &geometry.rest_positions, &mut geometry.positions, coder);
        if coder.distrusts() {
            self.validate().map_err(|_| Damage("its mesh"))?;
        }
        Ok(())
    }
}

impl Topology {
    fn code_duplicates<C: Coder>(&mut self, coder: &mut C) -> Result<(), Damage> {
        let originals = self.original_vertex_count();
        // Every vertex but those without faces at rest is the origin of a half-edge.
        let most = self.half_edge_count();
        let count = coder.length(self.vertex_count() - originals, most, "the number of its duplicates")?;
        if C::READS {
            self.originals.resize(originals + count, VertexId(0));
            self.border.resize(originals + count, true);
            self.fans.resize(originals + count, HalfEdgeId::NONE);
        }
        let (mut list, mut before) = (Differences::default(), 0);
        for original in self.originals.iter_mut().skip(originals) {
            coder.word(&mut list, &mut original.0, before);
            before = original.0;
            if original.index() >= originals {
                return Err(Damage("a duplicate"));
            }
        }
        Ok(())
    }

    fn code_torn<C: Coder>(&mut self, coder: &mut C) {
        // Cracks go on: by the number of torn edges of the face that came before.
        let mut odds = [Odds::default(); 4];
        for h in self.all_half_edges() {
            let Some(twin) = self.rest_twin(h).filter(|&twin| twin > h) else { continue };
            let known = h.face().half_edges().map(|side| self.is_torn(side) && side < h);
            let beside = known.into_iter().filter(|&torn| torn).count();
            #[expect(clippy::indexing_slicing, reason = "of three sides, none to three are torn")]
            let odds = &mut odds[beside];
            let mut torn = self.is_torn(h);
            coder.flag(odds, &mut torn, false);
            for side in [h, twin] {
                if let Some(known) = self.torn.get_mut(side.index()) {
                    *known = torn;
                }
            }
        }
    }

    /// Codes at which of the vertices of a place each half-edge begins: its rank among the original and its duplicates.
    fn code_origins<C: Coder>(&mut self, rest: &Self, coder: &mut C) -> Result<(), Damage> {
        let originals = self.original_vertex_count();
        let duplicates = self.originals.get(originals..).unwrap_or_default();
        // The rank of each vertex: 0 for originals, 1 and more for the duplicates of each in order.
        let (mut counts, mut ranks) = (vec![0u32; originals], vec![0u32; originals]);
        for original in duplicates {
            let count = counts.get_mut(original.index()).ok_or(Damage("a duplicate"))?;
            *count += 1;
            ranks.push(*count);
        }
        // The duplicates of each original vertex in order, all in one list.
        let mut listed = vec![VertexId::NONE; duplicates.len()];
        let mut left: &mut [VertexId] = &mut listed;
        let cut = |&count: &u32| left.split_off_mut(..count as usize).unwrap_or_default();
        let mut groups: Vec<&mut [VertexId]> = counts.iter().map(cut).collect();
        for ((i, original), &rank) in (originals..).zip(duplicates).zip(ranks.iter().skip(originals)) {
            let group = groups.get_mut(original.index());
            if let Some(place) = group.and_then(|group| group.get_mut((rank - 1) as usize)) {
                *place = VertexId::new(i);
            }
        }
        let rank_of = |v: VertexId| ranks.get(v.index()).copied().unwrap_or_default();
        let mut list = Differences::default();
        for (h, &at_rest) in self.all_half_edges().zip(&rest.origins) {
            let Some(vertices) = groups.get(at_rest.index()).filter(|group| !group.is_empty()) else { continue };
            // Half-edges that a bound edge joins begin at the same vertex.
            let [after, before] = [self.bound_twin(h).map(HalfEdgeId::next), self.bound_twin(h.previous())];
            let known = [after, before].into_iter().flatten().find(|&other| other < h);
            let expected = known.map_or(0, |other| rank_of(self.origin(other)));
            let mut rank = rank_of(self.origin(h));
            coder.word(&mut list, &mut rank, expected);
            if C::READS
                && let Some(origin) = self.origins.get_mut(h.index())
            {
                *origin = match rank.checked_sub(1) {
                    None => at_rest,
                    Some(i) => *vertices.get(i as usize).ok_or(Damage("a corner"))?,
                };
            }
        }
        Ok(())
    }

    fn code_fates<C: Coder>(&mut self, coder: &mut C) {
        let [mut live, mut stripped, mut fallen] = [[Odds::default(); 2]; 3];
        let mut before = FaceFate::Live;
        self.removed_faces = 0;
        for fate in &mut self.fates {
            let [is_removed, has_fallen] = match before {
                FaceFate::Live => &mut live,
                FaceFate::Stripped => &mut stripped,
                FaceFate::Fallen => &mut fallen,
            };
            *fate = match coder.bit(is_removed, *fate != FaceFate::Live) {
                false => FaceFate::Live,
                true if coder.bit(has_fallen, *fate == FaceFate::Fallen) => FaceFate::Fallen,
                true => FaceFate::Stripped,
            };
            before = *fate;
            self.removed_faces += u32::from(*fate != FaceFate::Live);
        }
    }

    /// Codes where fans begin. They follow from the cracks, so that nearly nothing is written.
    fn code_fans<C: Coder>(&mut self, rest: &Self, coder: &mut C) -> Result<(), Damage> {
        let mut expected = vec![HalfEdgeId::NONE; self.vertex_count()];
        for h in self.all_half_edges().filter(|h| self.is_live(h.face())) {
            let fan = expected.get_mut(self.origin(h).index()).ok_or(Damage("a corner"))?;
            // An open fan begins at its clockwise end, a closed one where it always did.
            if self.bound_twin(h).is_none()
                || rest.fans.get(self.origin(h).index()) == Some(&h) && *fan == HalfEdgeId::NONE
            {
                *fan = h;
            }
        }
        let mut list = Differences::default();
        for (fan, expected) in self.fans.iter_mut().zip(expected) {
            coder.word(&mut list, &mut fan.0, expected.0);
            if *fan != HalfEdgeId::NONE && fan.index() >= self.origins.len() {
                return Err(Damage("a fan"));
            }
        }
        Ok(())
    }
}

/// Codes the positions of all vertices. Most have moved about as far as their neighbours.
fn code_positions<C: Coder>(topology: &Topology, rest: &[Vec3], positions: &mut [Vec3], coder: &mut C) {
    // Some neighbours of each vertex that come before it, across faces that are gone, too.
    let mut known = vec![[u32::MAX; NEIGHBOURS]; positions.len()];
    for h in topology.all_half_edges() {
        let (a, b) = (topology.origin(h).0, topology.target(h).0);
        let (low, high) = (a.min(b), a.max(b));
        let mut places = known.get_mut(high as usize).into_iter().flatten();
        if let Some(free) = places.find(|known| **known == u32::MAX || **known == low) {
            *free = low;
        }
    }
    let mut lists: [Differences; 3] = Default::default();
    let mut odds = [Odds::default(); 2 * NEIGHBOURS + 1];
    // How far each vertex has moved that came before, unless it lies where it did at rest.
    let mut moves: Vec<Option<Vec3>> = Vec::with_capacity(positions.len());
    for ((position, &rest), known) in positions.iter_mut().zip(rest).zip(known) {
        let (mut moved, mut count) = (Vec3::ZERO, 0);
        for way in known.iter().filter_map(|&n| moves.get(n as usize).copied().flatten()) {
            moved += way;
            count += 1;
        }
        let all = known.iter().filter(|&&n| n != u32::MAX).count();
        #[expect(clippy::indexing_slicing, reason = "no more than all neighbours have moved")]
        let odds = &mut odds[count + if all > count { NEIGHBOURS } else { 0 }];
        let at_rest = position.to_array().map(f32::to_bits) == rest.to_array().map(f32::to_bits);
        if coder.bit(odds, at_rest) {
            *position = rest;
            moves.push(None);
        } else {
            coder.vector(&mut lists, position, rest + moved / count.max(1) as f32);
            moves.push(Some(*position - rest));
        }
    }
}

/// Returns what of a mesh tells it from others: the positions at rest and the triangles between them, little-endian.
pub(crate) fn write_rest(mesh: &FilmMesh, mut write: impl FnMut(&[u8])) {
    let topology = &mesh.topology;
    let originals = topology.original_vertex_count();
    write(&topology.original_vertices.to_le_bytes());
    for p in mesh.geometry.rest_positions.iter().take(originals) {
        p.to_array().iter().for_each(|x| write(&x.to_le_bytes()));
    }
    let corners = |f: FaceId| topology.corners(f).map(|v| topology.original(v).0);
    for f in topology.all_faces() {
        corners(f).iter().for_each(|v| write(&v.to_le_bytes()));
    }
}
