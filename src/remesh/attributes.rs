//! Finds the edges of the prop's surface at which its corner attributes jump or bend.

use bevy_math::{Vec3, Vec4};

use super::topology::Topology;
use crate::{
    film::HalfEdgeId,
    rest::{LIGHT_PIECE, Rest},
    surface::{CleanSurface, Surface, SurfaceSite},
};

/// Texture coordinates further apart than this on the two sides of an edge make it a seam.
const UV_SEAM: f32 = 1e-4;
/// Most by which the film may blur texture coordinates: one texel of a texture 1,000 texels wide.
const UV_BEND: f32 = 1e-3;
/// Directions (normals, tangents) further apart than this make an edge hard: about 20 degrees. Smaller differences are
/// the facets of a dense, flat-shaded scan.
const DIRECTION_SEAM: f32 = 0.35;
/// Most by which the film may blur directions: about a degree.
const DIRECTION_BEND: f32 = 0.015;
/// Linear colours further apart than this make a colour border.
const COLOR_SEAM: f32 = 0.02;
/// Most by which the film may blur linear colours.
const COLOR_BEND: f32 = 0.01;

/// Attribute with a value at each corner of the clean triangles, and the limits of its jumps and bends.
struct Channel {
    values: Vec<Vec4>,
    seam: f32,
    bend: f32,
}

/// Attributes that the prop has.
pub(super) struct Attributes {
    channels: Vec<Channel>,
}

impl Attributes {
    pub async fn new(surface: &Surface, clean: &CleanSurface, rest: &mut impl Rest) -> Self {
        let mut all = Self { channels: Vec::new() };
        let corners = 3 * surface.triangles.len();
        let has = |length: usize| length == corners && corners > 0;
        let direction = |v: Vec3| v.normalize_or_zero();
        for uvs in [&surface.uvs, &surface.uvs_1].into_iter().filter(|uvs| has(uvs.len())) {
            all.add(clean, UV_SEAM, UV_BEND, |i| uvs[i].extend(0.0).extend(0.0), rest).await;
        }
        if has(surface.normals.len()) {
            all.add(clean, DIRECTION_SEAM, DIRECTION_BEND, |i| direction(surface.normals[i]).extend(0.0), rest).await;
        }
        if has(surface.tangents.len()) {
            let tangent = |i: usize| direction(surface.tangents[i].truncate()).extend(surface.tangents[i].w);
            all.add(clean, DIRECTION_SEAM, DIRECTION_BEND, tangent, rest).await;
        }
        if has(surface.colors.len()) {
            all.add(clean, COLOR_SEAM, COLOR_BEND, |i| surface.colors[i], rest).await;
        }
        all
    }

    /// Adds an attribute with a `value` at each corner of the surface.
    async fn add(
        &mut self,
        clean: &CleanSurface,
        seam: f32,
        bend: f32,
        value: impl Fn(usize) -> Vec4 + Send + Sync,
        rest: &mut impl Rest,
    ) {
        let at_site = |site: &SurfaceSite| {
            let [a, b, c] = [0, 1, 2].map(|k| value(3 * site.triangle as usize + k));
            a * site.weights.x + b * site.weights.y + c * site.weights.z
        };
        let mut values = Vec::with_capacity(3 * clean.sites.len());
        for piece in clean.sites.chunks(LIGHT_PIECE) {
            values.extend(piece.iter().flatten().map(&at_site));
            rest.rest().await;
        }
        self.channels.push(Channel { values, seam, bend });
    }

    /// Returns whether an attribute differs between the two sides of the edge, at either end. Where the film must be
    /// `exact`, smaller differences count too: those above the most that the film may blur.
    pub fn jump(&self, h: HalfEdgeId, t: HalfEdgeId, exact: bool) -> bool {
        self.channels.iter().any(|c| {
            let limit = if exact { c.seam.min(c.bend) } else { c.seam };
            let apart = |i: HalfEdgeId, j: HalfEdgeId| (c.values[i.index()] - c.values[j.index()]).length() > limit;
            apart(h, t.next()) || apart(h.next(), t)
        })
    }

    /// Returns whether film faces of edge length `target` that lie across a flat edge would visibly change an
    /// attribute, because the attribute is not one affine function on the two triangles.
    ///
    /// The gradient jumps across the edge by the error of the near triangle's function at the far corner, divided by
    /// that corner's height over the edge. A face of width w with the edge in its middle is off by w/4 times that jump.
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
