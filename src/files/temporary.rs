//! Keeps temporary files, and a list of all there are in this process, so that none stays behind when a signal ends it.

use std::{
    collections::BTreeSet,
    fs::{self, File, OpenOptions},
    io::{self, Write},
    path::{Path, PathBuf},
    process,
    sync::{Mutex, MutexGuard, PoisonError},
    time::SystemTime,
};

/// Paths of all temporary files of this process. Whoever holds it keeps others from making or moving any.
static ALL: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

/// Lock on the list of temporary files.
pub type List = MutexGuard<'static, BTreeSet<PathBuf>>;

/// Takes the list of temporary files.
pub fn list() -> List {
    ALL.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes all temporary files, then calls `then` while nobody can make another.
#[cfg(feature = "bake")]
pub fn remove_all(then: impl FnOnce()) {
    let mut list = list();
    for path in std::mem::take(&mut *list) {
        // It may be gone already.
        let _ = fs::remove_file(path);
    }
    then();
}

/// Names that are tried for a temporary file before it is given up: others write into the folder, too.
const TRIES: u64 = 1000;

/// A file that is removed when it is dropped.
#[derive(Debug)]
pub struct Temporary(Option<PathBuf>);

impl Temporary {
    /// Writes a file into a folder and sees to it that it is on the disk. Its name begins with `prefix`.
    ///
    /// # Errors
    /// The error of the operating system.
    pub fn write(folder: &Path, prefix: &str, bytes: &[u8]) -> io::Result<Self> {
        let (mut file, path) = {
            let mut list = list();
            let (file, path) = create(folder, prefix)?;
            list.insert(path.clone());
            (file, path)
        };
        let temporary = Self(Some(path));
        file.write_all(bytes)?;
        file.flush()?;
        file.sync_all()?;
        Ok(temporary)
    }

    /// Gives the file its place, in one go: whoever looks there finds the old file or the new one. Does nothing the
    /// second time.
    ///
    /// # Errors
    /// The error of the operating system; the file is gone then.
    pub fn persist(&mut self, list: &mut List, place: &Path) -> io::Result<()> {
        let Some(path) = self.0.take() else { return Ok(()) };
        list.remove(&path);
        let renamed = fs::rename(&path, place);
        if renamed.is_err() {
            let _ = fs::remove_file(path);
        }
        renamed
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        if let Some(path) = self.0.take() {
            let mut list = list();
            list.remove(&path);
            let _ = fs::remove_file(path);
        }
    }
}

/// Creates a file that was not there.
fn create(folder: &Path, prefix: &str) -> io::Result<(File, PathBuf)> {
    let now = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).unwrap_or_default();
    let seed = now.as_nanos() as u64 ^ u64::from(process::id()).rotate_left(32);
    for i in 0..TRIES {
        // An odd multiplier, so that no two tries give the same name.
        let number = seed.wrapping_add(i).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        let path = folder.join(format!("{prefix}{number:016x}"));
        match OpenOptions::new().write(true).create_new(true).open(&path) {
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
            done => return done.map(|file| (file, path)),
        }
    }
    Err(io::Error::new(io::ErrorKind::AlreadyExists, "no name was left for a temporary file"))
}
