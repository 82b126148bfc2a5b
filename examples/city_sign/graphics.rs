//! What this machine can show. Asked before the engine starts, which panics where it finds no adapter.

use bevy::prelude::*;
use bevy::render::renderer::{RenderInstance, WgpuWrapper};
use bevy::render::settings::{Backends, WgpuSettings};
use bevy::tasks::block_on;
use std::sync::Arc;

/// Whether there is an adapter the engine could draw with, be it a software renderer.
pub fn adapter_exists() -> bool {
    // Every backend that may be used, as the engine itself would choose (`WGPU_BACKEND` counts).
    let backends = WgpuSettings::default().backends.unwrap_or(Backends::empty());
    let instance = RenderInstance(Arc::new(WgpuWrapper::new(Default::default())));
    !block_on(instance.enumerate_adapters(backends)).is_empty()
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
