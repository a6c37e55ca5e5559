//! Value-gradient noise, normalized to be exactly Gaussian at every point.

use asperity_core::lanes::Task;

use crate::{
    contract::compiled::{in_dimension, is_compiled},
    contract::kernel::{self, Measured, OctaveSamples, OctavesAt},
    contract::noise::{kind, measured, noise, tiles},
    kinds::cell::at_ends::by_corners,
    kinds::cell::corner::{CellNoise, Corner, normalized},
    kinds::cell::corners::CellPosition,
    kinds::cell::kernel::{of_lane, parts},
    lanes::level::run_at_point,
    lanes::{Arithmetic, LaneSample, Lanes, Scalar},
    lattice::integer_hash::IntegerHash,
    lattice::lattice::{IS_FULL, Lattice, OnLattice, REACH, is_within, wrapped},
    lattice::variates::{gaussian_variates, gaussian_variates_of_both},
    point::Point,
    sample::Sample,
    statistics::statistics::Statistics,
    statistics::tables,
};

/// Noise with the distribution N(0, 1) at every point; C² before and after normalization.
///
#[cfg_attr(doc, doc = include_str!("../../docs/pictures/gaussian.md"))]
///
/// ```text
/// n(p) = Σ_c W_c(p) (s_c + 2 g_c·(p − c)),   v(p) = Σ_c W_c(p)² (1 + 4 |p − c|²),   z = n/√v
/// ```
///
/// Each corner c of the cell carries independent N(0, 1) variates, a value s_c and a gradient g_c.
/// W are the products of 6t⁵ − 15t⁴ + 10t³. At a given p, n is a linear combination of Gaussian
/// variates with variance v. Its quotient z = n/√v is therefore N(0, 1) at lattice points, in cell
/// centers and between, in 1 to 4 dimensions. v ranges from 0.75 to 1.07 in 2-D and from 0.5 to
/// 1.09 in 3-D, with the minimum in cell centers.
///
/// - **Variates:** values have 32 bits, and their tails are normal up to 5.5 deviations, with
///   P(|s| > x) within 0.6 % of the normal distribution. Gradients have 4096 equally likely levels
///   with second and fourth moment 1 and 3.
/// - **Tails:** at lattice points they are the tails of the values. Elsewhere the bounded levels
///   reduce P(|z| > 4) by up to 0.4 % and P(|z| > 5) by up to 3.1 %. The loss is largest in the
///   middle of edges and negligible in the middle of cells in 3-D.
/// - **Gradient:** ∇z = (∇n − n ∇v/(2v))/√v.
/// - **Range:** all of ℝ up to the variates' bits: |s| ≤ 6.24, |g| ≤ 3.78.
///
/// ```
/// use asperity_noise::{Field, GaussianNoise, glam::Vec3};
///
/// let mean_square = (0..10_000).map(|seed| GaussianNoise::new(seed).value(Vec3::ZERO).powi(2)).sum::<f32>() / 10_000.0;
/// assert!((mean_square - 1.0).abs() < 0.05);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GaussianNoise<L = IntegerHash> {
    seed: u32,
    lattice: L,
}

kind!(GaussianNoise);
measured!(GaussianNoise, |self| &tables::GAUSSIAN);
noise!(GaussianNoise, curved);
tiles!(GaussianNoise);

impl GaussianNoise {
    /// Returns the Gaussian value and gradient that the noise draws from a lattice point's
    /// [`word`](crate::Lattice::word), for both channels.
    #[must_use]
    pub fn variates<const N: usize>(word: u32) -> [(f32, [f32; N]); 2] {
        let word = Scalar.word(word);
        [gaussian_variates::<_, N, 0>(Scalar, word), gaussian_variates::<_, N, 1>(Scalar, word)]
            .map(|(value, twice)| (value, twice.map(|g| 0.5 * g)))
    }
}

impl<L: Lattice> GaussianNoise<L> {
    /// Evaluates two independent channels in one pass over the lattice.
    ///
    /// The first channel is [`sample`](crate::Field::sample). The second has its own variates at
    /// each corner. Both use the same cells, weights and hashes, so that the pair costs less than
    /// two noises.
    #[must_use]
    #[inline]
    pub fn pair<V: Point<Coordinates = [f32; N]>, const N: usize>(&self, p: V) -> [Sample<V>; 2] {
        let p = p.coordinates();
        let pair =
            if const { is_compiled::<L>(N) } { (forms().pair)(&self.standard(), p) } else { self.pair_at(p) };
        pair.map(|(value, gradient)| Sample { value, gradient: V::from_coordinates(gradient) })
    }

    /// Returns n, the noise before normalization, with its gradient; both 0 if p is not finite.
    #[must_use]
    #[inline]
    pub fn unnormalized<V: Point<Coordinates = [f32; N]>, const N: usize>(&self, p: V) -> Sample<V> {
        self.parts_at(p)[0]
    }

    /// Returns v, the variance of n over all seeds, with its gradient; both 0 if p is not finite.
    #[must_use]
    #[inline]
    pub fn variance<V: Point<Coordinates = [f32; N]>, const N: usize>(&self, p: V) -> Sample<V> {
        self.parts_at(p)[1]
    }

    fn parts_at<V: Point<Coordinates = [f32; N]>, const N: usize>(&self, p: V) -> [Sample<V>; 2] {
        wrapped(p.coordinates()).map_or([Sample::default(); 2], |p| {
            let (noise, variance) = parts::<_, _, N, true>(Scalar, self, p, self.seed);
            [noise, variance]
                .map(|(value, gradient)| Sample { value, gradient: V::from_coordinates(gradient) })
        })
    }

    /// n with its gradient; both 0 if p is not finite.
    pub(crate) fn unnormalized_at<const N: usize>(&self, p: [f32; N], seed: u32) -> LaneSample<Scalar, N> {
        wrapped(p).map_or((0.0, [0.0; N]), |p| parts::<_, _, N, true>(Scalar, self, p, seed).0)
    }

    /// Both channels at an arbitrary point.
    #[inline(always)]
    pub(crate) fn channels<const N: usize>(&self, p: [f32; N], seed: u32) -> [LaneSample<Scalar, N>; 2] {
        if is_within(Scalar, &p, REACH) { self.near_channels(p, seed) } else { self.far_channels(p, seed) }
    }

    /// Both channels at an arbitrary point, with corners in lanes if there are four lanes for each
    /// channel.
    #[inline(always)]
    pub(crate) fn channels_in_lanes<S: Lanes, const N: usize>(
        &self,
        s: S,
        p: [f32; N],
        seed: u32,
    ) -> [LaneSample<Scalar, N>; 2] {
        if S::LEN != BOTH || N == 1 {
            return self.channels(p, seed);
        }
        if !is_within(Scalar, &p, REACH) {
            return self.far_channels(p, seed);
        }
        let both = by_corners::<_, S, N, true>(s, &Channels(self), p, seed);
        [0, BOTH / 2].map(|lane| of_lane::<S, N, true>(s, both, lane))
    }

    /// Both channels at a point whose coordinates all have a cell.
    #[inline(always)]
    fn near_channels<const N: usize>(&self, p: [f32; N], seed: u32) -> [LaneSample<Scalar, N>; 2] {
        let position = CellPosition::new(Scalar, self, &p, 0);
        // Each channel draws separately. Returning pairs costs more than the words that the
        // compiler reuses.
        let nothing = Corner::nothing(Scalar);
        let corners =
            position.corners(Scalar, self, seed, nothing, |word| corner::<Scalar, N, 0>(Scalar, word));
        let (first, variance) = position.parts_of::<Self>(Scalar, &corners);
        let corners =
            position.corners(Scalar, self, seed, nothing, |word| corner::<Scalar, N, 1>(Scalar, word));
        let (second, _) = position.parts_of::<Self>(Scalar, &corners);
        let normalized = |sample| normalized::<_, N, true>(Scalar, sample, variance);
        [normalized(first), normalized(second)]
    }

    #[cold]
    #[inline(never)]
    fn far_channels<const N: usize>(&self, p: [f32; N], seed: u32) -> [LaneSample<Scalar, N>; 2] {
        wrapped(p).map_or([(0.0, [0.0; N]); 2], |p| self.near_channels(p, seed))
    }
}

impl<L: Lattice> GaussianNoise<L> {
    /// Both channels of octaves at a point; `None` if there is only one lane.
    pub(crate) fn pairs_at<const N: usize>(
        &self,
        octaves: OctavesAt<'_, N>,
        samples: &mut [OctaveSamples<N>; 2],
    ) -> Option<()> {
        if const { is_compiled::<L>(N) } {
            return (forms::<N>().octaves)(&self.standard(), octaves, samples);
        }
        run_at_point(Pairs { noise: self, octaves, samples })
    }

    #[inline(always)]
    fn pair_at<const N: usize>(&self, p: [f32; N]) -> [LaneSample<Scalar, N>; 2] {
        let mut pair = [(0.0, [0.0; N]); 2];
        if run_at_point(Lone { noise: self, p, pair: &mut pair }).is_none() {
            pair = self.channels(p, self.seed);
        }
        pair
    }
}

/// The evaluations of both channels, compiled once like the evaluations of one channel.
struct PairForms<const N: usize> {
    pair: fn(&GaussianNoise, [f32; N]) -> [LaneSample<Scalar, N>; 2],
    octaves: fn(&GaussianNoise, OctavesAt<'_, N>, &mut [OctaveSamples<N>; 2]) -> Option<()>,
}

impl<const N: usize> PairForms<N> {
    const ALL: Self = if IS_FULL {
        Self {
            pair: |noise, p| noise.pair_at(p),
            octaves: |noise, octaves, samples| run_at_point(Pairs { noise, octaves, samples }),
        }
    } else {
        Self::NONE
    };
    const NONE: Self = Self { pair: |_, _| [(0.0, [0.0; N]); 2], octaves: |_, _, _| None };
}

#[inline(always)]
fn forms<const N: usize>() -> &'static PairForms<N> {
    static LINE: PairForms<1> = PairForms::ALL;
    static PLANE: PairForms<2> = PairForms::ALL;
    static SPACE: PairForms<3> = PairForms::ALL;
    in_dimension::<_, N>([&LINE, &PLANE, &SPACE]).unwrap_or(const { &PairForms::NONE })
}

impl<L: Lattice, const N: usize> CellNoise<N> for GaussianNoise<L> {
    type Standard = GaussianNoise;

    #[inline(always)]
    fn standard(&self) -> GaussianNoise {
        Self::standard(self)
    }

    const NORMALIZED: bool = true;

    #[inline(always)]
    fn corner<S: Lanes>(&self, s: S, word: S::U) -> Corner<S, N> {
        corner::<S, N, 0>(s, word)
    }
}

/// The number of lanes that both channels of a point fill with corners.
pub(crate) const BOTH: usize = 8;

/// The evaluation of both channels of octaves of a point.
///
/// Lanes of the lower half have the first channel, the others the second.
struct Pairs<'a, L, const N: usize> {
    noise: &'a GaussianNoise<L>,
    octaves: OctavesAt<'a, N>,
    samples: &'a mut [OctaveSamples<N>; 2],
}

impl<L: Lattice, const N: usize> Task for Pairs<'_, L, N> {
    type Output = ();

    #[inline(always)]
    fn run<S: Lanes>(self, s: S) {
        let Self { noise, octaves: OctavesAt { points, seeds, keys, count, .. }, samples } = self;
        let half = S::LEN / 2;
        if half == 0 {
            return;
        }
        // A few octaves are faster one by one, where their corners fill the lanes.
        let few = if S::LEN == BOTH && N > 2 { 2 } else { 1 };
        let mut first = 0;
        while first < count {
            if count - first <= few {
                let mut p = [0.0; N];
                for axis in 0..N {
                    p[axis] = points[axis][first % points[axis].len()];
                }
                let pair = noise.channels_in_lanes(s, p, seeds[first % seeds.len()]);
                for (samples, sample) in samples.iter_mut().zip(pair) {
                    samples.set(first, sample);
                }
                first += 1;
                continue;
            }
            let part = first..first + half;
            let mut p = [s.float(0.0); N];
            for axis in 0..N {
                let numbers = points[axis].get(part.clone()).unwrap_or_default();
                p[axis] = s.floats(|lane| numbers.get(lane % half).copied().unwrap_or(0.0));
            }
            let words = keys.get(part.clone()).unwrap_or_default();
            let keys = s.words(|lane| words.get(lane % half).copied().unwrap_or(0));
            let (value, gradient) =
                kernel::evaluate::<_, S::Keyed, N, true>(&Channels(noise), s.keyed(keys), p, 0);
            for lane in 0..half.min(count - first) {
                for (samples, lane) in samples.iter_mut().zip([lane, half + lane]) {
                    samples.set(first + lane % half, of_lane::<S, N, true>(s, (value, gradient), lane));
                }
            }
            first += half;
        }
    }
}

struct Lone<'a, L, const N: usize> {
    noise: &'a GaussianNoise<L>,
    p: [f32; N],
    pair: &'a mut [LaneSample<Scalar, N>; 2],
}

impl<L: Lattice, const N: usize> Task for Lone<'_, L, N> {
    type Output = ();

    #[inline(always)]
    fn run<S: Lanes>(self, s: S) {
        *self.pair = self.noise.channels_in_lanes(s, self.p, self.noise.seed);
    }
}

/// Both channels at once: lanes of the lower half have the first channel, the others the second.
pub(crate) struct Channels<'a, L>(pub(crate) &'a GaussianNoise<L>);

impl<L: Lattice> OnLattice for Channels<'_, L> {
    type Lattice = L;

    #[inline(always)]
    fn lattice(&self) -> &L {
        self.0.lattice()
    }
}

impl<L: Lattice, const N: usize> Measured<N> for Channels<'_, L> {
    fn seed(&self) -> u32 {
        self.0.seed
    }

    fn statistics(&self) -> &'static Statistics {
        Measured::<N>::statistics(self.0)
    }
}

impl<L: Lattice, const N: usize> CellNoise<N> for Channels<'_, L> {
    type Standard = GaussianNoise;

    fn standard(&self) -> GaussianNoise {
        self.0.standard()
    }

    const NORMALIZED: bool = true;

    #[inline(always)]
    fn corner<S: Lanes>(&self, s: S, word: S::U) -> Corner<S, N> {
        let (value, gradient) = gaussian_variates_of_both(s, word);
        Corner { value, gradient }
    }
}

#[inline(always)]
fn corner<S: Lanes, const N: usize, const CHANNEL: u32>(s: S, word: S::U) -> Corner<S, N> {
    let (value, gradient) = gaussian_variates::<S, N, CHANNEL>(s, word);
    Corner { value, gradient }
}
