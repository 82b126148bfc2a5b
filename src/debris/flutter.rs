//! Moves flakes: they fall, tumble, come to rest and shrink away.

use bevy::{
    ecs::{
        entity::Entity,
        system::{Commands, Query, Res},
    },
    math::{Quat, Vec3},
    time::Time,
    transform::components::Transform,
};

use crate::api::{
    clock::CoatingGravity,
    debris::{CoatingDebris, Flake},
    unit::CoatingUnit,
};

/// Gravity, in metres a second squared.
const GRAVITY: f32 = 9.81;
/// Speed at which air carries a flake of 5 cm, in metres a second; smaller ones fall more slowly.
const TERMINAL: f32 = 2.2;
/// Size of that flake, in metres.
const TYPICAL: f32 = 0.05;
/// Time in which a flake shrinks away at its end, in seconds.
const SHRINKING: f32 = 1.0;

/// Moves all flakes that the plugin is to move.
pub(super) fn flutter(
    mut commands: Commands,
    mut flakes: Query<(Entity, &mut Flake, &mut Transform)>,
    debris: Query<&CoatingDebris>,
    time: Res<Time>,
    gravity: Res<CoatingGravity>,
    unit: Res<CoatingUnit>,
) {
    let (dt, down) = (time.delta_secs(), gravity.0.normalize_or(Vec3::NEG_Y));
    if dt <= 0.0 {
        return;
    }
    for (entity, mut flake, mut transform) in &mut flakes {
        // A flake outlives its prop, and goes on as it would by default.
        let debris = debris.get(flake.root).copied().unwrap_or_default();
        if !debris.flutters {
            continue;
        }
        flake.time += dt;
        let left = debris.lifetime - flake.time;
        if !(left > 0.0) {
            commands.entity(entity).try_despawn();
            continue;
        }
        transform.scale = Vec3::splat((left / SHRINKING).min(1.0));
        let metres = if unit.metres > 0.0 { unit.metres } else { 1.0 };
        let terminal = TERMINAL * (flake.size * metres / TYPICAL).clamp(0.1, 4.0).sqrt() / metres;
        // Drag that grows with the speed and balances gravity at the terminal one; solved for the whole frame.
        let drag = GRAVITY / metres / terminal;
        let pull = down * (GRAVITY / metres);
        flake.velocity = (flake.velocity + pull * dt) / (1.0 + drag * dt);
        let height = -transform.translation.dot(down);
        let next = transform.translation + flake.velocity * dt;
        let lands = debris.floor.is_some_and(|floor| -next.dot(down) <= floor && height > floor - flake.size);
        if lands {
            let floor = debris.floor.unwrap_or_default();
            // On the ground: no more turning, no more moving.
            transform.translation = next + down * (-next.dot(down) - floor);
            (flake.velocity, flake.spin) = (Vec3::ZERO, Vec3::ZERO);
            continue;
        }
        transform.translation = next;
        let turn = flake.spin * dt;
        transform.rotation = (Quat::from_scaled_axis(turn) * transform.rotation).normalize();
    }
}
