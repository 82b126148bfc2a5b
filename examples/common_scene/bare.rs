//! Without a graphics adapter nothing can be drawn. The props are aged all the same, and written as models that any
//! viewer opens, with the figures of the runs.

use bevy::prelude::AppExit;
use bevy_coating::bake::{
    BakeError, BakeOptions, Model, ModelMesh, Progress, Slot, StagedFiles, StainOutput, Stopwatch, bake,
};
use bevy_coating::surface::Surface;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};

/// A model to be aged.
pub struct Piece {
    /// Name of its files, without ending.
    pub name: String,
    pub model: Model,
    pub options: BakeOptions,
}

/// A model of one mesh in plain paint.
pub fn plain_model(name: &str, surface: Surface) -> Model {
    let mut model = Model { origin: name.into(), ..Model::default() };
    let material = Some(model.materials.add_plain_paint());
    let slots = vec![Slot { material, uvs: true, ..Slot::default() }];
    model.meshes.push(ModelMesh { name: name.into(), surface, slots, ..ModelMesh::default() });
    model
}

/// Says what to install, ages the pieces (or says why there are none) and writes them into `folder`.
pub fn run(folder: &Path, pieces: Result<Vec<Piece>, BakeError>) -> AppExit {
    println!(
        "No graphics adapter was found, so nothing can be drawn: what would be seen is aged and written as models."
    );
    println!("To see it drawn, a software renderer is enough:");
    println!("  Debian, Ubuntu:  apt install mesa-vulkan-drivers");
    println!("  Fedora:          dnf install mesa-vulkan-drivers");
    println!("  Arch:            pacman -S vulkan-swrast");
    let aged = pieces.and_then(|pieces| {
        std::fs::create_dir_all(folder).map_err(|source| BakeError::Write { path: folder.into(), source })?;
        let folder = std::fs::canonicalize(folder).unwrap_or_else(|_| folder.into());
        pieces.into_iter().try_for_each(|piece| age(piece, &folder))
    });
    match aged {
        Ok(()) => AppExit::Success,
        Err(error) => {
            eprintln!("{error}");
            AppExit::error()
        }
    }
}

fn age(piece: Piece, folder: &Path) -> Result<(), BakeError> {
    let told = Told { name: piece.name.clone(), ..Told::default() };
    let mut baked = bake(piece.model, &piece.options, Stopwatch::start(), &told)?;
    let file = |ending: &str| -> PathBuf { folder.join(format!("{}.{ending}", piece.name)) };
    let (aged, figures) = (file("glb"), file("json"));
    let mut files = StagedFiles::default();
    files.add(&aged, &baked.glb(StainOutput::default())?)?;
    files.add(&figures, baked.stats().to_json().as_bytes())?;
    files.commit()?;
    for warning in &baked.warnings {
        println!("note: {warning}");
    }
    println!("{}", aged.display());
    println!("{}", figures.display());
    Ok(())
}

/// Tells of every tenth of the work.
#[derive(Default)]
struct Told {
    name: String,
    all: AtomicU64,
    done: AtomicU64,
}

impl Progress for Told {
    fn begin(&self, work: u64) {
        self.all.store(work.max(1), Ordering::Relaxed);
    }

    fn advance(&self, work: u64) {
        let all = self.all.load(Ordering::Relaxed);
        let before = self.done.fetch_add(work, Ordering::Relaxed);
        let (old, new) = (before * 10 / all, (before + work) * 10 / all);
        if new > old {
            println!("{}: aged {} %", self.name, new * 10);
        }
    }
}
