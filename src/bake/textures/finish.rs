//! Reads the prop's own materials and samples them, without any stain.

use std::{collections::BTreeMap, sync::Arc};

use bevy_math::{Affine2, Vec2, Vec3, Vec4};
use serde_json::Value;

use super::texture::{MAX_TEXELS, Texture, Wrap};
use crate::{appearance::shading::SurfaceShading, bake::model::MaterialLibrary};

/// Reflectance of glTF's dielectrics, 4 %, as `StandardMaterial` has it.
const REFLECTANCE: f32 = 0.5;

/// Decoded images of a library.
#[derive(Default)]
pub struct Textures {
    /// By number, and whether their colours are sRGB.
    decoded: BTreeMap<(usize, bool), Result<Arc<Texture>, String>>,
    /// Texels of all of them.
    texels: u64,
}

impl Textures {
    fn image(&mut self, library: &MaterialLibrary, source: usize, srgb: bool) -> Result<Arc<Texture>, String> {
        if let Some(known) = self.decoded.get(&(source, srgb)) {
            return known.clone();
        }
        let decoded = library.images.get(source).ok_or_else(|| "an image is missing".into()).and_then(|image| {
            let texture = Texture::decode(image, srgb, MAX_TEXELS.saturating_sub(self.texels));
            texture.map(Arc::new).map_err(|cause| {
                format!("image {} ({source}): {cause}", image.name.as_deref().unwrap_or("without a name"))
            })
        });
        self.texels += decoded.as_ref().map_or(0, |texture| texture.texels());
        self.decoded.insert((source, srgb), decoded.clone());
        decoded
    }
}

/// A material of the prop, without stains.
#[derive(Clone, Debug)]
pub struct Finish {
    base: Vec4,
    metallic: f32,
    roughness: f32,
    normal_scale: f32,
    base_map: Option<Map>,
    surface_map: Option<Map>,
    normal_map: Option<Map>,
    /// Whether alpha means anything.
    pub transparent: bool,
}

/// A texture as a material uses it.
#[derive(Clone, Debug)]
struct Map {
    texture: Arc<Texture>,
    /// First or second coordinates.
    set: usize,
    transform: Affine2,
    wrap: [Wrap; 2],
    nearest: bool,
}

/// A place on the prop's own surface.
#[derive(Clone, Copy, Debug, Default)]
pub struct Place {
    /// First and second texture coordinates.
    pub uvs: [Vec2; 2],
    /// How far each of them goes over one texel of what is baked.
    pub steps: [f32; 2],
    /// Linear vertex colour.
    pub color: Vec4,
}

impl Finish {
    /// Reads a material; `None` is the format's default.
    ///
    /// # Errors
    /// A message that says why it cannot be baked.
    pub fn new(library: &MaterialLibrary, textures: &mut Textures, material: Option<usize>) -> Result<Self, String> {
        let material = material.and_then(|m| library.materials.get(m)).unwrap_or(&Value::Null);
        if !material["extensions"]["KHR_materials_pbrSpecularGlossiness"].is_null() {
            return Err("it is of the specular-glossiness kind".into());
        }
        let pbr = &material["pbrMetallicRoughness"];
        let number = |value: &Value, default: f32| value.as_f64().map_or(default, |x| x as f32);
        let mut map = |value: &Value, srgb: bool| -> Result<Option<Map>, String> {
            if value.is_null() { Ok(None) } else { Map::new(library, textures, value, srgb).map(Some) }
        };
        Ok(Self {
            base: Vec4::from_array(std::array::from_fn(|i| number(&pbr["baseColorFactor"][i], 1.0))),
            metallic: number(&pbr["metallicFactor"], 1.0),
            roughness: number(&pbr["roughnessFactor"], 1.0),
            normal_scale: number(&material["normalTexture"]["scale"], 1.0),
            base_map: map(&pbr["baseColorTexture"], true)?,
            surface_map: map(&pbr["metallicRoughnessTexture"], false)?,
            normal_map: map(&material["normalTexture"], false)?,
            transparent: matches!(material["alphaMode"].as_str(), Some("MASK" | "BLEND")),
        })
    }

    /// Whether it has a colour texture.
    pub fn is_textured(&self) -> bool {
        self.base_map.is_some()
    }

    /// Whether it has a relief of its own.
    pub fn has_relief(&self) -> bool {
        self.normal_map.is_some()
    }

    /// The texture coordinates that its relief uses.
    pub fn relief_set(&self) -> usize {
        self.normal_map.as_ref().map_or(0, |map| map.set)
    }

    /// Shading and alpha.
    pub fn shading(&self, place: &Place) -> (SurfaceShading, f32) {
        let sample = |map: &Option<Map>| map.as_ref().map_or(Vec4::ONE, |map| map.sample(place));
        let color = self.base * sample(&self.base_map) * place.color;
        let surface = sample(&self.surface_map);
        let shading = SurfaceShading {
            base_color: color.truncate(),
            metallic: self.metallic * surface.z,
            roughness: self.roughness * surface.y,
            reflectance: REFLECTANCE,
            height: 0.0,
        };
        (shading, color.w)
    }

    /// How far the normal leans along tangent and bitangent, for each unit out of the surface.
    pub fn lean(&self, place: &Place) -> Vec2 {
        let Some(map) = &self.normal_map else { return Vec2::ZERO };
        let normal: Vec3 = map.sample(place).truncate() * 2.0 - 1.0;
        normal.truncate() * self.normal_scale / normal.z.max(0.05)
    }
}

impl Map {
    fn new(library: &MaterialLibrary, textures: &mut Textures, info: &Value, srgb: bool) -> Result<Self, String> {
        let index = |value: &Value| value.as_u64().and_then(|i| usize::try_from(i).ok());
        let texture = index(&info["index"]).and_then(|i| library.textures.get(i)).ok_or("a texture is missing")?;
        let source = index(&texture["source"]).ok_or("a texture is in a format of an extension")?;
        let sampler = index(&texture["sampler"]).and_then(|i| library.samplers.get(i)).unwrap_or(&Value::Null);
        let wrap = |key: &str| match sampler[key].as_u64() {
            Some(33071) => Wrap::Clamp,
            Some(33648) => Wrap::Mirror,
            _ => Wrap::Repeat,
        };
        let moved = &info["extensions"]["KHR_texture_transform"];
        let pair = |value: &Value, default: f32| {
            let part = |i: usize| value[i].as_f64().map_or(default, |x| x as f32);
            Vec2::new(part(0), part(1))
        };
        let angle = moved["rotation"].as_f64().map_or(0.0, |x| x as f32);
        Ok(Self {
            texture: textures.image(library, source, srgb)?,
            set: index(&moved["texCoord"]).or_else(|| index(&info["texCoord"])).unwrap_or(0).min(1),
            // The rotation is counter-clockwise where v runs upwards.
            transform: Affine2::from_scale_angle_translation(
                pair(&moved["scale"], 1.0),
                -angle,
                pair(&moved["offset"], 0.0),
            ),
            wrap: [wrap("wrapS"), wrap("wrapT")],
            nearest: sampler["magFilter"].as_u64() == Some(9728),
        })
    }

    fn sample(&self, place: &Place) -> Vec4 {
        // Texels of the image, along the side of a square, for a texel of what is baked.
        let area = self.texture.size().as_vec2().element_product() * self.transform.matrix2.determinant().abs();
        let footprint = place.steps[self.set] * area.sqrt();
        self.texture.sample(self.transform.transform_point2(place.uvs[self.set]), self.wrap, footprint, self.nearest)
    }
}
