//! Finds the way of a scratch: along edges of the film, as straight as they allow.

use bevy_math::Vec3;

use super::{reach::originals_of, site::Site};
use crate::film::{FilmMesh, HalfEdgeId, VertexId};

/// Price of a way beside the straight line, in lengths for each length that its middle lies beside it.
const ASTRAY: f32 = 6.0;
/// Distance beside the straight line, as a share of its length, beyond which no way is looked for.
const FARTHEST: f32 = 0.25;

/// Returns the edges of the shortest way over the film at rest from `from` to `to`. It is empty where there is none
/// near the straight line, and where both places have the same nearest corner.
pub(super) fn route(mesh: &FilmMesh, from: Site, to: Site) -> Vec<HalfEdgeId> {
    let topology = &mesh.topology;
    let rest = |v: VertexId| mesh.geometry.rest_positions[v.index()];
    let (Some(start), Some(end)) = (from.at_rest(mesh), to.at_rest(mesh)) else { return Vec::new() };
    let nearest = |site: Site, at: Vec3| {
        let [a, b, c] = originals_of(topology, site.face);
        let d = |v: VertexId| rest(v).distance_squared(at);
        let ab = if d(b) < d(a) { b } else { a };
        if d(c) < d(ab) { c } else { ab }
    };
    let (first, last) = (nearest(from, start), nearest(to, end));
    let line = end - start;
    let most = FARTHEST * line.length_squared().sqrt() + 2.0 * mesh.geometry.mean_edge;
    let beside = |p: Vec3| {
        let along = (p - start).dot(line) / line.length_squared().max(f32::MIN_POSITIVE);
        (p - start - line * along.clamp(0.0, 1.0)).length_squared().sqrt()
    };
    // Edges near the line, so that the search looks at few.
    let count = topology.original_vertex_count();
    let (mut edges, mut starts) = (Vec::new(), vec![0usize; count + 1]);
    for h in topology.all_edges() {
        let [a, b] = [topology.origin(h), topology.target(h)].map(|v| topology.original(v));
        let astray = beside(rest(a).midpoint(rest(b)));
        if astray <= most {
            let price = mesh.geometry.rest_lengths[h.index()] + ASTRAY * astray;
            edges.push(([a, b], h, price));
            starts[a.index() + 1] += 1;
            starts[b.index() + 1] += 1;
        }
    }
    // The same by their ends: those of vertex `v` are from `starts[v]` to before `starts[v + 1]`.
    for i in 0..count {
        starts[i + 1] += starts[i];
    }
    let (mut next, mut ways) = (starts.clone(), vec![(VertexId(0), HalfEdgeId(0), 0.0f32); 2 * edges.len()]);
    for &([a, b], h, price) in &edges {
        for (from, to) in [(a, b), (b, a)] {
            ways[next[from.index()]] = (to, h, price);
            next[from.index()] += 1;
        }
    }
    let at = |v: VertexId| &ways[starts[v.index()]..starts[v.index() + 1]];
    let mut prices = vec![f32::INFINITY; count];
    let mut came: Vec<Option<(VertexId, HalfEdgeId)>> = vec![None; count];
    let mut queue = std::collections::BinaryHeap::new();
    prices[first.index()] = 0.0;
    // Prices are not negative, so their bits are in their order.
    queue.push(std::cmp::Reverse((0u32, first)));
    while let Some(std::cmp::Reverse((price, v))) = queue.pop() {
        if v == last {
            break;
        }
        if f32::from_bits(price) > prices[v.index()] {
            continue;
        }
        for &(next, h, more) in at(v) {
            let price = prices[v.index()] + more;
            if price < prices[next.index()] {
                prices[next.index()] = price;
                came[next.index()] = Some((v, h));
                queue.push(std::cmp::Reverse((price.to_bits(), next)));
            }
        }
    }
    let mut way = Vec::new();
    let mut v = last;
    while let Some((before, h)) = came[v.index()].filter(|_| v != first) {
        way.push(h);
        v = before;
    }
    if v == first { way } else { Vec::new() }
}
