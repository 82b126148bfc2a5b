//! Finds what is different about a film's connectivity and exposure since its appearance was last brought up to date.
//!
//! Comparing with what was seen then is quicker than keeping books of every step, and cannot miss an edit.

use crate::{
    film::{FaceFate, FaceId, FilmMesh, HalfEdgeId, Topology, VertexId},
    fracture::FilmForces,
};

/// Number of entries that are compared at once.
const CHUNK: usize = 64;

/// Film as it was seen, and how it differs from that now.
#[derive(Clone, Debug, Default)]
pub(in crate::appearance) struct Differences {
    /// Start vertex of each half-edge.
    origins: Vec<VertexId>,
    /// Whether the edge of each half-edge was torn.
    torn: Vec<bool>,
    /// Fate of each face.
    fates: Vec<FaceFate>,
    /// Whether each vertex was attached.
    attached: Vec<bool>,
    /// Whether nothing had been seen, or what was seen is void: then the lists are empty, and everything is different.
    pub whole: bool,
    /// Half-edges that start at another vertex.
    pub parted: Vec<HalfEdgeId>,
    /// Half-edges whose edge tore, both of each edge.
    pub tears: Vec<HalfEdgeId>,
    /// Vertices with other faces around them, or with a crack between them: each once.
    pub vertices: Vec<VertexId>,
    /// Vertices that separated, or are attached again.
    pub separated: Vec<VertexId>,
    /// Faces that are gone.
    pub gone: Vec<FaceId>,
    /// Faces that are gone, and faces at vertices that separated: each once.
    pub exposed: Vec<FaceId>,
    /// Whether each vertex is in `vertices`, and each face in `exposed`.
    marks: [Vec<bool>; 2],
}

impl Differences {
    /// Forgets the differences of the last look.
    pub fn clear(&mut self) {
        self.whole = false;
        self.parted.clear();
        self.tears.clear();
        self.vertices.clear();
        self.separated.clear();
        self.gone.clear();
        self.exposed.clear();
    }

    /// Compares the film with the last look. With `whole`, what was seen is void.
    pub fn look(&mut self, mesh: &FilmMesh, forces: &FilmForces, whole: bool) {
        self.clear();
        let topology = &mesh.topology;
        let came_back = !(whole || self.fates.len() != topology.face_count()) && self.find_gone(topology);
        if whole || came_back || self.fates.len() != topology.face_count() {
            self.clear();
            self.whole = true;
            self.origins = topology.origins().to_vec();
            self.torn = topology.torn().to_vec();
            self.fates = topology.fates().to_vec();
            self.attached = topology.all_vertices().map(|v| forces.is_attached(v)).collect();
            self.marks = [Vec::new(), Vec::new()];
            return;
        }
        self.find_tears(topology);
        self.find_exposed(topology, forces);
        let [vertices, faces] = &mut self.marks;
        self.vertices.iter().for_each(|v| vertices[v.index()] = false);
        self.exposed.iter().for_each(|f| faces[f.index()] = false);
    }

    /// Finds the faces that are gone, and returns whether any is there again.
    fn find_gone(&mut self, topology: &Topology) -> bool {
        let (mut came_back, gone) = (false, &mut self.gone);
        each_difference(&mut self.fates, topology.fates(), |f, was, is| {
            came_back |= is == FaceFate::Live;
            if was == FaceFate::Live {
                gone.push(FaceId::new(f));
            }
        });
        came_back
    }

    fn find_tears(&mut self, topology: &Topology) {
        let Self { origins, torn, parted, tears, vertices, marks: [marks, _], .. } = self;
        marks.resize(topology.vertex_count(), false);
        let mut mark = |v: VertexId| {
            if !std::mem::replace(&mut marks[v.index()], true) {
                vertices.push(v);
            }
        };
        each_difference(origins, topology.origins(), |h, was, is| {
            parted.push(HalfEdgeId::new(h));
            mark(was);
            mark(is);
        });
        each_difference(torn, topology.torn(), |h, _, _| {
            let h = HalfEdgeId::new(h);
            tears.push(h);
            mark(topology.origin(h));
        });
    }

    fn find_exposed(&mut self, topology: &Topology, forces: &FilmForces) {
        let Self { attached, separated, gone, exposed, marks: [_, marks], .. } = self;
        marks.resize(topology.face_count(), false);
        let mut mark = |f: FaceId| {
            if !std::mem::replace(&mut marks[f.index()], true) {
                exposed.push(f);
            }
        };
        gone.iter().for_each(|&f| mark(f));
        // A duplicate is as attached as its vertex was.
        attached.resize(topology.vertex_count(), true);
        for v in topology.all_vertices() {
            let is = forces.is_attached(v);
            if std::mem::replace(&mut attached[v.index()], is) != is {
                separated.push(v);
                topology.fan(v).for_each(|h| mark(h.face()));
            }
        }
    }
}

/// Calls `found` with the index and both values of each difference, and makes `was` equal to `is`.
fn each_difference<T: Copy + PartialEq>(was: &mut [T], is: &[T], mut found: impl FnMut(usize, T, T)) {
    for (c, (was, is)) in was.chunks_mut(CHUNK).zip(is.chunks(CHUNK)).enumerate() {
        if was == is {
            continue;
        }
        for (i, (was, &is)) in was.iter_mut().zip(is).enumerate() {
            if *was != is {
                found(c * CHUNK + i, *was, is);
                *was = is;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use bevy_math::Vec3;

    use super::*;
    use crate::{film::tests::grid, settings::CoatingSettings};

    #[test]
    fn tears_and_separations_are_found_once() {
        let (positions, triangles) = grid(4, 4);
        let mut mesh = FilmMesh::new(positions, &triangles).unwrap();
        let mut forces = FilmForces::new(&mesh, &CoatingSettings::default(), 1);
        let mut found = Differences::default();
        found.look(&mesh, &forces, false);
        assert!(found.whole, "nothing had been seen");
        found.look(&mesh, &forces, false);
        assert!(!found.whole && found.vertices.is_empty() && found.exposed.is_empty());

        // From the border inwards: the vertex on the border parts.
        let border = |v| mesh.topology.is_border(v);
        let edge = mesh.topology.all_edges().find(|&h| {
            mesh.topology.rest_twin(h).is_some() && border(mesh.topology.origin(h)) != border(mesh.topology.target(h))
        });
        let edge = edge.unwrap();
        mesh.tear(edge, Vec3::NEG_Y).unwrap();
        forces.separated_age.resize(mesh.topology.vertex_count(), f32::INFINITY);
        found.look(&mesh, &forces, false);
        assert_eq!(found.tears.len(), 2, "both sides");
        assert!(!found.parted.is_empty());
        assert_eq!(found.vertices.len(), 3, "both ends, and the duplicate");

        let middle = mesh.topology.all_vertices().find(|&v| !mesh.topology.is_border(v)).unwrap();
        forces.separated_age[middle.index()] = 0.1;
        found.look(&mesh, &forces, false);
        assert!(found.tears.is_empty() && found.vertices.is_empty());
        assert_eq!(found.exposed.len(), mesh.topology.fan(middle).count());
    }
}
