//! Holes of alpha masks stay holes: rays through an aged grating are stopped where they were stopped by the fresh one.

use bevy_coating::bake::StainOutput;
use serde_json::Value;

use crate::{
    carried::{aged, data, input, quick},
    strict::{Glb, index},
};

/// Rays along each side of the plate.
const RAYS: usize = 160;

/// An image with its alpha.
struct Mask {
    size: [usize; 2],
    alpha: Vec<f64>,
}

impl Mask {
    fn new(bytes: &[u8]) -> Self {
        let mut decoder = png::Decoder::new(std::io::Cursor::new(bytes));
        decoder.set_transformations(png::Transformations::EXPAND | png::Transformations::ALPHA);
        let mut reader = decoder.read_info().expect("a PNG");
        let mut bytes = vec![0; reader.output_buffer_size().expect("a size")];
        let frame = reader.next_frame(&mut bytes).expect("texels");
        let channels = frame.color_type.samples();
        let alpha = bytes.chunks(channels).map(|texel| f64::from(texel[channels - 1]) / 255.0).collect();
        Self { size: [frame.width as usize, frame.height as usize], alpha }
    }

    /// Blended between texels; repeated beyond the edges.
    fn at(&self, uv: [f64; 2]) -> f64 {
        let [x, y]: [f64; 2] = std::array::from_fn(|k| uv[k] * self.size[k] as f64 - 0.5);
        let texel = |x: f64, y: f64| {
            let [x, y] = [(x, 0), (y, 1)].map(|(p, k)| (p.floor() as i64).rem_euclid(self.size[k] as i64) as usize);
            self.alpha[y * self.size[0] + x]
        };
        let (u, v) = (x - x.floor(), y - y.floor());
        let row = |y: f64| texel(x, y) * (1.0 - u) + texel(x + 1.0, y) * u;
        row(y) * (1.0 - v) + row(y + 1.0) * v
    }
}

/// For each ray along z through the square from (-0.5, 0) to (0.5, 1) whether anything stops it. All primitives count,
/// whichever way they face. `only` chooses them by the name of their material.
fn stopped(glb: &Glb, only: &dyn Fn(&str) -> bool) -> Vec<bool> {
    let mut stopped = vec![false; RAYS * RAYS];
    let node = &glb.list("nodes")[0];
    for primitive in glb.list("meshes")[index(&node["mesh"]).expect("a mesh")]["primitives"].as_array().expect("some") {
        let material = index(&primitive["material"]).map_or(&Value::Null, |m| &glb.list("materials")[m]);
        if !only(material["name"].as_str().unwrap_or("")) {
            continue;
        }
        let attribute = |name: &str| index(&primitive["attributes"][name]).map(|accessor| glb.floats(accessor));
        let positions = attribute("POSITION").expect("positions");
        let uvs = attribute("TEXCOORD_0");
        let colors = attribute("COLOR_0");
        let pbr = &material["pbrMetallicRoughness"];
        let masked = material["alphaMode"] == "MASK";
        let texture = index(&pbr["baseColorTexture"]["index"]).filter(|_| masked);
        let image = texture.map(|t| Mask::new(glb.image(index(&glb.list("textures")[t]["source"]).expect("an image"))));
        let cutoff = material["alphaCutoff"].as_f64().unwrap_or(0.5);
        let factor = pbr["baseColorFactor"][3].as_f64().unwrap_or(1.0);
        for triangle in glb.triangles(primitive) {
            // Rays in the square's own unit.
            let corner = triangle.map(|v| [(positions[v][0] + 0.5) * RAYS as f64, positions[v][1] * RAYS as f64]);
            let [a, b, c] = corner;
            let cross =
                |p: [f64; 2], q: [f64; 2], r: [f64; 2]| (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
            let area = cross(a, b, c);
            let range = |k: usize| {
                let low = corner.iter().map(|p| p[k]).fold(f64::INFINITY, f64::min).max(0.0) as usize;
                let high = corner.iter().map(|p| p[k]).fold(0.0, f64::max).min(RAYS as f64 - 1.0) as usize;
                low..=high
            };
            for (x, y) in range(1).flat_map(|y| range(0).map(move |x| (x, y))) {
                let p = [x as f64 + 0.5, y as f64 + 0.5];
                let weights = [cross(p, b, c), cross(a, p, c), cross(a, b, p)].map(|w| w / area);
                if area == 0.0 || weights.iter().any(|&w| w < 0.0) {
                    continue;
                }
                let blend = |of: &[Vec<f64>], k: usize| (0..3).map(|i| weights[i] * of[triangle[i]][k]).sum::<f64>();
                let mut alpha = factor;
                if let (Some(image), Some(uvs)) = (&image, &uvs) {
                    alpha *= image.at([blend(uvs, 0), blend(uvs, 1)]);
                }
                if let Some(colors) = colors.as_ref().filter(|colors| colors[0].len() == 4) {
                    alpha *= blend(colors, 3);
                }
                stopped[y * RAYS + x] |= !masked || alpha >= cutoff;
            }
        }
    }
    stopped
}

fn share(stopped: &[bool]) -> f64 {
    stopped.iter().filter(|&&s| s).count() as f64 / stopped.len() as f64
}

#[test]
fn holes_stay_holes_at_every_age() {
    let fresh = stopped(&input("grating_mask.glb"), &|_| true);
    assert!((0.5..0.55).contains(&share(&fresh)), "{}", share(&fresh));
    for stains in [StainOutput::Textures(256), StainOutput::VertexColors, StainOutput::None] {
        for age in [0.0, 0.3, 0.6, 0.9] {
            let (glb, warnings) = aged(data("grating_mask.glb"), &quick(age), stains);
            assert!(warnings.is_empty(), "{warnings:?}");
            let (all, film) = (stopped(&glb, &|_| true), stopped(&glb, &|name| name == "grating"));
            let (primer, metal) =
                (stopped(&glb, &|name| name == "primer"), stopped(&glb, &|name| name == "rusted metal"));
            let what = format!("{stains:?} at age {age}: {} of {}", share(&all), share(&fresh));
            assert_eq!([share(&primer) > 0.05, share(&metal) > 0.05], [age > 0.0; 2], "{what}");
            // Metal lies where paint lay, and backs behind paint. Only flakes that stand off hang over holes.
            let rays = 0..fresh.len();
            let metal_in_holes = rays.clone().filter(|&i| metal[i] && !fresh[i]).count();
            let primer_in_holes = rays.filter(|&i| primer[i] && !fresh[i] && !film[i]).count();
            assert!(metal_in_holes <= 3 && primer_in_holes <= 40, "{what}: {metal_in_holes} {primer_in_holes}");
            assert!((-0.02..0.005).contains(&(share(&all) - share(&fresh))), "{what}");
        }
    }
}
