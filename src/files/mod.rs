//! Reads and writes files. Whatever is written is there whole or not at all: it goes to a temporary file beside its
//! place, which then takes that place.

#![cfg_attr(
    not(test),
    deny(
        clippy::indexing_slicing,
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "what is read here comes from outside"
    )
)]

mod read;
pub(crate) mod temporary;

use std::path::Path;

pub(crate) use read::read;
#[cfg(feature = "bake")]
pub(crate) use read::relative;

/// Returns the folder of a file.
pub(crate) fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}
