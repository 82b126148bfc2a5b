//! Makes texture coordinates where the prop's do not serve.

use bevy_math::{UVec2, Vec2, Vec3};

use super::{
    boxes::SmallestBox,
    charts::{Chart, charts},
    pack::pack,
};
use crate::appearance::MeshPart;

/// A part whose vertices were split where charts end.
#[derive(Clone, Debug, Default)]
pub struct Unwrapped {
    /// The part's vertex that each new vertex is.
    pub sources: Vec<u32>,
    /// Texture coordinates of each new vertex, 0 to 1 from the top left.
    pub uvs: Vec<[f32; 2]>,
    /// Three new vertices a triangle, in the part's order.
    pub indices: Vec<u32>,
    /// The chart of each triangle.
    pub charts: Vec<u32>,
}

/// Lays out parts side by side in a square texture, as they are at rest. Each comes with its share of texels for a
/// length: 1 is a full one. `padding` is in texels. `None` if there are more charts than there is room for.
pub fn unwrap(parts: &[(&MeshPart, f32)], size: u32, padding: u32) -> Option<Vec<Unwrapped>> {
    let mut flat: Vec<(usize, Flat)> = Vec::new();
    for (i, (part, density)) in parts.iter().enumerate() {
        flat.extend(charts(&part.rest, &part.indices).into_iter().map(|chart| (i, Flat::new(part, chart, *density))));
    }
    let sizes: Vec<Vec2> = flat.iter().map(|(_, flat)| flat.size).collect();
    let (scale, corners) = pack(&sizes, size, padding)?;
    let mut unwrapped: Vec<Unwrapped> = parts.iter().map(|(part, _)| Unwrapped::of(part)).collect();
    let mut new: Vec<Vec<u32>> = parts.iter().map(|(part, _)| vec![u32::MAX; part.positions.len()]).collect();
    for (chart, ((i, flat), corner)) in flat.iter().zip(corners).enumerate() {
        unwrapped[*i].add(chart as u32, flat, parts[*i].0, &mut new[*i], |p| texel_to_uv(p, scale, corner, size));
    }
    Some(unwrapped)
}

fn texel_to_uv(p: Vec2, scale: f32, corner: UVec2, size: u32) -> [f32; 2] {
    // From the middle of the first texel.
    ((p * scale + corner.as_vec2() + 0.5) / size as f32).to_array()
}

/// A chart laid flat.
struct Flat {
    chart: Chart,
    right: Vec3,
    down: Vec3,
    /// Corner of its box, and the size of that.
    low: Vec2,
    size: Vec2,
}

impl Flat {
    /// Lays a chart flat, turned for the smallest box.
    fn new(part: &MeshPart, chart: Chart, density: f32) -> Self {
        let [right, up] = chart.basis();
        let points: Vec<Vec2> = corners(part, &chart)
            .map(|(_, v)| Vec3::from(part.rest[v as usize]))
            .map(|p| Vec2::new(p.dot(right), -p.dot(up)))
            .collect();
        let SmallestBox { turn, low, size } = SmallestBox::around(&points);
        Self {
            right: (right * turn.x + up * turn.y) * density,
            down: (right * turn.y - up * turn.x) * density,
            low: low * density,
            size: size * density,
            chart,
        }
    }

    fn place(&self, p: Vec3) -> Vec2 {
        Vec2::new(p.dot(self.right), p.dot(self.down)) - self.low
    }
}

/// Triangle and vertex of all corners of a chart.
fn corners(part: &MeshPart, chart: &Chart) -> impl Iterator<Item = (u32, u32)> {
    chart.triangles.iter().flat_map(|&t| part.indices[t as usize * 3..][..3].iter().map(move |&v| (t, v)))
}

impl Unwrapped {
    fn of(part: &MeshPart) -> Self {
        let indices = vec![0; part.indices.len()];
        Self { charts: vec![0; indices.len() / 3], indices, ..Self::default() }
    }

    /// Adds a chart. `new` is scratch: no new vertex for any old one, before and after.
    fn add(&mut self, chart: u32, flat: &Flat, part: &MeshPart, new: &mut [u32], uv: impl Fn(Vec2) -> [f32; 2]) {
        for (k, (t, v)) in corners(part, &flat.chart).enumerate() {
            if new[v as usize] == u32::MAX {
                new[v as usize] = self.sources.len() as u32;
                self.sources.push(v);
                self.uvs.push(uv(flat.place(part.rest[v as usize].into())));
            }
            self.indices[t as usize * 3 + k % 3] = new[v as usize];
            self.charts[t as usize] = chart;
        }
        corners(part, &flat.chart).for_each(|(_, v)| new[v as usize] = u32::MAX);
    }

    /// The part with these vertices. Its own texture coordinates stay what they were.
    pub fn split(&self, part: &MeshPart) -> MeshPart {
        fn pick<T: Copy>(values: &[T], sources: &[u32]) -> Vec<T> {
            // What the part does not have stays empty.
            sources.iter().filter_map(|&v| values.get(v as usize).copied()).collect()
        }
        MeshPart {
            positions: pick(&part.positions, &self.sources),
            normals: pick(&part.normals, &self.sources),
            uvs: pick(&part.uvs, &self.sources),
            uvs_1: pick(&part.uvs_1, &self.sources),
            tangents: pick(&part.tangents, &self.sources),
            colors: pick(&part.colors, &self.sources),
            stains: pick(&part.stains, &self.sources),
            rest: pick(&part.rest, &self.sources),
            rest_normals: pick(&part.rest_normals, &self.sources),
            indices: self.indices.clone(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A flat square of two triangles, turned by 45 degrees, and one far from it.
    fn diamond() -> MeshPart {
        let rest =
            vec![[0., -1., 0.], [1., 0., 0.], [0., 1., 0.], [-1., 0., 0.], [5., 0., 0.], [5., 0., 1.], [5., 1., 0.]];
        MeshPart { positions: rest.clone(), rest, indices: vec![0, 1, 2, 0, 2, 3, 4, 6, 5], ..Default::default() }
    }

    #[test]
    fn every_triangle_has_its_true_shape_in_the_texture() {
        let part = diamond();
        let [unwrapped] = &unwrap(&[(&part, 1.0)], 256, 2).expect("room")[..] else { panic!("one part") };
        assert_eq!(unwrapped.charts, [0, 0, 1]);
        let split = unwrapped.split(&part);
        let mut scale = None;
        for t in split.indices.as_chunks::<3>().0 {
            for (&a, &b) in [(&t[0], &t[1]), (&t[1], &t[2]), (&t[2], &t[0])] {
                let [p, q] = [a, b].map(|v| Vec3::from(split.rest[v as usize]));
                let [s, t] = [a, b].map(|v| Vec2::from(unwrapped.uvs[v as usize]));
                assert!(s.min_element() > 0.0 && s.max_element() < 1.0);
                let ratio = s.distance(t) / p.distance(q);
                assert!((ratio / *scale.get_or_insert(ratio) - 1.0).abs() < 1e-4);
            }
            // Seen from outside, textures are not mirrored: rows run downwards.
            let [a, b, c] = t.map(|v| Vec2::from(unwrapped.uvs[v as usize]));
            assert!((b - a).perp_dot(c - a) < 0.0);
        }
    }

    #[test]
    fn charts_are_turned_to_fit_their_box() {
        let part = diamond();
        let square = Chart { triangles: vec![0, 1], axis: Vec3::Z };
        let flat = Flat::new(&part, square, 1.0);
        assert!((flat.size.element_product() - 2.0).abs() < 1e-4, "{}", flat.size);
        for p in &part.rest[..4] {
            let place = flat.place((*p).into());
            assert!(place.min_element() > -1e-4 && (flat.size - place).min_element() > -1e-4, "{place}");
        }
    }
}
