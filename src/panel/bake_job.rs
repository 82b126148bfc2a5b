//! Bakes a model in the background.

use std::{
    path::{Path, PathBuf},
    sync::{
        Arc,
        atomic::{AtomicU64, Ordering},
    },
};

use bevy::{
    ecs::{resource::Resource, system::ResMut},
    tasks::{AsyncComputeTaskPool, Task, futures::check_ready},
};

use super::state::CoatingPanel;
use crate::{
    api::coating::Coating,
    bake::{BakeError, BakeOptions, Images, Input, Progress, StagedFiles, StainOutput, Stopwatch, bake},
    settings::CoatingSettings,
};

/// Model that is being baked, if one is.
#[derive(Resource, Default)]
pub(super) struct BakeJob(Option<(Task<Result<String, BakeError>>, Arc<Done>)>);

/// Work that is done, and all of it.
#[derive(Debug, Default)]
struct Done {
    all: AtomicU64,
    done: AtomicU64,
}

impl Progress for Done {
    fn begin(&self, work: u64) {
        self.all.store(work, Ordering::Relaxed);
    }

    fn advance(&self, work: u64) {
        self.done.fetch_add(work, Ordering::Relaxed);
    }
}

/// Returns the file into which a model is baked: beside it, with `_aged` at the end of its name. A test piece goes into
/// the working folder. `None` for no name.
pub(super) fn written_name(model: &str) -> Option<PathBuf> {
    let model = Path::new(model.trim());
    // A test piece has a colon between its kind and its number of triangles.
    let stem = model.file_stem()?.to_string_lossy().replace(':', "_");
    Some(model.with_file_name(format!("{stem}_aged.glb")))
}

impl BakeJob {
    /// Begins to bake `model` with the paint of a prop, unless another is being baked. Returns what to tell.
    pub fn begin(&mut self, model: &str, coating: &Coating, seed: u64, settings: &CoatingSettings, age: f64) -> String {
        if self.0.is_some() {
            return "a model is being baked already".to_owned();
        }
        let model = model.trim();
        let (input, out) = match (Input::parse(model.as_ref()), written_name(model)) {
            (Ok(input), Some(out)) => (input, out),
            (Err(error), _) => return error.to_string(),
            (_, None) => return format!("`{model}` is no model"),
        };
        let options = BakeOptions {
            resolution: coating.resolution,
            settings: settings.clone(),
            preset: "panel".to_owned(),
            age,
            steps: coating.steps_per_age,
            quality: coating.quality,
            seed,
            masks: coating.masks.masks.clone(),
            detail: coating.detail,
            ..BakeOptions::default()
        };
        let done = Arc::new(Done::default());
        let told = done.clone();
        let task = AsyncComputeTaskPool::get().spawn(async move { age_model(&input, &options, &out, &*told) });
        self.0 = Some((task, done));
        format!("baking {model} to age {age:.2}")
    }

    /// Returns the share of the work that is done; `None` if nothing is being baked.
    pub fn done(&self) -> Option<f32> {
        let (_, done) = self.0.as_ref()?;
        let all = done.all.load(Ordering::Relaxed).max(1);
        Some(done.done.load(Ordering::Relaxed) as f32 / all as f32)
    }
}

/// Ages a model and writes it into `out`. Returns what to tell.
fn age_model(input: &Input, options: &BakeOptions, out: &Path, progress: &dyn Progress) -> Result<String, BakeError> {
    let stopwatch = Stopwatch::start();
    let model = input.read(options.seed, Images::Load)?;
    let mut files = StagedFiles::default();
    model.files.iter().for_each(|file| files.guard(file));
    files.claim(out)?;
    let mut baked = bake(model, options, stopwatch, progress)?;
    files.add(out, &baked.glb(StainOutput::default())?)?;
    files.commit()?;
    let notes: String = baked.warnings.iter().map(|warning| format!("; {warning}")).collect();
    Ok(format!("baked into {}{notes}", out.display()))
}

/// Tells when the model has been baked, or why it was not.
pub(super) fn finish_baking(mut job: ResMut<BakeJob>, mut panel: ResMut<CoatingPanel>) {
    let Some((task, _)) = &mut job.0 else { return };
    let Some(result) = check_ready(task) else { return };
    panel.message = result.unwrap_or_else(|error| error.to_string());
    job.0 = None;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn baked_models_lie_beside_their_sources_and_never_over_them() {
        let name = |model: &str| written_name(model).map(|path| path.to_string_lossy().into_owned());
        assert_eq!(name("props/barrel.glb").as_deref(), Some("props/barrel_aged.glb"));
        assert_eq!(name(" barrel.obj ").as_deref(), Some("barrel_aged.glb"));
        assert_eq!(name("plate:3012").as_deref(), Some("plate_3012_aged.glb"));
        assert_eq!((name(""), name("..")), (None, None));
    }

    #[test]
    fn what_is_no_model_is_told_at_once_or_at_the_end() {
        AsyncComputeTaskPool::get_or_init(Default::default);
        let mut job = BakeJob::default();
        let (coating, settings) = (Coating::default(), CoatingSettings::default());
        let told = job.begin("disk:1", &coating, 1, &settings, 0.1);
        assert!(!told.is_empty() && !told.starts_with("baking"), "too few triangles: {told}");
        assert!(job.done().is_none());
        assert!(job.begin("no/such.glb", &coating, 1, &settings, 0.1).starts_with("baking"));
        assert!(job.done().is_some());
        assert!(job.begin("plate:100", &coating, 1, &settings, 0.1).contains("already"));
    }
}
