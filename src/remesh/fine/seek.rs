//! Seeks points of the surface from the film.

use bevy_math::Vec3;

use super::{
    corners::Corners,
    ground::FineGround,
    lines::{LinePoint, Lines},
    shoot::shoot,
};
use crate::{
    film::{FaceId, HalfEdgeId},
    remesh::{
        project::{Foot, project},
        sites::site,
    },
    rest::Rest,
    surface::{CleanSurface, Surface, SurfaceSite},
};

/// Largest distance of a point of the surface from where it is expected, in edges of the face.
const FAR: f32 = 0.5;
/// Distance up to which a point stays where it is expected, in edges of the face: so flat faces stay flat to the bit.
const NEAR: f32 = 1e-5;

/// Clean surface on which points are sought, with the lines that the film follows.
pub struct Seeker<'a> {
    clean: &'a CleanSurface,
    /// None if all faces lie on single triangles, so that nothing need be sought.
    ground: Option<(FineGround, Lines)>,
}

/// Point that was sought.
pub struct Found {
    pub position: Vec3,
    pub foot: Foot,
}

impl<'a> Seeker<'a> {
    pub async fn new(surface: &Surface, clean: &'a CleanSurface, corners: &Corners<'_>, rest: &mut impl Rest) -> Self {
        if corners.faces().all(|f| corners.is_flat(f) || !corners.is_known(f)) {
            return Self { clean, ground: None };
        }
        let mut ground = FineGround::new(surface, clean, rest).await;
        let lines = Lines::new(&ground, corners, rest).await;
        lines.raise_walls(&mut ground);
        Self { clean, ground: Some((ground, lines)) }
    }

    /// Returns the point of the surface along `normal` from `expected`, or else the nearest one. The walks begin at
    /// `starts`. The position is the expected one if the surface is too far away in a face of this size.
    pub fn seek(&self, expected: Vec3, normal: Vec3, starts: &[Foot], size: f32) -> Option<Found> {
        let (ground, _) = self.ground.as_ref()?;
        if !expected.is_finite() {
            return None;
        }
        let fits = |foot: &Foot| foot.position.distance(expected) <= FAR * size;
        let shot = starts.iter().find_map(|start| shoot(ground, expected, normal, start.triangle).filter(fits));
        let foot = match shot {
            Some(foot) => foot,
            None => self.nearest(expected, starts, size)?,
        };
        Some(Found { position: settle(expected, &foot, size), foot })
    }

    /// Returns the nearest point of the surface to which a walk from one of `starts` leads.
    ///
    /// The triangle under a corner may lie behind the end of a seam: a walk from there ends at the seam.
    pub fn nearest(&self, p: Vec3, starts: &[Foot], size: f32) -> Option<Foot> {
        let (ground, _) = self.ground.as_ref().filter(|_| p.is_finite())?;
        let mut best: Option<(f32, Foot)> = None;
        for start in starts {
            let foot = project(ground, p, start.triangle);
            let distance = foot.position.distance(p);
            if best.is_none_or(|(least, _)| distance < least) {
                best = Some((distance, foot));
            }
            if distance <= NEAR * size {
                break;
            }
        }
        best.map(|(_, foot)| foot)
    }

    /// Returns the point at a share of the line along which a leading half-edge runs, if it follows one.
    pub fn on_line(&self, h: HalfEdgeId, share: f32) -> Option<LinePoint> {
        let (ground, lines) = self.ground.as_ref()?;
        lines.point(ground, h, share)
    }

    /// Returns whether the edge of a leading half-edge runs along a line.
    pub fn is_followed(&self, h: HalfEdgeId) -> bool {
        self.ground.as_ref().is_some_and(|(_, lines)| lines.is_followed(h))
    }

    /// Returns whether a line might divide the faces at the edge, unknown to us.
    pub fn is_doubtful(&self, corners: &Corners, h: HalfEdgeId) -> bool {
        self.ground.as_ref().is_some_and(|(_, lines)| lines.touches(corners, h))
    }

    pub fn site(&self, foot: &Foot) -> SurfaceSite {
        site(self.clean, foot)
    }
}

/// Returns the position of a point whose place was expected at `expected`.
pub fn settle(expected: Vec3, foot: &Foot, size: f32) -> Vec3 {
    let distance = foot.position.distance(expected);
    // Also false where the distance is no number.
    if distance > NEAR * size && distance <= FAR * size { foot.position } else { expected }
}

/// Returns the normal of the film along an edge: that of its face where it bounds a side, and else the mean of its two
/// faces.
pub fn edge_normal(seeker: &Seeker, corners: &Corners, h: HalfEdgeId) -> Vec3 {
    let own = corners.normal(h.face());
    let Some(t) = corners.twin(h).filter(|&t| !seeker.is_followed(h.min(t))) else { return own };
    (own + corners.normal(t.face())).try_normalize().unwrap_or(own)
}

/// Returns the feet of the face's corners in the order of their weights, greatest first.
pub fn starts(corners: &Corners, f: FaceId, weights: Vec3) -> Vec<Foot> {
    let mut order = [0, 1, 2];
    order.sort_by(|&i: &usize, &j: &usize| weights[j].total_cmp(&weights[i]));
    order.into_iter().filter_map(|k| corners.foot(f.half_edges()[k])).collect()
}
