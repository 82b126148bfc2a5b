//! Cuts pieces out of the film as parts of their own, for debris.

use bevy_math::Vec3;

use super::{FilmAppearance, MeshPart};
use crate::film::{FaceId, FilmMesh, HalfEdgeId};

/// Sides of a piece of paint that has come off.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PieceParts {
    /// Primitive of the prop that the piece was on.
    pub slot: usize,
    /// Front, with the prop's own attributes.
    pub front: MeshPart,
    /// Back, wound the other way.
    pub back: MeshPart,
}

impl FilmAppearance {
    /// Returns both sides of a piece of `faces`, which may have come off already, where they are or were last: each
    /// triangle with three vertices of its own, in the film's space. Faces that the film does not have are left out.
    ///
    /// ```
    /// use bevy_coating::{
    ///     appearance::FilmAppearance, film::FaceId, remesh::sample, settings::CoatingSettings, sim::FilmState,
    /// };
    ///
    /// let piece = sample::plate(200, 1)?;
    /// let film = FilmState::new(&piece.film, &CoatingSettings::default(), 0, 100).ok_or("an empty film")?;
    /// let shown = FilmAppearance::new(&piece.film, &piece.surface, &film.mesh, &film.forces, &film.stains);
    /// let flake = shown.piece(&film.mesh, &[FaceId(3), FaceId(4), FaceId(9_999)]);
    /// assert_eq!((flake.front.positions.len(), flake.back.indices.len()), (6, 6));
    /// assert_eq!(flake.front.uvs.len(), 6, "the plate has texture coordinates");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn piece(&self, mesh: &FilmMesh, faces: &[FaceId]) -> PieceParts {
        let topology = &mesh.topology;
        let mut parts = PieceParts::default();
        let there = faces.iter().copied().filter(|f| f.index() < topology.face_count());
        for (i, f) in there.enumerate() {
            if i == 0 {
                parts.slot = self.levels.face_slots.slot(f);
            }
            let [a, b, c] = topology.corners(f).map(|v| mesh.geometry.positions[v.index()]);
            let normal = (b - a).cross(c - a).normalize_or_zero();
            let mut corners = f.half_edges();
            if self.levels.face_slots.is_flipped(f) {
                corners.swap(1, 2);
            }
            self.add(&mut parts.front, mesh, corners, normal);
            corners.swap(1, 2);
            self.add(&mut parts.back, mesh, corners, -normal);
        }
        parts
    }

    fn add(&self, part: &mut MeshPart, mesh: &FilmMesh, corners: [HalfEdgeId; 3], normal: Vec3) {
        let attributes = self.levels.attributes();
        for h in corners {
            let v = mesh.topology.origin(h).index();
            part.indices.push(part.positions.len() as u32);
            part.positions.push(mesh.geometry.positions[v].to_array());
            part.normals.push(normal.to_array());
            part.rest.push(mesh.geometry.rest_positions[v].to_array());
            part.uvs.extend(attributes.uvs.get(h.index()).map(|uv| uv.to_array()));
            part.uvs_1.extend(attributes.uvs_1.get(h.index()).map(|uv| uv.to_array()));
            part.colors.extend(attributes.colors.get(h.index()).map(|color| color.to_array()));
        }
    }
}
