//! Coatings by reflection, as editors and Bevy's remote protocol set them.

use bevy::{
    ecs::reflect::{AppTypeRegistry, ReflectComponent},
    prelude::*,
    reflect::serde::{TypedReflectDeserializer, TypedReflectSerializer},
};
use bevy_coating::{SettingsSource, film::FilmMesh, prelude::*};
use serde::de::DeserializeSeed;

use crate::common::*;

/// Type path of the component, as a remote request names it.
const COATING: &str = "bevy_coating::api::coating::Coating";

/// Inserts a `Coating` from JSON, as the method `world.insert_components` does.
fn insert(app: &mut App, entity: Entity, json: &str) -> Result<(), String> {
    let registry = app.world().resource::<AppTypeRegistry>().clone();
    let registry = registry.read();
    let registration = registry.get_with_type_path(COATING).ok_or("the component is not registered")?;
    let mut text = serde_json::Deserializer::from_str(json);
    let value = TypedReflectDeserializer::new(registration, &registry).deserialize(&mut text);
    let value = value.map_err(|error| error.to_string())?;
    let component = registration.data::<ReflectComponent>().ok_or("it is no reflected component")?;
    component.insert(&mut app.world_mut().entity_mut(entity), value.as_partial_reflect(), &registry);
    Ok(())
}

#[test]
fn a_coating_that_was_written_by_reflection_is_read_again() {
    let app = app();
    let registry = app.world().resource::<AppTypeRegistry>().clone();
    let registry = registry.read();
    let coating = Coating::new(Preset::Marine).with_seed(7).with_start_age(0.25).with_triangles(300);
    let json = serde_json::to_string(&TypedReflectSerializer::new(&coating, &registry)).expect("text");
    let mut app = app;
    let plate = spawn_plate(&mut app, 6, Coating::default());
    drop(registry);
    insert(&mut app, plate, &json).expect("a coating");
    assert_eq!(app.world().get::<Coating>(plate), Some(&coating));
}

#[test]
fn a_prop_is_coated_and_changed_by_reflection() {
    let mut app = app();
    let mesh = add_mesh(&mut app, plate(6));
    let plate = app.world_mut().spawn(Mesh3d(mesh)).id();
    // What is left out has its default.
    insert(&mut app, plate, r#"{ "seed": 7, "start_age": 0.5, "steps_per_age": 100 }"#).expect("a coating");
    let expected = Coating::default().with_seed(7).with_start_age(0.5).with_steps_per_age(100);
    assert_eq!(app.world().get::<Coating>(plate), Some(&expected));
    wait_for_films(&mut app, 1);
    assert!(app.world().get::<FilmMesh>(plate).is_some());

    let registry = app.world().resource::<AppTypeRegistry>().clone();
    let registry = registry.read();
    let component = registry.get_with_type_path(COATING).and_then(|r| r.data::<ReflectComponent>()).expect("reflected");
    {
        let mut entity = app.world_mut().entity_mut(plate);
        let mut coating = component.reflect_mut(&mut entity).expect("a coating");
        // As `world.mutate_components` does with the path `.settings.0.adhesion.mean`.
        *coating.path_mut::<f32>(".settings.0.adhesion.mean").expect("a setting") = 1.25;
    }
    let SettingsSource::Inline(settings) = &app.world().get::<Coating>(plate).expect("a coating").settings else {
        panic!("settings of its own")
    };
    assert_eq!(settings.adhesion.mean, 1.25);
    app.update();
}

#[test]
fn what_no_coating_is_made_of_is_refused() {
    let mut app = app();
    let plate = spawn_plate(&mut app, 6, Coating::default());
    for wrong in [r#"{ "sede": 7 }"#, r#"{ "seed": "seven" }"#, "7", ""] {
        assert!(insert(&mut app, plate, wrong).is_err(), "{wrong}");
    }
    assert_eq!(app.world().get::<Coating>(plate), Some(&Coating::default()));
}
