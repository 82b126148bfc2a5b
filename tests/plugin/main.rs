//! The plugin from outside: apps without a window, stepped frame by frame, and pictures of them.
//!
//! One binary, since each would link the engine. Pools of threads and the logger are those of the process: a test that
//! needs its own starts this program again (`assert_same_on_any_number_of_threads`).

#[path = "../common/mod.rs"]
mod common;
#[path = "../common/sky.rs"]
mod sky;
#[cfg(feature = "render")]
#[path = "../common/stained.rs"]
mod stained;
#[cfg(feature = "render")]
#[path = "../common/studio.rs"]
mod studio;

mod ageing;
mod attach;
mod budget;
mod clock;
mod clones;
mod detail;
mod display;
mod edits;
#[cfg(feature = "tools")]
mod gizmos;
mod grain;
mod groups;
#[cfg(feature = "render")]
mod heat;
#[cfg(feature = "render")]
mod mask_picture;
#[cfg(feature = "render")]
mod outline;
#[cfg(feature = "panel")]
mod panel;
#[cfg(feature = "render")]
mod parts;
#[cfg(feature = "render")]
mod picture;
mod rebuilding;
mod recovery;
mod rest;
mod saving;
mod seeds;
mod settings;
mod shelter;
mod soak;
mod stain_display;
mod stains;
#[cfg(feature = "render")]
mod stains_age;
#[cfg(feature = "render")]
mod stains_material;
#[cfg(feature = "render")]
mod stains_picture;
mod timeline;
mod units;
