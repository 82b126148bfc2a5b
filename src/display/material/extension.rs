//! Defines [`StainExtension`], which draws stains over a standard material.

use bevy::{
    asset::Asset,
    mesh::{MeshVertexAttribute, MeshVertexBufferLayoutRef},
    pbr::{ExtendedMaterial, MaterialExtension, MaterialExtensionKey, MaterialExtensionPipeline, StandardMaterial},
    reflect::prelude::*,
    render::render_resource::{AsBindGroup, RenderPipelineDescriptor, SpecializedMeshPipelineError},
    shader::ShaderRef,
};

use super::{uniform::StainUniform, view::StainView};
use crate::{
    appearance::shading::{FilmShading, StainPart, StainPattern},
    display::mesh::{ATTRIBUTE_REST, ATTRIBUTE_REST_NORMAL, ATTRIBUTE_STAINS},
};

/// Asset path of the embedded shader.
const SHADER: &str = "embedded://bevy_coating/display/material/weathering.wgsl";

/// Vertex attributes of the shader and their locations, which are free in Bevy's forward and prepass layouts.
const ATTRIBUTES: [(MeshVertexAttribute, u32); 3] =
    [(ATTRIBUTE_STAINS, 8), (ATTRIBUTE_REST, 9), (ATTRIBUTE_REST_NORMAL, 10)];

/// Standard material that draws stains over its surface.
pub type StainedMaterial = ExtendedMaterial<StandardMaterial, StainExtension>;

/// Extension of `StandardMaterial` that draws stains.
///
/// The plugin puts it on coated props. It can also be used for other meshes that have the attributes
/// [`ATTRIBUTE_STAINS`], [`ATTRIBUTE_REST`], [`ATTRIBUTE_REST_NORMAL`] and normals.
///
/// ```
/// use bevy::prelude::*;
/// use bevy_coating::{StainExtension, StainedMaterial, appearance::shading::StainPart};
///
/// let bare_metal = StainedMaterial {
///     base: StandardMaterial::default(),
///     extension: StainExtension { part: StainPart::Metal, ..StainExtension::default() },
/// };
/// # assert_eq!(StainExtension::default().part, StainPart::Film);
/// ```
#[derive(Asset, AsBindGroup, Reflect, Clone, Debug, Default, PartialEq)]
#[data(50, StainUniform, binding_array(101))]
#[bindless(index_table(range(50..51), binding(100)))]
#[bind_group_data(StainPart)]
#[reflect(Default, Debug, Clone, PartialEq)]
#[type_path = "bevy_coating::display::material"]
pub struct StainExtension {
    /// Kind of the surface. Stains on [`Film`](StainPart::Film) and [`Back`](StainPart::Back) lie over the standard
    /// material; [`Metal`](StainPart::Metal) replaces it by the metal of [`shading`](Self::shading). Default: `Film`.
    pub part: StainPart,
    /// Colours and strengths of stains and metal.
    pub shading: FilmShading,
    /// Placement of the patterns.
    pub pattern: StainPattern,
    /// Quantity that is drawn. Default: [`StainView::Lit`].
    pub view: StainView,
    /// Whether only the alpha counts of the standard material's base colour texture and of vertex colours, as for backs
    /// and metal under paint with an alpha mask. Default false.
    pub alpha_only: bool,
}

impl From<&StainExtension> for StainUniform {
    fn from(from: &StainExtension) -> Self {
        Self::new(from.view, from.alpha_only, &from.shading, &from.pattern)
    }
}

/// Gives each kind of part a pipeline of its own, so that none computes the patterns of the others.
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
