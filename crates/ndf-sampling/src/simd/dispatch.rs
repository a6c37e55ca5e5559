//! The SIMD level of this machine, and functions over arrays at it.

use crate::simd::lanes::{Lanes, Scalar};
#[cfg(feature = "simd")]
use crate::simd::register_pair::RegisterPair;
#[cfg(feature = "simd")]
use crate::simd::registers::Registers;

#[cfg(feature = "simd")]
type Instructions = fearless_simd::Level;
#[cfg(not(feature = "simd"))]
type Instructions = core::convert::Infallible;

/// The best instructions of this machine; without `std`, the best that the program was built for.
#[cfg(feature = "simd")]
pub(crate) fn best_level() -> Instructions {
    #[cfg(feature = "std")]
    return Instructions::new();
    #[cfg(not(feature = "std"))]
    return Instructions::baseline();
}

/// A SIMD level at which closed forms are evaluated over arrays: for tests and benches.
///
/// Plural calls such as [`Ggx::normals`](crate::Ggx::normals) take the best one; every level gives the same bits.
///
/// ```
/// use asperity_ndf_sampling::{Ggx, simd::Level};
///
/// let (ggx, z) = (Ggx::new(0.2, 0.4)?, [[0.7, -0.1, 2.0], [-1.2, 0.0, 0.3]]);
/// let [[mut x, mut y, mut up], [mut x1, mut y1, mut up1]] = [[[0.0; 3]; 3]; 2];
/// ggx.normals([&z[0], &z[1]], [&mut x, &mut y, &mut up])?;
/// Level::scalar().normals(&ggx, [&z[0], &z[1]], [&mut x1, &mut y1, &mut up1])?;
/// assert_eq!([x, y, up], [x1, y1, up1]);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Level {
    wide: Option<Instructions>,
}

impl Level {
    /// The widest lanes that this machine has; without `std`, as the program was built for; one without the feature `simd`.
    #[must_use]
    pub fn best() -> Self {
        #[cfg(feature = "simd")]
        let wide = Some(best_level());
        #[cfg(not(feature = "simd"))]
        let wide = None;
        Self { wide }
    }

    /// One lane, to be compared with.
    #[must_use]
    pub const fn scalar() -> Self {
        Self { wide: None }
    }

    /// Applies a kernel to arrays of one length.
    pub(crate) fn run<K: Kernel<I, O>, const I: usize, const O: usize>(
        self,
        kernel: &K,
        inputs: [&[f32]; I],
        outputs: [&mut [f32]; O],
    ) {
        match self.wide {
            #[cfg(feature = "simd")]
            Some(level) => {
                fearless_simd::dispatch!(level, simd => {
                    let pair = RegisterPair(Registers(simd));
                    if K::LONG {
                        fill(RegisterPair(pair), kernel, inputs, outputs);
                    } else {
                        fill(pair, kernel, inputs, outputs);
                    }
                });
            }
            #[cfg(not(feature = "simd"))]
            Some(never) => match never {},
            None => fill(Scalar, kernel, inputs, outputs),
        }
    }
}

/// A function of `I` numbers to `O`, in lanes.
pub(crate) trait Kernel<const I: usize, const O: usize> {
    /// Whether it is so long that four registers in step are faster than two.
    #[cfg(feature = "simd")]
    const LONG: bool = false;

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
        let mut x = [s.float(0.0); I];
        for (x, input) in x.iter_mut().zip(&inputs) {
            if let Some(input) = input.get(at..at + S::LEN) {
                *x = s.load(input);
            }
        }
        let y = kernel.apply(s, x);
        for (y, output) in y.iter().zip(&mut outputs) {
            if let Some(output) = output.get_mut(at..at + S::LEN) {
                s.store(*y, output);
            }
        }
        at += S::LEN;
    }
    if at < len {
        let mut x = [s.float(0.0); I];
        for (x, input) in x.iter_mut().zip(&inputs) {
            *x = s.load(input.get(at..).unwrap_or_default());
        }
        let y = kernel.apply(s, x);
        for (y, output) in y.iter().zip(&mut outputs) {
            s.store(*y, output.get_mut(at..).unwrap_or_default());
        }
    }
}
