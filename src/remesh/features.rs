//! Finds the edges of the prop's surface that the film must follow.
//!
//! These are always: borders, creases, UV seams, hard normals, colour borders, slot borders and borders of turned
//! winding. Where the prop's own triangles are large compared to the film's, the film also follows every edge that is
//! not flat or across which an attribute bends, since the fresh film must look exactly like the prop, down to its
//! facets. On dense scans such edges come from the sampling only, and the film runs across them.

use bevy_math::Vec3;

use super::seams::Seams;
use super::topology::Topology;
use crate::{
    film::{FaceId, HalfEdgeId},
    rest::{LIGHT_PIECE, Rest, pieces},
    surface::{CleanSurface, Surface},
};

/// Cosine of the crease angle, 30 degrees.
pub(super) const CREASE: f32 = 0.866;
/// Cosine of the angle up to which two triangles count as coplanar, 1.5 degrees.
const FLAT: f32 = 0.999_66;
/// A prop with at most this number of triangles is followed exactly everywhere.
const LOW_POLY: f32 = 500.0;
/// A prop is also followed exactly if it has at most this share of the film's number of triangles.
const LOW_POLY_SHARE: f32 = 0.3;
/// On other props an edge is followed exactly if both of its triangles are at least this high over it, in target edges.
const LOW_POLY_HEIGHT: f32 = 1.5;
/// A sharp edge at a face with a side longer than this, in target edges, is never taken for noise.
const NOISE_FACE: f32 = 1.2;

/// Height of a face over a crease below which the crease may be given up, in target edges.
const NARROW: f32 = 0.75;

/// How closely the film follows its prop. Where the features need more triangles than there may be, the film is less
/// faithful.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Fidelity {
    /// It follows the facets of low-poly props, to their corners.
    Facets,
    /// It follows borders, seams and creases, and runs smoothly over facets that are small for it.
    Creases,
    /// It follows borders, seams, and creases between faces that are large for it.
    Shape,
}

impl Fidelity {
    /// Returns the next less faithful way, if there is one.
    pub fn next(self) -> Option<Self> {
        match self {
            Self::Facets => Some(Self::Creases),
            Self::Creases => Some(Self::Shape),
            Self::Shape => None,
        }
    }
}

/// Size of the film for which features are found.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scale {
    /// Edge length.
    pub target: f32,
    /// Approximate number of triangles.
    pub triangles: f32,
    pub fidelity: Fidelity,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Free,
    /// A sharp edge between faces smaller than the film's: a crease or the noise of a scan.
    Doubtful,
    /// A crease, border or seam. The film follows its line, with vertices anywhere on it.
    Line,
    /// An edge of a low-poly prop. The film follows it and has vertices at both of its ends.
    Exact,
}

/// The feature edges of the clean mesh.
pub(super) struct Features {
    kinds: Vec<Kind>,
}

impl Features {
    /// Classifies the edges for a film of this scale.
    pub async fn find(
        surface: &Surface,
        clean: &CleanSurface,
        topology: &Topology,
        normals: &[Vec3],
        Scale { target, triangles, fidelity }: Scale,
        rest: &mut impl Rest,
    ) -> Self {
        let seams = Seams::new(surface, clean, rest).await;
        let positions = &clean.positions;
        let low_poly =
            fidelity == Fidelity::Facets && clean.triangles.len() as f32 <= LOW_POLY.max(LOW_POLY_SHARE * triangles);
        let height = |h: HalfEdgeId| {
            let [a, b, c] =
                [topology.origin(h), topology.target(h), topology.opposite(h)].map(|v| positions[v.index()]);
            (b - a).cross(c - a).length() / (b - a).length().max(f32::MIN_POSITIVE)
        };
        // Where only the shape is kept, creases may not divide what is narrower than the film's edges.
        let is_narrow =
            |h: HalfEdgeId, t: HalfEdgeId| fidelity == Fidelity::Shape && height(h).min(height(t)) < NARROW * target;
        let is_small = |f: FaceId| {
            f.half_edges().into_iter().all(|h| {
                let [a, b] = [topology.origin(h), topology.target(h)].map(|v| positions[v.index()]);
                a.distance(b) < NOISE_FACE * target
            })
        };
        // Coarser films have no vertex at every end of an edge that is short for them.
        let is_long = |h: HalfEdgeId| {
            let [a, b] = [topology.origin(h), topology.target(h)].map(|v| positions[v.index()]);
            fidelity == Fidelity::Facets || a.distance(b) >= target
        };
        let mut kinds = vec![Kind::Free; 3 * topology.face_slots()];
        for half_edges in pieces(topology.half_edge_slots(), LIGHT_PIECE) {
            for h in topology.edges_in(half_edges) {
                let Some(t) = topology.twin(h) else {
                    let exact = low_poly || height(h) >= LOW_POLY_HEIGHT * target && is_long(h);
                    kinds[h.index()] = if exact { Kind::Exact } else { Kind::Line };
                    continue;
                };
                let (f, g) = (h.face(), t.face());
                let cosine = normals[f.index()].dot(normals[g.index()]);
                let exact = low_poly || height(h).min(height(t)) >= LOW_POLY_HEIGHT * target && is_long(h);
                let seam = seams.divide(h, t, exact);
                let uneven = || cosine < FLAT || seams.attributes.bend(topology, positions, h, t, target);
                let kind = if exact && (seam || uneven()) {
                    Kind::Exact
                } else if seam {
                    Kind::Line
                } else if cosine < CREASE && !is_narrow(h, t) {
                    if is_small(f) && is_small(g) { Kind::Doubtful } else { Kind::Line }
                } else {
                    Kind::Free
                };
                kinds[h.index()] = kind;
                kinds[t.index()] = kind;
            }
            rest.rest().await;
        }
        Self { kinds }
    }

    #[inline]
    pub fn is_kept(&self, h: HalfEdgeId) -> bool {
        self.kinds[h.index()] != Kind::Free
    }

    /// Returns, for each vertex, whether it must stay in place because an exact edge ends there.
    pub fn rigid_vertices(&self, topology: &Topology) -> Vec<bool> {
        let mut rigid = vec![false; topology.vertex_slots()];
        for h in topology.edges().filter(|h| self.kinds[h.index()] == Kind::Exact) {
            rigid[topology.origin(h).index()] = true;
            rigid[topology.target(h).index()] = true;
        }
        rigid
    }

    /// Returns the patch of every face. A patch is a region bounded by features; patches are numbered in the order of
    /// their lowest faces.
    pub fn patches(&self, topology: &Topology) -> Vec<u32> {
        let mut patches = vec![u32::MAX; topology.face_slots()];
        let mut count = 0;
        let mut open = Vec::new();
        for seed in topology.faces() {
            if patches[seed.index()] != u32::MAX {
                continue;
            }
            patches[seed.index()] = count;
            open.push(seed);
            while let Some(f) = open.pop() {
                for h in f.half_edges().into_iter().filter(|&h| !self.is_kept(h)) {
                    if let Some(t) = topology.twin(h)
                        && patches[t.face().index()] == u32::MAX
                    {
                        patches[t.face().index()] = count;
                        open.push(t.face());
                    }
                }
            }
            count += 1;
        }
        patches
    }

    pub(super) fn is_doubtful(&self, h: HalfEdgeId) -> bool {
        self.kinds[h.index()] == Kind::Doubtful
    }

    /// Makes the edge no feature.
    pub(super) fn free(&mut self, topology: &Topology, h: HalfEdgeId) {
        self.kinds[h.index()] = Kind::Free;
        if let Some(t) = topology.twin(h) {
            self.kinds[t.index()] = Kind::Free;
        }
    }
}
