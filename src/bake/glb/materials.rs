//! Makes the materials of an aged model: the prop's own, those of what the paint uncovers, and those that were baked.

use std::{
    borrow::Cow,
    collections::{BTreeMap, BTreeSet},
};

use serde_json::{Map, Value, json};

use super::{
    buffer::BinaryChunk,
    pool::Pool,
    uses::{Uses, index},
};
use crate::{
    appearance::shading::{PrimerShading, SurfaceShading},
    bake::{
        model::MaterialLibrary,
        textures::{self, Base, Cover, Encoded, Primitive},
    },
};

/// The library's materials at their places, but for those that only coated primitives wore: what was made of one takes
/// its place. The same for textures and images. All others follow.
pub struct Materials<'a> {
    library: &'a MaterialLibrary,
    materials: Pool,
    textures: Pool,
    images: Pool,
    samplers: Vec<Value>,
    /// Baked images, by their places.
    baked: BTreeMap<usize, Cow<'a, [u8]>>,
    /// Materials that were made, by their text.
    made: BTreeMap<String, usize>,
    /// Textures of alpha masks, by the prop's own texture.
    mask_textures: BTreeMap<usize, usize>,
    sampler: Option<usize>,
}

impl<'a> Materials<'a> {
    /// For these primitives, where the rest of the document uses `uses`.
    pub fn new<'b>(
        library: &'a MaterialLibrary,
        uses: &Uses,
        primitives: impl IntoIterator<Item = &'b Primitive<'b>>,
    ) -> Self {
        // What is left of materials where it is worn, and all that are changed.
        let (mut rest, mut changed, mut stay) = (Uses::default(), BTreeSet::new(), uses.materials.clone());
        for primitive in primitives {
            for own in [primitive.base.own(), primitive.mask].into_iter().flatten() {
                let material = library.materials.get(own).unwrap_or(&Value::Null);
                match (primitive.cover, primitive.base) {
                    (Cover::Plain, Base::Own(_)) => _ = stay.insert(own),
                    (Cover::Textures { .. }, Base::Own(_)) => {
                        rest.add(&textures::without_baked(material));
                        changed.insert(own);
                    }
                    (_, Base::Own(_)) => {
                        rest.add(material);
                        changed.insert(own);
                    }
                    // Masks are read from the material.
                    _ => {}
                }
            }
        }
        let mut materials = Pool::new(library.materials.clone());
        let mut gone = Uses::default();
        for &own in changed.difference(&stay) {
            gone.add(materials.get(own));
            materials.release(own);
        }
        materials.elements().iter().for_each(|material| rest.add(material));
        rest.textures.extend(&uses.textures);
        let mut textures = Pool::new(library.textures.clone());
        let mut gone_images = Uses::default();
        for &texture in gone.textures.difference(&rest.textures) {
            gone_images.add(textures.get(texture));
            textures.release(texture);
        }
        textures.elements().iter().for_each(|texture| rest.add(texture));
        rest.images.extend(&uses.images);
        let mut images = Pool::new(library.images.iter().map(|_| json!({})).collect());
        gone_images.images.difference(&rest.images).for_each(|&image| images.release(image));
        Self {
            library,
            materials,
            textures,
            images,
            samplers: library.samplers.clone(),
            baked: BTreeMap::new(),
            made: BTreeMap::new(),
            mask_textures: BTreeMap::new(),
            sampler: None,
        }
    }

    /// The material of a primitive; `None` for the format's default. `sheets` are the textures of the prop's
    /// sheets.
    pub fn of(&mut self, primitive: &Primitive, sheets: &[[usize; 3]]) -> Option<usize> {
        let base = primitive.base;
        let mut material = match primitive.cover {
            Cover::Plain => match base {
                Base::Own(material) => return material,
                Base::Primer => plain("primer", &PrimerShading::default().surface(), false),
                Base::Metal => plain("rusted metal", &METAL, true),
            },
            Cover::Textures { sheet, moved } => {
                let [base_color, surface, normals] = sheets.get(sheet)?.map(|index| json!({ "index": index }));
                let mut material = self.bare(base);
                if moved {
                    textures::move_to_second(&mut material);
                }
                set_in(&mut material, &[("baseColorTexture", base_color), ("metallicRoughnessTexture", surface)]);
                set(&mut material, &[("normalTexture", normals)]);
                material
            }
            Cover::Colors(surface) => {
                let mut material = match base {
                    Base::Own(own) => own.and_then(|m| self.library.materials.get(m)).cloned().unwrap_or(json!({})),
                    other => self.bare(other),
                };
                set_in(&mut material, &[("baseColorFactor", json!([1.0, 1.0, 1.0, 1.0]))]);
                if let Some([metallic, roughness]) = surface {
                    let factors = [("metallicFactor", rounded(metallic)), ("roughnessFactor", rounded(roughness))];
                    set_in(&mut material, &factors);
                }
                material
            }
        };
        if let Some(mask) = primitive.mask {
            self.hold_mask(&mut material, mask, primitive);
        }
        Some(self.add(base.own(), material))
    }

    /// Adds a material that was made, once. It takes the place of the one it was made of, where that is free.
    fn add(&mut self, own: Option<usize>, material: Value) -> usize {
        let key = format!("{own:?} {material}");
        if let Some(&made) = self.made.get(&key) {
            return made;
        }
        let place = own.filter(|&own| self.materials.is_free(own)).unwrap_or(self.materials.len());
        self.materials.put(place, material);
        self.made.insert(key, place);
        place
    }

    /// Makes backs and metal end where the prop's own alpha mask ends.
    fn hold_mask(&mut self, material: &mut Value, mask: usize, primitive: &Primitive) {
        let Some(own) = self.library.materials.get(mask) else { return };
        set(material, &[("alphaMode", "MASK".into())]);
        if !own["alphaCutoff"].is_null() {
            set(material, &[("alphaCutoff", own["alphaCutoff"].clone())]);
        }
        if let Cover::Textures { .. } = primitive.cover {
            // The mask is in the textures.
            return;
        }
        let pbr = &own["pbrMetallicRoughness"];
        let opaque = pbr.pointer("/baseColorFactor/3").and_then(Value::as_f64).unwrap_or(1.0);
        if opaque != 1.0 {
            let mut factor = material.pointer("/pbrMetallicRoughness/baseColorFactor").cloned().unwrap_or_default();
            if let Some(alpha) = factor.get_mut(3) {
                *alpha = opaque.into();
            }
            set_in(material, &[("baseColorFactor", factor)]);
        }
        let mut info = pbr["baseColorTexture"].clone();
        if let Some(texture) = info.get("index").and_then(index) {
            set(&mut info, &[("index", self.mask_texture(texture).into())]);
            set_in(material, &[("baseColorTexture", info)]);
        }
    }

    /// A white texture with the alpha of the prop's own; that itself if it cannot be read.
    fn mask_texture(&mut self, texture: usize) -> usize {
        if let Some(&known) = self.mask_textures.get(&texture) {
            return known;
        }
        let own = self.library.textures.get(texture).unwrap_or(&Value::Null);
        let image = index(&own["source"]).and_then(|source| self.library.images.get(source));
        let white = image.and_then(textures::white_with_alpha);
        let made = white.map_or(texture, |white| {
            let source = self.images.add(json!({ "name": "alpha mask" }));
            self.baked.insert(source, white.into());
            let mut fields = json!({ "source": source });
            if !own["sampler"].is_null() {
                set(&mut fields, &[("sampler", own["sampler"].clone())]);
            }
            self.textures.add(fields)
        });
        self.mask_textures.insert(texture, made);
        made
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

    /// Adds the textures of a sheet: base colour, metalness with roughness, and normals.
    pub fn add_sheet(&mut self, name: &str, sheet: &'a Encoded) -> [usize; 3] {
        let sampler = *self.sampler.get_or_insert_with(|| {
            self.samplers.push(sampler());
            self.samplers.len() - 1
        });
        let Encoded { base, surface, normals } = sheet;
        [("base colour", base), ("metalness and roughness", surface), ("normals", normals)].map(|(what, bytes)| {
            let source = self.images.add(json!({ "name": format!("{name} {what}") }));
            self.baked.insert(source, bytes.as_slice().into());
            self.textures.add(json!({ "sampler": sampler, "source": source }))
        })
    }

    /// Writes materials, textures, samplers and images into the root object.
    pub fn write(self, chunk: &mut BinaryChunk, root: &mut Map<String, Value>) {
        let Self { library, images, baked, .. } = self;
        let mut filled = Vec::new();
        for (i, image) in images.finish(&Value::Null).iter().enumerate() {
            let mut fields = Map::new();
            if let Some(bytes) = baked.get(&i) {
                fields.insert("name".into(), image["name"].clone());
                fields.insert("mimeType".into(), "image/png".into());
                fields.insert("bufferView".into(), chunk.image(bytes).into());
            } else if let Some(own) = library.images.get(i) {
                // Free places between others keep the image they had.
                fields.clone_from(&own.rest);
                if let Some(name) = &own.name {
                    fields.insert("name".into(), name.clone().into());
                }
                // One that cannot be read stays where it is.
                if !fields.contains_key("uri") {
                    let bytes = if own.bytes.is_empty() { &EMPTY_IMAGE.into() } else { &own.bytes };
                    let mime_type = if own.bytes.is_empty() { "image/png" } else { own.mime_type.as_str() };
                    fields.insert("mimeType".into(), mime_type.into());
                    fields.insert("bufferView".into(), chunk.own_image(bytes).into());
                }
            }
            filled.push(Value::from(fields));
        }
        let lists = [
            ("materials", self.materials.finish(&json!({}))),
            ("textures", self.textures.finish(&json!({}))),
            ("samplers", self.samplers),
            ("images", filled),
        ];
        for (name, list) in lists {
            if list.is_empty() {
                root.remove(name);
            } else {
                root.insert(name.into(), list.into());
            }
        }
    }
}

fn set(object: &mut Value, fields: &[(&str, Value)]) {
    for (key, value) in fields {
        if let Some(object) = object.as_object_mut() {
            object.insert((*key).into(), value.clone());
        }
    }
}

/// Sets fields of the metallic-roughness model of a material.
fn set_in(material: &mut Value, fields: &[(&str, Value)]) {
    let mut pbr = match &material["pbrMetallicRoughness"] {
        Value::Object(own) => own.clone().into(),
        _ => json!({}),
    };
    set(&mut pbr, fields);
    set(material, &[("pbrMetallicRoughness", pbr)]);
}

/// To three digits, which is more than anyone sees.
fn rounded(x: f32) -> Value {
    ((f64::from(x) * 1000.0).round() / 1000.0).into()
}

/// Blended between texels and between sizes, and ending at the edge: charts never reach over it.
fn sampler() -> Value {
    json!({ "magFilter": 9729, "minFilter": 9987, "wrapS": 33071, "wrapT": 33071 })
}

/// A white texel as PNG, for images of which there is nothing.
const EMPTY_IMAGE: &[u8] = b"\
    \x89PNG\x0d\x0a\x1a\x0a\x00\x00\x00\x0dIHDR\
    \x00\x00\x00\x01\x00\x00\x00\x01\x08\x00\x00\x00\x00:~\x9bU\
    \x00\x00\x00\x0aIDATx\xdac\xf8\x0f\x00\x01\x01\x01\
    \x00\x1c\xb0\x8c\x99\x00\x00\x00\x00IEND\xaeB`\x82";

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
