//! Remembers when the settings file was written.

use std::{path::Path, time::SystemTime};

/// File at which somebody looked, and when it had been written.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Seen {
    file: String,
    written: SystemTime,
}

impl Seen {
    /// Looks at a file; `None` if it is not there, or the system does not tell when it was written.
    pub fn look(file: &str) -> Option<Self> {
        let written = std::fs::metadata(Path::new(file)).and_then(|data| data.modified()).ok()?;
        Some(Self { file: file.to_owned(), written })
    }

    /// Returns whether this is the same file, but written at another time.
    pub fn is_later_than(&self, before: &Self) -> bool {
        self.file == before.file && self.written != before.written
    }
}
