//! Computes eight points of a face at once, which the compiler turns into vector instructions.
//!
//! Each point takes the same operations in the same order, so vectors change no bit.

use bevy_math::{Mat3A, Vec3};

use super::patch::{Patch, weights};

/// Number of points that are computed at once.
pub(super) const LANES: usize = 8;

/// One number for each of eight points.
pub(super) type Lanes = [f32; LANES];

/// Where up to eight points of a face lie on it.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Places {
    /// Weights of a patch's control points.
    weights: [Lanes; 10],
    /// Barycentric coordinates.
    b: [Lanes; 3],
}

impl Places {
    /// Returns the places of all of `points`, eight in each.
    pub fn all(points: &[Vec3]) -> Vec<Self> {
        let places = |points: &[Vec3]| {
            let mut places = Self::default();
            for lane in 0..LANES {
                // What no point needs is like the first one, so that it is a number.
                places.set(lane, points.get(lane).copied().unwrap_or(points[0]));
            }
            places
        };
        points.chunks(LANES).map(places).collect()
    }

    /// Puts the point of one lane at the barycentric coordinates `b`.
    pub fn set(&mut self, lane: usize, b: Vec3) {
        for (lanes, weight) in self.weights.iter_mut().zip(weights(b)) {
            lanes[lane] = weight;
        }
        for (lanes, b) in self.b.iter_mut().zip(b.to_array()) {
            lanes[lane] = b;
        }
    }

    /// Returns the barycentric coordinates of the point of one lane.
    pub fn at(&self, lane: usize) -> Vec3 {
        let [x, y, z] = &self.b;
        Vec3::new(x[lane], y[lane], z[lane])
    }

    /// Returns the unit mean of three vectors at each point; the first one where the mean is zero.
    pub fn mean(&self, vectors: [Vec3; 3]) -> [Lanes; 3] {
        let [p, q, r] = vectors.map(|v| v.to_array());
        let [bx, by, bz] = &self.b;
        let mut mean = [[0.0; LANES]; 3];
        for l in 0..LANES {
            let [x, y, z] = [0, 1, 2].map(|i| p[i] * bx[l] + q[i] * by[l] + r[i] * bz[l]);
            [mean[0][l], mean[1][l], mean[2][l]] = unit([x, y, z], p);
        }
        mean
    }
}

/// Up to eight points at rest.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct AtRest {
    pub positions: [Lanes; 3],
    pub normals: [Lanes; 3],
    pub tangents: [Lanes; 3],
}

/// The same points on a face that has moved.
pub(super) type Bent = AtRest;

/// A face as it is now, and how its corners have turned.
pub(super) struct Bend {
    /// Control points of the patch over the face.
    pub patch: Patch,
    /// Rotations of the corners since rest.
    pub rotations: [Mat3A; 3],
    /// Normals of the film at the corners at rest.
    pub rest_normals: [Vec3; 3],
}

impl Bend {
    /// Returns what becomes of points at `places` that lie `offsets` beside the patch at rest: the offset, the normal
    /// and the tangent turn with the face, and nothing dips below its place at rest.
    pub fn of(&self, places: &Places, rest: &AtRest, offsets: &[Lanes; 3]) -> Bent {
        let points = self.patch.control_points().map(|point| point.to_array());
        let turns = self.rotations.map(|turn| turn.to_cols_array());
        let ups = self.rest_normals.map(|up| up.to_array());
        let Places { weights, b: [bx, by, bz] } = places;
        let mut bent = Bent::default();
        for l in 0..LANES {
            let mix = |p: f32, q: f32, r: f32| p * bx[l] + q * by[l] + r * bz[l];
            // Columns of the rotation.
            let turn: [f32; 9] = std::array::from_fn(|i| mix(turns[0][i], turns[1][i], turns[2][i]));
            let rotate = |v: &[Lanes; 3]| -> [f32; 3] {
                std::array::from_fn(|i| turn[i] * v[0][l] + turn[i + 3] * v[1][l] + turn[i + 6] * v[2][l])
            };
            let on_patch = |i: usize| {
                let mut sum = points[0][i] * weights[0][l];
                for k in 1..10 {
                    sum += points[k][i] * weights[k][l];
                }
                sum
            };
            let offset = rotate(offsets);
            let [x, y, z] = [0, 1, 2].map(|i| on_patch(i) + offset[i]);
            // Patches between film that has moved and film that has not may dip through the metal.
            let up = [0, 1, 2].map(|i| mix(ups[0][i], ups[1][i], ups[2][i]));
            // Around a thin pole the normals that it is a mean of may nearly cancel out: only its direction counts.
            let up = unit(up, [0.0; 3]);
            let [px, py, pz] = [0, 1, 2].map(|i| rest.positions[i][l]);
            let below = ((x - px) * up[0] + (y - py) * up[1] + (z - pz) * up[2]).min(0.0);
            bent.positions[0][l] = x - up[0] * below;
            bent.positions[1][l] = y - up[1] * below;
            bent.positions[2][l] = z - up[2] * below;
            let rest_normal = [0, 1, 2].map(|i| rest.normals[i][l]);
            let n = unit(rotate(&rest.normals), rest_normal);
            let t = rotate(&rest.tangents);
            let along = t[0] * n[0] + t[1] * n[1] + t[2] * n[2];
            let flat = [0, 1, 2].map(|i| t[i] - n[i] * along);
            let t = unit(flat, [0, 1, 2].map(|i| rest.tangents[i][l]));
            for i in 0..3 {
                bent.normals[i][l] = n[i];
                bent.tangents[i][l] = t[i];
            }
        }
        bent
    }
}

/// Returns a vector scaled to unit length, or `or` if it has none.
#[inline]
fn unit(v: [f32; 3], or: [f32; 3]) -> [f32; 3] {
    let length = (v[0] * v[0] + v[1] * v[1] + v[2] * v[2]).sqrt();
    let scale = 1.0 / length;
    std::array::from_fn(|i| if length > 0.0 { v[i] * scale } else { or[i] })
}

/// Collects up to eight vectors.
#[inline]
pub(super) fn collect(vectors: impl ExactSizeIterator<Item = [f32; 3]>) -> [Lanes; 3] {
    let mut lanes = [[0.0; LANES]; 3];
    for (lane, vector) in vectors.take(LANES).enumerate() {
        for (lanes, x) in lanes.iter_mut().zip(vector) {
            lanes[lane] = x;
        }
    }
    lanes
}

/// Writes up to eight vectors.
#[inline]
pub(super) fn spread(lanes: &[Lanes; 3], to: &mut [[f32; 3]]) {
    for (lane, to) in to.iter_mut().take(LANES).enumerate() {
        *to = [lanes[0][lane], lanes[1][lane], lanes[2][lane]];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A face in the plane z = 0 whose corners have turned by `rotations`.
    fn face(corners: [Vec3; 3], rotations: [Mat3A; 3]) -> Bend {
        let normals = rotations.map(|turn| turn * Vec3::Z);
        Bend {
            patch: Patch::new(corners.map(Into::into), normals.map(Into::into)),
            rotations,
            rest_normals: [Vec3::Z; 3],
        }
    }

    #[test]
    fn offsets_normals_and_tangents_turn_with_the_face() {
        let corners = [Vec3::ZERO, Vec3::X, Vec3::Y];
        let turn = Mat3A::from_rotation_x(0.7) * Mat3A::from_rotation_y(-0.4);
        let b: Vec<Vec3> = (0..LANES).map(|i| Vec3::new(0.1 * i as f32, 0.2, 0.8 - 0.1 * i as f32)).collect();
        let places = &Places::all(&b)[0];
        assert_eq!(places.at(3), b[3]);
        let at = |b: &Vec3| corners[0] * b.x + corners[1] * b.y + corners[2] * b.z;
        // High above its place at rest, so that nothing dips.
        let raised = corners.map(|corner| turn * corner + Vec3::Z * 5.0);
        let bend = face(raised, [turn; 3]);
        let offset = Vec3::new(0.0, 0.0, 0.3);
        let rest = AtRest {
            positions: collect(b.iter().map(|b| (at(b) + offset).to_array())),
            normals: collect(b.iter().map(|_| [0.0, 0.6, 0.8])),
            tangents: collect(b.iter().map(|_| [1.0, 0.0, 0.0])),
        };
        let bent = bend.of(places, &rest, &collect(b.iter().map(|_| offset.to_array())));
        let mut found = [[0.0; 3]; LANES];
        let mut check = |lanes: &[Lanes; 3], expected: &dyn Fn(&Vec3) -> Vec3| {
            spread(lanes, &mut found);
            for (found, b) in found.iter().zip(&b) {
                assert!(Vec3::from_array(*found).abs_diff_eq(expected(b), 1e-5), "{found:?} at {b}");
            }
        };
        check(&bent.positions, &|b| turn * (at(b) + offset) + Vec3::Z * 5.0);
        check(&bent.normals, &|_| turn * Vec3::new(0.0, 0.6, 0.8));
        check(&bent.tangents, &|_| turn * Vec3::X);
        check(&places.mean([Vec3::X, Vec3::Y, Vec3::Z]), &|b| b.normalize());
    }

    #[test]
    fn what_dips_is_lifted_and_comes_no_further_from_the_surface() {
        for up in [Vec3::Z, Vec3::Z * 1e-4, Vec3::new(0.6, 0.0, 0.8) * 1e-3, Vec3::ZERO, -Vec3::Z] {
            let place = Vec3::new(0.3, 0.2, -0.4);
            let mut bend = face([place; 3], [Mat3A::IDENTITY; 3]);
            bend.rest_normals = [up; 3];
            let rest = AtRest::default();
            let bent = bend.of(&Places::all(&[Vec3::splat(1.0 / 3.0)])[0], &rest, &[[0.0; LANES]; 3]);
            let found = Vec3::from(bent.positions.map(|lanes| lanes[0]));
            assert!(found.dot(up) >= -1e-6 * up.length(), "it lies above");
            assert!(found.length() <= place.length() * 1.00001, "{up}: {found}");
            if up.dot(place) >= 0.0 {
                assert!(found.abs_diff_eq(place, 1e-6), "what lies above stays");
            }
        }
    }
}
