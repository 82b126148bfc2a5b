//! Cleaning: makes an oriented manifold of any triangles. The method needs a half-edge mesh (VC 3.3), and props of
//! games are rarely fit to be one.
//!
//! ```text
//! Surface --validate--> --weld--> --drop duplicates--> --dissolve slivers--> faces over shared vertices
//!         --pair faces along edges--> --unify winding--> --split fans--> CleanSurface
//! ```
//!
//! No surface is refused for its shape. A surface that cannot be one manifold becomes several that touch. The cuts
//! between them stay closed and so are invisible while the film is at rest.
//!
//! - **Welding** merges vertices closer than 1e-5 of the bounding box's diagonal, but never vertices further
//!   apart than a tenth of the shortest edge at either, so that thin sheets and small details survive.
//! - **Triangles without area** are dissolved into their neighbours. Exporters fill T-junctions with them, so dropping
//!   one would open the surface along its long edge.
//! - **Duplicates** with the same winding are dropped, and the first is kept (but not of two fillers without area that
//!   welding laid on each other: they close nothing). Two triangles on the same vertices with
//!   *opposite* winding are the two sides of a sheet that was modelled twice. Both are kept and never joined to each
//!   other, so each side has its own texture and its own paint.
//! - **Edges with more than two faces** join the pairs of faces that continue most smoothly. The other faces get a
//!   border there.
//! - **Winding** is unified over each shell: the winding of the larger area is kept. A one-sided shell (a Moebius band)
//!   is cut where its two sides meet.
//! - **Vertices** at which several fans of faces meet get a duplicate for each fan but the first.

mod clean_surface;
mod duplicates;
mod face;
mod fans;
mod orient;
mod pair;
mod sliver;
mod validate;
mod weld;

#[cfg(test)]
mod checker;
#[cfg(test)]
mod tests;

use bevy_math::Vec3;

use super::{
    error::BuildError,
    prop_surface::{Surface, SurfaceSite},
    warning::BuildWarning,
};
use crate::rest::{LIGHT_PIECE, NoRest, Rest, at_once};
use face::{Face, NONE, has_repeats};

pub use clean_surface::CleanSurface;
pub use pair::twins;
pub(crate) use pair::twins_in_pieces;

/// Cleans a surface: welds its vertices, repairs it and turns its triangles, so that it becomes an oriented manifold.
///
/// The same surface always gives the same result. The time is O(n log n) in the number of triangles. Positions may have
/// any magnitude, since all decisions are made in double precision.
///
/// # Errors
/// [`BuildError`] if there are no triangles or too many (above `u32::MAX / 8`), an attribute has the wrong length, a
/// triangle refers to a vertex that does not exist or is not finite, or no triangle has any area.
///
/// ```
/// use bevy_coating::surface::{Surface, clean};
/// use bevy_math::Vec3;
///
/// // Two triangles of a square that do not share their vertices, as exporters write them.
/// let (a, b, c, d) = (Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y);
/// let surface = Surface {
///     positions: vec![a, b, c, a, c, d],
///     triangles: vec![[0, 1, 2], [3, 4, 5]],
///     ..Surface::default()
/// };
/// let clean = clean(&surface)?;
/// assert_eq!(clean.positions.len(), 4, "welded");
/// assert_eq!(clean.triangles.len(), 2);
/// # Ok::<(), bevy_coating::surface::BuildError>(())
/// ```
pub fn clean(surface: &Surface) -> Result<CleanSurface, BuildError> {
    at_once(clean_in_pieces(surface, &mut NoRest))
}

/// Does what [`clean`] does, with rests between its pieces.
///
/// # Errors
/// See [`clean`].
pub(crate) async fn clean_in_pieces(surface: &Surface, rest: &mut impl Rest) -> Result<CleanSurface, BuildError> {
    validate::validate(surface)?;
    let welded = weld::weld(surface, rest).await;
    let mut positions = welded.positions;

    let mut faces = Vec::with_capacity(surface.triangles.len());
    for (t, triangle) in surface.triangles.iter().enumerate() {
        let vertices = triangle.map(|v| welded.vertex_of[v as usize]);
        if has_repeats(vertices) {
            continue;
        }
        let t = t as u32;
        faces.push(Face {
            vertices,
            corners: [3 * t, 3 * t + 1, 3 * t + 2],
            weights: [Vec3::X, Vec3::Y, Vec3::Z],
            source: t,
            flipped: false,
        });
    }
    let points_and_lines = surface.triangles.len() - faces.len();
    let is_filler = |face: &Face| sliver::is_filler(face, &positions, welded.tolerance);
    let duplicates = duplicates::drop_duplicates(&mut faces, is_filler, rest).await;
    let degenerate = points_and_lines + sliver::dissolve(&mut faces, &positions, welded.tolerance, rest).await;
    if faces.is_empty() {
        return Err(BuildError::AllDegenerate { triangles: surface.triangles.len() });
    }

    // Windings are unified over the manifold parts first, because the pairing of faces along edges with more
    // than two of them relies on windings.
    let mut edges = pair::Edges::new(&faces, rest).await;
    let mut twin = edges.pair_manifold(&faces, rest).await;
    let mut cut = orient::unify(&mut faces, &mut twin, &positions, rest).await;
    if faces.iter().any(|face| face.flipped) {
        edges = pair::Edges::new(&faces, rest).await;
    }
    edges.pair_others(&faces, &positions, &mut twin, rest).await;
    cut += orient::unify(&mut faces, &mut twin, &positions, rest).await;
    let split = fans::split(&mut faces, &mut twin, &mut positions, &edges, rest).await;

    let warnings = [
        (degenerate, BuildWarning::DegenerateDropped as fn(u32) -> _),
        (duplicates, BuildWarning::DuplicatesDropped),
        (edges.non_manifold(), BuildWarning::NonManifoldEdgesSplit),
        (split, BuildWarning::NonManifoldVerticesSplit),
        (cut, BuildWarning::OneSidedEdgesCut),
        (faces.iter().filter(|face| face.flipped).count(), BuildWarning::WindingTurned),
    ];
    let warnings = warnings.into_iter().filter(|(count, _)| *count > 0).map(|(count, warning)| warning(count as u32));
    let warnings = warnings.collect();
    rest.rest().await;
    Ok(collect(faces, &positions, warnings, rest).await)
}

/// Drops unused vertices and takes the faces apart into flat arrays.
async fn collect(
    faces: Vec<Face>,
    positions: &[Vec3],
    warnings: Vec<BuildWarning>,
    rest: &mut impl Rest,
) -> CleanSurface {
    let mut used = vec![false; positions.len()];
    for face in &faces {
        for v in face.vertices {
            used[v as usize] = true;
        }
    }
    let mut clean = CleanSurface { warnings, ..Default::default() };
    let mut new_index = vec![NONE; positions.len()];
    for (v, position) in positions.iter().enumerate().filter(|(v, _)| used[*v]) {
        new_index[v] = clean.positions.len() as u32;
        clean.positions.push(*position);
    }
    rest.rest().await;
    for piece in faces.chunks(LIGHT_PIECE) {
        for face in piece {
            clean.triangles.push(face.vertices.map(|v| new_index[v as usize]));
            clean.corners.push(face.corners);
            clean.sites.push(face.weights.map(|weights| SurfaceSite { triangle: face.source, weights }));
            clean.source.push(face.source);
            clean.flipped.push(face.flipped);
        }
        rest.rest().await;
    }
    clean
}
