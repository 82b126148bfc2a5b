//! Writes files whole or not at all.

use std::{
    fs::{self, File},
    io::{self, Write},
    path::{Path, PathBuf},
};

use super::error::BakeError;
use crate::files::{
    folder_of,
    temporary::{self, Temporary},
};

/// Links are followed this far.
const MOST_LINKS: usize = 40;

/// Finished files that wait beside their places until all of them are written. Dropped without
/// [`commit`](Self::commit), they leave nothing behind.
///
/// ```
/// use bevy_coating::bake::StagedFiles;
///
/// # fn main() -> Result<(), Box<dyn std::error::Error>> {
/// # let temporary = tempfile::tempdir()?;
/// # let folder = temporary.path();
/// # std::fs::write(folder.join("prop.glb"), b"glTF ...")?;
/// let mut files = StagedFiles::default();
/// files.guard(folder.join("prop.glb"));
/// assert!(files.add(folder.join("prop.glb"), b"glTF ...").is_err());
///
/// files.add(folder.join("aged.glb"), b"glTF ...")?;
/// files.add(folder.join("aged.json"), b"{}")?;
/// assert!(files.add(folder.join("aged.json"), b"{}").is_err());
/// assert!(!folder.join("aged.glb").exists());
/// files.commit()?;
/// assert!(folder.join("aged.glb").exists() && folder.join("aged.json").exists());
///
/// assert!(StagedFiles::check(&folder.join("no_such_folder/aged.glb")).is_err());
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Default)]
pub struct StagedFiles {
    waiting: Vec<Waiting>,
    /// Files that must stay as they are.
    guarded: Vec<Named>,
    /// Places that are taken, and whether there is something for them yet.
    claimed: Vec<(Named, bool)>,
}

/// A path as it was given, and the file that it leads to.
#[derive(Debug)]
struct Named {
    path: PathBuf,
    file: PathBuf,
}

#[derive(Debug)]
enum Waiting {
    /// To be moved to its place; with the name for messages.
    File(Temporary, Named),
    /// A device or pipe, such as /dev/stdout, is written to in place.
    Device(Vec<u8>, PathBuf),
}

/// Kinds of places.
enum Place {
    /// A regular file, or none yet: where links end.
    File(PathBuf),
    Device,
}

impl StagedFiles {
    /// Checks early, before hours of work, that a file could be put at `path`.
    ///
    /// # Errors
    /// [`BakeError::Write`] if the path names a folder, no file or a pipe, or its folder does not exist.
    pub fn check(path: &Path) -> Result<(), BakeError> {
        place_of(path).map(drop)
    }

    /// Keeps a file from being written over: a model that was read, or something it refers to
    /// ([`Model::files`](super::Model::files)).
    pub fn guard(&mut self, path: impl Into<PathBuf>) {
        let path = path.into();
        // A file that does not exist cannot be written over.
        if let Ok(file) = fs::canonicalize(&path) {
            self.guarded.push(Named { path, file });
        }
    }

    /// Checks early, before hours of work, that a file could be put at `path`, and that it is neither guarded nor
    /// claimed before. Links count as the files that they lead to. [`add`](Self::add) claims what was not claimed.
    ///
    /// # Errors
    /// [`BakeError::Write`] as [`check`](Self::check) has it, [`BakeError::Overlap`] if the file is taken.
    pub fn claim(&mut self, path: &Path) -> Result<(), BakeError> {
        if let Place::File(place) = place_of(path)? {
            let file = identity(&place).map_err(|source| BakeError::Write { path: path.into(), source })?;
            let mut taken = self.guarded.iter().chain(self.claimed.iter().map(|(named, _)| named));
            if let Some(other) = taken.find(|named| named.file == file) {
                return Err(BakeError::Overlap { path: path.into(), other: other.path.clone() });
            }
            self.claimed.push((Named { path: path.into(), file }, false));
        }
        Ok(())
    }

    /// Writes `bytes` to a temporary file beside `path`, or beside the file that it links to. Bytes for a device or
    /// pipe, such as `/dev/stdout`, wait in memory.
    ///
    /// # Errors
    /// The errors of [`claim`](Self::claim), and [`BakeError::Write`] if the temporary file cannot be written.
    pub fn add(&mut self, path: impl AsRef<Path>, bytes: &[u8]) -> Result<(), BakeError> {
        let path = path.as_ref();
        let Place::File(file) = place_of(path)? else {
            self.waiting.push(Waiting::Device(bytes.to_vec(), path.into()));
            return Ok(());
        };
        if !self.claimed.iter().any(|(named, filled)| named.path == path && !filled) {
            self.claim(path)?;
        }
        let claim = self.claimed.iter_mut().find(|(named, filled)| named.path == path && !filled);
        claim.into_iter().for_each(|(_, filled)| *filled = true);
        let temporary = Temporary::write(folder_of(&file), ".bake-", bytes)
            .map_err(|source| BakeError::Write { path: path.into(), source })?;
        self.waiting.push(Waiting::File(temporary, Named { path: path.into(), file }));
        Ok(())
    }

    /// Puts all files in place, in the order in which they were added, then writes to devices. A signal that is
    /// answered with [`abandon_all`](Self::abandon_all) comes before or after all files.
    ///
    /// # Errors
    /// [`BakeError::Write`]; files before the one that failed are in place then.
    pub fn commit(mut self) -> Result<(), BakeError> {
        {
            let mut list = temporary::list();
            for waiting in &mut self.waiting {
                if let Waiting::File(file, Named { path, file: place }) = waiting {
                    file.persist(&mut list, place).map_err(|source| BakeError::Write { path: path.clone(), source })?;
                }
            }
        }
        for waiting in self.waiting {
            if let Waiting::Device(bytes, path) = waiting {
                write_through(&path, &bytes).map_err(|source| BakeError::Write { path, source })?;
            }
        }
        Ok(())
    }

    /// Removes what waits in all `StagedFiles` of this process, for programs that are asked to end (Ctrl+C). Then calls
    /// `end`, while nothing can be added or committed; it should end the process.
    ///
    /// ```
    /// use bevy_coating::bake::StagedFiles;
    ///
    /// # let folder = tempfile::tempdir()?;
    /// let mut files = StagedFiles::default();
    /// files.add(folder.path().join("aged.json"), b"{}")?;
    /// // From a handler of signals: StagedFiles::abandon_all(|| std::process::exit(130));
    /// StagedFiles::abandon_all(|| ());
    /// assert_eq!(std::fs::read_dir(&folder)?.count(), 0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn abandon_all(end: impl FnOnce()) {
        temporary::remove_all(end);
    }
}

/// Finds out where `path` leads.
fn place_of(path: &Path) -> Result<Place, BakeError> {
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
    if let Ok(data) = fs::metadata(path)
        && !data.is_file()
    {
        return match is_device(path, &data) {
            true => Ok(Place::Device),
            false => error(io::ErrorKind::InvalidInput, "it is a pipe or a disk; write to a file or to /dev/stdout"),
        };
    }
    let end = end_of_links(path).map_err(|source| BakeError::Write { path: path.into(), source })?;
    if !folder_of(&end).is_dir() {
        return error(io::ErrorKind::NotFound, "its folder does not exist; create it first");
    }
    Ok(Place::File(end))
}

/// The file that is named at the end of links, whether it exists or not.
fn end_of_links(path: &Path) -> io::Result<PathBuf> {
    let mut path = path.to_owned();
    for _ in 0..MOST_LINKS {
        match fs::symlink_metadata(&path) {
            Ok(data) if data.is_symlink() => path = folder_of(&path).join(fs::read_link(&path)?),
            _ => return Ok(path),
        }
    }
    Err(io::Error::new(io::ErrorKind::InvalidInput, "its links go round in a circle"))
}

/// A path by which a file is known, whatever leads to it.
fn identity(path: &Path) -> io::Result<PathBuf> {
    match fs::canonicalize(path) {
        Ok(path) => Ok(path),
        Err(_) => Ok(fs::canonicalize(folder_of(path))?.join(path.file_name().unwrap_or_default())),
    }
}

/// Whether something that is no file can be written to without waiting for ever: the terminal, /dev/null, and what this
/// process was given (/dev/stdout, /dev/fd/3). Nobody may ever read from another pipe.
#[cfg(unix)]
fn is_device(path: &Path, data: &fs::Metadata) -> bool {
    use std::os::unix::fs::FileTypeExt;
    data.file_type().is_char_device() || is_stream(path) || path.starts_with("/dev/fd")
}

#[cfg(not(unix))]
fn is_device(_: &Path, data: &fs::Metadata) -> bool {
    !data.is_dir()
}

fn is_stream(path: &Path) -> bool {
    path == Path::new("/dev/stdout") || path == Path::new("/dev/stderr")
}

fn write_through(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut file: Box<dyn Write> = match path.to_str() {
        Some("/dev/stdout") => Box::new(io::stdout()),
        Some("/dev/stderr") => Box::new(io::stderr()),
        _ => Box::new(File::options().write(true).open(path)?),
    };
    file.write_all(bytes)?;
    file.flush()
}

#[cfg(all(test, unix))]
mod tests {
    use std::os::unix::fs::symlink;

    use super::*;

    #[test]
    fn links_are_followed_and_stay() {
        let folder = tempfile::tempdir().expect("a folder");
        let at = |name: &str| folder.path().join(name);
        fs::create_dir(at("models")).expect("a folder");
        symlink("models/real.glb", at("link.glb")).expect("a link");
        symlink("link.glb", at("second.glb")).expect("a link");
        for text in ["new", "newer"] {
            let mut files = StagedFiles::default();
            files.add(at("second.glb"), text.as_bytes()).expect("a file");
            files.commit().expect("a file");
            assert_eq!(fs::read_to_string(at("models/real.glb")).expect("a file"), text);
        }
        assert!(fs::symlink_metadata(at("link.glb")).expect("a link").is_symlink());
        symlink("round.glb", at("round.glb")).expect("a link");
        assert!(StagedFiles::check(&at("round.glb")).is_err());
    }

    #[test]
    fn one_file_under_two_names_is_one_file() {
        let folder = tempfile::tempdir().expect("a folder");
        let at = |name: &str| folder.path().join(name);
        fs::write(at("prop.glb"), "glTF").expect("a file");
        symlink("prop.glb", at("link.glb")).expect("a link");
        symlink(".", at("same")).expect("a link");
        let mut files = StagedFiles::default();
        files.guard(at("link.glb"));
        for name in ["prop.glb", "link.glb", "same/prop.glb", "same/./same/prop.glb"] {
            let error = files.claim(&at(name)).expect_err(name);
            assert!(matches!(&error, BakeError::Overlap { other, .. } if other.ends_with("link.glb")), "{error}");
        }
        files.claim(&at("aged.glb")).expect("a place");
        assert!(matches!(files.claim(&at("same/aged.glb")), Err(BakeError::Overlap { .. })));
        files.add(at("aged.glb"), b"aged").expect("the place that was claimed");
        assert!(files.add(at("aged.glb"), b"again").is_err());
        // Nothing is lost by writing twice to nowhere.
        files.add("/dev/null", b"1").and_then(|()| files.add("/dev/null", b"2")).expect("a device");
        files.commit().expect("files");
        assert_eq!(fs::read(at("aged.glb")).expect("a file"), b"aged");
    }
}
