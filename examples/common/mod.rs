//! Shared by the examples: props read from files, aged without a window or a graphics adapter, and written as
//! a model that other programs read.
//!
//! ```text
//! Input --read--> Model --bake--> Baked --> glb (aged model), stats (figures), dump (vertices) --> Staged files
//! ```
//!
//! ```ignore
//! #[path = "../common/mod.rs"]
//! mod common;
//!
//! let stopwatch = common::Stopwatch::start();
//! let model = common::read(&common::Input::File("sign.glb".into()), 0, true)?;
//! let mut baked = common::bake(model, &common::BakeOptions::default(), stopwatch, &())?;
//! let mut files = common::Staged::default();
//! files.add("aged.glb", &common::aged_glb(&mut baked, common::StainOutput::default())?)?;
//! files.add("aged.json", baked.stats().to_json().as_bytes())?;
//! files.commit()?;
//! ```

#![allow(dead_code, unused_imports, reason = "each example includes this folder as a module and uses a part of it")]

mod bake;
mod base64;
mod dump;
mod error;
mod glb;
mod gltf;
mod input;
mod model;
mod obj;
mod output;
mod parallel;
mod props;
mod shelter;
mod stained;
mod stats;
mod stopwatch;

pub use bake::{BakeOptions, Baked, Progress, bake};
pub use dump::dump_csv;
pub use error::BakeError;
pub use glb::aged_glb;
pub use input::{Generator, Input, read};
pub use model::{Image, MaterialLibrary, Model, ModelMesh, Slot};
pub use output::Staged;
pub use props::{Coated, Coating as CoatedWith, MAX_TRIANGLES, Resolution, coat};
pub use stained::{StainOutput, TEXTURE_SIZES};
pub use stats::Stats;
pub use stopwatch::Stopwatch;
