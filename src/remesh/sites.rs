//! Makes the film of the working mesh: compact arrays, with the point of the prop's surface under each corner.

use super::film::{BuiltFilm, MAX_FILM_TRIANGLES};
use super::project::Foot;
use super::work_mesh::WorkMesh;
use crate::{
    film::{FaceId, VertexId},
    rest::{PIECE, Rest, pieces},
    surface::{BuildError, CleanSurface, Surface, SurfaceSite},
};

/// Numbers the live vertices and faces in order and finds the site of every corner.
pub(super) async fn finish(
    mesh: &WorkMesh<'_>,
    surface: &Surface,
    clean: &CleanSurface,
    rest: &mut impl Rest,
) -> BuiltFilm {
    let mut film = BuiltFilm { warnings: clean.warnings.clone(), ..BuiltFilm::default() };
    let mut numbers = vec![VertexId::NONE; mesh.topology.vertex_slots()];
    let mut number = |film: &mut BuiltFilm, v: VertexId| {
        if numbers[v.index()] == VertexId::NONE {
            numbers[v.index()] = VertexId::new(film.positions.len());
            film.positions.push(mesh.position(v));
        }
        numbers[v.index()].0
    };
    for piece in pieces(mesh.topology.face_slots(), 4 * PIECE) {
        for f in piece.map(FaceId::new).filter(|&f| mesh.topology.is_live(f)) {
            let triangle = mesh.topology.corners(f).map(|v| number(&mut film, v));
            film.triangles.push(triangle);
            let feet = f.half_edges().map(|h| mesh.corner(h));
            film.sites.extend(feet.iter().map(|foot| site(clean, foot)));
            // Slots and turned winding are the same all over a patch, so any corner will do.
            let triangle = feet[0].triangle.index();
            let source = clean.source[triangle];
            film.slots.push(surface.slots.get(source as usize).copied().unwrap_or_default());
            film.flipped.push(clean.flipped[triangle]);
        }
        rest.rest().await;
    }
    film
}

/// Makes a film of the clean mesh itself.
pub(super) fn keep(surface: &Surface, clean: &CleanSurface) -> Result<BuiltFilm, BuildError> {
    let found = clean.triangles.len();
    if found > MAX_FILM_TRIANGLES {
        return Err(BuildError::TooLarge { found, limit: MAX_FILM_TRIANGLES });
    }
    Ok(BuiltFilm {
        positions: clean.positions.clone(),
        triangles: clean.triangles.clone(),
        slots: clean.source.iter().map(|&t| surface.slots.get(t as usize).copied().unwrap_or_default()).collect(),
        flipped: clean.flipped.clone(),
        sites: clean.sites.iter().flatten().copied().collect(),
        warnings: clean.warnings.clone(),
    })
}

/// Turns weights of a clean triangle into weights of the surface triangle it came from.
///
/// The corners of a clean triangle may lie between those of its source.
pub(super) fn site(clean: &CleanSurface, foot: &Foot) -> SurfaceSite {
    let triangle = foot.triangle.index();
    let [a, b, c] = clean.sites[triangle].map(|site| site.weights);
    let weights = a * foot.weights.x + b * foot.weights.y + c * foot.weights.z;
    SurfaceSite { triangle: clean.source[triangle], weights }
}
