//! Coatings from the custom properties of glTF files.

use bevy::{
    gltf::{GltfAssetLabel, GltfExtras, GltfMaterialExtras, GltfMeshExtras, GltfPlugin},
    image::ImagePlugin,
    prelude::*,
    world_serialization::{WorldAssetRoot, WorldSerializationPlugin},
};
use bevy_coating::{SettingsSource, film::FilmMesh, prelude::*};

use crate::common::*;

fn named(app: &mut App, name: &str) -> Entity {
    let mut names = app.world_mut().query::<(Entity, &Name)>();
    let found = names.iter(app.world()).find(|(_, own)| own.as_str() == name);
    found.unwrap_or_else(|| panic!("no {name}")).0
}

fn node(extras: &str) -> impl Bundle {
    (Transform::default(), Visibility::default(), GltfExtras { value: extras.into() })
}

fn preset_of(app: &App, entity: Entity) -> Option<Preset> {
    let SettingsSource::Inline(settings) = &app.world().get::<Coating>(entity)?.settings else { return None };
    Preset::ALL.into_iter().find(|&preset| *settings == preset.into())
}

#[test]
fn a_model_from_blender_is_painted_as_its_properties_say() {
    let mut app = bare_app();
    app.add_plugins((ImagePlugin::default(), WorldSerializationPlugin, GltfPlugin::default()));
    app.add_plugins(CoatingWeatheringPlugin::default());
    app.insert_resource(CoatingBudget::UNLIMITED);
    app.init_asset::<StandardMaterial>();
    app.finish();
    app.cleanup();
    let scene = GltfAssetLabel::Scene(0).from_asset("props/custom_properties.glb");
    let scene = app.world().resource::<AssetServer>().load(scene);
    app.world_mut().spawn(WorldAssetRoot(scene));
    // The cabinet with its drawer, the rail and the panel.
    wait_for_films(&mut app, 4);

    let cabinet = named(&mut app, "cabinet");
    let mut expected = CoatingSettings::from(Preset::Harsh);
    expected.adhesion.mean = 1.8;
    let expected = Coating::new(expected).with_seed(7).with_start_age(0.5);
    assert_eq!(app.world().get::<Coating>(cabinet), Some(&expected));
    let drawer = named(&mut app, "drawer");
    assert!(app.world().get::<Coating>(drawer).is_none(), "it has the coating above it");

    let rail = named(&mut app, "rail");
    assert_eq!(preset_of(&app, rail), Some(Preset::Marine), "its primitives share a film");
    let panel = named(&mut app, "panel");
    assert!(app.world().get::<Coating>(panel).is_none());
    let panel = app.world().get::<Children>(panel).expect("a primitive")[0];
    assert_eq!(preset_of(&app, panel), Some(Preset::PowderCoat));
    let window = named(&mut app, "window");
    assert!(app.world().get::<CoatingExclude>(window).is_some());
    for name in ["misspelt", "stone"] {
        let bare = named(&mut app, name);
        assert!(app.world().get::<Coating>(bare).is_none(), "{name}");
    }
    let films = app.world_mut().query::<&FilmMesh>().iter(app.world()).count();
    assert_eq!(films, 4);
}

#[test]
fn what_the_game_says_goes_before_the_file() {
    let mut app = app();
    let own = app.world_mut().spawn((node(r#"{ "coating": "marine" }"#), quick_coating())).id();
    let cleared = app.world_mut().spawn(node(r#"{ "coating": "marine" }"#)).id();
    app.update();
    assert_eq!(app.world().get::<Coating>(own), Some(&quick_coating()));
    assert_eq!(preset_of(&app, cleared), Some(Preset::Marine));
    app.world_mut().entity_mut(cleared).remove::<Coating>();
    (0..3).for_each(|_| app.update());
    assert!(app.world().get::<Coating>(cleared).is_none(), "a coating that was taken off stays off");
}

#[test]
fn objects_go_before_meshes_and_materials_before_both() {
    let mut app = app();
    let mesh = add_mesh(&mut app, plate(4));
    let primitive = |app: &mut App, parent: Entity, material: Option<&str>| {
        let extras = GltfMeshExtras { value: r#"{ "coating": "gentle" }"#.into() };
        let mut child = app.world_mut().spawn((Mesh3d(mesh.clone()), ChildOf(parent), extras));
        if let Some(value) = material {
            child.insert(GltfMaterialExtras { value: value.into() });
        }
        child.id()
    };
    let object = app.world_mut().spawn(node(r#"{ "coating": "harsh" }"#)).id();
    let plain = primitive(&mut app, object, None);
    let chrome = primitive(&mut app, object, Some(r#"{ "coating": false }"#));
    // A node with a node below it: the coating of its mesh is not that of its children.
    let parent = app.world_mut().spawn(node("{}")).id();
    let own = primitive(&mut app, parent, Some(r#"{ "shine": 3 }"#));
    let below = app.world_mut().spawn((node("{}"), ChildOf(parent))).id();
    let wrong = app.world_mut().spawn(node(r#"{ "coating": "harsh", "coating.adhesion.mean": -1 }"#)).id();
    app.update();
    assert_eq!(preset_of(&app, object), Some(Preset::Harsh));
    assert_eq!(preset_of(&app, plain), None);
    assert!(app.world().get::<CoatingExclude>(chrome).is_some());
    assert_eq!((preset_of(&app, parent), preset_of(&app, own)), (None, Some(Preset::Gentle)));
    assert!(app.world().get::<Coating>(below).is_none());
    assert!(app.world().get::<Coating>(wrong).is_none(), "what is refused stays as it is");
}
