//! What falls off the props lies on the ground below: each [`PieceFallen`] leaves a curled flake.

use crate::common_scene::paint::Repaint;
use crate::scene::{FAR_KERB, KERB, ROAD};
use bevy::asset::RenderAssetUsages;
use bevy::light::NotShadowCaster;
use bevy::mesh::{Indices, PrimitiveTopology};
use bevy::prelude::*;
use bevy_coating::prelude::*;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

/// The oldest make room for new ones.
const MOST: usize = 600;

/// Colour of the flakes that come off a painted mesh.
#[derive(Component, Clone, Copy, Debug)]
pub struct FlakeColour(pub Color);

#[derive(Resource)]
struct Litter {
    mesh: Handle<Mesh>,
    dice: ChaCha8Rng,
    lying: std::collections::VecDeque<Entity>,
}

pub struct DebrisPlugin;

impl Plugin for DebrisPlugin {
    fn build(&self, app: &mut App) {
        app.add_systems(Startup, prepare).add_systems(Update, litter).add_observer(sweep);
    }
}

fn prepare(mut commands: Commands, mut meshes: ResMut<Assets<Mesh>>) {
    let mesh = meshes.add(curled());
    commands.insert_resource(Litter { mesh, dice: ChaCha8Rng::seed_from_u64(3), lying: default() });
}

/// A ragged patch about one unit wide, bent upwards at two sides, open to both.
fn curled() -> Mesh {
    const OUTLINE: [(f32, f32); 7] =
        [(0.5, 0.1), (0.3, 0.45), (-0.1, 0.5), (-0.5, 0.25), (-0.4, -0.2), (0.0, -0.5), (0.4, -0.3)];
    let bend = |x: f32, z: f32| 0.9 * x * x + 0.2 * z * z;
    let normal = |x: f32, z: f32| Vec3::new(-1.8 * x, 1.0, -0.4 * z).normalize().to_array();
    let points = std::iter::once((0.0, 0.0)).chain(OUTLINE);
    let (positions, normals): (Vec<_>, Vec<_>) = points.map(|(x, z)| ([x, bend(x, z), z], normal(x, z))).unzip();
    let count = OUTLINE.len() as u16;
    let indices = (0..count).flat_map(|i| [0, 1 + (i + 1) % count, 1 + i]).collect();
    Mesh::new(PrimitiveTopology::TriangleList, RenderAssetUsages::RENDER_WORLD)
        .with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, positions)
        .with_inserted_attribute(Mesh::ATTRIBUTE_NORMAL, normals)
        .with_inserted_indices(Indices::U16(indices))
}

fn litter(
    mut commands: Commands,
    mut fallen: MessageReader<PieceFallen>,
    mut litter: ResMut<Litter>,
    mut materials: ResMut<Assets<StandardMaterial>>,
    colours: Query<&FlakeColour>,
    mut paints: Local<Vec<(Color, Handle<StandardMaterial>)>>,
) {
    for piece in fallen.read() {
        let Ok(FlakeColour(colour)) = colours.get(piece.entity) else { continue };
        let material = match paints.iter().find(|(known, _)| known == colour) {
            Some((_, material)) => material.clone(),
            None => {
                let material = materials.add(StandardMaterial {
                    base_color: *colour,
                    perceptual_roughness: 0.55,
                    double_sided: true,
                    cull_mode: None,
                    ..default()
                });
                paints.push((*colour, material.clone()));
                material
            }
        };
        // It sails a little, further from higher up.
        let mut dice = || litter.dice.random::<f32>();
        let height = piece.position.y.max(0.1);
        let drift = Vec3::new(dice() - 0.5, 0.0, dice() - 0.5) * 0.45 * height
            + piece.normal.with_y(0.0) * height * 0.3 * dice();
        let place = piece.position + drift;
        let road = place.x > FAR_KERB && place.x < KERB;
        let ground = if road { ROAD } else { 0.0 } + 0.004;
        let turn = Quat::from_euler(
            EulerRot::YXZ,
            dice() * std::f32::consts::TAU,
            (dice() - 0.5) * 0.5,
            // Half of them lie on their face.
            (dice() - 0.5) * 0.5 + if dice() < 0.5 { std::f32::consts::PI } else { 0.0 },
        );
        let size = piece.size * 1.2;
        let transform = Transform::from_translation(place.with_y(ground + 0.12 * size))
            .with_rotation(turn)
            .with_scale(Vec3::splat(size));
        let flake = (Mesh3d(litter.mesh.clone()), MeshMaterial3d(material), transform, NotShadowCaster);
        let flake = commands.spawn(flake).id();
        litter.lying.push_back(flake);
        if litter.lying.len() > MOST
            && let Some(oldest) = litter.lying.pop_front()
        {
            commands.entity(oldest).despawn();
        }
    }
}

fn sweep(_: On<Repaint>, mut commands: Commands, mut litter: ResMut<Litter>) {
    for flake in litter.lying.drain(..) {
        commands.entity(flake).despawn();
    }
}
