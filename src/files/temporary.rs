//! Keeps temporary files, and a list of all there are in this process, so that none stays behind when a signal ends it.
//! What a process leaves behind that is killed outright goes when the next file is written into the same folder.

use std::{
    collections::BTreeSet,
    fs::{self, File, OpenOptions, TryLockError},
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

/// Number of hexadecimal digits at the end of the names of temporary files.
const DIGITS: usize = 16;

/// A file that is removed when it is dropped.
#[derive(Debug)]
pub struct Temporary {
    path: Option<PathBuf>,
    /// The file, locked as long as this lives: whoever finds it unlocked knows that its process has ended.
    _locked: File,
}

impl Temporary {
    /// Writes a file into a folder and sees to it that it is on the disk. Its name begins with `prefix`. Files of that
    /// prefix that killed processes have left there are removed.
    ///
    /// # Errors
    /// The error of the operating system.
    pub fn write(folder: &Path, prefix: &str, bytes: &[u8]) -> io::Result<Self> {
        let mut temporary = {
            let mut list = list();
            remove_left(folder, prefix);
            let (file, path) = create(folder, prefix)?;
            list.insert(path.clone());
            Self { path: Some(path), _locked: file }
        };
        let file = &mut temporary._locked;
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
        let Some(path) = self.path.take() else { return Ok(()) };
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
        if let Some(path) = self.path.take() {
            let mut list = list();
            list.remove(&path);
            let _ = fs::remove_file(path);
        }
    }
}

/// Removes the files of a prefix that no process holds any more. What cannot be removed stays.
fn remove_left(folder: &Path, prefix: &str) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for entry in entries.flatten() {
        let name = entry.file_name();
        let number = name.to_str().and_then(|name| name.strip_prefix(prefix)).unwrap_or_default();
        let is_ours = number.len() == DIGITS && number.bytes().all(|digit| digit.is_ascii_hexdigit());
        if !is_ours || !entry.file_type().is_ok_and(|kind| kind.is_file()) {
            continue;
        }
        // Locked from here until it is gone: who made it just now and has not locked it yet makes another.
        if let Ok(file) = File::open(entry.path())
            && file.try_lock().is_ok()
        {
            let _ = fs::remove_file(entry.path());
        }
    }
}

/// Creates a file that was not there, and locks it.
#[expect(clippy::cast_possible_truncation, reason = "any number will do that differs from moment to moment")]
fn create(folder: &Path, prefix: &str) -> io::Result<(File, PathBuf)> {
    // Says so where there is no such folder, or where there are no files, as in browsers: these have neither a clock
    // nor numbers of processes that could be asked without a panic.
    fs::metadata(folder)?;
    let now = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).unwrap_or_default();
    let seed = now.as_nanos() as u64 ^ u64::from(process::id()).rotate_left(32);
    for i in 0..TRIES {
        // An odd multiplier, so that no two tries give the same name.
        let number = seed.wrapping_add(i).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        let path = folder.join(format!("{prefix}{number:0DIGITS$x}"));
        match OpenOptions::new().write(true).create_new(true).open(&path) {
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
            Err(error) => return Err(error),
            Ok(file) => {
                // Without locks, as on some network drives, nobody removes what others have left.
                let is_taken = matches!(file.try_lock(), Err(TryLockError::WouldBlock));
                if !is_taken && fs::symlink_metadata(&path).is_ok() {
                    return Ok((file, path));
                }
            }
        }
    }
    Err(io::Error::new(io::ErrorKind::AlreadyExists, "no name was left for a temporary file"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_that_is_not_there_is_an_error() {
        let folder = tempfile::tempdir().expect("a folder");
        let error = Temporary::write(&folder.path().join("none"), ".test-", b"bytes").expect_err("no folder");
        assert_eq!(error.kind(), io::ErrorKind::NotFound);
    }

    #[test]
    fn what_the_dead_have_left_goes_and_what_lives_stays() {
        let folder = tempfile::tempdir().expect("a folder");
        let left = folder.path().join(".test-0123456789abcdef");
        let others = [".test-notes", ".test-0123456789abcdeg", ".rest-0123456789abcdef", "test"];
        for path in others.map(|name| folder.path().join(name)).iter().chain([&left]) {
            fs::write(path, b"half of a file").expect("a file");
        }
        let first = Temporary::write(folder.path(), ".test-", b"first").expect("a file");
        assert!(!left.exists(), "no process holds it");
        let second = Temporary::write(folder.path(), ".test-", b"second").expect("a file");
        for (temporary, bytes) in [(&first, &b"first"[..]), (&second, b"second")] {
            let path = temporary.path.as_ref().expect("a path");
            assert_eq!(fs::read(path).expect("a file"), bytes, "it is held");
        }
        let place = folder.path().join("place");
        let mut second = second;
        second.persist(&mut list(), &place).expect("a place");
        drop((first, second));
        assert_eq!(fs::read(&place).expect("a file"), b"second");
        assert_eq!(fs::read_dir(&folder).expect("a folder").count(), others.len() + 1, "names that are not ours stay");
    }
}
