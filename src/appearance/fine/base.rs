//! The prop's surface at the points of the faces' grids, at rest.

use std::sync::Arc;

use bevy_math::{Vec2, Vec3, Vec4, VectorSpace};

use super::layout::{Layout, Role};
use crate::{
    appearance::{
        corners::{CornerAttributes, sample_at, sample_in_pieces},
        face_slots::FaceSlots,
        part::{MeshPart, set},
        turn::unit,
        wedges::{RestWedges, are_same},
    },
    film::{FaceId, FilmMesh, HalfEdgeId, Topology},
    remesh::{BuiltFilm, FineSites, fine_sites_in_pieces},
    rest::{LIGHT_PIECE, Rest, pieces},
    surface::{BuildError, Surface, SurfaceSite},
};

/// Mark of an edge whose points are those of its twin, which runs the other way.
const REVERSED: u32 = 1 << 31;

/// Positions and attributes of the points of all faces at rest.
///
/// Points that faces share are there once: a point on an edge belongs to both its faces, and a corner to all faces
/// around it, unless a seam runs there.
#[derive(Clone, Debug, Default)]
pub(in crate::appearance) struct Base {
    pub layout: Layout,
    wedges: Arc<RestWedges>,
    /// Whether both faces at the edge of each half-edge share its points.
    joined: Arc<[bool]>,
    /// First point of each half-edge, or [`REVERSED`] with that of its twin.
    edges: Vec<u32>,
    /// Which half-edges of each face are not the lower ones of their edges: one bit each.
    reversed: Vec<u8>,
    /// First point inside each face.
    insides: Vec<u32>,
    positions: Vec<Vec3>,
    /// Attributes of each point; as in [`CornerAttributes`], those that the prop does not have are empty.
    attributes: CornerAttributes,
}

/// Position and attributes at one place of a face, but for tangents: chips shift them too little to be seen.
#[derive(Clone, Copy, Debug)]
pub(super) struct Place {
    pub position: Vec3,
    pub normal: Vec3,
    pub uv: Option<Vec2>,
    pub uv_1: Option<Vec2>,
    pub color: Option<Vec4>,
}

impl Base {
    /// Samples `surface` at the points of the grids of `level`.
    ///
    /// # Errors
    /// The errors of [`fine_sites`](crate::remesh::fine_sites).
    pub async fn sample(
        built: &BuiltFilm,
        surface: &Surface,
        mesh: &FilmMesh,
        corners: &CornerAttributes,
        wedges: Arc<RestWedges>,
        face_slots: &FaceSlots,
        level: u32,
        rest: &mut impl Rest,
    ) -> Result<Self, BuildError> {
        let layout = Layout::new(level);
        let mut sites = fine_sites_in_pieces(surface, built, &layout.grid, rest).await?;
        // As many as there are faces, whatever came in.
        let count = layout.roles.len() * mesh.topology.face_count();
        sites.positions.resize(count, Vec3::ZERO);
        sites.sites.resize(count, SurfaceSite { triangle: 0, weights: Vec3::X });
        rest.rest().await;
        let joined = joined(&layout, &sites, surface, &mesh.topology, &wedges, face_slots, rest).await;
        let mut base = Self::numbered(layout, mesh, wedges, joined);
        rest.rest().await;
        let points = base.layout.roles.len();
        let of: Vec<usize> = base.firsts(mesh, |f, i| f.index() * points + i, rest).await;
        base.positions = of.iter().map(|&i| sites.positions[i]).collect();
        let own: Vec<SurfaceSite> = of.iter().map(|&i| sites.sites[i]).collect();
        rest.rest().await;
        let attributes = &mut base.attributes;
        attributes.normals = sample_in_pieces(&surface.normals, &own, rest).await;
        attributes.normals.resize(of.len(), Vec3::ZERO);
        for (normals, of) in attributes.normals.chunks_mut(LIGHT_PIECE).zip(of.chunks(LIGHT_PIECE)) {
            for (normal, &i) in normals.iter_mut().zip(of) {
                *normal = unit(*normal);
                // Where the prop has no normals they are those at the film's corners, interpolated.
                if *normal == Vec3::ZERO {
                    let b = base.layout.grid.points()[i % points];
                    let of_corner = |k: usize| corners.normals.get(3 * (i / points) + k).copied().unwrap_or(Vec3::Z);
                    let mean = of_corner(0) * b.x + of_corner(1) * b.y + of_corner(2) * b.z;
                    *normal = mean.normalize_or(of_corner(0));
                }
            }
            rest.rest().await;
        }
        attributes.tangents = sample_in_pieces(&surface.tangents, &own, rest).await;
        for tangents in attributes.tangents.chunks_mut(LIGHT_PIECE) {
            for t in tangents {
                *t = t.truncate().normalize_or(Vec3::X).extend(if t.w < 0.0 { -1.0 } else { 1.0 });
            }
            rest.rest().await;
        }
        attributes.uvs = sample_in_pieces(&surface.uvs, &own, rest).await;
        attributes.uvs_1 = sample_in_pieces(&surface.uvs_1, &own, rest).await;
        attributes.colors = sample_in_pieces(&surface.colors, &own, rest).await;
        Ok(base)
    }

    /// Returns the same at the points of the grids of `level`, which is not above that of this.
    pub async fn coarser(&self, mesh: &FilmMesh, level: u32, rest: &mut impl Rest) -> Self {
        let coarse = Self::numbered(Layout::new(level), mesh, self.wedges.clone(), self.joined.clone());
        let own = self.layout.grid.points_of(&coarse.layout.grid);
        rest.rest().await;
        let of: Vec<usize> = coarse.firsts(mesh, |f, i| self.point(f, own[i] as usize), rest).await;
        fn pick<T: Copy>(values: &[T], of: &[usize]) -> Vec<T> {
            if values.is_empty() { Vec::new() } else { of.iter().map(|&i| values[i]).collect() }
        }
        let CornerAttributes { normals, uvs, uvs_1, tangents, colors } = &self.attributes;
        let attributes = CornerAttributes {
            normals: pick(normals, &of),
            uvs: pick(uvs, &of),
            uvs_1: pick(uvs_1, &of),
            tangents: pick(tangents, &of),
            colors: pick(colors, &of),
        };
        Self { positions: pick(&self.positions, &of), attributes, ..coarse }
    }

    /// Numbers the points: first those at corners by their wedges, then face by face those on edges and inside.
    fn numbered(layout: Layout, mesh: &FilmMesh, wedges: Arc<RestWedges>, joined: Arc<[bool]>) -> Self {
        let topology = &mesh.topology;
        let mut next = wedges.count() as u32;
        let mut take = |count: usize| {
            let first = next;
            next += count as u32;
            first
        };
        let mut edges = vec![0; topology.half_edge_count()];
        let mut insides = Vec::with_capacity(topology.face_count());
        let reversed = |f: FaceId| {
            f.half_edges().iter().enumerate().fold(0, |bits, (k, &h)| bits | u8::from(topology.edge(h) != h) << k)
        };
        let reversed = topology.all_faces().map(reversed).collect();
        for f in topology.all_faces() {
            for h in f.half_edges() {
                edges[h.index()] = match topology.rest_twin(h) {
                    Some(t) if joined[h.index()] && t < h => edges[t.index()] | REVERSED,
                    _ => take(layout.edge_points()),
                };
            }
            insides.push(take(layout.inner_points()));
        }
        let positions = vec![Vec3::ZERO; next as usize];
        Self { positions, layout, wedges, joined, edges, reversed, insides, ..Self::default() }
    }

    /// Returns for each point the value of `of` at the first face and place of its grid that has the point.
    async fn firsts(
        &self,
        mesh: &FilmMesh,
        of: impl Fn(FaceId, usize) -> usize + Send,
        rest: &mut impl Rest,
    ) -> Vec<usize> {
        let mut firsts = vec![usize::MAX; self.positions.len()];
        for piece in pieces(mesh.topology.face_count(), faces_of(&self.layout, LIGHT_PIECE)) {
            for f in piece.map(FaceId::new) {
                for i in 0..self.layout.roles.len() {
                    let first = &mut firsts[self.point(f, i)];
                    if *first == usize::MAX {
                        *first = of(f, i);
                    }
                }
            }
            rest.rest().await;
        }
        firsts
    }

    /// Returns the wedges at the corners.
    pub fn wedges(&self) -> &Arc<RestWedges> {
        &self.wedges
    }

    /// Returns whether the two faces at the edge of `h` share its points at rest.
    #[inline]
    pub fn is_joined(&self, h: HalfEdgeId) -> bool {
        self.joined[h.index()]
    }

    /// Returns whether `h` is not the half-edge that stands for the whole edge.
    #[inline]
    pub fn is_reversed(&self, h: HalfEdgeId) -> bool {
        self.reversed[h.face().index()] >> (h.index() % 3) & 1 != 0
    }

    /// Returns the half-edge whose points stand for the edge of `h` at rest.
    #[inline]
    pub fn lead(&self, topology: &Topology, h: HalfEdgeId) -> HalfEdgeId {
        if self.is_joined(h) { topology.edge(h) } else { h }
    }

    /// Returns the point at the corner at the start of `h`.
    #[inline]
    pub fn corner(&self, h: HalfEdgeId) -> usize {
        self.wedges.at(h) as usize
    }

    /// Returns the inner point `i` of `h`, counted along it.
    #[inline]
    pub fn on_edge(&self, h: HalfEdgeId, i: usize) -> usize {
        let first = self.edges[h.index()];
        if first & REVERSED == 0 {
            first as usize + i
        } else {
            (first & !REVERSED) as usize + self.layout.edge_points() - 1 - i
        }
    }

    /// Returns the point `i` inside `f`.
    #[inline]
    pub fn inside(&self, f: FaceId, i: usize) -> usize {
        self.insides[f.index()] as usize + i
    }

    /// Returns the point `i` of the grid of `f`.
    fn point(&self, f: FaceId, i: usize) -> usize {
        match self.layout.roles[i] {
            Role::Corner(k) => self.corner(f.half_edges()[k]),
            Role::Edge(k, i) => self.on_edge(f.half_edges()[k], i),
            Role::Inside(i) => self.inside(f, i),
        }
    }

    /// Returns the tangent at a point with its handedness, if the prop has tangents.
    #[inline]
    pub fn tangent(&self, point: usize) -> Option<Vec4> {
        self.attributes.tangents.get(point).copied()
    }

    /// Returns what lies at a point.
    pub(super) fn of(&self, point: usize) -> Place {
        let CornerAttributes { normals, uvs, uvs_1, colors, .. } = &self.attributes;
        Place {
            position: self.positions[point],
            normal: normals[point],
            uv: uvs.get(point).copied(),
            uv_1: uvs_1.get(point).copied(),
            color: colors.get(point).copied(),
        }
    }

    /// Returns what lies at the barycentric coordinates `b` of the face `f`: linear between the points of its grid, and
    /// beyond its edges a continuation.
    pub(super) fn at(&self, f: FaceId, b: Vec3) -> Place {
        let (points, weights) = self.layout.grid.locate(b);
        let indices = points.map(|i| self.point(f, i as usize));
        let CornerAttributes { normals, uvs, uvs_1, colors, .. } = &self.attributes;
        Place {
            position: mix(&self.positions, indices, weights).unwrap_or_default(),
            normal: mix(normals, indices, weights).map_or(Vec3::Z, |n| n.normalize_or(normals[indices[0]])),
            uv: mix(uvs, indices, weights),
            uv_1: mix(uvs_1, indices, weights),
            color: mix(colors, indices, weights).map(|color| color.clamp(Vec4::ZERO, Vec4::INFINITY)),
        }
    }

    /// Makes room in a part for so many more vertices and indices.
    pub fn reserve(&self, part: &mut MeshPart, vertices: usize, indices: usize) {
        part.reserve(vertices, indices, &self.attributes);
    }

    /// Writes the triangles of a face with these vertices at the points of its grid, from the index `index` on; with
    /// `flipped`, the other way round.
    pub(super) fn put_triangles(&self, part: &mut MeshPart, vertices: &[u32], index: usize, flipped: bool) {
        for (i, triangle) in self.layout.grid.triangles().iter().enumerate() {
            part.put_triangle(index + 3 * i, triangle.map(|point| vertices[point as usize]), flipped);
        }
    }
}

impl Place {
    /// Writes the place into the vertex `i` of a part, as its place at rest.
    pub fn put(&self, part: &mut MeshPart, i: usize) {
        part.rest[i] = self.position.to_array();
        part.rest_normals[i] = self.normal.to_array();
        set(&mut part.uvs, i, self.uv.map(|uv| uv.to_array()));
        set(&mut part.uvs_1, i, self.uv_1.map(|uv| uv.to_array()));
        set(&mut part.colors, i, self.color.map(|color| color.to_array()));
    }
}

/// Returns how many faces have about so many points together.
fn faces_of(layout: &Layout, points: usize) -> usize {
    (points / layout.roles.len().max(1)).max(1)
}

/// Returns for each half-edge whether both faces at its edge have the same attributes along it.
async fn joined(
    layout: &Layout,
    sites: &FineSites,
    surface: &Surface,
    topology: &Topology,
    wedges: &RestWedges,
    face_slots: &FaceSlots,
    rest: &mut impl Rest,
) -> Arc<[bool]> {
    let mut joined = vec![false; topology.half_edge_count()];
    let on_edge = |h: HalfEdgeId, i: usize| {
        let row = layout.grid.edge(h.index() % 3);
        h.face().index() * layout.roles.len() + row[1 + i] as usize
    };
    let same = |a: usize, b: usize| {
        sites.positions[a] == sites.positions[b] && has_same(surface, &sites.sites[a], &sites.sites[b])
    };
    for piece in pieces(topology.half_edge_count(), faces_of(layout, LIGHT_PIECE)) {
        for h in piece.map(HalfEdgeId::new).filter(|&h| topology.edge(h) == h) {
            let Some(t) = topology.rest_twin(h) else { continue };
            let ends = wedges.at(h) == wedges.at(t.next()) && wedges.at(h.next()) == wedges.at(t);
            let last = layout.edge_points();
            let is_joined = ends
                && face_slots.are_alike(h.face(), t.face())
                && (0..last).all(|i| same(on_edge(h, i), on_edge(t, last - 1 - i)));
            joined[h.index()] = is_joined;
            joined[t.index()] = is_joined;
        }
        rest.rest().await;
    }
    joined.into()
}

/// Returns whether the prop has the same attributes at two sites.
fn has_same(surface: &Surface, a: &SurfaceSite, b: &SurfaceSite) -> bool {
    /// Returns whether one attribute is the same.
    fn same<const N: usize, T>(values: &[T], a: &SurfaceSite, b: &SurfaceSite) -> bool
    where
        T: Into<[f32; N]> + VectorSpace<Scalar = f32> + Copy,
    {
        values.is_empty() || are_same(sample_at(values, a), sample_at(values, b))
    }
    let Surface { normals, uvs, uvs_1, tangents, colors, .. } = surface;
    a == b || same(normals, a, b) && same(uvs, a, b) && same(uvs_1, a, b) && same(tangents, a, b) && same(colors, a, b)
}

/// Returns the weighted sum of three values; `None` where there are none.
fn mix<T>(values: &[T], indices: [usize; 3], weights: Vec3) -> Option<T>
where
    T: Copy + std::ops::Mul<f32, Output = T> + std::ops::Add<Output = T>,
{
    let [a, b, c] = indices.map(|i| values.get(i).copied());
    Some(a? * weights.x + b? * weights.y + c? * weights.z)
}
