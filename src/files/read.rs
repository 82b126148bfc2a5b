//! Reads files that a user names.

#[cfg(feature = "bake")]
use std::path::{Component, PathBuf};
use std::{fs, io, path::Path};

/// Reads a whole file. Pipes and devices are refused: to read them may take for ever.
///
/// # Errors
/// The error of the operating system, or one that says that the path names no regular file.
pub fn read(path: &Path) -> io::Result<Vec<u8>> {
    let data = fs::metadata(path)?;
    if data.is_dir() {
        return Err(io::Error::new(io::ErrorKind::IsADirectory, "it is a folder"));
    }
    if !data.is_file() {
        return Err(io::Error::new(io::ErrorKind::InvalidInput, "it is no regular file but a pipe or a device"));
    }
    fs::read(path)
}

/// Returns a relative path, which may lead out of its folder; `None` for other paths: these are places on another
/// machine.
#[cfg(feature = "bake")]
pub fn relative(path: &str) -> Option<PathBuf> {
    let path = Path::new(path);
    let is_relative = path.components().all(|part| !matches!(part, Component::Prefix(_) | Component::RootDir));
    is_relative.then(|| path.into())
}
