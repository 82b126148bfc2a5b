//! The sign and the props around it.

use crate::cli::Options;
use crate::scene::ROAD;
use crate::weathering::Wear::{self, Sheltered, Street};
use crate::weathering::{Loading, Painted};
use bevy::gltf::GltfAssetLabel;
use bevy::prelude::*;
use bevy::world_serialization::WorldInstanceReady;

/// A model of the scene: file, place, and which of its meshes are painted.
struct Prop {
    file: &'static str,
    place: Transform,
    /// Names of painted nodes, the triangles of their films, and how they have fared; empty: the prop does not
    /// age.
    painted: Vec<(&'static str, u32, Wear)>,
    /// Multiplies the material's colour: toys' colours are too clean for this street.
    tint: Color,
}

pub struct PropsPlugin;

impl Plugin for PropsPlugin {
    fn build(&self, app: &mut App) {
        app.add_systems(Startup, spawn).add_systems(Update, give_up);
    }
}

fn place(x: f32, y: f32, z: f32, yaw_degrees: f32, scale: f32) -> Transform {
    Transform::from_xyz(x, y, z)
        .with_rotation(Quat::from_rotation_y(yaw_degrees.to_radians()))
        .with_scale(Vec3::splat(scale))
}

fn tilted(transform: Transform, x_degrees: f32, z_degrees: f32) -> Transform {
    let tilt = Quat::from_euler(EulerRot::XZY, x_degrees.to_radians(), z_degrees.to_radians(), 0.0);
    Transform { rotation: tilt * transform.rotation, ..transform }
}

fn spawn(mut commands: Commands, assets: Res<AssetServer>, options: Res<Options>, mut loading: ResMut<Loading>) {
    let prop = |file, place, painted: &[(&'static str, u32, Wear)], [r, g, b]: [f32; 3]| Prop {
        file,
        place,
        painted: painted.to_vec(),
        tint: Color::linear_rgb(r, g, b),
    };
    let dusty = [0.46, 0.41, 0.36];
    let faded_red = [0.50, 0.62, 0.62];
    let props = [
        prop(
            "city/street_sign.glb",
            Transform::default(),
            &[("plate", options.triangles, Street), ("post_left", 1600, Sheltered), ("post_right", 1600, Sheltered)],
            [1.0; 3],
        ),
        prop(
            "props/prop_firehydrant.glb",
            place(-1.02, 0.0, -2.3, 25.0, 3.5),
            &[("firehydrant", 3000, Street)],
            faded_red,
        ),
        prop(
            "props/prop_car.glb",
            tilted(place(-5.4, ROAD + 0.30, -9.4, 32.0, 5.2), 0.0, 2.0),
            &[("car_hatchback", 6000, Sheltered)],
            faded_red,
        ),
        // Green plastic as published; tinted to oil drums' olive.
        prop(
            "props/prop_container.glb",
            place(-3.0, ROAD, -6.9, 12.0, 3.5),
            &[("containers_A", 3000, Street)],
            [0.62, 0.20, 0.22],
        ),
        prop(
            "props/prop_barrier.glb",
            place(-7.6, ROAD, -6.2, 100.0, 8.0),
            &[("construction-barrier", 2000, Street)],
            dusty,
        ),
        prop(
            "props/prop_barrier.glb",
            place(-3.6, ROAD, -14.5, 75.0, 8.0),
            &[("construction-barrier", 2000, Street)],
            dusty,
        ),
        prop(
            "props/prop_dumpster.glb",
            place(2.35, 0.02, -9.0, 78.0, 4.3),
            &[("dumpster", 2000, Sheltered)],
            [0.75, 0.40, 0.35],
        ),
        prop("props/prop_sign_highway.glb", tilted(place(-5.8, 0.0, -29.0, -90.0, 11.0), 0.0, 1.5), &[], dusty),
        prop("props/prop_lantern.glb", tilted(place(2.0, 0.0, -4.3, 10.0, 1.0), 78.0, 20.0), &[], dusty),
        prop("props/prop_watertower.glb", tilted(place(-34.0, 0.0, -62.0, 20.0, 26.0), 0.0, 3.0), &[], dusty),
    ];
    for (index, prop) in props.into_iter().enumerate() {
        loading.props += 1;
        let scene = assets.load(GltfAssetLabel::Scene(0).from_asset(prop.file));
        let seed = options.seed.wrapping_add(index as u64 * 1000);
        commands.spawn((WorldAssetRoot(scene), prop.place)).observe(
            move |ready: On<WorldInstanceReady>,
                  mut commands: Commands,
                  mut loading: ResMut<Loading>,
                  mut materials: ResMut<Assets<StandardMaterial>>,
                  surfaces: Query<&MeshMaterial3d<StandardMaterial>>,
                  children: Query<&Children>,
                  meshes: Query<&ChildOf, With<Mesh3d>>,
                  names: Query<&Name>| {
                loading.loaded += 1;
                for entity in children.iter_descendants(ready.entity) {
                    if prop.tint != Color::WHITE
                        && let Some(mut material) = surfaces.get(entity).ok().and_then(|m| materials.get(&m.0)).cloned()
                    {
                        let [base, tint] = [material.base_color, prop.tint].map(|c| c.to_linear().to_vec3());
                        material.base_color = Color::LinearRgba(LinearRgba::from_vec3(base * tint));
                        material.perceptual_roughness = 0.6;
                        commands.entity(entity).insert(MeshMaterial3d(materials.add(material)));
                    }
                    // A mesh hangs below the node that carries its name.
                    let Ok(parent) = meshes.get(entity) else { continue };
                    let Ok(name) = names.get(parent.parent()) else { continue };
                    if let Some((at, (_, triangles, wear))) =
                        prop.painted.iter().enumerate().find(|(_, (painted, ..))| *painted == name.as_str())
                    {
                        commands.entity(entity).insert(Painted {
                            triangles: *triangles,
                            seed: seed.wrapping_add(at as u64),
                            wear: *wear,
                        });
                    }
                }
            },
        );
    }
}

/// A model that cannot be loaded would be waited for in vain.
fn give_up(assets: Res<AssetServer>, props: Query<&WorldAssetRoot>, mut exit: MessageWriter<AppExit>) {
    for prop in &props {
        if assets.load_state(&prop.0).is_failed() {
            error!("A model of the scene is missing; run the example from a whole copy of the repository.");
            exit.write(AppExit::error());
        }
    }
}
