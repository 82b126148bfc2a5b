//! Draws the inner life of films into the world: tips of cracks, edges that are stretched, bends, and the planes that
//! no vertex goes below.

use bevy::{
    app::{App, Plugin, PostUpdate},
    color::{Color, Srgba},
    ecs::{
        schedule::IntoScheduleConfigs,
        system::{Query, Res},
    },
    gizmos::{
        AppGizmoBuilder, GizmoPlugin,
        config::{GizmoConfig, GizmoConfigGroup, GizmoConfigStore},
        gizmos::Gizmos,
    },
    log::warn,
    math::{Affine3A, Vec3},
    reflect::prelude::*,
    transform::{TransformSystems, components::GlobalTransform},
};

use crate::{
    api::links::FilmSource,
    deform::FilmConstraints,
    film::{FilmMesh, VertexId},
    fracture::FilmForces,
    heat::HeatMap,
};

/// Plugin that draws [`CoatingGizmos`]. Needs Bevy's `GizmoPlugin`, which is part of `DefaultPlugins` with Bevy's
/// feature `bevy_gizmos`, and must be added after it.
///
/// Nothing is drawn until the group is enabled:
///
/// ```
/// use bevy::{gizmos::GizmoPlugin, prelude::*};
/// use bevy_coating::{CoatingGizmos, CoatingGizmosPlugin, prelude::*};
///
/// fn show_cracks(mut store: ResMut<GizmoConfigStore>) {
///     let (config, gizmos) = store.config_mut::<CoatingGizmos>();
///     config.enabled = true;
///     gizmos.planes = true;
/// }
///
/// let mut app = App::new();
/// // In a game: DefaultPlugins.
/// app.add_plugins((MinimalPlugins, AssetPlugin::default(), bevy::mesh::MeshPlugin, TransformPlugin, GizmoPlugin))
///     .add_plugins((CoatingWeatheringPlugin::default(), CoatingGizmosPlugin))
///     .add_systems(Startup, show_cracks)
///     .update();
/// ```
#[derive(Clone, Copy, Debug, Default)]
pub struct CoatingGizmosPlugin;

impl Plugin for CoatingGizmosPlugin {
    fn build(&self, app: &mut App) {
        if !app.is_plugin_added::<GizmoPlugin>() {
            warn!(
                "no gizmos of films are drawn: add `CoatingGizmosPlugin` after `DefaultPlugins`, with Bevy's feature \
                 `bevy_gizmos_render`"
            );
            return;
        }
        let off = GizmoConfig { enabled: false, depth_bias: -0.01, ..GizmoConfig::default() };
        app.insert_gizmo_config(CoatingGizmos::default(), off);
        app.add_systems(PostUpdate, draw.after(TransformSystems::Propagate).run_if(is_enabled));
    }
}

/// Gizmos of films: a config group of Bevy's gizmos, which is off until it is enabled. See [`CoatingGizmosPlugin`].
#[derive(Clone, Copy, Debug, PartialEq, Reflect, GizmoConfigGroup)]
#[reflect(Default, Debug, Clone, PartialEq)]
pub struct CoatingGizmos {
    /// Whether the tips of cracks are drawn, as red arrows along which the cracks go on. Default true.
    pub tips: bool,
    /// Whether edges with a length constraint are drawn, coloured by their strain as [`HeatMap::Strain`] is. Default
    /// true.
    pub lengths: bool,
    /// Whether bend constraints are drawn: from the middle of each edge a white line as long as the edge has bent, and
    /// behind it a yellow one as long as it has yet to bend; a mean edge a radian. Default true.
    pub bends: bool,
    /// Whether the planes that no vertex goes below are drawn: a blue cross at the rest position of each vertex that
    /// has come off, and a thin line to where the vertex is. Default false.
    pub planes: bool,
}

impl Default for CoatingGizmos {
    fn default() -> Self {
        Self { tips: true, lengths: true, bends: true, planes: false }
    }
}

const TIP: Color = Color::srgb(1.0, 0.15, 0.1);
const BENT: Color = Color::srgb(0.95, 0.95, 0.95);
const TO_BEND: Color = Color::srgb(1.0, 0.8, 0.1);
const PLANE: Color = Color::srgb(0.25, 0.55, 1.0);
const LIFTED: Color = Color::srgba(0.25, 0.55, 1.0, 0.4);

fn is_enabled(store: Res<GizmoConfigStore>) -> bool {
    store.get_config::<CoatingGizmos>().is_some_and(|(config, _)| config.enabled)
}

/// Parts of a film that gizmos read.
type Drawn<'a> = (&'a FilmSource, &'a FilmMesh, &'a FilmForces, &'a FilmConstraints, &'a GlobalTransform);

fn draw(films: Query<Drawn>, mut gizmos: Gizmos<CoatingGizmos>) {
    let CoatingGizmos { tips, lengths, bends, planes } = *gizmos.config_ext;
    for (source, mesh, forces, constraints, transform) in &films {
        let place = source.place(transform);
        if tips {
            draw_tips(&mut gizmos, place, mesh, forces);
        }
        if lengths {
            draw_lengths(&mut gizmos, place, mesh, constraints);
        }
        if bends {
            draw_bends(&mut gizmos, place, mesh, constraints);
        }
        if planes {
            draw_planes(&mut gizmos, place, mesh, forces);
        }
    }
}

fn draw_tips(gizmos: &mut Gizmos<CoatingGizmos>, place: Affine3A, mesh: &FilmMesh, forces: &FilmForces) {
    let (topology, geometry) = (&mesh.topology, &mesh.geometry);
    for v in topology.all_vertices().filter(|&v| topology.has_faces(v)) {
        if let (Some(along), Some(&at)) = (forces.tip(v), geometry.positions.get(v.index())) {
            let end = at + along * geometry.mean_edge;
            gizmos.arrow(place.transform_point3(at), place.transform_point3(end), TIP);
        }
    }
}

fn draw_lengths(gizmos: &mut Gizmos<CoatingGizmos>, place: Affine3A, mesh: &FilmMesh, constraints: &FilmConstraints) {
    let range = HeatMap::Strain.range();
    for length in constraints.lengths(mesh) {
        let [Some(a), Some(b)] = length.ends.map(|v| mesh.geometry.positions.get(v as usize).copied()) else {
            continue;
        };
        let strain = if length.rest > 0.0 { (a.distance(b) - length.rest).abs() / length.rest } else { 0.0 };
        let [red, green, blue] = HeatMap::Strain.color(strain, range);
        gizmos.line(place.transform_point3(a), place.transform_point3(b), Srgba::rgb(red, green, blue));
    }
}

fn draw_bends(gizmos: &mut Gizmos<CoatingGizmos>, place: Affine3A, mesh: &FilmMesh, constraints: &FilmConstraints) {
    let (topology, geometry) = (&mesh.topology, &mesh.geometry);
    for h in topology.all_edges() {
        let Some(bend) = constraints.bend_of(mesh, h) else { continue };
        let Some(now) = geometry.dihedral(topology, h) else { continue };
        let [Some(a), Some(b)] = [topology.origin(h), topology.target(h)].map(|v| at(mesh, v)) else { continue };
        let normal = (a.1 + b.1).normalize_or_zero() * geometry.mean_edge;
        let middle = a.0.midpoint(b.0);
        let bent = middle + normal * (bend.start - now);
        let goal = middle + normal * (bend.start - bend.target);
        let [middle, bent, goal] = [middle, bent, goal].map(|p| place.transform_point3(p));
        gizmos.line(middle, bent, BENT);
        gizmos.line(bent, goal, TO_BEND);
    }
}

fn draw_planes(gizmos: &mut Gizmos<CoatingGizmos>, place: Affine3A, mesh: &FilmMesh, forces: &FilmForces) {
    let (topology, geometry) = (&mesh.topology, &mesh.geometry);
    let size = 0.25 * geometry.mean_edge;
    for v in topology.all_vertices().filter(|&v| topology.has_faces(v) && !forces.is_attached(v)) {
        let (Some((now, normal)), Some(&rest)) = (at(mesh, v), geometry.rest_positions.get(v.index())) else {
            continue;
        };
        // A normal that cancels out is of no plane.
        if normal == Vec3::ZERO {
            continue;
        }
        let (x, y) = normal.any_orthonormal_pair();
        for arm in [x, y] {
            let [from, to] = [rest - arm * size, rest + arm * size].map(|p| place.transform_point3(p));
            gizmos.line(from, to, PLANE);
        }
        gizmos.line(place.transform_point3(rest), place.transform_point3(now), LIFTED);
    }
}

/// Returns where a vertex is, and its normal at rest.
fn at(mesh: &FilmMesh, v: VertexId) -> Option<(Vec3, Vec3)> {
    let geometry = &mesh.geometry;
    Some((*geometry.positions.get(v.index())?, *geometry.rest_normals.get(v.index())?))
}
