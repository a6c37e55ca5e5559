//! Fuzz targets: each takes any bytes, and panics if an invariant of a crate or of a tool is
//! violated.

#![expect(clippy::missing_panics_doc, clippy::unwrap_used, reason = "a panic is the failure")]

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

/// The heap, which aborts the program if a fuzz target allocates too much.
#[cfg(feature = "limits")]
#[global_allocator]
static HEAP: cap::Cap<std::alloc::System> = cap::Cap::new(std::alloc::System, usize::MAX);

/// A fuzz target with its name.
pub type Attack = (&'static str, fn(&[u8]));

/// All fuzz targets.
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

/// Runs a fuzz target.
///
/// # Panics
///
/// If no target has this name, or an invariant is violated.
pub fn attack(name: &str, data: &[u8]) {
    ATTACKS.iter().find(|attack| attack.0 == name).expect("a fuzz target of this name").1(data);
}

/// Runs a reader that may allocate at most `most` more bytes.
#[cfg(feature = "limits")]
fn within<T>(most: usize, read: impl FnOnce() -> T) -> T {
    HEAP.set_limit(HEAP.allocated() + most).expect("more than is taken");
    let result = read();
    HEAP.set_limit(usize::MAX).expect("all there is");
    result
}

/// Runs a reader.
#[cfg(not(feature = "limits"))]
fn within<T>(_: usize, read: impl FnOnce() -> T) -> T {
    read()
}
