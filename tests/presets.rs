//! What the presets of real paints make of a plate and of a hydrant, in figures. Needs no engine:
//! `cargo core --test presets -- --nocapture` prints them.

use std::thread;

use bevy_coating::{
    bake::{BakeOptions, Images, Input, coat},
    settings::{CoatingSettings, Preset},
    sim::FilmState,
    stain::Environment,
};

const SEEDS: std::ops::Range<u64> = 1..4;

/// What is aged, and the metres that a unit of it is long: a hydrant is nearly a metre high.
const PROPS: [(&str, f32); 2] = [("plate:6000", 1.0), ("assets/props/prop_firehydrant.glb", 4.0)];

/// Figures of a prop at age 1, means over seeds, but for the spacing: all of the area over all of the cracks.
#[derive(Clone, Copy, Debug, Default)]
struct Figures {
    /// Mean distance between cracks, in metres.
    spacing: f64,
    /// Share of the paint that has come off the metal.
    separated: f64,
    /// Share of the paint that has fallen.
    gone: f64,
    /// Height over the metal that nine tenths of what came off do not reach, in metres.
    lift: f64,
    /// Corrosion of the metal, mean over its area.
    rust: f64,
    /// Rust that has run off over the paint, in layers, mean over the area.
    run_off: f64,
    /// Dust, mean over the vertices.
    dust: f64,
}

impl Figures {
    fn of(films: &[FilmState]) -> Self {
        let measures = FilmState::measure_all(films);
        let area: f64 = films.iter().map(|film| f64::from(film.mesh.geometry.rest_area)).sum();
        let rusted = |film: &FilmState| {
            let places = film.stains.metal.areas.iter().zip(&film.stains.corrosion);
            places.map(|(&area, &corrosion)| f64::from(area * corrosion)).sum::<f64>()
        };
        Self {
            spacing: measures.crack_spacing.map_or(0.0, f64::recip),
            separated: measures.separated.unwrap_or_default(),
            gone: measures.stripped.unwrap_or_default() + measures.fallen.unwrap_or_default(),
            lift: measures.lift_area_p90_m.unwrap_or_default(),
            rust: films.iter().map(rusted).sum::<f64>() / area,
            run_off: (measures.rust_stained + measures.rust_wet) / area,
            dust: measures.dust_mean.unwrap_or_default(),
        }
    }

    fn mean(all: &[Self]) -> Self {
        let mean = |of: fn(&Self) -> f64| all.iter().map(of).sum::<f64>() / all.len() as f64;
        Self {
            spacing: mean(|f| f.spacing).recip(),
            separated: mean(|f| f.separated),
            gone: mean(|f| f.gone),
            lift: mean(|f| f.lift),
            rust: mean(|f| f.rust),
            run_off: mean(|f| f.run_off),
            dust: mean(|f| f.dust),
        }
    }
}

fn figures(preset: Preset, (input, metres_per_unit): (&str, f32)) -> Figures {
    let settings = CoatingSettings::from(preset);
    let of_seed = |seed| {
        let model = Input::parse(input.as_ref()).expect("an input").read(seed, Images::Skip).expect("a model");
        let options =
            BakeOptions { settings: settings.clone(), metres_per_unit, seed, steps: 500, ..BakeOptions::default() };
        let mut films = coat(input, model.meshes, &options).expect("films").films;
        films.iter_mut().for_each(|film| film.age_to(1.0, &settings, &Environment::default()));
        Figures::of(&films)
    };
    Figures::mean(&SEEDS.map(of_seed).collect::<Vec<_>>())
}

/// What makes a preset what it is, beside the default paint.
fn character(preset: Preset, own: Figures, usual: Figures) -> Vec<(&'static str, bool)> {
    match preset {
        Preset::ChalkyWhitewash => vec![
            ("it lies flat", own.lift < 0.4 * usual.lift),
            ("it breaks into small pieces", own.spacing < 0.7 * usual.spacing),
            ("much of it crumbles away", own.gone > 1.2 * usual.gone),
        ],
        Preset::DesertSun => vec![
            ("its cracks are a fine net", own.spacing < 0.6 * usual.spacing),
            ("its scales are small", own.lift < 0.6 * usual.lift),
            ("metal hardly rusts", own.rust < 0.25 * usual.rust),
            ("sand gathers", own.dust > 1.3 * usual.dust),
        ],
        Preset::FreshEnamel => vec![
            ("its cracks are few", own.spacing > 4.0 * usual.spacing),
            ("hardly a chip is gone", own.gone < 0.03),
            ("metal hardly rusts", own.rust < 0.2 * usual.rust),
            ("it is clean", own.dust < 0.5 * usual.dust),
        ],
        Preset::Marine => vec![
            ("metal rusts fast", own.rust > 1.7 * usual.rust),
            ("much rust runs off", own.run_off > 4.0 * usual.run_off),
        ],
        Preset::OldLeadPaint => vec![
            ("its flakes stand up", own.lift > 1.8 * usual.lift),
            ("its flakes are large", own.spacing > 1.2 * usual.spacing),
            ("its flakes hang on", own.gone < 0.9 * usual.gone && own.separated > 0.7),
        ],
        Preset::PowderCoat => vec![
            ("it hardly cracks", own.spacing > 3.0 * usual.spacing),
            ("it comes off over wide areas", own.separated > 0.65),
            ("its sheets hang on", own.gone < 0.6 * usual.gone),
        ],
        _ => Vec::new(),
    }
}

#[test]
fn every_paint_is_what_its_line_says() {
    let all: Vec<(Preset, [Figures; 2])> = thread::scope(|scope| {
        let runs = Preset::ALL.map(|preset| (preset, scope.spawn(move || PROPS.map(|prop| figures(preset, prop)))));
        runs.into_iter().map(|(preset, run)| (preset, run.join().expect("figures"))).collect()
    });
    let (_, usual) = all.iter().find(|(preset, _)| *preset == Preset::Default).expect("the default");
    let mut wrong = Vec::new();
    for (preset, own) in &all {
        for ((own, usual), (prop, _)) in own.iter().zip(usual).zip(PROPS) {
            println!(
                "{preset} on {prop}: spacing {:.0} mm, off {:.2}, gone {:.2}, lift {:.1} mm, rust {:.2}, run-off \
                 {:.3}, dust {:.2}",
                1e3 * own.spacing,
                own.separated,
                own.gone,
                1e3 * own.lift,
                own.rust,
                own.run_off,
                own.dust
            );
            let failed = character(*preset, *own, *usual).into_iter().filter(|(_, holds)| !holds);
            wrong.extend(failed.map(|(what, _)| format!("{preset} on {prop}: not so that {what}: {own:?}, {usual:?}")));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}
