//! Time of a touch on a film of 10,000 triangles, and of the rim that is drawn for the brush.
//!
//! `cargo bench --profile dev --bench touch`

use bevy_coating::{
    film::FaceId,
    remesh::sample,
    settings::CoatingSettings,
    sim::FilmState,
    stain::Environment,
    touch::{Change, Effect, Site, Touch, outline},
};
use bevy_math::Vec3;

fn main() {
    divan::main();
}

/// A plate of a metre at an age at which a part of it has come off.
fn film() -> FilmState {
    let piece = sample::plate(10_000, 7).expect("a plate");
    let mut film = FilmState::new(&piece.film, &CoatingSettings::default(), 7, 200).expect("a manifold");
    film.age_to(0.6, &CoatingSettings::default(), &Environment::default());
    film
}

fn bench(bencher: divan::Bencher, effect: Effect, radius: f32) {
    bench_on(bencher, film(), Touch::new(Site::new(FaceId(5_000), Vec3::ONE), radius, effect));
}

fn bench_on(bencher: divan::Bencher, film: FilmState, touch: Touch) {
    let (settings, environment) = (CoatingSettings::default(), Environment::default());
    bencher.with_inputs(|| film.clone()).bench_local_values(|mut film| {
        film.touch(&touch, &settings, &environment).expect("a touch");
        film
    });
}

#[divan::bench(args = [0.05, 0.1, 0.2])]
fn weaken(bencher: divan::Bencher, radius: f32) {
    bench(bencher, Effect::Adhesion(Change::Multiply(0.5)), radius);
}

#[divan::bench(args = [0.05, 0.1, 0.2])]
fn wash(bencher: divan::Bencher, radius: f32) {
    bench(bencher, Effect::Wash(1.0), radius);
}

#[divan::bench(args = [0.05, 0.1])]
fn hit(bencher: divan::Bencher, radius: f32) {
    bench(bencher, Effect::Hit(9.0), radius);
}

#[divan::bench(args = [0.05, 0.1])]
fn strip(bencher: divan::Bencher, radius: f32) {
    bench(bencher, Effect::Strip, radius);
}

/// Paints over paint that is new already, as all but the front of a stroke does.
#[divan::bench(args = [0.05, 0.1, 0.2])]
fn repaint_again(bencher: divan::Bencher, radius: f32) {
    let (settings, environment) = (CoatingSettings::default(), Environment::default());
    let site = Site::new(FaceId(5_000), Vec3::ONE);
    let mut film = film();
    film.touch(&Touch::new(site, 2.0 * radius, Effect::Repaint), &settings, &environment).expect("a touch");
    bench_on(bencher, film, Touch::new(site, radius, Effect::Repaint));
}

/// Paints over paint of which a part has let go, but that has not torn.
#[divan::bench(args = [0.1])]
fn repaint_loose(bencher: divan::Bencher, radius: f32) {
    bench(bencher, Effect::Repaint, radius);
}

/// Paints over the ends of a crack, and over all.
#[divan::bench(args = [0.05, 0.1, 0.2, 2.0])]
fn repaint_torn(bencher: divan::Bencher, radius: f32) {
    let film = film();
    let topology = &film.mesh.topology;
    let torn = topology.all_faces().skip(5_000).find(|&f| topology.is_live(f) && topology.has_torn_edge(f));
    let site = Site::new(torn.expect("a crack"), Vec3::ONE);
    bench_on(bencher, film, Touch::new(site, radius, Effect::Repaint));
}

#[divan::bench]
fn scratch(bencher: divan::Bencher) {
    bench(bencher, Effect::Scratch(Site::new(FaceId(7_000), Vec3::ONE)), 0.1);
}

#[divan::bench(args = [0.05, 0.1, 0.2])]
fn rim(bencher: divan::Bencher, radius: f32) {
    let film = film();
    bencher.bench_local(|| outline(&film.mesh, Site::new(FaceId(5_000), Vec3::ONE), radius));
}
