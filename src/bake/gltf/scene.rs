//! Walks over the nodes of the scene.

use bevy_math::{DMat4, DQuat, DVec3};

use super::{
    GltfError,
    cache::Cache,
    container::Container,
    coordinates::Fitting,
    document::{Node, lookup},
    instances,
    mesh::{MAX_TRIANGLES, Placed, Placing},
};
use crate::bake::{
    model::{Instance, Model, ModelMesh, Place},
    warning::BakeWarning,
};

/// Reads the meshes of the default scene: the one the file names, else its first; all nodes of a file without
/// scenes.
pub fn read_meshes(container: &Container, model: &mut Model) -> Result<(), GltfError> {
    let document = &container.document;
    let roots = match document.scene {
        Some(scene) => lookup(&document.scenes, scene, "scene", "the file")?.nodes.clone(),
        None => match document.scenes.first() {
            Some(scene) => scene.nodes.clone(),
            None => roots(&document.nodes),
        },
    };
    let mut visited = vec![false; document.nodes.len()];
    let mut total = 0;
    let mut placing = Placing { cache: Cache::new(container), fitting: Fitting::default() };
    // A stack, not recursion: a chain of nodes may be as deep as its file is long. Last in, first out, so
    // children are pushed in reverse.
    let mut stack: Vec<_> = roots.iter().rev().map(|&root| (root, DMat4::IDENTITY)).collect();
    while let Some((index, parent)) = stack.pop() {
        let node = lookup(&document.nodes, index, "node", "the scene")?;
        if visited.get_mut(index).is_none_or(|visited| std::mem::replace(visited, true)) {
            return Err(GltfError::NotATree(index));
        }
        let transform = parent * local_transform(node);
        stack.extend(node.children.iter().rev().map(|&child| (child, transform)));
        if let Some(mesh) = node.mesh {
            total += read_node(&mut placing, model, (index, node), mesh, transform)?;
            if total > MAX_TRIANGLES {
                let what = "the scene".into();
                return Err(GltfError::TooMany { what, found: total as u64, limit: MAX_TRIANGLES as u64 });
            }
        }
    }
    let others =
        document.nodes.iter().zip(&visited).filter(|(node, visited)| node.mesh.is_some() && !**visited).count();
    if others > 0 {
        model.warnings.push(BakeWarning::OutsideScene { count: others });
    }
    Ok(())
}

/// Reads one node's mesh and returns its number of triangles.
fn read_node(
    placing: &mut Placing,
    model: &mut Model,
    (index, node): (usize, &Node),
    mesh: usize,
    transform: DMat4,
) -> Result<usize, GltfError> {
    let document = &placing.cache.container.document;
    let mesh_name = || document.meshes.get(mesh).and_then(|mesh| mesh.name.clone());
    let name = node.name.clone().or_else(mesh_name).unwrap_or_else(|| format!("mesh {mesh}"));
    let Some(instances) = instances::read(&placing.cache, node)? else {
        let placed = placing.place(&mut model.materials, mesh, transform, &name)?;
        return Ok(add(model, placed, &name, node, Place { node: index, mesh, transform, ..none() }));
    };
    let mut triangles = 0;
    for instance in &instances {
        let transform = transform * instances::transform(instance);
        let name = format!("{name} {}", instance.index + 1);
        let placed = placing.place(&mut model.materials, mesh, transform, &name)?;
        triangles += add(model, placed, &name, node, Place { node: index, mesh, transform, ..of(instance) });
        if triangles > MAX_TRIANGLES {
            let (found, limit) = (triangles as u64, MAX_TRIANGLES as u64);
            return Err(GltfError::TooMany { what: format!("the instances of node {index}"), found, limit });
        }
    }
    if triangles > 0 {
        let more = instances::have_more(node);
        model.warnings.push(BakeWarning::Instances { mesh: name, count: instances.len(), more });
    }
    Ok(triangles)
}

fn none() -> Place {
    Place { node: 0, mesh: 0, primitives: Vec::new(), transform: DMat4::IDENTITY, instance: None }
}

fn of(instance: &Instance) -> Place {
    Place { instance: Some(*instance), ..none() }
}

/// Adds a mesh to the model, if it has triangles; returns their number.
fn add(model: &mut Model, placed: Placed, name: &str, node: &Node, place: Place) -> usize {
    let triangles = placed.mesh.surface.triangles.len();
    if triangles == 0 {
        return 0;
    }
    let mesh = || name.to_owned();
    if placed.morphed {
        model.warnings.push(BakeWarning::Morphed { mesh: mesh() });
    }
    if node.skin.is_some() {
        model.warnings.push(BakeWarning::Skinned { mesh: mesh() });
    }
    if placed.more_uvs {
        model.warnings.push(BakeWarning::ExtraTextureCoordinates { mesh: mesh() });
    }
    if placed.more_attributes {
        model.warnings.push(BakeWarning::ExtraAttributes { mesh: mesh() });
    }
    if placed.without_coordinates > 0 {
        let count = placed.without_coordinates;
        model.warnings.push(BakeWarning::TexturesWithoutCoordinates { mesh: mesh(), count });
    }
    let place = Some(Place { primitives: placed.primitives, ..place });
    model.meshes.push(ModelMesh { name: mesh(), place, ..placed.mesh });
    triangles
}

/// Nodes that are no node's child.
fn roots(nodes: &[Node]) -> Vec<usize> {
    let mut is_child = vec![false; nodes.len()];
    for &child in nodes.iter().flat_map(|node| &node.children) {
        if let Some(is_child) = is_child.get_mut(child) {
            *is_child = true;
        }
    }
    is_child.iter().enumerate().filter(|(_, is_child)| !**is_child).map(|(i, _)| i).collect()
}

/// In double precision: what lies far from the origin is moved near it later.
fn local_transform(node: &Node) -> DMat4 {
    if let Some(matrix) = &node.matrix {
        return DMat4::from_cols_array(&matrix.map(f64::from));
    }
    let vector = |v: Option<[f32; 3]>, default: DVec3| v.map_or(default, |v| DVec3::from(v.map(f64::from)));
    let rotation = DQuat::from_array(node.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]).map(f64::from));
    DMat4::from_scale_rotation_translation(
        vector(node.scale, DVec3::ONE),
        // A quaternion of zeros is no rotation.
        if rotation.length_squared() > 0.0 { rotation.normalize() } else { DQuat::IDENTITY },
        vector(node.translation, DVec3::ZERO),
    )
}
