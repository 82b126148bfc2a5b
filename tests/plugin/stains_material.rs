//! The material that draws stains comes and goes with the coating, and follows the prop's own. Needs a graphics
//! adapter, be it a software renderer.

use bevy::{
    camera::RenderTarget,
    core_pipeline::prepass::{DepthPrepass, NormalPrepass},
    prelude::*,
    render::render_resource::TextureFormat,
};
use bevy_coating::{CoatedMaterial, StainedMaterial, prelude::*};

use crate::{
    common::{add_mesh, messages, plate, quick_coating, update_until},
    studio::Studio,
};

type Own = MeshMaterial3d<StandardMaterial>;
type Worn = MeshMaterial3d<StainedMaterial>;

fn add_material(app: &mut App, color: Color) -> Handle<StandardMaterial> {
    app.world_mut().resource_mut::<Assets<StandardMaterial>>().add(color)
}

/// A metre of plate about the origin, coated and ready.
fn coated(studio: &mut Studio) -> (Entity, Handle<StandardMaterial>) {
    let app = &mut studio.app;
    let (own, mesh) = (add_material(app, Color::srgb(0.8, 0.1, 0.1)), add_mesh(app, plate(8)));
    let place = Transform::from_xyz(-0.5, -0.5, 0.0);
    let prop = app.world_mut().spawn((Mesh3d(mesh), MeshMaterial3d(own.clone()), place, quick_coating())).id();
    update_until(app, |app| app.world().resource::<CoatingStatus>().films == 1);
    app.update();
    (prop, own)
}

/// Colour of the material that `prop` wears with stains.
fn worn_color(app: &App, prop: Entity) -> Option<Color> {
    let worn = app.world().get::<Worn>(prop)?;
    Some(app.world().resource::<Assets<StainedMaterial>>().get(&worn.0)?.base.base_color)
}

fn set_display(app: &mut App, prop: Entity, display: StainDisplay) {
    app.world_mut().get_mut::<Coating>(prop).expect("a coating").stain_display = display;
}

#[test]
fn a_coated_prop_wears_its_own_material_with_stains_and_gets_it_back() {
    let Some(mut studio) = Studio::open(64, 48, ".") else { return };
    let (prop, own) = coated(&mut studio);
    let app = &mut studio.app;
    assert!(app.world().get::<Own>(prop).is_none(), "never two materials");
    assert_eq!(worn_color(app, prop), Some(Color::srgb(0.8, 0.1, 0.1)));
    assert_eq!(app.world().get::<CoatedMaterial>(prop), Some(&CoatedMaterial(own.clone())));

    let mut materials = app.world_mut().resource_mut::<Assets<StandardMaterial>>();
    materials.get_mut(&own).expect("its own").base_color = Color::srgb(0.1, 0.8, 0.1);
    app.update();
    app.update();
    assert_eq!(worn_color(app, prop), Some(Color::srgb(0.1, 0.8, 0.1)), "an edited asset");

    let other = add_material(app, Color::srgb(0.1, 0.1, 0.8));
    app.world_mut().entity_mut(prop).insert(MeshMaterial3d(other.clone()));
    app.update();
    assert!(app.world().get::<Own>(prop).is_none());
    assert_eq!(worn_color(app, prop), Some(Color::srgb(0.1, 0.1, 0.8)), "an inserted handle");
    app.world_mut().get_mut::<CoatedMaterial>(prop).expect("coated").0 = own.clone();
    app.update();
    assert_eq!(worn_color(app, prop), Some(Color::srgb(0.1, 0.8, 0.1)), "a swapped handle");

    set_display(app, prop, StainDisplay::VertexColor);
    app.update();
    assert_eq!(app.world().get::<Own>(prop).map(|own| &own.0), Some(&own));
    assert!(app.world().get::<Worn>(prop).is_none() && app.world().get::<CoatedMaterial>(prop).is_none());
    set_display(app, prop, StainDisplay::Material);
    app.update();
    assert!(app.world().get::<Own>(prop).is_none() && app.world().get::<Worn>(prop).is_some());

    // While another film is built, the prop keeps the film and the material that it has.
    app.world_mut().get_mut::<Coating>(prop).expect("a coating").seed = Some(9);
    update_until(app, |app| {
        assert!(app.world().get::<Worn>(prop).is_some());
        !messages::<FilmReady>(app).is_empty()
    });
    assert_eq!(app.world().get::<CoatedMaterial>(prop), Some(&CoatedMaterial(own.clone())));

    app.world_mut().entity_mut(prop).remove::<Coating>();
    app.update();
    assert_eq!(app.world().get::<Own>(prop).map(|own| &own.0), Some(&own));
    assert!(app.world().get::<Worn>(prop).is_none() && app.world().get::<CoatedMaterial>(prop).is_none());
    for _ in 0..3 {
        app.update();
    }
    assert!(app.world().resource::<Assets<StainedMaterial>>().is_empty(), "nothing is left behind");
}

#[test]
fn materials_change_off_screen_and_on_it_before_several_cameras() {
    let Some(mut studio) = Studio::open(160, 120, ".") else { return };
    // A second view with passes of its own, and shadows.
    let image = Image::new_target_texture(80, 60, TextureFormat::Rgba8UnormSrgb, None);
    let image = studio.app.world_mut().resource_mut::<Assets<Image>>().add(image);
    let view = Transform::from_xyz(0.3, 0.2, 2.0).looking_at(Vec3::ZERO, Vec3::Y);
    let target = RenderTarget::Image(image.into());
    let camera = (Camera3d::default(), target, Msaa::Off, DepthPrepass, NormalPrepass, view);
    let second = studio.app.world_mut().spawn(camera).id();
    studio.app.world_mut().query::<&mut DirectionalLight>().iter_mut(studio.app.world_mut()).for_each(|mut light| {
        light.shadow_maps_enabled = true;
    });
    let (prop, _) = coated(&mut studio);
    let eye = Vec3::Z * 2.0;
    let before = studio.shoot(eye, Vec3::ZERO);
    let displays = [StainDisplay::VertexColor, StainDisplay::Material];
    for (round, hidden) in [true, true, false, false].into_iter().enumerate() {
        // Looking away, with both cameras, or not; the type of the material changes twice, some frames apart.
        let away = Transform::from_translation(eye).looking_at(eye * 2.0, Vec3::Y);
        if hidden {
            studio.camera_mut().insert(away);
            studio.app.world_mut().entity_mut(second).insert(away);
            studio.app.update();
            studio.app.update();
        }
        for display in displays {
            set_display(&mut studio.app, prop, display);
            for _ in 0..3 {
                studio.app.update();
            }
        }
        if round % 2 == 1 {
            set_display(&mut studio.app, prop, StainDisplay::VertexColor);
            studio.app.update();
        }
        studio.app.world_mut().entity_mut(second).insert(view);
        let after = studio.shoot(eye, Vec3::ZERO);
        let (psnr, pixels) = before.psnr(&after);
        assert!(psnr > 45.0 && pixels > 2000, "round {round}: {psnr:.1} dB over {pixels} pixels");
    }
    // Two changes within a frame, and one of the handle, are none to the eye.
    for display in displays.into_iter().chain(displays) {
        set_display(&mut studio.app, prop, display);
    }
    let (psnr, _) = before.psnr(&studio.shoot(eye, Vec3::ZERO));
    assert!(psnr > 45.0, "{psnr:.1} dB");
    assert_eq!(studio.broken_pipelines(), Vec::<String>::new());
}
