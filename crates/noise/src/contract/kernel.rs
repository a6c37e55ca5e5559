//! The SIMD-generic interface that every kind of noise implements once; single points, rows and lists share it.

use core::array;

use crate::{
    lanes::lanes::{LANES, LaneSample, Lanes, Scalar},
    lanes::level::{Instructions, Task, run_at_point},
    lattice::lattice::{REACH, is_within, wrapped},
    point::Point,
    row::points::{Points, Source, Target, buffers, by_axes},
    row::row::{Row, Strip},
    statistics::statistics::Statistics,
};

/// Seed and measured statistics of a kind of noise of this crate. Not for users: its methods may change in any release.
#[doc(hidden)]
pub trait Measured<const N: usize> {
    /// The seed of the noise by itself; octaves have seeds of their own.
    fn seed(&self) -> u32;

    /// The measured statistics of the kind in this dimension.
    fn statistics(&self) -> &'static Statistics;

    /// σ₁, the standard deviation of this very noise; other than the table's where a kind has parameters.
    fn standard_deviation(&self) -> f32 {
        self.statistics().standard_deviation
    }

    /// The mean of one octave over all points and seeds.
    fn mean(&self) -> f32 {
        0.0
    }

    /// Lower and upper bound of the values of this very noise.
    fn bounds(&self) -> [f32; 2] {
        let range = self.statistics().range;
        [-range, range]
    }

    /// E|n|, E|n|², E|n|³ and E|n|⁴ of one octave over all points and seeds, what a [`Shape`](crate::Shape)'s mean follows from.
    fn absolute_moments(&self) -> [f32; 4] {
        self.statistics().absolute_moments
    }
}

/// A kind of noise in N dimensions, written over [`Lanes`].
///
/// Points have finite coordinates of at most 2³¹ in magnitude. Every method gives a point the same bits. Sealed: a field of one's
/// own implements [`Field`](crate::Field).
#[diagnostic::on_unimplemented(
    message = "`{Self}` is no kind of noise in {N} dimensions",
    note = "octaves are summed of the kinds of this crate, `Perlin2002` for instance; any field can be added, multiplied, \
            blended, clamped, mapped and warped"
)]
pub trait Kernel<const N: usize>: Measured<N> {
    /// The noise is 0 from where Σ |xᵢ| reaches this. By default coordinates go on to ∞ with their cells
    /// modulo 2³².
    const REACH: f32 = REACH;

    /// Whether the noise repeats.
    const TILED: bool = false;
    /// Whether cells are simplices of the skewed lattice.
    const SIMPLICIAL: bool = false;

    /// From so many octaves on those of a point are evaluated in lanes, each with a key of its own.
    const OCTAVES_IN_LANES: usize = usize::MAX;

    /// Intermediate results that rows of a grid share, from row to row.
    type RowScratch: Default;

    /// The period along an axis, 0 where there is none.
    fn period(&self, _axis: usize) -> u32 {
        0
    }

    /// The key that the lattice makes of a seed, and words of it.
    fn key(&self, seed: u32) -> u32 {
        seed
    }

    /// The noise of an octave of a sum, on its own lattice; nothing where that is the noise itself.
    #[inline(always)]
    fn of_octave(&self, _frequency: f32, _cell: &[i32]) -> Option<Self>
    where
        Self: Sized,
    {
        None
    }

    /// The noise again for lists of values, where it has parameters to keep in registers and a lattice that takes no memory.
    #[inline(always)]
    fn copied(&self) -> Option<Self>
    where
        Self: Sized,
    {
        None
    }

    /// The values at points, and the gradients if `GRADIENTS`; else those are of no meaning.
    fn evaluate<S: Lanes, const GRADIENTS: bool>(&self, s: S, p: [S::F; N], seed: u32) -> LaneSample<S, N>;

    /// The value at one point, and the gradient if `GRADIENTS`, the same bits.
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

    /// A row at a SIMD level.
    fn fill_row(call: FillRow<'_, Self, N>, instructions: Instructions)
    where
        Self: Sized,
    {
        call.at(instructions);
    }

    /// A list at a SIMD level.
    fn fill_list(call: FillList<'_, Self, N>, instructions: Instructions)
    where
        Self: Sized,
    {
        instructions.run(call);
    }

    /// Octaves at a point, as many at once as there are lanes; nothing where there is one lane only.
    fn octaves_at(&self, octaves: OctavesAt<'_, N>, samples: &mut OctaveSamples<N>) -> Option<()>
    where
        Self: Sized,
    {
        octaves.evaluate(self, samples)
    }

    /// The values along a row, and the gradients if `GRADIENTS`. What does not change along it may be computed once.
    #[inline(always)]
    fn rows<S: Lanes, const GRADIENTS: bool>(
        &self,
        s: S,
        _: &mut Self::RowScratch,
        strip: Strip<'_, N, GRADIENTS>,
    ) {
        by_lanes(s, self, strip);
    }
}

/// The most octaves of a point.
const OCTAVES: usize = 16;

/// A point in the coordinates of octaves, each of which draws its words with a key of its own.
#[derive(Clone, Copy, Debug)]
pub struct OctavesAt<'a, const N: usize> {
    pub(crate) points: &'a [[f32; OCTAVES]; N],
    pub(crate) seeds: &'a [u32; OCTAVES],
    pub(crate) keys: &'a [u32; OCTAVES],
    pub(crate) count: usize,
    /// Whether gradients are wanted.
    pub(crate) gradients: bool,
}

/// The values of octaves, and their gradients if they are wanted; beyond the number of octaves they are of no meaning.
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
    /// The octaves of a kind in lanes.
    pub(crate) fn evaluate<K: Kernel<N>>(self, kernel: &K, samples: &mut OctaveSamples<N>) -> Option<()> {
        run_at_point(EvaluateOctaves { kernel, octaves: self, samples })
    }

    /// The octaves in lanes from one on.
    #[inline(always)]
    fn put<S: Lanes, K: Kernel<N>, const GRADIENTS: bool>(
        self,
        s: S,
        kernel: &K,
        samples: &mut OctaveSamples<N>,
        first: usize,
    ) {
        let mut p = [s.float(0.0); N];
        for axis in 0..N {
            p[axis] = s.load(self.points[axis].get(first..).unwrap_or_default());
        }
        let keys = s.load_words(self.keys.get(first..).unwrap_or_default());
        let (value, gradient) = evaluate::<K, S::Keyed, N, GRADIENTS>(kernel, s.keyed(keys), p, 0);
        s.store(value, samples.values.get_mut(first..).unwrap_or_default());
        for axis in 0..if GRADIENTS { N } else { 0 } {
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
    #[inline(always)]
    fn run<S: Lanes>(self, s: S) {
        let Self { kernel, octaves, samples } = self;
        for first in (0..octaves.count).step_by(S::LEN) {
            if octaves.gradients {
                octaves.put::<S, K, true>(s, kernel, samples, first);
            } else {
                octaves.put::<S, K, false>(s, kernel, samples, first);
            }
        }
    }
}

/// A kind whose sums can be seen from an anchor far from the origin.
pub trait Anchor<const N: usize>: Kernel<N> {
    /// The kind on a lattice whose cells are counted from the anchor's.
    type Shifted: Kernel<N>;

    /// The noise on such a lattice, not shifted yet.
    fn shifted(self) -> Self::Shifted;
}

/// The methods of a [`Kernel`] for octaves, by its lattice.
macro_rules! on_lattice {
    () => {
        $crate::contract::compiled::on_standard_lattice!();

        const TILED: bool = <<Self as $crate::lattice::lattice::OnLattice>::Lattice as $crate::lattice::lattice::Lattice>::TILED;

        fn period(&self, axis: usize) -> u32 {
            $crate::lattice::lattice::Lattice::period($crate::lattice::lattice::OnLattice::lattice(self), axis)
        }

        fn key(&self, seed: u32) -> u32 {
            $crate::lattice::lattice::Lattice::key($crate::lattice::lattice::OnLattice::lattice(self), seed)
        }

        #[inline(always)]
        fn of_octave(&self, frequency: f32, cell: &[i32]) -> Option<Self> {
            $crate::lattice::lattice::OnLattice::of_octave(self, frequency, cell)
        }
    };
}

pub(crate) use on_lattice;

/// Whether |xᵢ| < 2³⁰ for every axis, by bits: arithmetic of words leaves that of vectors to the noise.
#[inline(always)]
fn is_small<const N: usize>(p: &[f32; N]) -> bool {
    // Such numbers come up to the sign's bit.
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
/// A point beyond reach is moved to where it has the same cells before the kind is evaluated, so that it is compiled once.
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

/// The values at any points, one in each lane, and the gradients if `GRADIENTS`.
#[inline(always)]
pub(crate) fn evaluate<K: Kernel<N>, S: Lanes, const N: usize, const GRADIENTS: bool>(
    kernel: &K,
    s: S,
    mut p: [S::F; N],
    seed: u32,
) -> LaneSample<S, N> {
    let mut beyond = None;
    if !is_within(s, &p, K::REACH) {
        let mut lanes = [None; LANES];
        for lane in 0..S::LEN {
            lanes[lane % LANES] = evaluated_far(p.map(|x| s.lane(x, lane)), K::REACH);
        }
        for axis in 0..N {
            p[axis] = s.floats(|lane| lanes[lane % LANES].map_or(0.0, |p| p[axis]));
        }
        beyond = Some(lanes);
    }
    let (mut value, mut gradient) = kernel.evaluate::<S, GRADIENTS>(s, p, seed);
    if let Some(lanes) = beyond {
        let kept = |x| s.floats(|lane| lanes[lane % LANES].map_or(0.0, |_| s.lane(x, lane)));
        if GRADIENTS {
            gradient = gradient.map(kept);
        }
        value = kept(value);
    }
    (value, gradient)
}

/// The point itself if it is within reach; beyond, a point with the same cells, if the kind has cells there.
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

/// Values along a row, and gradients if `GRADIENTS`, from as many single points at once as there are lanes.
#[inline(always)]
pub(crate) fn by_lanes<K: Kernel<N> + ?Sized, S: Lanes, const N: usize, const GRADIENTS: bool>(
    s: S,
    kernel: &K,
    mut strip: Strip<'_, N, GRADIENTS>,
) {
    for i in (0..strip.values.len()).step_by(S::LEN) {
        let p = strip.row.points(s, i);
        strip.put(s, kernel.evaluate::<S, GRADIENTS>(s, p, strip.seed), i);
    }
}

/// The values at points of a list, and the gradients if `GRADIENTS`. One lane takes the way of a single point, where corners have the lanes:
/// in a loop it has too few registers.
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
    let (value, gradient) = kernel.lone::<GRADIENTS>(p.map(|x| s.lane(x, 0)), seed);
    (s.float(value), gradient.map(|x| s.float(x)))
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
    /// The row at a SIMD level: all that is compiled for rows of a kind.
    pub(crate) fn at(self, instructions: Instructions) {
        if self.row.is_within(K::REACH, self.values.len()) {
            instructions.run(self);
        } else {
            self.far(instructions);
        }
    }

    /// A row of which some points are beyond the kind's reach, as a list.
    #[cold]
    #[inline(never)]
    fn far(mut self, instructions: Instructions) {
        const COUNT: usize = 64;
        let mut points = [[0.0; COUNT]; N];
        for start in (0..self.values.len()).step_by(COUNT) {
            let part = start..self.values.len().min(start + COUNT);
            for i in part.clone() {
                let p = self.row.point(i);
                for axis in 0..N {
                    points[axis][i - start] = p[axis];
                }
            }
            let points = points.each_ref().map(|x| &x[..part.len()]);
            let gradients = self.gradients.as_mut();
            let gradients =
                gradients.map(|g| g.each_mut().map(|g| g.get_mut(part.clone()).unwrap_or_default()));
            let (kernel, seed) = (self.kernel, self.seed);
            let values = &mut self.values[part.clone()];
            instructions.run(FillList { kernel, seed, points, values, gradients });
        }
    }
}

impl<K: Kernel<N>, const N: usize> Task for FillRow<'_, K, N> {
    #[inline(always)]
    fn run<S: Lanes>(self, s: S) {
        let Self { kernel, seed, row, scratch, values, gradients } = self;
        match gradients {
            Some(gradients) => kernel.rows(s, scratch, Strip::<N, true> { row, seed, values, gradients }),
            None => {
                let gradients = array::from_fn(|_| <&mut [f32]>::default());
                kernel.rows(s, scratch, Strip::<N, false> { row, seed, values, gradients });
            }
        }
    }
}

/// Points of a kind, or of one of its octaves, from lists of their coordinates.
#[derive(Debug)]
pub struct FillList<'a, K: Kernel<N>, const N: usize> {
    pub(crate) kernel: &'a K,
    pub(crate) seed: u32,
    pub(crate) points: [&'a [f32]; N],
    pub(crate) values: &'a mut [f32],
    /// One slice per axis, as long as `values`.
    pub(crate) gradients: Option<[&'a mut [f32]; N]>,
}

impl<K: Kernel<N>, const N: usize> Task for FillList<'_, K, N> {
    #[inline(always)]
    fn run<S: Lanes>(self, s: S) {
        let Self { kernel, seed, points, values, gradients } = self;
        match gradients {
            Some(gradients) => Blocks::<N, true> { points, values, gradients }.fill(s, kernel, seed),
            None => {
                let gradients = array::from_fn(|_| <&mut [f32]>::default());
                Blocks::<N, false> { points, values, gradients }.fill(s, kernel, seed);
            }
        }
    }
}

/// Points of a list that are evaluated without a question in between.
const BLOCK: usize = 128;

static NOTHING: [f32; BLOCK] = [0.0; BLOCK];

/// A list of points by blocks, and room for their values, and for gradients if `GRADIENTS`.
struct Blocks<'a, const N: usize, const GRADIENTS: bool> {
    points: [&'a [f32]; N],
    values: &'a mut [f32],
    /// One slice per axis, as long as `values`; empty unless `GRADIENTS`.
    gradients: [&'a mut [f32]; N],
}

impl<const N: usize, const GRADIENTS: bool> Blocks<'_, N, GRADIENTS> {
    /// Whole blocks of points near the origin as they lie, and others by way of copies.
    #[inline(always)]
    fn fill<K: Kernel<N>, S: Lanes>(mut self, s: S, kernel: &K, seed: u32) {
        let count = self.values.len();
        let copy = if GRADIENTS { None } else { kernel.copied() };
        let kernel = copy.as_ref().unwrap_or(kernel);
        let mut copies = None;
        for start in (0..count).step_by(BLOCK) {
            let mut block = self.part(start, count.min(start + BLOCK));
            let len = block.values.len();
            // A whole block first as it lies. Its points are asked whether they are near while they are in registers; few are not.
            let mut direct = len == BLOCK;
            loop {
                let mut known = u128::MAX;
                if !direct {
                    let copies = copies.get_or_insert_with(Copies::empty);
                    copies.copy(&block.points);
                    if !is_near(s, &copies.points.each_ref().map(|x| &x[..]), len, K::REACH) {
                        known = copies.read(&block.points, K::REACH);
                    }
                }
                let part = match &mut copies {
                    Some(copies) if !direct => copies.block(),
                    _ => block.reborrow(),
                };
                let near = part.evaluate(s, kernel, seed, len);
                if near || !direct {
                    if let Some(copies) = copies.as_ref().filter(|_| !direct) {
                        copies.write(&mut block, known);
                    }
                    break;
                }
                direct = false;
            }
        }
    }

    /// The first points of a block, at least `len`, and whether all of them are within reach; they may be and seem not where they are far
    /// from the origin.
    #[inline(always)]
    fn evaluate<K: Kernel<N>, S: Lanes>(self, s: S, kernel: &K, seed: u32, len: usize) -> bool {
        // Arrays, and an index that is told to leave room for a vector, or every list would be asked every time.
        let points = self.points.map(|x| x.first_chunk::<BLOCK>().unwrap_or(&NOTHING));
        let mut gradients = self.gradients.map(|g| g.first_chunk_mut::<BLOCK>());
        let Some(values) = self.values.first_chunk_mut::<BLOCK>() else { return true };
        // One question in place of one for each store. Simplices keep more in registers than there are, and lose by it.
        if GRADIENTS && !K::SIMPLICIAL && gradients.iter().any(Option::is_none) {
            return true;
        }
        let mut sum = s.float(0.0);
        let mut i = 0;
        while i < len {
            let at = i & (BLOCK - S::LEN);
            let mut p = [s.float(0.0); N];
            for axis in 0..N {
                p[axis] = s.load(&points[axis][at..]);
                sum = sum + s.abs(p[axis]);
            }
            let (value, gradient) = in_lanes::<K, S, N, GRADIENTS>(s, kernel, p, seed);
            s.store(value, &mut values[at..]);
            for axis in 0..if GRADIENTS { N } else { 0 } {
                if let Some(g) = &mut gradients[axis] {
                    s.store(gradient[axis], &mut g[at..]);
                }
            }
            i += S::LEN;
        }
        s.all(s.less(sum, s.float(K::REACH)))
    }

    #[inline(always)]
    fn part(&mut self, start: usize, end: usize) -> Blocks<'_, N, GRADIENTS> {
        let mut points = self.points;
        for axis in 0..N {
            points[axis] = self.points[axis].get(start..end).unwrap_or_default();
        }
        Blocks {
            points,
            values: self.values.get_mut(start..end).unwrap_or_default(),
            gradients: self.gradients.each_mut().map(|g| {
                if GRADIENTS { g.get_mut(start..end).unwrap_or_default() } else { Default::default() }
            }),
        }
    }

    #[inline(always)]
    fn reborrow(&mut self) -> Blocks<'_, N, GRADIENTS> {
        self.part(0, BLOCK)
    }
}

/// Whether the first points of a block, at least `len`, are within reach; they may be and seem not where they are far from the origin.
#[inline(always)]
fn is_near<S: Lanes, const N: usize>(s: S, points: &[&[f32]; N], len: usize, reach: f32) -> bool {
    let mut sum = s.float(0.0);
    for axis in 0..N {
        let Some(x) = points[axis].first_chunk::<BLOCK>() else { return false };
        for i in (0..len).step_by(S::LEN) {
            sum = sum + s.abs(s.load(&x[i & (BLOCK - S::LEN)..]));
        }
    }
    s.all(s.less(sum, s.float(reach)))
}

/// A block's points, those beyond reach moved to where they have the same cells, and room for what is found there.
struct Copies<const N: usize> {
    points: [[f32; BLOCK]; N],
    values: [f32; BLOCK],
    gradients: [[f32; BLOCK]; N],
}

impl<const N: usize> Copies<N> {
    #[inline(always)]
    fn empty() -> Self {
        Self { points: [[0.0; BLOCK]; N], values: [0.0; BLOCK], gradients: [[0.0; BLOCK]; N] }
    }

    #[inline(always)]
    fn copy(&mut self, points: &[&[f32]; N]) {
        for (to, from) in self.points.iter_mut().zip(points) {
            for (to, from) in to.iter_mut().zip(*from) {
                *to = *from;
            }
        }
    }

    /// Copies a block, points beyond reach moved, and tells by bits at which the noise is other than 0.
    #[cold]
    #[inline(never)]
    fn read(&mut self, points: &[&[f32]; N], reach: f32) -> u128 {
        let mut known = 0;
        for i in 0..points.first().map_or(0, |x| x.len().min(BLOCK)) {
            let p = points.map(|x| x.get(i).copied().unwrap_or(0.0));
            let found = evaluated(p, reach);
            known |= u128::from(found.is_some()) << i;
            for (axis, x) in found.unwrap_or([0.0; N]).into_iter().enumerate() {
                self.points[axis][i] = x;
            }
        }
        known
    }

    #[inline(always)]
    fn block<const GRADIENTS: bool>(&mut self) -> Blocks<'_, N, GRADIENTS> {
        Blocks {
            points: self.points.each_ref().map(|x| &x[..]),
            values: &mut self.values,
            gradients: self.gradients.each_mut().map(|g| &mut g[..]),
        }
    }

    /// Copies values, and gradients if `GRADIENTS`, to a block.
    #[cold]
    #[inline(never)]
    fn write<const GRADIENTS: bool>(&self, block: &mut Blocks<'_, N, GRADIENTS>, known: u128) {
        let kept = |i: usize, x: f32| if known >> i & 1 == 1 { x } else { 0.0 };
        for (i, (to, from)) in block.values.iter_mut().zip(self.values).enumerate() {
            *to = kept(i, from);
        }
        for (to, from) in block.gradients.iter_mut().zip(&self.gradients) {
            for (i, (to, from)) in to.iter_mut().zip(from).enumerate() {
                *to = kept(i, *from);
            }
        }
    }
}

/// From so many points on rows share enough to pay for the room that it takes.
pub(crate) const FEW_POINTS: usize = 256;

/// A kind at the points of a batch.
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
    } else if points.len() < FEW_POINTS {
        let mut lists = buffers::<V, FEW_POINTS>();
        points.write(lists.as_mut());
        let width = points.width().max(1);
        for row in 0..points.rows() {
            let part = row * width..(row + 1) * width;
            let points = array::from_fn(|axis| &lists.as_ref()[axis][part.clone()]);
            let (values, gradients) = target.row(row, width);
            let gradients = gradients.map(by_axes::<V, N>);
            K::fill_list(FillList { kernel, seed, points, values, gradients }, instructions);
        }
    } else {
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
    }
}
