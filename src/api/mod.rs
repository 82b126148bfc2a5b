//! The types that users name: what they put on props, the clock and the weather they set, and what the plugin tells them.
//!
//! Everything here is data with checks; the systems are in the rooms above.

pub(crate) mod assets;
pub(crate) mod budget;
pub(crate) mod clock;
pub(crate) mod coating;
pub mod diagnostics;
pub(crate) mod error;
pub(crate) mod film_pace;
pub(crate) mod links;
pub(crate) mod messages;
pub(crate) mod shelter;
pub(crate) mod stain_display;
pub(crate) mod status;
pub(crate) mod system_sets;
pub(crate) mod weather;
