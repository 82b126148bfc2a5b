//! Checks that indices are in range, positions are finite and attributes have the right length. The stages rely on it.

use crate::surface::{error::BuildError, prop_surface::Surface};

/// Most triangles that a surface may have: half-edges, corners and split vertices must fit in `u32`, and remeshing may
/// double the number.
pub(super) const MAX_TRIANGLES: usize = (u32::MAX / 8) as usize;

pub(super) fn validate(surface: &Surface) -> Result<(), BuildError> {
    let count = surface.triangles.len();
    if count == 0 {
        return Err(BuildError::NoTriangles);
    }
    if count > MAX_TRIANGLES {
        return Err(BuildError::TooLarge { found: count, limit: MAX_TRIANGLES });
    }
    let lengths = [
        ("slots", surface.slots.len(), count),
        ("normals", surface.normals.len(), 3 * count),
        ("texture coordinates", surface.uvs.len(), 3 * count),
        ("second texture coordinates", surface.uvs_1.len(), 3 * count),
        ("tangents", surface.tangents.len(), 3 * count),
        ("colors", surface.colors.len(), 3 * count),
    ];
    for (attribute, found, expected) in lengths {
        if found != 0 && found != expected {
            return Err(BuildError::AttributeLength { attribute, found, expected });
        }
    }
    let vertices = surface.positions.len();
    for (triangle, corners) in surface.triangles.iter().enumerate() {
        for &vertex in corners {
            let Some(&position) = surface.positions.get(vertex as usize) else {
                return Err(BuildError::IndexOutOfRange { triangle: triangle as u32, vertex, vertices });
            };
            if !position.is_finite() {
                return Err(BuildError::NonFinitePosition { vertex, position });
            }
        }
    }
    Ok(())
}
