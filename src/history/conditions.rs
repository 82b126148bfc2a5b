//! Conditions under which a film takes its steps.

use super::event::Event;
use crate::{settings::CoatingSettings, sim::FilmState, stain::Environment};

/// Inputs of the next step.
#[derive(Clone, Debug, PartialEq)]
pub struct Conditions {
    pub settings: CoatingSettings,
    pub environment: Environment,
}

impl Conditions {
    /// Takes over what `event` changes of these conditions. Returns whether it changed anything.
    pub fn follow(&mut self, event: &Event) -> bool {
        match event {
            Event::Settings(new) => replace(&mut self.settings, new),
            Event::Environment(new) => replace(&mut self.environment, new),
            _ => false,
        }
    }

    /// Lets `event` act on `film` or on these conditions. Returns whether it changed anything; if not, all is as it
    /// was.
    pub fn apply(&mut self, film: &mut FilmState, event: &Event) -> bool {
        let Self { settings, environment } = self;
        let FilmState { mesh, forces, .. } = film;
        match event {
            Event::Settings(_) | Event::Environment(_) => self.follow(event),
            Event::Quality(new) => replace(&mut film.quality, new),
            Event::Exposure(new) => {
                // Entries beyond the original vertices mean nothing, and keyframes do not hold them.
                let mut new = new.clone();
                new.rain.truncate(mesh.topology.original_vertex_count());
                new.sun.truncate(mesh.topology.original_vertex_count());
                replace(&mut film.stains.exposure, &new)
            }
            Event::TearEdge(h) => film.tear_edge(*h, settings, environment),
            Event::StripFace(f) => film.strip_face(*f, settings, environment),
            Event::Adhesion(v, force) => {
                let is_there = v.index() < mesh.topology.vertex_count();
                is_there.then(|| forces.set_adhesion(*v, *force)).is_some()
            }
            Event::Contraction(f, force) => {
                let is_there = f.index() < mesh.topology.face_count();
                is_there.then(|| forces.set_contraction(&mesh.topology, *f, *force)).is_some()
            }
            Event::Binding(h, force) => {
                let is_there = h.index() < mesh.topology.half_edge_count();
                is_there.then(|| forces.set_binding(&mesh.topology, *h, *force)).is_some()
            }
            Event::Touch(touch, _) => film.touch(touch, settings, environment).is_ok(),
        }
    }
}

fn replace<T: Clone + PartialEq>(old: &mut T, new: &T) -> bool {
    let changes = old != new;
    if changes {
        old.clone_from(new);
    }
    changes
}
