//! Tears flaps off that hang on by a narrow neck: beyond the paper.
//!
//! Two cracks that run towards each other may stop a few edges apart and leave a flake on a stalk. Paint is brittle and
//! a flake is heavy, so real ones break off there. What counts is the width of the neck in grains and the area that
//! hangs on it, whatever the triangles.

use bevy_math::Vec3;

use super::{forces::FilmForces, scratch::FractureScratch, tear_edge::tear_edge};
use crate::{
    film::{FilmChanges, FilmMesh, TearEnd},
    settings::TearingSettings,
};

/// Tears every neck of at most [`neck_width`](TearingSettings::neck_width) that has nothing but a flap on one of its
/// sides: one at which the film tore in this step, or one whose flap was held until now.
pub(super) fn tear_necks(
    mesh: &mut FilmMesh,
    forces: &mut FilmForces,
    settings: &TearingSettings,
    gravity: Vec3,
    changes: &mut FilmChanges,
    scratch: &mut FractureScratch,
) {
    let Some(grain) = forces.grain() else { return };
    let width = settings.neck_width * grain.length;
    if !(width > 0.0) {
        return;
    }
    let FractureScratch { pieces, relief, necks, .. } = scratch;
    let mut known = 0;
    loop {
        necks.begin_pass(mesh.topology.vertex_count());
        for neck in &forces.necks {
            if neck.held_by.iter().any(|&v| !forces.is_attached(v)) {
                necks.start_at(neck.at);
            }
        }
        // First the tips of cracks, from which the way across is the shortest.
        let ends = || changes.torn_ends[known..].iter().flatten();
        for end in ends() {
            if let TearEnd::Opened(v) = *end {
                necks.start_at(v);
            }
        }
        for end in ends() {
            if let TearEnd::Split { kept, duplicate } = *end {
                necks.start_at(kept);
                necks.start_at(duplicate);
            }
        }
        known = changes.torn_ends.len();
        if necks.starts.is_empty() {
            return;
        }
        forces.necks.retain(|neck| !necks.is_start(neck.at));
        for i in 0..necks.starts.len() {
            if necks.find(mesh, forces, grain, width, i) {
                // The tears make both ends of the path starts of the next pass.
                for i in 0..necks.path.len() {
                    let edge = mesh.topology.edge(necks.path[i]);
                    tear_edge(mesh, forces, settings, edge, gravity, changes, pieces, relief);
                }
            }
        }
    }
}
