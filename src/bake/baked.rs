//! Holds an aged model.

use super::{
    carried::Carried,
    coat::Prop,
    model::{MaterialLibrary, ModelMesh},
    stats::Stats,
    stopwatch::Stopwatch,
    warning::BakeWarning,
};
use crate::{appearance::Detail, sim::FilmState};

/// An aged model: props, their films and figures.
///
/// ```
/// use bevy_coating::bake::{BakeOptions, Images, Input, StainOutput, Stopwatch, bake};
///
/// let model = Input::parse("disk:60".as_ref())?.read(0, Images::Skip)?;
/// let options = BakeOptions { age: 0.05, ..BakeOptions::default() };
/// let mut baked = bake(model, &options, Stopwatch::start(), &())?;
/// assert_eq!(baked.films[0].clock.steps, 50);
/// assert_eq!(baked.csv().lines().count(), 1 + baked.films[0].mesh.topology.vertex_count());
/// assert!(baked.glb(StainOutput::VertexColors)?.starts_with(b"glTF"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Baked {
    /// Name of the input in messages.
    pub origin: String,
    /// Copyright notice of the model (glTF `asset.copyright`).
    pub copyright: Option<String>,
    /// The props' own surfaces.
    pub props: Vec<Prop>,
    /// The props' films, one to one.
    pub films: Vec<FilmState>,
    /// The model's materials.
    pub materials: MaterialLibrary,
    /// Everything that was left out, changed or put right so far, one warning a kind.
    pub warnings: Vec<BakeWarning>,
    /// Document that the model was read from.
    pub carried: Carried,
    /// Meshes without a document that are left as they are: glass, and what was excluded.
    pub(super) left: Vec<ModelMesh>,
    /// How finely the aged model is written.
    pub(super) detail: Detail,
    /// Time spent.
    pub(super) stopwatch: Stopwatch,
    /// All figures but the seconds, which run on.
    pub(super) stats: Stats,
}

impl Baked {
    /// Returns the figures of the run, with the seconds up to now.
    pub fn stats(&self) -> Stats {
        Stats { seconds: self.stopwatch.seconds(), ..self.stats.clone() }
    }
}
