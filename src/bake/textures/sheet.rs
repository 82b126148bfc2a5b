//! Draws one set of textures: base colour, metalness with roughness, and normals.

use bevy_math::{Mat2, Vec2, Vec3, Vec4};

use super::{
    coverage::{BAND, Coverage, NOBODY, nearest, texel},
    dilate,
    finish::{Finish, Place},
    frames,
    texture::{to_byte, to_srgb},
};
use crate::{
    appearance::{
        MeshPart,
        shading::{FilmShading, StainPattern, StainSample, SurfaceShading},
    },
    bake::parallel,
};

/// Steepest relief: beyond it neighbouring texels hold something else, such as the next chart.
const STEEPEST: f32 = 2.0;

/// Stuff that a part is made of.
#[derive(Clone, Copy, Debug)]
pub enum Ground<'a> {
    /// Paint over the prop's own material.
    Film(&'a Finish),
    /// Primer, on the backs of flakes.
    Back(SurfaceShading),
    /// Bare metal.
    Metal,
}

/// A part and where its triangles lie in the texture.
pub struct Patch<'a> {
    pub ground: Ground<'a>,
    /// Paint whose alpha mask holds for backs and metal.
    pub mask: Option<&'a Finish>,
    /// The part, with its own first and second texture coordinates.
    pub part: &'a MeshPart,
    /// Places in the texture, 0 to 1.
    pub uvs: &'a [[f32; 2]],
    /// For each triangle what it hangs together with in the texture.
    pub charts: &'a [u32],
    /// For each vertex, how directions in the prop's own normal texture read in the new one; empty: the same.
    pub turns: Vec<Mat2>,
}

/// Shading and pattern of the stains on one prop.
#[derive(Clone, Copy, Debug)]
pub struct Stains<'a> {
    pub shading: &'a FilmShading,
    pub pattern: StainPattern,
}

/// Texels, row by row from the top.
pub struct Sheet {
    pub size: u32,
    /// sRGB and alpha.
    pub base: Vec<[u8; 4]>,
    /// 255, roughness, metalness: what glTF reads of it, and full light for who takes red for occlusion.
    pub surface: Vec<[u8; 3]>,
    /// Tangent-space normals, green up.
    pub normals: Vec<[u8; 3]>,
    /// Whether alpha means anything.
    pub transparent: bool,
}

/// A triangle about to be drawn.
struct Triangle<'a> {
    patch: &'a Patch<'a>,
    vertices: [usize; 3],
    texels: [Vec2; 3],
    chart: (usize, u32),
    /// From changes of height between texels to slopes.
    slopes: Mat2,
    /// How far the prop's own texture coordinates go over a texel.
    steps: [f32; 2],
    /// Metres a texel.
    footprint: f32,
}

/// One band of rows.
struct Band<'a> {
    first: usize,
    base: &'a mut [[u8; 4]],
    surface: &'a mut [[u8; 3]],
    heights: &'a mut [f32],
}

impl Sheet {
    /// Draws patches into textures of `size` by `size` texels. `padding` is how far charts are continued around
    /// themselves, in texels.
    pub fn draw(patches: &[Patch], stains: &Stains, size: u32, padding: u32) -> Self {
        let side = size as usize;
        let triangles: Vec<Triangle> = patches.iter().enumerate().flat_map(|(i, p)| p.triangles(i, size)).collect();
        let corners: Vec<[Vec2; 3]> = triangles.iter().map(|t| t.texels).collect();
        let Coverage { owners, .. } = Coverage::new(size, &corners);

        let mut base = vec![[0u8; 4]; side * side];
        let mut surface = vec![[0u8; 3]; side * side];
        let mut heights = vec![0.0f32; side * side];
        let rows = BAND * side;
        let mut bands: Vec<Band> = base
            .chunks_mut(rows)
            .zip(surface.chunks_mut(rows))
            .zip(heights.chunks_mut(rows))
            .enumerate()
            .map(|(i, ((base, surface), heights))| Band { first: i * rows, base, surface, heights })
            .collect();
        parallel::for_each(&mut bands, |band| {
            for i in 0..band.base.len() {
                let at = band.first + i;
                let Some(triangle) = triangles.get(owners[at] as usize) else { continue };
                let (shading, alpha) = triangle.shading(texel(at % side, at / side), stains);
                let [r, g, b] = shading.base_color.to_array().map(to_srgb);
                band.base[i] = [r, g, b, to_byte(alpha)];
                band.surface[i] = [255, to_byte(shading.roughness), to_byte(shading.metallic)];
                band.heights[i] = shading.height;
            }
        });

        let mut normals = vec![[128, 128, 255]; side * side];
        // Texels outside of their triangles repeat its border: right for colours, but not for their changes.
        let mut inner = owners.clone();
        let relief = Relief { triangles: &triangles, owners: &owners, heights: &heights, side };
        let mut bands: Vec<(usize, &mut [[u8; 3]], &mut [u32])> = normals
            .chunks_mut(rows)
            .zip(inner.chunks_mut(rows))
            .enumerate()
            .map(|(i, (normals, inner))| (i * rows, normals, inner))
            .collect();
        parallel::for_each(&mut bands, |(first, normals, inner)| {
            for (i, (normal, owner)) in normals.iter_mut().zip(inner.iter_mut()).enumerate() {
                match relief.normal(*first + i) {
                    Some(found) => *normal = (found * 0.5 + 0.5).to_array().map(to_byte),
                    None => *owner = NOBODY,
                }
            }
        });

        let sources = dilate::sources(&owners, side, padding);
        dilate::fill(&mut base, &owners, &sources);
        dilate::fill(&mut surface, &owners, &sources);
        let sources = dilate::sources(&inner, side, padding + 1);
        dilate::fill(&mut normals, &inner, &sources);
        let transparent = patches.iter().any(|patch| match patch.ground {
            Ground::Film(finish) => finish.transparent,
            _ => patch.mask.is_some(),
        });
        Self { size, base, surface, normals, transparent }
    }
}

impl<'a> Patch<'a> {
    fn triangles(&'a self, index: usize, size: u32) -> impl Iterator<Item = Triangle<'a>> {
        self.part.indices.as_chunks::<3>().0.iter().zip(self.charts).map(move |(t, &chart)| {
            let vertices = t.map(|v| v as usize);
            let texels = vertices.map(|v| Vec2::from(self.uvs[v]) * size as f32);
            let rest = vertices.map(|v| Vec3::from(self.part.rest[v]));
            let area = texel_area(texels);
            let step = |own: &[[f32; 2]]| match vertices.map(|v| own.get(v)) {
                [Some(&a), Some(&b), Some(&c)] if area > 0.0 => (texel_area([a, b, c].map(Vec2::from)) / area).sqrt(),
                _ => 0.0,
            };
            let surface = (rest[1] - rest[0]).cross(rest[2] - rest[0]).length();
            Triangle {
                patch: self,
                vertices,
                texels,
                chart: (index, chart),
                slopes: frames::slopes(rest, texels),
                steps: [step(&self.part.uvs), step(&self.part.uvs_1)],
                footprint: if area > 0.0 { (surface / area).sqrt() } else { 0.0 },
            }
        })
    }
}

/// Twice the area of a triangle.
fn texel_area([a, b, c]: [Vec2; 3]) -> f32 {
    (b - a).perp_dot(c - a).abs()
}

impl Triangle<'_> {
    fn shading(&self, texel: Vec2, stains: &Stains) -> (SurfaceShading, f32) {
        let (weights, _) = nearest(&self.texels, texel);
        let sample = self.sample(weights);
        let pattern = stains.pattern.with_footprint(self.footprint);
        match self.patch.ground {
            Ground::Film(finish) => {
                let (base, alpha) = finish.shading(&self.place(weights));
                (stains.shading.film(base, &sample, &pattern), alpha)
            }
            Ground::Back(primer) => (stains.shading.back(primer, &sample, &pattern), self.mask(texel)),
            Ground::Metal => (stains.shading.metal(&sample, &pattern), self.mask(texel)),
        }
    }

    /// Alpha of backs and metal: the least in a texel, as they may not be seen in holes of the paint over them, whose
    /// texels may be finer.
    fn mask(&self, texel: Vec2) -> f32 {
        let Some(finish) = self.patch.mask else { return 1.0 };
        let alpha = |offset: Vec2| finish.shading(&self.place(nearest(&self.texels, texel + offset).0)).1;
        let corners = [Vec2::new(-0.5, -0.5), Vec2::new(0.5, -0.5), Vec2::new(-0.5, 0.5), Vec2::new(0.5, 0.5)];
        corners.into_iter().map(alpha).fold(alpha(Vec2::ZERO), f32::min)
    }

    fn sample(&self, weights: Vec3) -> StainSample {
        let part = self.patch.part;
        let [rust, dust, moisture, corrosion] =
            self.blend(weights, |v| Vec4::from(part.stains.get(v).copied().unwrap_or_default())).to_array();
        let mean = |of: &[[f32; 3]]| self.blend(weights, |v| Vec3::from(of[v]).extend(0.0)).truncate();
        let (rest, normal) = (mean(&part.rest), mean(&part.rest_normals).normalize_or_zero());
        StainSample { rust, dust, moisture, corrosion, rest, normal }
    }

    fn place(&self, weights: Vec3) -> Place {
        let part = self.patch.part;
        let uv = |uvs: &[[f32; 2]], v: usize| uvs.get(v).map_or(Vec2::ZERO, |&uv| uv.into());
        let uvs = self.blend(weights, |v| {
            let (first, second) = (uv(&part.uvs, v), uv(&part.uvs_1, v));
            Vec4::new(first.x, first.y, second.x, second.y)
        });
        let color = self.blend(weights, |v| part.colors.get(v).map_or(Vec4::ONE, |&c| c.into()));
        Place { uvs: [Vec2::new(uvs.x, uvs.y), Vec2::new(uvs.z, uvs.w)], steps: self.steps, color }
    }

    fn blend(&self, weights: Vec3, value: impl Fn(usize) -> Vec4) -> Vec4 {
        let [a, b, c] = self.vertices.map(value);
        a * weights.x + b * weights.y + c * weights.z
    }

    /// How far the prop's own normal texture makes the normal lean.
    fn lean(&self, texel: Vec2) -> Vec2 {
        let Ground::Film(finish) = self.patch.ground else { return Vec2::ZERO };
        if !finish.has_relief() {
            return Vec2::ZERO;
        }
        let (weights, _) = nearest(&self.texels, texel);
        let lean = finish.lean(&self.place(weights));
        let turned =
            self.blend(weights, |v| self.patch.turns.get(v).map_or(lean, |turn| *turn * lean).extend(0.0).extend(0.0));
        Vec2::new(turned.x, turned.y)
    }
}

/// Heights of all texels.
struct Relief<'a> {
    triangles: &'a [Triangle<'a>],
    owners: &'a [u32],
    heights: &'a [f32],
    side: usize,
}

impl Relief<'_> {
    /// Unit normal of a texel in the frame of the texture; `None` for a texel whose middle lies in no triangle.
    fn normal(&self, at: usize) -> Option<Vec3> {
        let triangle = self.triangles.get(self.owners[at] as usize)?;
        let (x, y) = (at % self.side, at / self.side);
        if nearest(&triangle.texels, texel(x, y)).1 > 0.0 {
            return None;
        }
        let left = (x > 0).then(|| at - 1);
        let right = (x + 1 < self.side).then(|| at + 1);
        let above = (y > 0).then(|| at - self.side);
        let below = (y + 1 < self.side).then(|| at + self.side);
        let change = Vec2::new(self.change(at, triangle, left, right), self.change(at, triangle, above, below));
        let slope = (triangle.slopes * change).clamp(Vec2::splat(-STEEPEST), Vec2::splat(STEEPEST));
        let lean = triangle.lean(texel(x, y));
        Some((lean - slope).extend(1.0).normalize())
    }

    /// Change of height from one texel to the next, from those of `before` and `after` that lie in the same chart.
    fn change(&self, at: usize, triangle: &Triangle, before: Option<usize>, after: Option<usize>) -> f32 {
        let same = |&i: &usize| {
            let owner = self.owners[i];
            owner != NOBODY && self.triangles[owner as usize].chart == triangle.chart
        };
        let here = self.heights[at];
        match (before.filter(same), after.filter(same)) {
            (Some(a), Some(b)) => (self.heights[b] - self.heights[a]) * 0.5,
            (Some(a), None) => here - self.heights[a],
            (None, Some(b)) => self.heights[b] - here,
            (None, None) => 0.0,
        }
    }
}
