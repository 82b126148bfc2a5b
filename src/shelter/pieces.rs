//! Keeps the meshes that shelter props in their places, and finds those that may shelter a film.

use std::sync::Arc;

use bevy::{
    asset::AssetId,
    ecs::entity::Entity,
    math::{Affine3A, Vec3},
    mesh::Mesh,
};

use super::{ball::Ball, ball_tree::BallTree};
use crate::stain::exposure::TriangleTree;

/// Mesh in its place.
#[derive(Clone, Debug)]
pub(super) struct Piece {
    pub entity: Entity,
    /// Entity of the only coating whose films it shelters; `None` if it shelters all films.
    pub root: Option<Entity>,
    pub mesh: AssetId<Mesh>,
    pub place: Affine3A,
    /// Version of the mesh; 0 while it is being loaded.
    pub version: u64,
    /// Triangles of the mesh; `None` while they are being sorted, or if they cannot be read.
    pub tree: Option<Arc<TriangleTree>>,
}

impl Piece {
    /// Returns a ball around the piece, if its triangles are known.
    pub fn ball(&self) -> Option<Ball> {
        Ball::around(self.tree.as_ref()?.bounds()?, &self.place)
    }

    /// Returns whether the piece stands as `other` does, with the same triangles.
    pub fn stands_as(&self, other: &Self) -> bool {
        self.place == other.place && self.version == other.version && self.tree.is_some() == other.tree.is_some()
    }
}

/// Meshes that shelter props, and a tree of balls around them.
#[derive(Clone, Debug, Default)]
pub(crate) struct ShelterPieces {
    /// Meshes in their places, sorted by entity and root.
    pieces: Vec<Piece>,
    tree: BallTree,
}

impl ShelterPieces {
    /// Returns the pieces, which must be sorted by entity and root.
    pub fn new(pieces: Vec<Piece>) -> Self {
        let tree = BallTree::new(pieces.iter().map(Piece::ball));
        Self { pieces, tree }
    }

    /// Returns all pieces, sorted by entity and root.
    pub fn all(&self) -> &[Piece] {
        &self.pieces
    }

    /// Returns the numbers of the pieces of `entity`.
    pub fn of_entity(&self, entity: Entity) -> std::ops::Range<usize> {
        let first = self.pieces.partition_point(|piece| piece.entity < entity);
        let count = self.pieces[first..].iter().take_while(|piece| piece.entity == entity).count();
        first..first + count
    }

    /// Moves a piece, and returns the balls around it before and after.
    pub fn set_place(&mut self, index: usize, place: Affine3A) -> [Option<Ball>; 2] {
        let Some(piece) = self.pieces.get_mut(index) else { return [None; 2] };
        let before = piece.ball();
        piece.place = place;
        let after = piece.ball();
        match (before, after) {
            (Some(_), Some(ball)) => self.tree.set(index, ball),
            (None, None) => {}
            _ => self.tree = BallTree::new(self.pieces.iter().map(Piece::ball)),
        }
        [before, after]
    }

    /// Returns the pieces that may hold off rays towards any of `ups` from `film`, sorted by entity and root, and adds
    /// the number of balls that were looked at to `looked_at`.
    pub fn near(&self, film: &Ball, ups: &[Vec3], looked_at: &mut usize) -> Vec<&Piece> {
        let mut found = Vec::new();
        let wanted = |ball: &Ball| ups.iter().any(|&up| ball.may_shelter(film, up));
        *looked_at += self.tree.find(wanted, |index| found.push(index));
        found.sort_unstable();
        found.into_iter().filter_map(|index| self.pieces.get(index)).collect()
    }
}
