//! Nothing of the user's is lost, nothing is left behind, and nothing is waited for.

use std::{
    collections::BTreeSet,
    fs,
    path::Path,
    process::{Command, Stdio},
    thread::sleep,
    time::{Duration, Instant},
};

use crate::tool::{bake, baked, files, folder, tool, write_two_squares};

/// Figures once replaced the model that they were about.
#[test]
fn files_that_are_read_are_not_written_over() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    write_two_squares(folder.path());
    fs::write(at("mine.ron"), "()").expect("a file");
    fs::write(at("square.obj"), "mtllib square.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl a\nf 1 2 3\n").expect("a file");
    fs::write(at("square.mtl"), "newmtl a\nKd 1 0 0\n").expect("a file");
    let contents = |names: &BTreeSet<String>| -> Vec<Vec<u8>> {
        names.iter().map(|name| fs::read(at(name)).expect("a file")).collect()
    };
    let names = || files(folder.path()).into_iter().collect::<BTreeSet<_>>();
    let real = names();
    let before = contents(&real);
    let mut cases: Vec<Vec<&str>> = vec![
        vec!["two.gltf", "--stats", "two.gltf"],
        vec!["two.gltf", "--stats", "./two.gltf"],
        vec!["two.gltf", "--dump", "two.bin"],
        vec!["two.gltf", "--out", "a texture.png"],
        vec!["two.gltf", "--preset", "mine.ron", "--stats", "mine.ron"],
        vec!["square.obj", "--stats", "square.mtl"],
        vec!["two.gltf", "--stats", "new.json", "--dump", "./new.json"],
    ];
    #[cfg(unix)]
    {
        std::os::unix::fs::symlink("two.gltf", at("link")).expect("a link");
        std::os::unix::fs::symlink("new.json", at("to_new")).expect("a link");
        cases.push(vec!["two.gltf", "--stats", "link"]);
        cases.push(vec!["link.gltf", "--stats", "two.gltf"]);
        std::os::unix::fs::symlink("two.gltf", at("link.gltf")).expect("a link");
        cases.push(vec!["two.gltf", "--stats", "new.json", "--dump", "to_new"]);
    }
    let all = names();
    for case in &cases {
        let output = bake(folder.path(), &[&case[..], &["--age", "0", "--triangles", "100"]].concat());
        let error = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{case:?}: {error}");
        assert!(error.lines().count() == 1 && error.contains("is the same file as"), "{case:?}: {error}");
        assert_eq!(names(), all, "{case:?}");
    }
    assert_eq!(contents(&real), before);
    // A folder of models into which they are baked.
    let output = bake(folder.path(), &["two.gltf", "--age", "0", "--out-dir", "."]);
    assert!(output.status.success());
    let output = bake(folder.path(), &["two.glb", "--age", "0", "--out-dir", "."]);
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.code() == Some(1) && error.contains("same file as two.glb"), "{error}");
}

#[cfg(unix)]
#[test]
fn links_are_written_through() {
    let folder = folder();
    let at = |name: &str| folder.path().join(name);
    fs::create_dir(at("store")).expect("a folder");
    fs::write(at("store/aged.glb"), "old").expect("a file");
    std::os::unix::fs::symlink("store/aged.glb", at("aged.glb")).expect("a link");
    baked(folder.path(), &["plate:20", "--age", "0", "--out", "aged.glb"]);
    assert!(fs::symlink_metadata(at("aged.glb")).expect("a link").is_symlink());
    assert!(fs::read(at("store/aged.glb")).expect("a model").starts_with(b"glTF"));
    assert_eq!((files(folder.path()).len(), files(&at("store")).len()), (2, 1));
}

/// Runs the tool for at most twenty seconds; returns its exit code and errors.
#[cfg(unix)]
fn run_in_time(folder: &Path, arguments: &[&str]) -> (Option<i32>, String) {
    let mut command = Command::new(tool());
    let mut child = command
        .args(arguments)
        .current_dir(folder)
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .expect("the tool starts");
    let start = Instant::now();
    while child.try_wait().expect("a child").is_none() {
        if start.elapsed() > Duration::from_secs(20) {
            child.kill().expect("a child");
            panic!("{arguments:?} waits for ever");
        }
        sleep(Duration::from_millis(5));
    }
    let output = child.wait_with_output().expect("its output");
    (output.status.code(), String::from_utf8_lossy(&output.stderr).into_owned())
}

#[cfg(unix)]
#[test]
fn pipes_are_not_waited_for() {
    let folder = folder();
    let make = |name: &str| {
        let made = Command::new("mkfifo").arg(folder.path().join(name)).status().expect("mkfifo");
        assert!(made.success());
    };
    write_two_squares(folder.path());
    for name in ["pipe.glb", "pipe.obj", "pipe.ron", "pipe.json", "pipe.mtl", "pipe.png"] {
        make(name);
    }
    fs::remove_file(folder.path().join("two.bin")).expect("a file");
    make("two.bin");
    let square = "mtllib pipe.mtl\nv 0 0 0\nv 1 0 0\nv 1 1 0\nusemtl a\nf 1 2 3\n";
    fs::write(folder.path().join("square.obj"), square).expect("a file");
    let textured =
        square.replace("pipe.mtl", "a.mtl").replace("v 0 0 0", "vt 0 0\nv 0 0 0").replace("f 1 2 3", "f 1/1 2/1 3/1");
    fs::write(folder.path().join("textured.obj"), textured).expect("a file");
    fs::write(folder.path().join("a.mtl"), "newmtl a\nmap_Kd pipe.png\n").expect("a file");
    for (case, code) in [
        (&["pipe.glb"][..], 1),
        (&["pipe.obj"], 1),
        (&["two.gltf"], 1),
        (&["plate:20", "--preset", "pipe.ron"], 1),
        (&["plate:20", "--stats", "pipe.json"], 1),
        (&["plate:20", "--out", "pipe.glb"], 1),
        // Materials and images are not worth an error.
        (&["square.obj", "--out", "out.glb"], 0),
        (&["textured.obj", "--out", "out.glb"], 0),
    ] {
        let (found, error) = run_in_time(folder.path(), &[case, &["--age", "0", "--triangles", "50"]].concat());
        assert_eq!(found, Some(code), "{case:?}: {error}");
        assert!(error.lines().count() == 1 && error.contains("pipe"), "{case:?}: {error}");
    }
    // The pipe that is there already is written to.
    let output = baked(folder.path(), &["plate:20", "--age", "0", "--stats", "/dev/stdout"]);
    assert!(String::from_utf8_lossy(&output.stdout).contains("\"schema\": 1"));
}

/// Temporary files of interrupted runs once stayed behind.
#[cfg(unix)]
#[test]
fn signals_leave_nothing_behind() {
    for signal in ["INT", "TERM"] {
        let mut interrupted = false;
        for _ in 0..10 {
            let folder = folder();
            let arguments =
                ["plate:40000", "--age", "0", "--out", "out.glb", "--texture-size", "64", "--dump", "out.csv"];
            let mut child = Command::new(tool())
                .args(arguments)
                .current_dir(folder.path())
                .stdout(Stdio::null())
                .stderr(Stdio::null())
                .spawn()
                .expect("the tool starts");
            // The model is written; the list is being made.
            while child.try_wait().expect("a child").is_none() && files(folder.path()).is_empty() {
                sleep(Duration::from_millis(1));
            }
            let kill =
                Command::new("kill").args(["-s", signal, &child.id().to_string()]).stderr(Stdio::null()).status();
            kill.expect("kill");
            let status = child.wait().expect("a child");
            let left = files(folder.path());
            if status.code() == Some(130) {
                assert!(left.is_empty() || left.len() == 2, "{signal}: {left:?}");
            } else {
                assert!(status.success(), "{signal}: {status}");
            }
            assert!(!left.iter().any(|name| name.starts_with(".bake")), "{signal}: {left:?}");
            interrupted |= status.code() == Some(130) && left.is_empty();
            if interrupted {
                break;
            }
        }
        assert!(interrupted, "no run was caught while it wrote");
    }
}
