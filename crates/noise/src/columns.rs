//! Rows of cell noises: what does not change along a row, or from row to row of a grid, is computed once.
//!
//! Along a row a cell's function has four constants, A₀, B₀, ΔA and ΔB. Places and weights are the same in all rows of a
//! grid, and the corners' values and gradients in all rows that cross the same cells.

use crate::{
    cell_noise::{CORNERS, CellNoise, Column, Corner, Section, normalised, variance},
    fade::Fade,
    kernel::{Kernel, Row, RowKey, put, put_sample},
    lanes::{LANES, Lanes, Scalar},
    lattice::Lattice,
    span::{Span, splat},
    variance::{Variance, axis_variance},
};

/// Points of a row that are planned at once.
pub(crate) const POINTS: usize = 512;
/// Columns that are computed at once along a row.
const COLUMNS: usize = 64;
/// Steps from here on leave too few points in a cell for columns to pay.
const LONG_STEP: f32 = 0.95;
/// Steps from here on leave so few points in a cell that lanes gather their cells' constants one by one.
const SPARSE_STEP: f32 = 0.22;

/// Values, and gradients if `GRADIENTS`, along a row, cell by cell.
#[inline(always)]
pub(crate) fn rows<K: CellNoise<N>, S: Lanes, const N: usize, const SCALED: bool, const GRADIENTS: bool>(
    s: S,
    noise: &K,
    row: &Row<N, SCALED>,
    seed: u32,
    stretch: &mut Stretch<N>,
    values: &mut [f32],
    gradients: &mut [&mut [f32]; N],
) {
    let count = values.len();
    if has_columns(row, count) {
        let section = Section::<Scalar, N>::new(Scalar, noise, &row.origin());
        let mut start = 0;
        while start < count {
            let points = POINTS.min(count - start);
            stretch.plan.make(s, K::FADE, &row.after(start), points);
            stretch.evaluate::<K, S, GRADIENTS>(s, noise, &section, seed, start, values, gradients);
            start += points;
        }
        return;
    }
    for i in (0..count).step_by(S::LEN) {
        let p = row.points(s, i);
        if GRADIENTS {
            put_sample(s, noise.lane_samples(s, p, seed), values, gradients, i);
        } else {
            put(s, noise.lane_values(s, p, seed), values, i, count);
        }
    }
}

/// Whether cells hold several points each, and where they begin can be computed.
#[inline(always)]
pub(crate) fn has_columns<const N: usize, const SCALED: bool>(row: &Row<N, SCALED>, count: usize) -> bool {
    let step = row.stride().abs();
    let reach = row.x(0).abs().max(row.x(count).abs());
    step < LONG_STEP && step > reach * 1e-6 && count < 1 << 24
}

/// The cells of a row's points, and the points' places and weights in them.
#[derive(Clone, Debug)]
struct Plan {
    /// The row that the plan is of.
    key: Option<(RowKey, Fade, usize)>,
    /// The first point's cell, and whether cells descend from there.
    cell: i32,
    descending: bool,
    /// Whether few points lie in a cell.
    sparse: bool,
    /// The index after the last point of every cell, in the order of the points; there are fewer cells than points.
    cells: usize,
    ends: [u16; POINTS],
    /// The column of every point's cell among those that are computed at once.
    column: [u8; POINTS + LANES],
    place: [f32; POINTS + LANES],
    weight: [f32; POINTS + LANES],
    slope: [f32; POINTS + LANES],
}

impl Plan {
    const EMPTY: Self = Self {
        key: None,
        cell: 0,
        descending: false,
        sparse: false,
        cells: 0,
        ends: [0; POINTS],
        column: [0; POINTS + LANES],
        place: [0.0; POINTS + LANES],
        weight: [0.0; POINTS + LANES],
        slope: [0.0; POINTS + LANES],
    };

    #[inline(always)]
    fn make<S: Lanes, const N: usize, const SCALED: bool>(
        &mut self,
        s: S,
        fade: Fade,
        row: &Row<N, SCALED>,
        points: usize,
    ) {
        let key = Some((row.key(), fade, points));
        if self.key == key {
            return;
        }
        self.key = key;
        self.cell = Scalar.floor(row.x(0)) as i32;
        self.descending = row.stride() < 0.0;
        self.sparse = row.stride().abs() >= SPARSE_STEP;
        self.cells = 0;
        let inverse = 1.0 / row.stride();
        let (mut i, mut cell) = (0, self.cell);
        while i < points && self.cells < POINTS {
            let floor = cell as f32;
            let end = end_of_cell(row, floor, inverse, i, points);
            self.ends[self.cells] = end as u16;
            self.cells += 1;
            while i < end {
                let t = row.xs(s, i) - s.float(floor);
                s.store(t, &mut self.place[i..]);
                s.store(fade.weight(s, t), &mut self.weight[i..]);
                s.store(fade.slope(s, t), &mut self.slope[i..]);
                i += S::LEN;
            }
            i = end;
            cell = if self.descending { cell.wrapping_sub(1) } else { cell.wrapping_add(1) };
        }
        if self.sparse {
            self.number_columns();
        }
    }

    /// Gives every point the column of its cell.
    #[inline(always)]
    fn number_columns(&mut self) {
        let (mut i, mut first) = (0, 0);
        while first < self.cells {
            let cells = (self.cells - first).min(COLUMNS - 1);
            for j in 0..cells {
                let k = if self.descending { cells - 1 - j } else { j };
                let end = usize::from(self.ends[(first + j) % POINTS]).min(POINTS);
                while i < end {
                    self.column[i] = k as u8;
                    i += 1;
                }
            }
            first += cells;
        }
    }
}

/// The index after the last point from `i` on that lies in the cell at `floor`.
#[inline(always)]
pub(crate) fn end_of_cell<const N: usize, const SCALED: bool>(
    row: &Row<N, SCALED>,
    floor: f32,
    inverse: f32,
    i: usize,
    count: usize,
) -> usize {
    let border = if row.stride() < 0.0 { floor } else { floor + 1.0 };
    let guess = (border - row.x(0)) * inverse;
    let mut end = (guess as i32).max(0) as usize;
    end = end.clamp(i, count);
    let inside = |i: usize| {
        let x = row.x(i);
        if row.stride() < 0.0 { x >= floor } else { x < border }
    };
    while end < count && inside(end) {
        end += 1;
    }
    while end > i && !inside(end - 1) {
        end -= 1;
    }
    end
}

/// One number per column.
type Numbers = [f32; COLUMNS];

/// The columns of the cells that a stretch of a row crosses, and what they are made of.
#[derive(Clone, Debug)]
pub struct Stretch<const N: usize> {
    plan: Plan,
    /// The cells, terms of the section and seed that the corners are of.
    key: Option<(i32, usize, [[u32; 2]; N], u32)>,
    corner_values: [Numbers; 8],
    corner_gradients: [[Numbers; N]; 8],
    /// What starts a span, A₀ and B₀, and its rises ΔA and ΔB; for axes from the second on their derivatives.
    a: [[Numbers; 2]; N],
    b: [[Numbers; 2]; N],
}

impl<const N: usize> Stretch<N> {
    pub(crate) const EMPTY: Self = Self {
        plan: Plan::EMPTY,
        key: None,
        corner_values: [[0.0; COLUMNS]; 8],
        corner_gradients: [[[0.0; COLUMNS]; N]; 8],
        a: [[[0.0; COLUMNS]; 2]; N],
        b: [[[0.0; COLUMNS]; 2]; N],
    };

    /// The planned points, from `start` on in the outputs.
    ///
    /// Whole vectors are written for every cell; the next cell overwrites what lies beyond the cell's end.
    #[inline(always)]
    #[expect(clippy::too_many_arguments, reason = "one call for every kind, row and output")]
    fn evaluate<K: CellNoise<N>, S: Lanes, const GRADIENTS: bool>(
        &mut self,
        s: S,
        noise: &K,
        section: &Section<Scalar, N>,
        seed: u32,
        start: usize,
        values: &mut [f32],
        gradients: &mut [&mut [f32]; N],
    ) {
        let rest = variance(Scalar, section);
        let rest = rest.splat(s);
        let (mut i, mut first) = (0, 0);
        while first < self.plan.cells {
            let cells = (self.plan.cells - first).min(COLUMNS - 1);
            let leftmost = if self.plan.descending {
                self.plan.cell.wrapping_sub((first + cells - 1) as i32)
            } else {
                self.plan.cell.wrapping_add(first as i32)
            };
            self.draw(s, noise, section, leftmost, cells + 1, seed);
            self.fill::<K, S, GRADIENTS>(s, section, cells + 1);
            if self.plan.sparse {
                let end = usize::from(self.plan.ends[(first + cells - 1) % POINTS]);
                while i < end {
                    let spans = self.gathered::<S, GRADIENTS>(s, i);
                    self.store::<K, S, GRADIENTS>(s, &rest, &spans, i, start, values, gradients);
                    i += S::LEN;
                }
                i = end;
                first += cells;
                continue;
            }
            for j in 0..cells {
                let k = if self.plan.descending { cells - 1 - j } else { j };
                let end = usize::from(self.plan.ends[(first + j) % POINTS]);
                let spans = self.spans::<S, GRADIENTS>(s, k);
                while i < end {
                    self.store::<K, S, GRADIENTS>(s, &rest, &spans, i, start, values, gradients);
                    i += S::LEN;
                }
                i = end;
            }
            first += cells;
        }
    }

    /// The values of the planned points from `i` on, from the constants of their cells.
    #[inline(always)]
    #[expect(clippy::too_many_arguments, reason = "one call for every kind, row and output")]
    fn store<K: CellNoise<N>, S: Lanes, const GRADIENTS: bool>(
        &self,
        s: S,
        rest: &Variance<S, N>,
        spans: &[Span<S>; N],
        i: usize,
        start: usize,
        values: &mut [f32],
        gradients: &mut [&mut [f32]; N],
    ) {
        let (t, w) = (s.load(&self.plan.place[i..]), s.load(&self.plan.weight[i..]));
        let mut value = spans[0].value::<K, N>(t, w);
        if GRADIENTS {
            let slope = s.load(&self.plan.slope[i..]);
            let mut gradient = [spans[0].derivative::<K, N>(t, w, slope); N];
            for axis in 1..N {
                gradient[axis] = spans[axis].value::<K, N>(t, w);
            }
            if K::NORMALISED {
                let axis = axis_variance(s, t, w, slope);
                let v = (rest.value(axis), rest.gradient(axis));
                (value, gradient) = normalised(s, (value, gradient), v);
            }
            put_sample(s, (value, gradient), values, gradients, start + i);
            return;
        }
        if K::NORMALISED {
            let axis = axis_variance(s, t, w, s.float(0.0));
            value = value * (s.float(1.0) / s.sqrt(rest.value(axis)));
        }
        put(s, value, values, start + i, values.len());
    }

    /// The spans of the cells of as many points as there are lanes, from point `i` on.
    #[inline(always)]
    fn gathered<S: Lanes, const GRADIENTS: bool>(&self, s: S, i: usize) -> [Span<S>; N] {
        let mut columns = [0; LANES];
        for lane in 0..S::LEN {
            columns[lane % LANES] = usize::from(self.plan.column[i + lane]) % COLUMNS;
        }
        let mut spans = [Span::new::<false>([s.float(0.0); 2], [s.float(0.0); 2]); N];
        for axis in 0..if GRADIENTS { N } else { 1 } {
            let ([a, rise_a], [b, rise_b]) = (&self.a[axis], &self.b[axis]);
            spans[axis] = Span {
                a: s.floats(|lane| a[columns[lane % LANES]]),
                b: s.floats(|lane| b[columns[lane % LANES]]),
                rise_a: s.floats(|lane| rise_a[columns[lane % LANES]]),
                rise_b: s.floats(|lane| rise_b[columns[lane % LANES]]),
            };
        }
        spans
    }

    /// The corners of `count` columns from the cell `leftmost` on.
    #[inline(always)]
    fn draw<K: CellNoise<N>, S: Lanes>(
        &mut self,
        s: S,
        noise: &K,
        section: &Section<Scalar, N>,
        leftmost: i32,
        count: usize,
        seed: u32,
    ) {
        let mut bits = [[0; 2]; N];
        let mut terms = [[s.word(0); 2]; N];
        for axis in 1..N {
            let [low, high] = section.terms[axis];
            bits[axis] = [low.0, high.0];
            terms[axis] = [s.word(low.0), s.word(high.0)];
        }
        let key = Some((leftmost, count, bits, seed));
        if self.key == key {
            return;
        }
        self.key = key;
        let zero = [s.float(0.0); N];
        let section = Section::<S, N> { terms, place: zero, weight: zero, slope: zero };
        let mut i = 0;
        while i < count {
            let cells = s.word(leftmost.wrapping_add(i as i32) as u32) + s.iota();
            let term = noise.lattice().term(s, 0, cells);
            for k in 0..CORNERS[N] {
                let corner = section.corner(s, noise, term, k, seed);
                if K::HAS_VALUE {
                    s.store(corner.value, &mut self.corner_values[k][i..]);
                }
                if K::HAS_GRADIENT {
                    for axis in 0..N {
                        s.store(corner.gradient[axis], &mut self.corner_gradients[k][axis][i..]);
                    }
                }
            }
            i += S::LEN;
        }
    }

    /// The constants of `count − 1` spans from the corners of `count` columns.
    #[inline(always)]
    fn fill<K: CellNoise<N>, S: Lanes, const GRADIENTS: bool>(
        &mut self,
        s: S,
        section: &Section<Scalar, N>,
        count: usize,
    ) {
        let section = Section::<S, N> {
            terms: [[s.word(0); 2]; N],
            place: splat(s, section.place),
            weight: splat(s, section.weight),
            slope: splat(s, section.slope),
        };
        let mut i = 0;
        while i < count {
            let mut columns = [Column::empty(s); 8];
            for k in 0..CORNERS[N] {
                let mut corner = Corner { value: s.float(0.0), gradient: [s.float(0.0); N] };
                if K::HAS_VALUE {
                    corner.value = s.load(&self.corner_values[k][i..]);
                }
                if K::HAS_GRADIENT {
                    for axis in 0..N {
                        corner.gradient[axis] = s.load(&self.corner_gradients[k][axis][i..]);
                    }
                }
                columns[k] = section.leaf::<K>(s, corner, k);
            }
            let column = section.column::<K>(columns);
            s.store(column.b, &mut self.b[0][0][i..]);
            if K::HAS_GRADIENT {
                s.store(column.a, &mut self.a[0][0][i..]);
            }
            if GRADIENTS {
                for axis in 1..N {
                    s.store(column.db[axis], &mut self.b[axis][0][i..]);
                    if K::HAS_GRADIENT {
                        s.store(column.da[axis], &mut self.a[axis][0][i..]);
                    }
                }
            }
            i += S::LEN;
        }
        for axis in 0..if GRADIENTS { N } else { 1 } {
            rises::<S, K, N>(s, &mut self.a[axis], &mut self.b[axis], count);
        }
    }

    /// The span of column k, and its derivatives along the axes from the second on.
    #[inline(always)]
    fn spans<S: Lanes, const GRADIENTS: bool>(&self, s: S, k: usize) -> [Span<S>; N] {
        let k = k % COLUMNS;
        let mut spans = [Span::new::<false>([s.float(0.0); 2], [s.float(0.0); 2]); N];
        for axis in 0..if GRADIENTS { N } else { 1 } {
            let ([a, rise_a], [b, rise_b]) = (&self.a[axis], &self.b[axis]);
            spans[axis] = Span {
                a: s.float(a[k]),
                b: s.float(b[k]),
                rise_a: s.float(rise_a[k]),
                rise_b: s.float(rise_b[k]),
            };
        }
        spans
    }
}

/// From the columns' A and B, the rises to the next column.
#[inline(always)]
fn rises<S: Lanes, K: CellNoise<N>, const N: usize>(
    s: S,
    [a, rise_a]: &mut [Numbers; 2],
    [b, rise_b]: &mut [Numbers; 2],
    count: usize,
) {
    let mut i = 0;
    while i < count {
        let low = [s.load_part(&a[i..]), s.load_part(&b[i..])];
        let high = [s.load_part(&a[i + 1..]), s.load_part(&b[i + 1..])];
        if K::HAS_GRADIENT {
            let span = Span::<S>::new::<true>(low, high);
            s.store(span.rise_a, &mut rise_a[i..]);
            s.store(span.rise_b, &mut rise_b[i..]);
        } else {
            s.store(Span::<S>::new::<false>(low, high).rise_b, &mut rise_b[i..]);
        }
        i += S::LEN;
    }
}
