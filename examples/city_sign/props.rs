//! The sign and the props around it.

use crate::cli::Options;
use crate::common_scene::paint::{Loading, Paint};
use crate::debris::FlakeColour;
use crate::scene::ROAD;
use Wear::{Sheltered, Street};
use bevy::gltf::GltfAssetLabel;
use bevy::prelude::*;
use bevy::world_serialization::WorldInstanceReady;
use bevy_coating::prelude::*;

pub struct PropsPlugin;

impl Plugin for PropsPlugin {
    fn build(&self, app: &mut App) {
        app.add_systems(Startup, spawn);
    }
}

/// How a part has fared.
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
enum Wear {
    /// As the command line has it.
    Street,
    /// A better primer, or a sheltered place: less has come off.
    Sheltered,
}

/// A model of the scene.
#[derive(Component, Clone)]
struct Prop {
    file: &'static str,
    place: Transform,
    /// Nodes whose paint ages, with the triangles of their films and how they have fared.
    painted: Vec<(&'static str, u32, Wear)>,
    /// Multiplies the materials' colour: toys' colours are too clean for this street.
    tint: Color,
    /// Colour of what falls off.
    flakes: Color,
    /// Added to the seed of the command line, that no two props crack alike.
    seed: u64,
}

impl Prop {
    fn new(file: &'static str, place: Transform) -> Self {
        let tint = Color::linear_rgb(0.46, 0.41, 0.36);
        Self { file, place, painted: Vec::new(), tint, flakes: Color::srgb_u8(120, 115, 108), seed: 0 }
    }

    fn painted(mut self, node: &'static str, triangles: u32, wear: Wear) -> Self {
        self.painted.push((node, triangles, wear));
        self
    }

    fn tinted(self, red: f32, green: f32, blue: f32) -> Self {
        Self { tint: Color::linear_rgb(red, green, blue), ..self }
    }

    fn shedding(self, red: u8, green: u8, blue: u8) -> Self {
        Self { flakes: Color::srgb_u8(red, green, blue), ..self }
    }
}

/// A place: position, degrees around the vertical, scale.
fn at(x: f32, y: f32, z: f32, yaw: f32, scale: f32) -> Transform {
    Transform::from_xyz(x, y, z).with_rotation(Quat::from_rotation_y(yaw.to_radians())).with_scale(Vec3::splat(scale))
}

/// Leans a place by degrees about x and z.
fn lean(place: Transform, x: f32, z: f32) -> Transform {
    let lean = Quat::from_euler(EulerRot::XZY, x.to_radians(), z.to_radians(), 0.0);
    Transform { rotation: lean * place.rotation, ..place }
}

fn props(sign_triangles: u32) -> Vec<Prop> {
    const SIGN: &str = "city/street_sign.glb";
    const HYDRANT: &str = "props/prop_firehydrant.glb";
    const CAR: &str = "props/prop_car.glb";
    const DRUMS: &str = "props/prop_container.glb";
    const BARRIER: &str = "props/prop_barrier.glb";
    const DUMPSTER: &str = "props/prop_dumpster.glb";
    const GANTRY: &str = "props/prop_sign_highway.glb";
    const LANTERN: &str = "props/prop_lantern.glb";
    const WATER_TOWER: &str = "props/prop_watertower.glb";
    let barrier = |place| Prop::new(BARRIER, place).painted("construction-barrier", 2000, Street);
    vec![
        Prop::new(SIGN, Transform::IDENTITY)
            .painted("plate", sign_triangles, Street)
            .painted("post_left", 1600, Sheltered)
            .painted("post_right", 1600, Sheltered)
            .tinted(1.0, 1.0, 1.0)
            .shedding(16, 82, 160),
        Prop::new(HYDRANT, at(-1.02, 0.0, -2.3, 25.0, 3.5))
            .painted("firehydrant", 3000, Street)
            .tinted(0.50, 0.62, 0.62)
            .shedding(150, 24, 18),
        Prop::new(CAR, lean(at(-5.4, ROAD + 0.30, -9.4, 32.0, 5.2), 0.0, 2.0))
            .painted("car_hatchback", 6000, Sheltered)
            .tinted(0.50, 0.62, 0.62)
            .shedding(150, 24, 18),
        Prop::new(DRUMS, at(-3.0, ROAD, -6.9, 12.0, 3.5))
            .painted("containers_A", 3000, Sheltered)
            .tinted(0.34, 0.25, 0.20)
            .shedding(32, 84, 40),
        barrier(at(-7.6, ROAD, -6.2, 100.0, 8.0)),
        barrier(at(-3.6, ROAD, -14.5, 75.0, 8.0)),
        Prop::new(DUMPSTER, at(2.35, 0.02, -9.0, 78.0, 4.3))
            .painted("dumpster", 2000, Sheltered)
            .tinted(0.42, 0.34, 0.28)
            .shedding(32, 84, 40),
        Prop::new(GANTRY, lean(at(-5.8, 0.0, -29.0, -90.0, 11.0), 0.0, 1.5)),
        Prop::new(LANTERN, lean(at(2.0, 0.0, -4.3, 10.0, 1.0), 78.0, 20.0)),
        Prop::new(WATER_TOWER, lean(at(-34.0, 0.0, -62.0, 20.0, 26.0), 0.0, 3.0)),
    ]
}

fn spawn(mut commands: Commands, assets: Res<AssetServer>, options: Res<Options>, mut loading: ResMut<Loading>) {
    for (index, mut prop) in props(options.triangles).into_iter().enumerate() {
        prop.seed = index as u64 * 1000;
        loading.props += 1;
        let scene = assets.load(GltfAssetLabel::Scene(0).from_asset(prop.file));
        loading.files.push(scene.clone().untyped());
        commands.spawn((WorldAssetRoot(scene), prop.place, prop)).observe(dress);
    }
}

/// Gives the meshes of a model that has arrived their tint and their paint.
fn dress(
    ready: On<WorldInstanceReady>,
    mut commands: Commands,
    mut loading: ResMut<Loading>,
    mut materials: ResMut<Assets<StandardMaterial>>,
    options: Res<Options>,
    props: Query<&Prop>,
    children: Query<&Children>,
    meshes: Query<(&MeshMaterial3d<StandardMaterial>, &ChildOf), With<Mesh3d>>,
    names: Query<&Name>,
) {
    let Ok(prop) = props.get(ready.entity) else { return };
    for entity in children.iter_descendants(ready.entity) {
        let Ok((surface, parent)) = meshes.get(entity) else { continue };
        if prop.tint != Color::WHITE
            && let Some(mut material) = materials.get(&surface.0).cloned()
        {
            let [base, tint] = [material.base_color, prop.tint].map(|c| c.to_linear().to_vec3());
            material.base_color = Color::LinearRgba(LinearRgba::from_vec3(base * tint));
            material.perceptual_roughness = 0.6;
            commands.entity(entity).insert(MeshMaterial3d(materials.add(material)));
        }
        // A mesh hangs below the node that carries its name.
        let Ok(name) = names.get(parent.parent()) else { continue };
        let painted = prop.painted.iter().enumerate().find(|(_, (node, ..))| *node == name.as_str());
        if let Some((index, &(_, triangles, wear))) = painted {
            let seed = options.scene.seed.wrapping_add(prop.seed + index as u64);
            let paint = coating(&options, wear).with_seed(seed).with_triangles(triangles);
            commands.entity(entity).insert((Paint(paint), FlakeColour(prop.flakes)));
        }
    }
    loading.loaded += 1;
}

fn coating(options: &Options, wear: Wear) -> Coating {
    let mut settings = options.preset.1.clone();
    // The sign is wet all over; it should be readable to the end.
    settings.moisture.adhesion *= 0.1;
    settings.rust.emission *= 0.5;
    if wear == Sheltered {
        settings.adhesion.mean += 0.5;
        settings.deform.bend_limit *= 0.6;
    }
    Coating { detail: options.scene.detail(options.level), ..Coating::new(settings) }
}
