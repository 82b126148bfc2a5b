//! How stains are shown where there is nothing to draw with: vertex colours, attributes, and materials left alone.

use bevy::{mesh::VertexAttributeValues, prelude::*};
use bevy_coating::{
    ATTRIBUTE_REST, ATTRIBUTE_REST_NORMAL, ATTRIBUTE_STAINS, appearance::DisplayChanges, prelude::*, stain::StainFields,
};

use crate::common::*;

const OWN: [f32; 4] = [0.2, 0.5, 0.9, 0.75];

fn spawn_blue(app: &mut App, display: StainDisplay) -> Entity {
    let mesh = plate(6);
    let colors = vec![OWN; mesh.count_vertices()];
    let mesh = add_mesh(app, mesh.with_inserted_attribute(Mesh::ATTRIBUTE_COLOR, colors));
    let film = app.world_mut().spawn((Mesh3d(mesh), quick_coating().with_stain_display(display))).id();
    wait_for_films(app, 1);
    app.update();
    film
}

/// Stains the right half of a film, by hand.
fn stain_half(app: &mut App, film: Entity) {
    let rest = film_state(app, film).mesh.geometry.rest_positions;
    let mut entity = app.world_mut().entity_mut(film);
    let mut stains = entity.get_mut::<StainFields>().expect("stains");
    for (i, p) in rest.iter().enumerate() {
        stains.film.stained[i] = if p.x > 0.5 { 2.0 } else { 0.0 };
    }
    stains.revision += 1;
    entity.get_mut::<DisplayChanges>().expect("a signal").stains = true;
    app.update();
}

fn shown(app: &App, film: Entity) -> Mesh {
    let handle = &app.world().get::<Mesh3d>(film).expect("a mesh").0;
    app.world().resource::<Assets<Mesh>>().get(handle).expect("an asset").clone()
}

/// Place at the time and colour of each vertex.
fn colors(mesh: &Mesh) -> Vec<(Vec3, [f32; 4])> {
    let positions = mesh.attribute(Mesh::ATTRIBUTE_POSITION).and_then(VertexAttributeValues::as_float3);
    let Some(VertexAttributeValues::Float32x4(colors)) = mesh.attribute(Mesh::ATTRIBUTE_COLOR) else {
        panic!("no colours")
    };
    positions.expect("positions").iter().map(|&p| p.into()).zip(colors.iter().copied()).collect()
}

fn has_stain_attributes(mesh: &Mesh) -> bool {
    let has = [ATTRIBUTE_STAINS, ATTRIBUTE_REST, ATTRIBUTE_REST_NORMAL].map(|a| mesh.contains_attribute(a));
    assert!(has == [true; 3] || has == [false; 3], "{has:?}");
    has[0]
}

#[test]
fn vertex_colours_carry_stains_over_the_props_own() {
    let mut app = app();
    let film = spawn_blue(&mut app, StainDisplay::VertexColor);
    let fresh = shown(&app, film);
    assert!(!has_stain_attributes(&fresh));
    assert!(colors(&fresh).iter().all(|(_, c)| c.iter().zip(OWN).all(|(a, b)| (a - b).abs() < 1e-5)));
    stain_half(&mut app, film);
    for (p, c) in colors(&shown(&app, film)) {
        let rusty = c[0] > 2.0 * c[2];
        assert_eq!(rusty, p.x > 0.5, "{p}: {c:?}");
        assert!((c[3] - OWN[3]).abs() < 1e-5, "alpha is the prop's");
    }
}

#[test]
fn displays_can_be_changed_at_any_time() {
    let mut app = app();
    let film = spawn_blue(&mut app, StainDisplay::None);
    stain_half(&mut app, film);
    let is_own =
        |app: &App| colors(&shown(app, film)).iter().all(|(_, c)| c.iter().zip(OWN).all(|(a, b)| (a - b).abs() < 1e-5));
    assert!(is_own(&app) && !has_stain_attributes(&shown(&app, film)), "nothing of stains is shown");
    let set = |app: &mut App, display| {
        app.world_mut().get_mut::<Coating>(film).expect("a coating").stain_display = display;
        app.update();
    };
    set(&mut app, StainDisplay::Material);
    assert!(is_own(&app) && has_stain_attributes(&shown(&app, film)));
    set(&mut app, StainDisplay::VertexColor);
    assert!(!is_own(&app) && !has_stain_attributes(&shown(&app, film)));
    set(&mut app, StainDisplay::None);
    assert!(is_own(&app) && !has_stain_attributes(&shown(&app, film)));
}

#[test]
fn a_changed_look_is_shown_and_an_unchanged_one_touches_nothing() {
    let mut app = app();
    let film = spawn_blue(&mut app, StainDisplay::VertexColor);
    stain_half(&mut app, film);
    let before = colors(&shown(&app, film));
    messages::<AssetEvent<Mesh>>(&mut app);
    app.world_mut().get_mut::<Coating>(film).expect("a coating").set_changed();
    app.update();
    app.update();
    assert_eq!(messages::<AssetEvent<Mesh>>(&mut app).len(), 0, "a coating that is the same");
    app.world_mut().get_mut::<Coating>(film).expect("a coating").shading.stains.rust_thick = Vec3::ZERO;
    app.update();
    let after = colors(&shown(&app, film));
    let darker = before.iter().zip(&after).filter(|((p, b), (_, a))| p.x > 0.5 && a[0] < b[0]).count();
    assert_eq!(darker, before.iter().filter(|(p, _)| p.x > 0.5).count());
}

#[cfg(feature = "render")]
mod custom {
    use bevy::{pbr::Material, render::render_resource::AsBindGroup};

    use super::*;

    #[derive(Asset, AsBindGroup, Reflect, Clone, Default)]
    struct Glow {}

    impl Material for Glow {}

    #[test]
    fn a_material_that_stays_need_not_be_standard() {
        let mut app = app();
        app.init_asset::<Image>().init_asset::<StandardMaterial>();
        app.init_asset::<Glow>().register_type::<MeshMaterial3d<Glow>>();
        let glow = app.world_mut().resource_mut::<Assets<Glow>>().add(Glow {});
        let mesh = add_mesh(&mut app, plate(4));
        let spawn = |app: &mut App, display| {
            let coating = quick_coating().with_stain_display(display);
            app.world_mut().spawn((Mesh3d(mesh.clone()), MeshMaterial3d(glow.clone()), coating)).id()
        };
        let films = [StainDisplay::VertexColor, StainDisplay::None].map(|display| spawn(&mut app, display));
        wait_for_films(&mut app, 2);
        assert!(films.iter().all(|&film| app.world().get::<MeshMaterial3d<Glow>>(film).is_some()));
        let refused = spawn(&mut app, StainDisplay::Material);
        update_until(&mut app, |app| app.world().resource::<CoatingStatus>().refused == 1);
        let failed = messages::<FilmFailed>(&mut app);
        assert_eq!(failed[0].entity, refused);
        let error = failed[0].error.to_string();
        assert!(error.contains("::Glow") && error.contains("StainDisplay::VertexColor"), "{error}");
    }
}
