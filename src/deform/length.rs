//! Length constraint: an edge keeps its rest length (VC 4.2).

use bevy_math::Vec3;

use crate::film::{FilmMesh, HalfEdgeId};

/// Length constraint: two vertices stay at the rest length of their edge (VC 4.2).
///
/// A bound edge has one, carried by its lower half-edge; a torn edge has one for each half-edge whose face is live.
/// [`FilmConstraints::lengths`](super::FilmConstraints::lengths) returns those of a film.
///
/// ```
/// use bevy_coating::{
///     deform::{FilmConstraints, update_constraints},
///     film::{FilmChanges, FilmMesh, VertexId},
/// };
/// use bevy_math::Vec3;
///
/// let corners = vec![Vec3::ZERO, Vec3::X, Vec3::ONE, Vec3::Y];
/// let mesh = FilmMesh::new(corners, &[[0, 1, 2], [0, 2, 3]])?;
/// let mut constraints = FilmConstraints::new(&mesh);
/// let changes = FilmChanges { separated: vec![VertexId(1)], ..FilmChanges::default() };
/// update_constraints(&mesh, &mut constraints, &changes);
///
/// // The two edges at the vertex that separated.
/// let lengths: Vec<_> = constraints.lengths(&mesh).collect();
/// assert_eq!([lengths[0].ends, lengths[1].ends], [[0, 1], [1, 2]]);
/// assert_eq!(lengths[0].rest, 1.0);
/// # Ok::<(), bevy_coating::film::TopologyError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LengthConstraint {
    /// Half-edge that carries the constraint.
    pub half_edge: HalfEdgeId,
    /// Indices of the two vertices: origin and target of the half-edge.
    pub ends: [u32; 2],
    /// Rest length d0, in the film's unit.
    pub rest: f32,
}

impl LengthConstraint {
    /// Returns the length constraint of the edge of `h`, carried by `h`.
    pub(super) fn of_edge(mesh: &FilmMesh, h: HalfEdgeId) -> Self {
        Self {
            half_edge: h,
            ends: [mesh.topology.origin(h).0, mesh.topology.target(h).0],
            rest: mesh.geometry.rest_lengths[h.index()],
        }
    }
}

/// Returns the corrections of the two ends at `p` with inverse masses `w`: VC 4.2, as printed. `None` where both are
/// fixed, the ends coincide, so that no direction is left, or lengths are beyond the range of floats.
#[inline]
pub(super) fn length_corrections(p: [Vec3; 2], w: [f32; 2], rest: f32) -> Option<[Vec3; 2]> {
    let mass = w[0] + w[1];
    let difference = p[0] - p[1];
    let length = length(difference);
    let quotient = (length - rest) / (mass * length);
    if !(mass > 0.0 && length > 0.0 && quotient.is_finite()) {
        return None;
    }
    let correction = difference * quotient;
    Some([-w[0] * correction, w[1] * correction])
}

/// Returns the length of `v`. The vector type's own length calls a library where it is built for the same bits on every
/// platform; a square root is exact everywhere, and here it must be one instruction.
#[inline]
pub(super) fn length(v: Vec3) -> f32 {
    v.length_squared().sqrt()
}
