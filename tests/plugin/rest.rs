//! What looks the same is not written, and what must be written is spread over frames.

use std::time::Duration;

use bevy::{mesh::VertexAttributeValues, prelude::*};
use bevy_coating::{appearance::DisplayChanges, prelude::*, stain::StainFields};

use crate::common::*;

/// Plates with vertex colours, coated and shown.
fn spawn_plates(app: &mut App, count: usize, display: StainDisplay) -> Vec<Entity> {
    let coating = quick_coating().with_stain_display(display);
    let plates: Vec<Entity> = (0..count).map(|i| spawn_plate(app, 6, coating.clone().with_seed(i as u64))).collect();
    wait_for_films(app, count);
    for _ in 0..3 {
        app.update();
    }
    messages::<AssetEvent<Mesh>>(app);
    plates
}

/// Adds dust everywhere, as a tick would.
fn add_dust(app: &mut App, film: Entity, amount: f32) {
    let mut entity = app.world_mut().entity_mut(film);
    let mut stains = entity.get_mut::<StainFields>().expect("stains");
    stains.film.dust.iter_mut().for_each(|dust| *dust += amount);
    stains.revision += 1;
    entity.get_mut::<DisplayChanges>().expect("a signal").stains = true;
}

/// Updates once and returns the plates whose meshes were written.
fn written(app: &mut App, plates: &[Entity]) -> Vec<usize> {
    app.update();
    let events = messages::<AssetEvent<Mesh>>(app);
    let is_written = |plate: &Entity| {
        let mesh = app.world().get::<Mesh3d>(*plate).expect("a mesh").0.id();
        events.iter().any(|event| matches!(event, AssetEvent::Modified { id } if *id == mesh))
    };
    (0..plates.len()).filter(|&i| is_written(&plates[i])).collect()
}

#[test]
fn stains_that_are_not_drawn_are_never_written() {
    let mut app = app();
    let plates = spawn_plates(&mut app, 1, StainDisplay::None);
    for _ in 0..3 {
        add_dust(&mut app, plates[0], 0.2);
        assert_eq!(written(&mut app, &plates), [0usize; 0]);
    }
}

#[test]
fn stains_that_look_the_same_are_not_written_until_they_add_up() {
    for display in [StainDisplay::VertexColor, StainDisplay::Material] {
        let mut app = app();
        let plates = spawn_plates(&mut app, 1, display);
        add_dust(&mut app, plates[0], 0.5);
        assert_eq!(written(&mut app, &plates), [0], "{display:?}");
        let writes: usize = (0..20)
            .map(|_| {
                add_dust(&mut app, plates[0], 1e-3);
                written(&mut app, &plates).len()
            })
            .sum();
        // They add up to 0.02, five times what can be told apart.
        assert!((4..=6).contains(&writes), "{display:?}: {writes} writes");
    }
}

#[test]
fn a_short_frame_shows_films_in_turn_and_forgets_none() {
    let mut app = app();
    let plates = spawn_plates(&mut app, 6, StainDisplay::VertexColor);
    let show_all = |app: &mut App| plates.iter().for_each(|&plate| add_dust(app, plate, 0.05));
    // One frame to measure.
    show_all(&mut app);
    assert_eq!(written(&mut app, &plates).len(), 6, "without a limit all are shown at once");
    app.insert_resource(CoatingBudget { max_time: Duration::from_nanos(1), ..CoatingBudget::default() });
    show_all(&mut app);
    let mut turns: Vec<usize> = Vec::new();
    for _ in 0..6 {
        let shown = written(&mut app, &plates);
        assert_eq!(shown.len(), 1, "{shown:?}");
        turns.extend(shown);
    }
    turns.sort_unstable();
    assert_eq!(turns, [0, 1, 2, 3, 4, 5], "each once");
    assert_eq!(written(&mut app, &plates), [0usize; 0]);
    // While all change in every frame, each still gets its turn.
    let mut counts = [0; 6];
    for _ in 0..60 {
        show_all(&mut app);
        written(&mut app, &plates).into_iter().for_each(|i| counts[i] += 1);
    }
    assert!(counts.iter().all(|count| (8..=12).contains(count)), "{counts:?}");
}

#[test]
fn colours_that_were_followed_are_those_that_are_drawn_afresh() {
    let mut app = app();
    let film = spawn_plates(&mut app, 1, StainDisplay::VertexColor)[0];
    take_steps(&mut app, 20);
    for _ in 0..25 {
        take_steps(&mut app, 1);
    }
    let colors = |app: &App| -> Vec<[f32; 4]> {
        let mesh = app.world().resource::<Assets<Mesh>>().get(&app.world().get::<Mesh3d>(film).expect("a mesh").0);
        match mesh.expect("an asset").attribute(Mesh::ATTRIBUTE_COLOR) {
            Some(VertexAttributeValues::Float32x4(colors)) => colors.clone(),
            other => panic!("{other:?}"),
        }
    };
    let followed = colors(&app);
    for display in [StainDisplay::None, StainDisplay::VertexColor] {
        app.world_mut().get_mut::<Coating>(film).expect("a coating").stain_display = display;
        app.update();
    }
    let afresh = colors(&app);
    assert_eq!(followed.len(), afresh.len());
    let largest = followed.iter().flatten().zip(afresh.iter().flatten()).map(|(a, b)| (a - b).abs());
    let largest = largest.fold(0.0, f32::max);
    assert!(largest < 0.02, "{largest}");
    assert!(afresh.iter().any(|color| color[0] < 0.9), "there is something to see");
}

/// Prints what showing costs while 30 props age. For machines that do nothing else:
/// `cargo test --test plugin thirty -- --ignored --nocapture`.
#[test]
#[ignore = "measures time"]
fn thirty_props_that_age() {
    for display in [StainDisplay::VertexColor, StainDisplay::Material, StainDisplay::None] {
        let mut app = app();
        let mesh = add_mesh(&mut app, plate(39));
        for seed in 0..30 {
            let coating = Coating::new(Preset::Default).with_resolution(FilmResolution::Keep).with_seed(seed);
            let coating = coating.with_start_age(0.8).with_stain_display(display);
            app.world_mut().spawn((Mesh3d(mesh.clone()), coating));
        }
        wait_for_films(&mut app, 30);
        for _ in 0..3 {
            app.update();
        }
        messages::<AssetEvent<Mesh>>(&mut app);
        let diagnostic = |app: &App| {
            let store = app.world().resource::<bevy::diagnostic::DiagnosticsStore>();
            store.get(&bevy_coating::diagnostics::MESH_GENERATION).and_then(|stage| stage.value()).unwrap_or(0.0)
        };
        let (mut sum, mut longest, mut writes) = (0.0, 0.0f64, 0);
        for _ in 0..60 {
            take_steps(&mut app, 1);
            let time = diagnostic(&app);
            (sum, longest) = (sum + time, longest.max(time));
            writes += messages::<AssetEvent<Mesh>>(&mut app).len();
        }
        println!("{display:?}: {:.2} ms a frame, longest {longest:.2} ms, {writes} writes", sum / 60.0);
    }
}
