//! The prop's corner attributes as functions on its surface: where they jump, and where they bend.

use bevy_math::{Vec3, Vec4};

use super::topology::Topology;
use crate::{
    film::HalfEdgeId,
    surface::{CleanSurface, Surface, SurfaceSite},
};

/// Texture coordinates further apart than this on the two sides of an edge make it a seam.
const UV_SEAM: f32 = 1e-4;
/// Texture coordinates may be blurred by this, one texel of a 1k texture.
const UV_BEND: f32 = 1e-3;
/// Directions (normals, tangents) further apart than this make an edge hard: about 20 degrees. Less is not a
/// hard edge but the facets of a dense, flat-shaded scan.
const DIRECTION_SEAM: f32 = 0.35;
/// Directions may be blurred by this, about a degree.
const DIRECTION_BEND: f32 = 0.015;
/// Linear colours further apart than this make a colour border.
const COLOR_SEAM: f32 = 0.02;
/// Linear colours may be blurred by this.
const COLOR_BEND: f32 = 0.01;

/// One attribute: a value at each corner of the clean triangles.
struct Channel {
    values: Vec<Vec4>,
    seam: f32,
    bend: f32,
}

/// All attributes that the prop has.
pub(super) struct Attributes {
    channels: Vec<Channel>,
}

impl Attributes {
    pub fn new(surface: &Surface, clean: &CleanSurface) -> Self {
        let corners = 3 * surface.triangles.len();
        let mut channels = Vec::new();
        let mut add = |length: usize, seam: f32, bend: f32, value: &dyn Fn(usize) -> Vec4| {
            if length == corners && corners > 0 {
                let at_site = |site: &SurfaceSite| {
                    let [a, b, c] = [0, 1, 2].map(|k| value(3 * site.triangle as usize + k));
                    a * site.weights.x + b * site.weights.y + c * site.weights.z
                };
                channels.push(Channel { values: clean.sites.iter().flatten().map(at_site).collect(), seam, bend });
            }
        };
        let direction = |v: Vec3| v.normalize_or_zero();
        add(surface.uvs.len(), UV_SEAM, UV_BEND, &|i| surface.uvs[i].extend(0.0).extend(0.0));
        add(surface.uvs_1.len(), UV_SEAM, UV_BEND, &|i| surface.uvs_1[i].extend(0.0).extend(0.0));
        add(surface.normals.len(), DIRECTION_SEAM, DIRECTION_BEND, &|i| direction(surface.normals[i]).extend(0.0));
        add(surface.tangents.len(), DIRECTION_SEAM, DIRECTION_BEND, &|i| {
            direction(surface.tangents[i].truncate()).extend(surface.tangents[i].w)
        });
        add(surface.colors.len(), COLOR_SEAM, COLOR_BEND, &|i| surface.colors[i]);
        Self { channels }
    }

    /// Whether an attribute differs between the two sides of the edge, at either end; in an `exact` film even by
    /// as little as the film's faces may blur.
    pub fn jump(&self, h: HalfEdgeId, t: HalfEdgeId, exact: bool) -> bool {
        self.channels.iter().any(|c| {
            let limit = if exact { c.seam.min(c.bend) } else { c.seam };
            let apart = |i: HalfEdgeId, j: HalfEdgeId| (c.values[i.index()] - c.values[j.index()]).length() > limit;
            apart(h, t.next()) || apart(h.next(), t)
        })
    }

    /// Whether film faces of edge length `target` that straddle a flat edge would show an attribute visibly
    /// differently, because it is not one affine function on the two triangles.
    ///
    /// Across the edge the gradient jumps by the misfit at the far corner over its height; a face of width w in
    /// the middle of which the edge lies misses the kink by w/4 of that.
    pub fn bend(&self, topology: &Topology, positions: &[Vec3], h: HalfEdgeId, t: HalfEdgeId, target: f32) -> bool {
        let at = |h: HalfEdgeId| positions[topology.origin(h).index()];
        let (a, b, c, d) = (at(h), at(h.next()), at(h.previous()), at(t.previous()));
        let normal = (b - a).cross(c - a);
        let area = normal.length_squared();
        if area <= 0.0 {
            return false;
        }
        // Affine weights of the near triangle's corners at the far corner.
        let far_b = (d - a).cross(c - a).dot(normal) / area;
        let far_c = (b - a).cross(d - a).dot(normal) / area;
        let far_a = 1.0 - far_b - far_c;
        let base = a.distance(b).max(f32::MIN_POSITIVE);
        let near_height = area.sqrt() / base;
        let far_height = (b - a).cross(d - a).length() / base;
        let width = target.min(2.0 * near_height).min(2.0 * far_height);
        let blur = 0.25 * width / far_height.max(f32::MIN_POSITIVE);
        self.channels.iter().any(|channel| {
            let v = |h: HalfEdgeId| channel.values[h.index()];
            let expected = v(h) * far_a + v(h.next()) * far_b + v(h.previous()) * far_c;
            (v(t.previous()) - expected).length() * blur > channel.bend
        })
    }
}
