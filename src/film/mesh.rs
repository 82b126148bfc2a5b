//! The film mesh: connectivity and positions together, and the tear that keeps both in step.

use bevy_math::Vec3;

use super::{
    direction::unit_or_zero,
    edit::TearEnd,
    geometry::Geometry,
    handles::{FaceId, HalfEdgeId},
    topology::{Topology, TopologyError},
};
use crate::rest::{NoRest, Rest, at_once};

/// The film of one coated prop: a half-edge triangle mesh with its positions.
#[derive(Clone, Debug, Default, PartialEq)]
#[cfg_attr(feature = "plugin", derive(bevy::ecs::component::Component), component(clone_behavior = Ignore))]
pub struct FilmMesh {
    /// Connectivity of vertices, half-edges and faces.
    pub topology: Topology,
    /// Positions at rest and now, one for each vertex of [`topology`](Self::topology), and rest measures.
    pub geometry: Geometry,
}

/// Coordinates nearer to zero than this count as zero. In the solver's unit they would lose bits, and products of them
/// leave single precision; and no film is so small that it could tell.
const LEAST_COORDINATE: f32 = 1e-30;

impl FilmMesh {
    /// Builds a film at rest. `triangles` index `positions` and are counter-clockwise seen from outside. Coordinates
    /// below 1e-30 count as zero.
    ///
    /// The triangles must form an oriented manifold; [`clean`](crate::surface::clean) makes one of any triangles.
    ///
    /// # Errors
    /// [`TopologyError`] if the triangles do not form an oriented manifold.
    ///
    /// ```
    /// use bevy_coating::film::FilmMesh;
    /// use bevy_math::Vec3;
    ///
    /// let film = FilmMesh::new(vec![Vec3::ZERO, Vec3::X, Vec3::Y], &[[0, 1, 2]])?;
    /// assert_eq!(film.topology.face_count(), 1);
    /// assert_eq!(film.geometry.rest_area, 0.5);
    ///
    /// assert!(FilmMesh::new(vec![Vec3::ZERO, Vec3::X], &[[0, 1, 1]]).is_err());
    /// # Ok::<(), bevy_coating::film::TopologyError>(())
    /// ```
    pub fn new(positions: Vec<Vec3>, triangles: &[[u32; 3]]) -> Result<Self, TopologyError> {
        at_once(Self::new_in_pieces(positions, triangles, &mut NoRest))
    }

    /// Does what [`new`](Self::new) does, with rests between its pieces.
    ///
    /// # Errors
    /// See [`new`](Self::new).
    pub(crate) async fn new_in_pieces(
        mut positions: Vec<Vec3>,
        triangles: &[[u32; 3]],
        rest: &mut impl Rest,
    ) -> Result<Self, TopologyError> {
        for p in &mut positions {
            // Times zero: the sign stays, and with it every bit of a zero that was one already.
            *p = Vec3::select(p.abs().cmplt(Vec3::splat(LEAST_COORDINATE)), *p * 0.0, *p);
        }
        let topology = Topology::in_pieces(positions.len(), triangles, rest).await?;
        let geometry = Geometry::at_rest(&topology, positions);
        rest.rest().await;
        Ok(Self { topology, geometry })
    }

    /// Tears the edge of `h` and gives every new vertex a position (VC 5.2).
    ///
    /// Returns what became of the origin and the target of `h`, in this order. Returns `None`, and changes nothing, if
    /// the edge does not join two live faces. See [`Topology::tear`].
    ///
    /// Where the faces of an end fall into two fans, the fan that lies further along `gravity` keeps the vertex, and
    /// the other fan gets a duplicate of it. Fans are compared by the mean of their faces' centroids at rest; at a tie,
    /// the fan with the face of the lowest id keeps the vertex. Only the direction of `gravity` matters; one that is
    /// not finite counts as none.
    ///
    /// Forces, constraints and stains must follow: outside this crate,
    /// [`FilmState::tear_edge`](crate::sim::FilmState::tear_edge) does all of it.
    pub(crate) fn tear(&mut self, h: HalfEdgeId, gravity: Vec3) -> Option<[TearEnd; 2]> {
        let gravity = unit_or_zero(gravity);
        let Self { topology, geometry } = self;
        let ends = topology.tear(h, |topology, a, b| {
            let (depth_a, face_a) = fan_depth(topology, geometry, a, gravity);
            let (depth_b, face_b) = fan_depth(topology, geometry, b, gravity);
            if depth_a == depth_b { face_a < face_b } else { depth_a > depth_b }
        })?;
        for end in ends {
            if let TearEnd::Split { kept, .. } = end {
                geometry.duplicate_vertex(kept);
            }
        }
        Some(ends)
    }
}

/// Returns the mean depth along `gravity` of the fan that starts at `first`, and the lowest id of its faces.
pub(super) fn fan_depth(topology: &Topology, geometry: &Geometry, first: HalfEdgeId, gravity: Vec3) -> (f32, FaceId) {
    let (mut depth, mut faces, mut lowest) = (0.0, 0.0, FaceId::NONE);
    for h in topology.fan_at(first) {
        depth += geometry.rest_centroid(topology, h.face()).dot(gravity);
        faces += 1.0;
        lowest = lowest.min(h.face());
    }
    (depth / faces, lowest)
}
