//! Gameplay: the plugin tells the game what happens to paint, and the game reacts.
//!
//! `cargo run --example gameplay`. A tank ages. Each flake that falls off scores and drops a crumb to the ground. The
//! pane of glass beside it cannot be painted, and the plugin says so. Space pauses, Up and Down change the speed.

use bevy::prelude::*;
use bevy_coating::prelude::*;
use bevy_egui::{EguiContexts, EguiPlugin, EguiPrimaryContextPass, egui};

fn main() {
    App::new()
        .add_plugins((DefaultPlugins, EguiPlugin::default(), CoatingWeatheringPlugin::default()))
        .insert_resource(CoatingClock { age_per_second: 0.04, ..default() })
        .init_resource::<Scoreboard>()
        .add_systems(Startup, setup)
        .add_systems(Update, (set_clock, note_films, note_first_crack, drop_crumbs, fall))
        .add_systems(EguiPrimaryContextPass, write_on_screen)
        .run();
}

/// The score, and the news for the player.
#[derive(Resource, Default)]
struct Scoreboard {
    flakes: u32,
    /// Paint on the ground, in square metres.
    area: f32,
    news: Vec<String>,
}

impl Scoreboard {
    /// Adds a line to the news, unless it is there already: a prop that was refused is tried again when it changes.
    fn tell(&mut self, line: String) {
        if !self.news.contains(&line) {
            self.news.push(line);
        }
    }
}

/// A crumb of paint that falls, and its speed.
#[derive(Component)]
struct Crumb(Vec3);

fn setup(mut commands: Commands, mut meshes: ResMut<Assets<Mesh>>, mut materials: ResMut<Assets<StandardMaterial>>) {
    commands.spawn((
        Name::new("tank"),
        Mesh3d(meshes.add(Capsule3d::new(0.4, 0.9))),
        MeshMaterial3d(materials.add(Color::srgb(0.2, 0.35, 0.6))),
        Transform::from_xyz(-0.2, 0.7, 0.0).with_rotation(Quat::from_rotation_z(1.57)),
        Coating::new(Preset::Heavy),
    ));
    // See-through materials have no paint that could come off: this coating is refused.
    let glass =
        StandardMaterial { base_color: Color::srgba(0.6, 0.8, 0.9, 0.3), alpha_mode: AlphaMode::Blend, ..default() };
    commands.spawn((
        Name::new("pane"),
        Mesh3d(meshes.add(Cuboid::new(0.03, 0.9, 0.9))),
        MeshMaterial3d(materials.add(glass)),
        Transform::from_xyz(1.1, 0.45, 0.0),
        Coating::default(),
    ));
    let ground = Mesh3d(meshes.add(Plane3d::default().mesh().size(20.0, 20.0)));
    commands.spawn((ground, MeshMaterial3d(materials.add(Color::srgb(0.4, 0.4, 0.37)))));
    let sun = DirectionalLight { illuminance: 8_000.0, shadow_maps_enabled: true, ..default() };
    commands.spawn((sun, Transform::from_xyz(-1.0, 1.5, 2.0).looking_at(Vec3::ZERO, Vec3::Y)));
    commands.insert_resource(GlobalAmbientLight { brightness: 300.0, ..default() });
    let eye = Transform::from_xyz(0.0, 1.4, 3.2).looking_at(Vec3::new(0.0, 0.8, 0.0), Vec3::Y);
    commands.spawn((Camera3d::default(), eye));
}

/// The clock that all films share is a resource.
fn set_clock(keys: Res<ButtonInput<KeyCode>>, mut clock: ResMut<CoatingClock>) {
    if keys.just_pressed(KeyCode::Space) {
        clock.paused = !clock.paused;
    }
    if keys.just_pressed(KeyCode::ArrowUp) {
        clock.age_per_second = (clock.age_per_second * 2.0).min(0.32);
    }
    if keys.just_pressed(KeyCode::ArrowDown) {
        clock.age_per_second = (clock.age_per_second / 2.0).max(0.005);
    }
}

/// Films are built in the background. One of these two messages says how that went.
fn note_films(
    mut ready: MessageReader<FilmReady>,
    mut failed: MessageReader<FilmFailed>,
    names: Query<&Name>,
    mut board: ResMut<Scoreboard>,
) -> Result {
    for film in ready.read() {
        board.tell(format!("The paint of the {} is ready: {} triangles.", names.get(film.root)?, film.triangles));
    }
    for film in failed.read() {
        board.tell(format!("The {} cannot be painted: {}", names.get(film.root)?, film.error));
    }
    Ok(())
}

/// Sent once for each film, when the first edge of it tears.
fn note_first_crack(
    mut cracks: MessageReader<FirstCrack>,
    names: Query<&Name>,
    mut board: ResMut<Scoreboard>,
) -> Result {
    for crack in cracks.read() {
        board.tell(format!("The paint of the {} has cracked, at age {:.2}.", names.get(crack.entity)?, crack.age));
    }
    Ok(())
}

/// Each piece that falls off says where it was, where it faced and how large it is.
fn drop_crumbs(
    mut commands: Commands,
    mut fallen: MessageReader<PieceFallen>,
    mut board: ResMut<Scoreboard>,
    mut meshes: ResMut<Assets<Mesh>>,
    mut materials: ResMut<Assets<StandardMaterial>>,
    mut looks: Local<Option<(Mesh3d, MeshMaterial3d<StandardMaterial>)>>,
) {
    // All crumbs share one mesh and one material, made for the first of them.
    let (mesh, paint) = looks.get_or_insert_with(|| {
        (Mesh3d(meshes.add(Cuboid::from_length(1.0))), MeshMaterial3d(materials.add(Color::srgb(0.2, 0.35, 0.6))))
    });
    for piece in fallen.read() {
        board.flakes += 1;
        // The size is the side of a square of the same area, in metres.
        board.area += piece.size * piece.size;
        let place = Transform::from_translation(piece.position).with_scale(Vec3::splat(piece.size * 0.6));
        commands.spawn((mesh.clone(), paint.clone(), place, Crumb(piece.normal * 0.5)));
    }
}

/// Moves crumbs until they lie on the ground.
fn fall(mut commands: Commands, time: Res<Time>, mut crumbs: Query<(Entity, &mut Transform, &mut Crumb)>) {
    for (entity, mut place, mut crumb) in &mut crumbs {
        crumb.0.y -= 9.81 * time.delta_secs();
        place.translation += crumb.0 * time.delta_secs();
        let ground = place.scale.y / 2.0;
        if place.translation.y < ground {
            place.translation.y = ground;
            commands.entity(entity).remove::<Crumb>();
        }
    }
}

fn write_on_screen(
    mut contexts: EguiContexts,
    board: Res<Scoreboard>,
    clock: Res<CoatingClock>,
    status: Res<CoatingStatus>,
) -> Result {
    egui::Window::new("Score").resizable(false).default_width(420.0).show(contexts.ctx_mut()?, |ui| {
        ui.heading(format!("flakes: {}, square centimetres: {:.0}", board.flakes, board.area * 1e4));
        let speed = if clock.paused { "paused".into() } else { format!("{} a second", clock.age_per_second) };
        ui.label(format!("age {:.2}, {speed} (Space, Up, Down)", status.youngest));
        ui.separator();
        for line in &board.news {
            ui.label(line);
        }
    });
    Ok(())
}
