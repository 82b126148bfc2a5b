//! Custom properties of models that say how they are painted: glTF `extras`, as Blender writes them.
//!
//! A property `coating` with the name of a preset coats an object; others change the settings, the seed or the age to
//! begin with. `coating-bake` and the plugin (feature `gltf`) read the same.
//!
//! | property | value | what it says |
//! |---|---|---|
//! | `coating` | name of a preset, or a boolean | its paint; `true`: by default; `false` or `"none"`: none |
//! | `coating.STAGE.NAME` | a number, or a name | one setting, such as `coating.adhesion.mean` |
//! | `coating_seed` | whole number, 0 or more | seed of all that is random |
//! | `coating_start_age` | 0 to 10 | age with which it appears in a game |
//!
//! ```
//! use bevy_coating::extras::PropExtras;
//!
//! let json = r#"{ "coating": "harsh", "coating.adhesion.mean": 1.8, "coating_seed": 7, "mass": 3 }"#;
//! let extras = PropExtras::read(json)?;
//! let Some(PropExtras::Coat(coating)) = extras else { panic!("a coating") };
//! assert_eq!((coating.settings.adhesion.mean, coating.seed), (1.8, Some(7)));
//!
//! assert_eq!(PropExtras::read(r#"{ "mass": 3 }"#)?, None);
//! assert_eq!(PropExtras::read(r#"{ "coating": false }"#)?, Some(PropExtras::Exclude));
//! let error = PropExtras::read(r#"{ "coating": "hrash" }"#).unwrap_err().to_string();
//! assert!(error.starts_with("custom property `coating`: there is no preset `hrash`; there are "));
//! # Ok::<(), bevy_coating::extras::ExtrasError>(())
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

mod error;
mod limits;
mod read;
#[cfg(test)]
mod tests;

pub use error::ExtrasError;
pub use limits::MOST_START_AGE;
pub use read::{PropCoating, PropExtras};
