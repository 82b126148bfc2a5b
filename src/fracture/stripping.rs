//! Stripping: faces torn all round are removed, and small loose pieces fall (VC 5.3 and beyond).

use bevy_math::Vec3;

use super::{FilmForces, FractureScratch};
use crate::{
    film::{Debris, FaceFate, FaceId, FilmChanges, FilmMesh},
    settings::StrippingSettings,
};

/// Removes every face whose half-edges are all torn (at the open border: all its inner edges, once all its
/// vertices have separated), then every loose piece of up to `fall_faces` faces: nothing holds it, so real
/// paint would have fallen. Larger loose pieces stay and are remembered, so that bending does not make them
/// drift. Looks only at this step's tears and separations, and at pieces that came loose by them.
pub fn strip(
    mesh: &mut FilmMesh,
    forces: &mut FilmForces,
    settings: &StrippingSettings,
    changes: &mut FilmChanges,
    scratch: &mut FractureScratch,
) {
    forces.find_pieces(&mesh.topology);
    for i in 0..changes.torn.len() {
        let edge = changes.torn[i];
        let twin = mesh.topology.rest_twin(edge);
        for f in [Some(edge.face()), twin.map(|t| t.face())].into_iter().flatten() {
            strip_if_free(mesh, forces, f, changes);
        }
    }
    for i in 0..changes.separated.len() {
        // A border face can hang on by its last attached vertex, whose fan is that face alone.
        if let Some(h) = mesh.topology.fan(changes.separated[i]).next() {
            strip_if_free(mesh, forces, h.face(), changes);
        }
    }
    forces.predictions.pieces.renew(&mesh.topology, &mut forces.loose, &mut scratch.pieces);
    if forces.loose.smallest().is_some_and(|faces| faces <= settings.fall_faces) {
        drop_pieces(mesh, forces, settings.fall_faces, changes);
        forces.loose.retain_live(&mesh.topology, &mut scratch.pieces);
    }
}

fn strip_if_free(mesh: &mut FilmMesh, forces: &FilmForces, f: FaceId, changes: &mut FilmChanges) {
    let corners = mesh.topology.corners(f);
    if mesh.topology.is_cut_out(f) && !corners.iter().any(|&v| forces.is_attached(v)) {
        changes.debris.push(debris(mesh, &[f]));
        changes.removed.push(f);
        mesh.topology.strip(f);
        debug_assert_eq!(mesh.topology.fate(f), FaceFate::Stripped);
    }
}

/// Drops every loose piece of up to `limit` faces.
fn drop_pieces(mesh: &mut FilmMesh, forces: &mut FilmForces, limit: u32, changes: &mut FilmChanges) {
    let first = changes.removed.len();
    for piece in forces.loose.iter().filter(|piece| piece.faces.len() as u32 <= limit) {
        changes.debris.push(debris(mesh, piece.faces));
        changes.removed.extend_from_slice(piece.faces);
        mesh.topology.drop_piece(piece.faces);
        for v in piece.vertices {
            forces.tips[v.index()] = Vec3::ZERO;
        }
    }
    for h in changes.removed[first..].iter().flat_map(|f| f.half_edges()) {
        forces.follow_decay(&mesh.topology, h);
    }
}

fn debris(mesh: &FilmMesh, faces: &[FaceId]) -> Debris {
    let (mut position, mut normal, mut area) = (Vec3::ZERO, Vec3::ZERO, 0.0);
    for &f in faces {
        let corners = mesh.topology.corners(f);
        let [a, b, c] = corners.map(|v| mesh.geometry.positions[v.index()]);
        position += (a + b + c) / 3.0;
        normal += (b - a).cross(c - a);
        let [a, b, c] = corners.map(|v| mesh.geometry.rest_positions[v.index()]);
        area += (b - a).cross(c - a).length() * 0.5;
    }
    Debris {
        position: position / faces.len() as f32,
        normal: normal.normalize_or_zero(),
        area,
        faces: faces.len() as u32,
    }
}
