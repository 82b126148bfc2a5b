//! Finds the meshes that shelter props, and sorts their triangles for casting.

use std::sync::Arc;

use bevy::{
    asset::{AssetEvent, AssetId, AssetServer, Assets, LoadState},
    ecs::{
        entity::Entity,
        hierarchy::Children,
        lifecycle::RemovedComponents,
        message::MessageReader,
        query::{Added, Changed, Or, With, Without},
        resource::Resource,
        system::{Query, Res, ResMut, SystemParam},
    },
    log::warn,
    math::{Affine3A, Vec3},
    mesh::{Mesh, Mesh3d, skinning::SkinnedMesh},
    platform::collections::{HashMap, HashSet, hash_map::Entry},
    tasks::{AsyncComputeTaskPool, Task, futures::check_ready},
    transform::components::GlobalTransform,
};

use super::{
    ball::Ball,
    key::{Around, CastOrder},
    pieces::{Piece, ShelterPieces},
};
use crate::{
    api::{
        coating::Coating,
        error::CoatingFault,
        links::{AwaitingFilm, CoatedBy, CoatingPart, FilmOutdated, FilmSlot},
        shelter::{RainShelter, Shelter},
        turn::Turn,
        weather::{CoatingWeather, PropWeather},
    },
    mesh_reader::shape_of,
    stain::{Environment, exposure::TriangleTree},
};

/// Number of triangles that are read in a frame after which reading goes on in the next.
const MOST_READ: usize = 50_000;

/// Meshes that shelter props, as they were when there was last rain or sun.
#[derive(Resource, Default)]
pub(crate) struct ShelterScene {
    /// Meshes in their places. Orders of builds that have not begun yet share them.
    pieces: Arc<ShelterPieces>,
    /// Triangles of each mesh asset.
    meshes: HashMap<AssetId<Mesh>, ShelterMesh>,
    /// Number of meshes that were read.
    version: u64,
    /// Whether the triangles of all meshes are known.
    ready: bool,
    /// Whether the pieces are those of the world, so that only their movements need be followed.
    surveyed: bool,
    /// Balls around pieces that have moved, come or gone: where they were, and where they are.
    touched: Vec<Ball>,
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

/// Signals that other meshes than before may shelter props.
#[derive(SystemParam)]
pub(crate) struct SceneChanges<'w, 's> {
    come: Query<
        'w,
        's,
        (),
        Or<(
            Added<Mesh3d>,
            Added<SkinnedMesh>,
            Changed<FilmSlot>,
            Changed<RainShelter>,
            Changed<Coating>,
            Changed<Children>,
        )>,
    >,
    gone: (
        RemovedComponents<'w, 's, Mesh3d>,
        RemovedComponents<'w, 's, SkinnedMesh>,
        RemovedComponents<'w, 's, FilmSlot>,
        RemovedComponents<'w, 's, RainShelter>,
        RemovedComponents<'w, 's, Coating>,
        RemovedComponents<'w, 's, Children>,
    ),
    swapped: Query<'w, 's, (Entity, &'static Mesh3d, Option<&'static FilmSlot>), Changed<Mesh3d>>,
    moved: Query<'w, 's, (Entity, &'static GlobalTransform), (Changed<GlobalTransform>, With<Mesh3d>)>,
}

impl SceneChanges<'_, '_> {
    /// Returns whether the pieces may be others than `known`. Signals are taken as read.
    fn concern(&mut self, known: &ShelterPieces) -> bool {
        let gone = &mut self.gone;
        let gone = [
            gone.0.read().count(),
            gone.1.read().count(),
            gone.2.read().count(),
            gone.3.read().count(),
            gone.4.read().count(),
            gone.5.read().count(),
        ];
        // Bevy marks a `Mesh3d` as changed whenever its asset is, which films do all the time.
        let is_other = |(entity, mesh, slot): (Entity, &Mesh3d, Option<&FilmSlot>)| {
            let mesh = mesh_of(mesh, slot);
            known.all()[known.of_entity(entity)].iter().any(|piece| piece.mesh != mesh)
        };
        gone.iter().any(|&count| count > 0) || !self.come.is_empty() || self.swapped.iter().any(is_other)
    }
}

/// Returns the mesh with which an entity shelters. A coated mesh shelters with its own shape, not with the film's.
fn mesh_of(mesh: &Mesh3d, slot: Option<&FilmSlot>) -> AssetId<Mesh> {
    slot.map_or(&mesh.0, |slot| &slot.original).id()
}

/// Finds the meshes that shelter props, while there is rain or sun, and follows their movements.
pub(crate) fn survey(
    weather: Res<CoatingWeather>,
    own_weather: Query<&PropWeather>,
    mut scene: ResMut<ShelterScene>,
    mut edited: MessageReader<AssetEvent<Mesh>>,
    mut changes: SceneChanges,
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
        if let AssetEvent::Added { id } | AssetEvent::Modified { id } | AssetEvent::Removed { id } = event
            && scene.meshes.remove(id).is_some()
        {
            scene.surveyed = false;
        }
    }
    let others = changes.concern(&scene.pieces);
    // Films that are about to be built may have a past with rain or sun.
    let has_past = |root: Entity| {
        let past = coatings.get(root).ok().and_then(|(_, coating)| coating.key().past_weather);
        past.is_some_and(|past| past.reaches_anything())
    };
    let mut begun = awaiting.iter().map(|awaiting| awaiting.root).chain(outdated.iter().map(|coated_by| coated_by.0));
    let has_own = || own_weather.iter().any(|weather| weather.0.reaches_anything());
    if !weather.reaches_anything() && !begun.any(has_past) && !has_own() {
        scene.surveyed = false;
        return;
    }
    if scene.surveyed && !others {
        scene.follow_movements(&changes.moved);
        return;
    }
    let mut found = Vec::with_capacity(scene.pieces.all().len());
    let piece_of = |entity: Entity, root: Option<Entity>| {
        let (mesh, transform, slot) = meshes.get(entity).ok()?;
        let (mesh, place) = (mesh_of(mesh, slot), transform.affine());
        Some((slot.map(|slot| slot.film), Piece { entity, root, mesh, place, version: 0, tree: None }))
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
    scene.take_over(found, &assets, server.as_deref());
}

impl ShelterScene {
    /// Moves the pieces of the entities that moved.
    fn follow_movements(
        &mut self,
        moved: &Query<(Entity, &GlobalTransform), (Changed<GlobalTransform>, With<Mesh3d>)>,
    ) {
        for (entity, transform) in moved {
            let place = transform.affine();
            for index in self.pieces.of_entity(entity) {
                if self.pieces.all()[index].place != place {
                    let balls = Arc::make_mut(&mut self.pieces).set_place(index, place);
                    self.touched.extend(balls.into_iter().flatten());
                }
            }
        }
    }

    /// Takes over the pieces that were found, and reads meshes that are new, as many as a frame has time for.
    fn take_over(&mut self, mut found: Vec<Piece>, assets: &Assets<Mesh>, server: Option<&AssetServer>) {
        self.ready = true;
        let mut left = MOST_READ;
        for piece in &mut found {
            let mesh = match self.meshes.entry(piece.mesh) {
                Entry::Occupied(known) => known.into_mut(),
                Entry::Vacant(_) if left == 0 => {
                    self.ready = false;
                    continue;
                }
                Entry::Vacant(new) => {
                    let Some((tree, triangles)) = begin_tree(piece, assets, server) else {
                        self.ready = false;
                        continue;
                    };
                    left = left.saturating_sub(triangles);
                    self.version += 1;
                    new.insert(ShelterMesh { version: self.version, tree })
                }
            };
            piece.version = mesh.version;
            if let Tree::Growing(task) = &mut mesh.tree
                && let Some(tree) = check_ready(task)
            {
                mesh.tree = Tree::Grown(Arc::new(tree));
            }
            match &mesh.tree {
                Tree::Growing(_) => self.ready = false,
                Tree::Grown(tree) => piece.tree = Some(tree.clone()),
                Tree::Missing => {}
            }
        }
        self.surveyed = self.ready;
        if self.note_differences(&found) {
            let used: HashSet<_> = found.iter().map(|piece| piece.mesh).collect();
            self.meshes.retain(|id, _| used.contains(id));
            self.pieces = Arc::new(ShelterPieces::new(found));
        }
    }

    /// Notes where pieces are not what they were, and returns whether there are any. Both lists are sorted.
    fn note_differences(&mut self, found: &[Piece]) -> bool {
        let known = self.pieces.all();
        let key = |piece: &Piece| (piece.entity, piece.root);
        let (mut before, mut after) = (known.iter().peekable(), found.iter().peekable());
        let mut differ = false;
        loop {
            let (old, new) = match (before.peek(), after.peek()) {
                (None, None) => break,
                (Some(old), Some(new)) if key(old) == key(new) => (before.next(), after.next()),
                (Some(old), Some(new)) if key(old) < key(new) => (before.next(), None),
                (Some(_), None) => (before.next(), None),
                (_, Some(_)) => (None, after.next()),
            };
            if let (Some(old), Some(new)) = (old, new)
                && old.stands_as(new)
                && old.mesh == new.mesh
            {
                continue;
            }
            differ = true;
            self.touched.extend([old, new].into_iter().flatten().filter_map(Piece::ball));
        }
        differ
    }

    /// Returns the balls around pieces that have moved, come or gone since the last call.
    pub(super) fn take_touched(&mut self) -> Vec<Ball> {
        std::mem::take(&mut self.touched)
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
        let around = Around { place, root, slots: slots.to_vec(), pieces: self.pieces.clone() };
        Some(CastOrder::new(environment, around))
    }
}

/// Begins to sort the triangles of a piece's mesh in the background, and returns their number, too; `None` while the
/// mesh is being loaded. A mesh that is neither loaded nor loading is missing until its asset is added.
fn begin_tree(piece: &Piece, assets: &Assets<Mesh>, server: Option<&AssetServer>) -> Option<(Tree, usize)> {
    let Some(mesh) = assets.get(piece.mesh) else {
        let state = server.map(|server| server.load_state(piece.mesh));
        if state.as_ref().is_some_and(LoadState::is_failed) {
            tell(piece, &CoatingFault::MeshNotLoaded);
        }
        return (!state.is_some_and(|state| state.is_loading())).then_some((Tree::Missing, 0));
    };
    match shape_of(mesh) {
        Ok((positions, triangles)) => {
            let count = triangles.len();
            let task = AsyncComputeTaskPool::get().spawn(async move {
                let mut turn = Turn::begin().await;
                let corner = |v: u32| positions.get(v as usize).map_or(Vec3::NAN, |&p| Vec3::from_array(p));
                TriangleTree::new_in_pieces(triangles.iter().map(|t| t.map(corner)), &mut turn).await
            });
            Some((Tree::Growing(task), count))
        }
        Err(fault) => {
            tell(piece, &fault);
            Some((Tree::Missing, 0))
        }
    }
}

/// Warns that a piece does not shelter.
fn tell(piece: &Piece, fault: &CoatingFault) {
    warn!("entity {} shelters nothing from rain and sun: {fault}", piece.entity);
}
