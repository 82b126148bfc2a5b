//! Explains how to use the crate, one topic a page.
//!
//! | page | topic |
//! |---|---|
//! | [`getting_started`] | a first prop, glTF scenes, the clock, messages, components |
//! | [`settings`] | every setting with its default and range, files, presets |
//! | [`stains`] | rust, dust and moisture, weather, shelter, colours |
//! | [`panel`] | a panel for all settings, heat maps, gizmos |
//! | [`baking`] | ageing model files without an engine |
//! | [`saving`] | saving and restoring films, going back in time, props that come late |
//! | [`performance`] | measured times, quality levels |
//! | [`bad_input`] | what happens to input that is wrong, and the test of each kind |
//! | [`limits`] | which meshes are taken, and what is not simulated |
//! | [`how_it_works`] | the stages, and where each comes from in the paper |
//!
//! The same pages lie in the folder `docs` of the repository. Pages whose examples need the engine are empty without
//! the feature `plugin` (that of the panel without the feature `panel`).

/// Destinations of the links between the pages. The pages define them too, as files, but the first definition counts.
macro_rules! links {
    () => {
        "[getting started]: crate::guide::getting_started
[settings]: crate::guide::settings
[stains]: crate::guide::stains
[panel]: crate::guide::panel
[baking]: crate::guide::baking
[saving]: crate::guide::saving
[performance]: crate::guide::performance
[limits]: crate::guide::limits
[bad input]: crate::guide::bad_input
[how it works]: crate::guide::how_it_works
"
    };
}

#[doc = links!()]
#[cfg_attr(feature = "plugin", doc = include_str!("../docs/getting_started.md"))]
#[cfg_attr(not(feature = "plugin"), doc = "Needs the feature `plugin`.")]
pub mod getting_started {}

#[doc = links!()]
#[doc = include_str!("../docs/settings.md")]
pub mod settings {}

#[doc = links!()]
#[cfg_attr(feature = "plugin", doc = include_str!("../docs/stains.md"))]
#[cfg_attr(not(feature = "plugin"), doc = "Needs the feature `plugin`.")]
pub mod stains {}

#[doc = links!()]
#[cfg_attr(feature = "panel", doc = include_str!("../docs/panel.md"))]
#[cfg_attr(not(feature = "panel"), doc = "Needs the feature `panel`.")]
pub mod panel {}

#[doc = links!()]
#[doc = include_str!("../docs/baking.md")]
pub mod baking {}

#[doc = links!()]
#[cfg_attr(feature = "plugin", doc = include_str!("../docs/saving.md"))]
#[cfg_attr(not(feature = "plugin"), doc = "Needs the feature `plugin`.")]
pub mod saving {}

#[doc = links!()]
#[doc = include_str!("../docs/performance.md")]
pub mod performance {}

#[doc = links!()]
#[doc = include_str!("../docs/bad_input.md")]
pub mod bad_input {}

#[doc = links!()]
#[doc = include_str!("../docs/limits.md")]
pub mod limits {}

#[doc = links!()]
#[doc = include_str!("../docs/how_it_works.md")]
pub mod how_it_works {}
