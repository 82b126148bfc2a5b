//! Props of the random app, how they are spawned, and what can be wrong with them.

use bevy::{
    asset::RenderAssetUsages,
    mesh::{Indices, PrimitiveTopology, skinning::SkinnedMesh},
    prelude::*,
};
use bevy_coating::prelude::*;

use crate::common::*;

/// Sides of the plates, in squares.
pub const SIDES: [u32; 4] = [2, 3, 4, 6];
/// Distance of the second primitive of a node from the first.
const BESIDE: Vec3 = Vec3::new(1.5, 0.0, 0.0);

/// Assets that props share.
pub struct Palette {
    /// Plates of each side: at the origin, and beside it.
    plates: Vec<[Shape; 2]>,
    /// Settings assets.
    pub settings: Vec<Handle<CoatingSettings>>,
    /// Paint of all props.
    #[cfg(feature = "render")]
    paint: Handle<StandardMaterial>,
}

/// A prop's own mesh, on its entity.
#[derive(Component, Clone)]
pub struct Shape {
    pub mesh: Handle<Mesh>,
    pub triangles: usize,
    /// Whether it is a second primitive.
    pub beside: bool,
}

/// Cause for which a prop is refused, on its root.
#[derive(Component, Clone, Debug, PartialEq)]
pub enum Trouble {
    /// Mesh asset that cannot be coated.
    Mesh(Entity),
    /// Settings asset out of range.
    Settings(Handle<CoatingSettings>),
    /// Mesh entity that follows a skeleton.
    Skin(Entity),
    /// Field of the coating out of range.
    Field,
}

/// State of the original when a prop was cloned, on the clone's root, as long as nothing else happened to it.
#[derive(Component, Clone, Copy)]
pub struct ClonedAt {
    pub of: Entity,
    /// Steps that the film on the root itself had taken, if there is one.
    pub steps: Option<u64>,
    /// Steps that the original was owed, as it had to wait. The clone is owed them, too.
    pub owed: f64,
}

impl Palette {
    pub fn new(app: &mut App) -> Self {
        let mut shape = |n: u32, beside: bool| {
            let mesh = if beside { plate(n).translated_by(BESIDE) } else { plate(n) };
            Shape { mesh: add_mesh(app, mesh), triangles: (2 * n * n) as usize, beside }
        };
        let plates = SIDES.iter().map(|&n| [shape(n, false), shape(n, true)]).collect();
        let mut assets = app.world_mut().resource_mut::<Assets<CoatingSettings>>();
        let settings = [Preset::Heavy, Preset::Gentle].map(|preset| assets.add(CoatingSettings::from(preset))).to_vec();
        #[cfg(feature = "render")]
        let paint = app.world_mut().resource_mut::<Assets<StandardMaterial>>().add(StandardMaterial::default());
        Self {
            plates,
            settings,
            #[cfg(feature = "render")]
            paint,
        }
    }

    /// A mesh that is painted.
    fn painted(&self, shape: Shape) -> impl Bundle {
        #[cfg(feature = "render")]
        return (Mesh3d(shape.mesh.clone()), shape, MeshMaterial3d(self.paint.clone()));
        #[cfg(not(feature = "render"))]
        (Mesh3d(shape.mesh.clone()), shape)
    }

    /// The plate number `i`.
    pub fn shape(&self, i: usize, beside: bool) -> Shape {
        self.plates[i % self.plates.len()][usize::from(beside)].clone()
    }
}

/// Spawns a prop of one of three kinds: a mesh, a node of two primitives, a mesh with another mesh below.
pub fn spawn(app: &mut App, palette: &Palette, kind: usize, side: usize, coating: Coating, place: Vec3) -> Entity {
    let world = app.world_mut();
    let place = Transform::from_translation(place);
    let mesh = |shape: Shape| palette.painted(shape);
    match kind % 3 {
        0 => world.spawn((place, coating, mesh(palette.shape(side, false)))).id(),
        1 => {
            let root = world.spawn((place, coating)).id();
            let node = world.spawn((Transform::from_xyz(0.0, 1.0, 0.0), ChildOf(root))).id();
            for beside in [false, true] {
                world.spawn((mesh(palette.shape(side, beside)), ChildOf(node)));
            }
            root
        }
        _ => {
            let root = world.spawn((place, coating, mesh(palette.shape(side, false)))).id();
            let at = Transform::from_xyz(0.0, 0.0, 1.0);
            world.spawn((at, mesh(palette.shape(side + 1, false)), ChildOf(root)));
            root
        }
    }
}

/// The entities of `root` and below that have meshes of their own.
pub fn shapes(world: &World, root: Entity) -> Vec<Entity> {
    let mut found = Vec::new();
    let mut open = vec![root];
    while let Some(entity) = open.pop() {
        found.extend(world.get::<Shape>(entity).map(|_| entity));
        open.extend(world.get::<Children>(entity).into_iter().flatten());
    }
    found
}

/// All entities with coatings, in order.
pub fn roots(app: &mut App) -> Vec<Entity> {
    let mut roots: Vec<_> = app.world_mut().query_filtered::<Entity, With<Coating>>().iter(app.world()).collect();
    roots.sort_unstable();
    roots
}

/// A mesh that cannot be coated.
pub fn broken_mesh() -> Mesh {
    Mesh::new(PrimitiveTopology::TriangleList, RenderAssetUsages::default())
        .with_inserted_attribute(Mesh::ATTRIBUTE_POSITION, vec![[f32::NAN; 3]; 3])
        .with_inserted_indices(Indices::U32(vec![0, 1, 2]))
}

/// Mends what `root` is refused for.
pub fn mend(app: &mut App, root: Entity) {
    let Some(trouble) = app.world_mut().entity_mut(root).take::<Trouble>() else { return };
    let world = app.world_mut();
    match trouble {
        Trouble::Mesh(entity) => {
            let Ok(mut entity) = world.get_entity_mut(entity) else { return };
            let Some(mut shape) = entity.get_mut::<Shape>() else { return };
            let sound = if shape.beside { plate(5).translated_by(BESIDE) } else { plate(5) };
            shape.triangles = 50;
            let mesh = shape.mesh.clone();
            world.resource_mut::<Assets<Mesh>>().insert(&mesh, sound).expect("a mesh that is there");
        }
        Trouble::Settings(handle) => {
            let mut assets = world.resource_mut::<Assets<CoatingSettings>>();
            assets.insert(&handle, Preset::Heavy.into()).expect("settings that are there");
        }
        Trouble::Skin(entity) => {
            if let Ok(mut entity) = world.get_entity_mut(entity) {
                entity.remove::<SkinnedMesh>();
            }
        }
        Trouble::Field => {
            if let Some(mut coating) = world.get_mut::<Coating>(root) {
                coating.start_age = 0.1;
            }
        }
    }
}
