//! `cargo xtask firmware`: a picture from tables in flash, drawn on an emulated Cortex-M4 and here,
//! and what functions cost there.

mod page;
mod program;

use std::path::Path;
use std::process::Command;

use crate::failure::Result;
use crate::report::write;
use asperity_output::cargo::{cargo, run};
use program::{Device, Drawn, Program};

const FOLDER: &str = "tests/firmware";
/// The checked-in table, in the folder of the firmware.
const TABLE: &str = "src/density.bin";
/// The checked-in picture.
const PICTURE: &str = "docs/pictures/firmware.png";

/// Draws the picture on both machines; an error if they differ, if the table is not what the crates
/// make, or if code for panics is linked into it or into a function whose cost is measured.
pub(crate) fn check(root: &Path) -> Result<String> {
    let folder = root.join(FOLDER);
    if std::fs::read(folder.join(TABLE))? != table(&folder)? {
        return Err(
            "the firmware's table is not what the crates make; `cargo xtask firmware --ship` writes it"
                .into(),
        );
    }
    let device = match Device::find(&folder) {
        Ok(device) => device,
        Err(why) => return Ok(format!("not run: {why}")),
    };
    let drawn = draw(&folder, &device)?;
    Program::read(&device.build("cost", "every")?)?;
    Ok(format!(
        "on an emulated Cortex-M4 the picture has this machine's hash, {}: {} bytes of code, {} of tables, {} of stack; nothing of panics \
         in it and in {} functions",
        drawn.hash,
        drawn.program.code,
        drawn.program.constants,
        drawn.stack,
        page::FUNCTIONS.len()
    ))
}

/// Writes the table and the picture, and returns the table of code, constants and stack of each
/// function.
pub(crate) fn ship(root: &Path) -> Result<String> {
    let folder = root.join(FOLDER);
    write(&folder.join(TABLE), &table(&folder)?)?;
    let device = Device::find(&folder)?;
    let drawn = draw(&folder, &device)?;
    let costs =
        page::FUNCTIONS.iter().map(|function| device.cost(function.feature)).collect::<Result<Vec<_>>>()?;
    write(&root.join(PICTURE), &page::png(&drawn.picture)?)?;
    Ok(page::markdown(&drawn, &device.cost("device")?, &costs))
}

/// The packed map in flash, made by the crates.
fn table(folder: &Path) -> Result<Vec<u8>> {
    Ok(host(folder)?.arg("tables").output()?.stdout)
}

/// The program of this machine.
fn host(folder: &Path) -> Result<Command> {
    let mut build = cargo(folder, "build --quiet --release --locked --features host --bin host");
    let build = build.env_remove("CARGO_TARGET_DIR").env_remove("RUSTFLAGS");
    run(build).map_err(|error| format!("the firmware's picture here: {error}"))?;
    Ok(Command::new(folder.join(format!("target/release/host{}", std::env::consts::EXE_SUFFIX))))
}

fn draw(folder: &Path, device: &Device<'_>) -> Result<Drawn> {
    let here = host(folder)?.output()?;
    let program = device.build("firmware", "device")?;
    let there = device.run(&program)?;
    let hash = program::word(&there.errors, "hash")?;
    if !here.status.success() || there.picture != here.stdout {
        let errors = String::from_utf8_lossy(&here.stderr);
        let hash_here = program::word(&errors, "hash")?;
        return Err(format!("the firmware's picture has the hash {hash}, this machine's {hash_here}").into());
    }
    let stack = u64::from_str_radix(program::word(&there.errors, "stack")?, 16)?;
    Ok(Drawn { picture: there.picture, hash: hash.to_owned(), stack, program: Program::read(&program)? })
}
