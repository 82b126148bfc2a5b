//! The props: toys that are scaled to the sizes of the things they stand for.

use crate::cli::{Measure, Options};
use crate::common_scene::paint::{Loading, Paint, Repaint};
use bevy::gltf::GltfAssetLabel;
use bevy::prelude::*;
use bevy::world_serialization::WorldInstanceReady;

pub struct PropsPlugin;

impl Plugin for PropsPlugin {
    fn build(&self, app: &mut App) {
        app.add_systems(Startup, spawn).add_systems(Update, change_rules);
    }
}

/// A model, how it stands, and the node whose paint ages.
#[derive(Component, Clone, Copy, Debug)]
pub struct Prop {
    /// Of its files.
    pub name: &'static str,
    pub file: &'static str,
    painted: &'static str,
    /// From the toy's size to its own.
    pub scale: f32,
    place: Vec3,
    /// Degrees around the vertical.
    turn: f32,
    /// Added to the seed of the command line, that no two props crack alike.
    pub seed: u64,
}

const CAR: &str = "props/prop_car.glb";
/// Height of the car's zero over the ground, in its own size.
const AXLE: f32 = 0.061;
const CAR_SCALE: f32 = 4.6;
const PEDAL_CAR_SCALE: f32 = 1.3;

/// From the largest to the smallest.
pub const PROPS: [Prop; 5] = [
    Prop {
        name: "car",
        file: CAR,
        painted: "car_hatchback",
        scale: CAR_SCALE,
        place: Vec3::new(1.0, AXLE * CAR_SCALE, -1.0),
        turn: 62.0,
        seed: 0,
    },
    Prop {
        name: "dumpster",
        file: "props/prop_dumpster.glb",
        painted: "dumpster",
        scale: 3.8,
        place: Vec3::new(-1.75, 0.0, -2.2),
        turn: 18.0,
        seed: 2000,
    },
    Prop {
        name: "lantern",
        file: "props/prop_lantern.glb",
        painted: "lantern_standing",
        scale: 1.7,
        place: Vec3::new(-2.3, 0.0, 0.55),
        turn: 24.0,
        seed: 1000,
    },
    Prop {
        name: "hydrant",
        file: "props/prop_firehydrant.glb",
        painted: "firehydrant",
        scale: 4.0,
        place: Vec3::new(-0.95, 0.0, 0.95),
        turn: 25.0,
        seed: 3000,
    },
    Prop {
        name: "pedal_car",
        file: CAR,
        painted: "car_hatchback",
        scale: PEDAL_CAR_SCALE,
        place: Vec3::new(0.35, AXLE * PEDAL_CAR_SCALE, 1.45),
        turn: 62.0,
        seed: 4000,
    },
];

impl Prop {
    fn transform(&self) -> Transform {
        Transform::from_translation(self.place)
            .with_rotation(Quat::from_rotation_y(self.turn.to_radians()))
            .with_scale(Vec3::splat(self.scale))
    }
}

fn spawn(mut commands: Commands, assets: Res<AssetServer>, mut loading: ResMut<Loading>) {
    for prop in PROPS {
        let scene = assets.load(GltfAssetLabel::Scene(0).from_asset(prop.file));
        loading.props += 1;
        loading.files.push(scene.clone().untyped());
        commands.spawn((WorldAssetRoot(scene), prop.transform(), prop)).observe(dress);
    }
}

/// Paints the node of a model that has arrived.
fn dress(
    ready: On<WorldInstanceReady>,
    mut commands: Commands,
    mut loading: ResMut<Loading>,
    options: Res<Options>,
    props: Query<&Prop>,
    children: Query<&Children>,
    meshes: Query<&ChildOf, With<Mesh3d>>,
    names: Query<&Name>,
) {
    let Ok(prop) = props.get(ready.entity) else { return };
    for entity in children.iter_descendants(ready.entity) {
        // A mesh hangs below the node that carries its name.
        let Ok(name) = meshes.get(entity).and_then(|parent| names.get(parent.parent())) else { continue };
        if name.as_str() == prop.painted {
            commands.entity(entity).insert(Paint(options.coating(options.rules, prop.seed)));
        }
    }
    loading.loaded += 1;
}

/// On M, everything is painted again, by the other rules.
fn change_rules(
    keyboard: Option<Res<ButtonInput<KeyCode>>>,
    mut commands: Commands,
    mut options: ResMut<Options>,
    mut painted: Query<(Entity, &mut Paint)>,
    parents: Query<&ChildOf>,
    props: Query<&Prop>,
) {
    if !keyboard.is_some_and(|keyboard| keyboard.just_pressed(KeyCode::KeyM)) {
        return;
    }
    options.rules = match options.rules {
        Measure::Grain => Measure::Paper,
        Measure::Paper => Measure::Grain,
    };
    for (entity, mut paint) in &mut painted {
        if let Some(prop) = parents.iter_ancestors(entity).find_map(|parent| props.get(parent).ok()) {
            paint.0 = options.coating(options.rules, prop.seed);
        }
    }
    commands.trigger(Repaint);
}
