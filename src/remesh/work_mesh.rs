//! The film while it is being remeshed: connectivity, positions, and the point of the surface under each vertex.

use bevy_math::Vec3;

use super::chains::NO_CHAIN;
use super::project::{Foot, project};
use super::reference::Reference;
use super::topology::Topology;
use crate::film::{FaceId, HalfEdgeId, VertexId};

/// Part of the clean surface on which a vertex of the film lies and may move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum SurfacePoint {
    /// A vertex of the clean mesh. The film vertex never moves.
    Fixed(VertexId),
    /// A feature line, at the arc length `s`. The film vertex moves along the line.
    Line { chain: u32, s: f32 },
    /// A triangle. The film vertex moves over the patch of the triangle.
    Free(FaceId),
}

#[cfg(test)]
thread_local! {
    /// Number of splits, collapses and flips so far: the measure of work for tests.
    pub(super) static EDITS: std::cell::Cell<u64> = const { std::cell::Cell::new(0) };
}

/// Counts a split, collapse or flip, for tests.
#[inline]
pub(super) fn count_edit() {
    #[cfg(test)]
    EDITS.set(EDITS.get() + 1);
}

/// Film while it is being remeshed, over the surface onto which it is projected.
pub(super) struct WorkMesh<'a> {
    pub reference: &'a Reference<'a>,
    pub topology: Topology,
    pub positions: Vec<Vec3>,
    pub surface_points: Vec<SurfacePoint>,
    /// Chain that each half-edge follows, or [`NO_CHAIN`].
    pub chain_of: Vec<u32>,
    /// Patch in which each face lies.
    pub patches: Vec<u32>,
}

impl<'a> WorkMesh<'a> {
    /// Starts from the clean mesh itself.
    pub fn new(reference: &'a Reference<'a>) -> Self {
        let topology = reference.topology.clone();
        let mut surface_points: Vec<SurfacePoint> = (0..topology.vertex_slots())
            .map(VertexId::new)
            .map(|v| match topology.outgoing(v) {
                Some(h) if !reference.fixed[v.index()] => SurfacePoint::Free(h.face()),
                _ => SurfacePoint::Fixed(v),
            })
            .collect();
        for chain in 0..reference.chains.count() {
            for (v, s) in reference.chains.points(chain) {
                if !reference.fixed[v.index()] {
                    surface_points[v.index()] = SurfacePoint::Line { chain, s };
                }
            }
        }
        Self {
            reference,
            topology,
            positions: reference.positions.to_vec(),
            surface_points,
            chain_of: reference.chain_of.clone(),
            patches: reference.patches.clone(),
        }
    }

    #[inline]
    pub fn position(&self, v: VertexId) -> Vec3 {
        self.positions[v.index()]
    }

    #[inline]
    pub fn surface_point(&self, v: VertexId) -> SurfacePoint {
        self.surface_points[v.index()]
    }

    /// Returns the chain that the edge follows, if it is a feature.
    #[inline]
    pub fn chain(&self, h: HalfEdgeId) -> Option<u32> {
        Some(self.chain_of[h.index()]).filter(|&c| c != NO_CHAIN)
    }

    pub fn set_chain(&mut self, h: HalfEdgeId, chain: Option<u32>) {
        self.chain_of[h.index()] = chain.unwrap_or(NO_CHAIN);
    }

    #[inline]
    pub fn length(&self, h: HalfEdgeId) -> f32 {
        self.position(self.topology.origin(h)).distance(self.position(self.topology.target(h)))
    }

    /// Returns the length of the edge over the factor by which edges may be longer than the target there.
    #[inline]
    pub fn sized_length(&self, h: HalfEdgeId) -> f32 {
        self.length(h) / self.stretch(h)
    }

    /// Returns the factor by which the edge may be longer than the target: see `Sizing`.
    #[inline]
    pub fn stretch(&self, h: HalfEdgeId) -> f32 {
        let sizing = &self.reference.sizing;
        match self.chain(h) {
            Some(chain) => sizing.chains[chain as usize],
            None => sizing.patches[self.patches[h.face().index()] as usize],
        }
    }

    /// Returns the factor of tolerances at the face: see `Sizing`.
    #[inline]
    pub fn scale(&self, f: FaceId) -> f32 {
        self.reference.sizing.patch_scales[self.patches[f.index()] as usize]
    }

    /// Returns the factor that makes 1 of the quality of the best triangles that fit the patch of the face.
    #[inline]
    pub fn allowance(&self, f: FaceId) -> f32 {
        let stretch = self.reference.sizing.patches[self.patches[f.index()] as usize] / self.scale(f);
        (stretch * stretch / 1.5).max(1.0)
    }

    /// Returns the unit normal of the face times twice its area.
    #[inline]
    pub fn area_vector(&self, f: FaceId) -> Vec3 {
        let [a, b, c] = self.topology.corners(f).map(|v| self.position(v));
        (b - a).cross(c - a)
    }

    /// Returns the arc length of a vertex on a chain that passes or ends there.
    pub fn arc_length(&self, v: VertexId, chain: u32) -> f32 {
        match self.surface_point(v) {
            SurfacePoint::Line { s, .. } => s,
            SurfacePoint::Fixed(v) => self.reference.chains.end(chain, v),
            SurfacePoint::Free(_) => 0.0,
        }
    }

    /// Returns the point of the surface under the corner of a face at which `h` starts, on the face's own side of every
    /// feature.
    ///
    /// The features at a vertex divide the faces around it into sectors. A turn clockwise from `h` meets the feature
    /// that begins the sector of the face. The film has the same orientation as the surface, so the same side of the
    /// same chain begins that sector on the surface.
    pub fn corner(&self, h: HalfEdgeId) -> Foot {
        let v = self.topology.origin(h);
        let position = self.position(v);
        if let SurfacePoint::Free(start) = self.surface_point(v) {
            return project(self.reference, position, start);
        }
        let mut opening = h;
        while self.chain(opening).is_none() {
            match self.topology.clockwise(opening) {
                Some(next) if next != h => opening = next,
                _ => break,
            }
        }
        let side = self.chain(opening).and_then(|chain| {
            let (here, there) = (self.arc_length(v, chain), self.arc_length(self.topology.target(opening), chain));
            self.reference.chains.side(chain, here, here < there)
        });
        let Some(side) = side else {
            // A fixed vertex without features: an isolated one.
            let start = match self.surface_point(v) {
                SurfacePoint::Fixed(v) => self.reference.topology.outgoing(v).map(HalfEdgeId::face),
                _ => None,
            };
            return project(self.reference, position, start.unwrap_or(FaceId(0)));
        };
        let k = side.half_edge.index() % 3;
        let mut weights = [0.0; 3];
        weights[k] = 1.0 - side.fraction;
        weights[(k + 1) % 3] = side.fraction;
        Foot { triangle: side.half_edge.face(), position, weights: Vec3::from_array(weights) }
    }

    /// Adds a vertex. The caller must connect it.
    pub fn add_vertex(&mut self, position: Vec3, surface_point: SurfacePoint) -> VertexId {
        let v = self.topology.add_vertex();
        if v.index() == self.positions.len() {
            self.positions.push(position);
            self.surface_points.push(surface_point);
        } else {
            self.positions[v.index()] = position;
            self.surface_points[v.index()] = surface_point;
        }
        v
    }

    pub fn add_face(&mut self, corners: [VertexId; 3], patch: u32) -> FaceId {
        let f = self.topology.add_face(corners);
        if f.index() == self.patches.len() {
            self.patches.push(patch);
            self.chain_of.extend([NO_CHAIN; 3]);
        } else {
            self.patches[f.index()] = patch;
            for h in f.half_edges() {
                self.set_chain(h, None);
            }
        }
        f
    }

    /// Exchanges the position of a vertex and its part of the surface with `other`, so that the move can be undone.
    pub fn exchange(&mut self, v: VertexId, other: &mut (Vec3, SurfacePoint)) {
        std::mem::swap(&mut self.positions[v.index()], &mut other.0);
        std::mem::swap(&mut self.surface_points[v.index()], &mut other.1);
    }

    /// Returns the distance of the middle of the edge `h` from the surface, over the scale of the part. It is 0 for
    /// feature edges, whose distance from their line is measured instead.
    pub fn stray(&self, h: HalfEdgeId) -> f32 {
        if self.chain(h).is_some() {
            return 0.0;
        }
        let (a, b) = (self.topology.origin(h), self.topology.target(h));
        let start = match (self.surface_point(a), self.surface_point(b)) {
            (SurfacePoint::Free(f), _) | (_, SurfacePoint::Free(f)) => f,
            _ => self.corner(h).triangle,
        };
        self.stray_between(self.position(a), self.position(b), start, h.face())
    }

    /// Returns the distance of the middle of an edge from `a` to `b` at the face `f` from the surface, over the scale
    /// of the part and the closeness of the film.
    pub fn stray_between(&self, a: Vec3, b: Vec3, start: FaceId, f: FaceId) -> f32 {
        self.stray_at(a.midpoint(b), start) / (self.scale(f) * self.reference.closeness)
    }

    /// Returns the largest distance of the edges at a vertex from the surface.
    pub fn stray_around(&self, v: VertexId) -> f32 {
        self.topology.ring(v).map(|h| self.stray(h)).fold(0.0, f32::max)
    }

    /// Returns whether the faces at a vertex are far from coplanar.
    pub fn is_bent(&self, v: VertexId) -> bool {
        let normal: Vec3 = self.topology.faces_around(v).map(|f| self.area_vector(f)).sum();
        let normal = normal.normalize_or_zero();
        self.topology.faces_around(v).map(|f| self.area_vector(f)).any(|n| n.dot(normal) < BENT * n.length())
    }

    /// Returns the distance of `p` from the surface near the triangle `start`.
    pub fn stray_at(&self, p: Vec3, start: FaceId) -> f32 {
        project(self.reference, p, start).position.distance(p)
    }

    /// Returns the least quality of the faces at `v` if it were at `p`, or `None` if one of them would fold over. The
    /// faces in `skip` are left out.
    pub fn quality_at(&self, v: VertexId, p: Vec3, skip: [Option<FaceId>; 2]) -> Option<f32> {
        let mut least = f32::MAX;
        for h in self.topology.ring(v) {
            if skip.contains(&Some(h.face())) {
                continue;
            }
            let (a, b) = (self.position(self.topology.target(h)), self.position(self.topology.opposite(h)));
            let before = self.area_vector(h.face());
            let after = (a - p).cross(b - p);
            if after.dot(before) < FOLD * after.length() * before.length() || after == Vec3::ZERO {
                return None;
            }
            least = least.min(quality(p, a, b) * self.allowance(h.face()));
        }
        Some(least)
    }

    /// Returns the least quality of the faces at `v`.
    pub fn quality(&self, v: VertexId) -> f32 {
        self.topology
            .faces_around(v)
            .map(|f| {
                let [a, b, c] = self.topology.corners(f).map(|v| self.position(v));
                quality(a, b, c) * self.allowance(f)
            })
            .fold(f32::MAX, f32::min)
    }
}

/// Cosine of the angle by which a face may turn in one edit: about 70 degrees.
pub(super) const FOLD: f32 = 0.35;

/// Cosine of the angle between a face and the mean normal above which the faces are bent: about 35 degrees.
const BENT: f32 = 0.82;

/// Returns the quality of a triangle, 1 if it is equilateral and 0 if it has no area: its area over the sum of its
/// squared sides, scaled.
pub(super) fn quality(a: Vec3, b: Vec3, c: Vec3) -> f32 {
    let sides = a.distance_squared(b) + b.distance_squared(c) + c.distance_squared(a);
    if sides > 0.0 { 2.0 * 3.0_f32.sqrt() * (b - a).cross(c - a).length() / sides } else { 0.0 }
}
