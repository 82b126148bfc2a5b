//! What is expected of the random app: the age of every film, and which films there are.

use std::{
    collections::{BTreeMap, BTreeSet},
    time::Duration,
};

use bevy::prelude::*;
use bevy_coating::{CoatingPart, FilmPace, film::FilmMesh, prelude::*};

use super::props::{self, ClonedAt, Shape};
use crate::common::*;

/// Expected state of the app.
#[derive(Default)]
pub struct Oracle {
    films: BTreeMap<Entity, Expected>,
    /// Coatings whose films may be built again, since something happened to them.
    rebuilding: BTreeSet<Entity>,
    /// Coatings whose films go to another age when all of them are ready.
    wishes: BTreeSet<Entity>,
    /// Last reason for which something could not be coated, by root.
    pub refusals: BTreeMap<Entity, String>,
}

/// Expected age of a film.
#[derive(Clone, Copy, Debug)]
struct Expected {
    root: Entity,
    /// Steps that the clock and requests have given, with the fraction.
    steps: f64,
    /// Steps that it may take besides, as it is a clone of a film that was owed them.
    ahead: f64,
    /// Last valid rate of the coating.
    rate: f64,
    /// Whether the film owes steps because it waited for rays.
    waits: bool,
    /// Whether time passed for the film in this frame.
    runs: bool,
    /// Steps that this frame gave.
    gain: f64,
    /// Number of frames for which the film may still be on its way to another age.
    travels: u32,
    /// Steps that the film was owed at the end of the last frame.
    owed: f64,
}

impl Oracle {
    pub fn has_films(&self, root: Entity) -> bool {
        self.films.values().any(|film| film.root == root)
    }

    /// Returns the most steps that a clone which is made of a film of `root` in this frame, or was in the last, may be
    /// owed: what the original was before this frame, and what the frame gave.
    pub fn owed(&self, root: Entity) -> f64 {
        let films = self.films.values().filter(|film| film.root == root);
        films.map(|film| film.owed + film.gain).fold(0.0, f64::max)
    }

    /// Notes that the films of `root` may go to other ages, or wait until their past is kept.
    pub fn allow_travel(&mut self, root: Entity) {
        for film in self.films.values_mut().filter(|film| film.root == root) {
            film.travels = 4;
        }
    }

    /// Notes that the films of `root` go to another age, when all of them are ready.
    pub fn wish(&mut self, root: Entity) {
        self.wishes.insert(root);
    }

    pub fn allow_rebuilding(&mut self, root: Entity) {
        self.rebuilding.insert(root);
    }

    pub fn may_be_rebuilt(&self, root: Entity) -> bool {
        self.rebuilding.contains(&root)
    }

    /// Tells the steps that each film has taken, and those expected.
    pub fn describe(&self, app: &App) -> String {
        let film = |(&film, expected): (&Entity, &Expected)| {
            let clock = app.world().get::<FilmClock>(film)?;
            let root = expected.root;
            Some(format!("{film}/{root} {} of {:.2} + {:.2}; ", clock.steps, expected.steps, expected.ahead))
        };
        self.films.iter().filter_map(film).collect()
    }

    /// Adds the steps that every film should take in a frame of this length.
    pub fn expect(&mut self, app: &mut App, frame: Duration) {
        let world = app.world();
        let clock = world.resource::<CoatingClock>();
        let age = if clock.paused { 0.0 } else { clock.age_per_second * frame.as_secs_f64() };
        self.films.retain(|&film, _| world.get::<FilmMesh>(film).is_some());
        for (&film, expected) in &mut self.films {
            let Some(coating) = world.get::<Coating>(expected.root) else { continue };
            let film_clock = world.get::<FilmClock>(film).expect("a clock");
            if (0.0..=1000.0).contains(&coating.rate) {
                expected.rate = coating.rate;
            }
            if expected.travels > 0 {
                let taken = film_clock.steps as f64;
                expected.ahead = (expected.steps + expected.ahead - taken).max(0.0);
                expected.steps = taken;
            }
            let before = expected.steps;
            expected.runs = !coating.paused && age * expected.rate > 0.0;
            if !coating.paused {
                expected.steps += age * expected.rate * f64::from(film_clock.steps_per_age);
                expected.steps += clock.requested_steps as f64;
            }
            expected.gain = expected.steps - before;
            let is_back = clock.target_age.is_some_and(|age| film_clock.step_at(age) < film_clock.steps);
            if is_back && world.get::<CoatingHistory>(expected.root).is_some() {
                expected.travels = 4;
            }
            if let Some(target) = clock.target_age {
                // Neither does a film take steps beyond the target, nor is it owed any.
                let last = film_clock.step_at(target).max(film_clock.steps) as f64;
                expected.steps = expected.steps.min(last);
            }
        }
    }

    /// Compares the steps of all films with those expected, and notes films that came and went.
    pub fn compare(&mut self, app: &mut App) {
        let casting = app.world().resource::<CoatingStatus>().casting > 0;
        let waits = app.world().resource::<CoatingStatus>().waiting > 0;
        for root in self.wishes.clone() {
            self.allow_travel(root);
            if !waits && self.has_films(root) {
                self.wishes.remove(&root);
            }
        }
        let ready: Vec<FilmReady> = messages(app);
        for failed in messages::<FilmFailed>(app) {
            self.refusals.insert(failed.root, failed.error.to_string());
        }
        // A film that was built in this frame counts from now on.
        for film in &ready {
            self.films.remove(&film.entity);
            assert!(self.rebuilding.contains(&film.root), "{film:?}: nothing had happened to it");
        }
        self.films.retain(|&film, _| app.world().get::<FilmMesh>(film).is_some());
        for (film, expected) in &mut self.films {
            let steps = app.world().get::<FilmClock>(*film).expect("a clock").steps as f64;
            if expected.travels > 0 {
                let is_away = app.world().get::<FilmPace>(*film).is_some_and(FilmPace::is_travelling);
                // It may take what this frame gave, and what it was owed before, when it has arrived. Time stands still
                // for it on the way.
                expected.ahead += if is_away { 0.0 } else { expected.gain };
                (expected.steps, expected.waits) = (steps, false);
                expected.travels -= u32::from(!is_away);
                continue;
            }
            let most = expected.steps + expected.ahead;
            assert!(steps <= most + 1.001, "film {film} took {steps} steps: {expected:?}");
            let behind = steps < expected.steps - 1.001;
            expected.waits |= behind && casting;
            assert!(
                !behind || (expected.waits && (casting || !expected.runs)),
                "film {film} took {steps}: {expected:?}"
            );
            expected.waits &= behind;
        }
        self.find_films(app);
        for (&film, expected) in &mut self.films {
            let steps = app.world().get::<FilmClock>(film).expect("a clock").steps as f64;
            expected.owed = (expected.steps + expected.ahead - steps).max(0.0);
        }
        let parts: Vec<&ChildOf> =
            app.world_mut().query_filtered::<&ChildOf, With<CoatingPart>>().iter(app.world()).collect();
        for part in parts {
            assert!(film_of(app.world(), part.0).is_some(), "a part below {} has no film", part.0);
        }
    }

    /// Begins to count the steps of films that are new.
    fn find_films(&mut self, app: &mut App) {
        let mut films = app.world_mut().query_filtered::<(Entity, &CoatedBy, &FilmClock), With<FilmMesh>>();
        for (film, &CoatedBy(root), clock) in films.iter(app.world()) {
            if self.films.contains_key(&film) {
                continue;
            }
            let cloned = app.world().get::<ClonedAt>(root);
            if let Some(&ClonedAt { of, steps: Some(steps), .. }) = cloned.filter(|_| film == root) {
                // The original may have gone back in the frame in which its clone was made.
                let original = app.world().get::<FilmClock>(of).map_or(0, |clock| clock.steps);
                assert!(clock.steps >= steps.min(original), "a clone is as old as its original");
            }
            // What the original was owed when it was asked for, or in the frame in which the clone was made.
            let ahead = cloned.map_or(0.0, |cloned| cloned.owed.max(self.owed(cloned.of)));
            let rate = app.world().get::<Coating>(root).map_or(0.0, |coating| coating.rate);
            let rate = if (0.0..=1000.0).contains(&rate) { rate } else { 1.0 };
            let root_entity = app.world().entity(root);
            let may_travel = root_entity.contains::<CoatingHistory>() || root_entity.contains::<CoatingSnapshot>();
            let travels = if may_travel || clock.sought().is_some() { 4 } else { 0 };
            let steps = clock.steps as f64;
            let (waits, runs, gain, owed) = (false, false, 0.0, 0.0);
            let expected = Expected { root, steps, ahead, rate, waits, runs, gain, travels, owed };
            self.films.insert(film, expected);
        }
    }

    /// Checks that no film is behind when nothing is under way. The clock must have been running.
    pub fn compare_at_rest(&mut self, app: &mut App) {
        self.compare(app);
        assert!(self.films.values().all(|film| !film.waits || !film.runs), "{:?}", self.films);
        self.rebuilding.clear();
    }

    /// Checks that each mesh of each prop shows a film of its own triangles, and that there are no other films.
    pub fn look_at_everything(&self, app: &mut App) {
        let roots = props::roots(app);
        let world = app.world();
        let mut films: BTreeMap<Entity, usize> = self.films.keys().map(|&film| (film, 0)).collect();
        let mut displays = BTreeSet::new();
        for root in roots {
            for entity in props::shapes(world, root) {
                let shape = world.get::<Shape>(entity).expect("a shape");
                let film = film_of(world, entity).unwrap_or_else(|| panic!("{entity} of {root} has no film"));
                assert_eq!(self.films.get(&film).map(|film| film.root), Some(root), "film {film} of {entity}");
                *films.entry(film).or_default() += shape.triangles;
                let shown = &world.get::<Mesh3d>(entity).expect("a mesh").0;
                assert_ne!(*shown, shape.mesh, "{entity} of {root} shows its own mesh");
                assert!(displays.insert(shown.id()), "two meshes show the film of {entity}");
                let mesh = world.resource::<Assets<Mesh>>().get(shown).expect("the mesh of a film");
                let positions =
                    mesh.attribute(Mesh::ATTRIBUTE_POSITION).and_then(|p| p.as_float3()).expect("positions");
                // Flakes curl away from their places, but in the mean the film is where its mesh is. Where all has
                // fallen, one triangle without area is drawn.
                let mean = positions.iter().map(|p| p[0]).sum::<f32>() / positions.len() as f32;
                let is_there = if shape.beside { mean > 1.25 } else { mean < 1.25 };
                let is_empty = positions.iter().all(|p| *p == [0.0; 3]);
                assert!(is_there || is_empty, "{entity} of {root}, beside: {}, shows {mean}", shape.beside);
            }
        }
        for (film, triangles) in films {
            assert!(triangles > 0, "film {film} is of no mesh: a ghost");
            let state = film_state(app, film);
            assert_eq!(state.validate(), Ok(()), "film {film}");
            // The film of a node keeps the faces of meshes that have left, hidden.
            let faces = state.mesh.topology.face_count();
            let may_hide = app.world().get::<Shape>(film).is_none();
            assert!(faces == triangles || (may_hide && faces > triangles), "film {film}: {faces} of {triangles}");
        }
    }
}

/// The film that the mesh of `entity` shows: its own, or that of the node above it.
fn film_of(world: &World, entity: Entity) -> Option<Entity> {
    world.get::<Shape>(entity)?;
    let node = world.get::<ChildOf>(entity).map(|child_of| child_of.0);
    [Some(entity), node].into_iter().flatten().find(|&film| world.get::<FilmMesh>(film).is_some())
}
