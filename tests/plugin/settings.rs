//! Settings as Bevy assets, loaded through a real asset server from memory.

use std::{any::TypeId, path::Path, time::Duration};

use bevy::{
    asset::{
        AssetLoadError, LoadState,
        io::{
            AssetSourceBuilder, AssetSourceId,
            memory::{Dir, MemoryAssetReader},
        },
    },
    mesh::MeshPlugin,
    prelude::*,
    reflect::{GetPath, TypeRegistry, std_traits::ReflectDefault},
};
use bevy_coating::{
    CoatingSettingsPlugin, CoatingWeatheringPlugin,
    settings::{CoatingSettings, Preset, Rules},
};

/// An app whose assets are the files put into the returned folder.
fn app() -> (App, Dir) {
    let (mut app, folder) = bare_app();
    app.add_plugins(CoatingSettingsPlugin);
    (app, folder)
}

/// The same without our plugin.
fn bare_app() -> (App, Dir) {
    let folder = Dir::default();
    let root = folder.clone();
    let mut app = App::new();
    app.register_asset_source(
        AssetSourceId::Default,
        AssetSourceBuilder::new(move || Box::new(MemoryAssetReader { root: root.clone() })),
    );
    app.add_plugins((MinimalPlugins, AssetPlugin::default()));
    (app, folder)
}

/// Updates the app until `done`, for 20 seconds at most.
fn update_until(app: &mut App, what: &str, mut done: impl FnMut(&App) -> bool) {
    for _ in 0..20_000 {
        app.update();
        if done(app) {
            return;
        }
        std::thread::sleep(Duration::from_millis(1));
    }
    panic!("timed out: {what}");
}

fn load(app: &mut App, file: &'static str) -> Handle<CoatingSettings> {
    app.world().resource::<AssetServer>().load(file)
}

fn settings<'a>(app: &'a App, handle: &Handle<CoatingSettings>) -> Option<&'a CoatingSettings> {
    app.world().resource::<Assets<CoatingSettings>>().get(handle)
}

/// The message with which the server refused the asset, if it did.
fn refusal(app: &App, handle: &Handle<CoatingSettings>) -> Option<String> {
    match app.world().resource::<AssetServer>().load_state(handle) {
        LoadState::Failed(error) => match &*error {
            AssetLoadError::AssetLoaderError(error) => Some(error.to_string()),
            error => Some(error.to_string()),
        },
        _ => None,
    }
}

#[test]
fn presets_load_as_assets() {
    let (mut app, folder) = app();
    let handles: Vec<_> = Preset::ALL
        .into_iter()
        .map(|preset| {
            let file = format!("presets/{preset}.coating.ron");
            folder.insert_asset_text(Path::new(&file), preset.ron());
            (preset, app.world().resource::<AssetServer>().load(file))
        })
        .collect();
    for (preset, handle) in handles {
        update_until(&mut app, preset.name(), |app| settings(app, &handle).is_some());
        assert_eq!(settings(&app, &handle), Some(&CoatingSettings::from(preset)));
    }
}

#[test]
fn the_settings_plugin_may_be_added_several_times_in_any_order() {
    let orders: [fn(&mut App); 3] = [
        |app| _ = app.add_plugins((CoatingSettingsPlugin, CoatingWeatheringPlugin::default())),
        |app| _ = app.add_plugins((CoatingWeatheringPlugin::default(), CoatingSettingsPlugin)),
        |app| _ = app.add_plugins(CoatingSettingsPlugin).add_plugins(CoatingSettingsPlugin),
    ];
    for add in orders {
        let (mut app, folder) = bare_app();
        app.add_plugins((MeshPlugin, TransformPlugin));
        add(&mut app);
        folder.insert_asset_text(Path::new("barrel.coating.ron"), "(tearing: (beta: 0.3))");
        let handle = load(&mut app, "barrel.coating.ron");
        update_until(&mut app, "load", |app| settings(app, &handle).is_some());
        app.add_plugins(CoatingSettingsPlugin);
        app.update();
        assert!(settings(&app, &handle).is_some(), "what is loaded stays");
    }
}

#[test]
fn refused_files_say_what_and_where() {
    let (mut app, folder) = app();
    for (file, text, message) in [
        ("a.coating.ron", "(tearing: (beta: NaN))", "a.coating.ron:1:18: setting `tearing.beta` is NaN"),
        ("b.coating.ron", "(\n  adhesion: (octaves: 9),\n)", "b.coating.ron:2:23: setting `adhesion.octaves` is 9"),
        ("c/d.coating.ron", "(soot: ())", "c/d.coating.ron:1:2: there is no setting `soot`"),
    ] {
        folder.insert_asset_text(Path::new(file), text);
        let handle = load(&mut app, file);
        update_until(&mut app, file, |app| refusal(app, &handle).is_some());
        let refusal = refusal(&app, &handle).unwrap();
        assert!(refusal.contains(message), "{refusal}");
        assert!(settings(&app, &handle).is_none());
    }

    folder.insert_asset(Path::new("binary.coating.ron"), vec![b'(', 0xff]);
    let handle = load(&mut app, "binary.coating.ron");
    update_until(&mut app, "binary", |app| refusal(app, &handle).is_some());
    let refusal = refusal(&app, &handle).unwrap();
    assert!(refusal.contains("binary.coating.ron is not UTF-8 text"), "{refusal}");
}

#[test]
fn a_refused_reload_keeps_the_old_settings() {
    let (mut app, folder) = app();
    let file = Path::new("barrel.coating.ron");
    folder.insert_asset_text(file, "(tearing: (beta: 0.3))");
    let handle = load(&mut app, "barrel.coating.ron");
    let beta = |app: &App, handle: &_| settings(app, handle).map(|settings| settings.tearing.beta);
    update_until(&mut app, "load", |app| beta(app, &handle) == Some(0.3));

    folder.insert_asset_text(file, "(tearing: (beta: 3.0))");
    app.world().resource::<AssetServer>().reload("barrel.coating.ron");
    update_until(&mut app, "refused reload", |app| refusal(app, &handle).is_some());
    assert_eq!(beta(&app, &handle), Some(0.3));

    folder.insert_asset_text(file, "(tearing: (beta: 0.4))");
    app.world().resource::<AssetServer>().reload("barrel.coating.ron");
    update_until(&mut app, "good reload", |app| beta(app, &handle) == Some(0.4));
}

#[test]
fn every_setting_is_reflected() {
    let (app, _) = app();
    let registry = app.world().resource::<AppTypeRegistry>().read();
    let registry: &TypeRegistry = &registry;
    let default = registry.get_type_data::<ReflectDefault>(TypeId::of::<CoatingSettings>()).expect("registered");
    let mut reflected = default.default();
    let mut settings = CoatingSettings::default();
    for field in CoatingSettings::fields() {
        let value = 0.5 * (1.0 + field.range.min.max(0.0));
        let value = if field.range.whole { value.ceil() } else { value.min(0.9) };
        field.set(&mut settings, value).unwrap();
        let path = format!(".{}", field.path);
        if !field.names.is_empty() {
            *reflected.path_mut::<Rules>(path.as_str()).unwrap() = settings.scale.rules;
        } else if field.range.whole {
            *reflected.path_mut::<u32>(path.as_str()).unwrap() = value as u32;
        } else {
            *reflected.path_mut::<f32>(path.as_str()).unwrap() = value;
        }
    }
    assert_ne!(settings, CoatingSettings::default());
    assert_eq!(reflected.downcast_ref::<CoatingSettings>(), Some(&settings));
}

/// The table of the scene `settings`, with its test: a value that is out of range is found here.
#[path = "../../examples/settings/rows.rs"]
#[allow(dead_code, reason = "its test is all that is used")]
mod rows;
