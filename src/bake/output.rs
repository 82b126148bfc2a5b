//! Writes files whole or not at all.

use std::{
    fs::{self, File},
    io::{self, Write},
    path::{Path, PathBuf},
};

use tempfile::NamedTempFile;

use super::error::BakeError;

/// Finished files that wait beside their places until all of them are written. Dropped without
/// [`commit`](Self::commit), they leave nothing behind.
///
/// ```
/// use bevy_coating::bake::StagedFiles;
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// # let temporary = tempfile::tempdir()?;
/// # let folder = temporary.path();
/// let mut files = StagedFiles::default();
/// files.add(folder.join("aged.glb"), b"glTF ...")?;
/// files.add(folder.join("aged.json"), b"{}")?;
/// assert!(!folder.join("aged.glb").exists());
/// files.commit()?;
/// assert!(folder.join("aged.glb").exists() && folder.join("aged.json").exists());
///
/// assert!(StagedFiles::check(&folder.join("no_such_folder/aged.glb")).is_err());
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Default)]
pub struct StagedFiles(Vec<Waiting>);

#[derive(Debug)]
enum Waiting {
    /// To be renamed.
    File(NamedTempFile, PathBuf),
    /// A device or pipe, such as /dev/stdout, is written to in place.
    Device(Vec<u8>, PathBuf),
}

impl StagedFiles {
    /// Checks early, before hours of work, that a file could be put at `path`.
    ///
    /// # Errors
    /// [`BakeError::Write`] if the path names a folder or no file, or its folder does not exist.
    pub fn check(path: &Path) -> Result<(), BakeError> {
        let error = |kind, cause: &str| {
            let source = io::Error::new(kind, cause);
            Err(BakeError::Write { path: path.into(), source })
        };
        if path.is_dir() {
            return error(io::ErrorKind::IsADirectory, "it is a folder");
        }
        if path.file_name().is_none() {
            return error(io::ErrorKind::InvalidInput, "it names no file");
        }
        if !folder_of(path).is_dir() {
            return error(io::ErrorKind::NotFound, "its folder does not exist; create it first");
        }
        Ok(())
    }

    /// Writes `bytes` to a temporary file beside `path`. Bytes for a device or pipe, such as `/dev/stdout`, wait in
    /// memory.
    ///
    /// # Errors
    /// [`BakeError::Write`] if the temporary file cannot be written.
    pub fn add(&mut self, path: impl AsRef<Path>, bytes: &[u8]) -> Result<(), BakeError> {
        let path = path.as_ref();
        Self::check(path)?;
        let waiting = if is_device(path) {
            Waiting::Device(bytes.to_vec(), path.into())
        } else {
            let file = write_beside(path, bytes).map_err(|source| BakeError::Write { path: path.into(), source })?;
            Waiting::File(file, path.into())
        };
        self.0.push(waiting);
        Ok(())
    }

    /// Puts all files in place, in the order in which they were added.
    ///
    /// # Errors
    /// [`BakeError::Write`]; files before the one that failed are in place then.
    pub fn commit(self) -> Result<(), BakeError> {
        for waiting in self.0 {
            let (result, path) = match waiting {
                Waiting::File(file, path) => (file.persist(&path).map(drop).map_err(|e| e.error), path),
                Waiting::Device(bytes, path) => (write_through(&path, &bytes), path),
            };
            result.map_err(|source| BakeError::Write { path, source })?;
        }
        Ok(())
    }
}

fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

fn is_device(path: &Path) -> bool {
    fs::metadata(path).is_ok_and(|data| !data.is_file() && !data.is_dir())
}

fn write_through(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file = File::options().write(true).open(path)?;
    file.write_all(bytes)?;
    file.flush()
}

fn write_beside(path: &Path, bytes: &[u8]) -> io::Result<NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    builder.prefix(".bake-");
    // Temporary files are private by default; these are to become ordinary ones.
    #[cfg(unix)]
    let permissions = std::os::unix::fs::PermissionsExt::from_mode(0o666);
    #[cfg(unix)]
    builder.permissions(permissions);
    let mut file = builder.tempfile_in(folder_of(path))?;
    file.write_all(bytes)?;
    file.flush()?;
    file.as_file().sync_all()?;
    Ok(file)
}
