//! How the program was called.

use std::ffi::OsString;
use std::path::PathBuf;

/// A command line, and the program that runs it.
///
/// In a process of another language, such as Python, the executable of the process is not the program.
#[derive(Clone, Debug)]
pub struct Invocation {
    /// The words of the command line, the name of the program first.
    pub words: Vec<OsString>,
    /// The path that runs the program again, for jobs.
    pub command: PathBuf,
    /// The file whose bytes identify the program. Tiles of another program are not reused.
    pub binary: PathBuf,
}

impl Invocation {
    /// Returns the invocation of this process.
    pub fn of_process() -> Self {
        // An empty path is reported when it is read.
        let executable = std::env::current_exe().unwrap_or_default();
        Self { words: std::env::args_os().collect(), command: executable.clone(), binary: executable }
    }

    /// Returns the arguments after the name of the program.
    pub(crate) fn arguments(&self) -> impl Iterator<Item = String> {
        self.words.iter().skip(1).map(|word| word.to_string_lossy().into_owned())
    }
}
