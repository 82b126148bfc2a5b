use super::{colors::viridis, *};
use crate::{
    film::VertexId,
    remesh::sample,
    settings::{CoatingSettings, Preset},
    sim::FilmState,
    stain::Environment,
};

fn plate(preset: Preset) -> (FilmState, CoatingSettings) {
    let settings = CoatingSettings::from(preset);
    let piece = sample::plate(2000, 3).expect("a plate");
    (FilmState::new(&piece.film, &settings, 5, 1000).expect("a manifold"), settings)
}

fn parts<'a>(film: &'a FilmState, settings: &'a CoatingSettings) -> HeatFilm<'a> {
    HeatFilm { mesh: &film.mesh, forces: &film.forces, stains: &film.stains, settings }
}

fn values_of(map: HeatMap, film: &FilmState, settings: &CoatingSettings) -> Vec<f32> {
    let mut values = HeatValues::default();
    values.update(map, parts(film, settings));
    assert_eq!(values.corners().len(), film.mesh.topology.half_edge_count());
    values.corners().to_vec()
}

/// Values at vertices, by the first corner that has one.
fn at_vertices(map: HeatMap, film: &FilmState, settings: &CoatingSettings) -> Vec<f32> {
    let mut at = vec![f32::NAN; film.mesh.topology.vertex_count()];
    for (value, h) in values_of(map, film, settings).into_iter().zip(film.mesh.topology.all_half_edges()) {
        at[film.mesh.topology.origin(h).index()] = value;
    }
    at
}

/// The film, values of it, and whether each of its vertices that held then has separated a little later.
fn before_and_after(map: HeatMap) -> Vec<(f32, bool)> {
    let (mut film, settings) = plate(Preset::Default);
    let still = Environment::default();
    film.age_to(0.25, &settings, &still);
    let before = at_vertices(map, &film, &settings);
    let held: Vec<bool> = film.mesh.topology.all_vertices().map(|v| film.forces.is_attached(v)).collect();
    film.age_to(0.30, &settings, &still);
    let after = |i: usize| !film.forces.is_attached(VertexId::new(i));
    (0..held.len()).filter(|&i| held[i]).map(|i| (before[i], after(i))).collect()
}

#[test]
fn places_that_separate_next_have_the_lowest_margins() {
    let found = before_and_after(HeatMap::Adhesion);
    let mut margins: Vec<f32> = found.iter().map(|&(margin, _)| margin).collect();
    margins.sort_unstable_by(f32::total_cmp);
    let gone: Vec<f32> = found.iter().filter(|(_, gone)| *gone).map(|&(margin, _)| margin).collect();
    println!("{} of {} separate", gone.len(), found.len());
    assert!(gone.len() > 20, "{}", gone.len());
    // Both sides of the balance move at about one rate everywhere, so those that let go are the first in order.
    let limit = margins[(gone.len() * 3 / 2).min(margins.len() - 1)];
    let among = gone.iter().filter(|&&margin| margin <= limit).count();
    assert!(among * 100 >= gone.len() * 95, "{among} of {} are among the lowest", gone.len());
}

#[test]
fn ages_until_separation_come_true() {
    let found = before_and_after(HeatMap::Separation);
    assert!(found.iter().all(|&(age, _)| age >= 0.0));
    let late = found.iter().filter(|&&(age, gone)| gone && age > 0.052).count();
    assert_eq!(late, 0, "a tear can only put a separation off");
    let due = found.iter().filter(|&&(age, _)| age < 0.049).count();
    let came = found.iter().filter(|&&(age, gone)| gone && age < 0.049).count();
    println!("{came} of {due} came off when they were said to");
    assert!(due > 20 && came * 10 >= due * 9, "{came} of {due}");
}

#[test]
fn faces_with_weak_edges_have_the_lowest_binding_margins() {
    let (mut film, settings) = plate(Preset::Default);
    let fresh = values_of(HeatMap::Binding, &film, &settings);
    let weak = fresh.iter().filter(|&&margin| margin < 0.0).count();
    let sound = fresh.iter().filter(|&&margin| (margin - 4.0).abs() < 1e-4).count();
    assert_eq!(weak + sound, fresh.len(), "binding 6 less the pull of two faces, or a defect");
    assert!(weak > 0 && weak * 10 < fresh.len(), "{weak} of {}", fresh.len());
    film.age_to(1.0, &settings, &Environment::default());
    let aged = values_of(HeatMap::Binding, &film, &settings);
    let torn = film.mesh.topology.all_faces().filter(|&f| !film.mesh.topology.is_live(f)).count();
    assert!(aged.iter().filter(|margin| margin.is_nan()).count() >= 3 * torn);
}

#[test]
fn strain_is_nothing_at_rest_and_something_in_curls() {
    let (mut film, settings) = plate(Preset::Heavy);
    assert!(values_of(HeatMap::Strain, &film, &settings).iter().all(|&strain| strain < 1e-6));
    film.age_to(0.5, &settings, &Environment::default());
    let strains = values_of(HeatMap::Strain, &film, &settings);
    let most = strains.iter().copied().filter(|strain| strain.is_finite()).fold(0.0, f32::max);
    let measured = film.measure().strain_max.expect("constraints") as f32;
    assert!((most - measured).abs() < 1e-4, "{most} {measured}");
}

#[test]
fn every_piece_has_one_value_and_no_other_has_it() {
    let (mut film, settings) = plate(Preset::Harsh);
    film.age_to(0.8, &settings, &Environment::default());
    let values = values_of(HeatMap::Pieces, &film, &settings);
    let topology = &film.mesh.topology;
    for h in topology.all_half_edges().filter(|h| topology.is_live(h.face())) {
        if let Some(twin) = topology.bound_twin(h) {
            assert_eq!(values[h.index()], values[twin.index()], "joined faces");
        }
    }
    let mut pieces: Vec<u32> = values.iter().filter(|v| !v.is_nan()).map(|v| v.to_bits()).collect();
    pieces.sort_unstable();
    pieces.dedup();
    assert_eq!(pieces.len() as u64, film.measure().pieces);
}

#[test]
fn sources_and_rain_are_those_of_the_stains() {
    let (mut film, settings) = plate(Preset::Default);
    assert!(values_of(HeatMap::Rain, &film, &settings).iter().all(|&rain| rain == 1.0), "nothing shelters it");
    film.stains.exposure.rain = (0..film.mesh.topology.original_vertex_count()).map(|i| (i % 2) as f32).collect();
    film.age_to(0.6, &settings, &Environment::default());
    let rain = at_vertices(HeatMap::Rain, &film, &settings);
    let is_right = |(i, rain): (usize, &f32)| {
        rain.is_nan() || *rain == (film.mesh.topology.original(VertexId::new(i)).0 % 2) as f32
    };
    assert!(rain.iter().enumerate().all(is_right), "duplicates have that of their originals");
    let sources = at_vertices(HeatMap::Sources, &film, &settings);
    assert!(sources.contains(&1.0) && sources.contains(&0.0));
}

#[test]
fn places_without_a_value_are_grey() {
    for map in HeatMap::ALL {
        let [r, g, b] = map.color(f32::NAN, map.range());
        assert!(r == g && g == b, "{map}");
        for value in [f32::NEG_INFINITY, -1.0, 0.0, 0.3, 7.0, f32::INFINITY] {
            for range in [map.range(), HeatRange { min: 1.0, max: 1.0 }, HeatRange { min: f32::NAN, max: 0.0 }] {
                let color = map.color(value, range);
                assert!(color.iter().all(|c| (0.0..=1.0).contains(c)), "{map} {value} {range:?}: {color:?}");
            }
        }
    }
}

#[test]
fn the_colours_are_perceptually_even() {
    // Lightness L* of CIELAB, by the luminance of linear sRGB.
    let lightness = |share: f32| {
        let [r, g, b] = viridis(share)
            .map(|c| if c <= 0.04045 { c / 12.92 } else { bevy_math::ops::powf((c + 0.055) / 1.055, 2.4) });
        116.0 * bevy_math::ops::powf(0.2126 * r + 0.7152 * g + 0.0722 * b, 1.0 / 3.0) - 16.0
    };
    let steps: Vec<f32> = (0..9).map(|i| lightness((i + 1) as f32 / 9.0) - lightness(i as f32 / 9.0)).collect();
    let mean = steps.iter().sum::<f32>() / 9.0;
    println!("{:.1} to {:.1}, steps of {steps:.1?}", lightness(0.0), lightness(1.0));
    assert!(steps.iter().all(|step| (0.7 * mean..1.3 * mean).contains(step)), "{steps:?}");
}

#[test]
fn legends_rise_and_have_different_texts() {
    for map in HeatMap::ALL {
        for range in [map.range(), HeatRange { min: -0.3, max: 0.05 }, HeatRange { min: 0.0, max: 1000.0 }] {
            let ticks = map.legend(range);
            for pair in ticks.windows(2) {
                assert!(pair[0].share < pair[1].share && pair[0].text != pair[1].text, "{map}: {pair:?}");
            }
        }
    }
}
