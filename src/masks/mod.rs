//! Masks: where paint is weak or dirty from the start, by textures, vertex colours, rules or functions.
//!
//! ```text
//! Mask --weights--> 0 to 1 at each vertex --MaskEffect--> MaskFactors --apply--> a fresh FilmState
//! ```
//!
//! A [`Mask`] says where, a [`MaskEffect`] what, and a [`CoatingMask`] is both. Masks are data: they are read from RON
//! ([`read_masks`]) and written to it, but for functions. [`apply_masks`] puts them on a film of age 0.
//!
//! ```
//! use bevy_coating::{
//!     masks::{MaskGround, MaskImages, apply_masks, read_masks},
//!     remesh::sample,
//!     settings::CoatingSettings,
//!     sim::FilmState,
//!     film::VertexId,
//! };
//! use bevy_math::Vec3;
//!
//! let text = "[(mask: Lower(full: 0.1, none: 0.3), effect: (adhesion: (1.0, 0.25), rust: (0.0, 0.5)))]";
//! let masks = read_masks(text, "hull.masks.ron")?;
//! let (piece, settings) = (sample::plate(400, 1)?, CoatingSettings::default());
//! let mut film = FilmState::new(&piece.film, &settings, 1, 100).ok_or("an empty film")?;
//! let images = MaskImages::new();
//! let ground =
//!     MaskGround { surface: &piece.surface, built: &piece.film, gravity: Vec3::NEG_Y, images: &images };
//! let fresh = film.clone();
//! apply_masks(&mut film, &masks, &ground)?;
//!
//! for v in film.mesh.topology.all_vertices() {
//!     let height = film.mesh.geometry.rest_positions[v.index()].y + 0.5;
//!     let (before, after) = (fresh.forces.adhesion(v), film.forces.adhesion(v));
//!     assert!(if height < 0.1 { after <= 0.26 * before } else { height < 0.3 || after == before });
//! }
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

#![cfg_attr(
    not(test),
    deny(
        clippy::indexing_slicing,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "what is read here comes from outside"
    )
)]

mod apply;
mod channel;
mod custom;
mod edges;
mod effect;
mod error;
mod ground;
mod image;
mod mask;
mod names;
mod noise;
mod presets;
mod read;
mod sites;
#[cfg(test)]
mod tests;
mod weights;

pub use apply::{MaskFactors, apply_masks};
pub use channel::{Channel, UvSet, Wrap};
pub use custom::CustomMask;
pub use effect::{CoatingMask, MaskEffect, Span};
pub use error::MaskError;
pub use ground::MaskGround;
pub use image::{MaskImage, MaskImages};
pub use mask::{Mask, TextureMask};
pub use read::read_masks;
