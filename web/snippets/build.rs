//! Takes the programs that `browser/snippets.mjs` wrote, where the variable `ASPERITY_SNIPPETS` names their file.

use std::path::Path;
use std::{env, fs};

/// No program at all, where none is named.
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
