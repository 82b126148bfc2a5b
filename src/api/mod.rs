//! Defines the types that users of the plugin name: components, resources, messages, errors and system sets.
//!
//! The types hold data and check it. The systems that work on them are in `attach`, `stepping`, `shelter` and
//! `display`.

pub(crate) mod assets;
pub(crate) mod budget;
pub(crate) mod calendar;
pub(crate) mod clock;
pub(crate) mod coating;
pub(crate) mod debris;
pub mod diagnostics;
pub(crate) mod display_cost;
pub(crate) mod error;
pub(crate) mod exclude;
pub(crate) mod film_pace;
pub(crate) mod heat_map_view;
pub(crate) mod history;
pub(crate) mod limits;
pub(crate) mod links;
pub(crate) mod masks;
pub(crate) mod messages;
pub(crate) mod outline;
pub(crate) mod paint;
pub(crate) mod seed;
pub(crate) mod shelter;
pub(crate) mod snapshot;
pub(crate) mod stain_display;
pub(crate) mod status;
pub(crate) mod step_account;
pub(crate) mod summary;
pub(crate) mod system_sets;
pub(crate) mod turn;
pub(crate) mod unit;
pub(crate) mod weather;
