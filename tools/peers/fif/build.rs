//! Finds Embree's library in `EMBREE_LIB_DIR`, with any file name.

use std::{env, error::Error, fs, path::PathBuf};

fn main() -> Result<(), Box<dyn Error>> {
    println!("cargo:rerun-if-env-changed=EMBREE_LIB_DIR");
    println!("cargo:rustc-check-cfg=cfg(embree3)");
    let folder = env::var("EMBREE_LIB_DIR").map_err(|_| "EMBREE_LIB_DIR is not set (see README.md)")?;
    let folder = PathBuf::from(folder).canonicalize()?;
    let mut found: Vec<String> = fs::read_dir(&folder)?
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        .filter(|name| {
            (name.starts_with("libembree4") || name.starts_with("libembree3")) && name.contains(".so")
        })
        .collect();
    found.sort();
    let name = found.pop().ok_or("found neither libembree4 nor libembree3 in EMBREE_LIB_DIR")?;
    if name.starts_with("libembree3") {
        println!("cargo:rustc-cfg=embree3");
    }
    println!("cargo:rustc-link-arg-bins={}", folder.join(name).display());
    println!("cargo:rustc-link-arg-bins=-Wl,-rpath,{}", folder.display());
    // The wheel's library finds its dependencies next to itself when it is loaded.
    println!("cargo:rustc-link-arg-bins=-Wl,--allow-shlib-undefined");
    Ok(())
}
