//! Digests of floats, and the points at which they are taken.

use alloc::{format, string::String};
use core::fmt::Write;

use asperity_noise::simd::Level;
use asperity_shading::glam::{DVec2, DVec3, Vec2, Vec3};

/// Tab-separated lines of groups, names and digests.
pub(crate) struct Report {
    pub(crate) text: String,
    group: &'static str,
}

impl Default for Report {
    fn default() -> Self {
        Self { text: format!("level\t{}\n", Level::best().name()), group: "" }
    }
}

impl Report {
    /// Starts a group for the lines that follow.
    pub(crate) fn group(&mut self, name: &'static str) {
        self.group = name;
    }

    /// Adds a line for the pushed values.
    pub(crate) fn row(&mut self, name: &str, push: impl FnOnce(&mut Digest)) {
        let mut digest = Digest(0xcbf2_9ce4_8422_2325);
        push(&mut digest);
        let _ = writeln!(self.text, "{}\t{name}\t{:016x}", self.group, digest.0);
    }
}

/// The FNV-1a hash of words (Fowler, Noll, Vo), by whole words.
pub(crate) struct Digest(u64);

impl Digest {
    pub(crate) fn push(&mut self, x: impl Bits) {
        x.push_to(self);
    }

    fn word(&mut self, bits: u64) {
        self.0 = (self.0 ^ bits).wrapping_mul(0x0100_0000_01b3);
        // Sign and exponent are the highest bits, which a product alone would shift out of the
        // word.
        self.0 ^= self.0 >> 29;
    }
}

/// Values that consist of floats.
pub(crate) trait Bits {
    fn push_to(self, digest: &mut Digest);
}

impl Bits for f32 {
    fn push_to(self, digest: &mut Digest) {
        // WebAssembly does not specify the bits of NaN.
        digest.word(if self.is_nan() { 1 << 40 } else { self.to_bits().into() });
    }
}

impl Bits for f64 {
    fn push_to(self, digest: &mut Digest) {
        digest.word(if self.is_nan() { 1 } else { self.to_bits() });
    }
}

impl<T: Bits> Bits for Option<T> {
    fn push_to(self, digest: &mut Digest) {
        match self {
            Some(x) => x.push_to(digest),
            None => digest.word(2),
        }
    }
}

impl<T: Bits, const N: usize> Bits for [T; N] {
    fn push_to(self, digest: &mut Digest) {
        self.into_iter().for_each(|x| x.push_to(digest));
    }
}

impl<T: Bits + Copy> Bits for &[T] {
    fn push_to(self, digest: &mut Digest) {
        self.iter().for_each(|x| x.push_to(digest));
    }
}

macro_rules! vectors {
    ($($vector:ty)*) => {$(
        impl Bits for $vector {
            fn push_to(self, digest: &mut Digest) {
                self.to_array().push_to(digest);
            }
        }
    )*};
}

vectors! { Vec2 Vec3 DVec2 DVec3 }

/// Returns number `axis` of point `i`, in [0, 1).
pub(crate) fn unit(i: u32, axis: u32) -> f32 {
    let mut word = i.wrapping_mul(0x9e37_79b9) ^ axis.wrapping_mul(0x85eb_ca6b) ^ 0x27d4_eb2f;
    for _ in 0..2 {
        word = (word ^ word >> 15).wrapping_mul(0x2c1b_3c6d);
    }
    (word >> 8) as f32 / 16_777_216.0
}

/// Returns point `i` of the unit square.
pub(crate) fn square(i: u32) -> Vec2 {
    Vec2::new(unit(i, 0), unit(i, 1))
}

/// Returns point `i` of a square about the origin: positions on a surface, pairs of Gaussian
/// numbers.
pub(crate) fn plane(i: u32) -> Vec2 {
    (square(i) - 0.5) * 6.0
}

/// Returns point `i` of a cube about the origin.
pub(crate) fn space(i: u32) -> Vec3 {
    (square(i).extend(unit(i, 2)) - 0.5) * 9.0
}

/// Returns direction `i` of the upper hemisphere.
pub(crate) fn direction(i: u32) -> Vec3 {
    (square(i) - 0.5).extend(0.01 + 0.5 * unit(i, 3)).normalize()
}
