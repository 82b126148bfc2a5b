//! Films that are built again: the prop keeps the old film until the new one is ready, and nothing that changes
//! meanwhile is lost.

use bevy::prelude::*;
use bevy_coating::{CoatingPart, FilmPace, film::FilmMesh, prelude::*};

use crate::common::*;

fn mesh_of(app: &App, entity: Entity) -> Handle<Mesh> {
    app.world().get::<Mesh3d>(entity).expect("a mesh").0.clone()
}

#[test]
fn the_old_film_stays_until_the_new_one_is_ready() {
    let changes: [fn(&mut Coating); 4] = [
        |coating| coating.seed = Some(99),
        |coating| coating.start_age = 0.2,
        |coating| coating.resolution = FilmResolution::Triangles(300),
        |coating| coating.steps_per_age = 50,
    ];
    for (case, change) in changes.into_iter().enumerate() {
        let mut app = app();
        let plate = spawn_plate(&mut app, 8, quick_coating().with_start_age(0.6));
        let own = mesh_of(&app, plate);
        wait_for_films(&mut app, 1);
        let (old, shown) = (film_state(&app, plate).digest(), mesh_of(&app, plate));
        messages::<FilmReady>(&mut app);
        change(&mut app.world_mut().get_mut::<Coating>(plate).expect("a coating"));
        update_until(&mut app, |app| {
            let ready = !messages::<FilmReady>(app).is_empty();
            assert_ne!(mesh_of(app, plate), own, "case {case}: the paint flashes");
            if !ready {
                assert_eq!(mesh_of(app, plate), shown);
                assert_eq!(film_state(app, plate).digest(), old);
            }
            ready
        });
        assert_ne!(film_state(&app, plate).digest(), old, "case {case}");
        app.update();
        assert_eq!(app.world().resource::<CoatingStatus>().films, 1);
        let parts = app.world_mut().query::<&CoatingPart>().iter(app.world()).count();
        assert!(parts <= 2, "{parts} parts");
        app.world_mut().entity_mut(plate).remove::<Coating>();
        app.update();
        app.update();
        assert_eq!(mesh_of(&app, plate), own);
    }
}

#[test]
fn a_change_that_is_taken_back_builds_nothing() {
    let mut app = app();
    let plate = spawn_plate(&mut app, 8, quick_coating().with_seed(1));
    wait_for_films(&mut app, 1);
    take_steps(&mut app, 10);
    messages::<FilmReady>(&mut app);
    app.world_mut().get_mut::<Coating>(plate).expect("a coating").seed = Some(2);
    app.update();
    app.world_mut().get_mut::<Coating>(plate).expect("a coating").seed = Some(1);
    for _ in 0..50 {
        app.update();
        std::thread::sleep(std::time::Duration::from_millis(1));
    }
    assert!(messages::<FilmReady>(&mut app).is_empty());
    assert_eq!(film_state(&app, plate).clock.steps, 10);
}

#[test]
fn a_film_that_cannot_be_built_again_stays() {
    let mut app = app();
    let plate = spawn_plate(&mut app, 8, quick_coating());
    wait_for_films(&mut app, 1);
    take_steps(&mut app, 30);
    messages::<FilmFailed>(&mut app);
    app.world_mut().get_mut::<Coating>(plate).expect("a coating").resolution = FilmResolution::Triangles(0);
    let mut failed = Vec::new();
    for _ in 0..100 {
        app.update();
        std::thread::sleep(std::time::Duration::from_millis(1));
        failed.extend(messages::<FilmFailed>(&mut app));
    }
    assert_eq!(failed.len(), 1, "told once: {failed:?}");
    assert_eq!(film_state(&app, plate).clock.steps, 30);
    take_steps(&mut app, 10);
    assert_eq!(film_state(&app, plate).clock.steps, 40, "and goes on ageing");
    app.world_mut().get_mut::<Coating>(plate).expect("a coating").resolution = FilmResolution::Triangles(200);
    update_until(&mut app, |app| !messages::<FilmReady>(app).is_empty());
    assert_eq!(film_state(&app, plate).clock.steps, 0);
}

#[test]
fn what_changes_during_a_build_acts_when_the_film_is_ready() {
    let mut app = app();
    let plate = spawn_plate(&mut app, 8, quick_coating());
    let asset = app.world_mut().resource_mut::<Assets<CoatingSettings>>().add(CoatingSettings::default());
    let from_file = spawn_plate(&mut app, 9, Coating { settings: asset.clone().into(), ..quick_coating() });
    app.update();
    assert!(app.world().get::<FilmMesh>(plate).is_none(), "it is being built");
    let mut settings = CoatingSettings::default();
    settings.adhesion.decay = 3.25;
    {
        let mut coating = app.world_mut().get_mut::<Coating>(plate).expect("a coating");
        coating.settings = settings.clone().into();
        (coating.rate, coating.quality) = (2.5, SolverQuality::Fast);
        coating.stain_display = StainDisplay::VertexColor;
    }
    app.world_mut().resource_mut::<Assets<CoatingSettings>>().insert(&asset, settings).expect("a handle");
    wait_for_films(&mut app, 2);
    for film in [plate, from_file] {
        let pace = app.world().get::<FilmPace>(film).expect("a film");
        assert_eq!(pace.settings.adhesion.decay, 3.25);
    }
    let pace = app.world().get::<FilmPace>(plate).expect("a film");
    assert_eq!((pace.rate, pace.quality), (2.5, SolverQuality::Fast));
    let mesh = app.world().resource::<Assets<Mesh>>().get(&mesh_of(&app, plate)).expect("an asset");
    assert!(mesh.attribute(Mesh::ATTRIBUTE_COLOR).is_some(), "its stains are drawn as vertex colours");
}
