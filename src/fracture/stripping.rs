//! Strips faces that are torn off all around, and drops small loose pieces (VC 5.3; loose pieces go beyond the paper).

use bevy_math::Vec3;

use super::{forces::FilmForces, hold::let_go_of_what_hangs, scratch::FractureScratch};
use crate::{
    film::{Debris, FaceFate, FaceId, FilmChanges, FilmMesh, LoosePiece},
    settings::StrippingSettings,
};

/// Removes the faces that nothing holds any more.
///
/// 1. Every face whose three half-edges are all torn is stripped (VC 5.3). A face at the open border is stripped once
///    all its inner edges are torn and all its vertices have separated.
/// 2. Every loose piece (connected faces without an attached vertex) of up to
///    [`fall_faces`](StrippingSettings::fall_faces) faces falls, as real paint would; the paper leaves it in the air.
///    Larger loose pieces stay and are listed in [`FilmForces::loose`], so that bending does not make them drift. By
///    [`Rules::Grain`](crate::settings::Rules::Grain) every loose piece falls, [`hold`](StrippingSettings::hold) after
///    it came loose.
///
/// `age` is that of the film at the end of this step.
///
/// The removed faces are appended to [`FilmChanges::removed`], and one entry for each stripped face or fallen piece to
/// [`FilmChanges::debris`]. `changes` must hold the tears and separations of this step: only faces at them, and pieces
/// that they set loose, are judged.
///
/// ```
/// use bevy_coating::{
///     film::{FilmChanges, FilmMesh},
///     fracture::{FilmForces, FractureScratch, strip},
///     settings::{CoatingSettings, Preset},
/// };
/// use bevy_math::Vec3;
///
/// let corners = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::new(1.0, 1.0, 0.0)];
/// let mut mesh = FilmMesh::new(corners, &[[0, 1, 2], [2, 1, 3]])?;
/// let settings = CoatingSettings::from(Preset::Paper);
/// let mut forces = FilmForces::new(&mesh, &settings, 7);
/// forces.separated_age.fill(0.0); // every vertex has separated
/// forces.touch_all();
///
/// let (mut changes, mut scratch) = (FilmChanges::default(), FractureScratch::default());
/// strip(&mut mesh, &mut forces, &settings.stripping, 0.1, &mut changes, &mut scratch);
/// assert_eq!((changes.debris.len(), changes.debris[0].faces), (1, 2), "the whole film falls as one piece");
/// # Ok::<(), bevy_coating::film::TopologyError>(())
/// ```
pub fn strip(
    mesh: &mut FilmMesh,
    forces: &mut FilmForces,
    settings: &StrippingSettings,
    age: f32,
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
        // A border face may have been held by one attached vertex alone; then it is the only face at that vertex.
        if let Some(h) = mesh.topology.fan(changes.separated[i]).next() {
            strip_if_free(mesh, forces, h.face(), changes);
        }
    }
    if let Some(grain) = forces.grain() {
        let_go_of_what_hangs(mesh, forces, settings, grain, age, changes, scratch);
    }
    forces.predictions.pieces.renew(&mesh.topology, &mut forces.loose, &mut scratch.pieces);
    let fell = if forces.grain().is_some() {
        forces.note_loose(mesh.topology.face_count(), age);
        let since = std::mem::take(&mut forces.loose_since);
        let held = |piece: &LoosePiece| piece.faces.first().is_some_and(|f| age - since[f.index()] < settings.hold);
        let fell = drop_pieces(mesh, forces, |piece| !held(piece), changes);
        forces.loose_since = since;
        fell
    } else if forces.loose.smallest().is_some_and(|faces| faces <= settings.fall_faces) {
        drop_pieces(mesh, forces, |piece| piece.faces.len() as u32 <= settings.fall_faces, changes)
    } else {
        false
    };
    if fell {
        forces.loose.retain_live(&mesh.topology, &mut scratch.pieces);
    }
}

impl FilmForces {
    /// Notes `age` for the loose pieces that came loose in this step, on a film with `count` faces.
    fn note_loose(&mut self, count: usize, age: f32) {
        self.loose_since.resize(count, f32::INFINITY);
        for piece in self.loose.iter() {
            // A piece that has parted since it came loose consists of faces that came loose with it.
            let is_new = piece.faces.first().is_some_and(|f| self.loose_since[f.index()] == f32::INFINITY);
            if is_new {
                piece.faces.iter().for_each(|f| self.loose_since[f.index()] = age);
            }
        }
    }
}

/// Strips `f` if all its inner edges are torn and no vertex of it is attached.
pub(super) fn strip_if_free(mesh: &mut FilmMesh, forces: &FilmForces, f: FaceId, changes: &mut FilmChanges) {
    let corners = mesh.topology.corners(f);
    if mesh.topology.is_cut_out(f) && !corners.iter().any(|&v| forces.is_attached(v)) {
        changes.debris.push(debris(mesh, &[f]));
        changes.removed.push(f);
        mesh.topology.strip(f);
        debug_assert_eq!(mesh.topology.fate(f), FaceFate::Stripped);
    }
}

/// Drops every loose piece that `falls`. Returns whether any did.
fn drop_pieces(
    mesh: &mut FilmMesh,
    forces: &mut FilmForces,
    falls: impl Fn(&LoosePiece) -> bool,
    changes: &mut FilmChanges,
) -> bool {
    let first = changes.removed.len();
    for piece in forces.loose.iter().filter(falls) {
        changes.debris.push(debris(mesh, piece.faces));
        changes.removed.extend_from_slice(piece.faces);
        mesh.topology.drop_piece(piece.faces);
        for v in piece.vertices {
            forces.tips[v.index()] = Vec3::ZERO;
        }
    }
    for h in changes.removed[first..].iter().flat_map(|f| f.half_edges()) {
        forces.update_decay(&mesh.topology, h);
    }
    changes.removed.len() > first
}

/// Describes the piece that consists of `faces`, as it is before they are removed.
pub(super) fn debris(mesh: &FilmMesh, faces: &[FaceId]) -> Debris {
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
        face: faces.iter().copied().min().unwrap_or(FaceId(0)),
    }
}
