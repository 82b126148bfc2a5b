//! Holds how a model is aged.

use super::{
    error::OptionsError,
    limits::{MAX_AGE, MAX_STEPS_PER_AGE, UNITS},
    name_pattern::NamePattern,
};
use crate::{
    appearance::Detail,
    deform::SolverQuality,
    masks::{CoatingMask, MaskImages},
    remesh::FilmResolution,
    settings::CoatingSettings,
    stain::Environment,
    survey::Until,
};

/// Options of ageing.
///
/// ```
/// use bevy_coating::{bake::BakeOptions, remesh::FilmResolution, settings::CoatingSettings};
///
/// let options = BakeOptions {
///     resolution: FilmResolution::Triangles(800),
///     settings: CoatingSettings::preset("heavy").unwrap_or_default(),
///     age: 0.6,
///     seed: 7,
///     ..BakeOptions::default()
/// };
/// assert!(options.validate().is_ok());
/// assert!(BakeOptions { age: f64::NAN, ..options }.validate().is_err());
/// ```
#[derive(Clone, Debug)]
pub struct BakeOptions {
    /// How fine the films are. Default: [`FilmResolution::default`], edges of 0.7 of the grain that the settings ask
    /// for, and at most 16,000 triangles for all films together. Test pieces have films of their own.
    pub resolution: FilmResolution,
    /// Metres that a unit of the model is long: 0.0001 to 10,000 ([`UNITS`]), default 1, as glTF has it. Films are in
    /// metres, and so are all figures and rows; the aged model is in the model's own unit. Test pieces are in metres
    /// anyway.
    pub metres_per_unit: f32,
    /// Settings of the coating.
    pub settings: CoatingSettings,
    /// Name of the settings, also in the figures ([`RunStats::preset`](super::RunStats::preset)); default `default`. If
    /// it is that of a [preset](crate::settings::Preset), films have its masks, too.
    pub preset: String,
    /// Age to reach: 0 to [`MAX_AGE`], default 1, the end of the reference run.
    pub age: f64,
    /// Condition at which ageing ends before that age, of all films together; default none. It is looked for at every
    /// hundredth of an age. A warning says if it was not reached
    /// ([`BakeWarning::NotReached`](super::BakeWarning::NotReached)).
    pub until: Option<Until>,
    /// Steps per unit age: 1 to [`MAX_STEPS_PER_AGE`], default 1,000.
    pub steps: u32,
    /// How bending is solved.
    pub quality: SolverQuality,
    /// Seed of films and forces; default 0.
    pub seed: u64,
    /// Gravity and weather in scene space; default still air and dry weather, with gravity along -y.
    pub environment: Environment,
    /// Names of nodes, meshes and materials that are left as they are, beside glass, which always is; default none. See
    /// [`NamePattern`] for the wildcards.
    pub exclude: Vec<NamePattern>,
    /// Whether custom properties of a model say how it is painted ([`extras`](crate::extras)); default true. What they
    /// say goes before [`settings`](Self::settings) and [`seed`](Self::seed).
    pub extras: bool,
    /// Masks of the films beside those of the preset: where they are weak or dirty from the start; default none. They
    /// act on all meshes.
    pub masks: Vec<CoatingMask>,
    /// Images that the masks name; default none.
    pub mask_images: MaskImages,
    /// How finely the aged model is written; default level 0, the triangles of the films.
    pub detail: Detail,
}

impl Default for BakeOptions {
    fn default() -> Self {
        Self {
            resolution: FilmResolution::default(),
            metres_per_unit: 1.0,
            settings: CoatingSettings::default(),
            preset: "default".into(),
            age: 1.0,
            until: None,
            steps: 1000,
            quality: SolverQuality::default(),
            seed: 0,
            environment: Environment::default(),
            exclude: Vec::new(),
            extras: true,
            masks: Vec::new(),
            mask_images: MaskImages::new(),
            detail: Detail::default(),
        }
    }
}

impl BakeOptions {
    /// Checks age, steps, unit, resolution, masks and settings against their ranges.
    ///
    /// # Errors
    /// [`OptionsError`] for the first that is out of its range.
    pub fn validate(&self) -> Result<(), OptionsError> {
        if !(0.0..=MAX_AGE).contains(&self.age) {
            return Err(OptionsError::Age { found: self.age });
        }
        if !(1..=MAX_STEPS_PER_AGE).contains(&self.steps) {
            return Err(OptionsError::Steps { found: self.steps });
        }
        if !UNITS.contains(&self.metres_per_unit) {
            return Err(OptionsError::Unit { found: self.metres_per_unit });
        }
        self.resolution.validate().map_err(OptionsError::Resolution)?;
        if let Some((field, found, range)) = self.detail.out_of_range() {
            return Err(OptionsError::Detail { field, found, range });
        }
        for mask in &self.masks {
            mask.validate()?;
        }
        Ok(self.settings.validate()?)
    }
}
