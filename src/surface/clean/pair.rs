//! Pairs the half-edges along each edge. Half-edge `3 * f + k` runs from corner `k` of face `f` to the next corner.

use bevy_math::{DVec3, Vec3};

use super::face::{Face, NONE};
use crate::rest::{LIGHT_PIECE, NoRest, Rest, at_once, end_of_runs, sort_by_number};

/// Returns the twin of each half-edge: the half-edge that runs the other way along the same edge. Half-edge `3 * f + k`
/// runs from corner `k` of triangle `f` to its next corner.
///
/// The twin is `u32::MAX` on borders, and at edges of more than two triangles or of two with the same direction.
///
/// ```
/// use bevy_coating::surface::twins;
///
/// let none = u32::MAX;
/// assert_eq!(twins(&[[0, 1, 2], [0, 2, 3]]), [none, none, 3, 2, none, none]);
/// ```
pub fn twins(triangles: &[[u32; 3]]) -> Vec<u32> {
    at_once(twins_in_pieces(triangles, &mut NoRest))
}

/// Does what [`twins`] does, with rests between its pieces.
pub(crate) async fn twins_in_pieces(triangles: &[[u32; 3]], rest: &mut impl Rest) -> Vec<u32> {
    let half_edges = sorted_half_edges(triangles, |&triangle| triangle, rest).await;
    let mut twin = vec![NONE; 3 * triangles.len()];
    let mut from = 0;
    while let Some(piece) = next_edges(&half_edges, &mut from) {
        for run in piece.chunk_by(is_same_edge) {
            if let &[(_, g), (_, h)] = run
                && start(triangles, g) != start(triangles, h)
            {
                (twin[g as usize], twin[h as usize]) = (h, g);
            }
        }
        rest.rest().await;
    }
    twin
}

fn start(triangles: &[[u32; 3]], h: u32) -> u32 {
    triangles[h as usize / 3][h as usize % 3]
}

/// Returns all half-edges with their two vertices, the lower vertex first, sorted by the vertices and then by index.
pub(super) async fn sorted_half_edges<T: Sync>(
    faces: &[T],
    vertices: impl Fn(&T) -> [u32; 3] + Send + Sync,
    rest: &mut impl Rest,
) -> Vec<SortedHalfEdge> {
    let mut half_edges: Vec<SortedHalfEdge> = Vec::with_capacity(3 * faces.len());
    for piece in faces.chunks(LIGHT_PIECE) {
        for face in piece {
            let ([a, b, c], h) = (vertices(face), half_edges.len() as u32);
            half_edges.extend([(a, b, h), (b, c, h + 1), (c, a, h + 2)].map(|(a, b, h)| ((a.min(b), a.max(b)), h)));
        }
        rest.rest().await;
    }
    sort_by_number(half_edges, |&((low, _), _)| low, rest).await
}

/// Vertices of a half-edge, the lower one first, and its index.
pub(super) type SortedHalfEdge = ((u32, u32), u32);

/// Returns the next piece of the sorted half-edges, with all half-edges of each edge, and moves `from` to its end.
pub(super) fn next_edges<'e>(half_edges: &'e [SortedHalfEdge], from: &mut usize) -> Option<&'e [SortedHalfEdge]> {
    let end = end_of_runs(half_edges, *from, is_same_edge);
    let piece = half_edges.get(*from..end).filter(|piece| !piece.is_empty());
    *from = end;
    piece
}

/// Returns whether two half-edges lie on the same edge.
pub(super) fn is_same_edge(a: &SortedHalfEdge, b: &SortedHalfEdge) -> bool {
    a.0 == b.0
}

/// List of all half-edges in which those of one edge are next to each other.
pub(super) struct Edges {
    half_edges: Vec<SortedHalfEdge>,
}

impl Edges {
    pub async fn new(faces: &[Face], rest: &mut impl Rest) -> Self {
        Self { half_edges: sorted_half_edges(faces, |face| face.vertices, rest).await }
    }

    fn runs(&self) -> impl Iterator<Item = &[SortedHalfEdge]> {
        self.half_edges.chunk_by(is_same_edge)
    }

    /// Iterates over the edges with more than two faces, each as its two vertices.
    pub fn non_manifold_edges(&self) -> impl Iterator<Item = (u32, u32)> {
        self.runs().filter(|run| run.len() > 2).map(|run| run[0].0)
    }

    pub fn non_manifold(&self) -> usize {
        self.non_manifold_edges().count()
    }

    /// Returns the twins across the edges with exactly two faces, whatever their winding.
    pub async fn pair_manifold(&self, faces: &[Face], rest: &mut impl Rest) -> Vec<u32> {
        let mut twin = vec![NONE; 3 * faces.len()];
        let mut from = 0;
        while let Some(piece) = next_edges(&self.half_edges, &mut from) {
            for run in piece.chunk_by(is_same_edge) {
                if let &[(_, g), (_, h)] = run
                    && !back_to_back(&faces[g as usize / 3], &faces[h as usize / 3])
                {
                    (twin[g as usize], twin[h as usize]) = (h, g);
                }
            }
            rest.rest().await;
        }
        twin
    }

    /// Adds twins across the edges with more than two faces, the smoothest continuation first. Pairs that agree in
    /// winding come before pairs that do not, and pairs that do not agree are joined only where they do not fold back.
    pub async fn pair_others(&self, faces: &[Face], positions: &[Vec3], twin: &mut [u32], rest: &mut impl Rest) {
        let mut from = 0;
        while let Some(piece) = next_edges(&self.half_edges, &mut from) {
            Self::pair_others_in(piece, faces, positions, twin);
            rest.rest().await;
        }
    }

    fn pair_others_in(half_edges: &[SortedHalfEdge], faces: &[Face], positions: &[Vec3], twin: &mut [u32]) {
        for run in half_edges.chunk_by(is_same_edge).filter(|run| run.len() > 2) {
            let pages: Vec<_> =
                run.iter().map(|&((a, b), h)| Page::new(&faces[h as usize / 3], h, a, b, positions)).collect();
            let mut pairs = Vec::new();
            for (i, p) in pages.iter().enumerate() {
                for q in &pages[i + 1..] {
                    if back_to_back(&faces[p.half_edge as usize / 3], &faces[q.half_edge as usize / 3]) {
                        continue;
                    }
                    let agree = p.forward != q.forward;
                    let flatness = -p.direction.dot(q.direction);
                    if agree || flatness >= 0.0 {
                        pairs.push((agree, flatness, p.convex(q), p.half_edge, q.half_edge));
                    }
                }
            }
            // Stable: ties stay in the order of the faces.
            pairs.sort_by(|a, b| b.0.cmp(&a.0).then(compare_flatness(b.1, a.1)).then(b.2.cmp(&a.2)));
            for (_, _, _, g, h) in pairs {
                if twin[g as usize] == NONE && twin[h as usize] == NONE {
                    (twin[g as usize], twin[h as usize]) = (h, g);
                }
            }
        }
    }
}

/// Returns whether two faces have the same three vertices: the two sides of a sheet that was modelled twice.
fn back_to_back(a: &Face, b: &Face) -> bool {
    a.vertices.iter().all(|v| b.vertices.contains(v))
}

/// Compares in steps of a ten-thousandth, so that rounding does not decide between symmetric pairs.
fn compare_flatness(a: f64, b: f64) -> std::cmp::Ordering {
    let step = |x: f64| (x * 1e4).round();
    step(a).total_cmp(&step(b))
}

/// A face at an edge with several faces. The faces stand around the edge like the pages of a book around its spine.
struct Page {
    half_edge: u32,
    /// Whether the face runs along the spine from its lower to its higher vertex.
    forward: bool,
    /// Unit vector into the face, perpendicular to the spine.
    direction: DVec3,
    /// Outward unit normal, or zero.
    normal: DVec3,
}

impl Page {
    fn new(face: &Face, half_edge: u32, low: u32, high: u32, positions: &[Vec3]) -> Self {
        let point = |v: u32| positions[v as usize].as_dvec3();
        let k = half_edge as usize % 3;
        let spine = (point(high) - point(low)).normalize_or_zero();
        let into = point(face.vertices[(k + 2) % 3]) - point(low);
        let [a, b, c] = face.points(positions);
        Self {
            half_edge,
            forward: face.vertices[k] == low,
            direction: (into - spine * into.dot(spine)).normalize_or_zero(),
            normal: (b - a).cross(c - a).normalize_or_zero(),
        }
    }

    /// Returns whether the two faces enclose solid between them: each lies behind the other.
    fn convex(&self, other: &Page) -> bool {
        self.normal.dot(other.direction) < 1e-4 && other.normal.dot(self.direction) < 1e-4
    }
}
