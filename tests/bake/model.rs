//! Aged models of the `bake` example in another reader, which checks what it reads.

use std::{fs, path::Path};

use crate::{
    strict::Glb,
    tool::{QUICK, TEXTURE, baked, folder, grey_png, number, stats, write_two_squares},
};

/// The aged model, checked strictly, in the `gltf` crate, which validates what it reads too.
fn read_back(path: &Path) -> (gltf::Document, Vec<u8>) {
    let bytes = fs::read(path).expect("a model");
    Glb::checked(&bytes);
    let gltf::Gltf { document, blob } = gltf::Gltf::from_slice(&bytes).expect("valid glTF");
    (document, blob.expect("a binary chunk"))
}

/// Checks every vertex of an aged model; gives the number of triangles of each material.
fn check_model(document: &gltf::Document, blob: &[u8]) -> Vec<(String, usize)> {
    let mut triangles = Vec::new();
    for node in document.default_scene().expect("a scene").nodes() {
        for primitive in node.mesh().expect("a mesh").primitives() {
            let reader = primitive.reader(|_| Some(blob));
            let positions: Vec<_> = reader.read_positions().expect("positions").collect();
            let normals: Vec<_> = reader.read_normals().expect("normals").collect();
            let indices: Vec<_> = reader.read_indices().expect("indices").into_u32().collect();
            assert!(indices.iter().all(|&i| (i as usize) < positions.len()) && indices.len() % 3 == 0);
            assert_eq!(positions.len(), normals.len());
            assert!(positions.iter().flatten().all(|x| x.is_finite()));
            let unit = |n: &[f32; 3]| (n.iter().map(|x| x * x).sum::<f32>() - 1.0).abs() < 1e-3;
            assert!(normals.iter().all(unit));
            let bounds = primitive.bounding_box();
            for axis in 0..3 {
                let lowest = positions.iter().map(|p| p[axis]).fold(f32::INFINITY, f32::min);
                let highest = positions.iter().map(|p| p[axis]).fold(f32::NEG_INFINITY, f32::max);
                assert_eq!((bounds.min[axis], bounds.max[axis]), (lowest, highest));
            }
            check_textures(document, blob, &primitive);
            let material = primitive.material().name().unwrap_or("").to_owned();
            triangles.push((material, indices.len() / 3));
        }
    }
    triangles
}

/// Checks that a primitive has what its textures need, and that those that were baked are images of the right kind.
fn check_textures(document: &gltf::Document, blob: &[u8], primitive: &gltf::Primitive) {
    let reader = primitive.reader(|_| Some(blob));
    let material = primitive.material();
    let surface = material.pbr_metallic_roughness();
    let Some(normals) = material.normal_texture() else { return };
    let base = surface.base_color_texture().expect("a base colour texture");
    let rough = surface.metallic_roughness_texture().expect("a metallic-roughness texture");
    assert_eq!([base.tex_coord(), rough.tex_coord(), normals.tex_coord()], [0; 3]);
    let inside = |uv: [f32; 2]| uv.iter().all(|x| (0.0..=1.0).contains(x));
    assert!(reader.read_tex_coords(0).expect("texture coordinates").into_f32().all(inside));
    let tangents = reader.read_tangents().expect("tangents");
    for (t, n) in tangents.zip(reader.read_normals().expect("normals")) {
        let dot = |a: &[f32], b: &[f32]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f32>();
        assert!((dot(&t[..3], &t[..3]) - 1.0).abs() < 1e-3 && dot(&t[..3], &n).abs() < 1e-3 && t[3].abs() == 1.0);
    }
    let sizes = [base.texture(), rough.texture(), normals.texture()].map(|texture| {
        let (width, height, pixels) = pixels_of(document, blob, texture.source().index());
        assert_eq!(width, height);
        if texture.index() == normals.texture().index() {
            for n in pixels {
                let length: f32 = n.iter().map(|&c| f32::from(c) / 127.5 - 1.0).map(|x| x * x).sum();
                assert!((length - 1.0).abs() < 0.03 && n[2] > 127, "{n:?}");
            }
        }
        width
    });
    assert_eq!(sizes, [sizes[0]; 3]);
}

/// Width, height and pixels, without alpha, of an image that is a PNG.
fn pixels_of(document: &gltf::Document, blob: &[u8], image: usize) -> (u32, u32, Vec<[u8; 3]>) {
    let image = document.images().nth(image).expect("an image");
    let gltf::image::Source::View { view, mime_type } = image.source() else { panic!("the image is not embedded") };
    assert_eq!(mime_type, "image/png");
    let bytes = &blob[view.offset()..][..view.length()];
    let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().expect("a PNG");
    let mut bytes = vec![0; reader.output_buffer_size().expect("a size")];
    let frame = reader.next_frame(&mut bytes).expect("pixels");
    assert_eq!(frame.color_type, png::ColorType::Rgb);
    (frame.width, frame.height, bytes.as_chunks::<3>().0.to_vec())
}

/// Mean sRGB colour of the texels that the triangles of all primitives with `material` cover, by their middles.
fn mean_color(document: &gltf::Document, blob: &[u8], material: &str) -> [f32; 3] {
    let (mut sum, mut count) = ([0.0f32; 3], 0);
    let meshes = document.meshes().flat_map(|mesh| mesh.primitives().collect::<Vec<_>>());
    for primitive in meshes.filter(|primitive| primitive.material().name() == Some(material)) {
        let texture = primitive.material().pbr_metallic_roughness().base_color_texture().expect("a texture");
        let (width, height, pixels) = pixels_of(document, blob, texture.texture().source().index());
        let reader = primitive.reader(|_| Some(blob));
        let uvs: Vec<_> = reader.read_tex_coords(0).expect("coordinates").into_f32().collect();
        let indices: Vec<_> = reader.read_indices().expect("indices").into_u32().collect();
        for triangle in indices.chunks_exact(3) {
            let middle = |k: usize| triangle.iter().map(|&v| uvs[v as usize][k]).sum::<f32>() / 3.0;
            let (x, y) = ((middle(0) * width as f32) as usize, (middle(1) * height as f32) as usize);
            let texel = pixels[y * width as usize + x];
            sum.iter_mut().zip(texel).for_each(|(sum, c)| *sum += f32::from(c));
            count += 1;
        }
    }
    assert!(count > 0, "nothing is made of {material}");
    sum.map(|c| c / count as f32)
}

#[test]
fn stains_are_in_the_textures() {
    let folder = folder();
    let run = |age: &str, file: &str| {
        let arguments = ["plate:800", "--texture-size", "300", "--age", age, "--set", "rust.emission=2", "--out", file];
        baked(folder.path(), &[&arguments[..], &QUICK[..]].concat());
        read_back(&folder.path().join(file))
    };
    let (document, blob) = run("0", "fresh.glb");
    check_model(&document, &blob);
    // Linear 0.55, 0.58, 0.60 in sRGB.
    assert_eq!(mean_color(&document, &blob, "paint"), [196.0, 200.0, 203.0]);
    let (document, blob) = run("0.9", "aged.glb");
    check_model(&document, &blob);
    assert_eq!(document.images().count(), 6, "the plate's own coordinates for the paint, others for backs and metal");
    assert_eq!(pixels_of(&document, &blob, 0).0, 300);
    let [r, g, b] = mean_color(&document, &blob, "paint");
    assert!(r < 190.0 && r - b > 5.0 && g < r, "dusty and rusty: {r} {g} {b}");
    let [r, g, b] = mean_color(&document, &blob, "primer");
    assert!(r > 1.15 * g && g > 1.15 * b, "rust creeps in: {r} {g} {b}");

    let again = run("0.9", "again.glb").1;
    assert_eq!(blob, again, "the same run gives the same bytes");
}

#[test]
fn vertex_colours_leave_textures_alone() {
    let folder = folder();
    write_two_squares(folder.path());
    fs::write(folder.path().join("a texture.png"), grey_png()).expect("a file");
    for (input, images) in [("two.gltf", 1), ("plate:400", 0)] {
        let arguments = [input, "--triangles", "600", "--out", "out.glb", "--age", "0.9", "--vertex-colors"];
        baked(folder.path(), &[&arguments[..], &QUICK[..]].concat());
        let (document, blob) = read_back(&folder.path().join("out.glb"));
        check_model(&document, &blob);
        assert_eq!(document.images().count(), images, "{input}");
        let mut stained = 0;
        for primitive in document.meshes().flat_map(|mesh| mesh.primitives().collect::<Vec<_>>()) {
            let colors: Vec<_> =
                primitive.reader(|_| Some(&blob)).read_colors(0).expect("colours").into_rgba_f32().collect();
            assert!(colors.iter().flatten().all(|c| (0.0..=1.0).contains(c)));
            stained += colors.iter().filter(|[r, _, b, _]| r - b > 0.05).count();
            if primitive.material().pbr_metallic_roughness().base_color_texture().is_none() {
                assert_eq!(primitive.material().pbr_metallic_roughness().base_color_factor(), [1.0; 4]);
            }
        }
        assert!(stained > 50, "{input}: {stained} vertices are rusty");
    }
}

#[test]
fn without_stains_materials_are_what_they_were() {
    let folder = folder();
    let arguments = ["plate:400", "--out", "out.glb", "--age", "0.9", "--no-stains"];
    baked(folder.path(), &[&arguments[..], &QUICK[..]].concat());
    let (document, blob) = read_back(&folder.path().join("out.glb"));
    check_model(&document, &blob);
    assert_eq!(document.images().count(), 0);
    let names: Vec<_> = document.materials().map(|material| material.name().unwrap_or("").to_owned()).collect();
    assert_eq!(names, ["paint", "primer", "rusted metal"]);
    let factor = document.materials().next().map(|paint| paint.pbr_metallic_roughness().base_color_factor());
    assert_eq!(factor, Some([0.55, 0.58, 0.6, 1.0]));
}

#[test]
fn the_aged_model_opens_elsewhere_with_its_texture() {
    let folder = folder();
    write_two_squares(folder.path());
    let arguments = ["two.gltf", "--triangles", "600", "--out", "out.glb", "--age", "0.8"];
    baked(folder.path(), &[&arguments[..], &QUICK[..]].concat());
    let (document, blob) = read_back(&folder.path().join("out.glb"));
    assert_eq!(document.as_json().asset.copyright.as_deref(), Some("nobody"));
    let names: Vec<_> = document.nodes().map(|node| node.name().unwrap_or("").to_owned()).collect();
    assert_eq!(names, ["small", "large"]);
    let triangles = check_model(&document, &blob);
    let of = |name: &str| triangles.iter().filter(|(material, _)| material == name).map(|(_, n)| n).sum::<usize>();
    let (paint, primer, metal) = (of("enamel"), of("primer"), of("rusted metal"));
    assert!(primer > 0 && primer <= paint && metal >= primer, "{triangles:?}");

    // The texture, its transform and what nobody knows came along.
    let image = document.images().next().expect("an image");
    let gltf::image::Source::View { view, mime_type } = image.source() else { panic!("the image is not embedded") };
    assert_eq!((&blob[view.offset()..][..view.length()], mime_type), (TEXTURE, "image/png"));
    let enamel = document.materials().next().expect("a material");
    let texture = enamel.pbr_metallic_roughness().base_color_texture().expect("a texture");
    assert_eq!(texture.texture_transform().expect("a transform").scale(), [2.0, 2.0]);
    let text = fs::read(folder.path().join("out.glb")).expect("a model");
    assert!(String::from_utf8_lossy(&text).contains("VENDOR_glitter"));

    // The prop lies where it lay: the large square on the far side, and textures on their place.
    let large = document.nodes().nth(1).and_then(|node| node.mesh()).expect("a mesh");
    let paint = large.primitives().next().expect("paint");
    let (translation, rotation, scale) = document.nodes().nth(1).expect("a node").transform().decomposed();
    assert_eq!((translation, rotation, scale), ([-5.0, 0.0, 0.0], [0.0, 0.0, 0.0, 1.0], [-3.0, 3.0, 3.0]));
    let reader = paint.reader(|_| Some(&blob));
    let uvs = reader.read_tex_coords(0).expect("texture coordinates").into_f32();
    for (p, [u, v]) in reader.read_positions().expect("positions").zip(uvs) {
        let p = [p[0] * scale[0] + translation[0], p[1] * scale[1] + translation[1]];
        assert!(p[0] < -4.5 && p[0] > -8.5, "{p:?}");
        // The film bends, but not by half of the plate.
        assert!((-5.0 - 3.0 * u - p[0]).abs() < 0.5 && (3.0 * (1.0 - v) - p[1]).abs() < 0.5, "{p:?} has {u} {v}");
    }
}

#[test]
fn a_fresh_model_has_neither_primer_nor_metal() {
    let folder = folder();
    baked(folder.path(), &["plate:200", "--age", "0", "--out", "fresh.glb"]);
    let (document, blob) = read_back(&folder.path().join("fresh.glb"));
    assert_eq!(check_model(&document, &blob), [("paint".to_owned(), 200)]);
}

/// Every model of the project's data, if it is there.
#[test]
fn real_models_age_and_open_elsewhere() {
    let data = Path::new("../shared/data");
    // The tool runs in a folder of its own.
    let Ok(entries) = fs::canonicalize(data).and_then(fs::read_dir) else {
        eprintln!("skipped: {} is not there", data.display());
        return;
    };
    let folder = folder();
    for entry in entries {
        let path = entry.expect("a file").path();
        if !path.extension().is_some_and(|ending| ending == "glb" || ending == "obj") {
            continue;
        }
        let input = path.to_str().expect("a name");
        for triangles in ["keep", "1500"] {
            let arguments =
                [input, "--triangles", triangles, "--out", "out.glb", "--steps", "25", "--texture-size", "256"];
            let stats = stats(folder.path(), &[&arguments[..], &["--set", "deform.sweeps_per_age=100"]].concat());
            let last = stats["timeline"].as_array().and_then(|t| t.last()).expect("an entry").clone();
            assert!(number(&last["separated"]) > 0.3, "{input} {triangles}: {last}");
            let (document, blob) = read_back(&folder.path().join("out.glb"));
            assert!(check_model(&document, &blob).len() >= 2, "{input} {triangles}");
        }
    }
}
