//! The corners of the film's faces, and where they lie on the clean surface.

use bevy_math::Vec3;

use crate::{
    film::{FaceId, HalfEdgeId, VertexId},
    remesh::{film::BuiltFilm, frame::Frame, project::Foot, project::distance_to_triangle, project::nearest_weights},
    rest::{LIGHT_PIECE, Rest, pieces},
    surface::{CleanSurface, SurfaceSite, twins_in_pieces},
};

/// Film in the frame in which it was built. Its corners are named by the half-edges that start there.
pub struct Corners<'a> {
    built: &'a BuiltFilm,
    positions: Vec<Vec3>,
    twins: Vec<u32>,
    /// Point of the clean surface under each corner, if it is known.
    feet: Vec<Option<Foot>>,
    /// Unit normal of each face, or zero.
    normals: Vec<Vec3>,
}

impl<'a> Corners<'a> {
    pub async fn new(clean: &CleanSurface, built: &'a BuiltFilm, frame: &Frame, rest: &mut impl Rest) -> Self {
        let positions = built.positions.iter().map(|&p| frame.inside(p)).collect();
        let twins = twins_in_pieces(&built.triangles, rest).await;
        let mut corners = Self { built, positions, twins, feet: Vec::new(), normals: Vec::new() };
        let parts = Pieces::new(clean);
        for piece in pieces(3 * built.triangles.len(), LIGHT_PIECE) {
            for h in piece.map(HalfEdgeId::new) {
                let foot = parts.foot(clean, corners.position(h), corners.site(h));
                corners.feet.push(foot);
            }
            rest.rest().await;
        }
        let normal = |f: FaceId| {
            let [a, b, c] = corners.positions_of(f).map(|p| p.as_dvec3());
            (b - a).cross(c - a).try_normalize().unwrap_or_default().as_vec3()
        };
        corners.normals = corners.faces().map(normal).collect();
        corners
    }

    pub fn faces(&self) -> impl Iterator<Item = FaceId> + use<> {
        (0..self.built.triangles.len()).map(FaceId::new)
    }

    pub fn half_edges(&self) -> impl ExactSizeIterator<Item = HalfEdgeId> + use<> {
        (0..3 * self.built.triangles.len()).map(HalfEdgeId::new)
    }

    /// Returns the number of the vertices that are given.
    pub fn vertex_count(&self) -> usize {
        self.positions.len()
    }

    pub fn vertex(&self, h: HalfEdgeId) -> VertexId {
        VertexId(self.built.triangles[h.face().index()][h.index() % 3])
    }

    pub fn twin(&self, h: HalfEdgeId) -> Option<HalfEdgeId> {
        HalfEdgeId(self.twins[h.index()]).get()
    }

    /// Returns whether this half-edge is the one of its edge at which the edge is worked on: the lower one.
    pub fn leads(&self, h: HalfEdgeId) -> bool {
        self.twin(h).is_none_or(|t| h < t)
    }

    pub fn position(&self, h: HalfEdgeId) -> Vec3 {
        self.positions.get(self.vertex(h).index()).copied().unwrap_or_default()
    }

    /// Returns the position of the corner in the space of the surface, as the film has it.
    pub fn exact(&self, h: HalfEdgeId) -> Vec3 {
        self.built.positions.get(self.vertex(h).index()).copied().unwrap_or_default()
    }

    pub fn positions_of(&self, f: FaceId) -> [Vec3; 3] {
        f.half_edges().map(|h| self.position(h))
    }

    pub fn site(&self, h: HalfEdgeId) -> SurfaceSite {
        let none = SurfaceSite { triangle: 0, weights: Vec3::X };
        self.built.sites.get(h.index()).copied().unwrap_or(none)
    }

    pub fn foot(&self, h: HalfEdgeId) -> Option<Foot> {
        self.feet[h.index()]
    }

    pub fn normal(&self, f: FaceId) -> Vec3 {
        self.normals[f.index()]
    }

    /// Returns the length of the edge.
    pub fn length(&self, h: HalfEdgeId) -> f32 {
        self.position(h).distance(self.position(h.next()))
    }

    /// Returns the mean edge of the face.
    pub fn size(&self, f: FaceId) -> f32 {
        f.half_edges().map(|h| self.length(h)).iter().sum::<f32>() / 3.0
    }

    /// Returns whether the edge lies on one triangle, as seen from the face of `h`.
    pub fn is_edge_flat(&self, h: HalfEdgeId) -> bool {
        match (self.foot(h), self.foot(h.next())) {
            (Some(a), Some(b)) => a.triangle == b.triangle,
            _ => false,
        }
    }

    /// Returns whether the face lies on one triangle.
    pub fn is_flat(&self, f: FaceId) -> bool {
        f.half_edges().into_iter().all(|h| self.is_edge_flat(h))
    }

    /// Returns whether the places of all corners of the face are known.
    pub fn is_known(&self, f: FaceId) -> bool {
        f.half_edges().into_iter().all(|h| self.foot(h).is_some())
    }
}

/// Clean triangles of each triangle of the surface.
struct Pieces {
    /// Source and clean triangle, sorted.
    pairs: Vec<(u32, u32)>,
}

impl Pieces {
    fn new(clean: &CleanSurface) -> Self {
        let mut pairs: Vec<_> = clean.source.iter().copied().zip(0..).collect();
        pairs.sort_unstable();
        Self { pairs }
    }

    /// Returns the point of the clean surface at a site, or `None` if there is none or the position is no point.
    fn foot(&self, clean: &CleanSurface, position: Vec3, site: SurfaceSite) -> Option<Foot> {
        if !position.is_finite() || !site.weights.is_finite() {
            return None;
        }
        let first = self.pairs.partition_point(|&(source, _)| source < site.triangle);
        let last = self.pairs.partition_point(|&(source, _)| source <= site.triangle);
        let corners = |t: u32| Some(clean.triangles.get(t as usize)?.map(|v| clean.positions[v as usize]));
        // Several triangles come of one source where slivers beside it were dissolved.
        let distance = |t: u32| corners(t).map_or(f32::MAX, |corners| distance_to_triangle(position, corners));
        let t = match self.pairs.get(first..last)? {
            &[(_, t)] => t,
            several => several.iter().map(|&(_, t)| t).min_by(|&s, &t| distance(s).total_cmp(&distance(t)))?,
        };
        let weights = own_weights(clean, t, site.weights)
            .map_or_else(|| corners(t).map(|[a, b, c]| nearest_weights(position, a, b, c)), Some)?;
        Some(Foot { triangle: FaceId(t), position, weights })
    }
}

/// Returns the weights of a clean triangle's corners, if these are the corners of its source in any order. Nothing is
/// rounded then, so a corner on an edge stays there.
fn own_weights(clean: &CleanSurface, t: u32, weights: Vec3) -> Option<Vec3> {
    let sites = clean.sites.get(t as usize)?;
    let axis = |k: usize| [Vec3::X, Vec3::Y, Vec3::Z].into_iter().position(|axis| axis == sites[k].weights);
    let [a, b, c] = [axis(0)?, axis(1)?, axis(2)?];
    Some(Vec3::new(weights[a], weights[b], weights[c]))
}
