//! Slopes by finite differences, with error bounds.

use asperity_core::math::sqrt_f64;

use crate::point::Point;

/// The largest magnitude of a point's coordinates; so close to the origin they lose few digits.
pub(super) const REACH: f32 = 4.0;

/// A unit in the last place of a number of one.
const ULP: f64 = 1.0 / 8_388_608.0;

/// A slope along an axis by differences, and a bound of its error.
///
/// ```text
/// D(h) = (f(p + h) − f(p − h))/(2h),      |D(h) − f′(p)| ≤ |D(h) − D(2h)| + |f(p + h) − 2 f(p) + f(p − h)|/(2h) + 4 ulp (|f| + |p| |∇f|)/h
/// ```
///
/// The first term is three times the error of the third derivative. The second is the error of a
/// kink closer than `h`. The third is the rounding of values and positions to `f32`. Of the steps
/// from 2⁻¹⁴ to 2⁻⁴, as long as they agree, the step with the smallest bound is used.
pub(super) fn slope<V: Point>(f: &dyn Fn(V) -> f64, p: V, axis: usize, size: f64, steep: f64) -> [f64; 2] {
    let moved = |by: f32| {
        let mut coordinates = p.coordinates();
        if let Some(x) = coordinates.as_mut().get_mut(axis) {
            *x += by;
        }
        f(V::from_coordinates(coordinates))
    };
    let rounding = 4.0 * ULP * (size + f64::from(REACH) * steep);
    let here = f(p);
    let sides = |power: i32| {
        let h = 1.0 / (1_i32 << power) as f32;
        ([-h, h].map(moved), f64::from(h))
    };
    let mut best = [0.0, f64::INFINITY];
    let (mut near, mut h) = sides(14);
    for power in (3..14).rev() {
        let ([behind, ahead], (far, twice)) = (near, sides(power));
        let difference = (ahead - behind) / (2.0 * h);
        let wider = (far[1] - far[0]) / (2.0 * twice);
        let bound =
            (difference - wider).abs() + (ahead - 2.0 * here + behind).abs() / (2.0 * h) + rounding / h;
        // Steps that are longer than the features of the function agree by chance.
        if (difference - best[0]).abs() > best[1] {
            break;
        }
        if bound < best[1] {
            best = [difference, bound];
        }
        (near, h) = (far, twice);
    }
    best
}

/// Root of the mean square.
pub(super) fn root_mean_square(numbers: impl Iterator<Item = f64>) -> f64 {
    let (count, sum) = numbers.fold((0.0, 0.0), |(count, sum), x| (count + 1.0, sum + x * x));
    sqrt_f64(sum / f64::max(count, 1.0))
}
