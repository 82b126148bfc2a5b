//! Finds the films that something which moved may shelter.

use bevy::{
    ecs::{
        entity::{Entity, EntityHashMap},
        resource::Resource,
    },
    math::Vec3,
};

use super::{ball::Ball, ball_tree::BallTree};

/// Films that are sheltered by what stands around them, in a tree of balls.
#[derive(Resource, Debug, Default)]
pub(crate) struct ShelteredFilms {
    entities: Vec<Entity>,
    items: EntityHashMap<usize>,
    tree: BallTree,
    /// Whether films have come, gone or moved since, without being followed.
    pub(super) stale: bool,
    /// Number of balls that were looked at in this frame.
    pub(super) looked_at: usize,
}

impl ShelteredFilms {
    /// Takes over all films afresh.
    pub(super) fn renew(&mut self, films: impl Iterator<Item = (Entity, Ball)>) {
        let (entities, balls): (Vec<Entity>, Vec<Option<Ball>>) =
            films.map(|(entity, ball)| (entity, Some(ball))).unzip();
        self.items = entities.iter().enumerate().map(|(item, &entity)| (entity, item)).collect();
        self.tree = BallTree::new(balls);
        self.entities = entities;
        self.stale = false;
    }

    /// Moves a film.
    pub(super) fn set(&mut self, film: Entity, ball: Ball) {
        if let Some(&item) = self.items.get(&film) {
            self.tree.set(item, ball);
        }
    }

    /// Calls `found` with each film from which `piece` may hold off rays towards any of `ups`.
    pub(super) fn touched_by(&mut self, piece: &Ball, ups: &[Vec3], mut found: impl FnMut(Entity)) {
        let wanted = |film: &Ball| ups.iter().any(|&up| piece.may_shelter(film, up));
        self.looked_at += self.tree.find(wanted, |item| {
            if let Some(&film) = self.entities.get(item) {
                found(film);
            }
        });
    }
}
