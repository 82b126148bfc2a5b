//! What each corner of a film wears: the prop's attributes at its place on the surface, turned with the film.

use bevy_coating::{
    film::{FaceId, HalfEdgeId, build::SurfaceSite},
    sim::FilmState,
};
use bevy_math::{Mat3, Vec2, Vec3, Vec4};

use super::{Corner, turn::rotations};
use crate::common::props::Prop;

/// Corners of a vertex whose rest normals are nearer than this cosine are one smooth surface.
const SMOOTH: f32 = 0.999;

/// Attributes of all corners, three a face.
pub struct Corners {
    rest: Vec<Corner>,
    /// Normal and tangent now.
    turned: Vec<(Vec3, Vec4)>,
}

impl Corners {
    pub fn new(prop: &Prop, film: &FilmState) -> Self {
        let faces = film.mesh.topology.all_faces();
        let rest: Vec<Corner> = faces.flat_map(|f| [0, 1, 2].map(|i| rest_corner(prop, film, f, i))).collect();
        let turned = turn(film, &rest);
        Self { rest, turned }
    }

    /// Corner `i` of `f` at rest.
    pub fn at_rest(&self, f: FaceId, i: usize) -> Corner {
        self.rest[f.index() * 3 + i]
    }

    /// Corner `i` of `f` now.
    pub fn at(&self, f: FaceId, i: usize) -> Corner {
        let (normal, tangent) = self.turned[f.index() * 3 + i];
        Corner { normal, tangent, ..self.at_rest(f, i) }
    }
}

fn rest_corner(prop: &Prop, film: &FilmState, f: FaceId, i: usize) -> Corner {
    let (surface, built) = (&prop.surface, &prop.built);
    let site = built.sites.get(f.index() * 3 + i);
    let of_face = {
        let [a, b, c] = film.mesh.topology.corners(f).map(|v| film.mesh.geometry.rest_positions[v.index()]);
        (b - a).cross(c - a).normalize_or(Vec3::Y)
    };
    let blended = site.and_then(|site| blend(&surface.normals, site, Vec3::ZERO)).and_then(Vec3::try_normalize);
    let stored = blended.unwrap_or_else(|| {
        // Without normals of its own the prop is shown flat, as glTF asks for: each triangle has its own.
        let flat = site.and_then(|site| flat_normal(prop, site)).unwrap_or(of_face);
        if flat.dot(of_face) < 0.0 { -flat } else { flat }
    });
    // Where winding was unified the film may face the other way than the prop's normals say.
    let turned_over = built.flipped.get(f.index()).is_some_and(|&flipped| flipped) && stored.dot(of_face) < 0.0;
    let side = if turned_over { -1.0 } else { 1.0 };
    let normal = stored * side;
    let tangent = site.and_then(|site| {
        let tangent = blend(&surface.tangents, site, Vec4::ZERO)?;
        let hand = if tangent.w < 0.0 { -side } else { side };
        Some(orthogonal(tangent.truncate(), normal).extend(hand))
    });
    Corner {
        normal,
        tangent: tangent.unwrap_or_else(|| normal.any_orthonormal_vector().extend(1.0)),
        uv: site.and_then(|site| blend(&surface.uvs, site, Vec2::ZERO)).unwrap_or_default(),
        uv_1: site.and_then(|site| blend(&surface.uvs_1, site, Vec2::ZERO)).unwrap_or_default(),
        color: site
            .and_then(|site| blend(&surface.colors, site, Vec4::ZERO))
            .map_or(Vec4::ONE, |color| color.clamp(Vec4::ZERO, Vec4::ONE)),
    }
}

/// The attribute at `site`; `None` if the surface has it not.
fn blend<T>(values: &[T], site: &SurfaceSite, zero: T) -> Option<T>
where
    T: Copy + std::ops::Add<Output = T> + std::ops::Mul<f32, Output = T>,
{
    let first = site.triangle as usize * 3;
    let corners = values.get(first..first + 3)?;
    let weights = site.weights.to_array();
    // A site on a corner takes it as it is.
    if let Some(i) = weights.iter().position(|&w| w == 1.0) {
        return corners.get(i).copied();
    }
    Some(corners.iter().zip(weights).fold(zero, |sum, (&value, w)| sum + value * w))
}

fn flat_normal(prop: &Prop, site: &SurfaceSite) -> Option<Vec3> {
    let corner = |v: u32| prop.surface.positions.get(v as usize).copied();
    let &[a, b, c] = prop.surface.triangles.get(site.triangle as usize)?;
    let (a, b, c) = (corner(a)?, corner(b)?, corner(c)?);
    (b - a).cross(c - a).try_normalize()
}

/// The part of `tangent` at right angles to `normal`, of unit length.
fn orthogonal(tangent: Vec3, normal: Vec3) -> Vec3 {
    (tangent - normal * tangent.dot(normal)).try_normalize().unwrap_or_else(|| normal.any_orthonormal_vector())
}

/// Turns normals and tangents with the faces. At each vertex the corners of one smooth surface share the mean.
fn turn(film: &FilmState, rest: &[Corner]) -> Vec<(Vec3, Vec4)> {
    let topology = &film.mesh.topology;
    let rotations = rotations(&film.mesh);
    let mut turned: Vec<(Vec3, Vec4)> = rest.iter().map(|corner| (corner.normal, corner.tangent)).collect();
    let (mut fan, mut rest_fan): (Vec<HalfEdgeId>, Vec<HalfEdgeId>) = (Vec::new(), Vec::new());
    for v in topology.all_vertices() {
        fan.clear();
        fan.extend(topology.fan(v));
        if fan.iter().all(|h| rotations[h.face().index()].is_none()) {
            continue;
        }
        // Half-edge 3 f + i starts at corner i of face f, so it stands for the corner too.
        while let Some(&first) = fan.first() {
            let chosen = rest[first.index()];
            rest_fan.clear();
            fan.retain(|&h| {
                let same = alike(&rest[h.index()], &chosen);
                if same {
                    rest_fan.push(h);
                }
                // The first always goes, though its values may be no numbers.
                !same && h != first
            });
            let turn = |h: &HalfEdgeId, x: Vec3| rotations[h.face().index()].map_or(x, |r: Mat3| r * x);
            let normal = rest_fan.iter().map(|h| turn(h, chosen.normal)).sum::<Vec3>();
            let normal = normal.try_normalize().unwrap_or(chosen.normal);
            let tangent = rest_fan.iter().map(|h| turn(h, chosen.tangent.truncate())).sum::<Vec3>();
            let tangent = orthogonal(tangent, normal).extend(chosen.tangent.w);
            for h in &rest_fan {
                turned[h.index()] = (normal, tangent);
            }
        }
    }
    turned
}

/// Whether two corners of a vertex are parts of one smooth surface.
fn alike(a: &Corner, b: &Corner) -> bool {
    a.normal.dot(b.normal) > SMOOTH
        && a.tangent.w == b.tangent.w
        && a.tangent.truncate().dot(b.tangent.truncate()) > SMOOTH
}
