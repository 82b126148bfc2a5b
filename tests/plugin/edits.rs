//! Edits of films by a game.

use bevy::prelude::*;
use bevy_coating::{FilmEdit, film::FilmMesh, prelude::*};

use crate::common::*;

fn shown_triangles(app: &App, entity: Entity) -> usize {
    let handle = &app.world().get::<Mesh3d>(entity).expect("a mesh").0;
    let mesh = app.world().resource::<Assets<Mesh>>().get(handle).expect("an asset");
    triangles_of(mesh).len()
}

#[test]
fn a_game_may_tear_and_strip_a_film_at_any_time() {
    let mut app = app();
    let plate = spawn_plate(&mut app, 8, quick_coating());
    app.world_mut().entity_mut(plate).insert(Transform::from_xyz(5.0, 0.0, 0.0));
    wait_for_films(&mut app, 1);
    let topology = |app: &App| app.world().get::<FilmMesh>(plate).expect("a film").topology.clone();
    let edge = topology(&app).all_edges().find(|&h| topology(&app).bound_twin(h).is_some()).expect("an edge");
    let edit = |app: &mut App, edit| {
        app.world_mut().commands().entity(plate).queue(edit);
        app.world_mut().flush();
    };
    edit(&mut app, FilmEdit::TearEdge(edge));
    let cracks = messages::<FirstCrack>(&mut app);
    assert_eq!(cracks.len(), 1);
    assert!(cracks[0].position.x > 4.5, "in the world: {}", cracks[0].position);
    app.update();
    let before = shown_triangles(&app, plate);
    let face = topology(&app).live_faces().nth(40).expect("a face");
    edit(&mut app, FilmEdit::StripFace(face));
    let fallen = messages::<PieceFallen>(&mut app);
    assert_eq!(fallen.iter().map(|piece| piece.faces).sum::<u32>(), 1);
    app.update();
    assert_eq!(shown_triangles(&app, plate), before - 1, "it is seen in the next frame");

    // The same again, and what there never was, does nothing.
    edit(&mut app, FilmEdit::StripFace(face));
    edit(&mut app, FilmEdit::StripFace(bevy_coating::film::FaceId(100_000)));
    edit(&mut app, FilmEdit::TearEdge(edge));
    assert!(messages::<PieceFallen>(&mut app).is_empty());
    for _ in 0..10 {
        take_steps(&mut app, 5);
        let face = topology(&app).live_faces().next();
        face.into_iter().for_each(|face| edit(&mut app, FilmEdit::StripFace(face)));
        film_state(&app, plate).validate().expect("a sound film");
    }
    // An entity without a film is told of, and that is all.
    let other = app.world_mut().spawn_empty().id();
    app.world_mut().commands().entity(other).queue(FilmEdit::StripFace(face));
    app.update();
}
