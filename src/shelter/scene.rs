//! Finds the meshes that shelter props, and sorts their triangles for casting.

use std::sync::Arc;

use bevy::{
    asset::{AssetEvent, AssetId, AssetServer, Assets, LoadState},
    ecs::{
        entity::Entity,
        hierarchy::Children,
        message::MessageReader,
        query::{With, Without},
        resource::Resource,
        system::{Query, Res, ResMut},
    },
    log::warn,
    math::{Affine3A, Vec3},
    mesh::{Mesh, Mesh3d, skinning::SkinnedMesh},
    platform::collections::{HashMap, HashSet, hash_map::Entry},
    tasks::{AsyncComputeTaskPool, Task, futures::check_ready},
    transform::components::GlobalTransform,
};

use super::key::CastOrder;
use crate::{
    api::{
        coating::Coating,
        error::CoatingFault,
        links::{AwaitingFilm, CoatedBy, CoatingPart, FilmOutdated, FilmSlot},
        shelter::{RainShelter, Shelter},
        weather::CoatingWeather,
    },
    mesh_reader::shape_of,
    stain::{
        Environment,
        exposure::{Blocker, TriangleTree},
    },
};

/// Meshes that shelter props, as they were when there was last rain or sun.
#[derive(Resource, Default)]
pub(crate) struct ShelterScene {
    /// Meshes in their places, sorted by entity and root.
    pieces: Vec<Piece>,
    /// Triangles of each mesh asset.
    meshes: HashMap<AssetId<Mesh>, ShelterMesh>,
    /// Number of changes of the pieces.
    revision: u64,
    /// Number of meshes that were read.
    version: u64,
    /// Whether the triangles of all meshes are known.
    ready: bool,
}

/// Mesh in its place.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Piece {
    entity: Entity,
    /// Entity of the only coating whose films it shelters; `None` if it shelters all films.
    root: Option<Entity>,
    mesh: AssetId<Mesh>,
    /// Version of the mesh; 0 while it is being loaded.
    version: u64,
    place: Affine3A,
}

/// Triangles of one mesh asset, and when they were read.
struct ShelterMesh {
    version: u64,
    tree: Tree,
}

/// Triangles of a mesh, sorted for casting.
enum Tree {
    /// Being sorted in the background.
    Growing(Task<TriangleTree>),
    /// Sorted.
    Grown(Arc<TriangleTree>),
    /// Not readable.
    Missing,
}

/// Finds the meshes that shelter props, while there is rain or sun.
pub(crate) fn survey(
    weather: Res<CoatingWeather>,
    mut scene: ResMut<ShelterScene>,
    mut edited: MessageReader<AssetEvent<Mesh>>,
    assets: Res<Assets<Mesh>>,
    server: Option<Res<AssetServer>>,
    shelters: Query<Entity, With<RainShelter>>,
    coatings: Query<(Entity, &Coating)>,
    awaiting: Query<&AwaitingFilm>,
    outdated: Query<&CoatedBy, With<FilmOutdated>>,
    children: Query<&Children>,
    meshes: Query<(&Mesh3d, &GlobalTransform, Option<&FilmSlot>), (Without<CoatingPart>, Without<SkinnedMesh>)>,
) {
    for event in edited.read() {
        if let AssetEvent::Added { id } | AssetEvent::Modified { id } | AssetEvent::Removed { id } = event {
            scene.meshes.remove(id);
        }
    }
    // Films that are about to be built may have a past with rain or sun.
    let has_past = |root: Entity| {
        let past = coatings.get(root).ok().and_then(|(_, coating)| coating.key().past_weather);
        past.is_some_and(|past| past.reaches_anything())
    };
    let mut begun = awaiting.iter().map(|awaiting| awaiting.root).chain(outdated.iter().map(|coated_by| coated_by.0));
    if !weather.reaches_anything() && !begun.any(has_past) {
        return;
    }
    let mut found = Vec::with_capacity(scene.pieces.len());
    let piece_of = |entity: Entity, root: Option<Entity>| {
        let (mesh, transform, slot) = meshes.get(entity).ok()?;
        // A coated mesh shelters with its own shape, not with the film's.
        let mesh = slot.map_or(&mesh.0, |slot| &slot.original).id();
        Some((slot.map(|slot| slot.film), Piece { entity, root, mesh, version: 0, place: transform.affine() }))
    };
    let below = |root: Entity| std::iter::once(root).chain(children.iter_descendants(root));
    for root in &shelters {
        found.extend(below(root).filter_map(|entity| Some(piece_of(entity, None)?.1)));
    }
    for (root, _) in coatings.iter().filter(|(_, coating)| coating.shelter == Shelter::Scene) {
        let own: Vec<_> = below(root).filter_map(|entity| piece_of(entity, Some(root))).collect();
        // The cast itself covers a film's own surface, so the coating's meshes count only if there is more than one
        // film.
        if own.iter().any(|(film, _)| film.is_none() || *film != own[0].0) && own.len() > 1 {
            found.extend(own.into_iter().map(|(_, piece)| piece));
        }
    }
    found.sort_unstable_by_key(|piece| (piece.entity, piece.root));
    // A piece that shelters all films sorts before a piece of the same entity that shelters only its own.
    found.dedup_by(|later, first| later.entity == first.entity && (first.root.is_none() || first.root == later.root));
    scene.follow(found, &assets, server.as_deref());
}

impl ShelterScene {
    /// Takes over the pieces that were found, and reads meshes that are new.
    fn follow(&mut self, mut found: Vec<Piece>, assets: &Assets<Mesh>, server: Option<&AssetServer>) {
        self.ready = true;
        for piece in &mut found {
            let mesh = match self.meshes.entry(piece.mesh) {
                Entry::Occupied(known) => known.into_mut(),
                Entry::Vacant(new) => {
                    let Some(tree) = begin_tree(piece, assets, server) else {
                        self.ready = false;
                        continue;
                    };
                    self.version += 1;
                    new.insert(ShelterMesh { version: self.version, tree })
                }
            };
            piece.version = mesh.version;
            if let Tree::Growing(task) = &mut mesh.tree {
                match check_ready(task) {
                    Some(tree) => mesh.tree = Tree::Grown(Arc::new(tree)),
                    None => self.ready = false,
                }
            }
        }
        if found != self.pieces {
            self.pieces = found;
            self.revision += 1;
            let used: HashSet<_> = self.pieces.iter().map(|piece| piece.mesh).collect();
            self.meshes.retain(|id, _| used.contains(id));
        }
    }

    /// Returns the number of changes so far.
    pub fn revision(&self) -> u64 {
        self.revision
    }

    /// Returns the order for casting rays on the film at `place` that is coated by `root` and made of the meshes of
    /// `slots`. `None` while meshes are being loaded or sorted.
    pub fn order(
        &self,
        environment: &Environment,
        place: Affine3A,
        root: Entity,
        slots: &[Entity],
    ) -> Option<CastOrder> {
        if !self.ready {
            return None;
        }
        let mut order = CastOrder::new(environment);
        for piece in &self.pieces {
            let others = piece.root.is_some_and(|only| only != root);
            let Some(ShelterMesh { version, tree: Tree::Grown(tree) }) = self.meshes.get(&piece.mesh) else { continue };
            if !others && !slots.contains(&piece.entity) {
                let into = piece.place.inverse() * place;
                order.push(piece.entity, *version, Blocker { tree: tree.clone(), into });
            }
        }
        Some(order)
    }
}

/// Begins to sort the triangles of a piece's mesh in the background; `None` while the mesh is being loaded. A mesh that
/// is neither loaded nor loading is missing until its asset is added.
fn begin_tree(piece: &Piece, assets: &Assets<Mesh>, server: Option<&AssetServer>) -> Option<Tree> {
    let Some(mesh) = assets.get(piece.mesh) else {
        let state = server.map(|server| server.load_state(piece.mesh));
        if state.as_ref().is_some_and(LoadState::is_failed) {
            tell(piece, &CoatingFault::MeshNotLoaded);
        }
        return (!state.is_some_and(|state| state.is_loading())).then_some(Tree::Missing);
    };
    match shape_of(mesh) {
        Ok((positions, triangles)) => Some(Tree::Growing(AsyncComputeTaskPool::get().spawn(async move {
            let corner = |v: u32| positions.get(v as usize).map_or(Vec3::NAN, |&p| Vec3::from_array(p));
            TriangleTree::new(triangles.iter().map(|t| t.map(corner)))
        }))),
        Err(fault) => {
            tell(piece, &fault);
            Some(Tree::Missing)
        }
    }
}

/// Warns that a piece does not shelter.
fn tell(piece: &Piece, fault: &CoatingFault) {
    warn!("entity {} shelters nothing from rain and sun: {fault}", piece.entity);
}
