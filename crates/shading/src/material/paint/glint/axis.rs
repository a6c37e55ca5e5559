//! Bins of one Gaussian coordinate, the leaves of a binary tree of intervals.

use asperity_ndf_sampling::{gaussian_cdf, inverse_gaussian_cdf};

use crate::math::{exp, floor, sqrt};

/// The largest sample; 10⁻¹⁶ of all Gaussian numbers are farther from 0.
const FARTHEST: f32 = 8.2;
/// The largest number of splits of an axis.
pub(super) const MAX_SPLITS: usize = 14;

/// Bins of one Gaussian coordinate.
///
/// The coordinate is split at 0, and each half is bisected until the bins have their width. The
/// outermost bins begin beyond 2.5 standard deviations and have no end.
#[derive(Clone, Copy, Debug)]
pub(super) struct Axis {
    width: f32,
    splits: usize,
}

/// A bin that covers a coordinate.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bin {
    /// The weight of the bin there. All weights at a coordinate have the sum 1.
    pub weight: f32,
    /// The probability of a coordinate in it.
    pub mass: f32,
    index: i32,
    splits: usize,
    /// The probability of the half farther from 0 at each split on the way to the bin.
    outer: [f32; MAX_SPLITS],
}

/// An interval above 0: its ends and the middle between them, and the width of its lower half.
#[derive(Clone, Copy)]
struct Interval {
    ends: [f32; 3],
    half: f32,
}

impl Axis {
    /// Bins of this width, within `[0.001, 1]`.
    pub(super) fn new(width: f32) -> Self {
        let (mut splits, mut end) = (1, width);
        while end < 5.0 && splits < MAX_SPLITS {
            (splits, end) = (splits + 1, 2.0 * end);
        }
        Self { width, splits }
    }

    /// The bins joined `level` times in pairs, at most until one is left.
    pub(super) fn joined(&self, level: usize) -> Self {
        let level = level.min(self.splits);
        Self { width: self.width * (1_u32 << level) as f32, splits: self.splits - level }
    }

    pub(super) const fn splits(&self) -> usize {
        self.splits
    }

    /// The index of the lowest bin; the highest has −1 minus it.
    const fn lowest(&self) -> i32 {
        if self.splits == 0 { 0 } else { -(1 << (self.splits - 1)) }
    }

    /// The index of the bin of a coordinate; NaN is in bin 0.
    pub(super) fn index(&self, z: f32) -> i32 {
        let lowest = self.lowest();
        (floor(z / self.width) as i32).clamp(lowest, (-1 - lowest).max(0))
    }

    /// The ends of a bin.
    fn ends(&self, index: i32) -> [f32; 2] {
        let lowest = self.lowest();
        let end = |index: i32| match index {
            i if i <= lowest => f32::NEG_INFINITY,
            i if i >= -lowest => f32::INFINITY,
            i => i as f32 * self.width,
        };
        [end(index), end(index + 1)]
    }

    /// The probability of the half of an interval after `split` splits that is farther from 0.
    ///
    /// Of the whole axis it is the upper half.
    pub(super) fn outer(&self, split: usize, index: i32) -> f32 {
        if split == 0 {
            return 0.5;
        }
        let interval = self.magnitude(split, index);
        narrow(interval).unwrap_or_else(|| {
            let [near, middle, far] = interval.ends.map(tail);
            ((middle - far) / (near - far)) as f32
        })
    }

    /// An interval after `split` splits, mirrored to the side above 0.
    fn magnitude(&self, split: usize, index: i32) -> Interval {
        let half = self.splits - split - 1;
        let inner = 2 * index.max(-1 - index);
        let width = self.width * (1_u32 << half) as f32;
        let far =
            if inner + 2 >= -self.lowest() >> half { f32::INFINITY } else { (inner + 2) as f32 * width };
        Interval { ends: [inner as f32 * width, (inner as f32 + 1.0) * width, far], half: width }
    }

    /// The half of an interval that is farther from 0, the upper one of the whole axis, or the other.
    pub(super) const fn child(split: usize, index: i32, outer: bool) -> i32 {
        if split == 0 { outer as i32 - 1 } else { 2 * index + (outer == (index >= 0)) as i32 }
    }

    /// The probability of a bin.
    fn mass(&self, index: i32) -> f32 {
        match self.ends(index) {
            [f32::NEG_INFINITY, f32::INFINITY] => 1.0,
            [low, f32::INFINITY] => tail(low) as f32,
            [f32::NEG_INFINITY, high] => tail(-high) as f32,
            _ => interval((index as f32 + 0.5) * self.width, self.width),
        }
    }

    /// The bin, with its probabilities if its flakes are `counted`.
    fn bin(&self, index: i32, counted: bool) -> Bin {
        let mut outer = [0.5; MAX_SPLITS];
        // The tails beyond both ends of the interval.
        let mut tails = [0.5, 0.0];
        let splits = if counted { self.splits } else { 0 };
        for (split, outer) in outer.iter_mut().enumerate().take(splits).skip(1) {
            let interval = self.magnitude(split, index >> (self.splits - split));
            *outer = narrow(interval).unwrap_or_else(|| {
                let middle = tail(interval.ends[1]);
                let share = (middle - tails[1]) / (tails[0] - tails[1]);
                tails[usize::from(!is_outer(index, self.splits, split))] = middle;
                share as f32
            });
        }
        Bin { weight: 1.0, mass: self.mass(index), index, splits: self.splits, outer }
    }

    /// The neighbor of a bin, with which it shares most intervals.
    fn neighbor(&self, own: &Bin, index: i32, mass: f32, counted: bool) -> Bin {
        let mut bin = Bin { mass, index, ..*own };
        for split in 1..if counted { self.splits } else { 0 } {
            let interval = index >> (self.splits - split);
            if interval != own.index >> (self.splits - split) {
                bin.outer[split] = self.outer(split, interval);
            }
        }
        bin
    }

    /// The bins at a coordinate. The second one has a weight near a border only.
    ///
    /// A bin is 1 inside and falls across each border, linearly in probability, over a quarter of
    /// the smaller neighbor to either side. Its integral is therefore its mass.
    ///
    /// Bins whose flakes are not `counted` have no probabilities of their halves.
    pub(super) fn bins(&self, z: f32, counted: bool) -> [Bin; 2] {
        let own = self.bin(self.index(z), counted);
        let alone = [own, Bin { weight: 0.0, ..own }];
        let [low, high] = self.ends(own.index);
        // The nearer border; the outermost bins have one.
        let (index, border, distance) =
            if z - low < high - z { (own.index - 1, low, z - low) } else { (own.index + 1, high, high - z) };
        if index < self.lowest() || index >= -self.lowest() || !z.is_finite() {
            return alone;
        }
        let mass = self.mass(index);
        let (ramp, within) = (0.25 * own.mass.min(mass), interval(0.5 * (z + border), distance.max(0.0)));
        if within >= ramp {
            return alone;
        }
        let weight = 0.5 - 0.5 * within / ramp;
        let neighbor = self.neighbor(&own, index, mass, counted);
        [Bin { weight: 1.0 - weight, ..own }, Bin { weight, ..neighbor }]
    }

    /// A coordinate of a bin, distributed by its weight.
    pub(super) fn sample(&self, index: i32, u: f32) -> f32 {
        let masses = [-1, 0, 1].map(|k| {
            let k = index + k;
            if k < self.lowest() || k >= -self.lowest() { 0.0 } else { self.mass(k) }
        });
        let [before, own, after] = masses;
        let [before, after] = [before, after].map(|neighbor| 0.25 * own.min(neighbor));
        let along = u * own;
        let along = if along < before {
            before * (2.0 * sqrt(along / before) - 1.0)
        } else if own - along < after {
            own - after * (2.0 * sqrt((own - along) / after) - 1.0)
        } else {
            along
        };
        // From the nearer tail, whose digits are not lost.
        let [low, high] = self.ends(index);
        let z = if index < 0 {
            inverse_gaussian_cdf(tail(-low) + f64::from(along))
        } else {
            -inverse_gaussian_cdf(tail(high) + f64::from(own - along))
        };
        (z as f32).clamp(-FARTHEST, FARTHEST)
    }
}

impl Bin {
    /// Whether the bin is in the half farther from 0 after `split` splits, and its probability.
    pub(super) const fn at(&self, split: usize) -> (bool, f32) {
        (is_outer(self.index, self.splits, split), self.outer[split])
    }

    pub(super) const fn index(&self) -> i32 {
        self.index
    }
}

/// The probability of the outer half of an interval of which both halves are narrow.
fn narrow(Interval { ends: [_, middle, far], half }: Interval) -> Option<f32> {
    (half * (middle + 2.5) <= 1.0 && far.is_finite()).then(|| {
        // exp(−m²/2) of both halves, m = middle ± half/2, and their series.
        let [near, far] = [-0.5, 0.5].map(|k| series(middle + k * half, half));
        far / (far + near * exp(middle * half))
    })
}

/// Whether a bin is in the half farther from 0, or above it, after `split` splits.
const fn is_outer(index: i32, splits: usize, split: usize) -> bool {
    let is_upper = split == 0 || (index >> (splits - split - 1)) & 1 != 0;
    is_upper == (index >= 0)
}

/// The probability of a standard Gaussian number beyond `z`.
fn tail(z: f32) -> f64 {
    gaussian_cdf(-f64::from(z))
}

/// The probability of a standard Gaussian number in an interval on one side of 0.
///
/// ```text
/// w φ(m) Σ_j He_2j(m) (w/2)^2j / (2j + 1)!,   m: the middle, w: the distance, He: polynomials of Hermite
/// ```
///
/// up to j = 3 for narrow intervals, accurate to 2·10⁻⁸ and the rounding of m².
fn interval(middle: f32, width: f32) -> f32 {
    if width * (middle.abs() + 2.0) <= 1.0 {
        const FRAC_1_SQRT_2PI: f32 = 0.398_942_3;
        return width * FRAC_1_SQRT_2PI * exp(-0.5 * middle * middle) * series(middle, width);
    }
    // The tail on the far side, so that differences of numbers near 1 do not lose it.
    let side = if middle < 0.0 { 1.0 } else { -1.0 };
    let [a, b] = [-0.5, 0.5].map(|k| gaussian_cdf(side * (f64::from(middle) + k * f64::from(width))));
    (b - a).abs() as f32
}

/// The sum over j of [`interval`].
fn series(middle: f32, width: f32) -> f32 {
    let (m2, w2) = (middle * middle, width * width * 0.25);
    let terms = [m2 - 1.0, (m2 - 6.0) * m2 + 3.0, ((m2 - 15.0) * m2 + 45.0) * m2 - 15.0];
    1.0 + w2 * (terms[0] / 6.0 + w2 * (terms[1] / 120.0 + w2 * (terms[2] / 5040.0)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn mass_is_the_difference_of_phi_at_the_ends() {
        for (width, k) in
            [0.001, 0.03, 0.1, 0.3, 0.49, 1.0].into_iter().flat_map(|w| (-60..60).map(move |k| (w, k as f32)))
        {
            let ends = [k, k + 1.0].map(|k| gaussian_cdf(-(f64::from(k) * f64::from(width)).abs()));
            let exact = if k < 0.0 { ends[1] - ends[0] } else { ends[0] - ends[1] };
            if exact > 1e-25 {
                let relative = f64::from(interval((k + 0.5) * width, width)) / exact.abs() - 1.0;
                // A rounding of the middle m, by dφ/φ = m² of it, and a few of the result; the
                // difference itself has 1e-15 of its ends.
                let m2 = f64::from((k + 0.5) * width).powi(2);
                let bound = 6e-8 * (m2 + 4.0) + 3e-16 * ends[0] / exact.abs();
                assert!(relative.abs() < bound, "{k}, {width}: {relative:e} of {bound:e}");
            }
        }
    }

    #[test]
    fn bins_are_a_partition_with_their_masses() {
        for axis in [0.001, 0.1, 0.37, 1.0].map(Axis::new).into_iter().flat_map(|a| [a, a.joined(2)]) {
            let (lowest, mut sum) = (axis.lowest(), 0.0);
            for index in lowest..-lowest {
                let bin = axis.bin(index, true);
                sum += f64::from(bin.mass);
                let product = (0..axis.splits()).fold(1.0, |product, split| {
                    let (is_outer, outer) = bin.at(split);
                    product * if is_outer { outer } else { 1.0 - outer }
                });
                // Farther out the difference of two tails loses digits.
                let is_near = bin.mass > 1e-12;
                assert!(
                    !is_near || (product / bin.mass - 1.0).abs() < 3e-5,
                    "{axis:?} {index}: {product} {}",
                    bin.mass
                );
            }
            assert_abs_diff_eq!(sum, 1.0, epsilon = 1e-6, "{axis:?}");
        }
        let one = Axis::new(0.3);
        let one = one.joined(one.splits());
        assert_eq!((one.bins(7.0, true)[0].mass, one.bins(7.0, true)[0].weight), (1.0, 1.0));
    }

    #[test]
    fn samples_of_a_bin_are_distributed_by_its_weight() {
        for axis in [Axis::new(0.4), Axis::new(1.0)] {
            for index in axis.lowest()..-axis.lowest() {
                // The integral of the weight up to a sample is its uniform number.
                for u in [0.01_f32, 0.03, 0.1, 0.5, 0.93, 0.99] {
                    let end = f64::from(axis.sample(index, u));
                    let steps = 4000;
                    let from = f64::from(axis.width) * (f64::from(index) - 1.0);
                    let from = if index == axis.lowest() { -9.0 } else { from };
                    let step = (end - from) / f64::from(steps);
                    let integral: f64 = (0..steps)
                        .map(|k| {
                            let z = from + (f64::from(k) + 0.5) * step;
                            let weight =
                                axis.bins(z as f32, true).into_iter().filter(|bin| bin.index == index);
                            let weight: f64 = weight.map(|bin| f64::from(bin.weight)).sum();
                            weight * (-0.5 * z * z).exp() / core::f64::consts::TAU.sqrt() * step
                        })
                        .sum();
                    let mass = f64::from(axis.bin(index, true).mass);
                    assert_abs_diff_eq!(integral / mass, f64::from(u), epsilon = 3e-3, "{axis:?} {index}");
                }
            }
        }
    }
}
