//! The prop's own surface as plain arrays of triangles, and the cleaning that makes an oriented manifold of it (VC
//! 3.3).
//!
//! ```text
//! Surface --clean--> CleanSurface
//! ```
//!
//! An oriented manifold is a surface on which every edge has one face, or two that run along it in opposite directions,
//! and the faces of every vertex form one fan.

mod clean;
mod error;
mod prop_surface;
mod warning;

pub use clean::{CleanSurface, clean, twins};
pub(crate) use clean::{clean_in_pieces, twins_in_pieces};
pub use error::BuildError;
pub use prop_surface::{Surface, SurfaceSite};
pub use warning::BuildWarning;
