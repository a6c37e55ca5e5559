//! Directions in the plane by the part of a full turn.

use core::f32::consts::FRAC_PI_2;

use glam::Vec2;

/// `(cos 2πv, sin 2πv)`.
///
/// - **Domain:** any `v`, read modulo 1; infinities and NaN give (1, 0).
/// - **Accuracy:** 1.2e-7, and exact at the quarters; the quarter is taken off before anything is rounded.
#[inline]
pub(crate) fn turn(v: f32) -> Vec2 {
    // Beyond 2²³ every number is whole.
    let v = if v.abs() < 8_388_608.0 { v - v as i32 as f32 } else { 0.0 };
    let quarter = (4.0 * v + 4.5) as i32;
    let x = (4.0 * v - (quarter - 4) as f32) * FRAC_PI_2;
    let t = x * x;
    // Taylor's series up to x⁹ and x¹⁰: the next terms are below 2e-9 for |x| ≤ π/4.
    let sin = x * (1.0 - t / 6.0 * (1.0 - t / 20.0 * (1.0 - t / 42.0 * (1.0 - t / 72.0))));
    let cos = 1.0 - t / 2.0 * (1.0 - t / 12.0 * (1.0 - t / 30.0 * (1.0 - t / 56.0 * (1.0 - t / 90.0))));
    let (c, s) = if quarter % 2 == 0 { (cos, sin) } else { (sin, cos) };
    // Quarters 0 to 3 of cos: +cos, −sin, −cos, +sin.
    Vec2::new(if (quarter + 1) & 2 == 0 { c } else { -c }, if quarter & 2 == 0 { s } else { -s })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equals_the_library() {
        for k in -3000..=3000_i32 {
            let v = k as f32 / 1024.0;
            let (sin, cos) = (f64::from(v) * core::f64::consts::TAU).sin_cos();
            let [x, y] = turn(v).to_array().map(f64::from);
            assert!((x - cos).abs() < 1.2e-7 && (y - sin).abs() < 1.2e-7, "{v}: {x} {y}");
        }
    }

    #[test]
    fn exact_at_the_quarters_and_total() {
        for (v, x, y) in
            [(0.0, 1.0, 0.0), (0.25, 0.0, 1.0), (0.5, -1.0, 0.0), (0.75, 0.0, -1.0), (1.0, 1.0, 0.0)]
        {
            assert_eq!(turn(v), Vec2::new(x, y), "{v}");
        }
        for v in [f32::NAN, f32::INFINITY, -1e30, 1e30] {
            assert!((turn(v).length() - 1.0).abs() < 1e-6, "{v}");
        }
    }
}
