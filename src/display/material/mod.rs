//! Draws stains as an extension of `StandardMaterial`.
//!
//! The prop's own material keeps all of its features. Over it the shader draws run-off, dust, water and rusted metal,
//! from the vertex attributes [`ATTRIBUTE_STAINS`], [`ATTRIBUTE_REST`] and [`ATTRIBUTE_REST_NORMAL`], and from noise
//! whose grains have sizes in metres.
//!
//! The shader is embedded, so with Bevy's `embedded_watcher` it can be edited while a game runs. It draws the forward
//! and deferred passes. The prepass and shadows, in which stains cannot be seen, are drawn by Bevy's own shaders.
//!
//! [`ATTRIBUTE_STAINS`]: crate::display::mesh::ATTRIBUTE_STAINS
//! [`ATTRIBUTE_REST`]: crate::display::mesh::ATTRIBUTE_REST
//! [`ATTRIBUTE_REST_NORMAL`]: crate::display::mesh::ATTRIBUTE_REST_NORMAL

pub(super) mod dress;
pub(super) mod extension;
pub(super) mod follow;
pub(super) mod ready;
mod uniform;
pub(super) mod view;

use bevy::{
    app::App,
    asset::embedded_asset,
    pbr::{MaterialPlugin, PbrPlugin},
    render::RenderApp,
    shader::load_shader_library,
};

use extension::StainedMaterial;

/// Returns whether there is a renderer with materials.
pub(super) fn can_draw(app: &App) -> bool {
    app.get_sub_app(RenderApp).is_some() && app.is_plugin_added::<PbrPlugin>()
}

/// Returns whether [`add_material`] has added the material.
pub(super) fn is_added(app: &App) -> bool {
    app.is_plugin_added::<MaterialPlugin<StainedMaterial>>()
}

/// Adds the material and its shaders if there is a renderer, and returns whether there is.
pub(super) fn add_material(app: &mut App) -> bool {
    if !can_draw(app) {
        return false;
    }
    load_shader_library!(app, "noise.wgsl");
    load_shader_library!(app, "shading.wgsl");
    embedded_asset!(app, "weathering.wgsl");
    app.add_plugins(MaterialPlugin::<StainedMaterial>::default());
    true
}
