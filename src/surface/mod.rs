//! The prop's own surface: plain arrays of triangles, and how they become an oriented manifold (VC 3.3).
//!
//! ```text
//! Surface --clean--> CleanSurface
//! ```

mod clean;
mod error;
mod prop_surface;
mod warning;

pub use clean::{CleanSurface, clean, twins};
pub use error::BuildError;
pub use prop_surface::{Surface, SurfaceSite};
pub use warning::BuildWarning;
