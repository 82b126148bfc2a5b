//! What an exposure is cast for, and when that is no longer true.

use bevy::{
    ecs::entity::Entity,
    math::{Affine3A, Vec3},
};

use crate::stain::{
    Environment, Exposure,
    exposure::{Blocker, ExposedSurface},
};

/// Cosine of the angle by which rain and sun may turn, 1 degree.
const SAME_DIRECTION: f32 = 0.999_848;

/// What an exposure is cast for, in the film's space.
#[derive(Clone, Debug, Default)]
pub(crate) struct CastKey {
    /// Directions of rain and sun: unit vectors, or zero where there is none.
    falls: [Vec3; 2],
    /// What may stand in the way, by entity.
    pieces: Vec<KeyPiece>,
}

#[derive(Clone, Copy, Debug)]
struct KeyPiece {
    entity: Entity,
    /// Version of its mesh.
    version: u64,
    into: Affine3A,
}

/// A cast to be done.
#[derive(Clone, Debug)]
pub(crate) struct CastOrder {
    pub key: CastKey,
    /// One for each piece of the key.
    blockers: Vec<Blocker>,
}

/// Directions of rain and sun.
pub(super) fn falls(environment: &Environment) -> [Vec3; 2] {
    [environment.rain, environment.sun].map(Vec3::normalize_or_zero)
}

/// Whether `b` is the direction `a`, or near enough.
fn is_same_direction(a: Vec3, b: Vec3) -> bool {
    a == b || a.dot(b) >= SAME_DIRECTION
}

impl CastKey {
    /// Whether an exposure to whatever falls now was cast at all.
    pub fn covers(&self, falls: [Vec3; 2]) -> bool {
        self.falls.iter().zip(falls).all(|(&cast, now)| (cast == Vec3::ZERO) == (now == Vec3::ZERO))
    }

    /// Whether rain and sun fall as they did, or nearly.
    pub fn faces(&self, falls: [Vec3; 2]) -> bool {
        self.covers(falls) && self.falls.iter().zip(falls).all(|(&cast, now)| is_same_direction(cast, now))
    }

    /// Whether an exposure that was cast for this key holds for the key `now`, on a film within a sphere (its middle
    /// and radius) that may move by `tolerance` against what shelters it.
    pub fn holds(&self, now: &Self, sphere: (Vec3, f32), tolerance: f32) -> bool {
        self.faces(now.falls)
            && self.pieces.len() == now.pieces.len()
            && self.pieces.iter().zip(&now.pieces).all(|(cast, piece)| {
                cast.entity == piece.entity
                    && cast.version == piece.version
                    && (cast.into == piece.into || self.is_near(cast, piece, now, sphere, tolerance))
            })
    }

    /// Whether film and piece lie to each other as they did, and rain and sun to the piece.
    fn is_near(&self, cast: &KeyPiece, piece: &KeyPiece, now: &Self, sphere: (Vec3, f32), tolerance: f32) -> bool {
        // Where a point of the film is now, seen from the piece, as a place in the film as it was.
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
    /// A cast against nothing yet.
    pub fn new(environment: &Environment) -> Self {
        Self { key: CastKey { falls: falls(environment), pieces: Vec::new() }, blockers: Vec::new() }
    }

    /// Adds something that may stand in the way.
    pub fn push(&mut self, entity: Entity, version: u64, blocker: Blocker) {
        self.key.pieces.push(KeyPiece { entity, version, into: blocker.into });
        self.blockers.push(blocker);
    }

    /// Leaves out what cannot stand in the way of anything that falls on `surface`.
    pub fn cull(&mut self, surface: &ExposedSurface) {
        let falls = self.key.falls;
        let counts =
            |blocker: &Blocker| falls.iter().any(|&fall| fall != Vec3::ZERO && surface.may_meet(blocker, -fall));
        let kept: Vec<bool> = self.blockers.iter().map(counts).collect();
        let (mut pieces, mut blockers) = (kept.iter(), kept.iter());
        self.key.pieces.retain(|_| pieces.next() == Some(&true));
        self.blockers.retain(|_| blockers.next() == Some(&true));
    }

    /// Casts.
    pub fn cast(&self, surface: &ExposedSurface) -> Exposure {
        let [rain, sun] = self.key.falls;
        surface.cast(&self.blockers, rain, sun)
    }
}
