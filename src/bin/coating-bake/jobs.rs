//! Lists what is to be baked, and into which files.

use std::{
    collections::BTreeMap,
    ffi::{OsStr, OsString},
    fs, io,
    path::{Path, PathBuf},
};

use bevy_coating::bake::{BakeError, Input, StagedFiles};

use crate::{
    Failure,
    args::{Args, usage_error},
    report::printable,
};

/// Endings of files that are taken from a folder.
const ENDINGS: [&str; 3] = ["glb", "gltf", "obj"];

/// One input and its outputs.
#[derive(Debug)]
pub struct Job {
    pub input: Input,
    pub out: Option<PathBuf>,
    pub dump: Option<PathBuf>,
    pub stats: Option<PathBuf>,
}

impl Job {
    /// The files to be written.
    pub fn outputs(&self) -> impl Iterator<Item = &Path> {
        [&self.out, &self.dump, &self.stats].into_iter().flatten().map(PathBuf::as_path)
    }
}

/// Lists one job an input and sees to it that all files can be written and that none takes the place of another or of
/// an input. Ends the program with code 2 where the command line makes no sense.
///
/// # Errors
/// [`Failure`] if a folder of inputs cannot be read or is empty, or an output cannot be written.
pub fn list(args: &Args, mask_files: &[PathBuf]) -> Result<Vec<Job>, Failure> {
    let jobs = if is_batch(args) { batch(args)? } else { vec![single(args)?] };
    for folder in [&args.out_dir, &args.stats_dir].into_iter().flatten() {
        fs::create_dir_all(folder).map_err(|source| BakeError::Write { path: folder.clone(), source })?;
    }
    let mut places = StagedFiles::default();
    args.preset_file().into_iter().chain(mask_files.iter().map(PathBuf::as_path)).for_each(|file| places.guard(file));
    for job in &jobs {
        if let Input::File(path) = &job.input {
            places.guard(path);
        }
    }
    jobs.iter().flat_map(Job::outputs).try_for_each(|path| places.claim(path))?;
    Ok(jobs)
}

/// Whether outputs get their names from their inputs.
pub fn is_batch(args: &Args) -> bool {
    args.out_dir.is_some() || args.stats_dir.is_some()
}

fn single(args: &Args) -> Result<Job, Failure> {
    let [input] = args.inputs.as_slice() else {
        usage_error("several inputs need --out-dir or --stats-dir");
    };
    let (out, dump, stats) = (args.out.clone(), args.dump.clone(), args.stats.clone());
    let job = Job { input: input.clone(), out, dump, stats };
    let outputs: Vec<&Path> = job.outputs().collect();
    if (1..outputs.len()).any(|i| outputs[..i].contains(&outputs[i])) {
        usage_error("two output files have the same name");
    }
    match input {
        Input::File(path) if path.is_dir() => Err(Failure::Folder(path.clone())),
        _ => Ok(job),
    }
}

fn batch(args: &Args) -> Result<Vec<Job>, Failure> {
    if args.out.is_some() || args.dump.is_some() || args.stats.is_some() {
        usage_error("--out, --dump and --stats are of one input and do not go with --out-dir and --stats-dir");
    }
    let mut inputs = Vec::new();
    for input in &args.inputs {
        match input {
            Input::File(path) if path.is_dir() => inputs.extend(models_in(path)?.into_iter().map(Input::File)),
            other => inputs.push(other.clone()),
        }
    }
    let mut names: BTreeMap<String, Input> = BTreeMap::new();
    let mut jobs = Vec::new();
    for input in inputs {
        let name = name(&input);
        // Many file systems take upper and lower case for the same.
        if let Some(other) = names.insert(name.to_string_lossy().to_lowercase(), input.clone()) {
            let text = format!(
                "{other} and {input} would both become {}; rename one, or bake them into different folders",
                name.display()
            );
            usage_error(&printable(&text));
        }
        let file = |folder: &Option<PathBuf>, ending: &str| {
            let mut file = name.clone();
            file.push(ending);
            folder.as_ref().map(|folder| folder.join(file))
        };
        let (out, stats) = (file(&args.out_dir, ".glb"), file(&args.stats_dir, ".json"));
        jobs.push(Job { out, stats, dump: None, input });
    }
    Ok(jobs)
}

/// The models that lie in a folder, by name. Folders in it are not looked into.
fn models_in(folder: &Path) -> Result<Vec<PathBuf>, Failure> {
    let read = || -> io::Result<Vec<PathBuf>> { fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect() };
    let mut files = read().map_err(|source| BakeError::Read { path: folder.into(), source })?;
    let is_model = |path: &PathBuf| {
        let ending = path.extension().and_then(OsStr::to_str).unwrap_or_default();
        ENDINGS.iter().any(|known| ending.eq_ignore_ascii_case(known)) && !path.is_dir()
    };
    files.retain(is_model);
    files.sort_unstable();
    if files.is_empty() {
        return Err(Failure::NoModels(folder.into()));
    }
    Ok(files)
}

/// The name of an input's outputs, without an ending.
fn name(input: &Input) -> OsString {
    match input {
        Input::File(path) => path.file_stem().unwrap_or(path.as_os_str()).to_owned(),
        Input::Piece(piece, triangles) => format!("{}_{triangles}", piece.name()).into(),
    }
}
