//! Says on which sides of a question the vertices of a film lie, to pass over the faces that lie beside it.
//!
//! A question about a place meets few of a film's faces, and the exact test of a face is dear. So one pass over the
//! vertices, which are half as many and lie in a row, notes for each of them beyond which planes around the place it
//! lies. A face whose corners all lie beyond the same plane cannot be met. Nothing is kept between two questions.

use bevy_math::{Mat3A, Vec3, Vec3A};

use super::view::{Face, FilmView};

/// Share of the greatest distance from the origin of a ray by which a face has to miss the ray. A ray meets a face up
/// to 1e-5 of its edges beside it ([`triangle::hit`](super::triangle::hit)), and an edge is at most twice that distance
/// long; rounding is a hundredth of it.
const MISS: f32 = 1e-4;

/// Bits of a vertex as it is now. The higher byte has the same bits for its place at rest.
const NOW: u16 = 0xff;

/// Planes beyond which each vertex lies: see [`FilmView::sides_of_box`] and [`FilmView::sides_of_ray`].
pub(super) struct Sides(Vec<u16>);

/// Face that may be met.
pub(super) struct NearFace {
    pub face: Face,
    /// Whether it may be met where its corners are now.
    pub now: bool,
    /// Whether it may be met where its corners were at rest.
    pub rest: bool,
}

impl FilmView<'_> {
    /// Returns the sides of the cube around `centre` with half the width `square.sqrt()`. A face beside it is farther
    /// from the centre than that, also by rounded numbers: the difference along one axis is, and all roundings rise
    /// with what is rounded.
    pub(super) fn sides_of_box(&self, centre: Vec3, square: f32) -> Sides {
        let (centre, square) = (Vec3A::from(centre), Vec3A::splat(square));
        let side = |p: Vec3| {
            let way = Vec3A::from(p) - centre;
            let (far, below) = ((way * way).cmpgt(square).bitmask(), way.is_negative_bitmask());
            ((far & !below) | ((far & below) << 3)) as u16
        };
        // Only removed faces are asked where they were at rest.
        let rest = self.mesh.topology.removed_face_count() > 0;
        self.sides(side, rest)
    }

    /// Returns the sides of the ray from `origin` along the unit vector `direction`, in two planes through it.
    ///
    /// A face that is seen edge-on to the last bit may be called met by the rounding of
    /// [`triangle::hit`](super::triangle::hit) wherever it lies. It is not, if it lies beside the ray.
    pub(super) fn sides_of_ray(&self, origin: Vec3, direction: Vec3) -> Sides {
        let origin = Vec3A::from(origin);
        let geometry = &self.mesh.geometry;
        let farthest = |positions: &[Vec3]| {
            positions.iter().fold(Vec3A::ZERO, |most, &p| most.max((Vec3A::from(p) - origin).abs())).element_sum()
        };
        let miss = Vec3A::splat(MISS * farthest(&geometry.positions).max(farthest(&geometry.rest_positions)));
        let (one, other) = direction.any_orthonormal_pair();
        // The third row is zero, so that it never says anything.
        let across = Mat3A::from_cols(one.into(), other.into(), Vec3A::ZERO).transpose();
        let side = |p: Vec3| {
            let way = across * (Vec3A::from(p) - origin);
            (way.cmpgt(miss).bitmask() | (way.cmplt(-miss).bitmask() << 3)) as u16
        };
        self.sides(side, true)
    }

    /// Returns what `side` says of each vertex now, and at `rest` if that is asked.
    fn sides(&self, side: impl Fn(Vec3) -> u16, rest: bool) -> Sides {
        let geometry = &self.mesh.geometry;
        let now = geometry.positions.iter();
        if rest {
            let both = now.zip(&geometry.rest_positions);
            Sides(both.map(|(&now, &rest)| side(now) | (side(rest) << 8)).collect())
        } else {
            Sides(now.map(|&now| side(now) | !NOW).collect())
        }
    }

    /// Returns the faces that do not lie beside the question, now or at rest, in ascending order.
    #[inline]
    pub(super) fn faces_near<'b>(&'b self, sides: &'b Sides) -> impl Iterator<Item = NearFace> + use<'b> {
        self.faces().filter_map(|face| {
            let [a, b, c] = face.corners.map(|v| sides.0[v.index()]);
            let beside = a & b & c;
            let (now, rest) = (beside & NOW == 0, beside & !NOW == 0);
            (now || rest).then_some(NearFace { face, now, rest })
        })
    }

    /// Returns the corners of the faces that do not lie beside the question where they are: now for film, and at rest
    /// for removed faces.
    #[inline]
    pub(super) fn places_near<'b>(&'b self, sides: &'b Sides) -> impl Iterator<Item = (Face, [Vec3; 3])> + use<'b> {
        self.faces_near(sides).filter_map(|NearFace { face, now, rest }| {
            let met = if face.live { now } else { rest };
            met.then(|| (face, if face.live { self.now(face.corners) } else { self.at_rest(face.corners) }))
        })
    }
}
