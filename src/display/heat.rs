//! Shows heat maps: a mesh of the film's own triangles just over its front, coloured by a quantity.
//!
//! The mesh is a child of a mesh entity of the film, like the backs and the metal, so that it has their visibility and
//! layers and goes with them. It is written when what it shows has changed, and despawned when no map is asked for.

use bevy::{
    asset::{Assets, Handle},
    color::{ColorToComponents, Srgba},
    ecs::{
        change_detection::{DetectChanges, DetectChangesMut, Ref},
        entity::Entity,
        hierarchy::ChildOf,
        name::Name,
        query::QueryData,
        system::{Commands, Local, Query, ResMut, SystemParam},
    },
    light::{NotShadowCaster, NotShadowReceiver},
    math::Vec3,
    mesh::{Mesh, Mesh3d},
    pbr::{MeshMaterial3d, StandardMaterial},
    prelude::Visibility,
    transform::components::{GlobalTransform, Transform},
};

use super::{
    film_display::FilmDisplay,
    heat_overlay::HeatOverlay,
    mesh::{PartSpace, insert, new_mesh},
};
use crate::{
    api::{
        diagnostics::CoatingTimings,
        film_pace::FilmPace,
        heat_map_view::HeatMapView,
        links::{CoatedBy, CoatingPart, FilmSource},
    },
    film::{FaceId, FilmMesh},
    fracture::FilmForces,
    heat::{HeatFilm, HeatMap, HeatValues},
    sim::{FilmClock, Stage},
    stain::StainFields,
};

/// Height of the colours over the film, in mean edges: above the front, which has no thickness.
const LIFT: f32 = 0.02;
/// Bias of their depth, so that they are also seen where the front is shown more finely than the film is simulated, and
/// lies a little higher.
const DEPTH_BIAS: f32 = 400.0;

/// Film that may show a heat map.
#[derive(QueryData)]
#[query_data(mutable)]
pub(super) struct Heated {
    entity: Entity,
    coated_by: &'static CoatedBy,
    source: Ref<'static, FilmSource>,
    mesh: Ref<'static, FilmMesh>,
    forces: Ref<'static, FilmForces>,
    stains: Ref<'static, StainFields>,
    clock: Ref<'static, FilmClock>,
    pace: &'static FilmPace,
    display: &'static mut FilmDisplay,
}

/// Entities and assets with which heat maps are drawn.
#[derive(SystemParam)]
pub(super) struct HeatAssets<'w, 's> {
    commands: Commands<'w, 's>,
    places: Query<'w, 's, &'static GlobalTransform>,
    meshes: ResMut<'w, Assets<Mesh>>,
    materials: ResMut<'w, Assets<StandardMaterial>>,
    /// Material of all heat maps.
    material: Local<'s, Option<Handle<StandardMaterial>>>,
}

/// Brings the heat maps of all films up to date, spawns those that are asked for and despawns the others.
pub(super) fn show_heat_maps(
    views: Query<&HeatMapView>,
    mut films: Query<Heated>,
    mut assets: HeatAssets,
    mut timings: ResMut<CoatingTimings>,
) {
    // Nothing to look at, as in most games.
    if views.is_empty() && films.iter().all(|film| film.display.heat.is_none()) {
        return;
    }
    timings.measure(Stage::MeshGeneration, || {
        for mut film in &mut films {
            let view = views.get(film.entity).or_else(|_| views.get(film.coated_by.0)).ok().copied();
            let parent = film.source.live_slots().next();
            let heat = film.display.bypass_change_detection().heat.take();
            let heat = match (view, parent) {
                (Some(view), Some(parent)) => assets.show(heat, view, parent, &film),
                _ => {
                    assets.despawn(heat);
                    None
                }
            };
            film.display.bypass_change_detection().heat = heat;
        }
    });
}

impl HeatedItem<'_, '_> {
    fn parts(&self) -> HeatFilm<'_> {
        let (mesh, forces, stains) = (&*self.mesh, &*self.forces, &*self.stains);
        HeatFilm { mesh, forces, stains, settings: &self.pace.settings }
    }

    /// Returns whether anything of the film has changed since the last frame.
    fn has_changed(&self) -> bool {
        self.mesh.is_changed()
            || self.forces.is_changed()
            || self.stains.is_changed()
            || self.clock.is_changed()
            || self.source.is_changed()
    }
}

impl HeatAssets<'_, '_> {
    /// Brings the heat map of a film up to date. Returns it, or `None` if its mesh entity is gone.
    fn show(
        &mut self,
        old: Option<Box<HeatOverlay>>,
        view: HeatMapView,
        parent: Entity,
        film: &HeatedItem,
    ) -> Option<Box<HeatOverlay>> {
        let old = match old {
            Some(heat) if heat.parent == parent => Some(heat),
            other => {
                self.despawn(other);
                None
            }
        };
        let is_new = old.is_none();
        let mut heat = match old {
            Some(heat) => heat,
            None => self.spawn(view, parent)?,
        };
        // Exposure is written without a trace, as it changes no stain yet.
        let rain = &film.stains.exposure.rain;
        let rained = view.map == HeatMap::Rain && heat.rain != *rain;
        if !(is_new || rained || heat.shown != view || film.has_changed()) {
            return Some(heat);
        }
        heat.shown = view;
        heat.values.update(view.map, film.parts());
        if rained {
            heat.rain.clone_from(rain);
        }
        if let Some(mut mesh) = self.meshes.get_mut(&heat.mesh) {
            write(&mut mesh, &heat, film.display.space, &film.mesh, &film.source.hidden);
        }
        Some(heat)
    }

    fn spawn(&mut self, shown: HeatMapView, parent: Entity) -> Option<Box<HeatOverlay>> {
        let transform = *self.places.get(parent).ok()?;
        let material = match &*self.material {
            Some(material) => material.clone(),
            None => self.material.insert(self.materials.add(material())).clone(),
        };
        let mesh = self.meshes.add(new_mesh());
        let part = self.commands.spawn((
            (CoatingPart, Name::new("heat map"), NotShadowCaster, NotShadowReceiver),
            (Mesh3d(mesh.clone()), MeshMaterial3d(material)),
            (Transform::IDENTITY, transform, Visibility::Inherited, ChildOf(parent)),
            #[cfg(feature = "tools")]
            bevy::picking::Pickable::IGNORE,
        ));
        let part = part.id();
        Some(Box::new(HeatOverlay { part, parent, mesh, shown, values: HeatValues::default(), rain: Vec::new() }))
    }

    fn despawn(&mut self, heat: Option<Box<HeatOverlay>>) {
        if let Some(heat) = heat {
            self.commands.entity(heat.part).try_despawn();
        }
    }
}

/// Returns the material of heat maps: vertex colours without light or fog.
fn material() -> StandardMaterial {
    StandardMaterial { unlit: true, fog_enabled: false, depth_bias: DEPTH_BIAS, ..StandardMaterial::default() }
}

/// Writes the faces that are left and not hidden, each with corners of its own. Without any it writes one triangle
/// without area, as a mesh must not be empty.
fn write(mesh: &mut Mesh, heat: &HeatOverlay, space: PartSpace, film: &FilmMesh, hidden: &[bool]) {
    let (topology, geometry) = (&film.topology, &film.geometry);
    let lift = LIFT * geometry.mean_edge;
    let range = heat.shown.spread();
    let count = 3 * (topology.face_count() - topology.removed_face_count());
    let mut positions = Vec::with_capacity(count);
    let mut normals = Vec::with_capacity(count);
    let mut colors = Vec::with_capacity(count);
    let outwards = |f: FaceId| {
        let [a, b, c] = topology.corners(f).map(|v| geometry.positions[v.index()]);
        (b - a).cross(c - a).normalize_or_zero()
    };
    // Faces that share a corner are lifted there by the same: each by itself, they would gape.
    let mut lifts = vec![Vec3::ZERO; topology.vertex_count()];
    for f in topology.live_faces() {
        let normal = outwards(f);
        topology.corners(f).iter().for_each(|v| lifts[v.index()] += normal);
    }
    lifts.iter_mut().for_each(|normal| *normal = normal.normalize_or_zero() * lift);
    for f in topology.live_faces() {
        if hidden.get(f.index()) == Some(&true) {
            continue;
        }
        let corners = topology.corners(f).map(|v| geometry.positions[v.index()] + lifts[v.index()]);
        let normal = outwards(f);
        for i in space.index_order() {
            positions.push(space.position(corners[i].to_array()));
            normals.push(space.normal(normal.to_array()));
            let value = heat.values.corners().get(3 * f.index() + i).copied().unwrap_or(f32::NAN);
            let [r, g, b] = heat.shown.map.color(value, range);
            colors.push(bevy::color::LinearRgba::from(Srgba::rgb(r, g, b)).to_f32_array());
        }
    }
    if positions.is_empty() {
        positions.resize(3, [0.0; 3]);
        normals.resize(3, Vec3::Z.to_array());
        colors.resize(3, [1.0; 4]);
    }
    insert(mesh, Mesh::ATTRIBUTE_POSITION, positions);
    insert(mesh, Mesh::ATTRIBUTE_NORMAL, normals);
    insert(mesh, Mesh::ATTRIBUTE_COLOR, colors);
}
