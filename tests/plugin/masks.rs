//! Masks of coatings: where films begin weak or dirty.

use bevy::{
    asset::RenderAssetUsages,
    image::Image,
    prelude::*,
    render::render_resource::{Extent3d, TextureDimension, TextureFormat},
};
use bevy_coating::{
    film::VertexId,
    masks::{Mask, MaskEffect, Span},
};

use crate::common::*;
use bevy_coating::prelude::*;

/// A weak and dusty half.
const WEAK: MaskEffect = MaskEffect {
    adhesion: Span(1.0, 0.1),
    binding: Span(1.0, 1.0),
    contraction: Span(1.0, 1.0),
    dust: Span(0.0, 0.9),
    rust: Span(0.0, 0.0),
    moisture: Span(0.0, 0.0),
};

fn app_with_images() -> App {
    let mut app = app();
    app.init_asset::<Image>();
    app
}

/// Black on the left, white on the right.
fn halves(format: TextureFormat, data: Vec<u8>) -> Image {
    let size = Extent3d { width: 2, height: 1, depth_or_array_layers: 1 };
    Image::new(size, TextureDimension::D2, data, format, RenderAssetUsages::default())
}

/// Mean adhesion and dust of the left and of the right of a plate.
fn halves_of(app: &App, plate: Entity) -> [[f32; 2]; 2] {
    let film = film_state(app, plate);
    [false, true].map(|right| {
        let places = film.mesh.geometry.rest_positions.iter().enumerate();
        let half: Vec<usize> = places.filter(|(_, p)| (p.x > 0.5) == right).map(|(i, _)| i).collect();
        let mean = |of: &dyn Fn(usize) -> f32| half.iter().map(|&i| of(i)).sum::<f32>() / half.len() as f32;
        [mean(&|i| film.forces.adhesion(VertexId::new(i))), mean(&|i| film.stains.film.dust[i])]
    })
}

#[test]
fn an_image_makes_half_of_a_plate_weak_once_it_has_loaded() {
    let mut app = app_with_images();
    let image = app.world().resource::<Assets<Image>>().reserve_handle();
    let masks = CoatingMasks::default().with_image("wear.png", image.clone(), WEAK);
    let plate = spawn_plate(&mut app, 12, quick_coating().with_seed(7).with_masks(masks));
    app.world_mut().resource_mut::<CoatingClock>().paused = true;
    (0..20).for_each(|_| app.update());
    assert_eq!(app.world().resource::<CoatingStatus>().films, 0, "it waits for the image");
    let texels = vec![0, 0, 0, 255, 255, 255, 255, 255];
    let mut images = app.world_mut().resource_mut::<Assets<Image>>();
    images.insert(&image, halves(TextureFormat::Rgba8UnormSrgb, texels)).expect("a reserved place");
    wait_for_films(&mut app, 1);
    let [left, right] = halves_of(&app, plate);
    assert!(right[0] < 0.6 * left[0] && right[1] > 0.4 && left[1] < 0.4, "{left:?} {right:?}");
}

#[test]
fn a_change_of_masks_builds_the_film_again_and_none_is_like_no_masks() {
    let mut app = app_with_images();
    let coating = quick_coating().with_seed(7);
    let plain = spawn_plate(&mut app, 10, coating.clone());
    let masked = CoatingMasks::default().with(Mask::Even(1.0), MaskEffect { dust: Span(0.5, 0.5), ..default() });
    let plate = spawn_plate(&mut app, 10, coating.clone().with_masks(masked));
    wait_for_films(&mut app, 2);
    assert_eq!(halves_of(&app, plate)[0][1], 0.5);
    app.world_mut().get_mut::<Coating>(plate).expect("a coating").masks = CoatingMasks::default();
    update_until(&mut app, |app| halves_of(app, plate)[0][1] == 0.0);
    assert_eq!(halves_of(&app, plate), halves_of(&app, plain));
    let same = CoatingMasks::default().with(Mask::edges(0.05), MaskEffect::default());
    app.world_mut().get_mut::<Coating>(plate).expect("a coating").masks = same;
    messages::<FilmReady>(&mut app);
    update_until(&mut app, |app| !messages::<FilmReady>(app).is_empty());
    assert_eq!(halves_of(&app, plate), halves_of(&app, plain), "what has no effect changes no bit");
}

#[test]
fn masks_that_cannot_be_used_are_refused_with_the_way_out() {
    let mut app = app_with_images();
    let mut add = |image| app.world_mut().resource_mut::<Assets<Image>>().add(image);
    let compressed = add(halves(TextureFormat::Rgba8Unorm, vec![0; 8]));
    let mut image = Image::default();
    image.texture_descriptor.format = TextureFormat::Bc1RgbaUnorm;
    image.data = Some(vec![0; 8]);
    let unreadable = add(image);
    let gone = Image { data: None, ..Image::default() };
    let on_gpu = add(gone);
    let named = |name: &str, handle: Handle<Image>| CoatingMasks::default().with_image(name, handle, WEAK);
    let mut unnamed = named("wear.png", compressed.clone());
    unnamed.images.clear();
    let cases = [
        (named("bc1.ktx2", unreadable), "uncompressed"),
        (named("gpu.png", on_gpu), "MAIN_WORLD"),
        (unnamed, "a mask asks for the image `wear.png`, but no images were given"),
        (CoatingMasks::default().with(Mask::Color(Default::default()), WEAK), "vertex colours"),
        (CoatingMasks::default().with(Mask::noise(1, f32::NAN), WEAK), "wavelength"),
    ];
    for (masks, part) in cases {
        let plate = spawn_plate(&mut app, 4, quick_coating().with_masks(masks));
        let mut failures = Vec::new();
        update_until(&mut app, |app| {
            failures.extend(messages::<FilmFailed>(app));
            !failures.is_empty()
        });
        let text = failures[0].error.to_string();
        assert!(text.contains(part), "{text}");
        // Mended, it gets a film.
        app.world_mut().get_mut::<Coating>(plate).expect("a coating").masks = named("wear.png", compressed.clone());
        update_until(&mut app, |app| app.world().get::<bevy_coating::film::FilmMesh>(plate).is_some());
        app.world_mut().entity_mut(plate).despawn();
        assert!(app.world().get_entity(plate).is_err());
        messages::<FilmFailed>(&mut app);
    }
}
