//! A bump-mapped patch above a fractal curve, rendered row by row from tables in flash, without an
//! allocator.
#![no_std]

#[cfg(feature = "device")]
pub mod stack;
mod tables;

use asperity_fif::FixedFif;
use asperity_ndf_sampling::{Frame, PackedMapRef};
use asperity_noise::{FbmSpectrum, GaussianFbm, GaussianNoise};
use asperity_shading::glam::{Vec2, Vec3};
use asperity_shading::reflectance::{OrenNayar, OrenNayarVariant};
use asperity_shading::{Brdf, BumpField, Footprint, LevelOfDetail};

pub const WIDTH: usize = 128;
/// Rows of the patch.
const PATCH: usize = 96;
/// Rows of the curve.
const CURVE: usize = 48;
/// The header of a portable gray map.
pub const HEADER: &[u8] = b"P5 128 144 255\n";

/// The density of the table in flash: steeper along x than along y.
#[must_use]
pub fn density(m: Vec3) -> f32 {
    let (x, y) = (m.x * 3.0, m.y * 7.0);
    let sum = 1.0 + x * x + y * y;
    m.z / (sum * sum)
}

/// Knots, ordinates and vertical factors of the curve.
static KNOTS: [f64; 6] = [0.0, 1.0, 2.5, 4.0, 4.75, 6.0];
static ORDINATES: [f64; 6] = [0.1, 0.75, 0.3, 0.95, 0.5, 0.2];
static FACTORS: [f64; 5] = [0.3, -0.35, 0.4, 0.25, -0.3];

/// Returns the density of the table in flash.
#[must_use]
pub fn normals() -> Option<PackedMapRef<'static>> {
    PackedMapRef::new(&tables::DENSITY).ok()
}

/// Returns the curve of the tables in flash.
#[must_use]
pub fn curve() -> Option<FixedFif<5, 2>> {
    FixedFif::affine(&KNOTS, &ORDINATES, &FACTORS).ok()
}

/// Returns the bump map: exactly Gaussian noise with five octaves.
#[must_use]
pub fn bumps() -> Option<BumpField<GaussianFbm<Vec3>>> {
    let spectrum = FbmSpectrum::new(2.17, 0.6, 5).ok()?;
    BumpField::new(GaussianFbm::new(GaussianNoise::new(19), spectrum), 5.0).ok()
}

/// Returns the reflectance of the patch.
#[must_use]
pub fn clay() -> Option<OrenNayar> {
    OrenNayar::new(Vec3::splat(0.9), 0.3, OrenNayarVariant::Full).ok()
}

/// Passes on the rows of the image from the top down. Returns false if a table is invalid.
pub fn draw(tell: &mut dyn FnMut(&[u8; WIDTH])) -> bool {
    patch(tell).is_some() && graph(tell).is_some()
}

fn patch(tell: &mut dyn FnMut(&[u8; WIDTH])) -> Option<()> {
    let (normals, bumps, clay) = (normals()?, bumps()?, clay()?);
    let light = Vec3::new(-0.48, 0.36, 0.8);
    let mut row = [0; WIDTH];
    for y in 0..PATCH {
        for (x, gray) in row.iter_mut().enumerate() {
            let p = Vec2::new(x as f32, y as f32) / PATCH as f32;
            let pixel = Footprint::from_width(1.0 / PATCH as f32);
            let seen = bumps.coordinates(p.extend(0.0), &Frame::IDENTITY, pixel);
            let m = LevelOfDetail::Exact.normal(&normals, seen);
            let bump = Frame::from_normal(m);
            let radiance = clay.eval(bump.to_local(Vec3::Z), bump.to_local(light)).x * m.dot(light).max(0.0);
            *gray = level(3.2 * radiance);
        }
        tell(&row);
    }
    Some(())
}

fn graph(tell: &mut dyn FnMut(&[u8; WIDTH])) -> Option<()> {
    let curve = curve()?;
    let domain = curve.domain();
    let mut heights = [0.0_f32; WIDTH];
    for (x, height) in heights.iter_mut().enumerate() {
        let at = domain.lo + domain.width() * (x as f64 + 0.5) / WIDTH as f64;
        *height = curve.evaluate(at, 1e-6).value as f32;
    }
    let mut row = [0; WIDTH];
    for y in 0..CURVE {
        let top = 1.3 - 1.5 * y as f32 / CURVE as f32;
        let bottom = top - 1.5 / CURVE as f32;
        for (gray, height) in row.iter_mut().zip(heights) {
            // The fraction of the pixel below the curve.
            let part = ((height - bottom) / (top - bottom)).clamp(0.0, 1.0);
            *gray = level(0.95 - 0.8 * part);
        }
        tell(&row);
    }
    Some(())
}

fn level(x: f32) -> u8 {
    (x.clamp(0.0, 1.0) * 255.0 + 0.5) as u8
}

/// Returns the FNV-1a hash of bytes (Fowler, Noll, Vo).
#[must_use]
pub fn hash(from: u32, bytes: &[u8]) -> u32 {
    bytes.iter().fold(from, |hash, &byte| (hash ^ u32::from(byte)).wrapping_mul(0x0100_0193))
}

/// The hash of empty input.
pub const START: u32 = 0x811c_9dc5;

/// Formats a word in hexadecimal, like `{:08x}` without the formatting machinery.
#[must_use]
pub fn hexadecimal(word: u32) -> [u8; 8] {
    core::array::from_fn(|k| {
        let digit = (word >> (28 - 4 * k) & 15) as u8;
        if digit < 10 { b'0' + digit } else { b'a' + digit - 10 }
    })
}
