//! A function along the first axis of a cell, blended from the columns at its ends.

use crate::{cell_noise::CellNoise, lanes::Lanes};

#[inline(always)]
pub(crate) fn lerp<S: Lanes>(a: S::F, b: S::F, w: S::F) -> S::F {
    a + w * (b - a)
}

#[inline(always)]
pub(crate) fn splat<S: Lanes, const N: usize>(s: S, x: [f32; N]) -> [S::F; N] {
    let mut lanes = [s.float(0.0); N];
    for axis in 0..N {
        lanes[axis] = s.float(x[axis]);
    }
    lanes
}

/// A₀, B₀, ΔA and ΔB of a function along a row within one cell.
#[derive(Clone, Copy)]
pub(crate) struct Span<S: Lanes> {
    pub(crate) a: S::F,
    pub(crate) b: S::F,
    pub(crate) rise_a: S::F,
    pub(crate) rise_b: S::F,
}

impl<S: Lanes> Span<S> {
    #[inline(always)]
    pub(crate) fn new<const GRADIENT: bool>([a0, b0]: [S::F; 2], [a1, b1]: [S::F; 2]) -> Self {
        if GRADIENT {
            Self { a: a0, b: b0, rise_a: a1 - a0, rise_b: (b1 - a1) - b0 }
        } else {
            Self { a: a0, b: b0, rise_a: a0, rise_b: b1 - b0 }
        }
    }

    /// What w is multiplied with at t.
    #[inline(always)]
    fn rise<const GRADIENT: bool>(&self, t: S::F) -> S::F {
        if GRADIENT { self.rise_a * t + self.rise_b } else { self.rise_b }
    }

    #[inline(always)]
    fn low<const GRADIENT: bool>(&self, t: S::F) -> S::F {
        if GRADIENT { self.a * t + self.b } else { self.b }
    }

    #[inline(always)]
    pub(crate) fn value<K: CellNoise<N>, const N: usize>(&self, t: S::F, w: S::F) -> S::F {
        if K::HAS_GRADIENT {
            self.low::<true>(t) + w * self.rise::<true>(t)
        } else {
            self.low::<false>(t) + w * self.rise::<false>(t)
        }
    }

    /// ∂²/∂t².
    #[inline(always)]
    pub(crate) fn second_derivative<K: CellNoise<N>, const N: usize>(
        &self,
        t: S::F,
        slope: S::F,
        bend: S::F,
    ) -> S::F {
        if K::HAS_GRADIENT {
            let twist = slope * self.rise_a;
            (twist + twist) + bend * self.rise::<true>(t)
        } else {
            bend * self.rise::<false>(t)
        }
    }

    /// ∂/∂t.
    #[inline(always)]
    pub(crate) fn derivative<K: CellNoise<N>, const N: usize>(&self, t: S::F, w: S::F, slope: S::F) -> S::F {
        if K::HAS_GRADIENT {
            (self.a + w * self.rise_a) + slope * self.rise::<true>(t)
        } else {
            slope * self.rise::<false>(t)
        }
    }
}
