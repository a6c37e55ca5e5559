//! Attacks: each takes any bytes, and panics where a promise of a crate or of the builder is broken.

#![expect(clippy::missing_panics_doc, clippy::unwrap_used, reason = "an attack that succeeds is a failure")]

#[path = "../../../tools/asperity/src/cli.rs"]
#[allow(dead_code, reason = "the builder's own, of which the parsers are called")]
mod cli;
#[path = "../../../tools/asperity/src/failure.rs"]
#[allow(unused, reason = "the builder's own, of which the parsers are called")]
mod failure;
mod input;
/// A function of the output that the input needs.
mod output {
    pub fn sha256(bytes: &[u8]) -> String {
        use sha2::{Digest, Sha256};
        Sha256::digest(bytes).iter().map(|byte| format!("{byte:02x}")).collect()
    }
}
/// Notes are not printed.
mod progress {
    pub const fn note(_: &str) {}
}
#[path = "../../../tools/asperity/src/quality.rs"]
#[allow(dead_code, reason = "the builder's own, of which the parsers are called")]
mod quality;

mod density;
mod environment;
mod fif;
mod files;
mod map;
mod material;
mod noise;
mod numbers;
mod reflectance;
pub mod seeds;
mod shader;
mod surface;
mod table;
mod text;

use numbers::Numbers;

/// The heap, which ends the program where an attack takes more than it may.
#[cfg(feature = "limits")]
#[global_allocator]
static HEAP: cap::Cap<std::alloc::System> = cap::Cap::new(std::alloc::System, usize::MAX);

/// An attack by its name.
pub type Attack = (&'static str, fn(&[u8]));

/// All attacks.
pub const ATTACKS: [Attack; 17] = [
    ("png", files::png),
    ("exr", files::exr),
    ("picture", files::picture),
    ("mesh", files::mesh),
    ("gltf", files::gltf),
    ("json", text::json),
    ("words", text::words),
    ("table", |data| table::attack(&mut Numbers::new(data))),
    ("shader", |data| shader::attack(&mut Numbers::new(data))),
    ("noise", |data| noise::attack(&mut Numbers::new(data))),
    ("density", |data| density::attack(&mut Numbers::new(data))),
    ("map", |data| map::attack(&mut Numbers::new(data))),
    ("fif", |data| fif::attack(&mut Numbers::new(data))),
    ("surface", |data| surface::attack(&mut Numbers::new(data))),
    ("reflectance", |data| reflectance::attack(&mut Numbers::new(data))),
    ("environment", |data| environment::attack(&mut Numbers::new(data))),
    ("material", |data| material::attack(&mut Numbers::new(data))),
];

/// Runs an attack.
///
/// # Panics
/// If there is none of this name, or a promise is broken.
pub fn attack(name: &str, data: &[u8]) {
    ATTACKS.iter().find(|attack| attack.0 == name).expect("an attack has this name").1(data);
}

/// The result of a reader, with at most so many bytes of memory more than before.
#[cfg(feature = "limits")]
fn within<T>(most: usize, read: impl FnOnce() -> T) -> T {
    HEAP.set_limit(HEAP.allocated() + most).expect("more than is taken");
    let result = read();
    HEAP.set_limit(usize::MAX).expect("all there is");
    result
}

/// The result of a reader.
#[cfg(not(feature = "limits"))]
fn within<T>(_: usize, read: impl FnOnce() -> T) -> T {
    read()
}
