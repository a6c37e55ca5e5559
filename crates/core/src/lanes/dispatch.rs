//! The SIMD level of the machine, and functions over arrays in its lanes.

use core::ops::Range;

#[cfg(not(feature = "simd"))]
use crate::lanes::lanes::Scalar;
use crate::lanes::lanes::{Arithmetic, Lanes};
#[cfg(feature = "simd")]
use crate::lanes::register_pair::RegisterPair;
#[cfg(feature = "simd")]
use crate::lanes::registers::Registers;
use crate::lanes::transpose::Transpose;

/// The best SIMD level of this machine; without `std`, the level that the program is compiled for.
#[cfg(feature = "simd")]
#[inline]
#[must_use]
pub fn best_level() -> fearless_simd::Level {
    #[cfg(feature = "std")]
    return fearless_simd::Level::new();
    #[cfg(not(feature = "std"))]
    return fearless_simd::Level::baseline();
}

/// The best SIMD level for `count` numbers; short arrays do not fill the longest registers.
#[cfg(feature = "simd")]
#[inline]
#[must_use]
#[cfg_attr(
    not(target_arch = "x86_64"),
    expect(unused_variables, reason = "registers elsewhere have one length")
)]
pub fn level_for(count: usize) -> fearless_simd::Level {
    let best = best_level();
    #[cfg(target_arch = "x86_64")]
    if count <= 16 {
        return best.as_avx2().map_or(best, fearless_simd::Level::Avx2);
    }
    best
}

/// Calls `f` with every SIMD level of this machine, for tests.
#[cfg(feature = "simd")]
pub fn each_level(mut f: impl FnMut(fearless_simd::Level)) {
    let best = best_level();
    f(best);
    f(fearless_simd::Level::baseline());
    #[cfg(target_arch = "x86_64")]
    for level in
        [best.as_avx2().map(fearless_simd::Level::Avx2), best.as_sse4_2().map(fearless_simd::Level::Sse4_2)]
    {
        level.into_iter().for_each(&mut f);
    }
}

/// Work that is written over lanes.
pub trait Task {
    /// The result.
    type Output;

    /// Does the work in lanes of `S`; implementations are `#[inline(always)]`.
    fn run<S: Lanes + Transpose>(self, s: S) -> Self::Output;
}

/// Runs a task at a SIMD level.
#[cfg(feature = "simd")]
#[inline]
pub fn run_at<T: Task>(level: fearless_simd::Level, task: T) -> T::Output {
    fearless_simd::dispatch!(level, simd => task.run(Registers::new(simd)))
}

/// Runs a task over `count` numbers at the best level for this count; in one lane without the
/// feature `simd`.
#[inline]
pub fn run<T: Task>(count: usize, task: T) -> T::Output {
    #[cfg(feature = "simd")]
    return run_at(level_for(count), task);
    #[cfg(not(feature = "simd"))]
    {
        let _ = count;
        task.run(Scalar)
    }
}

/// A function of `I` numbers to `O`, in lanes.
pub trait Kernel<const I: usize, const O: usize> {
    /// Whether the function is so long that four interleaved registers are faster than two.
    const LONG: bool = false;

    /// The results of one register; implementations are `#[inline(always)]`.
    fn apply<S: Arithmetic>(&self, s: S, x: [S::F; I]) -> [S::F; O];
}

/// Applies a kernel to arrays of equal length, at the best level of the machine; in one lane
/// without the feature `simd`.
#[inline]
pub fn map<K: Kernel<I, O>, const I: usize, const O: usize>(
    kernel: &K,
    inputs: [&[f32]; I],
    outputs: [&mut [f32]; O],
) {
    #[cfg(feature = "simd")]
    fearless_simd::dispatch!(best_level(), simd => {
        let pair = RegisterPair(Registers::new(simd));
        if K::LONG {
            fill(RegisterPair(pair), kernel, inputs, outputs);
        } else {
            fill(pair, kernel, inputs, outputs);
        }
    });
    #[cfg(not(feature = "simd"))]
    fill(Scalar, kernel, inputs, outputs);
}

/// Applies a kernel to arrays of equal length, register by register.
#[inline(always)]
fn fill<S: Arithmetic, K: Kernel<I, O>, const I: usize, const O: usize>(
    s: S,
    kernel: &K,
    inputs: [&[f32]; I],
    mut outputs: [&mut [f32]; O],
) {
    let len = inputs.first().map_or(0, |input| input.len());
    let mut at = 0;
    while at + S::LEN <= len {
        apply(s, kernel, &inputs, &mut outputs, at..at + S::LEN);
        at += S::LEN;
    }
    if at < len {
        apply(s, kernel, &inputs, &mut outputs, at..len);
    }
}

/// Applies a kernel to one register of the arrays, or to their remainder.
#[inline(always)]
fn apply<S: Arithmetic, K: Kernel<I, O>, const I: usize, const O: usize>(
    s: S,
    kernel: &K,
    inputs: &[&[f32]; I],
    outputs: &mut [&mut [f32]; O],
    range: Range<usize>,
) {
    let mut x = [s.float(0.0); I];
    for (x, input) in x.iter_mut().zip(inputs) {
        *x = s.load(input.get(range.clone()).unwrap_or_default());
    }
    for (y, output) in kernel.apply(s, x).into_iter().zip(outputs) {
        s.store(y, output.get_mut(range.clone()).unwrap_or_default());
    }
}
