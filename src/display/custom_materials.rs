//! Finds out whether a mesh is drawn by a material that the plugin does not know.

use bevy::ecs::{
    archetype::Archetype,
    component::{ComponentId, Components},
    reflect::AppTypeRegistry,
    system::{Local, Res, SystemParam},
};

/// Beginning of the type paths of material components.
const PREFIX: &str = "bevy_pbr::mesh_material::MeshMaterial3d<";

/// All types of material components in the app, standard ones included. They are recognised by their type paths, which
/// `MaterialPlugin` registers.
#[derive(SystemParam)]
pub(super) struct CustomMaterials<'w, 's> {
    components: &'w Components,
    registry: Option<Res<'w, AppTypeRegistry>>,
    known: Local<'s, Known>,
}

/// Material components that were found so far.
#[derive(Default)]
pub(super) struct Known {
    /// Number of types of components that were looked at.
    seen: usize,
    materials: Vec<ComponentId>,
}

impl CustomMaterials<'_, '_> {
    /// Looks at the types of components that are new since the last call.
    pub fn update(&mut self) {
        let count = self.components.num_registered();
        if self.known.seen == count {
            return;
        }
        let Some(registry) = &self.registry else { return };
        let registry = registry.read();
        let is_material = |path: &str| path.starts_with(PREFIX);
        self.known.materials.clear();
        self.known.materials.extend(
            self.components
                .iter_registered()
                .filter(|info| {
                    info.type_id()
                        .and_then(|id| registry.get_type_info(id))
                        .is_some_and(|info| is_material(info.type_path()))
                })
                .map(|info| info.id()),
        );
        self.known.seen = count;
    }

    /// Returns whether entities of `archetype` have a material of any type.
    pub fn has_material(&self, archetype: &Archetype) -> bool {
        self.known.materials.iter().any(|&material| archetype.contains(material))
    }
}
