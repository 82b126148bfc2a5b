//! Relaxes vertices tangentially: moves them towards the middle of their neighbours, along their feature line or over
//! their patch, and projects them back onto the surface.

use bevy_math::Vec3;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use super::collapse::chain_neighbours;
use super::project::project;
use super::work_mesh::{SurfacePoint, WorkMesh};
use crate::{
    film::VertexId,
    rest::{PIECE, Rest},
};

/// Parameters of one relaxation.
#[derive(Clone, Copy, Debug)]
pub(super) struct Relaxation {
    /// Share of the way to the middle that a vertex moves.
    pub step: f32,
    /// Largest length of the random displacement that is added, in each direction.
    pub jitter: f32,
    /// Largest distance of a feature edge from its line.
    pub deviation: f32,
    /// Largest distance of the middle of an edge from the surface.
    pub stray: f32,
    /// Quality that no face may fall below. A move after which a face does is accepted only if the worst face does not
    /// get worse.
    pub quality: f32,
}

/// Moves every vertex once, in index order.
pub(super) async fn relax(mesh: &mut WorkMesh<'_>, settings: Relaxation, rng: &mut ChaCha8Rng, rest: &mut impl Rest) {
    for v in (0..mesh.topology.vertex_slots()).map(VertexId::new) {
        if v.index().is_multiple_of(PIECE) {
            rest.rest().await;
        }
        if mesh.topology.outgoing(v).is_none() {
            continue;
        }
        match mesh.surface_point(v) {
            SurfacePoint::Fixed(_) => {}
            SurfacePoint::Line { chain, s } => relax_on_line(mesh, v, chain, s, settings, rng),
            SurfacePoint::Free(_) => relax_on_patch(mesh, v, settings, rng),
        }
    }
}

fn relax_on_line(mesh: &mut WorkMesh, v: VertexId, chain: u32, s: f32, settings: Relaxation, rng: &mut ChaCha8Rng) {
    let mut ends = chain_neighbours(mesh, v, chain).map(|n| mesh.arc_length(n, chain));
    let (Some(a), Some(b), None) = (ends.next(), ends.next(), ends.next()) else { return };
    drop(ends);
    let (low, high) = (a.min(b), a.max(b));
    let middle = 0.5 * (low + high);
    let scale = mesh.reference.sizing.chain_scales[chain as usize];
    let jitter = scale * settings.jitter * (2.0 * rng.random::<f32>() - 1.0);
    let margin = 0.2 * (high - low);
    let wanted = (s + settings.step * (middle - s) + jitter).clamp(low + margin, high - margin);
    let reference = mesh.reference;
    for step in [1.0, 0.5, 0.25] {
        let moved = s + step * (wanted - s);
        let strays =
            |end: f32| reference.strays(chain, moved, end) > settings.deviation.max(reference.strays(chain, s, end));
        if strays(a) || strays(b) {
            continue;
        }
        let position = reference.chains.position(reference.positions, chain, moved);
        if accept(mesh, v, position, SurfacePoint::Line { chain, s: moved }, settings) {
            return;
        }
    }
}

fn relax_on_patch(mesh: &mut WorkMesh, v: VertexId, settings: Relaxation, rng: &mut ChaCha8Rng) {
    let SurfacePoint::Free(start) = mesh.surface_point(v) else { return };
    let here = mesh.position(v);
    let (mut middle, mut weight, mut normal) = (Vec3::ZERO, 0.0, Vec3::ZERO);
    let mut scale = 1.0;
    for f in mesh.topology.faces_around(v) {
        scale = mesh.scale(f);
        let area_vector = mesh.area_vector(f);
        let area = area_vector.length();
        let [a, b, c] = mesh.topology.corners(f).map(|v| mesh.position(v));
        // Only the mean of the two far corners, since the vertex itself would slow the centroid down.
        middle += (a + b + c - here) * (0.5 * area);
        weight += area;
        normal += area_vector;
    }
    let normal = normal.normalize_or_zero();
    if weight <= 0.0 || normal == Vec3::ZERO {
        return;
    }
    let jitter = Vec3::new(rng.random(), rng.random(), rng.random()) * 2.0 - Vec3::ONE;
    let wanted = (middle / weight - here) * settings.step + jitter * (scale * settings.jitter);
    let wanted = wanted - normal * normal.dot(wanted);
    for step in [1.0, 0.5, 0.25] {
        let foot = project(mesh.reference, here + wanted * step, start);
        if accept(mesh, v, foot.position, SurfacePoint::Free(foot.triangle), settings) {
            return;
        }
    }
}

/// Moves the vertex unless a face folds, the worst face gets worse, or an edge comes to cut through a bend of the
/// surface.
fn accept(mesh: &mut WorkMesh, v: VertexId, position: Vec3, surface_point: SurfacePoint, settings: Relaxation) -> bool {
    let fits = mesh
        .quality_at(v, position, [None, None])
        .is_some_and(|quality| quality >= settings.quality || quality >= mesh.quality(v));
    if !fits {
        return false;
    }
    let was_bent = mesh.is_bent(v);
    let mut other = (position, surface_point);
    mesh.exchange(v, &mut other);
    if !was_bent && !mesh.is_bent(v) {
        return true;
    }
    let strays = mesh.stray_around(v);
    if strays <= settings.stray {
        return true;
    }
    mesh.exchange(v, &mut other);
    if strays > mesh.stray_around(v) {
        return false;
    }
    mesh.exchange(v, &mut other);
    true
}
