//! Connected pieces of the film, and the list of those that are loose: no longer attached anywhere.
//!
//! [`FilmPieces`] is updated after every tear and separation, so that a step in which nothing comes loose costs almost
//! nothing. [`LoosePieces`] is the list of loose pieces. [`LoosePieces::find`] searches the whole film instead, and
//! tests compare the two.

mod find;
mod flood;
mod loose;
mod mend;
#[cfg(test)]
mod tests;
mod track;

pub use flood::PieceScratch;
pub use loose::{LoosePiece, LoosePieces};
pub use track::FilmPieces;
