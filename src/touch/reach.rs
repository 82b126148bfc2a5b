//! Finds what a touch reaches: distances along the surface at rest, also across cracks and where film is gone.

use std::collections::VecDeque;

use bevy_math::{Vec2, Vec3};

use super::site::Site;
use crate::film::{FaceId, FilmMesh, Topology, VertexId};

/// Faces and vertices within the radius of a touch.
#[derive(Clone, Debug, Default)]
pub(super) struct Reach {
    /// Distance of each original vertex in metres; infinite beyond the radius.
    pub distances: Vec<f32>,
    /// Faces with a corner within the radius, in ascending order; with the face of the touch itself.
    pub faces: Vec<FaceId>,
    /// Original vertices within the radius, in ascending order.
    pub vertices: Vec<VertexId>,
}

impl Reach {
    /// Finds what lies within `radius` of `site`, but at least its face and the nearest corner of that.
    ///
    /// Distances spread from face to face. In each, the two corners that are known stand for a source in the plane of
    /// the face, from which the third is reached in a straight line, if that leads through the edge between them. On
    /// flat and on developable surfaces this is exact but for lines around holes and creases.
    pub fn new(mesh: &FilmMesh, site: Site, radius: f32) -> Self {
        let (topology, rest) = (&mesh.topology, &mesh.geometry.rest_positions);
        let originals = topology.original_vertex_count();
        let Some(at) = site.at_rest(mesh) else { return Self::default() };
        let mut reach = Self { distances: vec![f32::INFINITY; originals], ..Self::default() };
        let corners = originals_of(topology, site.face);
        let mut nearest = (f32::INFINITY, VertexId(0));
        for v in corners {
            let distance = (rest[v.index()] - at).length_squared().sqrt();
            if distance < nearest.0 {
                nearest = (distance, v);
            }
            if distance <= radius {
                reach.distances[v.index()] = distance;
            }
        }
        // At the nearest vertex a touch that is too small for the film has its full strength.
        if nearest.0 > radius {
            reach.distances[nearest.1.index()] = 0.0;
        }
        let mut waits = vec![false; topology.face_count()];
        let mut faces = VecDeque::from([site.face]);
        waits[site.face.index()] = true;
        let mut is_known = vec![false; topology.face_count()];
        while let Some(f) = faces.pop_front() {
            waits[f.index()] = false;
            is_known[f.index()] = true;
            let nearer = reach.spread(mesh, f, radius);
            for h in f.half_edges() {
                let Some(next) = topology.rest_twin(h).map(|twin| twin.face()) else { continue };
                let ends = [topology.origin(h), topology.target(h)].map(|v| topology.original(v).index());
                let is_near = ends.iter().any(|&v| reach.distances[v] < f32::INFINITY);
                if is_near && (nearer || !is_known[next.index()]) && !waits[next.index()] {
                    waits[next.index()] = true;
                    faces.push_back(next);
                }
            }
        }
        let is_near = |v: VertexId| reach.distances[v.index()] < f32::INFINITY;
        let near = |f: &FaceId| is_known[f.index()] && originals_of(topology, *f).into_iter().any(is_near);
        reach.faces = topology.all_faces().filter(near).collect();
        reach.vertices = (0..originals).map(VertexId::new).filter(|&v| is_near(v)).collect();
        reach
    }

    /// Brings the corners of `f` nearer where a way leads through it. Returns whether it has any.
    fn spread(&mut self, mesh: &FilmMesh, f: FaceId, radius: f32) -> bool {
        let corners = originals_of(&mesh.topology, f);
        let places = corners.map(|v| mesh.geometry.rest_positions[v.index()]);
        let mut nearer = false;
        for k in 0..3 {
            let (a, b, c) = (k, (k + 1) % 3, (k + 2) % 3);
            let known = [a, b].map(|i| self.distances[corners[i].index()]);
            let found = through(known, [places[a], places[b], places[c]]);
            let distance = &mut self.distances[corners[c].index()];
            if found < *distance && found <= radius {
                *distance = found;
                nearer = true;
            }
        }
        nearer
    }

    /// Returns the distance of the middle of `f`: the mean over its corners.
    pub fn distance_of(&self, topology: &Topology, f: FaceId) -> f32 {
        originals_of(topology, f).map(|v| self.distances[v.index()]).iter().sum::<f32>() / 3.0
    }
}

/// Returns the original vertices at the corners of `f`.
pub(super) fn originals_of(topology: &Topology, f: FaceId) -> [VertexId; 3] {
    topology.corners(f).map(|v| topology.original(v))
}

/// Returns the distance of c from a source that is `known` to be so far from a and from b, on the other side of their
/// edge.
fn through([from_a, from_b]: [f32; 2], [a, b, c]: [Vec3; 3]) -> f32 {
    let length = |v: Vec3| v.length_squared().sqrt();
    let (edge, ac, bc) = (b - a, c - a, c - b);
    let around = (from_a + length(ac)).min(from_b + length(bc));
    let base = length(edge);
    if !(from_a < f32::INFINITY && from_b < f32::INFINITY && base > 0.0) {
        return around;
    }
    // In the plane of the face: a at the origin, b along x, c above, the source below.
    let x = ac.dot(edge) / base;
    let top = Vec2::new(x, (ac.length_squared() - x * x).max(0.0).sqrt());
    let x = (from_a * from_a - from_b * from_b + base * base) / (2.0 * base);
    let below = from_a * from_a - x * x;
    if below < 0.0 {
        return around;
    }
    let source = Vec2::new(x, -below.sqrt());
    let way = top - source;
    // Where the straight line crosses the edge.
    let crossing = source.x - source.y * way.x / way.y;
    let straight = way.length_squared().sqrt();
    if way.y > 0.0 && (0.0..=base).contains(&crossing) { straight.min(around) } else { around }
}
