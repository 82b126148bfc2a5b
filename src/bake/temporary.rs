//! Keeps temporary files, and a list of all there are in this process, so that none stays behind when a signal ends it.

use std::{
    collections::BTreeSet,
    fs,
    io::{self, Write},
    path::{Path, PathBuf},
    sync::{Mutex, MutexGuard, PoisonError},
};

use tempfile::TempPath;

/// Paths of all temporary files of this process. Whoever holds it keeps others from making or moving any.
static ALL: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// Lock on the list of temporary files.
pub type List = MutexGuard<'static, BTreeSet<PathBuf>>;

/// Takes the list of temporary files.
pub fn list() -> List {
    ALL.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes all temporary files, then calls `then` while nobody can make another.
pub fn remove_all(then: impl FnOnce()) {
    let mut list = list();
    for path in std::mem::take(&mut *list) {
        // It may be gone already.
        let _ = fs::remove_file(path);
    }
    then();
}

/// A file that is removed when it is dropped.
#[derive(Debug)]
pub struct Temporary(Option<TempPath>);

impl Temporary {
    /// Writes a file into a folder and sees to it that it is on the disk.
    pub fn write(folder: &Path, bytes: &[u8]) -> io::Result<Self> {
        let mut builder = tempfile::Builder::new();
        builder.prefix(".bake-");
        // Temporary files are private by default; these are to become ordinary ones.
        #[cfg(unix)]
        let permissions = std::os::unix::fs::PermissionsExt::from_mode(0o666);
        #[cfg(unix)]
        builder.permissions(permissions);
        let (mut file, path) = {
            let mut list = list();
            let (file, path) = builder.tempfile_in(folder)?.into_parts();
            list.insert(path.to_path_buf());
            (file, path)
        };
        let temporary = Self(Some(path));
        file.write_all(bytes)?;
        file.flush()?;
        file.sync_all()?;
        Ok(temporary)
    }

    /// Gives the file its place. Does nothing the second time.
    pub fn persist(&mut self, list: &mut List, place: &Path) -> io::Result<()> {
        let Some(path) = self.0.take() else { return Ok(()) };
        list.remove::<Path>(&path);
        path.persist(place).map_err(|error| error.error)
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        if let Some(path) = self.0.take() {
            let mut list = list();
            list.remove::<Path>(&path);
            drop(path);
        }
    }
}
