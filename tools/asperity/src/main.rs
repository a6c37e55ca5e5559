//! The program `asperity`: renders meshes, bakes textures, exports tables and checks densities.

use std::process::ExitCode;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use asperity::invocation::Invocation;

fn main() -> ExitCode {
    let interrupted = Arc::new(AtomicBool::new(false));
    let flag = Arc::clone(&interrupted);
    // Without the handler, an interrupt ends the process at once, which loses nothing written before.
    let _ = ctrlc::set_handler(move || flag.store(true, Ordering::Relaxed));
    asperity::program::run(&Invocation::of_process(), &interrupted).into()
}
