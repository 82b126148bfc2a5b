//! Leaves glass, and what the options exclude, as it is.

use serde_json::Value;

use super::{
    error::BakeError,
    extras::excludes,
    model::{Model, ModelMesh, Slot},
    name_pattern::NamePattern,
    warning::BakeWarning,
};
use crate::{extras::PropExtras, surface::Surface};

/// Takes glass and excluded primitives out of a model's meshes, and meshes that have nothing else; with `extras` also
/// what custom properties exclude. Returns those that no document has, with the triangles that were taken out.
///
/// # Errors
/// [`BakeError::AllLeftAlone`] if there are meshes and nothing of them is left to age.
pub fn leave_alone(model: &mut Model, exclude: &[NamePattern], extras: bool) -> Result<Vec<ModelMesh>, BakeError> {
    let (mut glass, mut left, mut some) = (0, Vec::new(), false);
    let mut fits = vec![false; exclude.len()];
    let mut excluded = |name: Option<&str>| {
        let mut any = false;
        for (pattern, fits) in exclude.iter().zip(&mut fits) {
            if name.is_some_and(|name| pattern.matches(name)) {
                (*fits, any) = (true, true);
            }
        }
        any
    };
    let mut meshes = Vec::with_capacity(model.meshes.len());
    for mut mesh in model.meshes.drain(..) {
        let place = mesh.place.as_ref();
        let mesh_name = place.and_then(|place| model.carried.element("meshes", place.mesh)["name"].as_str());
        let node_name = place.and_then(|place| model.carried.element("nodes", place.node)["name"].as_str());
        // All names are looked at, so that each pattern knows whether it fits something.
        let names = [Some(mesh.name.as_str()), mesh_name, node_name].map(&mut excluded);
        let whole = names.contains(&true) || (extras && mesh.extras == Some(PropExtras::Exclude));
        let mut alone = Vec::with_capacity(mesh.slots.len());
        for Slot { material, .. } in &mesh.slots {
            let material = material.and_then(|m| model.materials.materials.get(m)).unwrap_or(&Value::Null);
            let by_name = excluded(material["name"].as_str()) || whole || (extras && excludes(material));
            let is_glass = is_glass(material);
            glass += usize::from(is_glass && !by_name);
            alone.push(by_name || is_glass);
        }
        if alone.contains(&true) || whole {
            let taken = split(&mut mesh.surface, |slot| whole || alone.get(slot) == Some(&true));
            if let Some(place) = &mut mesh.place {
                let primitives = place.primitives.iter_mut().zip(&alone);
                primitives.filter(|(_, alone)| **alone).for_each(|(primitive, _)| *primitive = None);
            }
            // A film that came with the mesh is one of all its triangles.
            mesh.film = None;
            if mesh.place.is_none() {
                let ModelMesh { name, origin, slots, .. } = &mesh;
                let (name, origin, slots) = (name.clone(), *origin, slots.clone());
                left.push(ModelMesh { name, surface: taken, origin, slots, ..ModelMesh::default() });
            }
            some = true;
            if mesh.surface.triangles.is_empty() {
                continue;
            }
        }
        meshes.push(mesh);
    }
    model.meshes = meshes;
    if glass > 0 {
        model.warnings.push(BakeWarning::Glass { count: glass });
    }
    let unused = exclude.iter().zip(fits).filter(|(_, fits)| !fits);
    model.warnings.extend(unused.map(|(pattern, _)| BakeWarning::NothingExcluded { pattern: pattern.as_str().into() }));
    if some && model.meshes.is_empty() {
        return Err(BakeError::AllLeftAlone { origin: model.origin.clone() });
    }
    Ok(left)
}

/// Returns whether a material is alpha-blended or transmissive.
fn is_glass(material: &Value) -> bool {
    let transmission = &material["extensions"]["KHR_materials_transmission"]["transmissionFactor"];
    material["alphaMode"] == "BLEND" || transmission.as_f64().is_some_and(|factor| factor > 0.0)
}

/// Moves the triangles of slots that `goes` wants into a surface of their own, with the same vertices.
fn split(surface: &mut Surface, goes: impl Fn(usize) -> bool) -> Surface {
    let goes: Vec<bool> =
        (0..surface.triangles.len()).map(|t| goes(surface.slots.get(t).map_or(0, |&slot| slot as usize))).collect();
    /// Splits what there are `each` of for a triangle; nothing where the surface has none of it.
    fn part<T: Copy>(values: &mut Vec<T>, goes: &[bool], each: usize) -> Vec<T> {
        let (mut stay, mut went) = (Vec::new(), Vec::new());
        for (values, &goes) in values.chunks(each).zip(goes) {
            if goes { went.extend_from_slice(values) } else { stay.extend_from_slice(values) }
        }
        *values = stay;
        went
    }
    Surface {
        positions: surface.positions.clone(),
        triangles: part(&mut surface.triangles, &goes, 1),
        slots: part(&mut surface.slots, &goes, 1),
        normals: part(&mut surface.normals, &goes, 3),
        tangents: part(&mut surface.tangents, &goes, 3),
        uvs: part(&mut surface.uvs, &goes, 3),
        uvs_1: part(&mut surface.uvs_1, &goes, 3),
        colors: part(&mut surface.colors, &goes, 3),
    }
}

#[cfg(test)]
mod tests {
    use bevy_math::{Vec2, Vec3};
    use serde_json::json;

    use super::*;

    /// Two triangles: one of paint, one of `material`.
    fn model(material: Value) -> Model {
        let mut model = Model::default();
        model.materials.materials = vec![json!({ "name": "paint" }), material];
        let surface = Surface {
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z],
            triangles: vec![[0, 1, 2], [1, 2, 3]],
            slots: vec![0, 1],
            uvs: (0..6).map(|i| Vec2::splat(i as f32)).collect(),
            ..Surface::default()
        };
        let slots = vec![
            Slot { material: Some(0), uvs: true, ..Slot::default() },
            Slot { material: Some(1), uvs: true, ..Slot::default() },
        ];
        model.meshes.push(ModelMesh { name: "door".into(), surface, slots, ..ModelMesh::default() });
        model
    }

    #[test]
    fn glass_is_taken_out_with_a_warning_and_the_rest_stays() {
        let transmissive = json!({ "extensions": { "KHR_materials_transmission": { "transmissionFactor": 0.9 } } });
        for glass in [json!({ "alphaMode": "BLEND" }), transmissive] {
            let mut model = model(glass);
            let left = leave_alone(&mut model, &[], true).expect("paint");
            assert_eq!(model.meshes[0].surface.triangles, [[0, 1, 2]]);
            assert_eq!(model.meshes[0].surface.uvs, [0.0, 1.0, 2.0].map(Vec2::splat));
            assert_eq!((left[0].surface.triangles[..].to_vec(), left[0].surface.slots[0]), (vec![[1, 2, 3]], 1));
            assert_eq!(model.warnings, [BakeWarning::Glass { count: 1 }]);
        }
    }

    #[test]
    fn masks_and_lookalikes_are_no_glass() {
        let opaque = json!({ "extensions": { "KHR_materials_transmission": { "transmissionFactor": 0.0 } } });
        for paint in [json!({ "alphaMode": "MASK" }), opaque, json!({})] {
            let mut model = model(paint);
            assert!(leave_alone(&mut model, &[], true).expect("paint").is_empty());
            assert_eq!((model.meshes[0].surface.triangles.len(), model.warnings.len()), (2, 0));
        }
    }

    #[test]
    fn names_exclude_meshes_and_materials() {
        let mut by_material = model(json!({ "name": "chrome trim" }));
        leave_alone(&mut by_material, &["chrome*".into(), "nothing".into()], true).expect("paint");
        assert_eq!(by_material.meshes[0].surface.slots, [0]);
        assert_eq!(by_material.warnings, [BakeWarning::NothingExcluded { pattern: "nothing".into() }]);
        let mut all = model(json!({}));
        assert!(matches!(leave_alone(&mut all, &["do?r".into()], true), Err(BakeError::AllLeftAlone { .. })));
    }
}
