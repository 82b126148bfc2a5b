//! Repairs the few thin faces that relaxation leaves at corners of features and in folds.

use bevy_math::Vec3;

use super::collapse::{CollapseLimits, try_collapse};
use super::flip::flip_closely;
use super::project::project;
use super::work_mesh::{SurfacePoint, WorkMesh, quality};
use crate::{
    film::{FaceId, VertexId},
    rest::{PIECE, Rest},
};

/// Quality below which a face is repaired: its least angle is below about 30 degrees.
const THIN: f32 = 0.7;
/// Number of thin faces that make a piece of the work: each is tried in very many ways.
const THIN_FACES: usize = PIECE / 8;
/// Lengths of the trial steps, as shares of the target edge.
const STEPS: [f32; 3] = [0.2, 0.07, 0.025];
/// Directions of the trial steps: six around a circle.
const DIRECTIONS: [(f32, f32); 6] =
    [(1.0, 0.0), (0.5, 0.866), (-0.5, 0.866), (-1.0, 0.0), (-0.5, -0.866), (0.5, -0.866)];

/// Improves thin faces, first by flips and collapses, then by moving their vertices so that the worst face around each
/// is as good as possible.
pub(super) async fn polish(mesh: &mut WorkMesh<'_>, limits: CollapseLimits, edge: f32, rest: &mut impl Rest) {
    for (i, f) in thin_faces(mesh).into_iter().enumerate() {
        if i.is_multiple_of(THIN_FACES) {
            rest.rest().await;
        }
        if !mesh.topology.is_live(f) || quality_of(mesh, f) >= THIN {
            continue;
        }
        if f.half_edges().into_iter().any(|h| flip_closely(mesh, h, limits.stray, raises_quality)) {
            continue;
        }
        let shortest = f.half_edges().into_iter().min_by(|&a, &b| mesh.length(a).total_cmp(&mesh.length(b)));
        if let Some(h) = shortest
            && mesh.sized_length(h) < limits.shortest
            && mesh.topology.live_faces() > limits.fewest_faces
        {
            try_collapse(mesh, h, limits);
        }
    }
    let mut moved = vec![false; mesh.topology.vertex_slots()];
    for (i, f) in thin_faces(mesh).into_iter().enumerate() {
        if i.is_multiple_of(THIN_FACES) {
            rest.rest().await;
        }
        for v in mesh.topology.corners(f) {
            if !std::mem::replace(&mut moved[v.index()], true) {
                improve(mesh, v, edge, limits.stray);
            }
        }
    }
}

fn thin_faces(mesh: &WorkMesh) -> Vec<FaceId> {
    mesh.topology.faces().filter(|&f| quality_of(mesh, f) < THIN).collect()
}

fn quality_of(mesh: &WorkMesh, f: FaceId) -> f32 {
    let [a, b, c] = mesh.topology.corners(f).map(|v| mesh.position(v));
    quality(a, b, c) * mesh.allowance(f)
}

/// Returns whether turning the edge between (a, b, c) and (b, a, d) raises the lower of the two qualities.
fn raises_quality([a, b, c, d]: [Vec3; 4]) -> bool {
    let before = quality(a, b, c).min(quality(b, a, d));
    let after = quality(c, d, b).min(quality(d, c, a));
    after > before + 0.02
}

/// Moves a vertex by trial steps so that the worst face around it is as good as possible.
fn improve(mesh: &mut WorkMesh, v: VertexId, edge: f32, limit: f32) {
    let mut best = mesh.quality(v);
    let mut stray = limit.max(mesh.stray_around(v));
    let reference = mesh.reference;
    for step in STEPS.map(|s| s * edge) {
        let trials: Vec<(Vec3, SurfacePoint)> = match mesh.surface_point(v) {
            SurfacePoint::Fixed(_) => return,
            SurfacePoint::Line { chain, s } => {
                let mut ends = super::collapse::chain_neighbours(mesh, v, chain).map(|n| mesh.arc_length(n, chain));
                let (Some(a), Some(b)) = (ends.next(), ends.next()) else { return };
                let margin = 0.2 * (a - b).abs();
                [s - step, s + step]
                    .into_iter()
                    .filter(|&s| s > a.min(b) + margin && s < a.max(b) - margin)
                    .map(|s| {
                        (reference.chains.position(reference.positions, chain, s), SurfacePoint::Line { chain, s })
                    })
                    .collect()
            }
            SurfacePoint::Free(start) => {
                let normal: Vec3 = mesh.topology.faces_around(v).map(|f| mesh.area_vector(f)).sum();
                let Some(normal) = normal.try_normalize() else { return };
                let (x, y) = normal.any_orthonormal_pair();
                DIRECTIONS
                    .map(|(i, j)| project(reference, mesh.position(v) + (x * i + y * j) * step, start))
                    .map(|foot| (foot.position, SurfacePoint::Free(foot.triangle)))
                    .into()
            }
        };
        for (position, surface_point) in trials {
            if let Some(quality) = mesh.quality_at(v, position, [None, None])
                && quality > best
            {
                let mut other = (position, surface_point);
                mesh.exchange(v, &mut other);
                let strays = mesh.stray_around(v);
                if strays <= stray {
                    (best, stray) = (quality, stray.min(strays.max(limit)));
                } else {
                    mesh.exchange(v, &mut other);
                }
            }
        }
    }
}
