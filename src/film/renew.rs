//! Makes parts of a film whole again: faces that are gone come back, and cracks between them close.
//!
//! Edits only ever add vertices. So this does not undo them one by one; it begins with the film at rest and does again
//! what remains: every tear that is not mended, every face that stays away. Faces and half-edges keep their ids.
//! Vertices beyond the original ones do not, and [`Renewal`] says what became of each.

use bevy_math::Vec3;

use super::{
    changes::FilmChanges,
    direction::unit_or_zero,
    edit::TearEnd,
    geometry::Geometry,
    handles::{HalfEdgeId, VertexId},
    mesh::{FilmMesh, fan_depth},
    topology::{FaceFate, Topology},
};

/// What a new vertex of a renewed film is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Origin {
    /// This vertex of the film as it was.
    Kept(VertexId),
    /// A corner of a face that is new. It lies at rest.
    New,
}

/// A film of which some faces were made new.
#[derive(Clone, Debug)]
pub(crate) struct Renewal {
    /// Film at rest.
    pub rest: FilmMesh,
    /// Film as it is now.
    pub mesh: FilmMesh,
    /// Fracture that remains, as if all of it had happened in one step. `separated` is empty: who separated is
    /// no question of the mesh.
    pub fracture: FilmChanges,
    /// Origin of each vertex of the new film.
    pub origins: Vec<Origin>,
    /// Whether each face was made new.
    pub faces: Vec<bool>,
}

impl Renewal {
    /// Returns whether the edge of `h` joins two new faces, so that it is new itself.
    pub fn is_new_edge(&self, h: HalfEdgeId) -> bool {
        let is_new = |h: HalfEdgeId| self.faces[h.face().index()];
        is_new(h) && self.mesh.topology.rest_twin(h).is_none_or(is_new)
    }
}

impl FilmMesh {
    /// Makes the `faces` new: one entry for each face of the film. Those that are gone come back, edges between two of
    /// them are whole, and all of their corners lie at rest. All other faces and edges stay what they are, but that a
    /// face which is gone is bound to none that is there.
    ///
    /// Where faces of a vertex fall into several fans, a fan of new faces keeps the vertex; among others the one that
    /// lies furthest along `gravity`.
    pub(crate) fn renew(&self, faces: Vec<bool>, gravity: Vec3) -> Renewal {
        debug_assert_eq!(faces.len(), self.topology.face_count());
        let gravity = unit_or_zero(gravity);
        let rest = self.rest();
        let (old, mut mesh, mut fracture) = (&self.topology, rest.clone(), FilmChanges::default());
        let is_new = |h: HalfEdgeId| faces[h.face().index()];
        let is_there = |h: HalfEdgeId| old.is_live(h.face()) || is_new(h);
        for h in old.all_edges() {
            let Some(twin) = old.rest_twin(h).filter(|&twin| !(is_new(h) && is_new(twin))) else { continue };
            if !old.is_torn(h) && is_there(h) == is_there(twin) {
                continue;
            }
            let FilmMesh { topology, geometry } = &mut mesh;
            let ends = topology.tear(h, |topology, a, b| {
                let rank = |first: HalfEdgeId| {
                    let (depth, lowest) = fan_depth(topology, geometry, first, gravity);
                    (topology.fan_at(first).any(is_new), depth, lowest)
                };
                let ((new_a, depth_a, face_a), (new_b, depth_b, face_b)) = (rank(a), rank(b));
                if new_a != new_b {
                    new_a
                } else if depth_a == depth_b {
                    face_a < face_b
                } else {
                    depth_a > depth_b
                }
            });
            let Some(ends) = ends else { continue };
            for end in ends {
                if let TearEnd::Split { kept, duplicate } = end {
                    geometry.duplicate_vertex(kept);
                    fracture.duplicates.push(duplicate);
                }
            }
            fracture.torn.push(h);
            fracture.torn_ends.push(ends);
        }
        for f in old.all_faces().filter(|&f| !old.is_live(f) && !faces[f.index()]) {
            mesh.topology.take_away(f, old.fate(f));
            fracture.removed.push(f);
        }
        let origins = origins(old, &mesh.topology, &faces);
        for (v, origin) in origins.iter().enumerate() {
            if let Origin::Kept(before) = origin {
                mesh.geometry.positions[v] = self.geometry.positions[before.index()];
            }
        }
        Renewal { rest, mesh, fracture, origins, faces }
    }

    /// Returns the film at rest, as it was built.
    fn rest(&self) -> Self {
        let (topology, geometry) = (self.topology.rest(), &self.geometry);
        let count = topology.vertex_count();
        let first = |list: &[Vec3]| list.iter().take(count).copied().collect::<Vec<_>>();
        let geometry = Geometry {
            rest_positions: first(&geometry.rest_positions),
            rest_normals: first(&geometry.rest_normals),
            positions: first(&geometry.rest_positions),
            rest_lengths: geometry.rest_lengths.clone(),
            rest_dihedrals: geometry.rest_dihedrals.clone(),
            ..*geometry
        };
        Self { topology, geometry }
    }
}

impl Topology {
    /// Returns the connectivity at rest.
    fn rest(&self) -> Self {
        let count = self.original_vertex_count();
        let mut rest = Self {
            origins: self.origins.iter().map(|&v| self.original(v)).collect(),
            twins: self.twins.clone(),
            torn: vec![false; self.torn.len()],
            fates: vec![FaceFate::Live; self.fates.len()],
            fans: vec![HalfEdgeId::NONE; count],
            originals: (0..count).map(VertexId::new).collect(),
            border: vec![false; count],
            original_vertices: self.original_vertices,
            removed_faces: 0,
        };
        rest.begin_fans();
        rest
    }
}

/// Returns what each vertex of the film `new` is, in which `faces` are new and that has grown out of `old`.
fn origins(old: &Topology, new: &Topology, faces: &[bool]) -> Vec<Origin> {
    // Vertices without faces at rest are what they were.
    let mut origins: Vec<Origin> = new.all_vertices().map(Origin::Kept).collect();
    // What stays says most about a vertex, then what stays away; a new face at it overrules both.
    let mut known = vec![0u8; new.vertex_count()];
    for h in new.all_half_edges() {
        let (v, is_new) = (new.origin(h).index(), faces[h.face().index()]);
        let says = if is_new { 3 } else { 1 + u8::from(old.is_live(h.face())) };
        if says > known[v] {
            known[v] = says;
            origins[v] = if is_new { Origin::New } else { Origin::Kept(old.origin(h)) };
        }
    }
    origins
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use proptest::prelude::*;

    use super::*;
    use crate::film::{FaceId, tests::grid};

    #[test]
    fn the_film_at_rest_is_the_one_that_was_built() {
        let (positions, triangles) = grid(5, 4);
        let built = FilmMesh::new(positions, &triangles).unwrap();
        let mut film = built.clone();
        for h in [7, 12, 13, 20] {
            film.tear(HalfEdgeId(h), Vec3::NEG_Y);
        }
        film.geometry.positions[3] += Vec3::Z;
        assert_eq!(film.rest(), built);
    }

    proptest! {
        #[test]
        fn any_film_can_be_renewed_anywhere(
            tears in prop::collection::vec(0u32..90, 0..60),
            gone in prop::collection::vec(0u32..30, 0..8),
            renewed in prop::collection::vec(any::<bool>(), 30),
        ) {
            let (positions, triangles) = grid(5, 3);
            let built = FilmMesh::new(positions, &triangles).unwrap();
            let mut film = built.clone();
            for h in tears {
                film.tear(HalfEdgeId(h), Vec3::NEG_Y);
            }
            for f in gone.into_iter().map(FaceId) {
                f.half_edges().into_iter().for_each(|h| { film.tear(h, Vec3::NEG_Y); });
                if film.topology.is_live(f) {
                    film.topology.take_away(f, FaceFate::Fallen);
                }
            }
            film.validate().unwrap();
            let renewal = film.renew(renewed.clone(), Vec3::NEG_Y);
            renewal.mesh.validate().unwrap();
            let (old, new) = (&film.topology, &renewal.mesh.topology);
            for f in new.all_faces() {
                prop_assert_eq!(new.is_live(f), old.is_live(f) || renewed[f.index()]);
            }
            for h in new.all_edges() {
                let Some(twin) = new.rest_twin(h) else { continue };
                let both = renewed[h.face().index()] && renewed[twin.face().index()];
                let whole = new.is_live(h.face()) && new.is_live(twin.face());
                if whole && old.is_live(h.face()) && old.is_live(twin.face()) {
                    prop_assert_eq!(new.is_torn(h), old.is_torn(h) && !both);
                }
            }
            for (v, origin) in renewal.origins.iter().enumerate() {
                let place = renewal.mesh.geometry.rest_positions[v];
                if let Origin::Kept(before) = origin {
                    prop_assert_eq!(film.geometry.rest_positions[before.index()], place);
                }
            }
            let whole = film.renew(vec![true; 30], Vec3::NEG_Y);
            prop_assert_eq!(whole.mesh, built.clone());

            // In place it comes to the same, but for the numbers of vertices.
            let mut mended = film.clone();
            let mend = mended.mend(renewed.clone());
            mended.validate().unwrap();
            let topology = &mended.topology;
            let place = |film: &FilmMesh, h: HalfEdgeId| film.geometry.positions[film.topology.origin(h).index()];
            prop_assert_eq!(&topology.fates, &new.fates);
            prop_assert_eq!(topology.removed_face_count(), new.removed_face_count());
            prop_assert_eq!(&topology.torn, &new.torn);
            let mut names = BTreeSet::new();
            for h in topology.all_half_edges().filter(|h| topology.is_live(h.face())) {
                let v = topology.origin(h);
                names.insert((v, new.origin(h)));
                prop_assert_eq!(place(&mended, h), place(&renewal.mesh, h));
                let is_new = renewal.origins[new.origin(h).index()] == Origin::New;
                prop_assert_eq!(mend.fresh.contains(&v), is_new);
                prop_assert_eq!(mend.here.contains(&v), mend.places.contains(&topology.original(v)));
            }
            let mended_names: BTreeSet<VertexId> = names.iter().map(|pair| pair.0).collect();
            let new_names: BTreeSet<VertexId> = names.iter().map(|pair| pair.1).collect();
            prop_assert_eq!([mended_names.len(), new_names.len()], [names.len(); 2], "each has one name in the other");
            prop_assert!(mend.places.iter().all(|place| mend.fresh.contains(place)), "new paint has the originals");
            mended.mend(vec![true; 30]);
            mended.validate().unwrap();
            let first = built.topology.vertex_count();
            prop_assert_eq!(&mended.topology.origins, &built.topology.origins);
            prop_assert_eq!(&mended.topology.fans[..first], &built.topology.fans[..]);
            prop_assert!(mended.topology.fans[first..].iter().all(|&fan| fan == HalfEdgeId::NONE));
            prop_assert_eq!(&mended.geometry.positions[..first], &built.geometry.positions[..]);
        }
    }
}
