//! The quadratic B-spline as a kernel over the texels of the (n_x, n_y) map.

use alloc::vec::Vec;

use crate::map::disk::meets;
use asperity_core::math;

/// The lower edge of texel `k` in units of n_x.
pub(crate) fn edge(k: usize, size: usize) -> f64 {
    2.0 * k as f64 / size as f64 - 1.0
}

/// The first texel that overlaps the kernel around `c`.
pub(crate) fn first_texel(c: f64, width: f64, size: usize) -> usize {
    // A cast from float to integer saturates at 0.
    (((c - 1.5 * width + 1.0) * 0.5 * size as f64) as usize).min(size - 1)
}

/// The kernel around `c`, averaged over each overlapping texel, starting at texel `first`.
pub(crate) fn averaged_kernel(c: f64, width: f64, first: usize, size: usize, kernel: &mut Vec<f64>) {
    kernel.clear();
    let below = |x: f64| {
        if width > 0.0 { spline_integral((x - c) / width) } else { f64::from(u8::from(x > c)) }
    };
    // The part below the first texel is outside the disk, except for a point at its very end.
    let mut before = if first == 0 && width == 0.0 { 0.0 } else { below(edge(first, size)) };
    for k in first..size {
        let after = if k + 1 == size && width == 0.0 { 1.0 } else { below(edge(k + 1, size)) };
        kernel.push((after - before) * 0.5 * size as f64);
        before = after;
        if after >= 1.0 {
            break;
        }
    }
}

/// The integral of the quadratic B-spline up to `t`.
fn spline_integral(t: f64) -> f64 {
    let rest = 1.5 - t.abs();
    let beyond = if rest <= 0.0 {
        0.0
    } else if rest < 1.0 {
        rest * rest * rest / 6.0
    } else {
        let t = t.abs();
        0.5 - t * (0.75 - t * t / 3.0)
    };
    if t > 0.0 { 1.0 - beyond } else { beyond }
}

/// The area of the part of a rectangle inside the unit disk.
///
/// The midpoints of 16 strips are accurate to 1 % of a texel at the rim.
pub(crate) fn area_inside([x0, x1]: [f64; 2], [y0, y1]: [f64; 2]) -> f64 {
    const STRIPS: usize = 16;
    if !meets([x0, x1], [y0, y1]) {
        return 0.0;
    }
    let step = (x1 - x0) / STRIPS as f64;
    (0..STRIPS)
        .map(|k| {
            let x = x0 + step * (k as f64 + 0.5);
            let chord = math::sqrt_f64((1.0 - x * x).max(0.0));
            (y1.min(chord) - y0.max(-chord)).max(0.0) * step
        })
        .sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn spline_integrates_to_one_with_variance_one_quarter() {
        let (mut mass, mut variance, mut before) = (0.0, 0.0, spline_integral(-1.5));
        assert_eq!((before, spline_integral(1.5), spline_integral(0.0)), (0.0, 1.0, 0.5));
        for k in -1499..=1500 {
            let t = f64::from(k) * 1e-3;
            let after = spline_integral(t);
            mass += after - before;
            variance += (after - before) * (t - 5e-4) * (t - 5e-4);
            before = after;
        }
        assert_abs_diff_eq!(mass, 1.0, epsilon = 1e-12, "{mass} {variance}");
        assert_abs_diff_eq!(variance, 0.25, epsilon = 1e-6, "{mass}");
    }

    #[test]
    fn kernel_sums_to_one_inside_the_map() {
        let mut kernel = Vec::new();
        for (c, width) in [(0.0, 0.1), (0.31, 0.02), (-0.7, 0.19), (0.999, 0.0), (1.0, 0.0), (-1.0, 0.0)] {
            averaged_kernel(c, width, first_texel(c, width, 64), 64, &mut kernel);
            let sum = kernel.iter().sum::<f64>() * 2.0 / 64.0;
            assert_abs_diff_eq!(sum, 1.0, epsilon = 1e-12, "{c} {width}");
        }
    }
}
