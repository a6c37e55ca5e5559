//! The SIMD-generic interface of noise kinds, shared by single points, rows and lists.

use core::{array, ops::Range};

use asperity_core::lanes::Task;

use crate::{
    lanes::level::{Instructions, has_values_alone, run_at_point},
    lanes::{LANES, LaneSample, Lanes, Scalar, lane_of, splat},
    lattice::lattice::{REACH, is_within, wrapped},
    point::Point,
    row::cells::{POINTS, has_columns},
    row::points::{Points, Source, Target, buffers, by_axes},
    row::row::{Row, Strip, no_slices},
    statistics::statistics::Statistics,
};

/// Seed and measured statistics of a kind of noise of this crate.
pub trait Measured<const N: usize> {
    /// The seed of the noise; octaves have their own seeds.
    fn seed(&self) -> u32;

    /// The measured statistics of the kind in this dimension.
    fn statistics(&self) -> &'static Statistics;

    /// σ₁, the standard deviation of this noise with its parameters.
    fn standard_deviation(&self) -> f32 {
        self.statistics().standard_deviation
    }

    /// The mean of one octave over all points and seeds.
    fn mean(&self) -> f32 {
        0.0
    }

    /// Lower and upper bound of the values of this noise.
    fn bounds(&self) -> [f32; 2] {
        let range = self.statistics().range;
        [-range, range]
    }

    /// E|n|, E|n|², E|n|³ and E|n|⁴ of one octave over all points and seeds.
    ///
    /// The mean of a [`Shape`](crate::Shape) follows from them.
    fn absolute_moments(&self) -> [f32; 4] {
        self.statistics().absolute_moments
    }
}

/// A kind of noise in N dimensions, written over [`Lanes`].
///
/// Points have finite coordinates of at most 2³¹ in magnitude. Every method returns the same bits
/// for a point. This trait is sealed. Implement [`Field`](crate::Field) for custom noise.
#[diagnostic::on_unimplemented(
    message = "`{Self}` is not a kind of noise in {N} dimensions",
    note = "octaves sum kinds of this crate, for instance `Perlin`; any field can be added, multiplied, blended, clamped, \
            mapped and warped"
)]
pub trait Kernel<const N: usize>: Measured<N> {
    /// The sum Σ |xᵢ| from which on the noise is 0.
    ///
    /// By default coordinates extend to ∞, with cells modulo 2³².
    const REACH: f32 = REACH;

    /// Whether the noise is tileable.
    const TILED: bool = false;
    /// Whether cells are simplices of the skewed lattice.
    const SIMPLICIAL: bool = false;

    /// Whether lists are faster in sixteen lanes than in eight.
    const WIDE: bool = true;

    /// The step along a row from which on rows no longer reuse enough work; 0 if they never do.
    const LONG_STEP: f32 = 0.0;

    /// The number of octaves from which on the octaves of a point are evaluated in lanes, each with
    /// its own key.
    const OCTAVES_IN_LANES: usize = usize::MAX;

    /// Intermediate results that successive rows of a grid reuse.
    type RowScratch: Default;

    /// The period along an axis, or 0 for an axis without a period.
    fn period(&self, _axis: usize) -> u32 {
        0
    }

    /// The factor of the offsets of octaves, which are below 1.
    fn spread(&self) -> f32 {
        1.0
    }

    /// The key that the lattice derives from a seed, used to draw words.
    fn key(&self, seed: u32) -> u32 {
        seed
    }

    /// The noise of an octave of a sum, on its own lattice; `None` if it is the noise itself.
    #[inline(always)]
    fn of_octave(&self, _frequency: f32, _cell: &[i32]) -> Option<Self>
    where
        Self: Sized,
    {
        None
    }

    /// A copy of the noise for lists of values.
    ///
    /// `Some` if the noise has parameters to keep in registers and a lattice without memory.
    #[inline(always)]
    fn copied(&self) -> Option<Self>
    where
        Self: Sized,
    {
        None
    }

    /// The values at points, and the gradients if `GRADIENTS`; otherwise the gradients are
    /// unspecified.
    fn evaluate<S: Lanes, const GRADIENTS: bool>(&self, s: S, p: [S::F; N], seed: u32) -> LaneSample<S, N>;

    /// The value at one point, and the gradient if `GRADIENTS`, with the same bits.
    #[inline(always)]
    fn lone<const GRADIENTS: bool>(&self, p: [f32; N], seed: u32) -> LaneSample<Scalar, N> {
        self.evaluate::<Scalar, GRADIENTS>(Scalar, p, seed)
    }

    /// The value at any point.
    #[inline]
    fn value_at(&self, p: [f32; N], seed: u32) -> f32 {
        lone::<Self, N, false>(self, p, seed).0
    }

    /// Value and gradient at any point.
    #[inline]
    fn sample_at(&self, p: [f32; N], seed: u32) -> LaneSample<Scalar, N> {
        lone::<Self, N, true>(self, p, seed)
    }

    /// Evaluates a row at a SIMD level.
    fn fill_row(call: FillRow<'_, Self, N>, instructions: Instructions)
    where
        Self: Sized,
    {
        call.at(instructions);
    }

    /// Evaluates a list at a SIMD level.
    fn fill_list(call: FillList<'_, Self, N>, instructions: Instructions)
    where
        Self: Sized,
    {
        call.at(instructions);
    }

    /// Evaluates octaves at a point, one per lane; `None` if there is only one lane.
    fn octaves_at(&self, octaves: OctavesAt<'_, N>, samples: &mut OctaveSamples<N>) -> Option<()>
    where
        Self: Sized,
    {
        octaves.evaluate(self, samples)
    }

    /// Whether a row of `count` points saves more than it costs by reusing work along it or in the
    /// next row.
    ///
    /// `wide` is set if lists have sixteen lanes. Rows have at most eight. Where few points are in
    /// a cell, sixteen lanes make `Perlin` faster by a fifth and `PerlinClassic` by two fifths.
    #[inline(always)]
    fn reuses(&self, row: &Row<N>, count: usize, _wide: bool) -> bool {
        has_columns(row, count, Self::LONG_STEP)
    }

    /// The values along a row that [reuses](Self::reuses) work, and the gradients if `GRADIENTS`.
    ///
    /// Returns the number of leading points that were evaluated. The others are evaluated as a
    /// list.
    #[inline(always)]
    fn rows<S: Lanes, const GRADIENTS: bool>(
        &self,
        _: S,
        _: &mut Self::RowScratch,
        _: Strip<'_, N, GRADIENTS>,
    ) -> usize {
        0
    }
}

/// The maximum number of octaves of a point.
const OCTAVES: usize = 16;

/// A point in the coordinates of octaves, each with its own key.
#[derive(Clone, Copy, Debug)]
pub struct OctavesAt<'a, const N: usize> {
    pub(crate) points: &'a [[f32; OCTAVES]; N],
    pub(crate) seeds: &'a [u32; OCTAVES],
    pub(crate) keys: &'a [u32; OCTAVES],
    pub(crate) count: usize,
}

/// The values and gradients of octaves; entries beyond the number of octaves are unspecified.
#[derive(Clone, Copy, Debug)]
pub struct OctaveSamples<const N: usize> {
    pub(crate) values: [f32; OCTAVES],
    pub(crate) gradients: [[f32; OCTAVES]; N],
}

impl<const N: usize> OctaveSamples<N> {
    pub(crate) const ZERO: Self = Self { values: [0.0; OCTAVES], gradients: [[0.0; OCTAVES]; N] };

    /// Sets the sample of an octave.
    #[inline(always)]
    pub(crate) fn set(&mut self, octave: usize, (value, gradient): LaneSample<Scalar, N>) {
        self.values[octave % OCTAVES] = value;
        for axis in 0..N {
            self.gradients[axis][octave % OCTAVES] = gradient[axis];
        }
    }
}

impl<const N: usize> OctavesAt<'_, N> {
    /// Evaluates the octaves of a kind in lanes.
    pub(crate) fn evaluate<K: Kernel<N>>(self, kernel: &K, samples: &mut OctaveSamples<N>) -> Option<()> {
        run_at_point(EvaluateOctaves { kernel, octaves: self, samples })
    }

    /// Evaluates a register of octaves, from `first` on.
    #[inline(always)]
    fn put<S: Lanes, K: Kernel<N>>(self, s: S, kernel: &K, samples: &mut OctaveSamples<N>, first: usize) {
        let mut p = [s.float(0.0); N];
        for axis in 0..N {
            p[axis] = s.load(self.points[axis].get(first..).unwrap_or_default());
        }
        let keys = s.load_words(self.keys.get(first..).unwrap_or_default());
        let (value, gradient) = evaluate::<K, S::Keyed, N, true>(kernel, s.keyed(keys), p, 0);
        s.store(value, samples.values.get_mut(first..).unwrap_or_default());
        for axis in 0..N {
            s.store(gradient[axis], samples.gradients[axis].get_mut(first..).unwrap_or_default());
        }
    }
}

struct EvaluateOctaves<'a, K, const N: usize> {
    kernel: &'a K,
    octaves: OctavesAt<'a, N>,
    samples: &'a mut OctaveSamples<N>,
}

impl<K: Kernel<N>, const N: usize> Task for EvaluateOctaves<'_, K, N> {
    type Output = ();

    #[inline(always)]
    fn run<S: Lanes>(self, s: S) {
        let Self { kernel, octaves, samples } = self;
        for first in (0..octaves.count).step_by(S::LEN) {
            octaves.put::<S, K>(s, kernel, samples, first);
        }
    }
}

/// A kind whose sums can be evaluated relative to an anchor far from the origin.
pub trait Anchor<const N: usize>: Kernel<N> {
    /// The kind on a lattice whose cells are relative to the anchor's cell.
    type Shifted: Kernel<N>;

    /// The noise on such a lattice, before it is shifted.
    fn shifted(self) -> Self::Shifted;
}

/// Whether |xᵢ| < 2³⁰ for every axis.
///
/// Compares bits with integer arithmetic, which leaves the vector units to the noise.
#[inline(always)]
fn is_small<const N: usize>(p: &[f32; N]) -> bool {
    // The addition carries the bits of numbers from 2³⁰ on into the sign bit.
    const BELOW: u64 = 0x8000_0000 - 0x4e80_0000;
    let mut any = 0;
    for axis in (0..N).step_by(2) {
        let [x, y] = [axis, axis + 1].map(|axis| if axis < N { u64::from(p[axis].to_bits()) } else { 0 });
        any |= (x & 0x7fff_ffff | (y & 0x7fff_ffff) << 32) + (BELOW << 32 | BELOW);
    }
    any & 0x8000_0000_8000_0000 == 0
}

/// The value at any point, and the gradient if `GRADIENTS`.
///
/// A point beyond reach is first moved to a point with the same cells, so that the kind is compiled
/// once.
#[inline(always)]
pub(crate) fn lone<K: Kernel<N> + ?Sized, const N: usize, const GRADIENTS: bool>(
    kernel: &K,
    mut p: [f32; N],
    seed: u32,
) -> LaneSample<Scalar, N> {
    let mut known = true;
    if !(if K::REACH == REACH { is_small(&p) } else { is_within(Scalar, &p, K::REACH) }) {
        (p, known) = evaluated_far(p, K::REACH).map_or(([0.0; N], false), |p| (p, true));
    }
    let sample = kernel.lone::<GRADIENTS>(p, seed);
    if known { sample } else { (0.0, [0.0; N]) }
}

/// The values at arbitrary points, one per lane, and the gradients if `GRADIENTS`.
#[inline(always)]
pub(crate) fn evaluate<K: Kernel<N>, S: Lanes, const N: usize, const GRADIENTS: bool>(
    kernel: &K,
    s: S,
    mut p: [S::F; N],
    seed: u32,
) -> LaneSample<S, N> {
    let mut known = None;
    if !is_within(s, &p, K::REACH) {
        let (near, lanes) = within_reach(s, p, K::REACH);
        (p, known) = (near, Some(lanes));
    }
    let (mut value, mut gradient) = kernel.evaluate::<S, GRADIENTS>(s, p, seed);
    if let Some(known) = known {
        for axis in 0..if GRADIENTS { N } else { 0 } {
            gradient[axis] = s.keep(known, gradient[axis]);
        }
        value = s.keep(known, value);
    }
    (value, gradient)
}

/// Points with the same cells within reach, and the lanes that have one; 0 in the others.
#[inline(always)]
pub(crate) fn within_reach<S: Lanes, const N: usize>(s: S, p: [S::F; N], reach: f32) -> ([S::F; N], S::M) {
    let mut lanes = [None; LANES];
    for lane in 0..S::LEN {
        lanes[lane % LANES] = evaluated_far(lane_of(s, &p, lane), reach);
    }
    let mut near = p;
    for axis in 0..N {
        near[axis] = s.floats(|lane| lanes[lane % LANES].map_or(0.0, |p| p[axis]));
    }
    let known = s.floats(|lane| if lanes[lane % LANES].is_some() { 1.0 } else { 0.0 });
    (near, s.less(s.float(0.5), known))
}

/// The point itself if it is within reach, otherwise a point with the same cells.
///
/// `None` if the kind has no cells there.
#[inline]
pub(crate) fn evaluated<const N: usize>(p: [f32; N], reach: f32) -> Option<[f32; N]> {
    if is_within(Scalar, &p, reach) {
        Some(p)
    } else if reach < REACH {
        None
    } else {
        wrapped(p)
    }
}

#[cold]
#[inline(never)]
fn evaluated_far<const N: usize>(p: [f32; N], reach: f32) -> Option<[f32; N]> {
    evaluated(p, reach)
}

/// The values at points of a list, and the gradients if `GRADIENTS`.
///
/// A single lane uses the code of a single point, in which corners have the lanes. In a loop it has
/// too few registers.
#[inline(always)]
fn in_lanes<K: Kernel<N>, S: Lanes, const N: usize, const GRADIENTS: bool>(
    s: S,
    kernel: &K,
    p: [S::F; N],
    seed: u32,
) -> LaneSample<S, N> {
    if S::LEN > 1 {
        return kernel.evaluate::<S, GRADIENTS>(s, p, seed);
    }
    let (value, gradient) = kernel.lone::<GRADIENTS>(lane_of(s, &p, 0), seed);
    (s.float(value), splat(s, gradient))
}

/// A row of a kind, or of one of its octaves.
#[derive(Debug)]
pub struct FillRow<'a, K: Kernel<N>, const N: usize> {
    pub(crate) kernel: &'a K,
    pub(crate) seed: u32,
    pub(crate) row: Row<N>,
    pub(crate) scratch: &'a mut K::RowScratch,
    pub(crate) values: &'a mut [f32],
    /// One slice per axis, as long as `values`.
    pub(crate) gradients: Option<[&'a mut [f32]; N]>,
}

impl<K: Kernel<N>, const N: usize> FillRow<'_, K, N> {
    /// Evaluates the row at a SIMD level, the only code that is compiled for rows of a kind.
    pub(crate) fn at(mut self, instructions: Instructions) {
        let count = self.values.len();
        let reuses = self.kernel.reuses(&self.row, count, instructions.are_wide());
        let done = if reuses && self.row.is_within(K::REACH, count) {
            instructions.run_in_eight(Shared(&mut self))
        } else {
            0
        };
        if done < count {
            self.list(done..count, instructions);
        }
    }

    /// Evaluates points of the row as a list.
    #[inline(never)]
    fn list(&mut self, range: Range<usize>, instructions: Instructions) {
        let mut points = [[0.0; BLOCK]; N];
        for start in range.clone().step_by(BLOCK) {
            let part = start..range.end.min(start + BLOCK);
            let p = self.row.point(start);
            for axis in 1..N {
                points[axis][..part.len()].fill(p[axis]);
            }
            for (x, i) in points[0].iter_mut().zip(part.clone()) {
                *x = self.row.x(i);
            }
            let points = points.each_ref().map(|x| &x[..part.len()]);
            let gradients = self.gradients.as_mut();
            let gradients =
                gradients.map(|g| g.each_mut().map(|g| g.get_mut(part.clone()).unwrap_or_default()));
            let (kernel, seed, values) = (self.kernel, self.seed, &mut self.values[part.clone()]);
            K::fill_list(FillList { kernel, seed, points, values, gradients }, instructions);
        }
    }
}

/// A row that reuses work.
struct Shared<'r, 'a, K: Kernel<N>, const N: usize>(&'r mut FillRow<'a, K, N>);

impl<K: Kernel<N>, const N: usize> Task for Shared<'_, '_, K, N> {
    type Output = usize;

    #[inline(always)]
    fn run<S: Lanes>(self, s: S) -> usize {
        let FillRow { kernel, seed, row, scratch, values, gradients } = self.0;
        let (row, seed, mut slopes) = (*row, *seed, no_slices());
        if const { has_values_alone::<S>() } && gradients.is_none() {
            return kernel.rows(s, scratch, Strip::<N, false> { row, seed, values, gradients: slopes });
        }
        // Without gradients they go to empty slices.
        for (to, g) in slopes.iter_mut().zip(gradients.iter_mut().flatten()) {
            *to = &mut **g;
        }
        kernel.rows(s, scratch, Strip::<N, true> { row, seed, values, gradients: slopes })
    }
}

/// Points of a kind or of one of its octaves, from one list of coordinates per axis.
#[derive(Debug)]
pub struct FillList<'a, K: Kernel<N>, const N: usize> {
    pub(crate) kernel: &'a K,
    pub(crate) seed: u32,
    pub(crate) points: [&'a [f32]; N],
    pub(crate) values: &'a mut [f32],
    /// One slice per axis, as long as `values`.
    pub(crate) gradients: Option<[&'a mut [f32]; N]>,
}

impl<K: Kernel<N>, const N: usize> FillList<'_, K, N> {
    /// Evaluates the list at a SIMD level.
    pub(crate) fn at(self, instructions: Instructions) {
        let Self { kernel, seed, points, values, gradients } = self;
        fill_blocks(points, values, gradients, K::REACH, &mut |block| {
            let task = EvaluateBlock { kernel, seed, block };
            if K::WIDE { instructions.run(task) } else { instructions.run_in_eight(task) }
        });
    }
}

/// The number of points of a list that are evaluated without a branch in between.
const BLOCK: usize = 128;

/// A block of points, with space for their values and gradients.
struct Block<'a, const N: usize> {
    points: [&'a [f32; BLOCK]; N],
    values: &'a mut [f32; BLOCK],
    gradients: Option<[&'a mut [f32; BLOCK]; N]>,
    /// The number of points to evaluate, from the first on.
    len: usize,
    /// Whether all points were within reach; may be a false negative far from the origin.
    is_near: bool,
}

/// Evaluates a list by blocks.
///
/// Whole blocks of points near the origin are evaluated in place, other blocks from copies.
#[inline(never)]
fn fill_blocks<const N: usize>(
    points: [&[f32]; N],
    values: &mut [f32],
    mut gradients: Option<[&mut [f32]; N]>,
    reach: f32,
    evaluate: &mut dyn FnMut(&mut Block<'_, N>),
) {
    let mut slopes = gradients.as_ref().map(|_| [[0.0; BLOCK]; N]);
    for start in (0..values.len()).step_by(BLOCK) {
        let len = (values.len() - start).min(BLOCK);
        if let Some(mut block) = whole_block(&points, values, &mut gradients, &mut slopes, start) {
            evaluate(&mut block);
            if block.is_near {
                continue;
            }
        }
        let (mut copies, mut found) = (Copies { points: [[0.0; BLOCK]; N], known: u128::MAX }, [0.0; BLOCK]);
        copies.read(&points, start, len, reach);
        let (points, gradients_found) = (copies.points.each_ref(), slopes.as_mut().map(<[_; N]>::each_mut));
        evaluate(&mut Block { points, values: &mut found, gradients: gradients_found, len, is_near: true });
        copies.write(&found, &mut values[start..start + len]);
        for (to, from) in gradients.iter_mut().flatten().zip(slopes.iter().flatten()) {
            copies.write(from, to.get_mut(start..start + len).unwrap_or_default());
        }
    }
}

/// A block of a list in place, if it is whole.
#[inline]
fn whole_block<'a, const N: usize>(
    points: &[&'a [f32]; N],
    values: &'a mut [f32],
    gradients: &'a mut Option<[&mut [f32]; N]>,
    slopes: &'a mut Option<[[f32; BLOCK]; N]>,
    start: usize,
) -> Option<Block<'a, N>> {
    let mut block = Block {
        points: [&[0.0; BLOCK]; N],
        values: values.get_mut(start..)?.first_chunk_mut()?,
        gradients: slopes.as_mut().map(<[_; N]>::each_mut),
        len: BLOCK,
        is_near: true,
    };
    for (to, from) in block.points.iter_mut().zip(points) {
        *to = from.get(start..)?.first_chunk()?;
    }
    for (to, from) in block.gradients.iter_mut().flatten().zip(gradients.iter_mut().flatten()) {
        *to = from.get_mut(start..)?.first_chunk_mut()?;
    }
    Some(block)
}

struct EvaluateBlock<'a, 'b, K, const N: usize> {
    kernel: &'a K,
    seed: u32,
    block: &'a mut Block<'b, N>,
}

impl<K: Kernel<N>, const N: usize> Task for EvaluateBlock<'_, '_, K, N> {
    type Output = ();

    #[inline(always)]
    fn run<S: Lanes>(self, s: S) {
        let Self { kernel, seed, block } = self;
        if const { has_values_alone::<S>() } && block.gradients.is_none() {
            let copy = kernel.copied();
            block.evaluate::<K, S, false>(s, copy.as_ref().unwrap_or(kernel), seed);
        } else {
            block.evaluate::<K, S, true>(s, kernel, seed);
        }
    }
}

impl<const N: usize> Block<'_, N> {
    #[inline(always)]
    fn evaluate<K: Kernel<N>, S: Lanes, const GRADIENTS: bool>(&mut self, s: S, kernel: &K, seed: u32) {
        let points = self.points;
        let mut sum = s.float(0.0);
        let mut i = 0;
        while i < self.len {
            // The mask lets the compiler see that a register fits.
            let at = i & (BLOCK - S::LEN);
            let mut p = [s.float(0.0); N];
            for axis in 0..N {
                p[axis] = s.load(&points[axis][at..]);
                sum = sum + s.abs(p[axis]);
            }
            let (value, gradient) = in_lanes::<K, S, N, GRADIENTS>(s, kernel, p, seed);
            s.store(value, &mut self.values[at..]);
            if let Some(gradients) = &mut self.gradients
                && GRADIENTS
            {
                for axis in 0..N {
                    s.store(gradient[axis], &mut gradients[axis][at..]);
                }
            }
            i += S::LEN;
        }
        self.is_near = s.all(s.less(sum, s.float(K::REACH)));
    }
}

/// Copies of a block's points; points beyond reach are moved to points with the same cells.
struct Copies<const N: usize> {
    points: [[f32; BLOCK]; N],
    /// One bit per point, 0 where the noise is 0 regardless of the evaluation.
    known: u128,
}

impl<const N: usize> Copies<N> {
    /// Copies a block.
    fn read(&mut self, points: &[&[f32]; N], start: usize, len: usize, reach: f32) {
        let mut sums = [0.0; BLOCK];
        for (to, from) in self.points.iter_mut().zip(points) {
            let from = from.get(start..start + len).unwrap_or_default();
            for ((to, sum), from) in to.iter_mut().zip(&mut sums).zip(from) {
                *to = *from;
                *sum += from.abs();
            }
        }
        // NaN is not below `reach` either.
        if !sums.iter().all(|&sum| sum < reach) {
            self.move_far(reach);
        }
    }

    /// Moves points beyond reach and records where the noise can differ from 0.
    #[cold]
    #[inline(never)]
    fn move_far(&mut self, reach: f32) {
        for i in 0..BLOCK {
            let mut p = [0.0; N];
            for axis in 0..N {
                p[axis] = self.points[axis][i];
            }
            let found = evaluated(p, reach);
            if found.is_none() {
                self.known &= !(1 << i);
            }
            for (axis, x) in found.unwrap_or([0.0; N]).into_iter().enumerate() {
                self.points[axis][i] = x;
            }
        }
    }

    /// Copies numbers to their destination.
    fn write(&self, from: &[f32; BLOCK], to: &mut [f32]) {
        for (i, (to, from)) in to.iter_mut().zip(from).enumerate() {
            *to = if self.known >> i & 1 == 1 { *from } else { 0.0 };
        }
    }
}

/// The number of points from which on rows save enough to pay for the memory.
pub(crate) const FEW_POINTS: usize = 256;
/// The number of points of a grid that are evaluated as one list.
pub(crate) const LIST: usize = 256;

/// Whether the rows of a grid reuse work, in the coordinates that `seen` maps them to.
pub(crate) fn reuses<K: Kernel<N>, V: Point<Coordinates = [f32; N]>, const N: usize>(
    kernel: &K,
    points: &Points<'_, V>,
    instructions: Instructions,
    seen: impl FnOnce(Row<N>) -> Row<N>,
) -> bool {
    let Source::Window(window) = &points.0 else { return false };
    let count = points.width().min(POINTS);
    let reuses = |(_, row)| kernel.reuses(&seen(row), count, instructions.are_wide());
    points.len() >= FEW_POINTS && window.rows(0..1).next().is_some_and(reuses)
}

/// Evaluates a kind at the points of a batch.
pub(crate) fn fill<K: Kernel<N>, V: Point<Coordinates = [f32; N]>, const N: usize>(
    kernel: &K,
    points: &Points<'_, V>,
    mut target: Target<'_, V>,
) {
    let seed = kernel.seed();
    let instructions = target.instructions;
    if let Source::Lists(lists) = &points.0 {
        let (values, gradients) = target.row(0, points.width());
        let points = array::from_fn(|axis| lists.as_ref()[axis]);
        let gradients = gradients.map(by_axes::<V, N>);
        K::fill_list(FillList { kernel, seed, points, values, gradients }, instructions);
    } else if reuses(kernel, points, instructions, |row| row) {
        let mut scratch = K::RowScratch::default();
        for block in points.blocks(usize::MAX) {
            let part = points.part(&block);
            let Source::Window(window) = &part.0 else { return };
            let mut target = target.part(&block);
            for (r, row) in window.rows(0..block.rows.len()) {
                let (values, gradients) = target.row(r, block.width());
                let gradients = gradients.map(by_axes::<V, N>);
                let call = FillRow { kernel, seed, row, scratch: &mut scratch, values, gradients };
                K::fill_row(call, instructions);
            }
        }
    } else {
        let mut lists = buffers::<V, LIST>();
        for block in points.blocks(LIST) {
            points.part(&block).write(lists.as_mut());
            let mut target = target.part(&block);
            // Whole rows form one list.
            let whole = target.stride == block.width();
            let (rows, width) =
                if whole { (1, block.len()) } else { (block.rows.len(), block.width().max(1)) };
            for row in 0..rows {
                let part = row * width..(row + 1) * width;
                let points = array::from_fn(|axis| &lists.as_ref()[axis][part.clone()]);
                let (values, gradients) = target.row(row, width);
                let gradients = gradients.map(by_axes::<V, N>);
                K::fill_list(FillList { kernel, seed, points, values, gradients }, instructions);
            }
        }
    }
}
