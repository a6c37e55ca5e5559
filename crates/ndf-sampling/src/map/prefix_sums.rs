//! From the texels of an image to the columns of a map and their integrals, several columns at a
//! time.

use alloc::vec;
use alloc::vec::Vec;
use core::ops::Range;

use crate::map::reconstruction::Reconstruction;
use crate::numeric::compensated_sum::CompensatedSums;
use asperity_core::lanes::{self, Lanes, Task, Transpose, TransposeSquare};

/// Columns that are processed together.
const LANES: usize = 8;

/// Texels of an image, row by row, and for each column the range of rows that overlap the disk.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Image<'a> {
    pub(crate) width: usize,
    pub(crate) height: usize,
    pub(crate) texels: &'a [f32],
    pub(crate) inside: &'a [[u32; 2]],
}

/// Values of a map along its columns, and their integral from the middle of the map to each line.
///
/// The integrals are in cells.
///
/// Prefix sums begin in the middle because every chord of the disk contains it. Texels beyond the
/// ends of a chord, even if a million times brighter, are therefore never subtracted from those on
/// it.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct PrefixSums {
    /// Column by column; bilinear columns repeat their first and last values.
    pub(crate) values: Vec<f32>,
    pub(crate) sums: Vec<f64>,
}

impl PrefixSums {
    /// The columns of an image, ignoring texels that do not overlap the disk.
    ///
    /// `None` if an overlapping texel is negative or not finite.
    pub(crate) fn new(image: Image<'_>, kind: Reconstruction) -> Option<Self> {
        lanes::run(usize::MAX, ColumnsOf { image, kind })
    }
}

struct ColumnsOf<'a> {
    image: Image<'a>,
    kind: Reconstruction,
}

impl Task for ColumnsOf<'_> {
    type Output = Option<PrefixSums>;

    #[inline(always)]
    fn run<S: Lanes + Transpose>(self, s: S) -> Self::Output {
        columns_of(s, self.image, self.kind)
    }
}

#[inline(always)]
fn columns_of<S: Transpose>(s: S, image: Image<'_>, kind: Reconstruction) -> Option<PrefixSums> {
    // Each column is summed separately, so one at a time has the same bits. This keeps WebAssembly
    // without SIMD small.
    let wide = image.width >= LANES && !cfg!(all(target_family = "wasm", not(feature = "simd")));
    match kind {
        Reconstruction::Constant if wide => Block::<LANES, false>::new(image).integrate(s),
        Reconstruction::Bilinear if wide => Block::<LANES, true>::new(image).integrate(s),
        Reconstruction::Constant => Block::<1, false>::new(image).integrate(s),
        Reconstruction::Bilinear => Block::<1, true>::new(image).integrate(s),
    }
}

/// The columns in progress, with the lanes of a row adjacent.
struct Block<'a, const N: usize, const BILINEAR: bool> {
    image: Image<'a>,
    /// The first column.
    from: usize,
    /// The rows inside the disk of each column, and of all columns.
    first: [u32; N],
    end: [u32; N],
    whole: Range<usize>,
    values: Vec<[f32; N]>,
    sums: Vec<[f64; N]>,
}

impl<'a, const N: usize, const BILINEAR: bool> Block<'a, N, BILINEAR> {
    #[inline(always)]
    fn new(image: Image<'a>) -> Self {
        let beyond = usize::from(BILINEAR);
        let values = vec![[0.0; N]; image.height + 2 * beyond];
        let sums = vec![[0.0; N]; image.height + beyond + 1];
        Self { image, from: 0, first: [0; N], end: [0; N], whole: 0..0, values, sums }
    }

    /// All columns of the image.
    #[inline(always)]
    fn integrate<S: Transpose>(mut self, s: S) -> Option<PrefixSums> {
        let width = self.image.width;
        let mut values = Vec::with_capacity(width * self.values.len());
        let mut sums = Vec::with_capacity(width * self.sums.len());
        while self.from < width {
            // The last block overlaps the one before it.
            let done = self.from;
            self.from = done.min(width - N.min(width));
            self.find_rows();
            if !self.fill() {
                return None;
            }
            append(s, &mut values, &self.values, done - self.from);
            append(s, &mut sums, &self.sums, done - self.from);
            self.from += N;
        }
        Some(PrefixSums { values, sums })
    }

    /// Finds the rows inside the disk.
    #[inline(always)]
    fn find_rows(&mut self) {
        let inside = self.image.inside.iter().skip(self.from);
        let mut whole = 0..usize::MAX;
        for (lane, &[first, end]) in inside.take(N).enumerate() {
            (self.first[lane], self.end[lane]) = (first, end);
            whole = whole.start.max(first as usize)..whole.end.min(end as usize);
        }
        self.whole = whole;
    }

    /// Fills in the columns; returns whether their texels are valid.
    #[inline(always)]
    fn fill(&mut self) -> bool {
        let cells = self.image.height + usize::from(BILINEAR);
        let cell = cells / 2;
        // The middle of the map is on a line or in the middle of a cell.
        let below = 0.5 * cells as f64 - cell as f64;
        let above = 1.0 - below;
        let (lower, upper) = if BILINEAR { (cell.saturating_sub(1), cell) } else { (cell, cell) };
        let a = self.row(lower, [0.0; N]);
        let b = self.row(upper, a);
        let mix = |s: f64, t: f64| core::array::from_fn(|k| s * f64::from(a[k]) + t * f64::from(b[k]));
        let mut up = State::<N, BILINEAR>::new(b, mix(above * 0.5 * above, above * (1.0 - 0.5 * above)));
        let mut down = State::<N, BILINEAR>::new(a, mix(below * (1.0 - 0.5 * below), below * 0.5 * below));
        let (mut values, mut sums) = (core::mem::take(&mut self.values), core::mem::take(&mut self.sums));
        let middle = [values.len(), sums.len()].map(|len| (cell + 1).min(len));
        let (lower_values, upper_values) = values.split_at_mut(middle[0]);
        let (lower_sums, upper_sums) = sums.split_at_mut(middle[1]);
        set(lower_values.last_mut(), a);
        set(lower_sums.last_mut(), negative(down.sums.values()));
        set(upper_sums.first_mut(), up.sums.values());
        if BILINEAR {
            set(upper_values.first_mut(), b);
        }
        let above = upper_values.iter_mut().skip(usize::from(BILINEAR)).zip(upper_sums.iter_mut().skip(1));
        let rows = self.rows(upper + 1..self.whole.end).chunks_exact(self.image.width);
        self.outward::<true>(&mut up, upper, rows, above);
        let below = lower_values.iter_mut().rev().skip(1).zip(lower_sums.iter_mut().rev().skip(1));
        let rows = self.rows(self.whole.start..lower).chunks_exact(self.image.width);
        self.outward::<false>(&mut down, lower, rows.rev(), below);
        (self.values, self.sums) = (values, sums);
        up.is_sound() & down.is_sound()
    }

    /// Goes from `row` to the end of the columns, first through whole rows.
    #[inline(always)]
    fn outward<'b, const UP: bool>(
        &self,
        state: &mut State<N, BILINEAR>,
        row: usize,
        rows: impl Iterator<Item = &'b [f32]>,
        mut targets: impl Iterator<Item = (&'b mut [f32; N], &'b mut [f64; N])>,
    ) {
        let next = |row: usize| if UP { row + 1 } else { row.wrapping_sub(1) };
        let signed = |sums: [f64; N]| if UP { sums } else { negative(sums) };
        let mut row = next(row);
        for (texels, (value, sum)) in rows.zip(&mut targets) {
            if let Some(texels) = texels.get(self.from..).and_then(|texels| texels.first_chunk()) {
                *value = *texels;
                *sum = signed(state.step(*texels));
            }
            row = next(row);
        }
        for (value, sum) in targets {
            *value = self.row(row, state.before);
            *sum = signed(state.step(*value));
            row = next(row);
        }
    }

    /// Rows of the image.
    #[inline(always)]
    fn rows(&self, range: Range<usize>) -> &'a [f32] {
        let width = self.image.width;
        self.image.texels.get(range.start * width..range.end * width).unwrap_or_default()
    }

    /// The texels of a row inside the disk; elsewhere the value `before`, or 0.
    #[inline(always)]
    fn row(&self, row: usize, before: [f32; N]) -> [f32; N] {
        let begin = row.saturating_mul(self.image.width).saturating_add(self.from);
        let texels = self.image.texels.get(begin..).and_then(|texels| texels.first_chunk::<N>());
        let mut texels = texels.copied().unwrap_or([0.0; N]);
        let at = row as u32;
        for lane in 0..N {
            let other = if BILINEAR { before[lane] } else { 0.0 };
            texels[lane] = if at < self.first[lane] || at >= self.end[lane] { other } else { texels[lane] };
        }
        texels
    }
}

#[inline(always)]
fn set<T>(to: Option<&mut T>, value: T) {
    if let Some(to) = to {
        *to = value;
    }
}

#[inline(always)]
fn negative<const N: usize>(numbers: [f64; N]) -> [f64; N] {
    numbers.map(|number| -number)
}

/// State that goes from row to row.
struct State<const N: usize, const BILINEAR: bool> {
    sums: CompensatedSums<N>,
    before: [f32; N],
    least: [f32; N],
}

impl<const N: usize, const BILINEAR: bool> State<N, BILINEAR> {
    #[inline(always)]
    fn new(row: [f32; N], integral: [f64; N]) -> Self {
        let mut sums = CompensatedSums::default();
        sums.add(integral);
        Self { sums, before: row, least: row }
    }

    /// Adds a row; returns the integral up to its position.
    #[inline(always)]
    fn step(&mut self, row: [f32; N]) -> [f64; N] {
        let mut terms = [0.0; N];
        for lane in 0..N {
            let (value, before) = (f64::from(row[lane]), f64::from(self.before[lane]));
            terms[lane] = if BILINEAR { 0.5 * (before + value) } else { value };
            self.least[lane] = if row[lane] < self.least[lane] { row[lane] } else { self.least[lane] };
        }
        self.before = row;
        self.sums.add(terms);
        self.sums.values()
    }

    /// Whether no texel was negative, NaN or infinite; sums with a non-finite term are not finite.
    #[inline(always)]
    fn is_sound(&self) -> bool {
        let sums = self.sums.values();
        (0..N).fold(true, |sound, lane| sound & (self.least[lane] >= 0.0) & sums[lane].is_finite())
    }
}

/// Appends the lanes of the rows after the first `skipped`, one after the other.
#[inline(always)]
fn append<S: TransposeSquare<T>, T: Copy + Default, const N: usize>(
    s: S,
    to: &mut Vec<T>,
    rows: &[[T; N]],
    skipped: usize,
) {
    let (begin, len) = (to.len(), rows.len());
    if !N.is_multiple_of(4) || skipped > 0 {
        for lane in skipped..N {
            to.extend(rows.iter().map(|row| row[lane]));
        }
        return;
    }
    to.resize(begin + N * len, T::default());
    let (squares, rest) = rows.as_chunks::<4>();
    let mut columns = to.get_mut(begin..).unwrap_or_default().chunks_exact_mut(len);
    for group in 0..N / 4 {
        let mut targets = [(); 4].map(|()| columns.next().unwrap_or_default().as_chunks_mut::<4>());
        let [a, b, c, d] = targets.each_mut().map(|(quads, _)| quads.iter_mut());
        for (square, (((a, b), c), d)) in squares.iter().zip(a.zip(b).zip(c).zip(d)) {
            [*a, *b, *c, *d] = s.transpose([0, 1, 2, 3].map(|k| square[k].as_chunks::<4>().0[group]));
        }
        for (lane, (_, end)) in targets.iter_mut().enumerate() {
            for (to, row) in end.iter_mut().zip(rest) {
                *to = row[4 * group + lane];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::texels::{rows_inside, texel_meets};
    use asperity_core::assert_abs_diff_eq;

    const KINDS: [Reconstruction; 2] = [Reconstruction::Constant, Reconstruction::Bilinear];
    const SIZES: [[usize; 2]; 10] =
        [[1, 1], [2, 1], [1, 2], [3, 3], [5, 7], [8, 8], [9, 4], [16, 33], [37, 20], [65, 63]];

    /// Texels of twelve decades; NaN outside the disk.
    fn texels(width: usize, height: usize) -> Vec<f32> {
        let texel = |k: usize| {
            let bits = (k as u32).wrapping_mul(0x9E37_79B9) >> 9;
            let inside = texel_meets(k % width, width, k / width, height);
            if inside { (bits as f32 / 8_388_608.0).powi(16) } else { f32::NAN }
        };
        (0..width * height).map(texel).collect()
    }

    fn integrals(width: usize, height: usize, texels: &[f32], kind: Reconstruction) -> Option<PrefixSums> {
        PrefixSums::new(Image { width, height, texels, inside: &rows_inside(width, height) }, kind)
    }

    #[test]
    fn integrals_equal_single_column_sums() {
        for ([width, height], kind) in SIZES.into_iter().flat_map(|size| KINDS.map(|kind| (size, kind))) {
            let texels = texels(width, height);
            let PrefixSums { values, sums } = integrals(width, height, &texels, kind).unwrap();
            let (step, cells) = (usize::from(kind == Reconstruction::Bilinear), kind.cells(height));
            let (stride, lines) = (height + 2 * step, cells + 1);
            assert_eq!((values.len(), sums.len()), (width * stride, width * lines));
            for i in 0..width {
                let column: Vec<f32> = (0..height).map(|j| texels[j * width + i]).collect();
                let first = column.iter().position(|value| !value.is_nan()).unwrap();
                let last = column.iter().rposition(|value| !value.is_nan()).unwrap();
                let found = &values[i * stride..(i + 1) * stride];
                for (k, &value) in found.iter().enumerate() {
                    // Bilinear columns begin one row before the image.
                    let row = (k as isize - step as isize).clamp(first as isize, last as isize) as usize;
                    let outside = row + step != k && step == 0;
                    assert_eq!(value, if outside { 0.0 } else { column[row] }, "{i} {k} {width} × {height}");
                }
                let found_sums = &sums[i * lines..(i + 1) * lines];
                // A cell's integral is the mean of its ends; the middle of the map is at 0.
                for k in 0..cells {
                    let cell = 0.5 * (f64::from(found[k]) + f64::from(found[k + step]));
                    let found = found_sums[k + 1] - found_sums[k];
                    assert_abs_diff_eq!(
                        found,
                        cell,
                        epsilon = 1e-14 * height as f64,
                        "{i} {k} {width} × {height}"
                    );
                }
                let cell = cells / 2;
                let ends = [found[cell.min(stride - 1)], found[(cell + step).min(stride - 1)]].map(f64::from);
                let below = if cells.is_multiple_of(2) { 0.0 } else { 0.375 * ends[0] + 0.125 * ends[1] };
                assert_abs_diff_eq!(
                    found_sums[cell],
                    -below,
                    epsilon = 1e-15,
                    "{i} {width} × {height} {kind:?}"
                );
            }
        }
    }

    #[test]
    fn invalid_texels_inside_the_disk_are_found() {
        for ([width, height], kind) in SIZES.into_iter().flat_map(|size| KINDS.map(|kind| (size, kind))) {
            let sound = texels(width, height);
            for k in (0..width * height).step_by(1 + width * height / 97) {
                for bad in [-1e-30, f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
                    let mut texels = sound.clone();
                    texels[k] = bad;
                    let found = integrals(width, height, &texels, kind).is_none();
                    assert_eq!(found, !sound[k].is_nan(), "{bad} at {k} of {width} × {height}");
                }
            }
        }
    }
}
