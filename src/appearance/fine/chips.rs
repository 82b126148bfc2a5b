//! Chipped outlines: both sides of a crack follow one irregular curve instead of the straight edge.
//!
//! The curve of an edge is a function of its number, so both sides know it. It begins and ends at the edge's ends, and
//! a crack that has not opened stays closed: one side gives what the other takes.

use bevy_math::{Vec3, ops};

use crate::film::{FilmMesh, HalfEdgeId};

/// Largest change of a barycentric coordinate by a chip, in either face at the torn edge. More would cut faces through.
const LARGEST_SHARE: f32 = 0.35;
/// Waves along an edge, with the share of the amplitude that each has. Found by trial.
const WAVES: [(f32, f32); 3] = [(3.0, 0.6), (7.0, 0.3), (15.0, 0.18)];
/// Exponent of the swell between the ends of an edge. Below 1 chips begin close to the ends.
const SWELL: f32 = 0.7;

/// Curve of one torn edge, seen from the face of one of its half-edges.
#[derive(Clone, Copy, Debug)]
pub(super) struct Chip {
    /// Lower half-edge of the edge: it decides the curve.
    edge: HalfEdgeId,
    /// Whether the face lies at that half-edge, so that the curve runs forwards.
    forward: bool,
    amplitude: f32,
    /// Corners of the face: origin and target of the half-edge, and the apex.
    corners: [usize; 3],
    /// Change of the barycentric coordinates of these three corners with the distance from the edge into the face.
    inwards: [f32; 3],
}

impl Chip {
    /// Returns the curve of the edge of `h` as seen from its face, with an amplitude of at most `most` metres. `None`
    /// where the edge is no crack: bound, or on the film's border at rest.
    pub fn of(mesh: &FilmMesh, h: HalfEdgeId, most: f32) -> Option<Self> {
        let topology = &mesh.topology;
        let twin = topology.rest_twin(h).filter(|_| topology.is_torn(h))?;
        let (own, other) = (Slope::of(mesh, h), Slope::of(mesh, twin));
        let amplitude = most.min(own.largest().min(other.largest()));
        if !(amplitude > 0.0) {
            return None;
        }
        let first = h.index() % 3;
        Some(Self {
            edge: topology.edge(h),
            forward: topology.edge(h) == h,
            amplitude,
            corners: [first, (first + 1) % 3, (first + 2) % 3],
            inwards: own.inwards(),
        })
    }

    /// Returns how far the point at the barycentric coordinates `b` is shifted into the face, in metres: less, the
    /// nearer it lies to the apex.
    pub fn shift(&self, b: Vec3) -> f32 {
        let [from, to, apex] = self.corners.map(|corner| b[corner]);
        let along = from + to;
        if along <= 0.0 {
            return 0.0;
        }
        let t = to / along;
        let curve = if self.forward { curve(self.edge.0, t) } else { -curve(self.edge.0, 1.0 - t) };
        self.amplitude * curve * (1.0 - apex) * (1.0 - apex)
    }

    /// Returns the change of barycentric coordinates by a shift of `distance` metres into the face.
    pub fn moved(&self, distance: f32) -> Vec3 {
        let mut change = Vec3::ZERO;
        for (corner, inwards) in self.corners.into_iter().zip(self.inwards) {
            change[corner] = distance * inwards;
        }
        change
    }
}

/// Shape of a face over one of its edges, at rest.
struct Slope {
    /// Distance of the apex from the edge.
    height: f32,
    /// Where the perpendicular from the apex meets the edge: 0 at the origin, 1 at the target.
    foot: f32,
}

impl Slope {
    fn of(mesh: &FilmMesh, h: HalfEdgeId) -> Self {
        let place = |h: HalfEdgeId| {
            let v = mesh.topology.original(mesh.topology.origin(h));
            mesh.geometry.rest_positions[v.index()]
        };
        let (from, along) = (place(h), place(h.next()) - place(h));
        let height = 2.0 * mesh.geometry.rest_area_of(&mesh.topology, h.face()) / mesh.geometry.rest_lengths[h.index()];
        Self { height, foot: (place(h.previous()) - from).dot(along) / along.length_squared() }
    }

    /// Returns the change of the barycentric coordinates of origin, target and apex with the distance from the edge.
    fn inwards(&self) -> [f32; 3] {
        [self.foot - 1.0, -self.foot, 1.0].map(|change| change / self.height)
    }

    /// Returns the largest amplitude: it keeps points near the face. A patch far beyond its own corners is anywhere.
    fn largest(&self) -> f32 {
        LARGEST_SHARE / self.inwards().into_iter().map(f32::abs).fold(0.0, f32::max)
    }
}

/// Returns the curve of the edge with the number `edge` at `t` between 0 and 1: between about -1 and 1, and 0 at both
/// ends.
fn curve(edge: u32, t: f32) -> f32 {
    let swell = ops::powf((4.0 * t * (1.0 - t)).max(0.0), SWELL);
    let waves = WAVES.iter().enumerate();
    swell * waves.map(|(i, (frequency, share))| share * noise(edge, i as u32, frequency * t)).sum::<f32>()
}

/// Returns smooth noise between -1 and 1 at `x`.
fn noise(edge: u32, wave: u32, x: f32) -> f32 {
    let cell = x.floor();
    let at = |step: f32| random(edge, wave, (cell + step) as u32);
    let t = x - cell;
    let eased = t * t * (3.0 - 2.0 * t);
    at(0.0) + (at(1.0) - at(0.0)) * eased
}

/// Returns a number between -1 and 1 that three numbers decide: a finaliser with good avalanche over their mixture.
fn random(edge: u32, wave: u32, cell: u32) -> f32 {
    let mut x = edge.wrapping_mul(0x9E37_79B9) ^ wave.wrapping_mul(0x85EB_CA6B) ^ cell.wrapping_mul(0xC2B2_AE35);
    x = (x ^ (x >> 16)).wrapping_mul(0x7FEB_352D);
    x = (x ^ (x >> 15)).wrapping_mul(0x846C_A68B);
    x ^= x >> 16;
    (x >> 8) as f32 / (1u32 << 23) as f32 - 1.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::tests::grid;

    #[test]
    fn both_sides_of_a_crack_follow_one_curve() {
        let (positions, triangles) = grid(2, 2);
        let mut mesh = FilmMesh::new(positions, &triangles).unwrap();
        let inner: Vec<_> = mesh.topology.all_edges().filter(|&h| mesh.topology.bound_twin(h).is_some()).collect();
        for h in inner {
            assert!(Chip::of(&mesh, h, 0.2).is_none(), "bound edges are straight");
            mesh.tear(h, Vec3::NEG_Y).unwrap();
            let twin = mesh.topology.rest_twin(h).unwrap();
            let [a, b] = [h, twin].map(|h| Chip::of(&mesh, h, 0.2).unwrap());
            let place = |chip: &Chip, h: HalfEdgeId, t: f32| {
                let mut at = Vec3::ZERO;
                at[chip.corners[0]] = 1.0 - t;
                at[chip.corners[1]] = t;
                let at = at + chip.moved(chip.shift(at));
                let corners = mesh.topology.corners(h.face()).map(|v| mesh.geometry.rest_positions[v.index()]);
                corners[0] * at.x + corners[1] * at.y + corners[2] * at.z
            };
            let mut largest = 0.0f32;
            for i in 0..=16 {
                let t = i as f32 / 16.0;
                let (one, other) = (place(&a, h, t), place(&b, twin, 1.0 - t));
                assert!(one.abs_diff_eq(other, 1e-5), "{one} and {other}");
                let straight = mesh.geometry.rest_positions[mesh.topology.origin(h).index()]
                    .lerp(mesh.geometry.rest_positions[mesh.topology.target(h).index()], t);
                largest = largest.max(one.distance(straight));
                assert!(one.distance(straight) <= 0.2 * 1.08 + 1e-6);
                if i == 0 || i == 16 {
                    assert!(one.abs_diff_eq(straight, 1e-6), "ends stay");
                }
            }
            assert!(largest > 0.02, "the edge is chipped: {largest}");
        }
    }
}
