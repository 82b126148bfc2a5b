//! Explains how to use the crate, one topic a page.
//!
//! | page | topic |
//! |---|---|
//! | [`getting_started`] | a first prop, glTF scenes, the clock, messages, components |
//! | [`recipes`] | short answers to "how do I ...", with code |
//! | [`choosing`] | which grain, resolution and level for which prop, and what they cost |
//! | [`troubleshooting`] | what to do, by what you see and by what the log says |
//! | [`settings`] | every setting with its default and range, files, presets |
//! | [`masks`] | where paint is weak or dirty from the start; custom properties of models |
//! | [`stains`] | rust, dust and moisture, weather, shelter, colours |
//! | [`touching`] | shooting, washing, painting again; brushes, undo, debris |
//! | [`panel`] | a panel for all settings, heat maps, gizmos |
//! | [`baking`] | ageing model files without an engine |
//! | [`ratings`] | what lies where on a film, shares by area, ratings by ISO and ASTM |
//! | [`saving`] | saving and restoring films, going back in time, props that come late |
//! | [`performance`] | measured times, quality levels |
//! | [`bad_input`] | what happens to input that is wrong, and the test of each kind |
//! | [`limits`] | which meshes are taken, and what is not simulated |
//! | [`browser`] | what is different where one thread does everything |
//! | [`how_it_works`] | words, the stages, and where each comes from in the paper |
//! | [`migration`] | what becomes of code that was written for an earlier state |
//! | [`porting`] | what a new release of Bevy takes |
//!
//! The same pages lie in the folder `docs` of the repository. Pages whose examples need the engine are empty without
//! the feature `plugin` (that of the panel without the feature `panel`).

/// Destinations of the links between the pages. The pages define them too, as files, but the first definition counts.
macro_rules! links {
    () => {
        "[getting started]: crate::guide::getting_started
[recipes]: crate::guide::recipes
[choosing]: crate::guide::choosing
[troubleshooting]: crate::guide::troubleshooting
[settings]: crate::guide::settings
[masks]: crate::guide::masks
[stains]: crate::guide::stains
[touching]: crate::guide::touching
[panel]: crate::guide::panel
[baking]: crate::guide::baking
[ratings]: crate::guide::ratings
[saving]: crate::guide::saving
[performance]: crate::guide::performance
[limits]: crate::guide::limits
[bad input]: crate::guide::bad_input
[browser]: crate::guide::browser
[how it works]: crate::guide::how_it_works
[migration]: crate::guide::migration
[porting]: crate::guide::porting
"
    };
}

#[doc = links!()]
#[cfg_attr(feature = "plugin", doc = include_str!("../docs/getting_started.md"))]
#[cfg_attr(not(feature = "plugin"), doc = "Needs the feature `plugin`.")]
pub mod getting_started {}

#[doc = links!()]
#[cfg_attr(feature = "render", doc = include_str!("../docs/recipes.md"))]
#[cfg_attr(not(feature = "render"), doc = "Needs the feature `render`.")]
pub mod recipes {}

#[doc = links!()]
#[cfg_attr(feature = "plugin", doc = include_str!("../docs/choosing.md"))]
#[cfg_attr(not(feature = "plugin"), doc = "Needs the feature `plugin`.")]
pub mod choosing {}

#[doc = links!()]
#[cfg_attr(feature = "plugin", doc = include_str!("../docs/troubleshooting.md"))]
#[cfg_attr(not(feature = "plugin"), doc = "Needs the feature `plugin`.")]
pub mod troubleshooting {}

#[doc = links!()]
#[doc = include_str!("../docs/settings.md")]
pub mod settings {}

#[doc = links!()]
#[doc = include_str!("../docs/masks.md")]
pub mod masks {}

#[doc = links!()]
#[cfg_attr(feature = "plugin", doc = include_str!("../docs/stains.md"))]
#[cfg_attr(not(feature = "plugin"), doc = "Needs the feature `plugin`.")]
pub mod stains {}

#[doc = links!()]
#[cfg_attr(feature = "plugin", doc = include_str!("../docs/touching.md"))]
#[cfg_attr(not(feature = "plugin"), doc = "Needs the feature `plugin`.")]
pub mod touching {}

#[doc = links!()]
#[cfg_attr(feature = "panel", doc = include_str!("../docs/panel.md"))]
#[cfg_attr(not(feature = "panel"), doc = "Needs the feature `panel`.")]
pub mod panel {}

#[doc = links!()]
#[doc = include_str!("../docs/baking.md")]
pub mod baking {}

#[doc = links!()]
#[cfg_attr(feature = "plugin", doc = include_str!("../docs/ratings.md"))]
#[cfg_attr(not(feature = "plugin"), doc = "Needs the feature `plugin`.")]
pub mod ratings {}

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
#[doc = include_str!("../docs/browser.md")]
pub mod browser {}

#[doc = links!()]
#[doc = include_str!("../docs/how_it_works.md")]
pub mod how_it_works {}

#[doc = links!()]
#[doc = include_str!("../docs/migration.md")]
pub mod migration {}

#[doc = links!()]
#[doc = include_str!("../docs/porting.md")]
pub mod porting {}
