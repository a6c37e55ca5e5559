//! The bits of all four crates, as lines of text that are the same on every machine.
#![no_std]

extern crate alloc;

mod digest;
mod fif;
mod ndf_sampling;
mod noise;
mod shading;

use alloc::string::String;

use digest::Report;

/// Returns a line with the SIMD level, then a line per function: group, name and digest of its
/// values at many points.
#[must_use]
pub fn report() -> String {
    let mut report = Report::default();
    noise::tell(&mut report);
    ndf_sampling::tell(&mut report);
    fif::tell(&mut report);
    shading::tell(&mut report);
    report.text
}
