//! Summaries of films, messages of ratings, and questions about places in the world.

use bevy::{ecs::system::RunSystemOnce, prelude::*};
use bevy_coating::{
    FilmEdit, FilmHit, FilmQuery,
    film::FilmMesh,
    prelude::*,
    survey::{FilmArea, FilmShares, FilmSurface, Rating, Ratings},
};

use crate::common::*;

fn update(app: &mut App, frames: u32) {
    (0..frames).for_each(|_| app.update());
}

fn summary(app: &App, film: Entity) -> FilmSummary {
    *app.world().get::<FilmSummary>(film).expect("a summary")
}

fn at_point(app: &mut App, point: Vec3, within: f32) -> Option<FilmHit> {
    app.world_mut().run_system_once(move |films: FilmQuery| films.at_point(point, within)).expect("an answer")
}

fn along_ray(app: &mut App, origin: Vec3, direction: Dir3) -> Option<FilmHit> {
    app.world_mut()
        .run_system_once(move |films: FilmQuery| films.along_ray(origin, direction, 50.0))
        .expect("an answer")
}

fn in_sphere(app: &mut App, centre: Vec3, radius: f32) -> Option<FilmArea> {
    app.world_mut().run_system_once(move |films: FilmQuery| films.in_sphere(centre, radius)).expect("an answer")
}

#[derive(Resource, Default)]
struct Changes(usize);

fn count(mut changes: ResMut<Changes>, films: Query<(), Changed<FilmSummary>>) {
    changes.0 += films.iter().count();
}

#[test]
fn summaries_follow_their_films_and_rest_with_them() {
    let mut app = app();
    app.init_resource::<Changes>().add_systems(Last, count);
    let plate = spawn_plate(&mut app, 16, quick_coating());
    wait_for_films(&mut app, 1);
    assert_eq!(summary(&app, plate).ratings, Ratings::default());
    assert!((summary(&app, plate).shares.area - 1.0).abs() < 1e-4, "in the frame in which it is ready");
    for steps in [30, 1, 40, 60] {
        take_steps(&mut app, steps);
        let (found, film) = (summary(&app, plate), film_state(&app, plate));
        assert_eq!(found.ratings, Ratings::from(&found.shares));
        // Stains may have crept on, less than can be seen.
        let now = film.shares();
        assert_eq!((found.shares.gone, found.shares.cracks), (now.gone, now.cracks));
        assert_eq!((found.shares.separated, found.shares.crack_density), (now.separated, now.crack_density));
        let stains = |s: &FilmShares| [s.rusted, s.stained, s.dusty, s.wet];
        let apart = stains(&found.shares).into_iter().zip(stains(&now)).map(|(a, b)| (a - b).abs());
        assert!(apart.into_iter().all(|apart| apart < 0.01), "{found:?}, {now:?}");
    }
    assert!(summary(&app, plate).shares.gone > 0.0);
    // Nothing moves, nothing is written.
    let before = app.world().resource::<Changes>().0;
    assert!(before >= 3);
    update(&mut app, 5);
    assert_eq!(app.world().resource::<Changes>().0, before);
    // An edit is seen in the same frame.
    let face = app.world().get::<FilmMesh>(plate).and_then(|mesh| mesh.topology.live_faces().next()).expect("a face");
    let gone = summary(&app, plate).shares.gone;
    app.world_mut().commands().entity(plate).queue(FilmEdit::StripFace(face));
    app.update();
    assert!(summary(&app, plate).shares.gone > gone);
    assert_eq!(app.world().resource::<Changes>().0, before + 1);
    // It goes with its film.
    app.world_mut().entity_mut(plate).remove::<Coating>();
    update(&mut app, 2);
    assert!(app.world().get::<FilmSummary>(plate).is_none());
}

#[test]
fn coatings_know_their_films() {
    let mut app = app();
    let plate_entity = spawn_plate(&mut app, 6, quick_coating());
    let mesh = add_mesh(&mut app, plate(6));
    let root = app.world_mut().spawn((Transform::default(), quick_coating())).id();
    let mut leaves = [1.0, 2.0].map(|x| {
        let place = Transform::from_xyz(x, 0.0, 0.0);
        app.world_mut().spawn((Mesh3d(mesh.clone()), place, ChildOf(root))).id()
    });
    leaves.sort_unstable();
    wait_for_films(&mut app, 3);
    let films = |app: &App, root: Entity| {
        let mut films = app.world().get::<CoatingFilms>(root).map(|own| own.films().to_vec()).unwrap_or_default();
        films.sort_unstable();
        films
    };
    assert_eq!((films(&app, plate_entity), films(&app, root)), (vec![plate_entity], leaves.to_vec()));
    // A clone has films of its own, and only these.
    let clone = app.world_mut().entity_mut(plate_entity).clone_and_spawn();
    update(&mut app, 3);
    assert_eq!((films(&app, plate_entity), films(&app, clone)), (vec![plate_entity], vec![clone]));
    app.world_mut().entity_mut(leaves[0]).despawn();
    update(&mut app, 2);
    assert_eq!(films(&app, root), [leaves[1]]);
    app.world_mut().entity_mut(root).remove::<Coating>();
    app.world_mut().entity_mut(plate_entity).despawn();
    update(&mut app, 2);
    assert!(app.world().get::<CoatingFilms>(root).is_none());
    assert_eq!(films(&app, clone), [clone]);
}

#[test]
fn ratings_are_told_as_they_are_reached() {
    let mut app = app();
    let plate = spawn_plate(&mut app, 16, quick_coating());
    wait_for_films(&mut app, 1);
    let mut told: Vec<RatingReached> = Vec::new();
    for _ in 0..12 {
        take_steps(&mut app, 10);
        told.extend(messages::<RatingReached>(&mut app));
    }
    assert!(told.iter().all(|reached| (reached.entity, reached.root) == (plate, plate)));
    assert!(told.is_sorted_by(|a, b| a.age <= b.age));
    let worst = summary(&app, plate).ratings;
    let rust: Vec<&RatingReached> = told.iter().filter(|reached| matches!(reached.rating, Rating::Rust(_))).collect();
    assert_eq!(rust.last().map(|reached| reached.rating), Some(Rating::Rust(worst.rust)));
    assert!(rust.windows(2).all(|pair| pair[0].rating == pair[1].before), "{rust:?}");
    for kind in [|r: &Rating| matches!(r, Rating::Flaking(_)), |r: &Rating| matches!(r, Rating::Cracking(_))] {
        assert!(told.iter().any(|reached| kind(&reached.rating)), "{told:?}");
    }
    // In one frame the same is told, with ages of their own.
    let mut other = crate::common::app();
    let again = spawn_plate(&mut other, 16, quick_coating());
    wait_for_films(&mut other, 1);
    take_steps(&mut other, 120);
    let at_once = messages::<RatingReached>(&mut other);
    let bare = |told: &[RatingReached]| told.iter().map(|reached| (reached.rating, reached.age)).collect::<Vec<_>>();
    assert_eq!(bare(&at_once), bare(&told));
    // A clone appears as it is.
    let clone = other.world_mut().entity_mut(again).clone_and_spawn();
    update(&mut other, 3);
    assert!(messages::<RatingReached>(&mut other).is_empty());
    assert_eq!(summary(&other, clone), summary(&other, again));
}

#[test]
fn places_are_found_in_the_world() {
    let mut app = app();
    let near = spawn_plate(&mut app, 8, quick_coating());
    let far = spawn_plate(&mut app, 8, quick_coating());
    // It stands two metres behind, twice as large, and faces +x.
    let turned = Quat::from_rotation_y(std::f32::consts::FRAC_PI_2);
    let place = Transform::from_xyz(0.0, 0.0, -2.0).with_rotation(turned).with_scale(Vec3::splat(2.0));
    app.world_mut().entity_mut(far).insert(place);
    wait_for_films(&mut app, 2);
    update(&mut app, 2);

    let point = place.transform_point(Vec3::new(0.25, 0.75, 0.01));
    let hit = at_point(&mut app, point, 1.0).expect("the plate");
    assert_eq!((hit.entity, hit.root, hit.point.surface), (far, far, FilmSurface::Paint));
    assert!((hit.point.distance - 0.02).abs() < 1e-4 && hit.point.normal.abs_diff_eq(Vec3::X, 1e-4), "{hit:?}");
    assert!(hit.point.position.abs_diff_eq(place.transform_point(Vec3::new(0.25, 0.75, 0.0)), 1e-3), "{hit:?}");
    assert_eq!(at_point(&mut app, point, 0.01), None);
    assert_eq!(at_point(&mut app, Vec3::splat(f32::NAN), 1.0), None);
    assert_eq!(at_point(&mut app, Vec3::new(0.5, 0.5, 0.3), 1.0).expect("a plate").entity, near);

    let hit = along_ray(&mut app, Vec3::new(0.5, 0.4, 3.0), Dir3::NEG_Z).expect("the near plate");
    assert!(hit.entity == near && (hit.point.distance - 3.0).abs() < 1e-4, "{hit:?}");
    let hit = along_ray(&mut app, Vec3::new(5.0, 0.4, -2.5), Dir3::NEG_X).expect("the far plate");
    assert!(hit.entity == far && (hit.point.distance - 5.0).abs() < 1e-4, "{hit:?}");
    assert_eq!(along_ray(&mut app, Vec3::new(5.0, 0.4, -2.5), Dir3::X), None);

    // What is knocked off shows the metal.
    let face = hit.point.face;
    app.world_mut().commands().entity(far).queue(FilmEdit::StripFace(face));
    app.world_mut().flush();
    let hit = along_ray(&mut app, Vec3::new(5.0, 0.4, -2.5), Dir3::NEG_X).expect("the metal");
    assert_eq!((hit.point.surface, hit.point.face), (FilmSurface::BareMetal, face));

    let area = in_sphere(&mut app, Vec3::ZERO, 20.0).expect("both");
    assert!((area.area - 5.0).abs() < 1e-3 && area.bare > 0.0, "{area:?}");
    assert_eq!(in_sphere(&mut app, Vec3::Y * 50.0, 1.0), None);
}

#[test]
fn places_are_in_units_of_the_world() {
    let mut app = app();
    // Centimetres.
    app.insert_resource(CoatingUnit { metres: 0.01 });
    let mesh = add_mesh(&mut app, plate(8).scaled_by(Vec3::splat(100.0)));
    let film = app.world_mut().spawn((Mesh3d(mesh), Transform::from_xyz(0.0, 0.0, 300.0), quick_coating())).id();
    wait_for_films(&mut app, 1);
    update(&mut app, 2);
    let hit = at_point(&mut app, Vec3::new(30.0, 40.0, 302.0), 10.0).expect("the plate");
    assert_eq!(hit.entity, film);
    assert!((hit.point.distance - 2.0).abs() < 1e-3, "{hit:?}");
    assert!(hit.point.position.abs_diff_eq(Vec3::new(30.0, 40.0, 300.0), 1e-2), "{hit:?}");
    let area = in_sphere(&mut app, Vec3::new(50.0, 50.0, 300.0), 20.0).expect("the plate");
    assert!((area.area - std::f64::consts::PI * 0.04).abs() < 0.01, "in square metres: {area:?}");
}
