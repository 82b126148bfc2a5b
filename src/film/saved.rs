//! Codes a film's mesh for snapshots: how it differs from the mesh at rest.

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
        for original in &mut self.originals[originals..] {
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
            let twin = self.twins[h.index()];
            if twin > h && twin != HalfEdgeId::NONE {
                let known = h.face().half_edges().map(|side| self.torn[side.index()] && side < h);
                let beside = known.into_iter().filter(|&torn| torn).count();
                let mut torn = self.torn[h.index()];
                coder.flag(&mut odds[beside], &mut torn, false);
                self.torn[h.index()] = torn;
                self.torn[twin.index()] = torn;
            }
        }
    }

    /// Codes at which of the vertices of a place each half-edge begins: its rank among the original and its duplicates.
    fn code_origins<C: Coder>(&mut self, rest: &Self, coder: &mut C) -> Result<(), Damage> {
        let originals = self.original_vertex_count();
        // The duplicates of each original vertex in order, all in one list.
        let mut starts = vec![0u32; originals + 1];
        let duplicates = self.originals.get(originals..).unwrap_or_default();
        for original in duplicates {
            starts[original.index() + 1] += 1;
        }
        for i in 0..originals {
            starts[i + 1] += starts[i];
        }
        let (mut next, mut listed) = (starts.clone(), vec![0u32; duplicates.len()]);
        let mut ranks = vec![0u32; self.vertex_count()];
        for (i, original) in duplicates.iter().enumerate() {
            let place = &mut next[original.index()];
            listed[*place as usize] = (originals + i) as u32;
            *place += 1;
            ranks[originals + i] = *place - starts[original.index()];
        }
        let mut list = Differences::default();
        for h in self.all_half_edges() {
            let original = rest.origins[h.index()].index();
            let vertices = &listed[starts[original] as usize..starts[original + 1] as usize];
            if vertices.is_empty() {
                continue;
            }
            // Half-edges that a bound edge joins begin at the same vertex.
            let [after, before] = [self.bound_twin(h).map(HalfEdgeId::next), self.bound_twin(h.previous())];
            let known = [after, before].into_iter().flatten().find(|&other| other < h);
            let expected = known.map_or(0, |other| ranks[self.origins[other.index()].index()]);
            let mut rank = ranks[self.origins[h.index()].index()];
            coder.word(&mut list, &mut rank, expected);
            if C::READS {
                self.origins[h.index()] = match rank.checked_sub(1) {
                    None => VertexId::new(original),
                    Some(i) => VertexId(*vertices.get(i as usize).ok_or(Damage("a corner"))?),
                };
            }
        }
        Ok(())
    }

    fn code_fates<C: Coder>(&mut self, coder: &mut C) {
        let mut odds = [[Odds::default(); 2]; 3];
        let mut before = 0;
        self.removed_faces = 0;
        for fate in &mut self.fates {
            let number = usize::from(*fate != FaceFate::Live) + usize::from(*fate == FaceFate::Fallen);
            let [removed, fallen] = &mut odds[before];
            *fate = match coder.bit(removed, number > 0) {
                false => FaceFate::Live,
                true if coder.bit(fallen, number > 1) => FaceFate::Fallen,
                true => FaceFate::Stripped,
            };
            before = usize::from(*fate != FaceFate::Live) + usize::from(*fate == FaceFate::Fallen);
            self.removed_faces += u32::from(*fate != FaceFate::Live);
        }
    }

    /// Codes where fans begin. They follow from the cracks, so that nearly nothing is written.
    fn code_fans<C: Coder>(&mut self, rest: &Self, coder: &mut C) -> Result<(), Damage> {
        let mut expected = vec![HalfEdgeId::NONE; self.vertex_count()];
        for h in self.all_half_edges().filter(|h| self.is_live(h.face())) {
            let fan = &mut expected[self.origin(h).index()];
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
        let free = known[high as usize].iter_mut().find(|known| **known == u32::MAX || **known == low);
        free.into_iter().for_each(|free| *free = low);
    }
    let mut lists: [Differences; 3] = Default::default();
    let mut odds = [Odds::default(); 2 * NEIGHBOURS + 1];
    let mut lies = vec![true; positions.len()];
    for i in 0..positions.len() {
        let before = known[i].iter().map(|&n| n as usize).filter(|&n| n < i);
        let (mut moved, mut count) = (Vec3::ZERO, 0);
        for n in before.filter(|&n| !lies[n]) {
            moved += positions[n] - rest[n];
            count += 1;
        }
        let all = known[i].iter().filter(|&&n| n != u32::MAX).count();
        let at_rest = positions[i].to_array().map(f32::to_bits) == rest[i].to_array().map(f32::to_bits);
        lies[i] = coder.bit(&mut odds[count + if all > count { NEIGHBOURS } else { 0 }], at_rest);
        if lies[i] {
            positions[i] = rest[i];
        } else {
            let expected = rest[i] + moved / count.max(1) as f32;
            coder.vector(&mut lists, &mut positions[i], expected);
        }
    }
}

/// Returns what of a mesh tells it from others: the positions at rest and the triangles between them, little-endian.
pub(crate) fn write_rest(mesh: &FilmMesh, mut write: impl FnMut(&[u8])) {
    let topology = &mesh.topology;
    let originals = topology.original_vertex_count();
    write(&(originals as u32).to_le_bytes());
    for p in mesh.geometry.rest_positions.iter().take(originals) {
        p.to_array().iter().for_each(|x| write(&x.to_le_bytes()));
    }
    let corners = |f: FaceId| topology.corners(f).map(|v| topology.original(v).0);
    for f in topology.all_faces() {
        corners(f).iter().for_each(|v| write(&v.to_le_bytes()));
    }
}
