//! Rebuilds the mesh of a coated node.

use serde_json::{Map, Value, json};

use crate::bake::{
    carried::Carried,
    coat::Prop,
    textures::{Cover, Primitive},
    warning::BakeWarning,
};

/// Name of the extension whose materials depend on the variant that is shown.
const VARIANTS: &str = "KHR_materials_variants";

/// The primitives of an aged mesh, and what they were.
pub struct Rebuilt<'a> {
    prop: &'a Prop,
    /// The prop's own primitives.
    own: &'a [Value],
    /// Films, by the prop's own primitive.
    films: Vec<(usize, Value)>,
    /// Backs and metal, and films without a primitive of their own.
    bare: Vec<Value>,
    pub warnings: Vec<BakeWarning>,
}

impl<'a> Rebuilt<'a> {
    pub fn new(prop: &'a Prop, carried: &'a Carried) -> Self {
        let mesh = prop.place.as_ref().map(|place| carried.element("meshes", place.mesh));
        let own = mesh.and_then(|mesh| mesh["primitives"].as_array()).map_or(&[][..], Vec::as_slice);
        Self { prop, own, films: Vec::new(), bare: Vec::new(), warnings: Vec::new() }
    }

    /// Adds an aged primitive, with extras, and with variants where its material is the prop's own.
    pub fn add(&mut self, primitive: &Primitive, mut written: Map<String, Value>) {
        let place = self.prop.place.as_ref();
        let own = primitive.slot.and_then(|slot| place?.primitives.get(slot).copied().flatten());
        let Some((index, own)) = own.and_then(|index| Some((index, self.own.get(index)?))) else {
            self.bare.push(written.into());
            return;
        };
        if !own["extras"].is_null() {
            written.insert("extras".into(), own["extras"].clone());
        }
        let mesh = || self.prop.name.clone();
        let mut lost = Vec::new();
        for (name, extension) in own["extensions"].as_object().into_iter().flatten() {
            match name.as_str() {
                VARIANTS if primitive.cover == Cover::Plain => {
                    written.insert("extensions".into(), json!({ VARIANTS: extension }));
                }
                VARIANTS => self.warnings.push(BakeWarning::Variants { mesh: mesh() }),
                other => lost.push(other),
            }
        }
        if !lost.is_empty() {
            self.warnings.push(BakeWarning::PrimitiveExtensions { mesh: mesh(), names: lost.join(", ") });
        }
        self.films.push((index, written.into()));
    }

    pub fn is_empty(&self) -> bool {
        self.films.is_empty() && self.bare.is_empty()
    }

    /// The whole mesh: `rest` has the primitives that are left as they are, in their order; films take the places of
    /// the others.
    pub fn with_rest(self, rest: &Value) -> Value {
        let coated = self.prop.place.as_ref().map_or(&[][..], |place| &place.primitives);
        let mut left = rest["primitives"].as_array().into_iter().flatten().cloned();
        let mut primitives = Vec::new();
        for i in 0..self.own.len() {
            if coated.contains(&Some(i)) {
                primitives.extend(self.films.iter().filter(|(own, _)| *own == i).map(|(_, film)| film.clone()));
            } else {
                primitives.extend(left.next());
            }
        }
        primitives.extend(self.bare);
        let mut mesh = rest.clone();
        if let Some(fields) = mesh.as_object_mut() {
            fields.insert("primitives".into(), primitives.into());
        }
        mesh
    }

    /// The aged primitives as a mesh of their own.
    pub fn alone(self, name: &str) -> Value {
        let primitives: Vec<Value> = self.films.into_iter().map(|(_, film)| film).chain(self.bare).collect();
        json!({ "name": name, "primitives": primitives })
    }
}
