//! Defines [`Coating`], the component that makes the paint of an entity age.

use bevy::{
    ecs::{component::Component, reflect::ReflectComponent},
    reflect::prelude::*,
};

use super::{
    masks::CoatingMasks,
    outline::PropOutline,
    paint::{Paint, SettingsSource},
    shelter::Shelter,
    stain_display::StainDisplay,
    weather::CoatingWeather,
};
use crate::{
    appearance::{
        Detail,
        shading::{FilmShading, MetalShading, PrimerShading, StainShading},
    },
    deform::SolverQuality,
    remesh::FilmResolution,
    settings::{Preset, SettingsError},
    sim::DEFAULT_STEPS_PER_AGE,
};

/// Paint that ages, on an entity with a [`Mesh3d`](bevy::mesh::Mesh3d) or on the root of a scene.
///
/// On the root of a scene it coats every mesh below, also meshes that are spawned later, and shares its triangles
/// between them by area. Where entities with a `Coating` are nested, the nearest one above a mesh counts. Glass is left
/// alone, and so is everything with a [`CoatingExclude`](super::exclude::CoatingExclude): see there.
///
/// Sibling meshes that all have an identity transform, like the primitives of one glTF node, share one film, which is
/// on their parent's entity. Otherwise the film is on the entity of the mesh. The entity of a film has
/// [`CoatedBy`](super::links::CoatedBy) from the moment its film is being built.
///
/// The prop keeps its own mesh until the film has been built in the background, and gets it back when the `Coating` is
/// removed. The fields `rate`, `paused`, `settings`, `quality`, `shelter`, `stain_display` and `shading` may be changed
/// at any time. A change of another field builds the film again; the prop keeps its old film until the new one is
/// ready. For fresh paint remove the `Coating` and insert it again.
///
/// A coated entity may be [cloned](bevy::ecs::entity::EntityCloner): the clone gets a film of its own in the same
/// state.
///
/// ```
/// use bevy::prelude::*;
/// use bevy_coating::prelude::*;
///
/// fn paint(mut commands: Commands, mut meshes: ResMut<Assets<Mesh>>) {
///     let barrel = meshes.add(Cylinder::new(0.3, 0.9));
///     let coating = Coating::new(Preset::Heavy).with_seed(7).with_start_age(0.4);
///     commands.spawn((Mesh3d(barrel), coating));
/// }
///
/// # let mut app = App::new();
/// # app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin));
/// # app.add_plugins(CoatingWeatheringPlugin::default());
/// app.add_systems(Startup, paint);
/// app.update();
/// # assert_eq!(app.world().resource::<CoatingStatus>().refused, 0);
/// ```
#[derive(Component, Clone, Debug, PartialEq, Reflect)]
#[reflect(Component, Default, Debug, Clone, PartialEq)]
pub struct Coating {
    /// Settings of the ageing. Default: [`CoatingSettings::default`](crate::settings::CoatingSettings::default).
    pub settings: SettingsSource,
    /// Seed of all random choices: remeshing, adhesion, weak edges and patterns of stains. Props with the same seed are
    /// twins. `None`, the default: it is drawn from the place in the world where the prop is first coated, and kept as
    /// [`CoatingSeed`](super::seed::CoatingSeed), so that no two props of a level look alike and each looks the same
    /// every time.
    ///
    /// The meshes below one coating differ in any case: each varies the seed by the path of names that leads to it.
    pub seed: Option<u64>,
    /// Resolution of the films. Default: [`FilmResolution::default`], edges of 0.7 of the
    /// [grain](crate::settings::ScaleSettings::grain) that the settings ask for, as long as all films of the coating
    /// together have at most 16,000 triangles, which they share by area.
    ///
    /// The grain counts that is asked for when the film is built. If it is changed later, the film keeps its triangles,
    /// and its cracks and curls are measured by the new grain at once.
    pub resolution: FilmResolution,
    /// Factor on the speed of the [clock](super::clock::CoatingClock). 0 to 1,000
    /// ([`MAX_RATE`](super::limits::MAX_RATE)), default 1. If it is set out of range while the film ages, a warning
    /// says so and the film keeps the rate that it had.
    pub rate: f64,
    /// Whether this prop stands still. It takes no steps, not even
    /// [requested](super::clock::CoatingClock::request_steps) ones, and goes on from where it was. Default false.
    pub paused: bool,
    /// Age to which the film is aged in the background before the prop shows it. 0 to 10
    /// ([`MAX_START_AGE`](super::limits::MAX_START_AGE)), default 0 (fresh).
    pub start_age: f64,
    /// Weather in which the film is aged to its [start age](Self::start_age). `None`, the default: still air, neither
    /// rain nor sun. Today's [weather](super::weather::CoatingWeather) does not reach back, so a prop that is spawned
    /// in a storm looks like one that is spawned before it.
    pub past_weather: Option<CoatingWeather>,
    /// Date at which the prop was painted, by the [calendar](super::calendar::CoatingCalendar). With one it appears as
    /// old as the date says: its [start age](Self::start_age), and what has passed since at this rate, in the weather
    /// that there has been. So a prop that is spawned late, or comes back from a
    /// [snapshot](super::snapshot::CoatingSnapshot) after it was away, is no younger than one that was there all the
    /// time, but for 10 of age at most. `None`, the default: it has its start age when it appears, or the age that was
    /// saved. Any finite number.
    pub painted: Option<f64>,
    /// Number of steps per unit of age. 1 to 100,000 ([`MAX_STEPS_PER_AGE`](super::limits::MAX_STEPS_PER_AGE)), default
    /// 1,000. The result hardly depends on it; more steps cost more.
    pub steps_per_age: u32,
    /// Quality of the solver that bends the film. Default: [`SolverQuality::Default`].
    pub quality: SolverQuality,
    /// Source of the prop's exposure to rain and sun. Default: [`Shelter::Scene`].
    pub shelter: Shelter,
    /// Way in which stains are drawn on the paint. Default: [`StainDisplay::Material`].
    pub stain_display: StainDisplay,
    /// Colours and strengths of stains, of the metal under the paint and of the paint's back. Default:
    /// [`FilmShading::default`].
    pub shading: FilmShading,
    /// Sides and holes of backs and metal where the prop's material is not a `StandardMaterial`. Default:
    /// [`PropOutline::default`], front sides without holes.
    pub outline: PropOutline,
    /// Masks: where the films are weak or dirty from the start. Default: none; [presets](Preset) may bring some.
    pub masks: CoatingMasks,
    /// How finely the film is shown, and how its torn edges look. Default: [`Detail::default`], the film's own
    /// triangles. From level 1 on the film follows the prop's own surface however coarse it is, curls are smooth, torn
    /// edges chipped, and the paint has a thickness: for props that are looked at from nearby.
    pub detail: Detail,
}

impl Default for Coating {
    fn default() -> Self {
        Self {
            settings: SettingsSource::default(),
            seed: None,
            resolution: FilmResolution::default(),
            rate: 1.0,
            paused: false,
            start_age: 0.0,
            past_weather: None,
            painted: None,
            steps_per_age: DEFAULT_STEPS_PER_AGE,
            quality: SolverQuality::default(),
            shelter: Shelter::default(),
            stain_display: StainDisplay::default(),
            shading: FilmShading::default(),
            outline: PropOutline::default(),
            masks: CoatingMasks::default(),
            detail: Detail::default(),
        }
    }
}

impl Coating {
    /// Returns a coating with this paint: a [`Preset`] with its [masks](Preset::masks),
    /// [`CoatingSettings`](crate::settings::CoatingSettings), or the handle of a settings asset.
    ///
    /// ```
    /// use bevy_coating::prelude::*;
    ///
    /// let preset = Coating::new(Preset::Gentle);
    /// let mut settings = CoatingSettings::from(Preset::Gentle);
    /// settings.adhesion.mean = 1.8;
    /// assert_ne!(Coating::new(settings).settings, preset.settings);
    /// ```
    pub fn new(paint: impl Into<Paint>) -> Self {
        let Paint { settings, masks } = paint.into();
        Self { settings, masks, ..Self::default() }
    }

    /// Returns a coating with the settings and masks of the [preset](Preset) called `name`, for names that users type.
    /// In code [`Coating::new(Preset::Heavy)`](Self::new) is simpler, as it cannot fail.
    ///
    /// # Errors
    /// [`SettingsError`] with a list of the presets, if none is called `name`.
    ///
    /// ```
    /// use bevy_coating::prelude::*;
    ///
    /// assert_eq!(Coating::preset("heavy"), Ok(Coating::new(Preset::Heavy)));
    /// assert!(Coating::preset("haevy").is_err());
    /// ```
    pub fn preset(name: &str) -> Result<Self, SettingsError> {
        Ok(Self::new(name.parse::<Preset>()?))
    }

    /// Sets the [`seed`](Self::seed) of all random choices.
    ///
    /// ```
    /// use bevy_coating::prelude::*;
    ///
    /// let twins = [0, 1].map(|_| Coating::default().with_seed(7));
    /// assert_eq!(twins[0].seed, Some(7));
    /// assert_eq!(Coating::default().seed, None, "by default each place has a seed of its own");
    /// ```
    pub fn with_seed(self, seed: u64) -> Self {
        Self { seed: Some(seed), ..self }
    }

    /// Sets the [`resolution`](Self::resolution) to about `triangles` triangles, at least 4, which all films of the
    /// coating share by area.
    pub fn with_triangles(self, triangles: u32) -> Self {
        self.with_resolution(FilmResolution::Triangles(triangles))
    }

    /// Sets the [`resolution`](Self::resolution).
    ///
    /// ```
    /// use bevy_coating::{prelude::*, remesh::FilmResolution};
    ///
    /// let even = Coating::default().with_resolution(FilmResolution::EdgeLength(0.02));
    /// assert_eq!(even.resolution, FilmResolution::EdgeLength(0.02));
    /// assert_eq!(Coating::default().with_triangles(900).resolution, FilmResolution::Triangles(900));
    /// ```
    pub fn with_resolution(self, resolution: FilmResolution) -> Self {
        Self { resolution, ..self }
    }

    /// Sets the [`rate`](Self::rate), the factor on the speed of the clock.
    pub fn with_rate(self, rate: f64) -> Self {
        Self { rate, ..self }
    }

    /// Sets the [`start_age`](Self::start_age) at which the prop first shows its film.
    ///
    /// ```
    /// use bevy_coating::prelude::*;
    ///
    /// // A wreck that hardly changes any more.
    /// let wreck = Coating::new(Preset::Heavy).with_start_age(0.9).with_rate(0.05);
    /// assert_eq!((wreck.start_age, wreck.rate), (0.9, 0.05));
    /// ```
    pub fn with_start_age(self, start_age: f64) -> Self {
        Self { start_age, ..self }
    }

    /// Sets the [`past_weather`](Self::past_weather) in which the film is aged to its start age.
    ///
    /// ```
    /// use bevy::math::Vec3;
    /// use bevy_coating::prelude::*;
    ///
    /// // A boat that has lain in the rain for years.
    /// let rainy = CoatingWeather { rain: Vec3::NEG_Y, ..CoatingWeather::default() };
    /// let boat = Coating::default().with_start_age(0.8).with_past_weather(rainy);
    /// assert_eq!(boat.past_weather, Some(rainy));
    /// ```
    pub fn with_past_weather(self, weather: CoatingWeather) -> Self {
        Self { past_weather: Some(weather), ..self }
    }

    /// Sets the [date](Self::painted) at which the prop was painted.
    pub fn with_painted(self, date: f64) -> Self {
        Self { painted: Some(date), ..self }
    }

    /// Sets the number of [`steps_per_age`](Self::steps_per_age).
    pub fn with_steps_per_age(self, steps_per_age: u32) -> Self {
        Self { steps_per_age, ..self }
    }

    /// Sets the [`quality`](Self::quality) of bending.
    pub fn with_quality(self, quality: SolverQuality) -> Self {
        Self { quality, ..self }
    }

    /// Sets the [`shelter`](Self::shelter), the source of the prop's exposure to rain and sun.
    pub fn with_shelter(self, shelter: Shelter) -> Self {
        Self { shelter, ..self }
    }

    /// Sets the [`stain_display`](Self::stain_display), the way in which stains are drawn on the paint.
    pub fn with_stain_display(self, stain_display: StainDisplay) -> Self {
        Self { stain_display, ..self }
    }

    /// Sets how finely paint is shown: [`detail`](Self::detail).
    ///
    /// ```
    /// use bevy_coating::{appearance::Detail, prelude::*};
    ///
    /// let close_up = Coating::default().with_detail(Detail { level: 2, ..Detail::default() });
    /// assert_eq!(close_up.detail.triangles(1_000), 16_000);
    /// ```
    pub fn with_detail(self, detail: Detail) -> Self {
        Self { detail, ..self }
    }

    /// Sets the whole [`shading`](Self::shading).
    ///
    /// ```
    /// use bevy_coating::prelude::*;
    ///
    /// // One shading for a whole harbour.
    /// let shading = FilmShading {
    ///     stains: StainShading { rust_strength: 0.6, ..StainShading::default() },
    ///     ..FilmShading::default()
    /// };
    /// let [crane, boat] = [1, 2].map(|seed| Coating::default().with_seed(seed).with_shading(shading.clone()));
    /// assert_eq!(crane.shading, boat.shading);
    /// ```
    pub fn with_shading(self, shading: FilmShading) -> Self {
        Self { shading, ..self }
    }

    /// Sets the shading of the back of the paint: a [`PrimerShading`], or a colour.
    ///
    /// ```
    /// use bevy::color::Color;
    /// use bevy_coating::prelude::*;
    ///
    /// let red_lead = Coating::default().with_primer(Color::srgb(0.55, 0.22, 0.15));
    /// assert_eq!(red_lead.shading.primer.roughness, PrimerShading::default().roughness);
    /// ```
    pub fn with_primer(self, primer: impl Into<PrimerShading>) -> Self {
        Self { shading: FilmShading { primer: primer.into(), ..self.shading }, ..self }
    }

    /// Sets the shading of the metal under the paint.
    ///
    /// ```
    /// use bevy::color::Color;
    /// use bevy_coating::prelude::*;
    ///
    /// let brass = MetalShading::default().with_steel(Color::srgb(0.78, 0.63, 0.32));
    /// assert_eq!(Coating::default().with_metal(brass.clone()).shading.metal, brass);
    /// ```
    pub fn with_metal(self, metal: MetalShading) -> Self {
        Self { shading: FilmShading { metal, ..self.shading }, ..self }
    }

    /// Sets the [`outline`](Self::outline) of a prop whose material is not a `StandardMaterial`.
    pub fn with_outline(self, outline: PropOutline) -> Self {
        Self { outline, ..self }
    }

    /// Sets the [`masks`](Self::masks), which say where films begin weak or dirty, in the place of those of a preset.
    pub fn with_masks(self, masks: impl Into<CoatingMasks>) -> Self {
        Self { masks: masks.into(), ..self }
    }

    /// Sets the colours and strengths of stains.
    pub fn with_stains(self, stains: StainShading) -> Self {
        Self { shading: FilmShading { stains, ..self.shading }, ..self }
    }

    /// Returns the fields whose change makes it necessary to build the film again.
    pub(crate) fn key(&self) -> FilmKey {
        FilmKey {
            seed: self.seed,
            resolution: self.resolution,
            start_age: self.start_age,
            past_weather: self.past_weather.filter(|_| self.start_age > 0.0 || self.painted.is_some()),
            painted: self.painted,
            steps_per_age: self.steps_per_age,
            masks: self.masks.fingerprint(),
            detail: self.detail,
        }
    }
}

/// Fields of a [`Coating`] that decide how a film is built. Two keys are equal if their bits are, so that a field that
/// is NaN does not look changed all the time.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FilmKey {
    pub seed: Option<u64>,
    pub resolution: FilmResolution,
    pub start_age: f64,
    /// Weather of the past; `None` also where there is no past.
    pub past_weather: Option<CoatingWeather>,
    pub painted: Option<f64>,
    pub steps_per_age: u32,
    /// Number that tells masks apart.
    pub masks: u64,
    pub detail: Detail,
}

impl FilmKey {
    /// Returns whether a film that was built with this key is one for `wanted`, too: a lower level needs no other film.
    pub fn serves(&self, wanted: &Self) -> bool {
        let level = self.detail.level;
        let finer = Self { detail: Detail { level, ..wanted.detail }, ..*wanted };
        wanted.detail.level <= level && *self == finer
    }

    /// Returns everything that keys are compared by.
    fn bits(&self) -> (Option<u64>, FilmResolution, u32, [u64; 4], Option<[u32; 10]>, u32, [u32; 4]) {
        let (resolution, number) = match self.resolution {
            FilmResolution::EdgeLength(length) => (FilmResolution::EdgeLength(0.0), length.to_bits()),
            FilmResolution::Grain { share, max_triangles } => {
                (FilmResolution::Grain { share: 0.0, max_triangles }, share.to_bits())
            }
            other => (other, 0),
        };
        let weather = self.past_weather.map(|weather| {
            let CoatingWeather { wind, gusts, rain, sun } = weather;
            [wind.x, wind.y, wind.z, gusts, rain.x, rain.y, rain.z, sun.x, sun.y, sun.z].map(f32::to_bits)
        });
        // How many pixels are enough may change at any time.
        let Detail { level, chips, thickness, tolerance, .. } = self.detail;
        let detail = [level, chips.to_bits(), thickness.to_bits(), tolerance.to_bits()];
        let painted = self.painted.map_or([0, 0], |date| [1, date.to_bits()]);
        let ages = [self.start_age.to_bits(), painted[0], painted[1], self.masks];
        (self.seed, resolution, number, ages, weather, self.steps_per_age, detail)
    }
}

impl PartialEq for FilmKey {
    fn eq(&self, other: &Self) -> bool {
        self.bits() == other.bits()
    }
}
