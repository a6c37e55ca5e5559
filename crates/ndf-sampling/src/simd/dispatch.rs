//! The SIMD level of this machine, and functions over arrays in its lanes.

use core::ops::Range;

use crate::simd::lanes::Lanes;
#[cfg(feature = "simd")]
use crate::simd::register_pair::RegisterPair;
#[cfg(feature = "simd")]
use crate::simd::registers::Registers;

/// The best instructions of this machine; without `std`, the best that the program was built for.
#[cfg(feature = "simd")]
pub(crate) fn best_level() -> fearless_simd::Level {
    #[cfg(feature = "std")]
    return fearless_simd::Level::new();
    #[cfg(not(feature = "std"))]
    return fearless_simd::Level::baseline();
}

/// The best instructions for so many numbers: what does not fill long registers waits less for shorter ones.
#[cfg(feature = "simd")]
#[cfg_attr(
    not(target_arch = "x86_64"),
    expect(unused_variables, reason = "registers elsewhere have one length")
)]
pub(crate) fn level_for(count: usize) -> fearless_simd::Level {
    let best = best_level();
    #[cfg(target_arch = "x86_64")]
    if count <= 16 {
        return best.as_avx2().map_or(best, fearless_simd::Level::Avx2);
    }
    best
}

/// Calls `f` with every level that this machine has.
#[cfg(all(test, feature = "simd"))]
pub(crate) fn each_level(mut f: impl FnMut(fearless_simd::Level)) {
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

/// Applies a kernel to arrays of one length, in the widest lanes that there are; in one without the feature `simd`.
pub(crate) fn run<K: Kernel<I, O>, const I: usize, const O: usize>(
    kernel: &K,
    inputs: [&[f32]; I],
    outputs: [&mut [f32]; O],
) {
    #[cfg(feature = "simd")]
    fearless_simd::dispatch!(best_level(), simd => {
        let pair = RegisterPair(Registers(simd));
        if K::LONG {
            fill(RegisterPair(pair), kernel, inputs, outputs);
        } else {
            fill(pair, kernel, inputs, outputs);
        }
    });
    #[cfg(not(feature = "simd"))]
    fill(crate::simd::lanes::Scalar, kernel, inputs, outputs);
}

/// A function of `I` numbers to `O`, in lanes.
pub(crate) trait Kernel<const I: usize, const O: usize> {
    /// Whether it is so long that four registers in step are faster than two.
    #[cfg(feature = "simd")]
    const LONG: bool;

    fn apply<S: Lanes>(&self, s: S, x: [S::F; I]) -> [S::F; O];
}

/// Applies a kernel to arrays of one length, a register after the other.
#[inline(always)]
fn fill<S: Lanes, K: Kernel<I, O>, const I: usize, const O: usize>(
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

/// Applies a kernel to a register of the arrays, or to what is left of them.
#[inline(always)]
fn apply<S: Lanes, K: Kernel<I, O>, const I: usize, const O: usize>(
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
