use bevy_math::{Vec2, Vec3, Vec4};
use serde_json::json;

use super::{texture::to_srgb, *};
use crate::{
    bake::model::Image,
    remesh::{FilmTarget, build_film},
    settings::CoatingSettings,
    surface::Surface,
};

/// A square of two triangles with the texture coordinates `uvs`, and its film.
fn square(uvs: [[f32; 2]; 4], slot: Slot) -> (Prop, FilmState) {
    let corners = [0, 1, 2, 0, 2, 3];
    let surface = Surface {
        positions: vec![Vec3::ZERO, Vec3::X, Vec3::new(1.0, 1.0, 0.0), Vec3::Y],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        normals: vec![Vec3::Z; 6],
        uvs: corners.map(|i: usize| Vec2::from(uvs[i])).to_vec(),
        ..Surface::default()
    };
    let built = build_film(&surface, FilmTarget::Triangles(200), 0).expect("a film");
    let film = FilmState::new(&built, &CoatingSettings::default(), 0, 100).expect("a film");
    let prop = Prop {
        settings: CoatingSettings::default(),
        name: "square".into(),
        surface,
        origin: Vec3::ZERO,
        metres_per_unit: 1.0,
        slots: vec![slot],
        place: None,
        built,
        seed: 0,
    };
    (prop, film)
}

const UPRIGHT: [[f32; 2]; 4] = [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]];

fn png(width: u32, height: u32, pixels: &[u8]) -> Image {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.write_header().and_then(|mut writer| writer.write_image_data(pixels)).expect("a PNG");
    Image { mime_type: "image/png".into(), bytes: bytes.into(), ..Image::default() }
}

fn decoded(bytes: &[u8]) -> (u32, Vec<[u8; 3]>) {
    let mut reader = png::Decoder::new(std::io::Cursor::new(bytes)).read_info().expect("a PNG");
    let mut pixels = vec![0; reader.output_buffer_size().expect("a size")];
    let frame = reader.next_frame(&mut pixels).expect("pixels");
    assert_eq!((frame.color_type, frame.width), (png::ColorType::Rgb, frame.height));
    (frame.width, pixels.as_chunks::<3>().0.to_vec())
}

/// Four squares of different colours, and a relief that leans to the right of the image.
fn library() -> MaterialLibrary {
    let colors = [200, 30, 30, 30, 200, 30, 30, 30, 200, 200, 200, 30];
    MaterialLibrary {
        materials: vec![json!({
            "pbrMetallicRoughness": {
                "baseColorTexture": { "index": 0 }, "metallicFactor": 0.25, "roughnessFactor": 0.5
            },
            "normalTexture": { "index": 1 }
        })],
        textures: vec![json!({ "source": 0, "sampler": 0 }), json!({ "source": 1, "sampler": 0 })],
        samplers: vec![json!({ "wrapS": 33071, "wrapT": 33071, "magFilter": 9728 })],
        images: vec![png(2, 2, &colors), png(1, 1, &[188, 128, 240])],
        ..MaterialLibrary::default()
    }
}

fn dressed<'a>(prop: &Prop, film: &FilmState, shown: &'a FilmAppearance, output: StainOutput) -> Dressed<'a> {
    dress(prop, film, (shown, bare(prop, shown)), &library(), &mut Textures::default(), output)
}

/// Backs and metal, for as long as the test runs.
fn bare(prop: &Prop, shown: &FilmAppearance) -> &'static Bare {
    Box::leak(Box::new(Bare::new(prop, shown, &library())))
}

fn shown(prop: &Prop, film: &FilmState) -> FilmAppearance {
    FilmAppearance::new(&prop.built, &prop.surface, &film.mesh, &film.forces, &film.stains)
}

/// Colour of the prop's own texture at a place of the square.
fn own_color(p: [f32; 3]) -> [u8; 3] {
    match (p[0] < 0.5, p[1] < 0.5) {
        (true, false) => [200, 30, 30],
        (false, false) => [30, 200, 30],
        (true, true) => [30, 30, 200],
        (false, true) => [200, 200, 30],
    }
}

/// Texture coordinates that are unique stay; others, here mirrored around the middle or all in one dot, are replaced.
/// The surface looks the same in any case.
#[test]
fn a_fresh_surface_looks_like_the_prop_in_any_layout() {
    let shrunk = UPRIGHT.map(|uv| uv.map(|x| 0.5 + (x - 0.5) * 0.01));
    // The upper half of the image in the lower half of the square too: the diagonal is its mirror.
    let folded = [[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [1.0, 1.0]];
    let slot = Slot { material: Some(0), uvs: true, ..Slot::default() };
    for (uvs, keeps) in [(UPRIGHT, true), (shrunk, false), (folded, false)] {
        let (prop, film) = square(uvs, slot);
        let shown = shown(&prop, &film);
        let dressed = dressed(&prop, &film, &shown, StainOutput::Textures(256));
        assert!(dressed.warnings.is_empty(), "{:?}", dressed.warnings);
        let [primitive] = &dressed.primitives[..] else { panic!("only paint") };
        let [sheet] = &dressed.sheets[..] else { panic!("one sheet") };
        assert_eq!(primitive.cover, Cover::Textures { sheet: 0, moved: false });
        assert_eq!(primitive.part.uvs == shown.front(0).expect("paint").uvs, keeps);

        let (size, base) = decoded(&sheet.base);
        let (_, surface) = decoded(&sheet.surface);
        let (_, normals) = decoded(&sheet.normals);
        let own = &prop.surface.uvs;
        let (mut seen, part) = (0, &primitive.part);
        for t in part.indices.as_chunks::<3>().0 {
            let middle = |of: &dyn Fn(usize) -> Vec3| t.iter().map(|&v| of(v as usize)).sum::<Vec3>() / 3.0;
            let p = middle(&|v| part.positions[v].into());
            let uv = middle(&|v| Vec2::from(part.uvs[v]).extend(0.0));
            let at = (uv.y * size as f32) as usize * size as usize + (uv.x * size as f32) as usize;
            if uvs == UPRIGHT {
                assert_eq!(base[at], own_color(p.to_array()), "at {p}");
                seen += 1;
            } else if uvs == shrunk {
                let q = (p - Vec3::new(0.5, 0.5, 0.0)) * 0.01;
                assert_eq!(base[at], own_color([0.5 + q.x, 0.5 + q.y, 0.0]), "at {p}");
                seen += 1;
            }
            assert_eq!(surface[at], [255, 128, 64]);
            // The relief leans by 60/127 along the prop's own u, which is along +x unless folded.
            if uvs != folded {
                let tangent = middle(&|v| Vec4::from(part.tangents[v]).truncate());
                let bitangent = Vec3::Z.cross(tangent) * part.tangents[t[0] as usize][3];
                let n = Vec3::from(normals[at].map(|c| f32::from(c) / 127.5 - 1.0));
                let leaning = tangent * n.x + bitangent * n.y;
                assert!(leaning.x > 0.4 && leaning.y.abs() < 0.03 && n.z > 0.8, "{leaning} at {p}");
            }
        }
        assert!(own.len() == 6 && (uvs == folded || seen >= 150));
    }
}

#[test]
fn stains_show_where_they_are_and_only_there() {
    let slot = Slot { material: Some(0), uvs: true, ..Slot::default() };
    let (prop, mut film) = square(UPRIGHT, slot);
    for (v, p) in film.mesh.geometry.rest_positions.iter().enumerate() {
        film.stains.film.stained[v] = if p.x > 0.75 { 3.0 } else { 0.0 };
    }
    let shown = shown(&prop, &film);
    let textured = dressed(&prop, &film, &shown, StainOutput::Textures(128));
    let (size, base) = decoded(&textured.sheets[0].base);
    let clean = decoded(&textured.sheets[0].surface).1;
    for (i, texel) in base.iter().enumerate() {
        let p = [(i as u32 % size) as f32 + 0.5, size as f32 - (i as u32 / size) as f32 - 0.5].map(|x| x / size as f32);
        let own = own_color([p[0], p[1], 0.0]);
        if p[0] < 0.55 {
            assert_eq!((*texel, clean[i]), (own, [255, 128, 64]), "clean at {p:?}");
        }
    }
    let mean = |low: f32, channel: usize| -> f32 {
        let right = base.iter().enumerate().filter(|(i, _)| (*i as u32 % size) as f32 > low * size as f32);
        let values: Vec<f32> = right.map(|(_, texel)| f32::from(texel[channel])).collect();
        values.iter().sum::<f32>() / values.len() as f32
    };
    // Green, and yellow below it: rust takes the green away.
    assert!(mean(0.9, 1) < 120.0, "{}", mean(0.9, 1));

    let colored = dressed(&prop, &film, &shown, StainOutput::VertexColors);
    assert!(colored.sheets.is_empty());
    let [primitive] = &colored.primitives[..] else { panic!("only paint") };
    assert_eq!((primitive.cover, primitive.has.colors), (Cover::Plain, true));
    for (color, rest) in primitive.part.colors.iter().zip(&primitive.part.rest) {
        assert!(color.iter().all(|c| (0.0..=1.0).contains(c)));
        assert!(rest[0] > 0.75 || *color == [1.0; 4], "clean at {rest:?}");
        assert!(rest[0] < 0.8 || color[1] < 0.6, "{color:?} at {rest:?}");
    }
    assert_eq!(dressed(&prop, &film, &shown, StainOutput::None).primitives[0].cover, Cover::Plain);
}

#[test]
fn colours_without_a_texture_are_the_whole_look() {
    let (prop, film) = square(UPRIGHT, Slot::default());
    let shown = shown(&prop, &film);
    let colored = dressed(&prop, &film, &shown, StainOutput::VertexColors);
    assert_eq!(colored.primitives[0].cover, Cover::Colors(None));
    assert!(colored.primitives[0].part.colors.iter().all(|c| *c == [1.0; 4]), "glTF's default is white");
    assert_eq!(to_srgb(1.0), 255);
}

#[test]
fn textures_that_cannot_be_read_stay() {
    let slot = Slot { material: Some(0), uvs: true, ..Slot::default() };
    let (prop, film) = square(UPRIGHT, slot);
    let shown = shown(&prop, &film);
    let mut library = library();
    library.images[0].bytes = library.images[0].bytes[..40].into();
    for output in [StainOutput::Textures(128), StainOutput::VertexColors] {
        let dressed = dress(&prop, &film, (&shown, bare(&prop, &shown)), &library, &mut Textures::default(), output);
        assert_eq!(dressed.primitives[0].cover, Cover::Plain);
        assert!(dressed.sheets.is_empty());
        let [warning] = &dressed.warnings[..] else { panic!("one warning") };
        let warning = warning.to_string();
        assert!(
            warning.starts_with("square: its paint shows no stains: material \"\" cannot be read: image"),
            "{warning}"
        );
    }
}

#[test]
fn the_same_film_gives_the_same_bytes() {
    let slot = Slot { material: Some(0), uvs: true, ..Slot::default() };
    let (prop, film) = square(UPRIGHT.map(|uv| uv.map(|x| x * 0.01)), slot);
    let shown = shown(&prop, &film);
    let draw = || dressed(&prop, &film, &shown, StainOutput::Textures(200));
    let (first, second) = (draw(), draw());
    assert_eq!(first.sheets[0].base, second.sheets[0].base);
    assert_eq!(first.primitives[0].part.uvs, second.primitives[0].part.uvs);
}
