//! Connected pieces of the film, and which of them hang in the air.
//!
//! [`FilmPieces`] follows every tear and separation, so that a step in which nothing comes loose need not look at the
//! film. [`LoosePieces`] is the list of what came loose; its [`find`](LoosePieces::find) floods the whole film and
//! is the reference for the former.

mod find;
mod flood;
mod loose;
#[cfg(test)]
mod tests;
mod track;

pub use flood::PieceScratch;
pub use loose::{LoosePiece, LoosePieces};
pub use track::FilmPieces;
