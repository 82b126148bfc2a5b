//! Shared by the examples that show something: a scene that ages in a window, in pictures, or, where nothing can be
//! drawn, as models.
//!
//! ```text
//! cli --> graphics: adapter? --no--> bare: aged models and figures
//!                      | yes
//!                   display? --no--> headless: a PNG for every shot, or (animation) one GIF of them all
//!                      | yes
//!                    window: orbit camera, keys, read-out
//! ```
//!
//! [`scene::Scene`] takes this way. The example itself brings a [`sky::Sky`] (or takes the [`studio`]'s), its views,
//! and its props, each with a [`paint::Paint`]; [`wall`] is what exhibits hang before.

#![allow(dead_code, reason = "each example includes this folder as a module and uses a part of it")]

pub mod animation;
pub mod bare;
pub mod camera;
pub mod cli;
pub mod graphics;
pub mod headless;
pub mod keys;
pub mod label;
pub mod paint;
pub mod picture;
pub mod scene;
pub mod sky;
pub mod studio;
pub mod wall;
pub mod window;
