//! Points along the edges of the film, the same for both faces at an edge.

use bevy_math::Vec3;

use super::{
    corners::Corners,
    seek::{Seeker, edge_normal, settle, starts},
};
use crate::{
    film::{FaceGrid, HalfEdgeId},
    rest::{PIECE, Rest, pieces},
    surface::SurfaceSite,
};

/// Inner points of every half-edge, in its own direction.
pub struct Edges {
    /// Number of small edges along an edge.
    count: usize,
    positions: Vec<Vec3>,
    sites: Vec<SurfaceSite>,
}

impl Edges {
    pub async fn new(seeker: &Seeker<'_>, corners: &Corners<'_>, grid: &FaceGrid, rest: &mut impl Rest) -> Self {
        let count = 1 << grid.level();
        let inner = (count - 1) * corners.half_edges().count();
        let none = SurfaceSite { triangle: 0, weights: Vec3::X };
        let mut edges = Self { count, positions: vec![Vec3::ZERO; inner], sites: vec![none; inner] };
        for piece in pieces(corners.half_edges().len(), (4 * PIECE / count).max(1)) {
            for h in piece.map(HalfEdgeId::new).filter(|&h| corners.leads(h)) {
                for i in 1..count {
                    let (position, own, far) = point(seeker, corners, h, i as f32 / count as f32);
                    edges.set(h, i, position, own);
                    if let (Some(t), Some(far)) = (corners.twin(h), far) {
                        edges.set(t, count - i, position, far);
                    }
                }
            }
            rest.rest().await;
        }
        edges
    }

    fn at(&self, h: HalfEdgeId, i: usize) -> usize {
        (self.count - 1) * h.index() + i - 1
    }

    fn set(&mut self, h: HalfEdgeId, i: usize, position: Vec3, site: SurfaceSite) {
        let at = self.at(h, i);
        self.positions[at] = position;
        self.sites[at] = site;
    }

    /// Returns the inner point `i` of the half-edge, which is neither its first nor its last.
    pub fn point(&self, h: HalfEdgeId, i: usize) -> (Vec3, SurfaceSite) {
        let at = self.at(h, i);
        (self.positions[at], self.sites[at])
    }

    /// Returns how far the edge is away from its chord, at a share of its length.
    pub fn bulge(&self, corners: &Corners, h: HalfEdgeId, share: f32) -> Vec3 {
        let at = |i: usize| match i {
            i if i == 0 || i >= self.count => Vec3::ZERO,
            i => self.point(h, i).0 - chord(corners, h, i as f32 / self.count as f32),
        };
        let along = share * self.count as f32;
        let i = along as usize;
        at(i).lerp(at(i + 1), along - i as f32)
    }

    /// Moves all points of the edge, on both sides, onto its chord.
    pub fn flatten(&mut self, corners: &Corners, h: HalfEdgeId) {
        let h = corners.twin(h).map_or(h, |t| t.min(h));
        for i in 1..self.count {
            let position = chord(corners, h, i as f32 / self.count as f32);
            let at = self.at(h, i);
            self.positions[at] = position;
            if let Some(t) = corners.twin(h) {
                let at = self.at(t, self.count - i);
                self.positions[at] = position;
            }
        }
    }
}

/// Returns the point of the straight edge at a share of its length. It is the same, to the bit, from both sides.
fn chord(corners: &Corners, h: HalfEdgeId, share: f32) -> Vec3 {
    let (h, share) = match corners.twin(h) {
        Some(t) if t < h => (t, 1.0 - share),
        _ => (h, share),
    };
    corners.position(h).lerp(corners.position(h.next()), share)
}

/// Returns the point at a share of the edge of a leading half-edge: its position, and its sites for the two faces.
fn point(seeker: &Seeker, corners: &Corners, h: HalfEdgeId, share: f32) -> (Vec3, SurfaceSite, Option<SurfaceSite>) {
    let twin = corners.twin(h);
    let straight = chord(corners, h, share);
    let size = corners.size(h.face());
    // Where nothing is known, the site of the nearer corner.
    let rough = |h: HalfEdgeId, share: f32| corners.site(if share < 0.5 { h } else { h.next() });
    let on_side = |h: HalfEdgeId, share: f32, position: Vec3| {
        if corners.is_edge_flat(h) {
            return mix(corners.site(h), corners.site(h.next()), share);
        }
        let foot = seeker.nearest(position, &starts(corners, h.face(), weights(h, share)), size);
        foot.map_or_else(|| rough(h, share), |foot| seeker.site(&foot))
    };
    if !corners.is_known(h.face()) || twin.is_some_and(|t| !corners.is_known(t.face())) {
        return (straight, rough(h, share), twin.map(|t| rough(t, 1.0 - share)));
    }
    if let Some(on) = seeker.on_line(h, share) {
        let position = on.left.or(on.right).map_or(straight, |foot| settle(straight, &foot, size));
        let own = on.left.map_or_else(|| rough(h, share), |foot| seeker.site(&foot));
        let far = on.right.map(|foot| seeker.site(&foot));
        return (position, own, twin.map(|t| far.unwrap_or_else(|| rough(t, 1.0 - share))));
    }
    if corners.is_edge_flat(h) || twin.is_some_and(|t| corners.is_edge_flat(t)) {
        let far = twin.map(|t| on_side(t, 1.0 - share, straight));
        return (straight, on_side(h, share, straight), far);
    }
    let starts = starts(corners, h.face(), weights(h, share));
    let Some(found) = seeker.seek(straight, edge_normal(seeker, corners, h), &starts, size) else {
        return (straight, rough(h, share), twin.map(|t| rough(t, 1.0 - share)));
    };
    let own = seeker.site(&found.foot);
    let far = twin.map(|t| if seeker.is_doubtful(corners, h) { on_side(t, 1.0 - share, found.position) } else { own });
    (found.position, own, far)
}

/// Returns the weights of the face's corners at a share of the half-edge.
fn weights(h: HalfEdgeId, share: f32) -> Vec3 {
    let k = h.index() % 3;
    Vec3::AXES[k] * (1.0 - share) + Vec3::AXES[(k + 1) % 3] * share
}

/// Returns the site between two on the same triangle.
fn mix(a: SurfaceSite, b: SurfaceSite, share: f32) -> SurfaceSite {
    SurfaceSite { triangle: a.triangle, weights: a.weights.lerp(b.weights, share) }
}
