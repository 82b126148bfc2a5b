//! The street corner in a ruined city: everything around the sign and the props, made from simple geometry
//! at start-up. Metres; the sign stands at the origin on the pavement, the street runs away along -z.

mod builder;
mod ground;
mod rubble;
mod ruins;
pub mod sky;
mod street;
mod textures;
mod tiling;
mod walls;

use bevy::asset::RenderAssetUsages;
use bevy::light::NotShadowCaster;
use bevy::prelude::*;
use bevy_coating::prelude::*;
use builder::MeshBuilder;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use textures::Surfaces;

/// Height of the road under the pavement, whose top is 0.
pub const ROAD: f32 = -0.13;
/// The pavement's edge towards the road.
pub const KERB: f32 = -1.45;
/// The other edge of the road.
pub const FAR_KERB: f32 = -10.0;

pub struct ScenePlugin;

impl Plugin for ScenePlugin {
    fn build(&self, app: &mut App) {
        app.insert_resource(weather()).add_systems(PreStartup, paint_sky);
        app.add_systems(Startup, (build_street, sky::spawn_sun));
    }
}

/// Showers from the sea, on the left; the low sun dries the other side.
fn weather() -> CoatingWeather {
    CoatingWeather {
        wind: Vec3::new(0.10, 0.0, -0.03),
        gusts: 0.02,
        rain: Vec3::new(0.62, -0.74, -0.26).normalize() * 0.8,
        sun: sky::sun_direction() * -0.8,
    }
}

fn paint_sky(mut commands: Commands, mut images: ResMut<Assets<Image>>) {
    commands.insert_resource(sky::paint(&mut images));
}

/// What the builders share: where finished parts go, and the dice.
pub struct Site<'a, 'w, 's> {
    commands: &'a mut Commands<'w, 's>,
    meshes: &'a mut Assets<Mesh>,
    materials: &'a mut Assets<StandardMaterial>,
    surfaces: Surfaces,
    dice: ChaCha8Rng,
}

impl Site<'_, '_, '_> {
    fn spawn(&mut self, mesh: MeshBuilder, material: &Handle<StandardMaterial>) {
        self.add(mesh, material, RenderAssetUsages::RENDER_WORLD, ());
    }

    /// For what is too thin or too flat to be missed in a shadow map.
    fn spawn_shadowless(&mut self, mesh: MeshBuilder, material: &Handle<StandardMaterial>) {
        self.add(mesh, material, RenderAssetUsages::RENDER_WORLD, NotShadowCaster);
    }

    /// For what keeps rain and sun off the props.
    fn spawn_shelter(&mut self, mesh: MeshBuilder, material: &Handle<StandardMaterial>) {
        self.add(mesh, material, RenderAssetUsages::default(), RainShelter);
    }

    fn add(
        &mut self,
        mesh: MeshBuilder,
        material: &Handle<StandardMaterial>,
        usages: RenderAssetUsages,
        more: impl Bundle,
    ) {
        if !mesh.is_empty() {
            let mesh = Mesh3d(self.meshes.add(mesh.build(usages)));
            self.commands.spawn((mesh, MeshMaterial3d(material.clone()), more));
        }
    }

    /// A number between `low` and `high`.
    fn between(&mut self, low: f32, high: f32) -> f32 {
        low + (high - low) * self.dice.random::<f32>()
    }
}

fn build_street(
    mut commands: Commands,
    mut meshes: ResMut<Assets<Mesh>>,
    mut materials: ResMut<Assets<StandardMaterial>>,
    mut images: ResMut<Assets<Image>>,
) {
    let surfaces = Surfaces::paint(&mut images);
    let mut site = Site {
        commands: &mut commands,
        meshes: &mut meshes,
        materials: &mut materials,
        surfaces,
        dice: ChaCha8Rng::seed_from_u64(14),
    };
    ground::build(&mut site);
    ruins::build(&mut site);
    rubble::build(&mut site);
    street::build(&mut site);
}
