//! The bits of all four crates, as lines of text that are the same on every machine.
#![cfg_attr(target_family = "wasm", no_std)]

extern crate alloc;

mod digest;
mod fif;
#[cfg(target_family = "wasm")]
mod module;
mod ndf_sampling;
mod noise;
mod shading;

use alloc::string::String;

use digest::Report;

/// One line a function: its name and a digest of its values at many points. Lines of noise with other than the golden bits say so.
#[must_use]
pub fn report() -> String {
    let mut report = Report::default();
    noise::tell(&mut report);
    ndf_sampling::tell(&mut report);
    fif::tell(&mut report);
    shading::tell(&mut report);
    report.text
}
