//! Points within the faces of the film, from those along their edges.

use bevy_math::Vec3;

use super::{
    corners::Corners,
    edges::Edges,
    seek::{Seeker, edge_normal, starts},
};
use crate::{
    film::{FaceGrid, FaceId, HalfEdgeId},
    rest::{PIECE, Rest},
    surface::SurfaceSite,
};

/// Cosine of the angle between a face and its small triangles from which these are folded over: a right angle, and a
/// little more for the rounded walls of upright bumps.
const TURNED: f32 = -0.01;

/// Place of a point in the grid.
#[derive(Clone, Copy)]
enum Place {
    Corner(usize),
    /// Point of an edge, counted along it.
    Edge(usize, usize),
    Inside,
}

/// How the points of a face are found. Each way is safer than the one before it.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Way {
    /// All lie on the surface.
    Surface,
    /// Points within lie between the edges, wherever the surface is.
    Between,
    /// All lie in the flat face.
    Flat,
}

/// Points of all faces.
pub struct Faces {
    pub positions: Vec<Vec3>,
    pub sites: Vec<SurfaceSite>,
    /// Corner at which each point lies, if it lies at one.
    pub corner_of: Vec<Option<HalfEdgeId>>,
}

impl Faces {
    pub async fn new(
        seeker: &Seeker<'_>,
        corners: &Corners<'_>,
        mut edges: Edges,
        grid: &FaceGrid,
        rest: &mut impl Rest,
    ) -> Self {
        let places = places(grid);
        let count = corners.faces().count() * grid.points().len();
        let none = SurfaceSite { triangle: 0, weights: Vec3::X };
        let mut faces =
            Self { positions: vec![Vec3::ZERO; count], sites: vec![none; count], corner_of: vec![None; count] };
        let mut ways = vec![Way::Surface; corners.faces().count()];
        let mut open: Vec<FaceId> = corners.faces().collect();
        // A face goes two steps at most, and opens its three neighbours once.
        while !open.is_empty() {
            let mut folded: Vec<FaceId> = Vec::new();
            for piece in open.chunks((4 * PIECE / places.len()).max(1)) {
                for &f in piece {
                    faces.fill(seeker, corners, &edges, grid, &places, f, ways[f.index()]);
                }
                folded.extend(piece.iter().copied().filter(|&f| faces.is_folded(corners, grid, f)));
                rest.rest().await;
            }
            open.clear();
            for f in folded {
                let way = &mut ways[f.index()];
                match *way {
                    Way::Surface => {
                        *way = Way::Between;
                        open.push(f);
                    }
                    Way::Between => {
                        *way = Way::Flat;
                        open.push(f);
                        for h in f.half_edges() {
                            edges.flatten(corners, h);
                            open.extend(corners.twin(h).map(HalfEdgeId::face));
                        }
                    }
                    Way::Flat => {}
                }
            }
            open.sort_unstable();
            open.dedup();
        }
        faces
    }

    fn fill(
        &mut self,
        seeker: &Seeker,
        corners: &Corners,
        edges: &Edges,
        grid: &FaceGrid,
        places: &[Place],
        f: FaceId,
        way: Way,
    ) {
        let half_edges = f.half_edges();
        let normals = half_edges.map(|h| edge_normal(seeker, corners, h));
        let first = f.index() * grid.points().len();
        for (i, (&weights, &place)) in grid.points().iter().zip(places).enumerate() {
            let (position, site) = match place {
                Place::Corner(k) => {
                    self.corner_of[first + i] = Some(half_edges[k]);
                    (corners.position(half_edges[k]), corners.site(half_edges[k]))
                }
                Place::Edge(k, i) => edges.point(half_edges[k], i),
                Place::Inside => inside(seeker, corners, edges, f, weights, normals, way),
            };
            self.positions[first + i] = position;
            self.sites[first + i] = site;
        }
    }

    /// Returns whether a small triangle is turned away from the face.
    fn is_folded(&self, corners: &Corners, grid: &FaceGrid, f: FaceId) -> bool {
        let first = f.index() * grid.points().len();
        let normal = corners.normal(f);
        grid.triangles().iter().any(|t| {
            let [a, b, c] = t.map(|i| self.positions[first + i as usize]);
            let area = (b - a).cross(c - a);
            area.dot(normal) < TURNED * area.length()
        })
    }
}

/// Returns the place of each point of the grid.
fn places(grid: &FaceGrid) -> Vec<Place> {
    let mut places = vec![Place::Inside; grid.points().len()];
    for k in 0..3 {
        for (i, &at) in grid.edge(k).iter().enumerate() {
            let last = grid.edge(k).len() - 1;
            places[at as usize] = match i {
                0 => Place::Corner(k),
                i if i == last => Place::Corner((k + 1) % 3),
                i => Place::Edge(k, i),
            };
        }
    }
    places
}

/// Returns a point within the face.
fn inside(
    seeker: &Seeker,
    corners: &Corners,
    edges: &Edges,
    f: FaceId,
    weights: Vec3,
    normals: [Vec3; 3],
    way: Way,
) -> (Vec3, SurfaceSite) {
    let half_edges = f.half_edges();
    let [a, b, c] = corners.positions_of(f);
    let mut expected = a * weights.x + b * weights.y + c * weights.z;
    if corners.is_flat(f) {
        let [a, b, c] = half_edges.map(|h| corners.site(h));
        let mixed = a.weights * weights.x + b.weights * weights.y + c.weights * weights.z;
        return (expected, SurfaceSite { triangle: a.triangle, weights: mixed });
    }
    let mut normal = Vec3::ZERO;
    for k in 0..3 {
        let [a, b] = [weights[k], weights[(k + 1) % 3]];
        // 1 all along the edge and 0 along the two others (Szabo and Babuska, Finite Element Analysis, 1991).
        let share = 4.0 * a * b / (1.0 - (b - a) * (b - a));
        expected += edges.bulge(corners, half_edges[k], 0.5 * (1.0 + b - a)) * share;
        normal += normals[k] * (a * b);
    }
    let rough = || {
        let greatest = (0..3).max_by(|&i, &j| weights[i].total_cmp(&weights[j])).unwrap_or_default();
        corners.site(half_edges[greatest])
    };
    let known = if corners.is_known(f) { starts(corners, f, weights) } else { Vec::new() };
    let normal = normal.try_normalize().unwrap_or(corners.normal(f));
    match seeker.seek(expected, normal, &known, corners.size(f)) {
        Some(found) => {
            let position = if way == Way::Surface { found.position } else { expected };
            (position, seeker.site(&found.foot))
        }
        None => (expected, rough()),
    }
}
