//! Link between fracture and curls: how far each edge may curl follows the free edges.

use super::{constraints::FilmConstraints, curl::CurlField};
use crate::{
    film::{FilmChanges, FilmMesh, Mend, VertexId},
    settings::CoatingSettings,
};

/// Brings the targets of bends in step with the free edges after the fracture of this step, on a film that is measured
/// by its [grain](crate::settings::Rules::Grain); by the paper's rules every edge curls by what the settings say. Call
/// it after [`update_constraints`](super::update_constraints). Does nothing if nothing fractured.
///
/// The target of an edge narrows by [`bend_limit`](crate::settings::DeformSettings::bend_limit) times d / (0.577 s)
/// exp(-(x / r)^2): d is the distance of its faces' centroids and s the grain, so that a free strip bends to the same
/// curvature on every film; x is the distance from the nearest free edge over connected film (torn edges, edges of
/// removed faces, and the open border where it has separated), and r the
/// [`curl_reach`](crate::settings::DeformSettings::curl_reach), shortened on coarse films to the root of r^2 - 1.8 h^2,
/// with h the mean edge, but to no less than 0.6 r.
///
/// ```
/// use bevy_coating::{
///     deform::{FilmConstraints, follow_free_edges, update_constraints},
///     film::{FilmChanges, FilmMesh},
///     settings::{CoatingSettings, Rules},
/// };
/// use bevy_math::Vec3;
///
/// let mesh = FilmMesh::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::ONE], &[[0, 1, 2], [2, 1, 3]])?;
/// let mut constraints = FilmConstraints::new(&mesh);
/// let mut settings = CoatingSettings::default();
/// settings.scale.rules = Rules::Grain;
/// let mut changes = FilmChanges::default();
/// changes.separated.extend(mesh.topology.all_vertices());
///
/// update_constraints(&mesh, &mut constraints, &changes);
/// follow_free_edges(&mesh, &mut constraints, &settings, &changes);
/// # Ok::<(), bevy_coating::film::TopologyError>(())
/// ```
pub fn follow_free_edges(
    mesh: &FilmMesh,
    constraints: &mut FilmConstraints,
    settings: &CoatingSettings,
    changes: &FilmChanges,
) {
    if !changes.fractured() {
        return;
    }
    let topology = &mesh.topology;
    let Some(grain) = settings.scale.grain_of(&mesh.geometry) else {
        if constraints.take_curl().is_some() {
            topology.all_edges().for_each(|h| constraints.set_share(mesh, h, 1.0));
        }
        return;
    };
    let reach = settings.deform.curl_reach;
    let before = constraints.take_curl();
    let known = before.filter(|field| field.is_of(mesh, grain, reach));
    let is_new = known.is_none();
    let mut field = known.unwrap_or_else(|| CurlField::new(mesh, grain, reach));
    field.begin(topology);
    let is_free = |v: VertexId| !constraints.is_attached(v);
    if is_new {
        for h in topology.all_half_edges().filter(|&h| topology.is_live(h.face())) {
            if topology.is_torn(h) || topology.rest_twin(h).is_some_and(|twin| !topology.is_live(twin.face())) {
                field.seed_torn(mesh, h);
            }
        }
        topology.all_vertices().filter(|&v| is_free(v)).for_each(|v| field.seed_border(mesh, v, is_free));
    } else {
        changes.torn.iter().for_each(|&h| field.seed_torn(mesh, h));
        for v in changes.removed.iter().flat_map(|&f| topology.corners(f)) {
            field.seed(mesh, v);
        }
        changes.separated.iter().for_each(|&v| field.seed_border(mesh, v, is_free));
    }
    field.spread(mesh);
    if is_new {
        topology.all_edges().for_each(|h| constraints.set_share(mesh, h, field.share(topology, h)));
    } else {
        field.for_changed(topology, |h, share| constraints.set_share(mesh, h, share));
    }
    constraints.put_curl(field);
}

/// Brings the targets of bends in step with the free edges after a mend, as [`follow_free_edges`] does after fracture.
pub(super) fn mend_free_edges(
    mesh: &FilmMesh,
    constraints: &mut FilmConstraints,
    settings: &CoatingSettings,
    mend: &Mend,
) {
    let topology = &mesh.topology;
    let grain = settings.scale.grain_of(&mesh.geometry);
    let is_of = |field: &CurlField| grain.is_some_and(|grain| field.is_of(mesh, grain, settings.deform.curl_reach));
    let mut field = match constraints.take_curl() {
        Some(field) if is_of(&field) => field,
        other => {
            // Distances are not known, or are measured by other rules: they are found for the whole film, or forgotten.
            if let Some(other) = other {
                constraints.put_curl(other);
            }
            let changes = FilmChanges { separated: mend.places.clone(), ..FilmChanges::default() };
            return follow_free_edges(mesh, constraints, settings, &changes);
        }
    };
    field.begin(topology);
    for &[from, to] in &mend.moved {
        field.take(from, to);
    }
    field.forget_around(mesh, mend);
    let is_free = |v: VertexId| !constraints.is_attached(v);
    for &f in mend.around.iter().filter(|&&f| topology.is_live(f)) {
        for h in f.half_edges() {
            if topology.is_torn(h) {
                field.seed(mesh, topology.origin(h));
                field.seed(mesh, topology.target(h));
            }
            field.seed_border(mesh, topology.origin(h), is_free);
        }
    }
    field.spread(mesh);
    field.for_changed(topology, |h, share| constraints.set_share(mesh, h, share));
    constraints.put_curl(field);
}
