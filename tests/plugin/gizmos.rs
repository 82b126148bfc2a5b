//! Gizmos of films, without a GPU.

use std::any::TypeId;

use bevy::{
    gizmos::{GizmoHandles, GizmoPlugin},
    prelude::*,
};
use bevy_coating::{CoatingGizmos, CoatingGizmosPlugin};

use crate::common::*;

/// Whether anything was drawn in the last frame.
fn is_drawn(app: &App) -> bool {
    let handles = app.world().resource::<GizmoHandles>().handles();
    handles.get(&TypeId::of::<CoatingGizmos>()).is_some_and(Option::is_some)
}

#[test]
fn gizmos_are_drawn_when_they_are_enabled_and_there_is_something_to_see() {
    let mut app = app();
    app.add_plugins((GizmoPlugin, CoatingGizmosPlugin));
    spawn_plate(&mut app, 10, quick_coating().with_seed(1));
    wait_for_films(&mut app, 1);
    take_steps(&mut app, 60);
    assert!(!is_drawn(&app), "off by default");
    let set = |app: &mut App, enabled, gizmos| {
        let mut store = app.world_mut().resource_mut::<GizmoConfigStore>();
        let (config, group) = store.config_mut::<CoatingGizmos>();
        (config.enabled, *group) = (enabled, gizmos);
        app.update();
    };
    let none = CoatingGizmos { tips: false, lengths: false, bends: false, planes: false };
    set(&mut app, true, none);
    assert!(!is_drawn(&app));
    for gizmos in [
        CoatingGizmos { tips: true, ..none },
        CoatingGizmos { lengths: true, ..none },
        CoatingGizmos { bends: true, ..none },
        CoatingGizmos { planes: true, ..none },
    ] {
        set(&mut app, true, gizmos);
        assert!(is_drawn(&app), "{gizmos:?}");
        set(&mut app, false, gizmos);
        assert!(!is_drawn(&app), "{gizmos:?}");
    }
}

#[test]
fn without_bevys_gizmos_there_are_none_and_no_panic() {
    let mut app = app();
    app.add_plugins(CoatingGizmosPlugin);
    spawn_plate(&mut app, 4, quick_coating());
    wait_for_films(&mut app, 1);
    take_steps(&mut app, 5);
}
