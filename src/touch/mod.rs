//! Touches: what an artist's brush or a game does to a film while it runs.
//!
//! A [`Touch`] is a round dab on the surface: a place ([`Site`]), a radius in metres, and an [`Effect`]. Its radius is
//! measured along the surface, so a dab on one side of a thin sheet does not reach through to the other. [`touch`] does
//! it, between two steps. A stroke is a row of touches.
//!
//! Touches are [events](crate::history::Event::Touch) of a film's history: they are replayed, saved and sent with it,
//! in a few bytes each.
//!
//! ```
//! use bevy_coating::{
//!     film::FaceId,
//!     remesh::sample,
//!     settings::CoatingSettings,
//!     sim::FilmState,
//!     stain::Environment,
//!     touch::{Change, Effect, Site, Touch, touch},
//! };
//! use bevy_math::Vec3;
//!
//! let (settings, environment) = (CoatingSettings::default(), Environment::default());
//! let piece = sample::plate(1_000, 7)?;
//! let mut film = FilmState::new(&piece.film, &settings, 7, 100).ok_or("a plate is a manifold")?;
//! let site = Site::new(FaceId(500), Vec3::splat(1.0 / 3.0));
//!
//! // Paint that holds ten times as well in a circle of 30 cm.
//! let protect = Touch::new(site, 0.3, Effect::Adhesion(Change::Multiply(10.0)));
//! touch(film.parts(), &settings, &environment, &protect)?;
//! film.age_to(1.0, &settings, &environment);
//! let [a, ..] = film.mesh.topology.corners(site.face);
//! assert!(film.forces.is_attached(film.mesh.topology.original(a)), "what was protected holds");
//!
//! // A blow chips the paint off all the same, and a painter mends it.
//! touch(film.parts(), &settings, &environment, &Touch::new(site, 0.05, Effect::Strip))?;
//! assert!(!film.mesh.topology.is_live(site.face));
//! touch(film.parts(), &settings, &environment, &Touch::new(site, 0.3, Effect::Repaint))?;
//! assert!(film.mesh.topology.is_live(site.face));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod apply;
mod effect;
mod fields;
mod outline;
mod reach;
mod route;
mod site;

#[cfg(test)]
mod mend_tests;
#[cfg(test)]
mod tests;

pub use apply::{Touched, touch};
pub use effect::{Change, Effect, MOST_CHANGE, MOST_RADIUS, Touch, TouchError};
pub use outline::outline;
pub use site::Site;
