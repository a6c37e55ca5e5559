//! The octaves of one point in lanes: as many at once as there are lanes, then added up one after the other.
//!
//! A lane has the bits that the octave has alone, and the sum its written order, so that the sum has the bits that it has where octaves
//! are evaluated one by one.

use crate::{
    contract::kernel::{self, Kernel},
    kinds::cell::blend::splat,
    kinds::gaussian::{BOTH, Channels, Gaussian},
    lanes::lanes::{LANES, LaneSample, Lanes, Scalar},
    lanes::level::Task,
    lattice::lattice::Lattice,
    sums::octave::Layers,
    sums::shape::Shape,
    sums::spectrum::MAX_OCTAVES,
};

/// The octaves of a sum at a point.
pub(crate) struct AtPoint<'a, K, const N: usize, T> {
    pub(crate) noise: &'a K,
    pub(crate) shape: T,
    pub(crate) layers: &'a Layers<N>,
    pub(crate) amplitudes: &'a [f32; MAX_OCTAVES as usize],
    pub(crate) count: usize,
    pub(crate) p: [f32; N],
}

/// Value and gradient of a sum, before its factor.
type Sum<const N: usize> = LaneSample<Scalar, N>;

impl<'a, K, const N: usize, T> AtPoint<'a, K, N, T> {
    /// The task of adding the octaves to a sum, with their gradients if `GRADIENTS`.
    #[inline(always)]
    pub(crate) fn sum<const GRADIENTS: bool>(self, sum: &'a mut Sum<N>) -> Added<'a, K, N, T, GRADIENTS> {
        Added { at_point: self, sum }
    }
}

/// Octaves of a point, added to a sum.
pub(crate) struct Added<'a, K, const N: usize, T, const GRADIENTS: bool> {
    at_point: AtPoint<'a, K, N, T>,
    sum: &'a mut Sum<N>,
}

/// Terms of a sum: amplitude times value and gradient of the octaves in lanes.
struct Terms<const N: usize> {
    value: [f32; LANES],
    gradient: [[f32; LANES]; N],
}

impl<const N: usize> Terms<N> {
    #[inline(always)]
    fn new<S: Lanes, const GRADIENTS: bool>(
        s: S,
        amplitude: S::F,
        (value, gradient): LaneSample<S, N>,
    ) -> Self {
        let mut terms = Self { value: [0.0; LANES], gradient: [[0.0; LANES]; N] };
        s.store(amplitude * value, &mut terms.value);
        for axis in 0..if GRADIENTS { N } else { 0 } {
            s.store(amplitude * gradient[axis], &mut terms.gradient[axis]);
        }
        terms
    }

    /// Adds the term of a lane.
    #[inline(always)]
    fn add<const GRADIENTS: bool>(&self, sum: &mut Sum<N>, lane: usize) {
        sum.0 += self.value[lane % LANES];
        for axis in 0..if GRADIENTS { N } else { 0 } {
            sum.1[axis] += self.gradient[axis][lane % LANES];
        }
    }
}

impl<K: Kernel<N>, const N: usize, T: Shape, const GRADIENTS: bool> Task for Added<'_, K, N, T, GRADIENTS> {
    #[inline(always)]
    fn run<S: Lanes>(self, s: S) {
        let AtPoint { noise, shape, layers, amplitudes, count, p } = self.at_point;
        let mut sum = *self.sum;
        let p = splat(s, p);
        for first in (0..count).step_by(S::LEN) {
            let part = first..first + S::LEN;
            let floats =
                |numbers: &[f32; MAX_OCTAVES as usize]| s.load(numbers.get(part.clone()).unwrap_or_default());
            let words = |words: &[u32; MAX_OCTAVES as usize]| {
                s.load_words(words.get(part.clone()).unwrap_or_default())
            };
            let (map, keys) = layers.in_lanes(s, floats, words);
            let (mut value, mut gradient) =
                kernel::evaluate::<K, S::Keyed, N, GRADIENTS>(noise, s.keyed(keys), map.points(p), 0);
            if !T::IS_IDENTITY {
                let n = value;
                value = s.floats(|lane| shape.value(s.lane(n, lane)));
                if GRADIENTS {
                    let slope = s.floats(|lane| shape.slope(s.lane(n, lane)));
                    for axis in 0..N {
                        gradient[axis] = slope * gradient[axis];
                    }
                }
            }
            if GRADIENTS {
                gradient = map.pull_back(gradient);
            }
            let terms = Terms::new::<S, GRADIENTS>(s, floats(amplitudes), (value, gradient));
            for lane in 0..S::LEN.min(count - first) {
                terms.add::<GRADIENTS>(&mut sum, lane);
            }
        }
        *self.sum = sum;
    }
}

/// Both channels of the octaves of a point, added to their sums: lanes of the lower half have the first channel, the others the second.
pub(crate) struct Pair<'a, L, const N: usize, T> {
    pub(crate) at_point: AtPoint<'a, Gaussian<L>, N, T>,
    pub(crate) sums: &'a mut [Sum<N>; 2],
}

impl<L: Lattice, const N: usize, T> Task for Pair<'_, L, N, T> {
    #[inline(always)]
    fn run<S: Lanes>(self, s: S) {
        let AtPoint { noise, layers, amplitudes, count, p, .. } = self.at_point;
        let half = S::LEN / 2;
        if half == 0 {
            return;
        }
        let (channels, lanes) = (Channels(noise), splat(s, p));
        let mut sums = *self.sums;
        // A few octaves are faster one by one, where their corners fill the lanes.
        let few = if S::LEN == BOTH && N > 2 { 2 } else { 1 };
        let mut first = 0;
        while first < count {
            if count - first <= few {
                let layer = layers.layer(first);
                let pair = noise.channels_in_lanes(s, layer.points(Scalar, p), layer.seed);
                for (sum, sample) in sums.iter_mut().zip(pair) {
                    layer.accumulate(Scalar, sum, amplitudes[first % amplitudes.len()], sample);
                }
                first += 1;
                continue;
            }
            let part = first..first + half;
            let floats = |numbers: &[f32; MAX_OCTAVES as usize]| {
                let numbers = numbers.get(part.clone()).unwrap_or_default();
                s.floats(|lane| numbers.get(lane % half).copied().unwrap_or(0.0))
            };
            let words = |words: &[u32; MAX_OCTAVES as usize]| {
                let words = words.get(part.clone()).unwrap_or_default();
                s.words(|lane| words.get(lane % half).copied().unwrap_or(0))
            };
            let (map, keys) = layers.in_lanes(s, floats, words);
            let (value, gradient) =
                kernel::evaluate::<_, S::Keyed, N, true>(&channels, s.keyed(keys), map.points(lanes), 0);
            let sample = (value, map.pull_back(gradient));
            let terms = Terms::new::<S, true>(s, floats(amplitudes), sample);
            for lane in 0..half.min(count - first) {
                terms.add::<true>(&mut sums[0], lane);
                terms.add::<true>(&mut sums[1], half + lane);
            }
            first += half;
        }
        *self.sums = sums;
    }
}
