//! Edges as a mask: how far the surface turns within a reach.

use std::f32::consts::{FRAC_PI_2, PI};

use bevy_math::{Vec3, ops};

use super::ground::MaskGround;
use crate::film::{FaceId, FilmMesh, HalfEdgeId};

/// Turn of a border: that of a right-angled edge.
const RIM: f32 = FRAC_PI_2;
/// Angle, in radians, up to which an edge of the prop may stand for a part of a curve, as shading normals say.
const SMOOTH: f32 = 0.7;

/// Returns at each vertex of a film at rest how far its surface turns outward within `reach` metres, in radians: across
/// a straight edge by its angle, and on a curve of a radius as long as the reach by about 1. It is the same on any
/// triangles that are smaller than the reach; hollows count against edges.
///
/// A curve that the prop shows smooth, though it is made of flat triangles, turns evenly, and not at their edges.
pub(super) fn turns(mesh: &FilmMesh, ground: &MaskGround, reach: f32) -> Vec<f32> {
    let (topology, geometry) = (&mesh.topology, &mesh.geometry);
    let vertices = topology.vertex_count();
    let (mut turns, mut next) = (vec![0.0f32; vertices], vec![Vec::new(); vertices]);
    let shading = shading_normals(ground);
    for h in topology.all_edges() {
        let [a, b] = [topology.origin(h), topology.target(h)].map(|v| v.index());
        let angle = match topology.rest_twin(h) {
            Some(twin) => {
                let bare = geometry.rest_dihedrals.get(h.index()).map_or(0.0, |dihedral| dihedral - PI);
                let shown = (bare.abs() <= SMOOTH).then(|| shown_turn(mesh, &shading, [h, twin])).flatten();
                // What is shown as a sharp edge where there is none is a fault of the normals.
                shown.filter(|turn| turn.abs() <= SMOOTH).unwrap_or(bare)
            }
            None => RIM,
        };
        let half = 0.5 * angle * geometry.rest_lengths.get(h.index()).copied().unwrap_or_default();
        for (v, other) in [(a, b), (b, a)] {
            if let (Some(turn), Some(next)) = (turns.get_mut(v), next.get_mut(v)) {
                *turn += half;
                next.push(other);
            }
        }
    }
    let at = |v: usize| geometry.rest_positions.get(v).copied().unwrap_or(Vec3::ZERO);
    let reach = reach.max(geometry.mean_edge);
    // Marks of the vertices that were seen around the last one.
    let (mut seen, mut found) = (vec![usize::MAX; vertices], Vec::new());
    let around = |v: usize| {
        found.clear();
        found.push(v);
        let (mut sum, mut done) = (0.0, 0);
        while let Some(&u) = found.get(done) {
            done += 1;
            let nearness = 1.0 - at(u).distance(at(v)) / reach;
            if nearness <= 0.0 {
                continue;
            }
            sum += nearness * turns.get(u).copied().unwrap_or_default();
            for &other in next.get(u).into_iter().flatten() {
                if let Some(mark) = seen.get_mut(other)
                    && *mark != v
                    && other != v
                {
                    *mark = v;
                    found.push(other);
                }
            }
        }
        // Along a straight edge nearness adds up to the reach.
        sum / reach
    };
    (0..vertices).map(around).collect()
}

/// Returns the prop's shading normal in the middle of each face of the film: nothing if the prop has none, and zero
/// where they cancel each other.
fn shading_normals(ground: &MaskGround) -> Vec<Vec3> {
    let normals = &ground.surface.normals;
    if normals.is_empty() {
        return Vec::new();
    }
    let corner = |triangle: u32, k: usize| normals.get(3 * triangle as usize + k).copied().unwrap_or(Vec3::ZERO);
    let faces = ground.built.sites.chunks_exact(3).enumerate();
    let normal = faces.map(|(face, sites)| {
        let at = sites.iter().map(|site| {
            let [a, b, c] = [0, 1, 2].map(|k| corner(site.triangle, k).normalize_or_zero());
            (a * site.weights.x + b * site.weights.y + c * site.weights.z).normalize_or_zero()
        });
        let is_flipped = ground.built.flipped.get(face).copied().unwrap_or(false);
        at.sum::<Vec3>().normalize_or_zero() * if is_flipped { -1.0 } else { 1.0 }
    });
    normal.collect()
}

/// Returns the outward turn that shading shows between the faces of two half-edges; `None` where normals are missing.
fn shown_turn(mesh: &FilmMesh, shading: &[Vec3], sides: [HalfEdgeId; 2]) -> Option<f32> {
    let faces: [FaceId; 2] = sides.map(|side| side.face());
    let [a, b] = faces.map(|face| shading.get(face.index()).copied().filter(|normal| *normal != Vec3::ZERO));
    let (a, b) = (a?, b?);
    let [from, to] = faces.map(|face| mesh.geometry.rest_centroid(&mesh.topology, face));
    let turn = ops::atan2(a.cross(b).length(), a.dot(b));
    Some(if (b - a).dot(to - from) >= 0.0 { turn } else { -turn })
}
