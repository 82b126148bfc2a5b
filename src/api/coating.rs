//! [`Coating`]: all that a user adds to an entity to have its paint age.

use bevy::{
    asset::Handle,
    ecs::{component::Component, reflect::ReflectComponent},
    reflect::prelude::*,
};

use super::{shelter::Shelter, stain_display::StainDisplay};
use crate::{
    appearance::shading::{FilmShading, MetalShading, PrimerShading, StainShading},
    deform::SolverQuality,
    remesh::FilmResolution,
    settings::{CoatingSettings, Preset, SettingsError},
    sim::DEFAULT_STEPS_PER_AGE,
};
/// Triangles of a film when nothing else is set.
pub const DEFAULT_TRIANGLES: u32 = 4000;

/// Paint that ages, on an entity with a [`Mesh3d`](bevy::mesh::Mesh3d) or on the root of a scene: then on every
/// mesh below it, also on those that arrive later. Where entities with a `Coating` are nested the nearest one
/// counts.
///
/// Meshes on sibling entities that all stand on their parent with an identity transform, as the primitives of
/// one glTF node do, are painted as one: they share a film, which lives on their parent. Otherwise the film lives on
/// the entity of the mesh. Where the film is ready, that entity has [`CoatedBy`](super::CoatedBy).
///
/// The prop shows its own mesh until the film has been built in the background, and gets it back when the
/// `Coating` is removed. `rate`, `paused`, `settings`, `quality`, `shelter` and the looks may be changed at any time;
/// changing any other field builds the film anew. To start over with fresh paint, remove the `Coating` and insert it again.
#[derive(Component, Clone, Debug, PartialEq, Reflect)]
#[reflect(Component, Default, Debug, Clone, PartialEq)]
pub struct Coating {
    /// How the paint ages. Default: [`CoatingSettings::default`].
    pub settings: SettingsSource,
    /// Seed of everything random: remeshing, adhesion and weak edges. Default 0.
    pub seed: u64,
    /// How fine each film is. Default: [`DEFAULT_TRIANGLES`] triangles.
    pub resolution: FilmResolution,
    /// Age gained per age that the clock gives out. 0 or more, default 1.
    pub rate: f64,
    /// Whether this prop stands still. Default false.
    pub paused: bool,
    /// Age at which the prop appears; aged in the background. 0 or more, default 0 (fresh).
    pub start_age: f64,
    /// Steps per unit age. At least 1, default 1000. More is slower, not better: the result hardly depends on it.
    pub steps_per_age: u32,
    /// How much work goes into bending. Default: [`SolverQuality::Default`].
    pub quality: SolverQuality,
    /// What decides how much rain and sun reaches the prop. Default: [what stands around it](Shelter::Scene).
    pub shelter: Shelter,
    /// How stains are shown on the paint. Default: with a material of their own.
    pub stain_display: StainDisplay,
    /// Colours and strengths of stains, of the metal under the paint and of the paint's back.
    pub shading: FilmShading,
}

impl Default for Coating {
    fn default() -> Self {
        Self {
            settings: SettingsSource::default(),
            seed: 0,
            resolution: FilmResolution::Triangles(DEFAULT_TRIANGLES),
            rate: 1.0,
            paused: false,
            start_age: 0.0,
            steps_per_age: DEFAULT_STEPS_PER_AGE,
            quality: SolverQuality::default(),
            shelter: Shelter::default(),
            stain_display: StainDisplay::default(),
            shading: FilmShading::default(),
        }
    }
}

impl Coating {
    /// A coating with `settings`.
    pub fn new(settings: impl Into<SettingsSource>) -> Self {
        Self { settings: settings.into(), ..Self::default() }
    }

    /// Returns a coating with the settings of the [preset](Preset) of this name. Where the name is known when the code is
    /// written, `Coating::new(Preset::Heavy)` leaves no room for a typo.
    ///
    /// # Errors
    /// [`SettingsError`] that lists the presets there are.
    pub fn preset(name: &str) -> Result<Self, SettingsError> {
        Ok(Self::new(CoatingSettings::preset(name)?))
    }

    /// Sets the seed.
    pub fn with_seed(self, seed: u64) -> Self {
        Self { seed, ..self }
    }

    /// Sets how fine each film is, in triangles.
    pub fn with_triangles(self, triangles: u32) -> Self {
        self.with_resolution(FilmResolution::Triangles(triangles))
    }

    /// Sets how fine each film is.
    pub fn with_resolution(self, resolution: FilmResolution) -> Self {
        Self { resolution, ..self }
    }

    /// Sets the age gained per age that the clock gives out.
    pub fn with_rate(self, rate: f64) -> Self {
        Self { rate, ..self }
    }

    /// Sets the age at which the prop appears.
    pub fn with_start_age(self, start_age: f64) -> Self {
        Self { start_age, ..self }
    }

    /// Sets the steps per unit age.
    pub fn with_steps_per_age(self, steps_per_age: u32) -> Self {
        Self { steps_per_age, ..self }
    }

    /// Sets how much work goes into bending.
    pub fn with_quality(self, quality: SolverQuality) -> Self {
        Self { quality, ..self }
    }

    /// Sets what decides how much rain and sun reaches the prop.
    pub fn with_shelter(self, shelter: Shelter) -> Self {
        Self { shelter, ..self }
    }

    /// Sets how stains are shown on the paint.
    pub fn with_stain_display(self, stain_display: StainDisplay) -> Self {
        Self { stain_display, ..self }
    }

    /// Sets how all that shows is shaded.
    pub fn with_shading(self, shading: FilmShading) -> Self {
        Self { shading, ..self }
    }

    /// Sets the back of the paint: a [`PrimerShading`], or a colour.
    pub fn with_primer(self, primer: impl Into<PrimerShading>) -> Self {
        Self { shading: FilmShading { primer: primer.into(), ..self.shading }, ..self }
    }

    /// Sets the metal under the paint.
    pub fn with_metal(self, metal: MetalShading) -> Self {
        Self { shading: FilmShading { metal, ..self.shading }, ..self }
    }

    /// Sets the colours and strengths of stains.
    pub fn with_stains(self, stains: StainShading) -> Self {
        Self { shading: FilmShading { stains, ..self.shading }, ..self }
    }

    /// What a film must be built anew for when it changes.
    pub(crate) fn key(&self) -> FilmKey {
        FilmKey {
            seed: self.seed,
            resolution: self.resolution,
            start_age: self.start_age,
            steps_per_age: self.steps_per_age,
        }
    }
}

/// The fields of a [`Coating`] that go into building a film.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct FilmKey {
    pub seed: u64,
    pub resolution: FilmResolution,
    pub start_age: f64,
    pub steps_per_age: u32,
}

/// Where the settings of a coating come from.
#[derive(Clone, Debug, PartialEq, Reflect)]
#[reflect(Default, Debug, Clone, PartialEq)]
pub enum SettingsSource {
    /// Given here.
    Inline(CoatingSettings),
    /// An asset, as loaded from a `.coating.ron` file. The film is built when it has been loaded, and follows
    /// when it changes.
    Asset(Handle<CoatingSettings>),
}

impl Default for SettingsSource {
    fn default() -> Self {
        Self::Inline(CoatingSettings::default())
    }
}

impl From<CoatingSettings> for SettingsSource {
    fn from(settings: CoatingSettings) -> Self {
        Self::Inline(settings)
    }
}

impl From<Preset> for SettingsSource {
    fn from(preset: Preset) -> Self {
        Self::Inline(preset.into())
    }
}

impl From<Handle<CoatingSettings>> for SettingsSource {
    fn from(handle: Handle<CoatingSettings>) -> Self {
        Self::Asset(handle)
    }
}
