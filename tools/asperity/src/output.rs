//! Output files and their digests.

use std::path::{Path, PathBuf};

use sha2::{Digest, Sha256};

pub use asperity_output::{Output, Shared};

use crate::failure::Result;

/// Splits the path of an output file into its folder and its name.
pub fn split(file: &Path) -> Result<(PathBuf, String)> {
    let path = std::path::absolute(file)?;
    match (path.parent(), path.file_name(), path.is_dir()) {
        (Some(folder), Some(name), false) => match name.to_str() {
            Some(name) => Ok((folder.into(), name.into())),
            None => Err(format!("the file name `{}` is not Unicode", file.display()).into()),
        },
        _ => Err(format!("`{}` is a directory (expected a file name)", file.display()).into()),
    }
}

/// SHA-256 in lower-case hexadecimal.
pub fn sha256(bytes: &[u8]) -> String {
    Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sha256_matches_fips_180_2() {
        // FIPS 180-2, appendix B.1.
        let abc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
        assert_eq!(sha256(b"abc"), abc);
    }
}
