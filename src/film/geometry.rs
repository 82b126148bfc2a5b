//! Positions of the film's vertices, and measures at rest: normals, lengths, angles and areas.

use bevy_math::{Vec3, ops};
use core::f32::consts::PI;

use super::{
    handles::{FaceId, HalfEdgeId, VertexId},
    topology::Topology,
};

/// Positions of the film's vertices at rest and now, and measures of the film at rest.
///
/// Positions are in the film's space: the prop's space with its world scale applied.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Geometry {
    /// Rest position of each vertex. A duplicate has that of its original.
    pub rest_positions: Vec<Vec3>,
    /// Rest normal of each vertex: the mean of its faces' normals, weighted by their angles at the vertex. It has unit
    /// length, or is zero if the normals cancel out.
    pub rest_normals: Vec<Vec3>,
    /// Current position of each vertex.
    pub positions: Vec<Vec3>,
    /// Rest length of each half-edge, in units of the film's space.
    pub rest_lengths: Vec<f32>,
    /// Rest value of the [signed dihedral angle](signed_dihedral) at each half-edge, in radians between 0 and 2 pi. It
    /// is pi on the border.
    pub rest_dihedrals: Vec<f32>,
    /// Mean rest length of the edges. Each edge counts once. This is h, the unit of settings that are
    /// given in mean film edges.
    pub mean_edge: f32,
    /// Rest area of all faces together, in square units of the film's space.
    pub rest_area: f32,
}

impl Geometry {
    /// Measures a film at rest. `positions` holds one entry for each vertex of `topology`.
    ///
    /// ```
    /// use bevy_coating::film::{Geometry, Topology};
    /// use bevy_math::Vec3;
    ///
    /// let topology = Topology::from_triangles(3, &[[0, 1, 2]])?;
    /// let geometry = Geometry::at_rest(&topology, vec![Vec3::ZERO, 3.0 * Vec3::X, 4.0 * Vec3::Y]);
    /// assert_eq!(geometry.rest_lengths, [3.0, 5.0, 4.0]);
    /// assert_eq!((geometry.mean_edge, geometry.rest_area), (4.0, 6.0));
    /// assert_eq!(geometry.rest_normals, [Vec3::Z; 3]);
    /// # Ok::<(), bevy_coating::film::TopologyError>(())
    /// ```
    pub fn at_rest(topology: &Topology, positions: Vec<Vec3>) -> Self {
        debug_assert_eq!(topology.vertex_count(), positions.len());
        let mut geometry = Self { positions: positions.clone(), rest_positions: positions, ..Self::default() };
        geometry.rest_normals = geometry.vertex_normals(topology);
        geometry.rest_lengths = topology
            .all_half_edges()
            .map(|h| {
                let (a, b) = (topology.origin(h), topology.target(h));
                geometry.rest_positions[a.index()].distance(geometry.rest_positions[b.index()])
            })
            .collect();
        geometry.rest_dihedrals =
            topology.all_half_edges().map(|h| geometry.rest_dihedral(topology, h).unwrap_or(PI)).collect();
        let (mut sum, mut edges) = (0.0f64, 0u32);
        for h in topology.all_edges() {
            sum += f64::from(geometry.rest_lengths[h.index()]);
            edges += 1;
        }
        geometry.mean_edge = (sum / f64::from(edges.max(1))) as f32;
        geometry.rest_area = topology
            .all_faces()
            .map(|f| {
                let [a, b, c] = topology.corners(f).map(|v| geometry.rest_positions[v.index()]);
                f64::from((b - a).cross(c - a).length()) * 0.5
            })
            .sum::<f64>() as f32;
        geometry
    }

    /// Returns the angle-weighted normal of each vertex at rest.
    fn vertex_normals(&self, topology: &Topology) -> Vec<Vec3> {
        let mut normals = vec![Vec3::ZERO; topology.vertex_count()];
        for f in topology.all_faces() {
            let corners = topology.corners(f);
            let p = corners.map(|v| self.rest_positions[v.index()]);
            let normal = (p[1] - p[0]).cross(p[2] - p[0]).normalize_or_zero();
            for i in 0..3 {
                let (a, b) = (p[(i + 1) % 3] - p[i], p[(i + 2) % 3] - p[i]);
                // atan2, because the arc cosine of a rounded cosine may not exist.
                let angle = ops::atan2(a.cross(b).length(), a.dot(b));
                normals[corners[i].index()] += normal * angle;
            }
        }
        for n in &mut normals {
            *n = n.normalize_or_zero();
        }
        normals
    }

    /// Appends a vertex with the positions and the rest normal of `v`.
    pub fn duplicate_vertex(&mut self, v: VertexId) {
        let i = v.index();
        self.rest_positions.push(self.rest_positions[i]);
        self.rest_normals.push(self.rest_normals[i]);
        self.positions.push(self.positions[i]);
    }

    /// Returns the centroid of `f` at rest.
    #[inline]
    pub fn rest_centroid(&self, topology: &Topology, f: FaceId) -> Vec3 {
        // A duplicate that was just made may have no entry here yet, but its original has the same position.
        let [a, b, c] = topology.corners(f).map(|v| self.rest_positions[topology.original(v).index()]);
        (a + b + c) / 3.0
    }

    /// Returns the area of `f` at rest, in square units of the film's space.
    pub fn rest_area_of(&self, topology: &Topology, f: FaceId) -> f32 {
        let [a, b, c] = topology.corners(f).map(|v| self.rest_positions[topology.original(v).index()]);
        // `f32::sqrt` rounds alike on every platform; the length of the vector type may call a library instead.
        (b - a).cross(c - a).length_squared().sqrt() * 0.5
    }

    /// Returns the height of `v` over the plane through its rest position and perpendicular to its rest normal, in
    /// units of the film's space. It is negative below that plane.
    #[inline]
    pub fn height(&self, v: VertexId) -> f32 {
        let i = v.index();
        (self.positions[i] - self.rest_positions[i]).dot(self.rest_normals[i])
    }

    /// Returns the current [signed dihedral angle](signed_dihedral) at the edge of `h`, in radians. Returns `None`
    /// where the edge is torn or on the border, and where a face has no area.
    pub fn dihedral(&self, topology: &Topology, h: HalfEdgeId) -> Option<f32> {
        let twin = topology.bound_twin(h)?;
        let [p1, p2, p3, p4] = [topology.origin(h), topology.target(h), topology.apex(h), topology.apex(twin)]
            .map(|v| self.positions[v.index()]);
        signed_dihedral(p1, p2, p3, p4)
    }

    fn rest_dihedral(&self, topology: &Topology, h: HalfEdgeId) -> Option<f32> {
        let twin = topology.rest_twin(h)?;
        let [p1, p2, p3, p4] = [topology.origin(h), topology.target(h), topology.apex(h), topology.apex(twin)]
            .map(|v| self.rest_positions[v.index()]);
        signed_dihedral(p1, p2, p3, p4)
    }
}

/// Returns the signed dihedral angle between face 1 = (p1, p2, p3) and face 2 = (p2, p1, p4), in radians between 0 and
/// 2 pi. Both faces are counter-clockwise seen from outside.
///
/// Flat is pi, a valley is below pi and a ridge above it. Returns `None` if a face has no area, or
/// is so small or large that the products of its lengths leave the range of floats.
///
/// VC 4.3 uses the arc cosine, which cannot tell valleys from ridges and is not smooth where the faces are flat. This
/// form uses the arc tangent of sine and cosine, and is smooth everywhere but where the faces are folded onto each
/// other.
///
/// ```
/// use bevy_coating::film::signed_dihedral;
/// use bevy_math::Vec3;
/// use std::f32::consts::PI;
///
/// let (a, b, left) = (Vec3::ZERO, Vec3::Y, Vec3::NEG_X);
/// assert_eq!(signed_dihedral(a, b, left, Vec3::X), Some(PI), "flat");
/// assert!(signed_dihedral(a, b, left, Vec3::new(1.0, 0.0, 0.5)).unwrap() < PI, "valley");
/// assert!(signed_dihedral(a, b, left, Vec3::new(1.0, 0.0, -0.5)).unwrap() > PI, "ridge");
/// ```
#[inline]
pub fn signed_dihedral(p1: Vec3, p2: Vec3, p3: Vec3, p4: Vec3) -> Option<f32> {
    let edge = p2 - p1;
    let length = edge.length_squared().sqrt();
    let n1 = edge.cross(p3 - p1);
    let n2 = edge.cross(p2 - p4);
    // Both values are scaled by the lengths of both normals, which the arc tangent ignores.
    let (sine, cosine) = (edge.dot(n1.cross(n2)) / length, n1.dot(n2));
    let whole = n1.length_squared() > 0.0 && n2.length_squared() > 0.0;
    // Lengths whose products leave the range of floats tell no angle.
    let finite = sine.is_finite() && cosine.is_finite();
    (whole && finite && (sine != 0.0 || cosine != 0.0)).then(|| PI + ops::atan2(sine, cosine))
}
