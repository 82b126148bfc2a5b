//! Coats what glTF files say is painted, by their custom properties.

use bevy::{
    ecs::{
        entity::Entity,
        hierarchy::{ChildOf, Children},
        name::Name,
        query::{Added, Has, Or, With},
        system::{Commands, Query},
    },
    gltf::{GltfExtras, GltfMaterialExtras, GltfMeshExtras},
    log::warn,
    mesh::Mesh3d,
};

use crate::{
    api::{coating::Coating, exclude::CoatingExclude},
    extras::{PropCoating, PropExtras},
};

/// Query of the custom properties of an entity that came from a glTF file, and of what it wears already.
type Properties<'w, 's, F = ()> = Query<
    'w,
    's,
    (
        Entity,
        Option<&'static GltfExtras>,
        Option<&'static GltfMeshExtras>,
        Option<&'static GltfMaterialExtras>,
        Option<&'static ChildOf>,
        Has<Coating>,
    ),
    F,
>;

/// Coats entities that have just come from a glTF file, or excludes them, as their custom properties say. What has a
/// `Coating` already keeps it.
///
/// The properties of an object (a node) count for it and all below it. Those of a mesh count where its object has none.
/// A material's count for what wears it, before both.
pub(super) fn coat_by_extras(
    mut commands: Commands,
    added: Properties<Or<(Added<GltfExtras>, Added<GltfMeshExtras>, Added<GltfMaterialExtras>)>>,
    all: Properties,
    children: Query<&Children>,
    meshes: Query<Option<&GltfMeshExtras>, With<Mesh3d>>,
    names: Query<&Name>,
) {
    let mut found: Vec<(Entity, &str)> = Vec::new();
    for (entity, node, mesh, material, parent, has_coating) in &added {
        // A primitive has the properties of its material and its mesh; the node above it has those of the object.
        let own = [node.map(|extras| &extras.value), material.map(|extras| &extras.value)];
        let own = own.into_iter().flatten().find(|json| speaks(json));
        if let (Some(json), false) = (own, has_coating) {
            found.push((entity, json));
            continue;
        }
        let Some(mesh) = mesh.filter(|mesh| own.is_none() && speaks(&mesh.value)) else { continue };
        let parent = parent.map(|parent| parent.0);
        let object = parent.and_then(|parent| all.get(parent).ok());
        let object_speaks = object
            .is_some_and(|(_, node, .., has_coating)| has_coating || node.is_some_and(|extras| speaks(&extras.value)));
        if object_speaks || has_coating {
            continue;
        }
        // Primitives of one mesh share a film on their node, if there is nothing else below that.
        let same = |&child: &Entity| meshes.get(child).is_ok_and(|other| other.is_some_and(|o| o.value == mesh.value));
        let whole = parent.filter(|&parent| children.get(parent).is_ok_and(|all| all.iter().all(same)));
        found.push((whole.unwrap_or(entity), &mesh.value));
    }
    // What several primitives say about their node is said once.
    found.sort_unstable();
    found.dedup();
    for (entity, json) in found {
        match PropExtras::read(json) {
            Ok(Some(PropExtras::Coat(coating))) => {
                commands.entity(entity).try_insert_if_new(coating_of(*coating));
            }
            Ok(Some(PropExtras::Exclude)) => {
                commands.entity(entity).try_insert_if_new(CoatingExclude);
            }
            Ok(None) => {}
            Err(error) => {
                let name = names.get(entity).map_or("", Name::as_str);
                warn!("entity {entity} ({name}) stays as it is: {error}");
            }
        }
    }
}

/// Returns whether custom properties say something about paint, be it wrong.
fn speaks(json: &str) -> bool {
    !matches!(PropExtras::read(json), Ok(None))
}

fn coating_of(PropCoating { preset, settings, seed, start_age }: PropCoating) -> Coating {
    let masks = preset.masks().into();
    Coating { seed, masks, start_age: start_age.unwrap_or_default(), ..Coating::new(settings) }
}
