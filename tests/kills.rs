//! A process is killed while it writes snapshots: the file is the old one or the new one, whole.
//!
//! 20 kills; `COATING_KILLS=1000 cargo core --test kills` does more.

use std::{
    env, fs,
    io::{BufRead, BufReader},
    path::{Path, PathBuf},
    process::{Command, Stdio},
    thread::sleep,
    time::Duration,
};

use bevy_coating::{remesh::sample, settings::CoatingSettings, sim::FilmState, snapshot::Snapshot, stain::Environment};

/// Set in the processes that are killed: the folder that they write to.
const FOLDER: &str = "COATING_TEST_FOLDER";

/// Names of the two snapshots that are written in turns, and of the place that they are written to.
const NAMES: [&str; 3] = ["young", "old", "film.snapshot"];

fn paths(folder: &Path) -> [PathBuf; 3] {
    NAMES.map(|name| folder.join(name))
}

/// Writes until it is killed.
#[test]
fn writer() {
    let Some(folder) = env::var_os(FOLDER) else { return };
    let [young, old, place] = paths(folder.as_ref());
    let snapshots = [young, old].map(|path| Snapshot::read(path).expect("a snapshot"));
    println!("begins");
    for snapshot in snapshots.iter().cycle() {
        snapshot.write(&place).expect("a file");
    }
}

/// Names of the files in a folder that are none of ours.
fn strays(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    let names = entries.map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned());
    names.filter(|name| !NAMES.contains(&name.as_str())).collect()
}

#[test]
fn a_killed_writer_leaves_a_whole_file() {
    let kills: u32 = env::var("COATING_KILLS").map_or(20, |kills| kills.parse().expect("a number"));
    let folder = tempfile::tempdir().expect("a folder");
    let [young, old, place] = paths(folder.path());
    let (settings, environment) = (CoatingSettings::default(), Environment::default());
    let piece = sample::plate(4000, 7).expect("a plate");
    let mut film = FilmState::new(&piece.film, &settings, 7, 200).expect("a manifold");
    let snapshots = [(0.2, &young), (0.7, &old)].map(|(age, path)| {
        film.age_to(age, &settings, &environment);
        let snapshot = Snapshot::of(&film).expect("a snapshot");
        snapshot.write(path).expect("a file");
        snapshot
    });
    snapshots[0].write(&place).expect("a file");

    let (mut caught, mut delay) = (0, 1_u64);
    for kill in 0..kills {
        let mut writer = Command::new(env::current_exe().expect("this program"))
            .args(["--exact", "writer", "--nocapture"])
            .env(FOLDER, folder.path())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("this program starts");
        let output = BufReader::new(writer.stdout.take().expect("its output"));
        let begins = output.lines().any(|line| line.is_ok_and(|line| line.contains("begins")));
        assert!(begins, "the writer begins");
        // At any moment of the first few writes.
        delay = delay.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        sleep(Duration::from_micros((delay >> 33) % 20_000));
        writer.kill().expect("it is there");
        writer.wait().expect("it ends");
        let found = Snapshot::read(&place).unwrap_or_else(|error| panic!("kill {kill}: {error}"));
        assert!(snapshots.contains(&found), "kill {kill}: another snapshot");
        let strays = strays(folder.path());
        assert!(strays.len() <= 1, "kill {kill}: {strays:?}");
        caught += strays.len();
    }
    eprintln!("{caught} of {kills} kills came while a file was being written");
    assert!(caught > 0, "no kill came while a file was being written");
    snapshots[1].write(&place).expect("a file");
    assert_eq!(strays(folder.path()), Vec::<String>::new(), "the next write removes what was left");
}
