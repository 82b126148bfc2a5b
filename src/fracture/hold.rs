//! Lets go of pieces that hang on by too little, however they came to: beyond the paper.
//!
//! A film of fine triangles that has torn nearly off hangs on by single vertices, which are next to nothing; on a
//! coarse film a vertex stands for much more. So what counts is the area that holds.

use super::{forces::FilmForces, scratch::FractureScratch, separation::let_go};
use crate::{
    film::{FaceId, FilmChanges, FilmMesh, Grain, PieceScratch, VertexId},
    settings::StrippingSettings,
};

/// Share of its area by which a piece may be held without being held well. A patch that was never larger than the area
/// that must hold is held well.
const WELL_HELD: f32 = 0.5;

/// Separates the last vertices of the pieces that tore or separated in this step and that are held by an area of at
/// most [`hold_area`](StrippingSettings::hold_area): at each attached vertex, a third of its faces.
pub(super) fn let_go_of_what_hangs(
    mesh: &FilmMesh,
    forces: &mut FilmForces,
    settings: &StrippingSettings,
    grain: Grain,
    age: f32,
    changes: &mut FilmChanges,
    scratch: &mut FractureScratch,
) {
    let topology = &mesh.topology;
    let least = settings.hold_area * grain.face_area();
    let mean = mesh.geometry.rest_area / topology.face_count().max(1) as f32;
    if !(least > 0.0 && mean > 0.0) {
        return;
    }
    // A vertex holds two faces on average. Pieces held by many more vertices than that are not measured.
    let most = (2.0 * least / mean) as u32 + 1;
    let FractureScratch { pieces, touched, attached, .. } = scratch;
    touched.clear();
    touched.extend(changes.separated.iter().filter_map(|&v| topology.fan(v).next()).map(|h| h.face()));
    for &h in &changes.torn {
        touched.extend([Some(h), topology.rest_twin(h)].into_iter().flatten().map(|side| side.face()));
    }
    for &f in touched.iter().filter(|&&f| topology.is_live(f)) {
        let count = forces.predictions.pieces.attached_of(f);
        if count == 0 || count > most {
            continue;
        }
        let (held, whole) = measure(mesh, forces, f, pieces, attached);
        // Whoever made the adhesion infinite wants the film to stay there.
        let riveted = attached.iter().any(|&v| forces.adhesion(v) == f32::INFINITY);
        if held <= least && held < WELL_HELD * whole && !riveted {
            for &v in attached.iter() {
                let_go(topology, forces, v, age, changes);
            }
        }
    }
}

/// Returns the area that holds the piece of `f`, and its whole area. Puts its attached vertices into `attached`, each
/// once.
fn measure(
    mesh: &FilmMesh,
    forces: &FilmForces,
    f: FaceId,
    scratch: &mut PieceScratch,
    attached: &mut Vec<VertexId>,
) -> (f32, f32) {
    let topology = &mesh.topology;
    let (mut held, mut whole) = (0.0, 0.0);
    attached.clear();
    for &f in scratch.piece_of(topology, f) {
        let area = mesh.geometry.rest_area_of(topology, f);
        whole += area;
        for h in f.half_edges() {
            let v = topology.origin(h);
            if forces.is_attached(v) {
                held += area / 3.0;
                if topology.starts_fan(h) {
                    attached.push(v);
                }
            }
        }
    }
    (held, whole)
}
