//! Makes the materials of an aged model: the prop's own, those of what the paint uncovers, and those that were baked.

use serde_json::{Map, Value, json};

use super::buffer::BinaryChunk;
use crate::{
    appearance::shading::{PrimerShading, SurfaceShading},
    bake::{
        model::MaterialLibrary,
        textures::{self, Base, Cover, Encoded, Primitive},
    },
};

/// The prop's materials in their order if any of them goes on as it is, then those that were needed besides.
pub struct Materials<'a> {
    /// The prop's own.
    library: &'a MaterialLibrary,
    /// The library as it is written: all of it, or nothing.
    listed: MaterialLibrary,
    materials: Vec<Value>,
    textures: Vec<Value>,
    /// Baked images, after the library's own.
    baked: Vec<(String, &'a [u8])>,
    primer: Option<usize>,
    metal: Option<usize>,
    sampler: Option<usize>,
}

impl<'a> Materials<'a> {
    /// For these primitives. Where all textures are baked, the prop's own are not written.
    pub fn new<'b>(library: &'a MaterialLibrary, primitives: impl IntoIterator<Item = &'b Primitive<'b>>) -> Self {
        let goes_on = |primitive: &Primitive| match (primitive.cover, primitive.base) {
            (Cover::Textures { .. }, Base::Own(Some(own))) => library
                .materials
                .get(own)
                .is_some_and(|own| textures::texture_sets(&textures::without_baked(own)) != [false; 2]),
            (Cover::Plain | Cover::Colors(_), Base::Own(own)) => own.is_some(),
            _ => false,
        };
        let listed = if primitives.into_iter().any(goes_on) { library.clone() } else { MaterialLibrary::default() };
        Self {
            library,
            materials: listed.materials.clone(),
            textures: listed.textures.clone(),
            listed,
            baked: Vec::new(),
            primer: None,
            metal: None,
            sampler: None,
        }
    }

    /// The material of a primitive; `None` for the format's default. `sheets` are the first textures of the
    /// prop's sheets.
    pub fn of(&mut self, primitive: &Primitive, sheets: &[usize]) -> Option<usize> {
        match (primitive.cover, primitive.base) {
            (Cover::Plain, Base::Own(material)) => material,
            (Cover::Plain, Base::Primer) => Some(*self.primer.get_or_insert_with(|| {
                push(&mut self.materials, plain("primer", &PrimerShading::default().surface(), false))
            })),
            (Cover::Plain, Base::Metal) => {
                Some(*self.metal.get_or_insert_with(|| push(&mut self.materials, plain("rusted metal", &METAL, true))))
            }
            (Cover::Textures { sheet, moved }, base) => {
                let first = sheets.get(sheet).copied()?;
                let mut material = self.bare(base);
                if moved {
                    textures::move_to_second(&mut material);
                }
                let pbr = json!({
                    "baseColorTexture": { "index": first }, "metallicRoughnessTexture": { "index": first + 1 }
                });
                set(&mut material, &[("pbrMetallicRoughness", pbr), ("normalTexture", json!({ "index": first + 2 }))]);
                Some(push(&mut self.materials, material))
            }
            (Cover::Colors(surface), base) => {
                let mut material = match base {
                    Base::Own(own) => own.and_then(|m| self.library.materials.get(m)).cloned().unwrap_or(json!({})),
                    other => self.bare(other),
                };
                let mut pbr = match &material["pbrMetallicRoughness"] {
                    Value::Null => json!({}),
                    own => own.clone(),
                };
                set(&mut pbr, &[("baseColorFactor", json!([1.0, 1.0, 1.0, 1.0]))]);
                if let Some([metallic, roughness]) = surface {
                    set(&mut pbr, &[("metallicFactor", rounded(metallic)), ("roughnessFactor", rounded(roughness))]);
                }
                set(&mut material, &[("pbrMetallicRoughness", pbr)]);
                Some(push(&mut self.materials, material))
            }
        }
    }

    /// A material without what is baked.
    fn bare(&self, base: Base) -> Value {
        match base {
            Base::Own(own) => {
                textures::without_baked(own.and_then(|m| self.library.materials.get(m)).unwrap_or(&Value::Null))
            }
            Base::Primer => json!({ "name": "primer" }),
            // A sheet of metal has a back, whatever the prop's own material shows of it.
            Base::Metal => json!({ "name": "rusted metal", "doubleSided": true }),
        }
    }

    /// Adds the textures of a sheet; returns the first of the three.
    pub fn add_sheet(&mut self, name: &str, sheet: &'a Encoded) -> usize {
        let sampler = *self.sampler.get_or_insert(self.listed.samplers.len());
        let first = self.textures.len();
        let Encoded { base, surface, normals } = sheet;
        for (what, bytes) in [("base colour", base), ("metalness and roughness", surface), ("normals", normals)] {
            let source = self.listed.images.len() + self.baked.len();
            self.baked.push((format!("{name} {what}"), bytes));
            self.textures.push(json!({ "sampler": sampler, "source": source }));
        }
        first
    }

    /// Writes materials, textures, samplers and images into the root object, and the extensions they use.
    pub fn write(self, chunk: &mut BinaryChunk, root: &mut Map<String, Value>) {
        let library = self.listed;
        let own = library.images.iter().map(|image| {
            let mut fields = image.rest.clone();
            if let Some(name) = &image.name {
                fields.insert("name".into(), name.clone().into());
            }
            // What cannot be read stays where it is.
            if !fields.contains_key("uri") {
                fields.insert("mimeType".into(), image.mime_type.clone().into());
                fields.insert("bufferView".into(), chunk.image(&image.bytes).into());
            }
            fields.into()
        });
        let mut images: Vec<Value> = own.collect();
        images.extend(
            self.baked.iter().map(
                |(name, bytes)| json!({ "name": name, "mimeType": "image/png", "bufferView": chunk.image(bytes) }),
            ),
        );
        let mut samplers = library.samplers.clone();
        if self.sampler.is_some() {
            samplers.push(sampler());
        }
        let lists =
            [("materials", self.materials), ("textures", self.textures), ("samplers", samplers), ("images", images)];
        let uses = |name: &&String| lists.iter().any(|(_, list)| list.iter().any(|value| mentions(value, name)));
        let used: Vec<&String> = self.library.extensions_used.iter().filter(uses).collect();
        let required: Vec<&String> =
            self.library.extensions_required.iter().filter(|name| used.contains(name)).collect();
        if !used.is_empty() {
            root.insert("extensionsUsed".into(), json!(used));
        }
        if !required.is_empty() {
            root.insert("extensionsRequired".into(), json!(required));
        }
        for (name, list) in lists {
            if !list.is_empty() {
                root.insert(name.into(), list.into());
            }
        }
    }
}

fn push(materials: &mut Vec<Value>, material: Value) -> usize {
    materials.push(material);
    materials.len() - 1
}

fn set(object: &mut Value, fields: &[(&str, Value)]) {
    for (key, value) in fields {
        if let Some(object) = object.as_object_mut() {
            object.insert((*key).into(), value.clone());
        }
    }
}

/// To three digits, which is more than anyone sees.
fn rounded(x: f32) -> Value {
    ((f64::from(x) * 1000.0).round() / 1000.0).into()
}

/// Blended between texels and between sizes, and ending at the edge: charts never reach over it.
fn sampler() -> Value {
    json!({ "magFilter": 9729, "minFilter": 9987, "wrapS": 33071, "wrapT": 33071 })
}

/// Whether an object in `value` has the extension `name`.
fn mentions(value: &Value, name: &str) -> bool {
    match value {
        Value::Object(fields) => {
            let own = fields.get("extensions").and_then(Value::as_object).is_some_and(|own| own.contains_key(name));
            own || fields.values().any(|value| mentions(value, name))
        }
        Value::Array(values) => values.iter().any(|value| mentions(value, name)),
        _ => false,
    }
}

/// Rusted metal where no stains are shown.
const METAL: SurfaceShading = SurfaceShading {
    base_color: bevy_math::Vec3::new(0.11, 0.045, 0.022),
    metallic: 0.6,
    roughness: 0.75,
    reflectance: 0.5,
    height: 0.0,
};

/// A material that is the same all over.
fn plain(name: &str, shading: &SurfaceShading, double_sided: bool) -> Value {
    let [r, g, b] = shading.base_color.to_array().map(rounded);
    let mut material = json!({
        "name": name,
        "pbrMetallicRoughness": {
            "baseColorFactor": [r, g, b, 1.0],
            "metallicFactor": rounded(shading.metallic),
            "roughnessFactor": rounded(shading.roughness)
        }
    });
    if double_sided {
        set(&mut material, &[("doubleSided", true.into())]);
    }
    material
}
