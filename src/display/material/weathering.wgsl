// Draws stains on a standard material, in the forward and the deferred pass. The prepass and shadows use Bevy's own
// shaders, as nothing here moves vertices or cuts holes.
#import bevy_coating::shading::{StainSample, StainUniform, SurfaceShading, stained}
#import bevy_pbr::{
    mesh_bindings::mesh,
    mesh_functions,
    pbr_bindings,
    pbr_types,
    pbr_functions::alpha_discard,
    pbr_fragment::pbr_input_from_standard_material,
    decal::clustered::apply_decals,
    view_transformations::position_world_to_clip,
}

#ifdef PREPASS_PIPELINE
#import bevy_pbr::{
    prepass_io::{Vertex, VertexOutput, FragmentOutput},
    pbr_deferred_functions::deferred_output,
}
#else
#import bevy_pbr::{
    forward_io::{Vertex, VertexOutput, FragmentOutput},
    pbr_functions::{apply_pbr_lighting, main_pass_post_lighting_processing},
}
#endif

#ifdef VISIBILITY_RANGE_DITHER
#import bevy_pbr::pbr_functions::visibility_range_dither
#endif

#ifdef OIT_ENABLED
#import bevy_core_pipeline::oit::oit_draw
#endif

#ifdef BINDLESS
// Many materials in one bind group, so that Bevy draws many props at once. Of each, where its uniform is.
struct StainIndices {
    stain: u32,
}
@group(#{MATERIAL_BIND_GROUP}) @binding(100) var<storage> stain_indices: array<StainIndices>;
@group(#{MATERIAL_BIND_GROUP}) @binding(101) var<storage> stain_array: array<StainUniform>;
#else
@group(#{MATERIAL_BIND_GROUP}) @binding(50) var<uniform> stain_uniform: StainUniform;
#endif

const VIEW_SURFACE: u32 = 2u;
const VIEW_NORMAL: u32 = 3u;

// Values from vertex to fragment shader besides Bevy's own, at locations that are free in both passes.
struct StainVarying {
    @location(10) stains: vec4<f32>,
    @location(11) rest: vec3<f32>,
    @location(12) rest_normal: vec3<f32>,
}

// Bevy's `VertexOutput` of the pass together with `StainVarying`; structs with locations cannot be nested.
struct StainedOutput {
    @builtin(position) position: vec4<f32>,
#ifdef PREPASS_PIPELINE
#ifdef VERTEX_UVS_A
    @location(0) uv: vec2<f32>,
#endif
#ifdef VERTEX_UVS_B
    @location(1) uv_b: vec2<f32>,
#endif
    @location(2) world_normal: vec3<f32>,
#ifdef VERTEX_TANGENTS
    @location(3) world_tangent: vec4<f32>,
#endif
    @location(4) world_position: vec4<f32>,
#ifdef MOTION_VECTOR_PREPASS
    @location(5) previous_world_position: vec4<f32>,
#endif
    @location(7) instance_index: u32,
#ifdef VERTEX_COLORS
    @location(8) color: vec4<f32>,
#endif
#ifdef VISIBILITY_RANGE_DITHER
    @location(9) @interpolate(flat) visibility_range_dither: i32,
#endif
#else
    @location(0) world_position: vec4<f32>,
    @location(1) world_normal: vec3<f32>,
#ifdef VERTEX_UVS_A
    @location(2) uv: vec2<f32>,
#endif
#ifdef VERTEX_UVS_B
    @location(3) uv_b: vec2<f32>,
#endif
#ifdef VERTEX_TANGENTS
    @location(4) world_tangent: vec4<f32>,
#endif
#ifdef VERTEX_COLORS
    @location(5) color: vec4<f32>,
#endif
    @location(6) @interpolate(flat) instance_index: u32,
#ifdef VISIBILITY_RANGE_DITHER
    @location(7) @interpolate(flat) visibility_range_dither: i32,
#endif
#endif
    @location(10) stains: vec4<f32>,
    @location(11) rest: vec3<f32>,
    @location(12) rest_normal: vec3<f32>,
}

@vertex
fn vertex(
    in: Vertex,
    @location(8) stains: vec4<f32>,
    @location(9) rest: vec3<f32>,
    @location(10) rest_normal: vec3<f32>,
) -> StainedOutput {
    var out: StainedOutput;
    let world_from_local = mesh_functions::get_world_from_local(in.instance_index);
    out.world_position = mesh_functions::mesh_position_local_to_world(world_from_local, vec4<f32>(in.position, 1.0));
    out.position = position_world_to_clip(out.world_position.xyz);
    out.world_normal = mesh_functions::mesh_normal_local_to_world(in.normal, in.instance_index);
#ifdef VERTEX_UVS_A
    out.uv = in.uv;
#endif
#ifdef VERTEX_UVS_B
    out.uv_b = in.uv_b;
#endif
#ifdef VERTEX_TANGENTS
    out.world_tangent = mesh_functions::mesh_tangent_local_to_world(world_from_local, in.tangent, in.instance_index);
#endif
#ifdef VERTEX_COLORS
    out.color = in.color;
#endif
#ifdef PREPASS_PIPELINE
#ifdef MOTION_VECTOR_PREPASS
    out.previous_world_position = mesh_functions::mesh_position_local_to_world(
        mesh_functions::get_previous_world_from_local(in.instance_index),
        vec4<f32>(in.position, 1.0),
    );
#endif
#endif
    out.instance_index = in.instance_index;
#ifdef VISIBILITY_RANGE_DITHER
    out.visibility_range_dither =
        mesh_functions::get_visibility_range_dither_level(in.instance_index, world_from_local[3]);
#endif
    out.stains = stains;
    out.rest = rest;
    out.rest_normal = rest_normal;
    return out;
}

// Tilts the normal `n` by the slope of the height (Mikkelsen 2010, without texture coordinates). The slope is per metre
// at rest; the changes of rest and world position from pixel to pixel relate it to the surface in the world.
fn bumped(
    n: vec3<f32>,
    slope: vec3<f32>,
    rest_x: vec3<f32>,
    rest_y: vec3<f32>,
    world_x: vec3<f32>,
    world_y: vec3<f32>,
) -> vec3<f32> {
    let r_x = cross(world_y, n);
    let r_y = cross(n, world_x);
    let det = dot(world_x, r_x);
    let along = sign(det) * (dot(slope, rest_x) * r_x + dot(slope, rest_y) * r_y);
    let bent = abs(det) * n - along;
    return select(n, normalize(bent), dot(bent, bent) > 0.0);
}

@fragment
fn fragment(in: VertexOutput, extra: StainVarying, @builtin(front_facing) is_front: bool) -> FragmentOutput {
    // Derivatives must be taken before any pixel is discarded.
    let rest_x = dpdx(extra.rest);
    let rest_y = dpdy(extra.rest);
    let world_x = dpdx(in.world_position.xyz);
    let world_y = dpdy(in.world_position.xyz);
#ifdef VISIBILITY_RANGE_DITHER
    visibility_range_dither(in.position, in.visibility_range_dither);
#endif
#ifdef BINDLESS
    let slot = mesh[in.instance_index].material_and_lightmap_bind_group_slot & 0xffffu;
    let stain = stain_array[stain_indices[slot].stain];
    let own_color = pbr_bindings::material_array[pbr_bindings::material_indices[slot].material].base_color;
#else
    let stain = stain_uniform;
    let own_color = pbr_bindings::material.base_color;
#endif
    var pbr = pbr_input_from_standard_material(in, is_front);
    pbr.material.base_color = alpha_discard(pbr.material, pbr.material.base_color);

    let s = StainSample(
        extra.stains.x,
        extra.stains.y,
        extra.stains.z,
        extra.stains.w,
        extra.rest,
        extra.rest_normal,
        sqrt(length(rest_x) * length(rest_y)),
    );
    var base: SurfaceShading;
    base.base_color = pbr.material.base_color.rgb;
    if stain.alpha_only != 0u {
        base.base_color = own_color.rgb;
    }
    base.metallic = pbr.material.metallic;
    base.roughness = pbr.material.perceptual_roughness;
    base.reflectance = pbr.material.reflectance;
    base.slope = vec3<f32>(0.0);
    let shading = stained(stain, base, s);
    pbr.material.base_color = vec4<f32>(shading.base_color, pbr.material.base_color.a);
    pbr.material.metallic = shading.metallic;
    pbr.material.perceptual_roughness = shading.roughness;
    pbr.material.reflectance = shading.reflectance;
    if any(shading.slope != vec3<f32>(0.0)) {
        pbr.N = bumped(pbr.N, shading.slope, rest_x, rest_y, world_x, world_y);
    }
    // Dirt hides emissive light and the clear coat.
    let bare = 1.0 - min(max(s.dust, 1.0 - exp(-3.0 * s.rust)), 1.0);
    pbr.material.emissive = vec4<f32>(pbr.material.emissive.rgb * bare, pbr.material.emissive.a);
    pbr.material.clearcoat *= bare;
    apply_decals(&pbr);

    if stain.view != 0u {
        var viewed = shading.base_color;
        if stain.view == VIEW_SURFACE {
            viewed = vec3<f32>(shading.metallic, shading.roughness, shading.reflectance.x);
        } else if stain.view == VIEW_NORMAL {
            viewed = pbr.N * 0.5 + 0.5;
        }
        pbr.material.base_color = vec4<f32>(viewed, 1.0);
        pbr.material.flags |= pbr_types::STANDARD_MATERIAL_FLAGS_UNLIT_BIT;
    }

#ifdef PREPASS_PIPELINE
    return deferred_output(in, pbr);
#else
    var out: FragmentOutput;
    if (pbr.material.flags & pbr_types::STANDARD_MATERIAL_FLAGS_UNLIT_BIT) == 0u {
        out.color = apply_pbr_lighting(pbr);
    } else {
        out.color = pbr.material.base_color;
    }
    out.color = main_pass_post_lighting_processing(pbr, out.color);
#ifdef OIT_ENABLED
    let alpha_mode = pbr.material.flags & pbr_types::STANDARD_MATERIAL_FLAGS_ALPHA_MODE_RESERVED_BITS;
    if alpha_mode != pbr_types::STANDARD_MATERIAL_FLAGS_ALPHA_MODE_OPAQUE {
        oit_draw(in.position, out.color);
        discard;
    }
#endif
    return out;
#endif
}
