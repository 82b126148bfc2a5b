//! The paper's test pieces: a plate, a curved plate and a disk, with an exact number of triangles.
//!
//! The paper's meshes are "uniformly random" (VC 3.3): edges of nearly one length, and no direction that
//! cracks could prefer. Here blue noise is relaxed until the edges are even, and triangulated (Delaunay);
//! the relaxation stops long before the points would settle into a lattice.
//!
//! All pieces are centred on the origin and face +z. Each comes as a film and as the surface it lies on, so
//! that it can wear a texture; the film's faces are the surface's triangles, one to one.

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

/// A test piece.
#[derive(Clone, Debug)]
pub struct TestPiece {
    /// The piece as a surface, with normals and texture coordinates. These span 0 to 1 over the piece's
    /// outline (unrolled, for the curved plate), u along x and v downward, as in glTF.
    pub surface: Surface,
    /// The film on it: face `i` is triangle `i` of the surface.
    pub film: BuiltFilm,
}

/// A square plate in the xy plane, side 1, centred on the origin, facing +z.
///
/// # Errors
/// [`BuildError::Resolution`] unless 2 to 10 million triangles are asked for.
pub fn plate(triangles: u32, seed: u64) -> Result<TestPiece, BuildError> {
    piece(Outline::Square, triangles, seed, |p| (p.as_vec2().extend(0.0), Vec3::Z))
}

/// A quarter of a cylinder around the y axis: height 1, arc length 1 (so the radius is 2/pi), its convex side
/// facing outward, its middle facing +z.
///
/// # Errors
/// [`BuildError::Resolution`] unless 2 to 10 million triangles are asked for.
pub fn curved_plate(triangles: u32, seed: u64) -> Result<TestPiece, BuildError> {
    piece(Outline::Square, triangles, seed, |p| {
        let (sin, cos) = ops::sin_cos((FRAC_PI_2 * p.x) as f32);
        let normal = Vec3::new(sin, 0.0, cos);
        (normal * FRAC_2_PI as f32 + Vec3::Y * p.y as f32, normal)
    })
}

/// A disk in the xy plane, radius 1, centred on the origin, facing +z.
///
/// # Errors
/// [`BuildError::Resolution`] unless 6 to 10 million triangles are asked for.
pub fn disk(triangles: u32, seed: u64) -> Result<TestPiece, BuildError> {
    piece(Outline::Disk, triangles, seed, |p| (p.as_vec2().extend(0.0), Vec3::Z))
}

/// Triangulates the outline and maps it into space: `place` gives position and normal of a planar point.
fn piece(
    outline: Outline,
    triangles: u32,
    seed: u64,
    place: impl Fn(DVec2) -> (Vec3, Vec3),
) -> Result<TestPiece, BuildError> {
    let (points, triangles) = scatter::triangulate(outline, triangles, seed)?;
    let (positions, normals): (Vec<Vec3>, Vec<Vec3>) = points.iter().map(|&p| place(p)).unzip();
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
