//! Files that appear whole or not at all: written under a temporary name beside their own, brought to the disk, then renamed.
//!
//! Every writer of the tools, of the live page and of the shaders goes through [`Output`]. A temporary file is locked while it is
//! written, so that the next run that opens the folder knows what a killed one has left, and removes it.

pub mod cargo;

use std::fs::{self, File, TryLockError};
use std::io::{self, BufWriter, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

use tempfile::NamedTempFile;

/// Names of temporary files: these around six letters and digits.
const NAME: [&str; 2] = [".asperity-", ".part"];

/// A folder that is known to be writable.
#[derive(Clone, Debug)]
pub struct Output {
    folder: PathBuf,
}

impl Output {
    /// Makes the folder if need be, proves that it can be written to, and removes temporary files that nobody writes any more.
    ///
    /// # Errors
    /// The folder and why it cannot be written to, in one line; so do all errors here.
    pub fn new(folder: impl Into<PathBuf>) -> io::Result<Self> {
        let mut folder = folder.into();
        // The folder of a bare name.
        if folder.as_os_str().is_empty() {
            folder.push(".");
        }
        let fail = unwritten(&folder);
        fs::create_dir_all(&folder).map_err(fail)?;
        tempfile::tempfile_in(&folder).map_err(fail)?;
        sweep(&folder);
        Ok(Self { folder })
    }

    /// The whole path of a file in it, for people.
    #[must_use]
    pub fn place(&self, name: &str) -> String {
        let path = self.folder.join(name);
        std::path::absolute(&path).unwrap_or(path).display().to_string()
    }

    /// The path of a file in it.
    #[must_use]
    pub fn path(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    /// A folder inside this one.
    ///
    /// # Errors
    /// The errors of [`new`](Self::new).
    pub fn inside(&self, name: &str) -> io::Result<Self> {
        Self::new(self.folder.join(name))
    }

    /// Writes `bytes` to `name`.
    ///
    /// # Errors
    /// The file and why it cannot be written; then there is no file of the name, or the one from before.
    pub fn write(&self, name: &str, bytes: &[u8]) -> io::Result<()> {
        self.stream(name, |file| file.write_all(bytes))
    }

    /// Writes `name` piece by piece.
    ///
    /// # Errors
    /// The errors of [`write`](Self::write), and what `write` itself returns.
    pub fn stream<E: From<io::Error>>(
        &self,
        name: &str,
        write: impl FnOnce(&mut BufWriter<Part>) -> Result<(), E>,
    ) -> Result<(), E> {
        let mut buffer = BufWriter::with_capacity(1 << 18, Part::new(&self.folder, name)?);
        write(&mut buffer)?;
        // Where the disk is full it may be the last bytes that have no room.
        Ok(buffer.into_inner().map_err(io::IntoInnerError::into_error)?.finish()?)
    }

    /// Reads `name` if it is there.
    #[must_use]
    pub fn read(&self, name: &str) -> Option<Vec<u8>> {
        fs::read(self.folder.join(name)).ok()
    }
}

/// A file that is being written under a temporary name, which is gone if it is never finished.
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
            // Without locks in a file system nothing is swept from it either.
            let _ = file.as_file().lock();
            // Another run may have swept it before it was locked.
            if !matches!(file.path().try_exists(), Ok(false)) {
                return Ok(Self { file, path });
            }
        }
    }

    fn finish(self) -> io::Result<()> {
        let fail = unwritten(&self.path);
        open_to_readers(self.file.as_file()).map_err(fail)?;
        // Else a rename may reach the disk before the bytes do.
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

/// Removes temporary files whose writers have died; of what cannot be read or removed the next run will try again.
fn sweep(folder: &Path) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let temporary = entry.file_name().to_str().is_some_and(is_temporary);
        if !temporary || !entry.file_type().is_ok_and(|kind| kind.is_file()) {
            continue;
        }
        // The lock is held until the file is gone.
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

/// A lock on a name that several runs may hold, until the last of them removes what it stands for.
#[derive(Debug)]
pub struct Shared {
    file: File,
    path: PathBuf,
}

impl Shared {
    /// Takes the lock, of which a file of the name is left while it is held; waits while another run removes.
    ///
    /// # Errors
    /// The file and why it cannot be written.
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

    /// Gives the lock back; calls `remove` if no other run holds it.
    pub fn release(self, remove: impl FnOnce()) {
        let _ = self.file.unlock();
        if !matches!(self.file.try_lock(), Err(TryLockError::WouldBlock)) {
            remove();
            let _ = fs::remove_file(&self.path);
        }
    }
}

/// Why a file or folder could not be written.
fn unwritten(path: &Path) -> impl Fn(io::Error) -> io::Error + Copy {
    move |cause| io::Error::new(cause.kind(), format!("cannot write {}: {cause}", path.display()))
}

// A temporary file is private to its owner; a finished one is as readable as any other.
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
    fn a_write_replaces_the_file_and_leaves_no_other() {
        let scratch = tempfile::tempdir().unwrap();
        let output = Output::new(scratch.path().join("deep/er")).unwrap();
        output.write("a.txt", b"first").unwrap();
        output.write("a.txt", b"second").unwrap();
        assert_eq!(output.read("a.txt").unwrap(), b"second");
        assert_eq!(names(&output.folder), ["a.txt"]);
    }

    #[test]
    fn what_fails_halfway_leaves_the_file_from_before_alone() {
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
    fn a_dead_run_s_temporary_is_swept_a_living_one_s_and_other_files_are_not() {
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
    fn the_last_of_those_who_share_removes() {
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
