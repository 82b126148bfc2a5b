//! One scale of cracks on props of any size.

use std::path::Path;

use bevy_coating::{
    bake::{BakeOptions, Carried, Images, Input, Model, NamePattern, Stopwatch, bake},
    remesh::FilmResolution,
    settings::{CoatingSettings, Rules, ScaleSettings},
};

const GRAIN: f32 = 0.03;
/// Length of the film's edges, in grains.
const EDGE: f32 = 0.7;

/// Files of props, and their scales: areas are 0.8 to 5.4 square metres.
const PROPS: [(&str, f32); 5] =
    [("firehydrant", 2.5), ("dumpster", 1.0), ("car", 1.0), ("lantern", 1.0), ("dumpster", 2.5)];

/// Area in square metres that is aged of each: small props with as many seeds as it takes, so that chance, by which
/// cracks start, has the same share in all figures.
const AREA: f64 = 7.0;

fn model(name: &str, scale: f32) -> Model {
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("assets/props/prop_{name}.glb"));
    let mut model = Input::File(file).read(0, Images::Skip).expect("a prop");
    model.carried = Carried::default();
    model.meshes.retain(|mesh| !NamePattern::new("*wheel*").matches(&mesh.name));
    for mesh in &mut model.meshes {
        mesh.surface.positions.iter_mut().for_each(|p| *p *= scale);
        mesh.place = None;
    }
    model
}

/// Distance between cracks at age 1, in metres.
fn spacing(name: &str, size: f32, rules: Rules, triangles: impl Fn(f64) -> f64) -> f64 {
    let scale = ScaleSettings { rules, grain: GRAIN };
    let mut settings = CoatingSettings { scale, ..CoatingSettings::default() };
    // How far flakes curl is not looked at.
    settings.deform.sweeps_per_age = 0.0;
    let model = model(name, size);
    let area: f64 = model.meshes.iter().map(|mesh| mesh.surface.area()).sum();
    let cracks_per_length = |seed| {
        let resolution = FilmResolution::Triangles(triangles(area) as u32);
        let settings = settings.clone();
        let options = BakeOptions { resolution, settings, steps: 400, seed, ..BakeOptions::default() };
        let stats = bake(model.clone(), &options, Stopwatch::start(), &()).expect("an aged prop").stats();
        stats.timeline.last().and_then(|last| last.crack_spacing).map_or(0.0, |spacing| 1.0 / spacing)
    };
    let seeds = (AREA / area).ceil() as u64;
    seeds as f64 / (0..seeds).map(cracks_per_length).sum::<f64>()
}

/// Spacings on all props, and how many times the smallest the largest is.
fn spacings(rules: Rules, triangles: impl Fn(f64) -> f64 + Copy) -> (Vec<f64>, f64) {
    let all: Vec<f64> = PROPS.iter().map(|&(name, scale)| spacing(name, scale, rules, triangles)).collect();
    let (least, most) = all.iter().fold((f64::MAX, 0.0f64), |(least, most), x| (least.min(*x), most.max(*x)));
    println!("{rules:?}: {all:.3?} m");
    (all, most / least)
}

#[test]
fn one_grain_gives_one_distance_between_cracks_on_props_of_any_size() {
    let edge = f64::from(GRAIN * EDGE);
    let (by_grain, ratio) = spacings(Rules::Grain, |area| area / (3f64.sqrt() / 4.0 * edge * edge));
    assert!(ratio < 1.6, "{by_grain:?}");
    let mean = by_grain.iter().sum::<f64>() / by_grain.len() as f64 / f64::from(GRAIN);
    assert!((2.0..6.0).contains(&mean), "{mean} grains");
}

#[test]
fn as_many_triangles_on_props_of_any_size_give_as_many_distances() {
    let (by_triangles, ratio) = spacings(Rules::Paper, |_| 4000.0);
    assert!(ratio > 2.0, "{by_triangles:?}");
}
