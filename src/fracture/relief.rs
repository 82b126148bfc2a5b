//! Relieves the film beside a tear of its contraction, over a length that does not depend on the triangles.

use bevy_math::{Vec3, ops};

use super::{drawn::Contraction, forces::FilmForces};
use crate::{
    film::{FaceId, FilmMesh, Grain, HalfEdgeId},
    settings::TearingSettings,
};

/// Number of lengths of relief from the torn edge beyond which faces are not looked at: there it is a twentieth.
const LARGEST_REACH: f32 = 3.0;
/// Share of the torn edge's length beyond each of its ends within which faces still lie beside it. Straight ahead of a
/// tip stress concentrates: without this margin cracks run a little too far, and with twice as much they get stuck on
/// fine films.
const MARGIN: f32 = 0.15;

/// Buffers of the search for the faces beside a tear.
#[derive(Clone, Debug, Default)]
pub(super) struct ReliefScratch {
    /// Search in which each face was last reached.
    reached: Vec<u32>,
    search: u32,
    faces: Vec<FaceId>,
}

impl ReliefScratch {
    /// Begins a search on a film with `count` faces.
    fn begin(&mut self, count: usize) {
        if self.reached.len() != count || self.search == u32::MAX {
            self.reached.clear();
            self.reached.resize(count, 0);
            self.search = 0;
        }
        self.search += 1;
        self.faces.clear();
    }

    fn reach(&mut self, f: FaceId) {
        if self.reached[f.index()] != self.search {
            self.reached[f.index()] = self.search;
            self.faces.push(f);
        }
    }
}

/// Relieves the film beside edges that have just torn, as [`relieve_beside`] does beside each, on a film that is
/// measured by its grain. Between two faces that are gone there is nothing to relieve.
pub(super) fn relieve_torn(
    mesh: &FilmMesh,
    forces: &mut FilmForces,
    settings: &TearingSettings,
    torn: &[HalfEdgeId],
    scratch: &mut ReliefScratch,
) {
    let Some(grain) = forces.grain() else { return };
    let is_live = |h: HalfEdgeId| mesh.topology.is_live(h.face());
    for &edge in torn {
        if is_live(edge) || mesh.topology.rest_twin(edge).is_some_and(is_live) {
            relieve_beside(mesh, forces, settings, grain, edge, scratch);
        }
    }
}

/// Relieves the faces on both sides of `edge`, which has just torn, as far as they are reached over film that is
/// whole: at the distance d of a face's centroid from the edge, by the share c exp(-d / l) of the contraction that
/// every face has gained, with c the [`relief`](TearingSettings::relief) and l the
/// [`relief_reach`](TearingSettings::relief_reach) in grains. A face keeps the largest relief that it got.
fn relieve_beside(
    mesh: &FilmMesh,
    forces: &mut FilmForces,
    settings: &TearingSettings,
    grain: Grain,
    edge: HalfEdgeId,
    scratch: &mut ReliefScratch,
) {
    let topology = &mesh.topology;
    let Some(twin) = topology.rest_twin(edge) else { return };
    let place = |v| mesh.geometry.rest_positions[topology.original(v).index()];
    let (from, to) = (place(topology.origin(edge)), place(topology.target(edge)));
    let length = mesh.geometry.rest_lengths[edge.index()];
    let along = (to - from).normalize_or_zero();
    let reach = settings.relief_reach * grain.length;
    let far = LARGEST_REACH * reach;
    // A strip wide enough for its faces to hang together: its triangles are as wide as the edge or the mean edge.
    let aside = if length > mesh.geometry.mean_edge { length } else { mesh.geometry.mean_edge };
    let gained = forces.drawn.contraction + forces.contraction_gained as f32;

    scratch.begin(topology.face_count());
    scratch.reach(edge.face());
    scratch.reach(twin.face());
    let mut next = 0;
    while let Some(&f) = scratch.faces.get(next) {
        next += 1;
        let centroid = mesh.geometry.rest_centroid(topology, f) - from;
        let position = centroid.dot(along);
        let distance = length_of(centroid - position * along);
        let is_first = next <= 2;
        let is_near = distance <= far && position > -aside && position < length + aside;
        if !is_first && !is_near {
            continue;
        }
        if position >= -MARGIN * length && position <= (1.0 + MARGIN) * length {
            // Paint that is newer has gained less.
            let spared = forces.contraction_spared.get(f.index()).copied().unwrap_or(0.0);
            let full = settings.relief * (gained - spared);
            forces.relieve_by(f, full * ops::exp(-distance / reach) + spared);
        }
        for h in f.half_edges() {
            if let Some(twin) = topology.bound_twin(h) {
                scratch.reach(twin.face());
            }
        }
    }
}

/// Returns the length of `v`, by a square root that rounds alike on every platform.
fn length_of(v: Vec3) -> f32 {
    v.length_squared().sqrt()
}

impl FilmForces {
    /// Makes the contraction of `f` at most that of a face that has `relief` less than all have gained, and was
    /// relieved by nothing else.
    fn relieve_by(&mut self, f: FaceId, relief: f32) {
        let drawn = self.drawn.contraction;
        let face = &mut self.contractions[f.index()];
        let base = drawn - relief;
        if base < face.less_gained(drawn) {
            *face = Contraction { base, drawn, ..*face };
        }
    }
}
