//! Checks that trees of balls find what a search through all would, and how much they look at.

use std::sync::Arc;

use bevy::{
    asset::AssetId,
    ecs::entity::Entity,
    math::{Affine3A, Quat, Vec3},
};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::{
    ball::Ball,
    ball_tree::BallTree,
    films::ShelteredFilms,
    pieces::{Piece, ShelterPieces},
};
use crate::stain::exposure::TriangleTree;

fn random_ball(rng: &mut ChaCha8Rng, extent: f32) -> Ball {
    let center = Vec3::new(rng.random::<f32>(), 0.2 * rng.random::<f32>(), rng.random::<f32>()) * extent;
    Ball { center, radius: 0.1 + rng.random::<f32>() }
}

#[test]
fn a_tree_finds_what_a_search_through_all_finds_also_after_movements() {
    let mut rng = ChaCha8Rng::seed_from_u64(5);
    let mut balls: Vec<Ball> = (0..300).map(|_| random_ball(&mut rng, 60.0)).collect();
    let mut tree = BallTree::new(balls.iter().copied().map(Some));
    for round in 0..1000 {
        let item = rng.random_range(0..balls.len());
        balls[item] = random_ball(&mut rng, 60.0);
        tree.set(item, balls[item]);
        let film = random_ball(&mut rng, 60.0);
        let [x, y, z]: [f32; 3] = rng.random();
        let up = Vec3::new(x - 0.5, y, z - 0.5).normalize_or(Vec3::Y);
        let mut found = Vec::new();
        tree.find(|ball| ball.may_shelter(&film, up), |item| found.push(item));
        found.sort_unstable();
        let all: Vec<usize> = (0..balls.len()).filter(|&item| balls[item].may_shelter(&film, up)).collect();
        assert_eq!(found, all, "round {round}");
        // And the other way round: what may be sheltered.
        let mut found = Vec::new();
        tree.find(|ball| film.may_shelter(ball, up), |item| found.push(item));
        found.sort_unstable();
        let all: Vec<usize> = (0..balls.len()).filter(|&item| film.may_shelter(&balls[item], up)).collect();
        assert_eq!(found, all, "round {round}");
    }
}

#[test]
fn items_without_a_ball_are_never_found() {
    let ball = Ball { center: Vec3::ZERO, radius: 1.0 };
    let broken = Ball { center: Vec3::NAN, radius: 1.0 };
    let tree = BallTree::new([None, Some(ball), Some(broken)]);
    let mut found = Vec::new();
    tree.find(|_| true, |item| found.push(item));
    assert_eq!(found, [1]);
    assert_eq!(BallTree::default().find(|_| true, |_| {}), 0);
    assert_eq!(Ball::around((Vec3::ZERO, Vec3::ONE), &Affine3A::from_scale(Vec3::ZERO)), None);
}

/// A piece of one triangle, about a metre wide.
fn piece(entity: Entity, at: Vec3) -> Piece {
    let tree = TriangleTree::new([[Vec3::ZERO, Vec3::X, Vec3::Z]]);
    let place = Affine3A::from_rotation_translation(Quat::IDENTITY, at);
    Piece { entity, root: None, mesh: AssetId::invalid(), place, version: 1, tree: Some(Arc::new(tree)) }
}

/// Look-ups of a frame in which one of `side` squared roofs, each a metre above a film, moves by a little: those of the
/// films that may be below it, and those of the shelters that may be above these.
fn lookups_of_a_movement(side: u32) -> usize {
    let at = |i: u32| Vec3::new((i % side) as f32, 0.0, (i / side) as f32) * 4.0;
    let entity = |i: u32| Entity::from_raw_u32(i).expect("an entity");
    let count = side * side;
    let mut pieces = ShelterPieces::new((0..count).map(|i| piece(entity(i), at(i) + Vec3::Y)).collect());
    let ball = |i: u32| Ball { center: at(i), radius: 0.7 };
    let mut films = ShelteredFilms::default();
    films.renew((0..count).map(|i| (entity(i), ball(i))));
    let moved = count / 2 + side / 2;
    let place = Affine3A::from_translation(at(moved) + Vec3::new(0.1, 1.0, 0.0));
    let mut touched = Vec::new();
    for ball in pieces.set_place(moved as usize, place).into_iter().flatten() {
        films.touched_by(&ball, &[Vec3::Y], |film| touched.push(film));
    }
    touched.sort_unstable();
    touched.dedup();
    assert!(touched.contains(&entity(moved)) && touched.len() < 10, "{touched:?}");
    let mut looked_at = films.looked_at;
    for film in touched {
        let near = pieces.near(&ball(film.index_u32()), &[Vec3::Y], &mut looked_at);
        assert!(near.iter().any(|piece| piece.entity == film) && near.len() < 10);
    }
    looked_at
}

#[test]
fn what_a_movement_costs_does_not_grow_with_what_is_far_away() {
    let [few, many] = [10, 32].map(lookups_of_a_movement);
    println!("look-ups when one of 100 shelters moves: {few}, of 1,024: {many}");
    assert!(many < 250, "{many} look-ups, not a million");
    assert!(many < 3 * few, "{few} for 100 films, {many} for 1,024");
}
