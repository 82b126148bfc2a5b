//! Answers questions about films: what lies at a place, how much has rusted or flaked off, and how that is rated.
//!
//! A [`FilmView`] borrows the parts of a film and answers where they are: [`nearest`](FilmView::nearest),
//! [`along_ray`](FilmView::along_ray) and [`in_sphere`](FilmView::in_sphere). [`FilmShares`] are the figures of a whole
//! film, which a [`FilmSurvey`] keeps up to date; [`Ratings`] are what inspectors of coatings call such figures, and
//! [`Until`] says how far to age a film in their words.
//!
//! ```
//! use bevy_coating::{
//!     remesh::sample,
//!     settings::{CoatingSettings, Preset},
//!     sim::FilmState,
//!     stain::Environment,
//!     survey::{FilmSurface, Ratings, RustGrade, Until},
//! };
//! use bevy_math::Vec3;
//!
//! let (settings, environment) = (CoatingSettings::from(Preset::Heavy), Environment::default());
//! let piece = sample::plate(400, 7)?;
//! let mut film = FilmState::new(&piece.film, &settings, 7, 200).expect("a plate is a manifold");
//! let above = film.view().along_ray(Vec3::Z, Vec3::NEG_Z, 10.0).expect("the plate is in the way");
//! assert_eq!((above.surface, above.attached), (FilmSurface::Paint, true));
//!
//! let age = film.age_until(&Until::rating(RustGrade::Ri2), 10.0, &settings, &environment).expect("it rusts");
//! assert!(age > 0.0 && Ratings::from(&film.shares()).rust >= RustGrade::Ri2);
//! # Ok::<(), bevy_coating::surface::BuildError>(())
//! ```

mod area;
mod covers;
mod crack_sums;
mod film_survey;
mod gone_sums;
mod nearest;
mod point;
mod ratings;
mod ray;
mod shares;
mod sides;
mod sphere;
mod triangle;
mod until;
mod view;

pub use area::FilmArea;
pub use film_survey::FilmSurvey;
pub use point::{FilmPoint, FilmSurface};
pub use ratings::{
    all::{Rating, Ratings},
    astm_rust::AstmRust,
    cracking::CrackingGrade,
    error::RatingError,
    flaking::FlakingGrade,
    rust_grade::RustGrade,
};
pub use shares::{FilmShares, Share};
pub use until::{Until, UntilError, UntilWatch};
pub use view::FilmView;

#[cfg(test)]
mod plain;
#[cfg(test)]
mod tests;
