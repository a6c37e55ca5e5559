//! The programs that the live page gives to copy, one after the other; each by the scene and the settings it was given for.
#![deny(warnings)]

use std::process::ExitCode;

include!(concat!(env!("OUT_DIR"), "/snippets.rs"));

fn main() -> ExitCode {
    let mut failed = false;
    for (name, run) in SNIPPETS {
        if let Err(error) = run() {
            eprintln!("{name}: {error}");
            failed = true;
        }
    }
    if failed { ExitCode::FAILURE } else { ExitCode::SUCCESS }
}
