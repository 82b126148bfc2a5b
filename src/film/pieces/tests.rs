//! Pieces that are followed against those that are found.

use bevy_math::Vec3;
use proptest::prelude::*;

use super::*;
use crate::film::{FilmMesh, HalfEdgeId, TearEnd, Topology, VertexId, tests};

/// A film whose pieces are followed.
struct Followed {
    mesh: FilmMesh,
    attached: Vec<bool>,
    pieces: FilmPieces,
    loose: LoosePieces,
    scratch: PieceScratch,
}

impl Followed {
    fn new(mesh: FilmMesh) -> Self {
        let pieces = FilmPieces::new(&mesh.topology, |_| true);
        Self {
            attached: vec![true; mesh.topology.vertex_count()],
            mesh,
            pieces,
            loose: LoosePieces::default(),
            scratch: PieceScratch::default(),
        }
    }

    fn separate(&mut self, v: VertexId) {
        if self.mesh.topology.has_faces(v) && std::mem::take(&mut self.attached[v.index()]) {
            self.pieces.vertex_separated(&self.mesh.topology, v);
        }
    }

    /// Separates the ends of the edge of `h`, tears it, and strips what that cuts out.
    fn tear(&mut self, h: HalfEdgeId) {
        if self.mesh.topology.bound_twin(h).is_none() || !self.mesh.topology.is_live(h.face()) {
            return;
        }
        for v in [self.mesh.topology.origin(h), self.mesh.topology.target(h)] {
            self.separate(v);
        }
        let ends = self.mesh.tear(h, Vec3::NEG_Y).expect("it was bound");
        let splits = ends.iter().filter(|end| matches!(end, TearEnd::Split { .. })).count();
        self.attached.resize(self.attached.len() + splits, false);
        let is_attached = |v: VertexId| self.attached[v.index()];
        self.pieces.edge_torn(&self.mesh.topology, h, &ends, &mut self.scratch, is_attached);
    }

    fn strip(&mut self, h: HalfEdgeId) {
        let mut stripped = false;
        for f in [Some(h), self.mesh.topology.rest_twin(h)].into_iter().flatten().map(HalfEdgeId::face) {
            if self.mesh.topology.corners(f).iter().all(|v| !self.attached[v.index()]) {
                stripped |= self.mesh.topology.strip(f);
            }
        }
        if stripped {
            self.loose.retain_live(&self.mesh.topology, &mut self.scratch);
        }
    }

    /// Renews the list, then drops pieces of up to `limit` faces.
    fn renew(&mut self, limit: usize) {
        self.pieces.renew(&self.mesh.topology, &mut self.loose, &mut self.scratch);
        self.check();
        for piece in self.loose.iter().filter(|piece| piece.faces.len() <= limit) {
            self.mesh.topology.drop_piece(piece.faces);
        }
        self.loose.retain_live(&self.mesh.topology, &mut self.scratch);
        self.check();
    }

    fn check(&self) {
        let topology: &Topology = &self.mesh.topology;
        let is_attached = |v: VertexId| self.attached[v.index()];
        let mut found = LoosePieces::default();
        found.find(topology, &mut PieceScratch::default(), is_attached);
        assert_eq!(self.loose, found);
        assert_eq!(found.smallest(), found.iter().map(|piece| piece.faces.len() as u32).min());
        assert!(self.pieces.agrees(topology, &self.loose, is_attached));
    }
}

proptest! {
    #[test]
    fn followed_pieces_are_those_that_are_found(
        mesh in tests::any_mesh(),
        separated in 0u32..6,
        edits in prop::collection::vec((any::<u32>(), any::<u8>()), 1..200),
    ) {
        let mut film = Followed::new(mesh);
        let edges: Vec<_> = film.mesh.topology.all_edges().collect();
        for (pick, what) in edits {
            let h = edges[pick as usize % edges.len()];
            film.tear(h);
            // Also many vertices whose edges hold: pieces come loose by the last of them.
            for i in 0..separated {
                film.separate(VertexId((pick >> 8).wrapping_add(i * 7) % film.attached.len() as u32));
            }
            film.strip(h);
            // The list is not renewed after every tear.
            if what % 4 != 0 {
                film.renew(usize::from(what % 3) * usize::from(what / 32));
            }
        }
        film.renew(0);
        film.mesh.validate().unwrap();
    }
}

/// A tube, and its edges along the ring of vertices at each height.
fn tube(w: u32, h: u32) -> (Followed, Vec<Vec<HalfEdgeId>>) {
    let (positions, triangles) = tests::wrapped(w, h, false);
    let film = Followed::new(FilmMesh::new(positions, &triangles).unwrap());
    let topology = &film.mesh.topology;
    let rings = (0..=h)
        .map(|y| {
            let ring = y * w..(y + 1) * w;
            let on_ring = |v: VertexId| ring.contains(&v.0);
            topology.all_edges().filter(|&e| on_ring(topology.origin(e)) && on_ring(topology.target(e))).collect()
        })
        .collect();
    (film, rings)
}

fn pieces(film: &Followed) -> usize {
    LoosePieces::default().find(&film.mesh.topology, &mut PieceScratch::default(), |_| true)
}

#[test]
fn a_tube_is_cut_in_two_by_a_ring_and_not_by_a_slit() {
    let (mut film, rings) = tube(6, 6);
    assert_eq!(rings[3].len(), 6);
    for (i, &h) in rings[3].iter().enumerate() {
        assert_eq!(pieces(&film), 1, "after {i} tears");
        film.tear(h);
        film.renew(0);
    }
    assert_eq!(pieces(&film), 2);
    // A slit from border to border joins the borders.
    let (mut film, _) = tube(6, 6);
    let along: Vec<_> = (0..6)
        .map(|y| {
            let (a, b) = (y * 6, (y + 1) * 6);
            let topology = &film.mesh.topology;
            topology.all_edges().find(|&h| {
                let ends = [topology.origin(h).0, topology.target(h).0];
                ends == [a, b] || ends == [b, a]
            })
        })
        .collect();
    for h in along {
        film.tear(h.unwrap());
        film.renew(0);
    }
    assert_eq!(pieces(&film), 1);
}

#[test]
fn a_piece_of_either_side_can_be_the_loose_one() {
    // All vertices below the ring have separated, or all above, or all.
    for (below, above) in [(true, false), (false, true), (true, true)] {
        let (mut film, rings) = tube(5, 4);
        for y in 0..5 {
            for v in y * 5..(y + 1) * 5 {
                if (y < 2 && below) || (y > 2 && above) {
                    film.separate(VertexId(v));
                }
            }
        }
        for &h in &rings[2] {
            assert!(film.loose.is_empty() || (below && above));
            film.tear(h);
            film.renew(0);
        }
        assert_eq!(film.loose.len(), usize::from(below) + usize::from(above));
        assert!(film.loose.iter().all(|piece| piece.faces.len() == 20 && piece.vertices.len() == 15));
    }
}
