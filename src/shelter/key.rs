//! Defines the conditions of a cast, and decides when they have changed too much.

use std::sync::Arc;

use bevy::{
    ecs::entity::Entity,
    math::{Affine3A, Vec3},
};

use super::{ball::Ball, pieces::ShelterPieces};
use crate::{
    rest::Rest,
    stain::{
        Environment, Exposure,
        exposure::{Blocker, ExposedSurface},
    },
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
    /// Conditions of the cast. Its pieces are found by [`cull`](Self::cull).
    pub key: CastKey,
    /// Triangles of each piece of the key.
    blockers: Vec<Blocker>,
    /// Film in the world, and what stands there.
    around: Around,
}

/// Film in the world, and what stands there.
#[derive(Clone, Debug)]
pub(super) struct Around {
    /// Transform from the film's space to the world.
    pub place: Affine3A,
    /// Entity with the film's coating.
    pub root: Entity,
    /// Entities of the film's own meshes, which do not count.
    pub slots: Vec<Entity>,
    /// Meshes that shelter props.
    pub pieces: Arc<ShelterPieces>,
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
    /// Returns an order in which nothing stands in the way yet.
    pub(super) fn new(environment: &Environment, around: Around) -> Self {
        Self { key: CastKey { falls: falls(environment), pieces: Vec::new() }, blockers: Vec::new(), around }
    }

    /// Returns the order for a film whose zero lies at `origin` of the space that the order was made for.
    pub fn shifted(mut self, origin: Vec3) -> Self {
        self.around.place *= Affine3A::from_translation(origin);
        self
    }

    /// Finds the meshes that may stand in the way of rain or sun on a film within `sphere`, a centre and a radius in
    /// the film's space. Returns the number of meshes and groups of meshes that were looked at.
    pub fn cull(&mut self, sphere: (Vec3, f32)) -> usize {
        let Self { key, blockers, around } = self;
        let Around { place, root, slots, pieces } = around;
        // The film is in metres, and the world may have another unit.
        let radius = place.transform_vector3(Vec3::X * sphere.1).length();
        let film = Ball { center: place.transform_point3(sphere.0), radius };
        let up = |&fall: &Vec3| place.transform_vector3(-fall).normalize_or_zero();
        let ups: Vec<Vec3> = key.falls.iter().filter(|&&fall| fall != Vec3::ZERO).map(up).collect();
        let mut looked_at = 0;
        for piece in pieces.near(&film, &ups, &mut looked_at) {
            let Some(tree) = &piece.tree else { continue };
            let others = piece.root.is_some_and(|only| only != *root);
            if !others && !slots.contains(&piece.entity) {
                let into = piece.place.inverse() * *place;
                key.pieces.push(KeyPiece { entity: piece.entity, version: piece.version, into });
                blockers.push(Blocker { tree: tree.clone(), into });
            }
        }
        // Other casts may change the pieces without a copy now.
        *pieces = Arc::default();
        looked_at
    }

    /// Casts the rays, with rests in between, and returns the exposure of each vertex.
    pub async fn cast(&self, surface: &ExposedSurface, rest: &mut impl Rest) -> Exposure {
        let [rain, sun] = self.key.falls;
        surface.cast_in_pieces(&self.blockers, rain, sun, rest).await
    }
}
