//! Pictures of props whose stains are those of the simulation. Needs a graphics adapter, be it a software renderer.

use bevy::prelude::*;
use bevy_coating::{
    film::{FilmMesh, HalfEdgeId, VertexId},
    fracture::FilmForces,
    prelude::*,
};

use crate::{
    common::{add_mesh, plate, quick_coating, update_until},
    stained::save,
    studio::{Picture, Studio},
};

/// Distance of the camera from the plates, a metre wide, that stand about the origin.
const EYE: f32 = 1.8;

fn spawn_white(studio: &mut Studio, n: u32, coating: Coating) -> Entity {
    let app = &mut studio.app;
    let mesh = add_mesh(app, plate(n));
    let white = StandardMaterial { base_color: Color::srgb(0.85, 0.86, 0.88), perceptual_roughness: 0.5, ..default() };
    let white = app.world_mut().resource_mut::<Assets<StandardMaterial>>().add(white);
    let place = Transform::from_xyz(-0.5, -0.5, 0.0);
    let film = app.world_mut().spawn((Mesh3d(mesh), MeshMaterial3d(white), place, coating)).id();
    update_until(app, |app| app.world().resource::<CoatingStatus>().films == 1);
    film
}

fn age_to(studio: &mut Studio, age: f64) {
    let mut clock = studio.app.world_mut().resource_mut::<CoatingClock>();
    clock.target_age = Some(age);
    clock.request_steps(10_000);
    update_until(&mut studio.app, |app| app.world().resource::<CoatingStatus>().youngest >= age - 1e-9);
}

fn is_rusty([red, green, blue, _]: [u8; 4]) -> bool {
    let [red, green, blue] = [red, green, blue].map(f32::from);
    red > 1.2 * green && green > 1.1 * blue
}

fn rusty_share(picture: &Picture) -> f64 {
    let backdrop = picture.pixels[0];
    let prop: Vec<_> = picture.pixels.iter().filter(|&&pixel| pixel != backdrop).collect();
    prop.iter().filter(|&&&pixel| is_rusty(pixel)).count() as f64 / prop.len() as f64
}

#[test]
fn there_is_no_rust_on_fresh_paint_and_more_and_more_later() {
    let Some(mut studio) = Studio::open(400, 300, ".") else { return };
    spawn_white(&mut studio, 24, quick_coating().with_seed(2));
    let mut last = -1.0;
    for age in [0.0, 0.5, 0.8, 1.1] {
        age_to(&mut studio, age);
        let picture = studio.shoot(Vec3::Z * EYE, Vec3::ZERO);
        save(&picture, &format!("age_{age}"));
        let share = rusty_share(&picture);
        println!("age {age}: {:.1} % are rusty", share * 100.0);
        assert!(share > last + 0.005, "{share} after {last}");
        assert!(age > 0.0 || share == 0.0, "{share} at age 0");
        last = share;
    }
    assert!(last > 0.05, "{last}");
    assert_eq!(studio.broken_pipelines(), Vec::<String>::new());
}

/// A coating that separates at once, and neither tears nor moves nor gathers dust by itself.
fn held() -> Coating {
    let mut settings = CoatingSettings::from(Preset::Paper);
    settings.adhesion.mean = 0.0;
    settings.adhesion.deviation = 0.0;
    settings.tearing.binding = 1e6;
    settings.tearing.weak_probability = 0.0;
    settings.tearing.contraction_growth = 0.0;
    settings.deform.sweeps_per_age = 0.0;
    settings.dust.rate = 0.0;
    Coating::new(settings).with_resolution(FilmResolution::Keep).with_steps_per_age(200)
}

/// Weakens a chain of edges between two places of the plate, so that it tears in the next step.
fn crack(app: &mut App, film: Entity, ends: [Vec3; 2]) {
    let mut entity = app.world_mut().entity_mut(film);
    let mesh = entity.get::<FilmMesh>().expect("a film").clone();
    let mut forces = entity.get_mut::<FilmForces>().expect("forces");
    let rest = |v: VertexId| mesh.geometry.rest_positions[v.index()];
    let nearest = |place: Vec3| {
        let closer = |a: &VertexId, b: &VertexId| rest(*a).distance(place).total_cmp(&rest(*b).distance(place));
        mesh.topology.all_vertices().min_by(closer).expect("vertices")
    };
    let [mut v, end] = ends.map(nearest);
    while v != end {
        let around = mesh.topology.fan(v).flat_map(|h| [Some(h), mesh.topology.bound_twin(h.previous())]).flatten();
        let to_end = |h: &HalfEdgeId| rest(mesh.topology.target(*h)).distance(rest(end));
        let h = around.min_by(|a, b| to_end(a).total_cmp(&to_end(b))).expect("edges");
        forces.set_binding(&mesh.topology, h, 0.0);
        v = mesh.topology.target(h);
    }
}

#[test]
fn rust_runs_down_from_a_lone_crack_whichever_way_down_is() {
    let Some(mut studio) = Studio::open(400, 300, ".") else { return };
    for (name, down) in [("down", Vec3::NEG_Y), ("left", Vec3::NEG_X)] {
        studio.app.insert_resource(CoatingGravity(down));
        let film = spawn_white(&mut studio, 24, held());
        crack(&mut studio.app, film, [Vec3::new(0.4, 0.4, 0.0), Vec3::new(0.6, 0.6, 0.0)]);
        age_to(&mut studio, 0.6);
        let picture = studio.shoot(Vec3::Z * EYE, Vec3::ZERO);
        save(&picture, &format!("crack_{name}"));
        let rusty = |side: f32| {
            let there = |&(p, _, pixel): &(Vec3, f32, [u8; 4])| side * p.dot(down) > 0.0 && is_rusty(pixel);
            picture.places(EYE).filter(there).count()
        };
        // The crack runs through the middle, half of it on either side, so that its own width counts for both.
        let (below, above) = (rusty(1.0), rusty(-1.0));
        println!("{name}: {below} below, {above} above");
        assert!(below > 500 && below >= 5 * above, "{name}: {below} below, {above} above");
        studio.app.world_mut().entity_mut(film).despawn();
        studio.app.update();
    }
}
