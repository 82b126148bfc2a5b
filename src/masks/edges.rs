//! Edges as a mask: how far the surface turns within a reach.

use std::f32::consts::{FRAC_PI_2, PI};

use bevy_math::Vec3;

use crate::film::FilmMesh;

/// Turn of a border: that of a right-angled edge.
const RIM: f32 = FRAC_PI_2;

/// Returns at each vertex of a film at rest how far its surface turns outward within `reach` metres, in radians: across
/// a straight edge by its angle, and on a curve of a radius as long as the reach by about 1. It is the same on any
/// triangles that are smaller than the reach; hollows count against edges.
pub(super) fn turns(mesh: &FilmMesh, reach: f32) -> Vec<f32> {
    let (topology, geometry) = (&mesh.topology, &mesh.geometry);
    let vertices = topology.vertex_count();
    let (mut turns, mut next) = (vec![0.0f32; vertices], vec![Vec::new(); vertices]);
    for h in topology.all_edges() {
        let [a, b] = [topology.origin(h), topology.target(h)].map(|v| v.index());
        let angle = match topology.rest_twin(h) {
            Some(_) => geometry.rest_dihedrals.get(h.index()).map_or(0.0, |dihedral| dihedral - PI),
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
