//! Backs and metal have the sides and the holes of the prop's material, whatever that is, and of each primitive its
//! own.

use bevy::{
    camera::visibility::{NoFrustumCulling, RenderLayers, VisibilityRange},
    light::{NotShadowCaster, NotShadowReceiver, TransmittedShadowReceiver},
    math::Affine2,
    mesh::{UvChannel, VertexAttributeValues},
    pbr::Material,
    prelude::*,
    render::render_resource::{AsBindGroup, Face},
};
use bevy_coating::{CoatingPart, StainedMaterial, prelude::*};

use crate::common::*;

/// A material that the plugin does not know.
#[derive(Asset, AsBindGroup, Reflect, Clone, Default)]
struct Glow {}

impl Material for Glow {}

/// The app with standard materials and one of the game's own, but nothing to draw them.
fn app_with_materials() -> App {
    let mut app = app();
    app.init_asset::<Image>().init_asset::<StandardMaterial>();
    app.init_asset::<Glow>().register_type::<MeshMaterial3d<Glow>>();
    app
}

fn add<A: Asset>(app: &mut App, asset: A) -> Handle<A> {
    app.world_mut().resource_mut::<Assets<A>>().add(asset)
}

/// The children of `primitive` that draw backs and metal, by name: metal first.
fn parts(app: &mut App, primitive: Entity) -> Vec<Entity> {
    let mut query = app.world_mut().query_filtered::<(Entity, &Name, &ChildOf), With<CoatingPart>>();
    let mut parts: Vec<_> = query
        .iter(app.world())
        .filter(|(.., parent)| parent.parent() == primitive)
        .map(|(part, name, _)| (name.to_string(), part))
        .collect();
    parts.sort();
    parts.into_iter().map(|(_, part)| part).collect()
}

fn material(app: &App, part: Entity) -> StandardMaterial {
    let handle = &app.world().get::<MeshMaterial3d<StandardMaterial>>(part).expect("a material").0;
    app.world().resource::<Assets<StandardMaterial>>().get(handle).expect("an asset").clone()
}

fn mesh(app: &App, part: Entity) -> Mesh {
    let handle = &app.world().get::<Mesh3d>(part).expect("a mesh").0;
    app.world().resource::<Assets<Mesh>>().get(handle).expect("an asset").clone()
}

/// A plate with a material of the game's own, aged until there is metal to see.
fn spawn_glowing(app: &mut App, coating: Coating) -> Entity {
    let glow = MeshMaterial3d(add(app, Glow {}));
    let plate = add_mesh(app, plate(10));
    let prop = app.world_mut().spawn((Mesh3d(plate), glow, coating.with_seed(1))).id();
    wait_for_films(app, 1);
    take_steps(app, 80);
    app.update();
    prop
}

#[test]
fn props_of_custom_materials_have_backs_and_metal() {
    for display in [StainDisplay::VertexColor, StainDisplay::None] {
        let mut app = app_with_materials();
        let prop = spawn_glowing(&mut app, quick_coating().with_stain_display(display));
        let found = parts(&mut app, prop);
        assert_eq!(found.len(), 2, "{display:?}: one looks through the holes");
        for part in found {
            let material = material(&app, part);
            assert_eq!((material.cull_mode, material.double_sided), (Some(Face::Back), false), "{display:?}");
            assert_eq!(material.alpha_mode, AlphaMode::Opaque, "{display:?}");
        }
        assert!(app.world().get::<MeshMaterial3d<Glow>>(prop).is_some(), "the material stays");
    }
}

#[test]
fn a_mesh_without_any_material_is_not_drawn_and_has_no_metal() {
    let mut app = app_with_materials();
    let mesh = add_mesh(&mut app, plate(10));
    let prop = app.world_mut().spawn((Mesh3d(mesh), quick_coating().with_seed(1))).id();
    wait_for_films(&mut app, 1);
    take_steps(&mut app, 80);
    app.update();
    assert_eq!(parts(&mut app, prop), []);
    // Later it gets one.
    let glow = MeshMaterial3d(add(&mut app, Glow {}));
    app.world_mut().entity_mut(prop).insert(glow);
    take_steps(&mut app, 1);
    assert_eq!(parts(&mut app, prop).len(), 2);
    app.world_mut().entity_mut(prop).remove::<MeshMaterial3d<Glow>>().insert(CoatedTwice);
    app.world_mut().get_mut::<Coating>(prop).expect("a coating").shading.primer.roughness = 0.5;
    app.update();
    app.update();
    assert_eq!(parts(&mut app, prop), [], "and loses it");
}

/// Any component, to bring the prop into another archetype.
#[derive(Component)]
struct CoatedTwice;

#[test]
fn the_outline_of_a_custom_material_is_a_setting_that_acts_live() {
    let mut app = app_with_materials();
    let texture = add(&mut app, Image::default());
    let coating = quick_coating().with_stain_display(StainDisplay::VertexColor);
    let outline = PropOutline { double_sided: true, ..default() };
    let prop = spawn_glowing(&mut app, coating.with_outline(outline));
    let found = parts(&mut app, prop);
    let [metal, back] = found[..] else { panic!("{found:?}") };
    assert_eq!((material(&app, metal).cull_mode, material(&app, metal).double_sided), (None, true));
    assert_eq!(material(&app, back).cull_mode, Some(Face::Back), "a back has one side");
    let uv_transform = Affine2::from_scale(Vec2::splat(3.0));
    let mask = PropMask { texture: texture.clone(), cutoff: 0.25, uv_transform, ..default() };
    app.world_mut().get_mut::<Coating>(prop).expect("a coating").outline.mask = Some(mask);
    app.update();
    for part in parts(&mut app, prop) {
        let material = material(&app, part);
        assert_eq!(material.alpha_mode, AlphaMode::Mask(0.25));
        assert_eq!(material.base_color_texture.as_ref(), Some(&texture));
        assert_eq!(material.uv_transform, uv_transform);
        assert!(mesh(&app, part).contains_attribute(Mesh::ATTRIBUTE_UV_0), "the texture is read at coordinates");
    }
}

/// Values of an attribute of two numbers, by place.
fn coordinates(mesh: &Mesh, attribute: bevy::mesh::MeshVertexAttribute) -> Vec<[f32; 2]> {
    match mesh.attribute(attribute) {
        Some(VertexAttributeValues::Float32x2(values)) => values.clone(),
        other => panic!("{other:?}"),
    }
}

#[test]
fn masks_hold_for_backs_and_metal_and_follow_the_props() {
    let mut app = app_with_materials();
    let texture = add(&mut app, Image::default());
    let grating = StandardMaterial {
        base_color: Color::srgba(0.2, 0.4, 0.6, 0.9),
        base_color_texture: Some(texture.clone()),
        base_color_channel: UvChannel::Uv1,
        uv_transform: Affine2::from_scale(Vec2::splat(2.0)),
        alpha_mode: AlphaMode::Mask(0.3),
        cull_mode: None,
        double_sided: true,
        ..default()
    };
    let own = add(&mut app, grating.clone());
    let own_mesh = plate(10);
    let uvs = coordinates(&own_mesh, Mesh::ATTRIBUTE_UV_0);
    let own_mesh = own_mesh.with_inserted_attribute(Mesh::ATTRIBUTE_UV_1, uvs);
    let handle = add_mesh(&mut app, own_mesh);
    let prop = app.world_mut().spawn((Mesh3d(handle), MeshMaterial3d(own.clone()), quick_coating().with_seed(1))).id();
    wait_for_films(&mut app, 1);
    take_steps(&mut app, 80);
    let check = |app: &mut App, expected: &StandardMaterial| {
        let found = parts(app, prop);
        assert_eq!(found.len(), 2);
        for (part, name) in found.into_iter().zip(["metal", "back"]) {
            let material = material(app, part);
            assert_eq!(material.alpha_mode, expected.alpha_mode, "{name}");
            assert_eq!(material.base_color_texture, expected.base_color_texture, "{name}");
            assert_eq!(material.base_color_channel, expected.base_color_channel, "{name}");
            assert_eq!(material.uv_transform, expected.uv_transform, "{name}");
            assert_eq!(material.base_color.alpha(), expected.base_color.alpha(), "{name}");
            let sides = (material.cull_mode, material.double_sided);
            let both = (expected.cull_mode, expected.double_sided);
            assert_eq!(sides, if name == "metal" { both } else { (Some(Face::Back), false) }, "{name}");
        }
    };
    check(&mut app, &grating);
    // The plate's coordinates are its places: x and 1 - y.
    for part in parts(&mut app, prop) {
        let mesh = mesh(&app, part);
        let rest = mesh.attribute(Mesh::ATTRIBUTE_POSITION).and_then(VertexAttributeValues::as_float3).expect("places");
        let found = coordinates(&mesh, Mesh::ATTRIBUTE_UV_1);
        assert_eq!(found.len(), rest.len());
        let near = |(p, uv): (&[f32; 3], &[f32; 2])| (p[0] - uv[0]).abs() < 0.2 && (1.0 - p[1] - uv[1]).abs() < 0.2;
        let right = rest.iter().zip(&found).filter(|&at| near(at)).count();
        assert!(right * 10 >= rest.len() * 9, "{right} of {}", rest.len());
    }
    let opaque = StandardMaterial { alpha_mode: AlphaMode::Opaque, base_color: Color::WHITE, ..default() };
    *app.world_mut().resource_mut::<Assets<StandardMaterial>>().get_mut(&own).expect("its own") = opaque.clone();
    app.update();
    app.update();
    check(&mut app, &opaque);
    let other = add(&mut app, grating.clone());
    app.world_mut().get_mut::<MeshMaterial3d<StandardMaterial>>(prop).expect("its own").0 = other;
    app.update();
    check(&mut app, &grating);
}

/// Two halves of a prop that share a film, aged.
fn spawn_halves(app: &mut App, materials: [StandardMaterial; 2]) -> [Entity; 2] {
    let root = app.world_mut().spawn((Transform::default(), Visibility::default(), quick_coating().with_seed(1))).id();
    let mut x = 0.0;
    let halves = materials.map(|own| {
        let own = MeshMaterial3d(add(app, own));
        let mesh = add_mesh(app, plate(10).translated_by(Vec3::X * x));
        x += 1.0;
        app.world_mut().spawn((Mesh3d(mesh), own, ChildOf(root))).id()
    });
    wait_for_films(app, 1);
    take_steps(app, 80);
    app.update();
    halves
}

#[test]
fn each_primitive_has_backs_and_metal_of_its_own() {
    let mut app = app_with_materials();
    let masked = StandardMaterial { alpha_mode: AlphaMode::Mask(0.5), ..default() };
    let [left, right] = spawn_halves(&mut app, [masked, StandardMaterial { cull_mode: None, ..default() }]);
    let [on_left, on_right] = [left, right].map(|half| parts(&mut app, half));
    assert_eq!([on_left.len(), on_right.len()], [2; 2]);
    assert_eq!(material(&app, on_left[0]).alpha_mode, AlphaMode::Mask(0.5));
    assert_eq!(material(&app, on_left[0]).cull_mode, Some(Face::Back));
    assert_eq!(material(&app, on_right[0]).alpha_mode, AlphaMode::Opaque);
    assert_eq!(material(&app, on_right[0]).cull_mode, None);
    for (metal, side) in [(on_left[0], 0.0..=1.0), (on_right[0], 1.0..=2.0)] {
        let mesh = mesh(&app, metal);
        let places = mesh.attribute(Mesh::ATTRIBUTE_POSITION).and_then(VertexAttributeValues::as_float3);
        assert!(places.expect("places").iter().all(|p| side.contains(&p[0])), "{side:?}");
    }
    // A primitive that goes takes its own with it, at once.
    app.world_mut().despawn(left);
    let world = app.world_mut();
    let left_over = world.query_filtered::<(), With<CoatingPart>>().iter(world).count();
    assert_eq!(left_over, 2);
}

#[test]
fn layers_shadows_ranges_and_visibility_follow_the_primitives() {
    let mut app = app_with_materials();
    let [left, right] = spawn_halves(&mut app, [StandardMaterial::default(), StandardMaterial::default()]);
    let range = VisibilityRange::abrupt(1.0, 20.0);
    app.world_mut().entity_mut(left).insert((
        (RenderLayers::layer(3), NotShadowCaster, NotShadowReceiver),
        (TransmittedShadowReceiver, NoFrustumCulling, range.clone()),
    ));
    app.update();
    let of = |app: &App, part: Entity| {
        let part = app.world().entity(part);
        (
            part.get::<RenderLayers>().cloned(),
            part.get::<VisibilityRange>().cloned().map(|range| range.end_margin),
            [part.contains::<NotShadowCaster>(), part.contains::<NotShadowReceiver>()],
            [part.contains::<TransmittedShadowReceiver>(), part.contains::<NoFrustumCulling>()],
        )
    };
    let none = (None, None, [false; 2], [false; 2]);
    for part in parts(&mut app, left) {
        let margin = Some(range.end_margin.clone());
        assert_eq!(of(&app, part), (Some(RenderLayers::layer(3)), margin, [true; 2], [true; 2]));
    }
    for part in parts(&mut app, right) {
        assert_eq!(of(&app, part), none, "the other one has none of it");
    }
    app.world_mut().entity_mut(left).insert(RenderLayers::layer(5)).remove::<(NotShadowCaster, VisibilityRange)>();
    app.update();
    for part in parts(&mut app, left) {
        let expected = (Some(RenderLayers::layer(5)), None, [false, true], [true; 2]);
        assert_eq!(of(&app, part), expected);
    }
    app.world_mut()
        .entity_mut(left)
        .remove::<(RenderLayers, NotShadowReceiver, TransmittedShadowReceiver, NoFrustumCulling)>();
    app.update();
    for part in parts(&mut app, left) {
        assert_eq!(of(&app, part), none);
        assert_eq!(app.world().get::<ChildOf>(part).map(ChildOf::parent), Some(left), "so visibility is inherited");
        assert_eq!(app.world().get::<Visibility>(part), Some(&Visibility::Inherited));
    }
    // A part that comes later has them from its first frame on.
    app.world_mut().entity_mut(right).insert(RenderLayers::layer(7));
    app.world_mut().entity_mut(right).remove::<MeshMaterial3d<StandardMaterial>>();
    app.update();
    take_steps(&mut app, 1);
    assert_eq!(parts(&mut app, right), [], "without a material nothing is drawn");
    let own = MeshMaterial3d(add(&mut app, StandardMaterial::default()));
    app.world_mut().entity_mut(right).insert(own);
    take_steps(&mut app, 1);
    let found = parts(&mut app, right);
    assert_eq!(found.len(), 2);
    assert!(found.iter().all(|&part| of(&app, part).0 == Some(RenderLayers::layer(7))));
}

#[test]
fn nothing_is_left_of_films_that_were_taken_off_or_despawned() {
    let mut app = app_with_materials();
    app.init_asset::<StainedMaterial>();
    let counts = |app: &App| {
        let world = app.world();
        [
            world.resource::<Assets<Mesh>>().len(),
            world.resource::<Assets<StandardMaterial>>().len(),
            world.resource::<Assets<StainedMaterial>>().len(),
            world.entities().count_spawned() as usize,
        ]
    };
    let mut settled = None;
    for round in 0..3 {
        for display in [StainDisplay::Material, StainDisplay::VertexColor] {
            let masked = StandardMaterial { alpha_mode: AlphaMode::Mask(0.5), ..default() };
            let halves = spawn_halves(&mut app, [masked, StandardMaterial::default()]);
            let root = app.world().get::<ChildOf>(halves[0]).expect("a root").parent();
            app.world_mut().get_mut::<Coating>(root).expect("a coating").stain_display = display;
            take_steps(&mut app, 1);
            app.update();
            assert_eq!(halves.map(|half| parts(&mut app, half).len()), [2; 2]);
            if round == 1 {
                app.world_mut().entity_mut(root).remove::<Coating>();
                app.update();
                app.update();
                assert_eq!(halves.map(|half| parts(&mut app, half).len()), [0; 2], "parts of a film that is off");
            }
            if round == 2 {
                app.world_mut().despawn(halves[0]);
                app.update();
            }
            app.world_mut().despawn(root);
            for _ in 0..4 {
                app.update();
            }
            assert_eq!(*settled.get_or_insert(counts(&app)), counts(&app), "round {round}, {display:?}");
            assert_eq!(counts(&app)[..3], [0; 3], "round {round}, {display:?}");
        }
    }
}
