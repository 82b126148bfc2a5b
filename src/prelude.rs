//! Exports the names that most games need: `use bevy_coating::prelude::*;`
//!
//! Further names of the plugin are at the root of the crate, for example `bevy_coating::CoatingAdvance`.

#[cfg(feature = "plugin")]
pub use crate::{
    api::{
        budget::CoatingBudget,
        calendar::CoatingCalendar,
        clock::{CoatingClock, CoatingGravity},
        coating::Coating,
        debris::{CoatingDebris, Flake},
        error::{CoatingError, CoatingFault},
        exclude::CoatingExclude,
        history::CoatingHistory,
        links::{CoatedBy, CoatingFilms},
        masks::CoatingMasks,
        messages::{
            AgeReached, FilmFailed, FilmReady, FilmRepainted, FirstCrack, FirstSeparation, PieceFallen, RatingReached,
            RestoreFailed,
        },
        outline::{PropMask, PropOutline},
        paint::SettingsSource,
        seed::CoatingSeed,
        shelter::{RainShelter, Shelter},
        snapshot::CoatingSnapshot,
        stain_display::StainDisplay,
        status::CoatingStatus,
        summary::FilmSummary,
        system_sets::{CoatingStep, CoatingSystems},
        unit::CoatingUnit,
        weather::{CoatingWeather, PropWeather},
    },
    plugin::CoatingWeatheringPlugin,
    stepping::{TouchAt, TouchCommands},
    timeline::CoatingCommands,
};
pub use crate::{
    appearance::{
        Detail,
        shading::{FilmShading, MetalShading, PrimerShading, StainShading},
    },
    deform::SolverQuality,
    remesh::FilmResolution,
    settings::{CoatingSettings, Preset},
    sim::FilmClock,
    surface::BuildWarning,
};
