//! What this machine can show. Asked before the engine starts, which panics where it finds no adapter.

use bevy::prelude::*;
use bevy::render::RenderPlugin;
use bevy::render::renderer::{RenderInstance, WgpuWrapper};
use bevy::render::settings::{Backends, WgpuSettings};
use bevy::tasks::block_on;
use std::sync::Arc;

/// Backends that the engine's renderer is written for; OpenGL, which `wgpu` would fall back to, is not among
/// them. `WGPU_BACKEND` overrides.
fn backends() -> Backends {
    Backends::from_env().unwrap_or(Backends::PRIMARY)
}

/// Whether there is an adapter the engine could draw with, be it a software renderer.
pub fn adapter_exists() -> bool {
    let instance = RenderInstance(Arc::new(WgpuWrapper::new(Default::default())));
    !block_on(instance.enumerate_adapters(backends())).is_empty()
}

/// The renderer, on those backends. `patient`: pipelines are compiled before they are first used, so that no
/// frame lacks anything.
pub fn renderer(patient: bool) -> RenderPlugin {
    let settings = WgpuSettings { backends: Some(backends()), ..default() };
    RenderPlugin { render_creation: settings.into(), synchronous_pipeline_compilation: patient, ..default() }
}

/// Whether a window can be opened. Only X11 is compiled in on Linux.
pub fn display_exists() -> bool {
    cfg!(not(target_os = "linux")) || std::env::var_os("DISPLAY").is_some_and(|d| !d.is_empty())
}

/// The repository's `assets` folder.
pub const ASSETS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/assets");

/// Where the models are: beside the manifest, also when the program is started from elsewhere.
pub fn assets() -> AssetPlugin {
    AssetPlugin { file_path: ASSETS.into(), ..default() }
}
