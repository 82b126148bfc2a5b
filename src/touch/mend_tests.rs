//! New paint over torn and missing film: mended in place it comes to what it does where the film is put together again.

use std::collections::BTreeSet;

use bevy_math::Vec3;
use proptest::prelude::*;

use super::{Effect, Site, Touch, fields::faces_to_renew, reach::Reach};
use crate::{
    film::{FaceId, HalfEdgeId, Topology, VertexId},
    remesh::sample,
    settings::{CoatingSettings, Rules},
    sim::{FilmState, FreshFilm, edit::Renewed},
    stain::Environment,
};

/// Rain, so that rust runs and moisture lies on the film.
const ENVIRONMENT: Environment = Environment {
    gravity: Vec3::NEG_Y,
    wind: Vec3::ZERO,
    gusts: 0.0,
    rain: Vec3::new(0.0, -0.3, 0.0),
    sun: Vec3::ZERO,
};

fn ruin(triangles: u32, age: f64, seed: u64, rules: Rules) -> (FilmState, CoatingSettings) {
    let mut settings = CoatingSettings::default();
    settings.scale.rules = rules;
    let piece = sample::plate(triangles, seed).unwrap();
    let mut film = FilmState::new(&piece.film, &settings, seed, 60).unwrap();
    film.age_to(age, &settings, &ENVIRONMENT);
    (film, settings)
}

fn faces_of(film: &FilmState, touch: &Touch) -> Vec<bool> {
    let reach = Reach::new(&film.mesh, touch.site, touch.radius);
    faces_to_renew(&film.mesh.topology, touch, &reach)
}

/// Compares a film that was mended with the same film put together again, by corners: vertices have other numbers.
fn compare(mended: &FilmState, whole: &FilmState, is_new: &[bool]) -> Result<(), TestCaseError> {
    let (a, b) = (&mended.mesh.topology, &whole.mesh.topology);
    prop_assert_eq!(mended.validate(), Ok(()));
    prop_assert_eq!(whole.validate(), Ok(()));
    // Where two fans of new paint meet in a point, either may hold there. And where nothing is new, another fan may get
    // the original vertex as the film is put together, so that older paint lets go there; a mend leaves it as it is.
    let differs = |h: HalfEdgeId| {
        let place = a.original(a.origin(h));
        let at_original = |t: &Topology| t.origin(h) == place;
        at_original(a) != at_original(b)
            && mended.forces.is_attached(a.origin(h)) != whole.forces.is_attached(b.origin(h))
    };
    let mut odd = vec![false; a.original_vertex_count()];
    for h in a.all_half_edges().filter(|h| a.is_live(h.face()) && differs(*h)) {
        odd[a.original(a.origin(h)).index()] = true;
    }
    let odd_places = odd.iter().filter(|odd| **odd).count();
    for (place, _) in odd.iter().enumerate().filter(|(_, odd)| **odd) {
        let fresh = a.all_half_edges().filter(|h| is_new[h.face().index()]).map(|h| a.origin(h));
        let fresh: BTreeSet<VertexId> = fresh.filter(|&v| a.original(v).index() == place).collect();
        prop_assert!(fresh.len() != 1, "one fan of new paint holds at {place}");
    }
    let is_odd = |h: HalfEdgeId| odd[a.original(a.origin(h)).index()];
    for f in a.all_faces() {
        prop_assert_eq!(a.fate(f), b.fate(f));
        prop_assert_eq!(mended.forces.contraction(f), whole.forces.contraction(f));
    }
    for h in a.all_half_edges().filter(|h| a.is_live(h.face())) {
        prop_assert_eq!(a.is_torn(h), b.is_torn(h));
        prop_assert_eq!(mended.forces.binding(a, h), whole.forces.binding(b, h));
        let (v, w) = (a.origin(h), b.origin(h));
        let (i, j) = (v.index(), w.index());
        prop_assert_eq!(mended.mesh.geometry.positions[i], whole.mesh.geometry.positions[j]);
        prop_assert_eq!(mended.forces.adhesion(v), whole.forces.adhesion(w));
        prop_assert_eq!(mended.forces.tips[i], whole.forces.tips[j]);
        let layers = |film: &FilmState, i: usize| {
            let layer = &film.stains.film;
            [layer.wet[i], layer.stained[i], layer.dust[i], layer.moisture[i], layer.areas[i]]
        };
        prop_assert_eq!(layers(mended, i), layers(whole, j));
        prop_assert_eq!(mended.stains.sources[i], whole.stains.sources[j]);
        if is_odd(h) || is_odd(h.next()) || is_odd(h.previous()) {
            continue;
        }
        prop_assert_eq!(mended.forces.separated_age[i], whole.forces.separated_age[j]);
        let length = |film: &FilmState| film.constraints.length_of(&film.mesh, h).is_some();
        prop_assert_eq!(length(mended), length(whole));
        let beyond = a.bound_twin(h).is_some_and(|twin| is_odd(twin.previous()));
        let target = |film: &FilmState| film.constraints.bend_of(&film.mesh, h).map(|bend| bend.target);
        if !beyond {
            prop_assert_eq!(target(mended), target(whole));
        }
    }
    prop_assert_eq!(mended.forces.torn_edges, whole.forces.torn_edges);
    if odd_places == 0 {
        prop_assert_eq!(mended.forces.separations, whole.forces.separations);
        prop_assert_eq!(mended.forces.loose.len(), whole.forces.loose.len());
    }
    let (a, b) = (&mended.stains, &whole.stains);
    prop_assert_eq!(&a.metal, &b.metal);
    prop_assert_eq!(&a.corrosion, &b.corrosion);
    prop_assert_eq!(&a.open_metal(), &b.open_metal());
    prop_assert_eq!(&a.crack_lengths(), &b.crack_lengths());
    prop_assert!((a.budget.dripped - b.budget.dripped).abs() <= 1e-5 * a.budget.emitted.max(1.0));
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]
    #[test]
    fn a_ruin_is_mended_to_what_it_is_put_together_to(
        seed in 0u64..1_000,
        age in 0.2f64..1.1,
        by_grain in any::<bool>(),
        strokes in prop::collection::vec((0u32..900, 0.02f32..0.3, 0u8..6, 0u8..4), 1..6),
    ) {
        let (mut film, settings) = ruin(900, age, seed, if by_grain { Rules::Grain } else { Rules::Paper });
        for (face, radius, steps, damage) in strokes {
            let site = Site::new(FaceId(face.min(film.mesh.topology.face_count() as u32 - 1)), Vec3::ONE);
            let damage = [None, Some(Effect::Hit(40.0)), Some(Effect::Strip), None][usize::from(damage)];
            if let Some(damage) = damage {
                film.touch(&Touch::new(site, 0.5 * radius, damage), &settings, &ENVIRONMENT).unwrap();
            }
            let touch = Touch::new(site, radius, Effect::Repaint);
            let is_new = faces_of(&film, &touch);
            let mut whole = film.clone();
            whole.parts().renew_whole(&settings, &ENVIRONMENT, is_new.clone());
            prop_assert_eq!(film.parts().mend(&settings, &ENVIRONMENT, is_new.clone()), Renewed::Mended);
            compare(&film, &whole, &is_new)?;
            // Saved and restored, it goes on with the same bits.
            let mut fresh = FreshFilm::new(film.mesh.at_rest().unwrap());
            let saved = fresh.write(&mut film).unwrap();
            let mut again = fresh.read(&saved, true).unwrap();
            prop_assert_eq!(again.digest(), film.digest());
            for _ in 0..steps {
                film.step(&settings, &ENVIRONMENT);
                again.step(&settings, &ENVIRONMENT);
                prop_assert_eq!(again.digest(), film.digest());
                prop_assert_eq!(film.validate(), Ok(()));
            }
        }
    }
}

#[test]
fn strokes_over_a_ruin_do_not_let_it_grow_without_end() {
    let (mut film, settings) = ruin(900, 0.6, 7, Rules::Grain);
    let originals = film.mesh.topology.original_vertex_count();
    let (mut mended, mut whole) = (0, 0);
    for i in 0..400u32 {
        let faces = film.mesh.topology.face_count() as u32;
        let site = Site::new(FaceId(i * 37 % faces), Vec3::ONE);
        film.touch(&Touch::new(site, 0.06, Effect::Hit(40.0)), &settings, &ENVIRONMENT).unwrap();
        let before = film.mesh.topology.vertex_count();
        if film.touch(&Touch::new(site, 0.12, Effect::Repaint), &settings, &ENVIRONMENT).unwrap() {
            let is_whole = film.mesh.topology.vertex_count() < before;
            *(if is_whole { &mut whole } else { &mut mended }) += 1;
        }
        let duplicates = film.mesh.topology.vertex_count() - originals;
        let most = film.mesh.topology.half_edge_count() * 2 / 3;
        assert!(duplicates <= most, "{duplicates} of {originals}");
    }
    assert_eq!(film.validate(), Ok(()));
    assert!(mended > 200 && whole >= 1 && mended > 10 * whole, "{mended} {whole}");
}
