//! Keeps figures of every prop over its age.

use std::{collections::BTreeMap, sync::Arc};

use bevy::ecs::{
    change_detection::{DetectChanges, Ref},
    entity::Entity,
    query::With,
    resource::Resource,
    system::{Query, ResMut},
};

use crate::{
    api::{coating::Coating, links::CoatedBy},
    film::FilmMesh,
    fracture::FilmForces,
    sim::FilmClock,
    stain::StainFields,
};

/// Number of samples in a unit of age.
const PER_AGE: f64 = 200.0;

/// Figures of a prop at one age.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Sample {
    /// Age, in samples.
    bin: u32,
    /// Share of the film that has come off the metal, by vertices.
    pub separated: f32,
    /// Share of the film that is gone, by faces.
    pub gone: f32,
    /// Number of edges that have torn.
    pub cracks: f32,
    /// Rust that sources have given off, in layers times square metres.
    pub rust: f32,
}

impl Sample {
    /// Returns the age of the sample.
    pub fn age(&self) -> f64 {
        f64::from(self.bin) / PER_AGE
    }
}

/// Figures of all props, each by rising age. The samples beyond a prop's age are those of a future that it has had.
#[derive(Resource, Debug, Default)]
pub(super) struct Statistics(BTreeMap<Entity, Arc<Vec<Sample>>>);

impl Statistics {
    /// Returns the figures of the prop with the coating on `root`.
    pub fn of(&self, root: Entity) -> Arc<Vec<Sample>> {
        self.0.get(&root).cloned().unwrap_or_default()
    }

    fn add(&mut self, root: Entity, sample: Sample) {
        let samples = Arc::make_mut(self.0.entry(root).or_default());
        match samples.binary_search_by_key(&sample.bin, |sample| sample.bin) {
            Ok(at) => {
                if let Some(old) = samples.get_mut(at) {
                    *old = sample;
                }
            }
            Err(at) => samples.insert(at, sample),
        }
    }
}

/// Sums over the films of a prop.
#[derive(Clone, Copy, Debug, Default)]
struct Sum {
    age: f64,
    vertices: u64,
    separated: u64,
    faces: u64,
    gone: u64,
    cracks: u64,
    rust: f64,
}

impl Sum {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "an age from 0 on, of a million at most"
    )]
    fn sample(&self) -> Sample {
        let share = |part: u64, whole: u64| part as f32 / whole.max(1) as f32;
        Sample {
            bin: (self.age.clamp(0.0, 1e6) * PER_AGE).round() as u32,
            separated: share(self.separated, self.vertices),
            gone: share(self.gone, self.faces),
            cracks: self.cracks as f32,
            rust: self.rust as f32,
        }
    }
}

/// Parts of a film that figures come from.
type Counted<'a> = (&'a CoatedBy, Ref<'a, FilmClock>, &'a FilmMesh, &'a FilmForces, &'a StainFields);

/// Adds the figures of props whose films have aged. Each takes the same time whatever the size of the film.
pub(super) fn record(mut statistics: ResMut<Statistics>, films: Query<Counted>, props: Query<(), With<Coating>>) {
    if !films.iter().any(|(_, clock, ..)| clock.is_changed()) {
        return;
    }
    let mut sums: BTreeMap<Entity, (Sum, bool)> = BTreeMap::new();
    for (coated_by, clock, mesh, forces, stains) in &films {
        let (sum, changed) = sums.entry(coated_by.0).or_default();
        *changed |= clock.is_changed();
        let topology = &mesh.topology;
        sum.age = sum.age.max(clock.age());
        sum.vertices += topology.original_vertex_count() as u64;
        sum.separated += u64::from(forces.separations);
        sum.faces += topology.face_count() as u64;
        sum.gone += topology.removed_face_count() as u64;
        sum.cracks += u64::from(forces.torn_edges);
        sum.rust += stains.budget.emitted;
    }
    for (root, (sum, changed)) in sums {
        if changed {
            statistics.add(root, sum.sample());
        }
    }
    statistics.0.retain(|&root, _| props.contains(root));
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn samples_are_kept_by_age_and_a_second_past_replaces_the_first() {
        let mut statistics = Statistics::default();
        let root = Entity::from_raw_u32(3).expect("an entity");
        let at = |age, cracks| Sum { age, cracks, vertices: 10, separated: 5, ..Sum::default() }.sample();
        for (age, cracks) in [(0.1, 1), (0.3, 3), (0.2, 2), (0.3, 7), (0.3001, 8)] {
            statistics.add(root, at(age, cracks));
        }
        let samples = statistics.of(root);
        assert_eq!(samples.iter().map(|sample| sample.cracks).collect::<Vec<_>>(), [1.0, 2.0, 8.0]);
        assert!(samples.iter().all(|sample| sample.separated == 0.5 && sample.gone == 0.0));
        assert!((samples[1].age() - 0.2).abs() < 1e-9);
    }
}
