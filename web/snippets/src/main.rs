//! Runs the code snippets of the live page one by one. Each is named by its scene and settings.
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
