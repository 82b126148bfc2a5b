//! All that most games need: `use bevy_coating::prelude::*;`

pub use crate::{
    deform::SolverQuality,
    film::build::{BuildWarning, FilmResolution},
    plugin::{
        CoatedBy, Coating, CoatingBudget, CoatingClock, CoatingError, CoatingFault, CoatingGravity, CoatingStatus,
        CoatingStep, CoatingSystems, CoatingWeather, CoatingWeatheringPlugin, FilmFailed, FilmReady, FirstCrack,
        MetalLook, PieceFallen, RainShelter, SettingsSource, Shelter, StainDisplay,
    },
    settings::CoatingSettings,
    shown::look::StainLook,
    sim::FilmClock,
};
