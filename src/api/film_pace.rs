//! Defines [`FilmPace`], the stepping state of one film.

use std::sync::Arc;

use bevy::{ecs::component::Component, math::Vec3, transform::components::GlobalTransform};

use super::{coating::Coating, error::CoatingFault, step_account::StepAccount, weather::CoatingWeather};
use crate::{deform::SolverQuality, fracture::FilmForces, settings::CoatingSettings, stain::Environment};

/// Smallest share of the view that a film counts with, so that none waits more than 16 times longer than another.
const LEAST_SHARE: f32 = 1.0 / 16.0;

/// Stepping state of one film, on its entity: the settings and the environment of its steps, and the steps that it is
/// owed.
///
/// The plugin inserts it when the film is ready and keeps it up to date with the [`Coating`]: quality, rate and pause
/// in each frame before the first step is taken, settings whenever they change.
#[derive(Component, Clone, Debug)]
#[component(clone_behavior = Ignore)]
pub struct FilmPace {
    /// Settings with which the film steps.
    pub settings: Arc<CoatingSettings>,
    /// Quality of the solver that bends the film.
    pub quality: SolverQuality,
    /// Factor on the speed of the clock.
    pub rate: f64,
    /// Whether the film takes no steps, not even requested ones.
    pub paused: bool,
    /// Gravity and weather in the film's space, renewed every frame.
    pub environment: Environment,
    /// Steps [requested](Self::request_steps) of this film since the last frame. The next frame sets this to 0.
    pub requested_steps: u64,
    /// Weather of the prop, if it has one of its own.
    pub(crate) weather: Option<CoatingWeather>,
    /// Steps that the film is owed, and those that it has taken in this frame.
    pub(crate) account: StepAccount,
    /// Steps planned in this frame.
    pub(crate) planned: u64,
    /// Whether the film has steps to take, but waits until its exposure to rain and sun is known.
    pub(crate) held: bool,
    /// Whether the film is on its way to another age, and takes no steps.
    pub(crate) travels: bool,
    /// Whether the film takes the step that is under way.
    pub(crate) due: bool,
    /// Whether the first vertex that let go has been reported.
    pub(crate) separated: bool,
    /// Whether the first crack has been reported.
    pub(crate) cracked: bool,
    /// Centre and radius of a sphere around the film at rest, in its own space.
    pub(crate) bounds: (Vec3, f32),
    /// Priority that the film has gained while it was postponed.
    pub(crate) credit: f32,
    /// Whether the film takes no steps in this frame because the budget has no time for it.
    pub(crate) postponed: bool,
    /// Assumed cost of a step, in moving vertices.
    pub(crate) cost: u64,
}

impl FilmPace {
    /// Returns the pace of a film that has taken no steps.
    pub(crate) fn new(settings: Arc<CoatingSettings>) -> Self {
        Self {
            settings,
            quality: SolverQuality::default(),
            rate: 1.0,
            paused: false,
            environment: Environment::default(),
            requested_steps: 0,
            weather: None,
            account: StepAccount::default(),
            planned: 0,
            held: false,
            travels: false,
            due: false,
            separated: false,
            cracked: false,
            bounds: (Vec3::ZERO, 0.0),
            credit: 0.0,
            postponed: false,
            cost: 0,
        }
    }

    /// Takes what has happened to a film as told: first messages are about what comes after.
    pub(crate) fn know(&mut self, forces: &FilmForces) {
        self.separated = forces.separations > 0;
        self.cracked = forces.torn_edges > 0;
    }

    /// Requests `steps` further steps of this film alone, also while the clock is paused. A film that is paused itself
    /// takes none. [`CoatingCommands::request_steps`](crate::CoatingCommands::request_steps) does so for all films of
    /// a prop.
    ///
    /// ```
    /// use bevy::prelude::*;
    /// use bevy_coating::{FilmPace, prelude::*};
    ///
    /// fn nudge(mut films: Query<&mut FilmPace>) {
    ///     for mut film in &mut films {
    ///         film.request_steps(5);
    ///     }
    /// }
    /// # let mut app = App::new();
    /// # app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin));
    /// # app.add_plugins(CoatingWeatheringPlugin::default());
    /// app.add_systems(Update, nudge);
    /// app.update();
    /// ```
    pub fn request_steps(&mut self, steps: u64) {
        self.requested_steps = self.requested_steps.saturating_add(steps);
    }

    /// Takes over the pause, the quality and the rate of its coating.
    ///
    /// # Errors
    /// [`CoatingFault::Field`] if the rate is out of range; then the film keeps the rate that it has.
    pub(crate) fn follow(&mut self, coating: &Coating) -> Result<(), CoatingFault> {
        (self.paused, self.quality) = (coating.paused, coating.quality);
        self.rate = coating.checked_rate()?;
        Ok(())
    }

    /// Returns the size of the film at `transform` in the view of the nearest of the cameras at `eyes`: its radius over
    /// its distance, from [`LEAST_SHARE`] to 1. Without cameras it is 1.
    pub(crate) fn share_of_view(&self, transform: &GlobalTransform, eyes: &[Vec3]) -> f32 {
        let (middle, radius) = self.sphere(transform);
        let nearest = eyes.iter().map(|eye| eye.distance(middle)).reduce(f32::min);
        let share = nearest.map_or(1.0, |distance| radius / distance);
        // A film without extent at a camera gives NaN, which counts as the least.
        if share > LEAST_SHARE { share.min(1.0) } else { LEAST_SHARE }
    }

    /// Returns centre and radius of a sphere around the film at `transform`, in the world.
    pub(crate) fn sphere(&self, transform: &GlobalTransform) -> (Vec3, f32) {
        let (_, rotation, translation) = transform.to_scale_rotation_translation();
        (translation + rotation * self.bounds.0, self.bounds.1)
    }

    /// Returns whether the film is on its way to another age, or to a saved state: then it takes no steps.
    pub fn is_travelling(&self) -> bool {
        self.travels
    }

    /// Returns whether the film takes the step that is under way. Systems in
    /// [`CoatingStep`](super::system_sets::CoatingStep) skip the films for which it is false.
    ///
    /// ```
    /// use bevy::prelude::*;
    /// use bevy_coating::{FilmPace, prelude::*};
    ///
    /// /// Notes when each film last took a step.
    /// fn note_age(films: Query<(&FilmPace, &FilmClock)>) {
    ///     for (_, clock) in films.iter().filter(|(pace, _)| pace.is_due()) {
    ///         debug!("a film is {:.3} old", clock.age());
    ///     }
    /// }
    ///
    /// # let mut app = App::new();
    /// # app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin));
    /// # app.add_plugins(CoatingWeatheringPlugin::default());
    /// app.add_systems(CoatingStep, note_age.after(CoatingSystems::Report));
    /// app.update();
    /// ```
    pub fn is_due(&self) -> bool {
        self.due
    }
}
