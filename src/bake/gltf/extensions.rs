//! Tells which extensions a file may require.

use super::GltfError;

/// Extensions that may be required because they change no triangle, or are read. Materials and textures may have any:
/// what cannot be read of them goes on as it is.
const KNOWN: [&str; 15] = [
    "EXT_mesh_gpu_instancing",
    "EXT_lights_ies",
    "EXT_lights_image_based",
    "KHR_animation_pointer",
    "KHR_audio_emitter",
    "KHR_lights_image_based",
    "KHR_lights_punctual",
    "KHR_mesh_quantization",
    "KHR_node_hoverability",
    "KHR_node_selectability",
    "KHR_node_visibility",
    "KHR_physics_rigid_bodies",
    "KHR_xmp",
    "KHR_xmp_json_ld",
    "MSFT_lod",
];
/// Beginnings of the names of extensions of materials and textures, whoever they are from.
const OF_SURFACES: [&str; 2] = ["materials_", "texture_"];
/// Extensions that compress meshes.
const COMPRESSION: [&str; 4] =
    ["EXT_meshopt_compression", "KHR_draco_mesh_compression", "KHR_meshopt_compression", "WEB3D_quantized_attributes"];

/// Checks the extensions that a file requires.
pub fn check(required: &[String]) -> Result<(), GltfError> {
    for name in required {
        if COMPRESSION.contains(&name.as_str()) {
            return Err(GltfError::Compressed(name.clone()));
        }
        let of_surface =
            name.split_once('_').is_some_and(|(_, own)| OF_SURFACES.iter().any(|start| own.starts_with(start)));
        if !of_surface && !KNOWN.contains(&name.as_str()) {
            return Err(GltfError::Extension(name.clone()));
        }
    }
    Ok(())
}
