//! Octaves of a sum at many points, one octave after the other over blocks of points.

use asperity_core::lanes::Task;

use crate::{
    contract::kernel::{FillList, FillRow, Kernel, LIST, reuses},
    lanes::Lanes,
    lanes::level::Instructions,
    lattice::tiled::in_first_tile,
    point::Point,
    row::cells::POINTS,
    row::points::{Block, Points, Source, Target, by_axes},
    row::row::{Row, put},
    sums::octave::{Layer, Layers, Rotation},
    sums::shape::Shape,
};

/// The number of points per octave pass, as many as fit into a near cache.
const BLOCK: usize = 8192;

/// One number for each point of a list, for each axis.
pub(crate) type Lists<const N: usize> = [[f32; LIST]; N];

/// The active octaves of a sum, and how they are combined.
pub(crate) struct Passes<'a, K, const N: usize, T> {
    pub(crate) noise: &'a K,
    /// The periods along all axes, 0 for axes without a period.
    pub(crate) periods: [f32; N],
    pub(crate) shape: T,
    pub(crate) layers: &'a Layers<[f32; N]>,
    pub(crate) amplitudes: &'a [f32],
    /// A constant that is added to the sum before it is normalized.
    pub(crate) constant: f32,
    pub(crate) factor: f32,
}

impl<K: Kernel<N>, const N: usize, T: Shape> Passes<'_, K, N, T> {
    /// Evaluates the sum at the points of a batch.
    pub(crate) fn fill<V: Point<Coordinates = [f32; N]>>(
        &self,
        points: &Points<'_, V>,
        mut target: Target<'_, V>,
    ) {
        if self.amplitudes.is_empty() {
            for row in 0..points.rows() {
                let (values, gradients) = target.row(row, points.width());
                values.fill(self.constant * self.factor);
                gradients
                    .into_iter()
                    .for_each(|mut gradients| gradients.as_mut().iter_mut().for_each(|g| g.fill(0.0)));
            }
        } else if !K::TILED
            && self.layers.rotation == Rotation::Aligned
            && reuses(self.noise, points, target.instructions, |row| self.first_octave(row))
        {
            let mut scratch = K::RowScratch::default();
            for block in points.blocks(BLOCK) {
                self.fill_rows(&points.part(&block), &block, &mut scratch, target.part(&block));
            }
        } else {
            for block in points.blocks(LIST) {
                self.fill_list(&points.part(&block), &block, target.part(&block));
            }
        }
    }

    /// A row in the coordinates of the first octave of parallel lattices.
    fn first_octave(&self, row: Row<N>) -> Row<N> {
        let layer = self.layers.layer(0);
        row.scaled(layer.frequencies(), layer.offset)
    }

    fn octaves(&self) -> impl Iterator<Item = (usize, f32, Layer<N>)> {
        let layers = self.layers.iter();
        self.amplitudes.iter().zip(layers).enumerate().map(|(i, (&amplitude, layer))| (i, amplitude, layer))
    }

    /// Evaluates rows of a grid on parallel lattices, which reuse work along the rows.
    fn fill_rows<V: Point<Coordinates = [f32; N]>>(
        &self,
        points: &Points<'_, V>,
        block: &Block,
        scratch: &mut K::RowScratch,
        mut target: Target<'_, V>,
    ) {
        let Source::Window(window) = &points.0 else { return };
        let (instructions, width) = (target.instructions, block.width());
        let (mut own, mut octave, mut slopes) = (None, [0.0; POINTS], [[0.0; POINTS]; N]);
        for (i, amplitude, layer) in self.octaves() {
            let noise = layer.noise(self.noise, &mut own);
            let frequencies = layer.frequencies();
            for (r, row) in window.rows(0..block.rows.len()) {
                let (values, gradients) = target.row(r, width);
                let row = row.scaled(frequencies, layer.offset);
                let room = gradients.as_ref().map(|_| slopes.each_mut().map(|slope| &mut slope[..width]));
                let (kernel, seed, octave) = (noise, layer.seed, &mut octave[..]);
                let fill = FillRow {
                    kernel,
                    seed,
                    row,
                    scratch: &mut *scratch,
                    values: &mut octave[..width],
                    gradients: room,
                };
                K::fill_row(fill, instructions);
                let gradients = gradients.map(by_axes::<V, N>);
                self.add(instructions, (i, amplitude, &layer), octave, &slopes, values, gradients);
            }
        }
    }

    /// Evaluates a list of points, or points of a grid whose octaves are rotated.
    fn fill_list<V: Point<Coordinates = [f32; N]>>(
        &self,
        points: &Points<'_, V>,
        block: &Block,
        mut target: Target<'_, V>,
    ) {
        let (instructions, count, wanted) = (target.instructions, block.len(), target.gradients.is_some());
        let (mut sum, mut gradient) = ([0.0; LIST], [[0.0; LIST]; N]);
        self.each_octave(points, instructions, wanted, |term, octave, slopes| {
            let gradients = wanted.then(|| gradient.each_mut().map(|g| &mut g[..count]));
            self.add(instructions, term, octave, slopes, &mut sum[..count], gradients);
        });
        copy_out(&mut target, block, &sum, &gradient);
    }

    /// Evaluates every octave at up to [`LIST`] points, with its number and amplitude, and its
    /// gradients if wanted.
    pub(crate) fn each_octave<V: Point<Coordinates = [f32; N]>>(
        &self,
        points: &Points<'_, V>,
        instructions: Instructions,
        wanted: bool,
        mut add: impl FnMut((usize, f32, &Layer<N>), &mut [f32; LIST], &Lists<N>),
    ) {
        let count = points.len().min(LIST);
        let (mut from, mut to) = ([[0.0; LIST]; N], [[0.0; LIST]; N]);
        let (mut own, mut octave, mut slopes) = (None, [0.0; LIST], [[0.0; LIST]; N]);
        points.write(&mut from);
        if K::TILED {
            instructions.run(Wrap { periods: &self.periods, points: &mut from, count });
        }
        for (i, amplitude, layer) in self.octaves() {
            instructions.run(Move { layer: &layer, from: &from, to: &mut to, count });
            let gradients = wanted.then(|| slopes.each_mut().map(|slope| &mut slope[..count]));
            let kernel = layer.noise(self.noise, &mut own);
            let (seed, points) = (layer.seed, to.each_ref().map(|x| &x[..count]));
            let values = &mut octave[..count];
            K::fill_list(FillList { kernel, seed, points, values, gradients }, instructions);
            add((i, amplitude, &layer), &mut octave, &slopes);
        }
    }

    /// Shapes an octave and adds it to a sum.
    fn add<const M: usize>(
        &self,
        instructions: Instructions,
        (i, amplitude, layer): (usize, f32, &Layer<N>),
        octave: &mut [f32],
        slopes: &[[f32; M]; N],
        values: &mut [f32],
        gradients: Option<[&mut [f32]; N]>,
    ) {
        let last = i + 1 == self.amplitudes.len();
        instructions.run(Add {
            shape: self.shape,
            layer,
            amplitude,
            before: (i == 0).then_some(self.constant),
            factor: last.then_some(self.factor),
            octave,
            slopes,
            values,
            gradients,
        });
    }
}

/// Writes the sums of a block to their destination.
pub(crate) fn copy_out<V: Point, const N: usize>(
    target: &mut Target<'_, V>,
    block: &Block,
    sum: &[f32; LIST],
    gradient: &Lists<N>,
) {
    let width = block.width();
    for row in 0..block.rows.len() {
        let part = row * width..(row + 1) * width;
        let (values, gradients) = target.row(row, width);
        values.copy_from_slice(&sum[part.clone()]);
        if let Some(mut gradients) = gradients {
            for (to, from) in gradients.as_mut().iter_mut().zip(gradient) {
                to.copy_from_slice(&from[part.clone()]);
            }
        }
    }
}

/// Points moved into the first tile.
struct Wrap<'a, const N: usize> {
    periods: &'a [f32; N],
    points: &'a mut Lists<N>,
    count: usize,
}

impl<const N: usize> Task for Wrap<'_, N> {
    type Output = ();

    #[inline(always)]
    fn run<S: Lanes>(self, s: S) {
        let Self { periods, points, count } = self;
        for i in (0..count.min(LIST)).step_by(S::LEN) {
            let mut p = [s.float(0.0); N];
            for axis in 0..N {
                p[axis] = s.load(&points[axis][i..]);
            }
            let q = in_first_tile(s, p, periods);
            for axis in 0..N {
                s.store(q[axis], &mut points[axis][i..]);
            }
        }
    }
}

/// Points in the coordinates of an octave.
struct Move<'a, const N: usize> {
    layer: &'a Layer<N>,
    from: &'a Lists<N>,
    to: &'a mut Lists<N>,
    count: usize,
}

impl<const N: usize> Task for Move<'_, N> {
    type Output = ();

    #[inline(always)]
    fn run<S: Lanes>(self, s: S) {
        let Self { layer, from, to, count } = self;
        for i in (0..count.min(LIST)).step_by(S::LEN) {
            let mut p = [s.float(0.0); N];
            for axis in 0..N {
                p[axis] = s.load(&from[axis][i..]);
            }
            let q = layer.points(s, p);
            for axis in 0..N {
                s.store(q[axis], &mut to[axis][i..]);
            }
        }
    }
}

/// sum + amplitude · φ(octave), with a constant before the first octave and normalized after the
/// last.
struct Add<'a, const N: usize, const M: usize, T> {
    shape: T,
    layer: &'a Layer<N>,
    amplitude: f32,
    before: Option<f32>,
    factor: Option<f32>,
    /// With space for a whole register behind the points.
    octave: &'a mut [f32],
    slopes: &'a [[f32; M]; N],
    values: &'a mut [f32],
    gradients: Option<[&'a mut [f32]; N]>,
}

impl<const N: usize, const M: usize, T: Shape> Task for Add<'_, N, M, T> {
    type Output = ();

    #[inline(always)]
    fn run<S: Lanes>(self, s: S) {
        let Self { shape, layer, amplitude, before, factor, octave, slopes, values, gradients } = self;
        let (count, amplitude, zero) = (values.len(), s.float(amplitude), s.float(0.0));
        if let Some(gradients) = gradients {
            let mut bends = [1.0; M];
            if !T::IS_IDENTITY {
                for (bend, n) in bends.iter_mut().zip(octave.iter()) {
                    *bend = shape.slope(*n);
                }
            }
            for i in (0..count).step_by(S::LEN) {
                let mut sum = (zero, [zero; N]);
                for axis in 0..N {
                    if before.is_none() {
                        sum.1[axis] = s.load(gradients[axis].get(i..).unwrap_or_default());
                    }
                }
                let mut slope = [zero; N];
                for axis in 0..N {
                    slope[axis] = s.load(&slopes[axis][i..]);
                    if !T::IS_IDENTITY {
                        slope[axis] = s.load(&bends[i..]) * slope[axis];
                    }
                }
                layer.accumulate(s, &mut sum, amplitude, (zero, slope));
                for axis in 0..N {
                    let total = factor.map_or(sum.1[axis], |factor| sum.1[axis] * s.float(factor));
                    put(s, total, gradients[axis], i, count);
                }
            }
        }
        if !T::IS_IDENTITY {
            for n in octave.iter_mut() {
                *n = shape.value(*n);
            }
        }
        // Whole registers need no bounds checks. The remainder comes last.
        let (whole, factor) = (count - count % S::LEN, s.float(factor.unwrap_or(1.0)));
        let (parts, rest) = values.split_at_mut(whole);
        let turns = parts.chunks_exact_mut(S::LEN).zip(octave.chunks_exact(S::LEN));
        if let Some(constant) = before {
            for (to, n) in turns {
                s.store((s.float(constant) + amplitude * s.load(n)) * factor, to);
            }
        } else {
            for (to, n) in turns {
                s.store((s.load(to) + amplitude * s.load(n)) * factor, to);
            }
        }
        if !rest.is_empty() {
            let sum = before.map_or_else(|| s.load(rest), |constant| s.float(constant));
            let n = s.load(octave.get(whole..).unwrap_or_default());
            s.store((sum + amplitude * n) * factor, rest);
        }
    }
}
