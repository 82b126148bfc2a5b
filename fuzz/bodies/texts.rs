//! Texts of masks and of custom properties.

use std::sync::OnceLock;

use bevy_coating::{
    bake::{BakeError, BakeOptions, Images, Model, Stopwatch, bake},
    extras::{ExtrasError, PropExtras},
    masks::{MaskFactors, MaskGround, MaskImage, MaskImages, apply_masks, read_masks},
    remesh::{BuiltFilm, FilmResolution, sample},
    settings::CoatingSettings,
    sim::FilmState,
    stain::Environment,
    surface::Surface,
};
use bevy_math::{Vec2, Vec3, Vec4};

/// A triangle with the custom properties that stand in it as `SAID`.
const MODEL: &str = r#"{"asset":{"version":"2.0"},"nodes":[{"mesh":0,"extras":SAID}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"buffers":[{"byteLength":36,
"uri":"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],"bufferViews":[{"buffer":0,"byteLength":36}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"}]}"#;

/// What masks are put on: a plate with texture coordinates, some of them far away, with colours and two images.
struct Prop {
    surface: Surface,
    built: BuiltFilm,
    fresh: FilmState,
    images: MaskImages,
}

fn prop() -> &'static Prop {
    static PROP: OnceLock<Prop> = OnceLock::new();
    PROP.get_or_init(|| {
        let mut piece = sample::plate(60, 7).expect("a plate");
        let surface = &mut piece.surface;
        let corners: Vec<Vec3> = surface.triangles.iter().flatten().map(|&v| surface.positions[v as usize]).collect();
        surface.uvs = corners.iter().map(|p| Vec2::new(p.x, 1e30 * p.y)).collect();
        surface.colors = corners.iter().map(|p| Vec4::new(p.x, p.y, 0.5, 1.0)).collect();
        let image = |width: u8, height: u8| {
            let texels = (0..width * height).map(|i| [16 * i, 255 - i, i, 128]).collect();
            MaskImage::new(width.into(), height.into(), texels).expect("an image")
        };
        let images = [("a", image(1, 1)), ("b.png", image(3, 2))].map(|(name, image)| (name.to_owned(), image));
        let fresh = FilmState::new(&piece.film, &CoatingSettings::default(), 7, 40).expect("a manifold");
        Prop { surface: piece.surface, built: piece.film, fresh, images: images.into_iter().collect() }
    })
}

/// Reads masks, and puts them on a film, which ages a little. Masks that cannot be used leave it as it is.
pub fn masks(bytes: &[u8]) {
    let masks = match read_masks(&String::from_utf8_lossy(bytes), "fuzz.masks.ron") {
        Ok(masks) => masks,
        Err(error) => return assert!(error.to_string().starts_with("fuzz.masks.ron"), "{error}"),
    };
    let Prop { surface, built, fresh, images } = prop();
    let ground = MaskGround { surface, built, gravity: Vec3::NEG_Y, images };
    let mut film = fresh.clone();
    match apply_masks(&mut film, &masks, &ground) {
        Ok(()) => {
            let factors = MaskFactors::of(&masks, &fresh.mesh, &ground).expect("masks that were put on");
            let MaskFactors { adhesion, binding, contraction, dust, rust, moisture } = factors;
            for (list, most) in [(dust, 1.0), (moisture, 1.0), (rust, 10.0)] {
                assert!(list.iter().all(|stain| (0.0..=most).contains(stain)), "{list:?}");
            }
            for list in [adhesion, binding, contraction] {
                assert!(list.iter().all(|factor| *factor >= 0.0), "{list:?}");
            }
            film.validate().expect("a film in order");
            film.age_to(0.1, &CoatingSettings::default(), &Environment::default());
            film.validate().expect("a film in order");
        }
        Err(error) => {
            assert!(!error.to_string().is_empty());
            assert_eq!(film.digest(), fresh.digest(), "{error}");
        }
    }
}

/// Reads custom properties, and ages a model that has them.
pub fn extras(bytes: &[u8]) {
    let text = String::from_utf8_lossy(bytes);
    let said = PropExtras::read(&text);
    match &said {
        Ok(Some(PropExtras::Coat(coating))) => {
            coating.settings.validate().expect("what was read is in range");
            assert!(coating.start_age.is_none_or(|age| (0.0..=10.0).contains(&age)), "{coating:?}");
        }
        Ok(_) => {}
        Err(error) => assert!(!error.to_string().is_empty()),
    }
    // What is no JSON might still be the rest of a model that says something else.
    if matches!(said, Err(ExtrasError::Json(_))) {
        return;
    }
    let text = MODEL.replace("SAID", &text);
    // More may be nested in it than a reader wants to follow.
    let Ok(model) = Model::from_gltf(text.as_bytes(), None, Images::Skip) else { return };
    let options = BakeOptions { resolution: FilmResolution::Keep, age: 0.02, steps: 100, ..BakeOptions::default() };
    let baked = bake(model, &options, Stopwatch::start(), &());
    match said {
        Ok(None | Some(PropExtras::Coat(_))) => assert!(baked.is_ok(), "{:?}", baked.err()),
        Ok(Some(PropExtras::Exclude)) => {
            assert!(matches!(baked, Err(BakeError::AllLeftAlone { .. })), "{:?}", baked.err());
        }
        // One triangle that is left as it is.
        Err(_) => assert!(baked.is_err()),
    }
}
