//! Links the entities of a coating: its root, its films, the prop's meshes and the children that the plugin spawns.

use std::sync::Arc;

use bevy::{
    asset::{AssetId, Handle},
    ecs::{
        component::{Component, ComponentId},
        entity::Entity,
        reflect::ReflectComponent,
    },
    math::{Affine3A, Vec3},
    mesh::Mesh,
    reflect::prelude::*,
    transform::components::GlobalTransform,
};

#[cfg(feature = "render")]
use bevy::pbr::StandardMaterial;

use super::{coating::FilmKey, error::CoatingFault, shelter::Shelter, stain_display::StainDisplay};
use crate::settings::CoatingSettings;

/// Link from the entity of a film to the entity with its [`Coating`](super::coating::Coating).
///
/// It is present while the film is being built and afterwards. It is neither cloned nor saved with a scene.
///
/// ```
/// use bevy::prelude::*;
/// use bevy_coating::prelude::*;
///
/// /// Prints the age of every film and the name of its prop.
/// fn print_ages(films: Query<(&CoatedBy, &FilmClock)>, names: Query<&Name>) {
///     for (coated_by, clock) in &films {
///         if let Ok(name) = names.get(coated_by.0) {
///             info!("{name} is {:.2} old", clock.age());
///         }
///     }
/// }
///
/// # let mut app = App::new();
/// # app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin));
/// # app.add_plugins(CoatingWeatheringPlugin::default());
/// app.add_systems(Update, print_ages);
/// app.update();
/// ```
// A relationship that could be cloned or reflected would be cloned with its film.
#[derive(Component, Debug, PartialEq, Eq)]
#[relationship(relationship_target = CoatingFilms, allow_self_referential)]
pub struct CoatedBy(pub Entity);

/// Films of a coating, on the entity with the [`Coating`](super::coating::Coating): those that are ready and those that
/// are being built. Where the coating is on a mesh, the film is on the same entity.
///
/// It is there as long as there are films, and follows [`CoatedBy`]. It is neither cloned nor saved with a scene.
///
/// ```
/// use bevy::prelude::*;
/// use bevy_coating::prelude::*;
///
/// /// Prints how each prop is doing.
/// fn print_ratings(props: Query<(&Name, &CoatingFilms)>, films: Query<&FilmSummary>) {
///     for (name, own) in &props {
///         for summary in films.iter_many(own.films()) {
///             info!("{name}: {}", summary.ratings);
///         }
///     }
/// }
/// # let mut app = App::new();
/// # app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin));
/// # app.add_plugins(CoatingWeatheringPlugin::default());
/// app.add_systems(Update, print_ratings);
/// app.update();
/// ```
#[derive(Component, Debug, Default, PartialEq, Eq)]
#[relationship_target(relationship = CoatedBy)]
pub struct CoatingFilms(Vec<Entity>);

impl CoatingFilms {
    /// Returns the entities of the films.
    pub fn films(&self) -> &[Entity] {
        &self.0
    }
}

/// Marker of the entities that the plugin spawns to draw the backs of flakes and the bare metal. They are children of
/// the entities of the prop's meshes, and have their render layers, shadow flags and visibility.
#[derive(Component, Clone, Copy, Debug, Default, Reflect)]
#[reflect(Component, Default, Debug, Clone)]
pub struct CoatingPart;

/// Handle of the prop's own mesh, on a mesh entity that shows a film.
///
/// The entity gets this mesh back when the coating is removed. It is saved with scenes, so that a prop of a saved scene
/// gets its own mesh too, and not the one that showed its film.
#[derive(Component, Clone, Debug, Default, PartialEq, Eq, Reflect)]
#[reflect(Component, Default, Debug, Clone, PartialEq)]
pub struct CoatedMesh(pub Handle<Mesh>);

/// Origin of a film: its meshes and the fields with which it was built.
#[derive(Component, Clone, Debug)]
#[component(clone_behavior = Ignore)]
pub(crate) struct FilmSource {
    /// Fields of the coating with which the film was built.
    pub key: FilmKey,
    /// Seed of the film.
    pub seed: u64,
    /// Entities whose meshes make up the film, by slot; [`Entity::PLACEHOLDER`] for a slot that has left the film.
    pub slots: Vec<Entity>,
    /// Scale from the mesh to the film, which is in metres: the world scale at which the film was built, times
    /// [`metres_per_unit`](Self::metres_per_unit).
    pub scale: Vec3,
    /// Metres that a unit of the world was long when the film was built.
    pub metres_per_unit: f32,
    /// Point of the scaled mesh that is zero in the film's space: a position of the film is scale *
    /// position in the mesh - origin.
    pub origin: Vec3,
    /// Area of the meshes, in square metres.
    pub area: f64,
    /// Whether each face belongs to a slot that has left the film; empty while none has.
    pub hidden: Vec<bool>,
    /// Fields of a coating with which no other film could be built, so that it is not tried again and again.
    pub refused: Option<RefusedKey>,
}

/// Returns the place in the world of the scaled mesh at `transform`, which is in metres: it is rotated and moved, and
/// shrunk or enlarged where the world has another unit, but its world scale is applied already.
pub(crate) fn place_of(transform: &GlobalTransform, metres_per_unit: f32) -> Affine3A {
    let (_, rotation, translation) = transform.to_scale_rotation_translation();
    Affine3A::from_scale_rotation_translation(Vec3::splat(1.0 / metres_per_unit), rotation, translation)
}

impl FilmSource {
    /// Returns the film's space in the world.
    pub fn place(&self, transform: &GlobalTransform) -> Affine3A {
        place_of(transform, self.metres_per_unit) * Affine3A::from_translation(self.origin)
    }

    /// Returns the slots that are part of the film.
    pub fn live_slots(&self) -> impl Iterator<Item = Entity> {
        self.slots.iter().copied().filter(|&slot| slot != Entity::PLACEHOLDER)
    }
}

/// Fields of a coating with which no other film could be built.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct RefusedKey {
    /// Fields that decide how a film is built.
    pub key: FilmKey,
    /// Whether all fields of the coating were in range.
    pub valid: bool,
}

/// Marker of a film that is to be built again, or is being, because its coating changed. The film stays until the new
/// one is ready.
#[derive(Component, Clone, Copy, Debug)]
#[component(clone_behavior = Ignore)]
pub(crate) struct FilmOutdated;

/// Marker of a mesh entity whose film has not been begun yet.
#[derive(Component, Clone, Copy, Debug)]
#[component(clone_behavior = Ignore)]
pub(crate) struct AwaitingFilm {
    /// Entity with the coating.
    pub root: Entity,
}

/// Marker of a mesh entity that could not be coated. It is kept until the mesh is coated, so that the same fault is
/// told once only.
#[derive(Component, Clone, Debug)]
#[component(clone_behavior = Ignore)]
pub(crate) struct FilmRefused {
    /// Entity with the coating.
    pub root: Entity,
    /// Entity that the film would have been on.
    pub film: Entity,
    /// All meshes that would have shared the film.
    pub mates: Arc<[Entity]>,
    /// Fault of the prop.
    pub cause: CoatingFault,
    /// Things that the fault may lie in, as they were.
    pub seen: Suspects,
}

/// Marker of a mesh entity below a coating that is left alone, because its material is like glass.
#[derive(Component, Clone, Debug)]
#[component(clone_behavior = Ignore)]
pub(crate) struct LeftAlone {
    /// Entity with the coating.
    pub root: Entity,
    /// Things that decided this, as they were.
    pub seen: Suspects,
}

/// Everything that a refusal may depend on. When it changes, the mesh is looked at again.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Suspects {
    /// Mesh of the entity.
    pub mesh: AssetId<Mesh>,
    /// Material of the entity.
    #[cfg(feature = "render")]
    pub material: Option<AssetId<StandardMaterial>>,
    /// Types of the entity's components other than the plugin's own.
    pub components: Vec<ComponentId>,
    /// Fields of the coating.
    pub coating: (FilmKey, StainDisplay, Shelter, bool),
    /// Settings asset, or the bits of settings that are stored in the coating: values that are NaN are equal, too.
    pub settings: (Option<AssetId<CoatingSettings>>, Vec<u32>),
    /// World scale of the entity.
    pub scale: [u32; 3],
    /// Metres that a unit of the world is long.
    pub unit: u32,
}

/// Link from a mesh entity to its film, which is being built or ready. The clone of an entity is linked to the film of
/// the original until `attach` has given it one of its own.
#[derive(Component, Clone, Debug)]
pub(crate) struct FilmSlot {
    /// Entity of the film.
    pub film: Entity,
    /// Mesh of the prop itself.
    pub original: Handle<Mesh>,
    /// Mesh that draws the film; `None` while the film is being built.
    pub display_mesh: Option<Handle<Mesh>>,
}
