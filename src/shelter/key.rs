//! Defines the conditions of a cast, and decides when they have changed too much.

use bevy::{
    ecs::entity::Entity,
    math::{Affine3A, Vec3},
};

use crate::stain::{
    Environment, Exposure,
    exposure::{Blocker, ExposedSurface},
};

/// Cosine of 1 degree, the angle by which rain and sun may turn before rays are cast again.
const SAME_DIRECTION: f32 = 0.999_848;

/// Conditions for which an exposure was cast, in the film's space.
#[derive(Clone, Debug, Default)]
pub(crate) struct CastKey {
    /// Directions of rain and sun: unit vectors, or zero where there is none.
    falls: [Vec3; 2],
    /// Meshes that may stand in the way, sorted by entity.
    pieces: Vec<KeyPiece>,
}

/// Mesh that may stand in the way, and where.
#[derive(Clone, Copy, Debug)]
struct KeyPiece {
    entity: Entity,
    /// Version of its mesh.
    version: u64,
    /// Transform from the film's space into the mesh's.
    into: Affine3A,
}

/// Order for a cast: its conditions and the triangles that may stand in the way.
#[derive(Clone, Debug)]
pub(crate) struct CastOrder {
    /// Conditions of the cast.
    pub key: CastKey,
    /// Triangles of each piece of the key.
    blockers: Vec<Blocker>,
}

/// Returns the directions of rain and sun as unit vectors, or zero where there is none.
pub(super) fn falls(environment: &Environment) -> [Vec3; 2] {
    [environment.rain, environment.sun].map(Vec3::normalize_or_zero)
}

/// Returns whether `a` and `b` are the same direction, to within [`SAME_DIRECTION`].
fn is_same_direction(a: Vec3, b: Vec3) -> bool {
    a == b || a.dot(b) >= SAME_DIRECTION
}

impl CastKey {
    /// Returns whether rays were cast for rain if it rains now, and for sun if it shines now, and for nothing else.
    pub fn covers(&self, falls: [Vec3; 2]) -> bool {
        self.falls.iter().zip(falls).all(|(&cast, now)| (cast == Vec3::ZERO) == (now == Vec3::ZERO))
    }

    /// Returns whether rain and sun have nearly the directions of the cast.
    pub fn faces(&self, falls: [Vec3; 2]) -> bool {
        self.covers(falls) && self.falls.iter().zip(falls).all(|(&cast, now)| is_same_direction(cast, now))
    }

    /// Returns whether an exposure that was cast for this key still holds under the key `now`.
    ///
    /// `sphere` is the centre and radius of the film, and `tolerance` the distance by which it may have moved against
    /// its shelters, in metres.
    pub fn holds(&self, now: &Self, sphere: (Vec3, f32), tolerance: f32) -> bool {
        self.faces(now.falls)
            && self.pieces.len() == now.pieces.len()
            && self.pieces.iter().zip(&now.pieces).all(|(cast, piece)| {
                cast.entity == piece.entity
                    && cast.version == piece.version
                    && (cast.into == piece.into || self.is_near(cast, piece, now, sphere, tolerance))
            })
    }

    /// Returns whether the film lies nearly as it did relative to `piece`, and rain and sun do, too.
    fn is_near(&self, cast: &KeyPiece, piece: &KeyPiece, now: &Self, sphere: (Vec3, f32), tolerance: f32) -> bool {
        // Maps a point of the film now to the point of the film at the cast that had the same place relative to the
        // piece.
        let change = cast.into.inverse() * piece.into;
        let (center, radius) = sphere;
        let corners = [Vec3::ZERO, Vec3::X * radius, Vec3::Y * radius, Vec3::Z * radius].map(|corner| center + corner);
        corners.iter().all(|&p| change.transform_point3(p).distance(p) <= tolerance)
            && self
                .falls
                .iter()
                .zip(now.falls)
                .all(|(&cast, now)| is_same_direction(cast, change.transform_vector3(now).normalize_or_zero()))
    }
}

impl CastOrder {
    /// Returns an order without any meshes.
    pub fn new(environment: &Environment) -> Self {
        Self { key: CastKey { falls: falls(environment), pieces: Vec::new() }, blockers: Vec::new() }
    }

    /// Adds a mesh that may stand in the way.
    pub fn push(&mut self, entity: Entity, version: u64, blocker: Blocker) {
        self.key.pieces.push(KeyPiece { entity, version, into: blocker.into });
        self.blockers.push(blocker);
    }

    /// Returns the order for a film whose zero lies at `origin` of the space that the order was made for.
    pub fn shifted(mut self, origin: Vec3) -> Self {
        let shift = Affine3A::from_translation(origin);
        if origin != Vec3::ZERO {
            self.key.pieces.iter_mut().for_each(|piece| piece.into *= shift);
            self.blockers.iter_mut().for_each(|blocker| blocker.into *= shift);
        }
        self
    }

    /// Removes the meshes that cannot stand in the way of rain or sun on `surface`.
    pub fn cull(&mut self, surface: &ExposedSurface) {
        let falls = self.key.falls;
        let counts =
            |blocker: &Blocker| falls.iter().any(|&fall| fall != Vec3::ZERO && surface.may_meet(blocker, -fall));
        let kept: Vec<bool> = self.blockers.iter().map(counts).collect();
        let (mut pieces, mut blockers) = (kept.iter(), kept.iter());
        self.key.pieces.retain(|_| pieces.next() == Some(&true));
        self.blockers.retain(|_| blockers.next() == Some(&true));
    }

    /// Casts the rays and returns the exposure of each vertex.
    pub fn cast(&self, surface: &ExposedSurface) -> Exposure {
        let [rain, sun] = self.key.falls;
        surface.cast(&self.blockers, rain, sun)
    }
}
