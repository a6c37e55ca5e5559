//! Includes the programs written by `browser/snippets.mjs`, if `ASPERITY_SNIPPETS` is the path of
//! their file.

use std::path::Path;
use std::{env, fs};

/// No programs, if there is no file.
const NONE: &str = "const SNIPPETS: &[(&str, fn() -> Result<(), Box<dyn std::error::Error>>)] = &[];\n";

fn main() -> Result<(), Box<dyn std::error::Error>> {
    println!("cargo::rerun-if-env-changed=ASPERITY_SNIPPETS");
    let text = match env::var_os("ASPERITY_SNIPPETS") {
        Some(file) => {
            println!("cargo::rerun-if-changed={}", Path::new(&file).display());
            fs::read_to_string(file)?
        }
        None => NONE.to_owned(),
    };
    fs::write(Path::new(&env::var("OUT_DIR")?).join("snippets.rs"), text)?;
    Ok(())
}
