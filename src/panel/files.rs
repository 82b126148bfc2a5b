//! Loads and saves settings files.

use std::{io, path::Path, string::FromUtf8Error};

use crate::{
    files::{
        self, folder_of,
        temporary::{self, Temporary},
    },
    settings::{CoatingSettings, SettingsError},
};

/// Ending of the names of settings files.
const ENDING: &str = ".coating.ron";

/// Reason why a settings file could not be loaded or saved.
#[derive(Debug, thiserror::Error)]
pub(super) enum FileError {
    #[error("`{file}` is no settings file: give it a name that ends in `.coating.ron`")]
    Name { file: String },
    #[error("could not read {file}: {source}")]
    Read { file: String, source: io::Error },
    #[error("{file} is not UTF-8 text: {source}")]
    NotText { file: String, source: FromUtf8Error },
    #[error(transparent)]
    Settings(#[from] SettingsError),
    #[error("could not write {file}: {source}; choose a folder that is there and may be written to")]
    Write { file: String, source: io::Error },
    #[error("the settings cannot be written as RON: {0}")]
    Ron(#[from] ron::Error),
}

/// Reads a settings file.
///
/// # Errors
/// [`FileError`] that says what is wrong with the file, and where.
pub(super) fn load(file: &str) -> Result<CoatingSettings, FileError> {
    check(file)?;
    let bytes = files::read(Path::new(file)).map_err(|source| FileError::Read { file: file.to_owned(), source })?;
    let text = String::from_utf8(bytes).map_err(|source| FileError::NotText { file: file.to_owned(), source })?;
    Ok(CoatingSettings::from_ron(&text, file)?)
}

/// Writes a settings file, whole or not at all.
///
/// # Errors
/// [`FileError`].
pub(super) fn save(file: &str, settings: &CoatingSettings) -> Result<(), FileError> {
    check(file)?;
    let text = ron::ser::to_string_pretty(settings, ron::ser::PrettyConfig::default())?;
    let (path, fail) = (Path::new(file), |source| FileError::Write { file: file.to_owned(), source });
    let mut written = Temporary::write(folder_of(path), ".coating-", text.as_bytes()).map_err(fail)?;
    written.persist(&mut temporary::list(), path).map_err(fail)
}

fn check(file: &str) -> Result<(), FileError> {
    let name = Path::new(file).file_name().and_then(|name| name.to_str()).unwrap_or_default();
    let is_right = name.strip_suffix(ENDING).is_some_and(|stem| !stem.is_empty());
    if is_right { Ok(()) } else { Err(FileError::Name { file: file.to_owned() }) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::settings::Preset;

    #[test]
    fn settings_that_are_saved_are_those_that_are_loaded() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("hull.coating.ron");
        let file = file.to_str().expect("a path");
        let mut settings = CoatingSettings::from(Preset::Harsh);
        settings.tearing.alpha = 0.123_456_7;
        save(file, &settings).expect("it can be written");
        assert_eq!(load(file).expect("it can be read"), settings);
    }

    #[test]
    fn files_that_are_none_are_refused_with_a_reason() {
        let folder = tempfile::tempdir().expect("a folder");
        for name in ["", "hull.ron", ".coating.ron", "/", "hull.coating.ron/"] {
            let said = save(name, &CoatingSettings::default()).map_err(|error| error.to_string());
            assert!(said.is_err_and(|said| said.contains(".coating.ron") || said.contains("write")), "{name}");
        }
        let missing = folder.path().join("none/hull.coating.ron");
        let missing = missing.to_str().expect("a path");
        assert!(matches!(load(missing), Err(FileError::Read { .. })));
        assert!(matches!(save(missing, &CoatingSettings::default()), Err(FileError::Write { .. })));
        let bad = folder.path().join("bad.coating.ron");
        std::fs::write(&bad, "(tearing: (beta: 7.0))").expect("a file");
        let said = load(bad.to_str().expect("a path")).expect_err("out of range").to_string();
        assert!(said.contains("bad.coating.ron:1:") && said.contains("tearing.beta"), "{said}");
    }
}
