//! Sorts backs and metal by the alpha masks that hold for them.

use super::Base;
use crate::{
    appearance::{FilmAppearance, MeshPart},
    bake::{
        coat::Prop,
        model::{MaterialLibrary, Slot},
    },
};

/// Backs and metal of a prop. Those under paint with an alpha mask are parts of their own, with the coordinates of the
/// mask: holes in the paint are holes in the metal.
pub struct Bare(Vec<BarePart>);

/// A part of primer or metal.
pub struct BarePart {
    pub part: MeshPart,
    pub base: Base,
    /// The attributes that its mask needs.
    pub has: Slot,
    /// Material of the prop whose mask holds.
    pub mask: Option<usize>,
}

impl Bare {
    pub fn new(prop: &Prop, appearance: &FilmAppearance, library: &MaterialLibrary) -> Self {
        let mask = |slot: usize| {
            let material = prop.slots.get(slot)?.material?;
            (library.materials.get(material)?["alphaMode"] == "MASK").then_some(material)
        };
        let masks: Vec<(usize, usize)> = (0..prop.slots.len()).filter_map(|slot| Some((slot, mask(slot)?))).collect();
        let part = |part, base| BarePart { part, base, has: Slot::default(), mask: None };
        let open = |slot: usize| mask(slot).is_none();
        let mut parts =
            vec![part(appearance.backs_in(open), Base::Primer), part(appearance.metal_in(open), Base::Metal)];
        for (slot, material) in masks {
            let has = prop.slots.get(slot).copied().unwrap_or_default();
            let has = Slot { material: None, tangents: false, ..has };
            for (own, base) in
                [(appearance.backs_in(|s| s == slot), Base::Primer), (appearance.metal_in(|s| s == slot), Base::Metal)]
            {
                parts.push(BarePart { part: own, base, has, mask: Some(material) });
            }
        }
        Self(parts)
    }

    /// All parts.
    pub fn parts(&self) -> &[BarePart] {
        &self.0
    }
}
