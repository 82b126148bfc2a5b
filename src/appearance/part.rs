//! Defines [`MeshPart`], the vertex arrays of one part of a film's appearance.

use super::{corners::CornerAttributes, shading::StainSample};
use crate::stain::shown::MOST_LAYERS;

/// Vertices and triangles of one part of a film's appearance (front, backs or metal), in the film's space.
///
/// Each array holds one entry a vertex, or none at all where the part does not have the attribute.
///
/// ```
/// use bevy_coating::appearance::MeshPart;
///
/// let corner = MeshPart {
///     positions: vec![[0.0, 0.0, 0.1]],
///     stains: vec![[0.5, 0.0, 0.2, 0.0]],
///     rest: vec![[0.0; 3]],
///     rest_normals: vec![[0.0, 0.0, 1.0]],
///     ..MeshPart::default()
/// };
/// assert_eq!(corner.sample(0).map(|sample| sample.rust), Some(0.5));
/// assert_eq!(corner.sample(1), None, "there is one vertex only");
/// assert!(corner.is_empty(), "a vertex without triangles draws nothing");
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshPart {
    /// Positions, in metres.
    pub positions: Vec<[f32; 3]>,
    /// Normals, of unit length.
    pub normals: Vec<[f32; 3]>,
    /// First texture coordinates; empty if the prop has none.
    pub uvs: Vec<[f32; 2]>,
    /// Second texture coordinates; empty if the prop has none.
    pub uvs_1: Vec<[f32; 2]>,
    /// Tangents of unit length, with the handedness in the fourth component; empty if the prop has none, and for backs
    /// and metal.
    pub tangents: Vec<[f32; 4]>,
    /// Linear vertex colours of the prop with alpha; empty if it has none. Of backs and metal, which have colours of
    /// their own, only the alpha counts: it cuts holes where the prop's material is a mask.
    pub colors: Vec<[f32; 4]>,
    /// Stains of each vertex: layers of rust that has run off (0 to 1; more is cut off), dust (0 to 1), moisture (0 to
    /// 1), and corrosion of the metal at this place (0 bright to 1 rusted through).
    pub stains: Vec<[f32; 4]>,
    /// Position of each vertex at rest, in metres. Patterns of stains are computed from it, so that they stay fixed to
    /// the paint when flakes move.
    pub rest: Vec<[f32; 3]>,
    /// Normal of each vertex at rest, of unit length.
    pub rest_normals: Vec<[f32; 3]>,
    /// Vertex indices, three a triangle. Fronts and metal are wound as the prop's own triangles, backs the other way.
    ///
    /// A triangle keeps its place here while the film ages. One that is gone leaves a triangle without area behind, of
    /// three times the same vertex; see [`triangles`](Self::triangles).
    pub indices: Vec<u32>,
}

/// Returns the entry of [`MeshPart::stains`] for a vertex with `layers` of rust.
pub(super) fn vertex_stains(layers: f32, dust: f32, moisture: f32, corrosion: f32) -> [f32; 4] {
    [layers.min(MOST_LAYERS), dust, moisture, corrosion]
}

impl MeshPart {
    /// Returns whether the part has no triangles, so that there is nothing to draw.
    pub fn is_empty(&self) -> bool {
        self.indices.is_empty()
    }

    /// Returns the stains of vertex `i` with its place and normal at rest, as [shading](super::shading) needs them.
    /// `None` if the part has no such vertex or no stains.
    pub fn sample(&self, i: usize) -> Option<StainSample> {
        let (&stains, &rest, &normal) = (self.stains.get(i)?, self.rest.get(i)?, self.rest_normals.get(i)?);
        Some(StainSample::new(stains, rest.into(), normal.into()))
    }

    /// Returns the vertices of each triangle, but for those that are gone.
    ///
    /// ```
    /// use bevy_coating::appearance::MeshPart;
    ///
    /// let part = MeshPart { indices: vec![0, 1, 2, 5, 5, 5], ..MeshPart::default() };
    /// assert_eq!(part.triangles().collect::<Vec<_>>(), [[0, 1, 2]]);
    /// ```
    pub fn triangles(&self) -> impl Iterator<Item = [u32; 3]> + '_ {
        let triangles = self.indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]]);
        triangles.filter(|[a, b, c]| a != b && b != c && c != a)
    }

    /// Removes all vertices and triangles and keeps the buffers.
    pub(super) fn clear(&mut self) {
        self.positions.clear();
        self.normals.clear();
        self.uvs.clear();
        self.uvs_1.clear();
        self.tangents.clear();
        self.colors.clear();
        self.stains.clear();
        self.rest.clear();
        self.rest_normals.clear();
        self.indices.clear();
    }

    /// Grows the arrays that every part has to `count` vertices. The others grow as they are [set](set).
    pub(super) fn grow_to(&mut self, count: usize) {
        if count > self.positions.len() {
            grow(&mut self.positions, count);
            grow(&mut self.normals, count);
            grow(&mut self.stains, count);
            grow(&mut self.rest, count);
            grow(&mut self.rest_normals, count);
        }
    }

    /// Makes room for `vertices` more vertices of a part with the attributes of `like`, and for `indices` more indices.
    pub(super) fn reserve(&mut self, vertices: usize, indices: usize, like: &CornerAttributes) {
        fn room<T, U>(values: &mut Vec<T>, count: usize, like: &[U]) {
            if !like.is_empty() {
                values.reserve_exact(count);
            }
        }
        self.positions.reserve_exact(vertices);
        self.normals.reserve_exact(vertices);
        self.stains.reserve_exact(vertices);
        self.rest.reserve_exact(vertices);
        self.rest_normals.reserve_exact(vertices);
        room(&mut self.uvs, vertices, &like.uvs);
        room(&mut self.uvs_1, vertices, &like.uvs_1);
        room(&mut self.colors, vertices, &like.colors);
        self.indices.reserve_exact(indices);
    }

    /// Gives back the memory that the part does not need.
    pub(super) fn shrink(&mut self) {
        self.positions.shrink_to_fit();
        self.normals.shrink_to_fit();
        self.uvs.shrink_to_fit();
        self.uvs_1.shrink_to_fit();
        self.tangents.shrink_to_fit();
        self.colors.shrink_to_fit();
        self.stains.shrink_to_fit();
        self.rest.shrink_to_fit();
        self.rest_normals.shrink_to_fit();
        self.indices.shrink_to_fit();
    }

    /// Appends so many indices, and returns the first.
    pub(super) fn add_indices(&mut self, count: usize) -> usize {
        let first = self.indices.len();
        grow(&mut self.indices, first + count);
        first
    }

    /// Copies the texture coordinates and the colour of vertex `from` of `other` to vertex `to`.
    pub(super) fn copy_coordinates(&mut self, to: usize, other: &Self, from: usize) {
        set(&mut self.uvs, to, other.uvs.get(from).copied());
        set(&mut self.uvs_1, to, other.uvs_1.get(from).copied());
        set(&mut self.colors, to, other.colors.get(from).copied());
    }

    /// Copies stains and the place at rest of vertex `from` of `other` to vertex `to`.
    pub(super) fn copy_stains(&mut self, to: usize, other: &Self, from: usize) {
        self.stains[to] = other.stains[from];
        self.rest[to] = other.rest[from];
        self.rest_normals[to] = other.rest_normals[from];
    }

    /// Writes a triangle at `index`; with `flipped`, wound the other way.
    #[inline]
    pub(super) fn put_triangle(&mut self, index: usize, [a, b, c]: [u32; 3], flipped: bool) {
        self.indices[index..index + 3].copy_from_slice(&if flipped { [a, c, b] } else { [a, b, c] });
    }
}

/// Sets entry `i` of an attribute, which grows if it is too short; nothing where there is no value.
pub(super) fn set<T: Copy + Default>(values: &mut Vec<T>, i: usize, value: Option<T>) {
    let Some(value) = value else { return };
    if i >= values.len() {
        grow(values, i + 1);
    }
    values[i] = value;
}

/// Grows an array to `count` entries, with room for an eighth more. Doubling would leave half of the memory of large
/// parts unused.
fn grow<T: Copy + Default>(values: &mut Vec<T>, count: usize) {
    if count > values.capacity() {
        values.reserve_exact(count - values.len() + count / 8);
    }
    values.resize(count, T::default());
}
