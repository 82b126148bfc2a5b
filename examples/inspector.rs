//! Inspector: what lies under the pointer, how things are around it, and how the whole prop is rated.
//!
//! `cargo run --example inspector`. Space pauses.

use bevy::prelude::*;
use bevy_coating::{FilmQuery, prelude::*, survey::FilmSurface};
use bevy_egui::{EguiContexts, EguiPlugin, EguiPrimaryContextPass, egui};

/// Radius of what counts as around the pointer, in metres.
const AROUND: f32 = 0.1;

fn main() {
    App::new()
        .add_plugins((DefaultPlugins, EguiPlugin::default(), CoatingWeatheringPlugin::default()))
        .insert_resource(CoatingClock { age_per_second: 0.03, ..default() })
        .insert_resource(CoatingWeather { rain: Vec3::NEG_Y * 0.3, ..default() })
        .add_systems(Startup, setup)
        .add_systems(Update, pause)
        .add_systems(EguiPrimaryContextPass, inspect)
        .run();
}

fn setup(mut commands: Commands, mut meshes: ResMut<Assets<Mesh>>, mut materials: ResMut<Assets<StandardMaterial>>) {
    let paint = materials.add(Color::srgb(0.15, 0.35, 0.3));
    for (name, mesh, x, preset) in [
        ("boiler", Mesh::from(Capsule3d::new(0.35, 0.6)), -0.5, Preset::Marine),
        ("crate", Mesh::from(Cuboid::from_length(0.7)), 0.55, Preset::OldLeadPaint),
    ] {
        let place = Transform::from_xyz(x, 0.6, 0.0).with_rotation(Quat::from_rotation_y(0.5));
        let looks = (Mesh3d(meshes.add(mesh)), MeshMaterial3d(paint.clone()), place);
        commands.spawn((Name::new(name), looks, Coating::new(preset)));
    }
    let sun = DirectionalLight { illuminance: 8_000.0, shadow_maps_enabled: true, ..default() };
    commands.spawn((sun, Transform::from_xyz(-1.0, 1.5, 2.0).looking_at(Vec3::ZERO, Vec3::Y)));
    commands.insert_resource(GlobalAmbientLight { brightness: 300.0, ..default() });
    let eye = Transform::from_xyz(0.0, 1.1, 2.4).looking_at(Vec3::new(0.0, 0.55, 0.0), Vec3::Y);
    commands.spawn((Camera3d::default(), eye));
}

fn pause(keys: Res<ButtonInput<KeyCode>>, mut clock: ResMut<CoatingClock>) {
    if keys.just_pressed(KeyCode::Space) {
        clock.paused = !clock.paused;
    }
}

fn inspect(
    mut contexts: EguiContexts,
    window: Single<&Window>,
    camera: Single<(&Camera, &GlobalTransform)>,
    films: FilmQuery,
    props: Query<(&Name, &CoatingFilms)>,
    summaries: Query<(&FilmSummary, &FilmClock)>,
) -> Result {
    let (camera, eye) = *camera;
    let ray = window.cursor_position().and_then(|pointer| camera.viewport_to_world(eye, pointer).ok());
    let hit = ray.and_then(|ray| films.along_ray(ray.origin, ray.direction, 100.0));
    egui::Window::new("Inspector").resizable(false).default_width(260.0).show(contexts.ctx_mut()?, |ui| {
        let Some(hit) = hit else {
            ui.label("Point at a prop.");
            return;
        };
        let point = &hit.point;
        if let Ok((name, own)) = props.get(hit.root) {
            ui.heading(name.as_str());
            for (summary, clock) in summaries.iter_many(own.films()) {
                ui.label(format!("age {:.2}: {}", clock.age(), summary.ratings));
            }
        }
        ui.separator();
        ui.label(match point.surface {
            FilmSurface::Paint if point.attached => "paint that holds",
            FilmSurface::Paint => "paint that has let go",
            FilmSurface::Primer => "the back of a flake",
            FilmSurface::BareMetal => "bare metal",
            FilmSurface::RustedMetal => "rusted metal",
        });
        ui.label(format!("{:.1} mm from where it was", 1e3 * point.position.distance(point.rest_position)));
        ui.label(format!("wet {:.2}, dusty {:.2}, stained {:.2}", point.wetness, point.dust, point.rust_stain));
        ui.separator();
        if let Some(area) = films.in_sphere(point.position, AROUND) {
            ui.label(format!("Within {:.0} cm:", 100.0 * AROUND));
            for (what, share) in [("loose paint", area.loose), ("bare metal", area.bare), ("of it rusted", area.rusted)]
            {
                ui.label(format!("{what}: {:.0} %", 100.0 * share));
            }
        }
    });
    Ok(())
}
