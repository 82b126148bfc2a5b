//! Stains as an extension of `StandardMaterial`: everything that the prop's own material does goes on working, and the
//! shader draws run-off, dust, water and rusted metal over it, from the fields in the mesh
//! ([`ATTRIBUTE_STAINS`], [`ATTRIBUTE_REST`], [`ATTRIBUTE_REST_NORMAL`]) and noise in metres.
//!
//! The shader is embedded, so with Bevy's `embedded_watcher` it can be edited while a game runs. Forward and deferred
//! passes are drawn by it; prepass and shadows, in which nothing of this can be seen, by Bevy's own shaders.

mod dress;
mod follow;
mod uniform;

use bevy::{
    app::App,
    asset::{Asset, embedded_asset},
    mesh::{MeshVertexAttribute, MeshVertexBufferLayoutRef},
    pbr::{MaterialExtension, MaterialExtensionKey, MaterialExtensionPipeline, MaterialPlugin, PbrPlugin},
    prelude::*,
    render::{
        RenderApp,
        render_resource::{AsBindGroup, RenderPipelineDescriptor, SpecializedMeshPipelineError},
    },
    shader::{ShaderRef, load_shader_library},
};

pub use dress::CoatedMaterial;
pub(super) use dress::{dress_props, undress_props};
pub(super) use follow::{follow_paint, follow_standard_materials};
pub(crate) use uniform::StainUniform;
pub use uniform::StainedMaterial;

use crate::{
    appearance::shading::{FilmShading, StainPart, StainPattern},
    display::mesh::{ATTRIBUTE_REST, ATTRIBUTE_REST_NORMAL, ATTRIBUTE_STAINS},
};
/// Where the shader is among embedded assets.
const SHADER: &str = "embedded://bevy_coating/display/material/weathering.wgsl";

/// What the shader needs of a vertex, and where: at locations that are free in Bevy's forward and prepass layouts.
const ATTRIBUTES: [(MeshVertexAttribute, u32); 3] =
    [(ATTRIBUTE_STAINS, 8), (ATTRIBUTE_REST, 9), (ATTRIBUTE_REST_NORMAL, 10)];

/// Stains on a `StandardMaterial`. Meshes that wear it need [`ATTRIBUTE_STAINS`], [`ATTRIBUTE_REST`],
/// [`ATTRIBUTE_REST_NORMAL`] and normals.
#[derive(Asset, AsBindGroup, Reflect, Clone, Debug, Default, PartialEq)]
#[uniform(100, StainUniform)]
#[bind_group_data(StainPart)]
#[reflect(Default, Debug, Clone, PartialEq)]
pub struct StainExtension {
    /// What kind of surface it is on. The standard material underneath shows on the film and on its back; metal has a
    /// look of its own.
    pub part: StainPart,
    /// Colours and strengths.
    pub shading: FilmShading,
    /// How the patterns lie.
    pub pattern: StainPattern,
    /// What is drawn. Default: the lit surface.
    pub view: StainView,
}

/// What of a stained surface is drawn: it, or one of the quantities that make it up, for tests and for the curious.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash, Reflect)]
#[reflect(Default, Debug, Clone, PartialEq, Hash)]
pub enum StainView {
    /// The lit surface.
    #[default]
    Lit,
    /// Its base colour, unlit.
    BaseColor,
    /// Metalness, roughness and reflectance as red, green and blue.
    Surface,
    /// Its normal in the world, from -1 to 1 in each channel.
    Normal,
}

impl From<&StainExtension> for StainUniform {
    fn from(from: &StainExtension) -> Self {
        Self::new(from.view, &from.shading, &from.pattern)
    }
}

/// A pipeline for each part: none carries the others' patterns.
impl From<&StainExtension> for StainPart {
    fn from(from: &StainExtension) -> Self {
        from.part
    }
}

impl MaterialExtension for StainExtension {
    fn vertex_shader() -> ShaderRef {
        SHADER.into()
    }

    fn fragment_shader() -> ShaderRef {
        SHADER.into()
    }

    fn deferred_vertex_shader() -> ShaderRef {
        SHADER.into()
    }

    fn deferred_fragment_shader() -> ShaderRef {
        SHADER.into()
    }

    /// Adds the stains to the vertex attributes of each pass, whatever else it has.
    fn specialize(
        _pipeline: &MaterialExtensionPipeline,
        descriptor: &mut RenderPipelineDescriptor,
        layout: &MeshVertexBufferLayoutRef,
        key: MaterialExtensionKey<Self>,
    ) -> Result<(), SpecializedMeshPipelineError> {
        let part = match key.bind_group_data {
            StainPart::Film => "STAIN_FILM",
            StainPart::Back => "STAIN_BACK",
            StainPart::Metal => "STAIN_METAL",
        };
        descriptor.vertex.shader_defs.push(part.into());
        if let Some(fragment) = &mut descriptor.fragment {
            fragment.shader_defs.push(part.into());
        }
        let ours = ATTRIBUTES.map(|(attribute, location)| attribute.at_shader_location(location));
        let ours = layout.0.get_layout(&ours)?;
        if let Some(buffer) = descriptor.vertex.buffers.first_mut() {
            buffer.attributes.extend(ours.attributes);
        }
        Ok(())
    }
}

/// Whether there is a renderer that knows materials.
pub(super) fn can_draw(app: &App) -> bool {
    app.get_sub_app(RenderApp).is_some() && app.is_plugin_added::<PbrPlugin>()
}

/// Whether [`add_material`] did.
pub(super) fn is_added(app: &App) -> bool {
    app.is_plugin_added::<MaterialPlugin<StainedMaterial>>()
}

/// Adds the material and its shaders, where there is something to draw with; whether there is.
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
