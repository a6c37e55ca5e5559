//! Distant lamps: single directions, and soft boxes built from them.

use glam::Vec3;

use crate::image::tone::hex;

/// A distant light.
#[derive(Clone, Copy, Debug)]
pub struct Lamp {
    /// Unit length, toward the light.
    pub direction: Vec3,
    pub color: Vec3,
}

impl Lamp {
    /// Creates a lamp at an azimuth and an elevation, as in [`direction`].
    pub fn at(azimuth: f32, elevation: f32, color: Vec3) -> Self {
        Self { direction: direction(azimuth, elevation), color }
    }
}

/// Lamps with one common shadow, or none.
#[derive(Clone, Debug)]
pub enum Lamps {
    /// Distant: a white matte surface facing a lamp has its color. An object in the direction of
    /// `shadow` hides all of them.
    Far { lights: Vec<Lamp>, shadow: Option<Vec3> },
    /// A point light: a white matte surface facing it at distance 1 has its color.
    Near { place: Vec3, color: Vec3 },
}

impl Lamps {
    /// Creates lights without shadows.
    pub fn open(lights: Vec<Lamp>) -> Self {
        Self::Far { lights, shadow: None }
    }

    /// Creates one distant lamp with a shadow.
    pub fn one(direction: Vec3, color: Vec3) -> Self {
        Self::Far { lights: vec![Lamp { direction, color }], shadow: Some(direction) }
    }
}

/// A warm key from the upper left, a cool fill from the right and a rim from behind, all times
/// `scale`.
///
/// Each is a rectangle of lights in the sky, so closely spaced that a lobe of the widths in the
/// figures spans several.
pub fn studio(scale: Vec3) -> Vec<Lamp> {
    let mut lamps = Vec::new();
    // Azimuth and elevation of the center and full angles in degrees, lights along and across,
    // color, brightness.
    for ([azimuth, elevation], size, [columns, rows], color, brightness) in [
        ([-132.0, 46.0], [26.0_f32, 26.0], [4, 4], 0xff_f2e2, 1.0),
        ([-18.0, 16.0], [16.0, 40.0], [2, 4], 0xb9_d0ff, 0.5),
        ([100.0, 34.0], [40.0, 16.0], [4, 2], 0xff_d6a8, 0.6),
    ] {
        let center = direction(azimuth, elevation);
        let right = Vec3::Z.cross(center).normalize();
        let up = center.cross(right);
        let half = size.map(|angle| (0.5 * angle.to_radians()).tan());
        let color = scale * hex(color) * brightness / (columns * rows) as f32;
        lamps.extend((0..columns * rows).map(|k| {
            let place = |i: u32, n: u32| 2.0 * (i as f32 + 0.5) / n as f32 - 1.0;
            let (x, y) = (place(k % columns, columns) * half[0], place(k / columns, rows) * half[1]);
            Lamp { direction: (center + right * x + up * y).normalize(), color }
        }));
    }
    lamps
}

/// Returns the unit vector at an azimuth about the z axis and an elevation, both in degrees.
pub fn direction(azimuth: f32, elevation: f32) -> Vec3 {
    let (sin_a, cos_a) = azimuth.to_radians().sin_cos();
    let (sin_e, cos_e) = elevation.to_radians().sin_cos();
    Vec3::new(cos_e * cos_a, cos_e * sin_a, sin_e)
}

#[cfg(test)]
mod tests {
    use approx::assert_abs_diff_eq;

    use super::*;

    #[test]
    fn soft_box_has_its_color_and_center() {
        let (sum, middle) = studio(Vec3::ONE)[..16]
            .iter()
            .fold((Vec3::ZERO, Vec3::ZERO), |(c, d), light| (c + light.color, d + light.direction));
        assert_abs_diff_eq!(sum, hex(0xff_f2e2), epsilon = 1e-5);
        assert_abs_diff_eq!(middle.normalize(), direction(-132.0, 46.0), epsilon = 1e-3);
    }
}
