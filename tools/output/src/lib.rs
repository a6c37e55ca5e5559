//! Atomic file output: files are written under a temporary name next to their own, fsynced, then
//! renamed.
//!
//! Every writer of the tools, the live page and the shaders uses [`Output`]. A temporary file is
//! locked while it is written. The next run in the folder detects files left by a killed run, and
//! removes them.

pub mod cargo;

use std::fs::{self, File, TryLockError};
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

/// Names of temporary files: these around six letters and digits.
const NAME: [&str; 2] = [".asperity-", ".part"];

/// A folder checked for write access.
#[derive(Clone, Debug)]
pub struct Output {
    folder: PathBuf,
}

impl Output {
    /// Creates the folder if necessary, checks that it is writable, and removes abandoned temporary
    /// files.
    ///
    /// # Errors
    ///
    /// Returns the folder and the reason why it is not writable, in one line, like all errors here.
    pub fn new(folder: impl Into<PathBuf>) -> io::Result<Self> {
        let mut folder = folder.into();
        // The folder of a bare file name.
        if folder.as_os_str().is_empty() {
            folder.push(".");
        }
        let fail = unwritten(&folder);
        fs::create_dir_all(&folder).map_err(fail)?;
        tempfile::tempfile_in(&folder).map_err(fail)?;
        sweep(&folder);
        Ok(Self { folder })
    }

    /// Returns the absolute path of a file, for display.
    #[must_use]
    pub fn place(&self, name: &str) -> String {
        let path = self.folder.join(name);
        std::path::absolute(&path).unwrap_or(path).display().to_string()
    }

    /// Returns the path of a file.
    #[must_use]
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    /// Returns a subfolder.
    ///
    /// # Errors
    ///
    /// Same as [`new`](Self::new).
    pub fn inside(&self, name: &str) -> io::Result<Self> {
        Self::new(self.folder.join(name))
    }

    /// Writes `bytes` to `name`.
    ///
    /// # Errors
    ///
    /// Returns the file and the reason why it cannot be written. The previous file, if any, is
    /// unchanged.
    pub fn write(&self, name: &str, bytes: &[u8]) -> io::Result<()> {
        self.stream(name, |file| file.write_all(bytes))
    }

    /// Writes `name` incrementally.
    ///
    /// # Errors
    ///
    /// Same as [`write`](Self::write), and errors of the `write` argument.
    pub fn stream<E: From<io::Error>>(
        &self,
        name: &str,
        write: impl FnOnce(&mut BufWriter<Part>) -> Result<(), E>,
    ) -> Result<(), E> {
        let mut buffer = BufWriter::with_capacity(1 << 18, Part::new(&self.folder, name)?);
        write(&mut buffer)?;
        // On a full disk the last bytes may fail.
        Ok(buffer.into_inner().map_err(io::IntoInnerError::into_error)?.finish()?)
    }

    /// Reads `name` if it exists.
    #[must_use]
    pub fn read(&self, name: &str) -> Option<Vec<u8>> {
        fs::read(self.folder.join(name)).ok()
    }
}

/// A file written under a temporary name, which is removed unless finished.
#[derive(Debug)]
pub struct Part {
    file: NamedTempFile,
    path: PathBuf,
}

impl Part {
    fn new(folder: &Path, name: &str) -> io::Result<Self> {
        let path = folder.join(name);
        loop {
            let [before, after] = NAME;
            let file = tempfile::Builder::new().prefix(before).suffix(after).tempfile_in(folder);
            let file = file.map_err(unwritten(&path))?;
            // On file systems without locks, nothing is removed either.
            let _ = file.as_file().lock();
            // Another run may have removed it before it was locked.
            if !matches!(file.path().try_exists(), Ok(false)) {
                return Ok(Self { file, path });
            }
        }
    }

    fn finish(self) -> io::Result<()> {
        let fail = unwritten(&self.path);
        open_to_readers(self.file.as_file()).map_err(fail)?;
        // Otherwise a rename may reach the disk before the bytes do.
        self.file.as_file().sync_data().map_err(fail)?;
        self.file.persist(&self.path).map_err(|error| fail(error.error))?;
        Ok(())
    }
}

impl Write for Part {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.as_file().write(bytes).map_err(unwritten(&self.path))
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.as_file().flush().map_err(unwritten(&self.path))
    }
}

impl Seek for Part {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.file.as_file().seek(to).map_err(unwritten(&self.path))
    }
}

/// Removes temporary files of dead writers. Files that cannot be read or removed are left for the
/// next run.
fn sweep(folder: &Path) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let temporary = entry.file_name().to_str().is_some_and(is_temporary);
        if !temporary || !entry.file_type().is_ok_and(|kind| kind.is_file()) {
            continue;
        }
        // The lock is held until the file is removed.
        let Ok(file) = File::options().write(true).open(entry.path()) else { continue };
        if file.try_lock().is_ok() {
            let _ = fs::remove_file(entry.path());
        }
    }
}

fn is_temporary(name: &str) -> bool {
    let [before, after] = NAME;
    let random = name.strip_prefix(before).and_then(|name| name.strip_suffix(after));
    random.is_some_and(|random| random.len() == 6 && random.bytes().all(|byte| byte.is_ascii_alphanumeric()))
}

/// A lock on a name that several runs can hold, until the last run removes the resource.
#[derive(Debug)]
pub struct Shared {
    file: File,
    path: PathBuf,
}

impl Shared {
    /// Acquires the lock, which keeps a file of this name while held. Waits while another run
    /// removes the resource.
    ///
    /// # Errors
    ///
    /// Returns the file and the reason why it cannot be written.
    pub fn new(output: &Output, name: &str) -> io::Result<Self> {
        let path = output.path(name);
        loop {
            let file = File::options().create(true).truncate(false).write(true).open(&path);
            let file = file.map_err(unwritten(&path))?;
            let _ = file.lock_shared();
            if !matches!(path.try_exists(), Ok(false)) {
                return Ok(Self { file, path });
            }
        }
    }

    /// Releases the lock, and calls `remove` if no other run holds it.
    pub fn release(self, remove: impl FnOnce()) {
        let _ = self.file.unlock();
        if !matches!(self.file.try_lock(), Err(TryLockError::WouldBlock)) {
            remove();
            let _ = fs::remove_file(&self.path);
        }
    }
}

/// Formats the reason why a file or folder could not be written.
fn unwritten(path: &Path) -> impl Fn(io::Error) -> io::Error + Copy {
    move |cause| io::Error::new(cause.kind(), format!("cannot write {}: {cause}", path.display()))
}

// A temporary file is private to its owner. A finished file has the default permissions.
#[cfg(unix)]
fn open_to_readers(file: &File) -> io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    file.set_permissions(fs::Permissions::from_mode(0o644))
}

#[cfg(not(unix))]
#[expect(clippy::unnecessary_wraps, reason = "the twin of the fallible form above")]
fn open_to_readers(_: &File) -> io::Result<()> {
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(folder: &Path) -> Vec<String> {
        let mut names: Vec<_> = fs::read_dir(folder)
            .unwrap()
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort_unstable();
        names
    }

    #[test]
    fn write_replaces_the_file_and_leaves_no_temporary() {
        let scratch = tempfile::tempdir().unwrap();
        let output = Output::new(scratch.path().join("deep/er")).unwrap();
        output.write("a.txt", b"first").unwrap();
        output.write("a.txt", b"second").unwrap();
        assert_eq!(output.read("a.txt").unwrap(), b"second");
        assert_eq!(names(&output.folder), ["a.txt"]);
    }

    #[test]
    fn failed_write_keeps_the_previous_file() {
        let scratch = tempfile::tempdir().unwrap();
        let output = Output::new(scratch.path()).unwrap();
        output.write("a.txt", b"first").unwrap();
        let failed = output.stream("a.txt", |file| {
            file.write_all(b"half")?;
            file.flush()?;
            assert_eq!(names(scratch.path()).len(), 2);
            Err(io::Error::other("no more"))
        });
        assert_eq!(failed.unwrap_err().to_string(), "no more");
        assert_eq!(
            (names(scratch.path()), output.read("a.txt").unwrap()),
            (vec!["a.txt".into()], b"first".into())
        );
    }

    #[test]
    fn sweep_removes_only_abandoned_temporaries() {
        let scratch = tempfile::tempdir().unwrap();
        let kept = [
            ".asperity-notes",
            ".asperity-abcdef.partial",
            ".asperity-abcdefg.part",
            ".asperity-abc/ef.part",
            "a.part",
        ];
        for name in kept {
            fs::create_dir_all(scratch.path().join(name).parent().unwrap()).unwrap();
            fs::write(scratch.path().join(name), b"a person's own").unwrap();
        }
        let before = names(scratch.path());
        fs::write(scratch.path().join(".asperity-aB3dE6.part"), b"hal").unwrap();
        let output = Output::new(scratch.path()).unwrap();
        assert_eq!(names(scratch.path()), before);
        let written = output.stream("b.txt", |file| {
            Output::new(scratch.path()).unwrap();
            file.write_all(b"whole")
        });
        written.unwrap();
        assert_eq!(output.read("b.txt").unwrap(), b"whole");
    }

    #[test]
    fn last_shared_holder_removes() {
        let scratch = tempfile::tempdir().unwrap();
        let output = Output::new(scratch.path()).unwrap();
        let [first, last] = [(); 2].map(|()| Shared::new(&output, "held").unwrap());
        let mut removed = 0;
        first.release(|| removed += 1);
        assert_eq!((removed, names(scratch.path()).len()), (0, 1));
        last.release(|| removed += 1);
        assert_eq!((removed, names(scratch.path()).len()), (1, 0));
    }
}
