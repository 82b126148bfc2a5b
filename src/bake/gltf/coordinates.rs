//! Chooses the two sets of texture coordinates that a film keeps, and fits materials to them.

use std::collections::BTreeMap;

use serde_json::Value;

use crate::bake::{
    model::MaterialLibrary,
    texture_refs::{retain, set_of, use_set, visit},
};

/// Materials that were fitted, by their index and the sets of texture coordinates that a primitive has.
#[derive(Default)]
pub struct Fitting(BTreeMap<(usize, Vec<usize>), Fitted>);

/// Texture coordinates of a primitive.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Fitted {
    /// Sets that become the first and second.
    pub sets: [Option<usize>; 2],
    /// The material that uses these.
    pub material: Option<usize>,
    /// Textures of the material that were left out, because there are no coordinates for them.
    pub left_out: usize,
}

impl Fitting {
    /// Chooses among the sets that are `there`, ascending, those that the material's textures use. A material that uses
    /// others than the first two, or some that are not there, is added to the library once more, as it has to be.
    pub fn fit(&mut self, library: &mut MaterialLibrary, material: Option<usize>, there: Vec<usize>) -> Fitted {
        let plain = Fitted { sets: [0, 1].map(|set| there.contains(&set).then_some(set)), material, left_out: 0 };
        let Some((index, own)) = material.and_then(|m| Some((m, library.materials.get(m)?))) else { return plain };
        let used = used_sets(own);
        if used.iter().all(|set| *set < 2 && there.contains(set)) {
            return plain;
        }
        let key = (index, there);
        if let Some(&fitted) = self.0.get(&key) {
            return fitted;
        }
        let mut kept: Vec<usize> = used.into_iter().filter(|set| key.1.contains(set)).take(2).collect();
        kept.sort_unstable();
        let (mut fitted, mut left_out) = (own.clone(), 0);
        retain(&mut fitted, &mut |info| {
            let place = kept.iter().position(|&set| set as u64 == set_of(info));
            match place {
                Some(place) => use_set(info, place as u64),
                None => left_out += 1,
            }
            place.is_some()
        });
        library.materials.push(fitted);
        let sets = [kept.first().copied(), kept.get(1).copied()];
        let fitted = Fitted { sets, material: Some(library.materials.len() - 1), left_out };
        self.0.insert(key, fitted);
        fitted
    }
}

/// The sets that a material's textures use: of the colour, then of the relief, then the others.
fn used_sets(material: &Value) -> Vec<usize> {
    let mut used: Vec<usize> = Vec::new();
    let mut add = |info: &serde_json::Map<String, Value>| {
        let set = usize::try_from(set_of(info)).unwrap_or(usize::MAX);
        if !used.contains(&set) {
            used.push(set);
        }
    };
    let first = ["/pbrMetallicRoughness/baseColorTexture", "/normalTexture"].map(|place| material.pointer(place));
    first.into_iter().flatten().filter_map(Value::as_object).for_each(&mut add);
    visit(material, &mut add);
    used
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    fn library() -> MaterialLibrary {
        let material = json!({
            "pbrMetallicRoughness": { "baseColorTexture": { "index": 0, "texCoord": 2 } },
            "emissiveTexture": { "index": 1, "extensions": { "KHR_texture_transform": { "texCoord": 1 } } },
            "occlusionTexture": { "index": 2 }
        });
        MaterialLibrary { materials: vec![json!({ "normalTexture": { "index": 3 } }), material], ..Default::default() }
    }

    #[test]
    fn materials_that_use_the_first_two_sets_stay() {
        let (mut library, mut fitting) = (library(), Fitting::default());
        let fitted = fitting.fit(&mut library, Some(0), vec![0, 1, 2]);
        assert_eq!(fitted, Fitted { sets: [Some(0), Some(1)], material: Some(0), left_out: 0 });
        assert_eq!(fitting.fit(&mut library, None, vec![1]).sets, [None, Some(1)]);
        assert_eq!(library.materials.len(), 2);
    }

    #[test]
    fn others_get_the_sets_they_use_in_the_place_of_the_first() {
        let (mut library, mut fitting) = (library(), Fitting::default());
        let fitted = fitting.fit(&mut library, Some(1), vec![1, 2]);
        assert_eq!(fitted, Fitted { sets: [Some(1), Some(2)], material: Some(2), left_out: 1 });
        let expected = json!({
            "pbrMetallicRoughness": { "baseColorTexture": { "index": 0, "texCoord": 1 } },
            "emissiveTexture": {
                "index": 1, "texCoord": 0, "extensions": { "KHR_texture_transform": { "texCoord": 0 } }
            }
        });
        assert_eq!(library.materials[2], expected);
        assert_eq!(fitting.fit(&mut library, Some(1), vec![1, 2]), fitted, "once for all primitives that are alike");
        assert_eq!(library.materials.len(), 3);
    }

    #[test]
    fn textures_without_coordinates_are_left_out() {
        let (mut library, mut fitting) = (library(), Fitting::default());
        let fitted = fitting.fit(&mut library, Some(0), vec![]);
        assert_eq!(fitted, Fitted { sets: [None; 2], material: Some(2), left_out: 1 });
        assert_eq!(library.materials[2], json!({}));
    }
}
