//! An app without a GPU, stepped frame by frame with manual time, for the plugin's tests.
#![allow(dead_code, reason = "each test binary uses its part")]

use std::time::Duration;

use bevy::{
    app::TaskPoolOptions,
    asset::RenderAssetUsages,
    mesh::{Indices, MeshPlugin, PrimitiveTopology},
    prelude::*,
    time::TimeUpdateStrategy,
};
use bevy_coating::{
    FilmPace,
    deform::FilmConstraints,
    film::{FilmChanges, FilmMesh},
    fracture::FilmForces,
    prelude::*,
    sim::FilmState,
    stain::StainFields,
};

/// Frames after which a background build must be done; each waits a millisecond.
const PATIENCE: u32 = 60_000;

/// An app with the plugin, 50 ms a frame, without a limit to the steps of a frame.
pub fn app() -> App {
    let mut app = bare_app();
    app.add_plugins(CoatingWeatheringPlugin::default());
    app.insert_resource(CoatingBudget::UNLIMITED);
    app
}

/// The same without the plugin.
pub fn bare_app() -> App {
    let mut app = App::new();
    app.add_plugins((MinimalPlugins, AssetPlugin::default(), MeshPlugin, TransformPlugin));
    app.insert_resource(TimeUpdateStrategy::ManualDuration(Duration::from_millis(50)));
    app
}

/// A plate of `n` by `n` squares in the xy plane, a metre wide, facing +z, not quite regular.
pub fn plate(n: u32) -> Mesh {
    let point = |x: u32, y: u32| {
        let inner = x > 0 && y > 0 && x < n && y < n;
        let jitter = |k: u32| if inner { ((x * 7919 + y * 104_729 + k * 1299) % 97) as f32 / 97.0 - 0.5 } else { 0.0 };
        [(x as f32 + 0.35 * jitter(1)) / n as f32, (y as f32 + 0.35 * jitter(2)) / n as f32, 0.0]
    };
    let side = n + 1;
    let positions: Vec<[f32; 3]> = (0..side * side).map(|i| point(i % side, i / side)).collect();
    let uvs: Vec<[f32; 2]> = positions.iter().map(|p| [p[0], 1.0 - p[1]]).collect();
    let mut indices = Vec::new();
    for y in 0..n {
        for x in 0..n {
            let a = y * side + x;
            let [b, c, d] = [a + 1, a + side + 1, a + side];
            indices.extend(if (x + y) % 2 == 0 { [a, b, c, a, c, d] } else { [a, b, d, b, c, d] });
        }
    }
    Mesh::new(PrimitiveTopology::TriangleList, RenderAssetUsages::default())
        .with_inserted_attribute(Mesh::ATTRIBUTE_NORMAL, vec![[0.0, 0.0, 1.0f32]; positions.len()])
        .with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, positions)
        .with_inserted_attribute(Mesh::ATTRIBUTE_UV_0, uvs)
        .with_inserted_indices(Indices::U32(indices))
}

/// Adds `mesh` to the app's assets.
pub fn add_mesh(app: &mut App, mesh: Mesh) -> Handle<Mesh> {
    app.world_mut().resource_mut::<Assets<Mesh>>().add(mesh)
}

/// Spawns a plate with `coating` at the origin.
pub fn spawn_plate(app: &mut App, n: u32, coating: Coating) -> Entity {
    let mesh = add_mesh(app, plate(n));
    app.world_mut().spawn((Mesh3d(mesh), coating)).id()
}

/// A coating that uses the mesh as it is, and ages fast: 100 steps per age.
pub fn quick_coating() -> Coating {
    Coating::new(Preset::Heavy).with_resolution(FilmResolution::Keep).with_steps_per_age(100)
}

/// Updates until `done`, waiting for background builds.
pub fn update_until(app: &mut App, mut done: impl FnMut(&mut App) -> bool) {
    for _ in 0..PATIENCE {
        if done(app) {
            return;
        }
        app.update();
        std::thread::sleep(Duration::from_millis(1));
    }
    panic!("nothing happened within {PATIENCE} frames");
}

/// Corners of each triangle of a mesh, but for those that are gone: they are left without area.
pub fn triangles_of(mesh: &Mesh) -> Vec<[usize; 3]> {
    let indices: Vec<usize> = mesh.indices().expect("indices").iter().collect();
    let triangles = indices.chunks_exact(3).map(|t| [t[0], t[1], t[2]]);
    triangles.filter(|[a, b, c]| a != b && b != c && c != a).collect()
}

/// Stops the clock and updates until `films` films are ready.
pub fn wait_for_films(app: &mut App, films: usize) {
    app.world_mut().resource_mut::<CoatingClock>().paused = true;
    update_until(app, |app| app.world().resource::<CoatingStatus>().films >= films);
}

/// Takes exactly `steps` steps with all films.
pub fn take_steps(app: &mut App, steps: u64) {
    app.world_mut().resource_mut::<CoatingClock>().request_steps(steps);
    app.update();
}

/// The film on `entity`, as the state that `sim` knows.
pub fn film_state(app: &App, entity: Entity) -> FilmState {
    let film = app.world().entity(entity);
    let part = "a part of the film";
    FilmState {
        mesh: film.get::<FilmMesh>().expect(part).clone(),
        forces: film.get::<FilmForces>().expect(part).clone(),
        constraints: film.get::<FilmConstraints>().expect(part).clone(),
        stains: film.get::<StainFields>().expect(part).clone(),
        clock: *film.get::<FilmClock>().expect(part),
        changes: film.get::<FilmChanges>().expect(part).clone(),
        quality: film.get::<FilmPace>().expect(part).quality,
        ..FilmState::default()
    }
}

/// All messages of a kind that are in the app, oldest first; they are taken out.
pub fn messages<M: Message>(app: &mut App) -> Vec<M> {
    app.world_mut().resource_mut::<Messages<M>>().drain().collect()
}

/// Set in the processes that [`digests_on`] starts: how many threads to use.
const THREADS: &str = "COATING_TEST_THREADS";

/// The app of a process that [`digests_on`] started, on as many threads as that says; `None` in any other process.
pub fn app_of_other_process() -> Option<App> {
    let threads = std::env::var(THREADS).ok()?.parse().ok()?;
    let mut app = App::new();
    let pools = TaskPoolPlugin { task_pool_options: TaskPoolOptions::with_num_threads(threads) };
    app.add_plugins((MinimalPlugins.set(pools), AssetPlugin::default(), MeshPlugin, TransformPlugin));
    app.add_plugins(CoatingWeatheringPlugin::default()).insert_resource(CoatingBudget::UNLIMITED);
    Some(app)
}

/// What the test `test` of this program, a path of modules and its name, prints after `digest ` when it runs alone in a
/// process with `threads` threads: Bevy makes its pools of threads once in a process.
fn digests_on(threads: &str, test: &str) -> Vec<String> {
    let program = std::env::current_exe().expect("this program");
    let mut process = std::process::Command::new(program);
    process.args(["--exact", test, "--nocapture"]).env(THREADS, threads);
    let output = process.output().expect("a run");
    assert!(output.status.success(), "{test} on {threads} threads: {}", String::from_utf8_lossy(&output.stderr));
    let output = String::from_utf8(output.stdout).expect("text");
    // The harness may print on the same line.
    output.match_indices("digest ").map(|(at, _)| output[at..at + 71].to_string()).collect()
}

/// Asserts that the four digests that the test `test` prints are the same on 1, 3 and 8 threads.
pub fn assert_same_on_any_number_of_threads(test: &str) {
    let one = digests_on("1", test);
    assert_eq!(one.len(), 4, "{one:?}");
    assert!(one[0] != one[1]);
    assert_eq!(digests_on("3", test), one);
    assert_eq!(digests_on("8", test), one);
}
