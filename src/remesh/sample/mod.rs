//! Makes the paper's test pieces with an exact number of triangles: a plate, a curved plate and a disk.
//!
//! The paper's meshes are "uniformly random" (VC 3.3): their edges have nearly one length, and no direction is
//! preferred that cracks could follow. Here blue noise is relaxed until the edges are even, and triangulated
//! (Delaunay). The relaxation stops long before the points form a lattice.
//!
//! All pieces are centred on the origin and face +z. Each is a film together with the surface on which it lies, so that
//! it can have a texture. The film's faces are the surface's triangles, one to one.

mod outline;
mod scatter;

#[cfg(test)]
mod tests;

use std::f64::consts::{FRAC_2_PI, FRAC_PI_2};

use bevy_math::{DVec2, Vec2, Vec3, ops};

use crate::{
    remesh::film::BuiltFilm,
    surface::{BuildError, Surface, SurfaceSite},
};
use outline::Outline;

/// Test piece: a film and the surface on which it lies.
#[derive(Clone, Debug)]
pub struct TestPiece {
    /// Surface of the piece, with normals and texture coordinates. Texture coordinates run from 0 to 1 over the
    /// bounding square of the piece (of the unrolled curved plate), u along x and v downward, as in glTF.
    pub surface: Surface,
    /// Film on the surface. Face `i` is triangle `i` of the surface.
    pub film: BuiltFilm,
}

/// Makes a square plate with side 1 in the xy plane. It is centred on the origin and faces +z.
///
/// The same seed gives the same plate, to the bit.
///
/// # Errors
/// [`BuildError::Resolution`] unless 2 to 10 million triangles are asked for.
///
/// ```
/// use bevy_coating::{film::FilmMesh, remesh::sample::plate};
///
/// let piece = plate(500, 7)?;
/// assert_eq!(piece.film.triangles.len(), 500);
/// let film = FilmMesh::new(piece.film.positions, &piece.film.triangles).unwrap();
/// assert!((film.geometry.rest_area - 1.0).abs() < 1e-4);
/// # Ok::<(), bevy_coating::surface::BuildError>(())
/// ```
pub fn plate(triangles: u32, seed: u64) -> Result<TestPiece, BuildError> {
    piece(Outline::Square, triangles, seed, |p| (p.as_vec2().extend(0.0), Vec3::Z))
}

/// Makes a quarter of a cylinder around the y axis, with height 1, arc length 1 and so radius 2/pi. The film is on its
/// convex side, and its middle faces +z.
///
/// # Errors
/// [`BuildError::Resolution`] unless 2 to 10 million triangles are asked for.
///
/// ```
/// use bevy_coating::remesh::sample::curved_plate;
/// use std::f32::consts::FRAC_2_PI;
///
/// let piece = curved_plate(200, 7)?;
/// assert!(piece.film.positions.iter().all(|p| (p.x.hypot(p.z) - FRAC_2_PI).abs() < 1e-5));
/// # Ok::<(), bevy_coating::surface::BuildError>(())
/// ```
pub fn curved_plate(triangles: u32, seed: u64) -> Result<TestPiece, BuildError> {
    piece(Outline::Square, triangles, seed, |p| {
        let (sin, cos) = ops::sin_cos((FRAC_PI_2 * p.x) as f32);
        let normal = Vec3::new(sin, 0.0, cos);
        (normal * FRAC_2_PI as f32 + Vec3::Y * p.y as f32, normal)
    })
}

/// Makes a disk with radius 1 in the xy plane. It is centred on the origin and faces +z.
///
/// # Errors
/// [`BuildError::Resolution`] unless 6 to 10 million triangles are asked for.
///
/// ```
/// use bevy_coating::remesh::sample::disk;
///
/// let piece = disk(300, 7)?;
/// assert_eq!(piece.surface.triangles.len(), 300);
/// assert!(disk(3, 7).is_err());
/// # Ok::<(), bevy_coating::surface::BuildError>(())
/// ```
pub fn disk(triangles: u32, seed: u64) -> Result<TestPiece, BuildError> {
    piece(Outline::Disk, triangles, seed, |p| (p.as_vec2().extend(0.0), Vec3::Z))
}

/// Triangulates the outline and maps it into space. `map` returns the position and the normal of a planar point.
fn piece(
    outline: Outline,
    triangles: u32,
    seed: u64,
    map: impl Fn(DVec2) -> (Vec3, Vec3),
) -> Result<TestPiece, BuildError> {
    let (points, triangles) = scatter::triangulate(outline, triangles, seed)?;
    let (positions, normals): (Vec<Vec3>, Vec<Vec3>) = points.iter().map(|&p| map(p)).unzip();
    let uv = |p: DVec2| {
        let p = p.as_vec2() / outline.extent() as f32;
        Vec2::new(0.5 + p.x, 0.5 - p.y)
    };
    let corners = || triangles.iter().flatten().map(|&v| v as usize);
    let surface = Surface {
        normals: corners().map(|v| normals[v]).collect(),
        uvs: corners().map(|v| uv(points[v])).collect(),
        positions: positions.clone(),
        triangles: triangles.clone(),
        ..Default::default()
    };
    let film = BuiltFilm {
        positions,
        slots: vec![0; triangles.len()],
        flipped: vec![false; triangles.len()],
        sites: (0..triangles.len() as u32)
            .flat_map(|triangle| [Vec3::X, Vec3::Y, Vec3::Z].map(|weights| SurfaceSite { triangle, weights }))
            .collect(),
        triangles,
        warnings: Vec::new(),
    };
    Ok(TestPiece { surface, film })
}
