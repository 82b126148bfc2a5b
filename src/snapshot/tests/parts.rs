//! Compares films part by part.

use crate::{film::words::Words, sim::FilmState};

/// Returns the name of the first part in which two films differ, or `None` if later steps cannot tell them apart.
pub fn first_difference(a: &FilmState, b: &FilmState) -> Option<&'static str> {
    let bits = |values: &[f32]| values.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
    let words = |write: &dyn Fn(&FilmState, &mut Words)| {
        let [mut of_a, mut of_b] = [Words::default(), Words::default()];
        write(a, &mut of_a);
        write(b, &mut of_b);
        of_a == of_b
    };
    let (stains, other) = (&a.stains, &b.stains);
    let layer = |of: &FilmState, metal: bool| {
        let layer = if metal { &of.stains.metal } else { &of.stains.film };
        [&layer.wet, &layer.stained, &layer.dust, &layer.moisture, &layer.areas].map(|values| bits(values))
    };
    let parts = [
        ("clock", a.clock == b.clock),
        ("quality", a.quality == b.quality),
        ("topology", a.mesh.topology == b.mesh.topology),
        ("positions", words(&|film, to| to.vectors(&film.mesh.geometry.positions))),
        ("geometry", a.mesh.geometry == b.mesh.geometry),
        ("forces", words(&|film, to| film.forces.write_state(to))),
        ("loose pieces", a.forces.loose == b.forces.loose),
        ("forces, inner", a.forces == b.forces),
        ("constraints", words(&|film, to| film.constraints.write_state(to))),
        ("stains of the film", layer(a, false) == layer(b, false)),
        ("stains of the metal", layer(a, true) == layer(b, true)),
        ("corrosion", bits(&stains.corrosion) == bits(&other.corrosion)),
        ("sources", stains.sources == other.sources),
        ("rust budget", stains.budget == other.budget),
        ("exposure", stains.exposure == other.exposure),
        ("streaks", stains.streaks == other.streaks),
        ("stains, inner", words(&|film, to| film.stains.write_state(to))),
        ("digest", a.digest() == b.digest()),
    ];
    parts.into_iter().find(|(_, same)| !same).map(|(name, _)| name)
}
