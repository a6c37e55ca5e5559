//! Files that appear whole or not at all: written under a temporary name, then renamed.

use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::{fs, io};

use sha2::{Digest, Sha256};

use crate::failure::{Failure, Interrupted};

/// A folder that is known to be writable.
#[derive(Clone, Debug)]
pub(crate) struct Output {
    folder: PathBuf,
}

impl Output {
    /// Makes the folder if need be and proves that it can be written to.
    pub(crate) fn new(folder: impl Into<PathBuf>) -> Result<Self, Failure> {
        let folder = folder.into();
        let fail = unwritten(&folder);
        fs::create_dir_all(&folder).map_err(fail)?;
        tempfile::tempfile_in(&folder).map_err(fail)?;
        Ok(Self { folder })
    }

    /// The whole path of a file in it, for people.
    pub(crate) fn place(&self, name: &str) -> String {
        let path = self.folder.join(name);
        std::path::absolute(&path).unwrap_or(path).display().to_string()
    }

    /// The path of a file in it.
    pub(crate) fn path(&self, name: &str) -> PathBuf {
        self.folder.join(name)
    }

    /// A folder inside this one.
    pub(crate) fn inside(&self, name: &str) -> Result<Self, Failure> {
        Self::new(self.folder.join(name))
    }

    /// Writes `bytes` to `name` and returns the SHA-256 of the file in hexadecimal.
    pub(crate) fn write(&self, name: &str, bytes: &[u8]) -> Result<String, Failure> {
        let path = self.folder.join(name);
        let fail = unwritten(&path);
        let mut file =
            tempfile::Builder::new().prefix(".asperity-").tempfile_in(&self.folder).map_err(fail)?;
        file.write_all(bytes).map_err(fail)?;
        open_to_readers(file.as_file()).map_err(fail)?;
        file.persist(&path).map_err(|e| fail(e.error))?;
        Ok(sha256(bytes))
    }

    /// Writes `name` piece by piece; where that fails, there is no file of the name, or the one from before.
    pub(crate) fn stream(
        &self,
        name: &str,
        write: impl FnOnce(&mut BufWriter<fs::File>) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        let path = self.folder.join(name);
        let fail = unwritten(&path);
        let file = tempfile::Builder::new().prefix(".asperity-").tempfile_in(&self.folder).map_err(fail)?;
        let mut buffer = BufWriter::with_capacity(1 << 18, file.reopen().map_err(fail)?);
        // Where the disk is full it may be the last bytes that have no room.
        let written = write(&mut buffer).and_then(|()| Ok(buffer.flush()?));
        written.map_err(|cause| {
            let stopped = cause.is::<Interrupted>();
            if stopped { cause } else { Failure::from(format!("cannot write {}: {cause}", path.display())) }
        })?;
        open_to_readers(file.as_file()).map_err(fail)?;
        file.persist(&path).map_err(|e| fail(e.error))?;
        Ok(())
    }

    /// Reads `name` if it is there.
    pub(crate) fn read(&self, name: &str) -> Option<Vec<u8>> {
        fs::read(self.folder.join(name)).ok()
    }
}

/// Why a file or folder could not be written.
fn unwritten(path: &Path) -> impl Fn(io::Error) -> Failure + Copy {
    move |cause| format!("cannot write {}: {cause}", path.display()).into()
}

// A temporary file is private to its owner; a finished one is as readable as any other.
#[cfg(unix)]
fn open_to_readers(file: &fs::File) -> io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    file.set_permissions(fs::Permissions::from_mode(0o644))
}

#[cfg(not(unix))]
#[expect(clippy::unnecessary_wraps, reason = "the twin of the fallible form above")]
fn open_to_readers(_: &fs::File) -> io::Result<()> {
    Ok(())
}

/// SHA-256 in lower-case hexadecimal.
pub(crate) fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_write_replaces_the_file_and_leaves_no_other() {
        let scratch = tempfile::tempdir().unwrap();
        let output = Output::new(scratch.path().join("deep/er")).unwrap();
        output.write("a.txt", b"first").unwrap();
        let digest = output.write("a.txt", b"second").unwrap();
        assert_eq!(output.read("a.txt").unwrap(), b"second");
        assert_eq!(digest, sha256(b"second"));
        assert_eq!(fs::read_dir(&output.folder).unwrap().count(), 1);
    }

    #[test]
    fn the_digest_is_that_of_the_standard() {
        // FIPS 180-2, appendix B.1.
        let abc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        assert_eq!(sha256(b"abc"), abc);
    }
}
