//! Heat maps of a film: what it is about to do, as values at the corners of its faces, with colours and a legend.
//!
//! | map | value | source |
//! |---|---|---|
//! | [`HeatMap::Adhesion`] | adhesion minus bending force: where the film is likely to come off | VC fig. 16 |
//! | [`HeatMap::Binding`] | binding minus pull at the weakest edge of a face: where it is likely to crack | VC 5.2 |
//! | [`HeatMap::Separation`] | age until a place separates | VC 5.1, in closed form |
//! | [`HeatMap::Strain`] | strain of the edges now against their lengths at rest | VC 4.2 |
//! | [`HeatMap::Pieces`] | connected pieces, a colour each | VC 5.3 |
//! | [`HeatMap::Sources`] | places where rust comes out, or came out | VC 6.1, fig. 9 |
//! | [`HeatMap::Rain`] | share of the rain that reaches a place | beyond the paper |
//!
//! ```
//! use bevy_coating::{
//!     heat::{HeatFilm, HeatMap, HeatValues},
//!     remesh::sample,
//!     settings::CoatingSettings,
//!     sim::FilmState,
//! };
//!
//! let (piece, settings) = (sample::plate(200, 1)?, CoatingSettings::default());
//! let film = FilmState::new(&piece.film, &settings, 0, 100).ok_or("an empty film")?;
//! let parts = HeatFilm { mesh: &film.mesh, forces: &film.forces, stains: &film.stains, settings: &settings };
//!
//! let (map, mut values) = (HeatMap::Adhesion, HeatValues::default());
//! values.update(map, parts);
//! assert_eq!(values.corners().len(), 3 * film.mesh.topology.face_count());
//! let color = map.color(values.corners()[0], map.range());
//! assert!(color.iter().all(|channel| (0.0..=1.0).contains(channel)));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod colors;
mod legend;
mod map;
mod range;
#[cfg(test)]
mod tests;
mod values;

pub use legend::Tick;
pub use map::{HeatMap, UnknownHeatMap};
pub use range::HeatRange;
pub use values::{HeatFilm, HeatValues};
