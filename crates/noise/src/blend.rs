//! The blend of one linear function per corner of a cell, the common core of lattice noises: value and gradient.
//!
//! Corners are kept in lanes, the lower and the upper end of every edge along x, so that the compiler can vectorise.

use glam::{Vec2, Vec3};

use crate::{fade::Fade, sample::Sample};

/// The linear functions of `N` corners: their values at the point and their gradients.
#[derive(Clone, Copy)]
pub(crate) struct Corners<const N: usize, const D: usize> {
    pub(crate) value: [f32; N],
    pub(crate) gradient: [[f32; N]; D],
}

impl<const N: usize, const D: usize> Corners<N, D> {
    pub(crate) const ZERO: Self = Self { value: [0.0; N], gradient: [[0.0; N]; D] };
}

/// Blends the corners of a square; lane j of `low` and `high` is the edge along x at y = j.
#[inline(always)]
pub(crate) fn blend2(low: &Corners<2, 2>, high: &Corners<2, 2>, fade: [Fade; 2]) -> Sample<Vec2> {
    let [fx, fy] = fade;
    let w = [1.0 - fy.weight, fy.weight];
    let dy = [-fy.slope, fy.slope];
    let rise = zip(high.value, low.value, |h, l| h - l);
    let value = zip(low.value, rise, |l, r| l + fx.weight * r);
    let [gx, gy] = [0, 1].map(|k| lerp(low.gradient[k], high.gradient[k], fx.weight));
    let x = zip(gx, rise, |g, r| g + fx.slope * r);
    let y = zip(zip(w, gy, |w, g| w * g), zip(dy, value, |d, v| d * v), |a, b| a + b);
    let sum = |a: [f32; 2]| a[0] + a[1];
    Sample {
        value: sum(zip(w, value, |w, v| w * v)),
        gradient: Vec2::new(sum(zip(w, x, |w, x| w * x)), sum(y)),
    }
}

/// Blends the corners of a cube; lane j of `low` and `high` is the edge along x at y = j & 1, z = j ≫ 1.
#[inline(always)]
pub(crate) fn blend3(low: &Corners<4, 3>, high: &Corners<4, 3>, fade: [Fade; 3]) -> Sample<Vec3> {
    let [fx, fy, fz] = fade;
    let wy = [1.0 - fy.weight, fy.weight, 1.0 - fy.weight, fy.weight];
    let wz = [1.0 - fz.weight, 1.0 - fz.weight, fz.weight, fz.weight];
    let w = zip(wy, wz, |a, b| a * b);
    let dy = zip([-fy.slope, fy.slope, -fy.slope, fy.slope], wz, |a, b| a * b);
    let dz = zip(wy, [-fz.slope, -fz.slope, fz.slope, fz.slope], |a, b| a * b);
    let rise = zip(high.value, low.value, |h, l| h - l);
    let value = zip(low.value, rise, |l, r| l + fx.weight * r);
    let [gx, gy, gz] = [0, 1, 2].map(|k| lerp(low.gradient[k], high.gradient[k], fx.weight));
    let x = zip(gx, rise, |g, r| g + fx.slope * r);
    let y = zip(zip(w, gy, |w, g| w * g), zip(dy, value, |d, v| d * v), |a, b| a + b);
    let z = zip(zip(w, gz, |w, g| w * g), zip(dz, value, |d, v| d * v), |a, b| a + b);
    let sum = |a: [f32; 4]| (a[0] + a[2]) + (a[1] + a[3]);
    Sample {
        value: sum(zip(w, value, |w, v| w * v)),
        gradient: Vec3::new(sum(zip(w, x, |w, x| w * x)), sum(y), sum(z)),
    }
}

#[inline(always)]
fn lerp<const N: usize>(low: [f32; N], high: [f32; N], weight: f32) -> [f32; N] {
    zip(low, high, |l, h| l + weight * (h - l))
}

/// Lane by lane.
#[inline(always)]
fn zip<const N: usize>(a: [f32; N], b: [f32; N], f: impl Fn(f32, f32) -> f32) -> [f32; N] {
    core::array::from_fn(|lane| f(a[lane], b[lane]))
}
