//! Noises that blend one linear function per corner of a cell: gradient, value, value-gradient and Gaussian noise.
//!
//! The corners' functions are first blended along all axes but the first. That leaves two columns, linear in the first
//! coordinate, which do not change along a row of a grid:
//!
//! ```text
//! n = A₀ t + B₀ + w(t) (ΔA t + ΔB),   ΔA = A₁ − A₀,   ΔB = B₁ − A₁ − B₀
//! ```

use crate::{
    columns::{Stretch, rows},
    fade::Fade,
    kernel::{Kernel, LaneSample, Row, gaussian_moments},
    lanes::Lanes,
    lattice::{Lattice, cell},
    span::{Span, lerp},
    statistics::Statistics,
    variance::{Variance, axis_variance},
};

/// The linear function of a corner: its value there and its gradient.
#[derive(Clone, Copy)]
pub(crate) struct Corner<S: Lanes, const N: usize> {
    pub(crate) value: S::F,
    pub(crate) gradient: [S::F; N],
}

/// What a noise draws at the corners of its cells, and how it blends them.
pub(crate) trait CellNoise<const N: usize> {
    /// Where the words come from.
    type Lattice: Lattice;
    /// Whether corners have values other than 0.
    const HAS_VALUE: bool;
    /// Whether corners have gradients other than 0.
    const HAS_GRADIENT: bool;
    /// The weights.
    const FADE: Fade;
    /// Whether the sum is divided by its standard deviation at the point, see [`Gaussian`](crate::Gaussian).
    const NORMALISED: bool = false;

    fn lattice(&self) -> &Self::Lattice;
    fn corner<S: Lanes>(&self, s: S, word: S::U) -> Corner<S, N>;
    fn statistics(&self) -> &'static Statistics;
    fn standard_deviation(&self) -> f32 {
        self.statistics().standard_deviation
    }
    fn absolute_moments(&self) -> [f32; 4] {
        gaussian_moments(self.standard_deviation())
    }
}

/// The blend of the corners at one end of a cell's first axis: A t + B, with ∂A and ∂B along the other axes.
#[derive(Clone, Copy)]
pub(crate) struct Column<S: Lanes, const N: usize> {
    pub(crate) a: S::F,
    pub(crate) b: S::F,
    pub(crate) da: [S::F; N],
    pub(crate) db: [S::F; N],
}

impl<S: Lanes, const N: usize> Column<S, N> {
    #[inline(always)]
    pub(crate) fn empty(s: S) -> Self {
        let zero = s.float(0.0);
        Self { a: zero, b: zero, da: [zero; N], db: [zero; N] }
    }
}

/// The corners at one end of the first axis, by the number of dimensions.
pub(crate) const CORNERS: [usize; 5] = [0, 1, 2, 4, 8];

/// Everything about a point's cell but the first axis.
#[derive(Clone, Copy)]
pub(crate) struct Section<S: Lanes, const N: usize> {
    /// The lattice's terms of the lower and the upper ends; those of the first axis are 0.
    pub(crate) terms: [[S::U; 2]; N],
    pub(crate) place: [S::F; N],
    pub(crate) weight: [S::F; N],
    pub(crate) slope: [S::F; N],
}

impl<S: Lanes, const N: usize> Section<S, N> {
    #[inline(always)]
    pub(crate) fn new<K: CellNoise<N>>(s: S, noise: &K, p: &[S::F; N]) -> Self {
        let zero = s.float(0.0);
        let mut section =
            Self { terms: [[s.word(0); 2]; N], place: [zero; N], weight: [zero; N], slope: [zero; N] };
        for axis in 1..N {
            let (cell, t) = cell(s, p[axis]);
            section.terms[axis] = noise.lattice().terms(s, axis, cell);
            section.place[axis] = t;
            section.weight[axis] = K::FADE.weight(s, t);
            section.slope[axis] = K::FADE.slope(s, t);
        }
        section
    }

    /// What the lattice draws at corner `k` of the section, `term` being that of the first axis.
    ///
    /// Bit i of k tells the end along axis i + 1.
    #[inline(always)]
    pub(crate) fn corner<K: CellNoise<N>>(
        &self,
        s: S,
        noise: &K,
        term: S::U,
        k: usize,
        seed: u32,
    ) -> Corner<S, N> {
        let mut terms = [term; N];
        for axis in 1..N {
            terms[axis] = self.terms[axis][k >> (axis - 1) & 1];
        }
        noise.corner(s, noise.lattice().words(s, terms, seed))
    }

    /// The function of corner `k` along the first axis.
    #[inline(always)]
    pub(crate) fn leaf<K: CellNoise<N>>(&self, s: S, corner: Corner<S, N>, k: usize) -> Column<S, N> {
        let zero = s.float(0.0);
        let mut column = Column { a: zero, b: corner.value, da: [zero; N], db: [zero; N] };
        if K::HAS_GRADIENT {
            column.a = corner.gradient[0];
            for axis in 1..N {
                let d = match k >> (axis - 1) & 1 {
                    0 => self.place[axis],
                    _ => self.place[axis] - s.float(1.0),
                };
                let rise = corner.gradient[axis] * d;
                column.b = if axis == 1 && !K::HAS_VALUE { rise } else { column.b + rise };
                column.db[axis] = corner.gradient[axis];
            }
        }
        column
    }

    /// The blend of the corners' functions, of which the first 2ⁿ⁻¹ are meant.
    #[inline(always)]
    pub(crate) fn column<K: CellNoise<N>>(&self, mut columns: [Column<S, N>; 8]) -> Column<S, N> {
        for axis in 1..N {
            for i in 0..CORNERS[N] >> axis {
                let (low, high) = (columns[2 * i], columns[2 * i + 1]);
                columns[i] = self.blend::<K>(low, high, axis);
            }
        }
        columns[0]
    }

    /// The blend at one end of the first axis, `term` being that end's.
    #[inline(always)]
    fn column_at<K: CellNoise<N>>(&self, s: S, noise: &K, term: S::U, seed: u32) -> Column<S, N> {
        let mut columns = [Column::empty(s); 8];
        for k in 0..CORNERS[N] {
            columns[k] = self.leaf::<K>(s, self.corner(s, noise, term, k, seed), k);
        }
        self.column::<K>(columns)
    }

    /// The blend of two ends along `axis`; the axes before it have been blended.
    #[inline(always)]
    pub(crate) fn blend<K: CellNoise<N>>(
        &self,
        low: Column<S, N>,
        high: Column<S, N>,
        axis: usize,
    ) -> Column<S, N> {
        let (w, slope) = (self.weight[axis], self.slope[axis]);
        let mut blend = low;
        blend.b = lerp::<S>(low.b, high.b, w);
        for i in 1..N {
            if K::HAS_GRADIENT || i < axis {
                blend.db[i] = lerp::<S>(low.db[i], high.db[i], w);
            }
        }
        let rise = slope * (high.b - low.b);
        blend.db[axis] = if K::HAS_GRADIENT { blend.db[axis] + rise } else { rise };
        if K::HAS_GRADIENT {
            blend.a = lerp::<S>(low.a, high.a, w);
            for i in 1..axis {
                blend.da[i] = lerp::<S>(low.da[i], high.da[i], w);
            }
            blend.da[axis] = slope * (high.a - low.a);
        }
        blend
    }
}

/// The sum at a point before it is normalised, with what is needed for that.
pub(crate) struct Place<S: Lanes, const N: usize> {
    pub(crate) section: Section<S, N>,
    pub(crate) columns: [Column<S, N>; 2],
    pub(crate) t: S::F,
}

impl<S: Lanes, const N: usize> Place<S, N> {
    #[inline(always)]
    fn new<K: CellNoise<N>>(s: S, noise: &K, p: [S::F; N], seed: u32) -> Self {
        let (section, [low, high], t) = Self::section(s, noise, p);
        let columns = [section.column_at(s, noise, low, seed), section.column_at(s, noise, high, seed)];
        Self { section, columns, t }
    }

    /// Where a point lies: all axes but the first, and the terms and the place along the first.
    #[inline(always)]
    pub(crate) fn section<K: CellNoise<N>>(
        s: S,
        noise: &K,
        p: [S::F; N],
    ) -> (Section<S, N>, [S::U; 2], S::F) {
        let section = Section::new(s, noise, &p);
        let (cell, t) = cell(s, p[0]);
        (section, noise.lattice().terms(s, 0, cell), t)
    }

    /// The function of the columns' A and B; along an axis other than the first, of their derivatives.
    #[inline(always)]
    pub(crate) fn span<K: CellNoise<N>>(&self, axis: usize) -> Span<S> {
        let [low, high] = &self.columns;
        let (low, high) = if axis == 0 {
            ([low.a, low.b], [high.a, high.b])
        } else {
            ([low.da[axis], low.db[axis]], [high.da[axis], high.db[axis]])
        };
        if K::HAS_GRADIENT { Span::new::<true>(low, high) } else { Span::new::<false>(low, high) }
    }

    /// n and its gradient, and v and its gradient where the noise is normalised.
    #[inline(always)]
    pub(crate) fn parts<K: CellNoise<N>>(&self, s: S) -> (LaneSample<S, N>, LaneSample<S, N>) {
        let (w, slope) = (K::FADE.weight(s, self.t), K::FADE.slope(s, self.t));
        let span = self.span::<K>(0);
        let mut gradient = [span.derivative::<K, N>(self.t, w, slope); N];
        for axis in 1..N {
            gradient[axis] = self.span::<K>(axis).value::<K, N>(self.t, w);
        }
        let value = span.value::<K, N>(self.t, w);
        let variance = variance(s, &self.section);
        let axis = axis_variance(s, self.t, w, slope);
        ((value, gradient), (variance.value(axis), variance.gradient(axis)))
    }
}

/// The variance of the section.
#[inline(always)]
pub(crate) fn variance<S: Lanes, const N: usize>(s: S, section: &Section<S, N>) -> Variance<S, N> {
    Variance::new(s, &section.place, &section.weight, &section.slope)
}

/// n and its gradient, and v and its gradient where the noise is normalised.
#[inline(always)]
pub(crate) fn parts<K: CellNoise<N>, S: Lanes, const N: usize>(
    s: S,
    noise: &K,
    p: [S::F; N],
    seed: u32,
) -> (LaneSample<S, N>, LaneSample<S, N>) {
    Place::new(s, noise, p, seed).parts::<K>(s)
}

/// n/√v and its gradient.
#[inline(always)]
pub(crate) fn normalised<S: Lanes, const N: usize>(
    s: S,
    (value, gradient): LaneSample<S, N>,
    (v, dv): LaneSample<S, N>,
) -> LaneSample<S, N> {
    let inverse = s.float(1.0) / s.sqrt(v);
    let z = value * inverse;
    let factor = z * (s.float(0.5) * inverse * inverse);
    let mut dz = gradient;
    for axis in 0..N {
        dz[axis] = gradient[axis] * inverse - factor * dv[axis];
    }
    (z, dz)
}

impl<K: CellNoise<N>, const N: usize> Kernel<N> for K {
    #[inline(always)]
    fn lane_values<S: Lanes>(&self, s: S, p: [S::F; N], seed: u32) -> S::F {
        let place = Place::new(s, self, p, seed);
        let w = K::FADE.weight(s, place.t);
        let value = place.span::<K>(0).value::<K, N>(place.t, w);
        if !K::NORMALISED {
            return value;
        }
        let axis = axis_variance(s, place.t, w, s.float(0.0));
        value * (s.float(1.0) / s.sqrt(variance(s, &place.section).value(axis)))
    }

    #[inline(always)]
    fn lane_samples<S: Lanes>(&self, s: S, p: [S::F; N], seed: u32) -> LaneSample<S, N> {
        let (sample, variance) = parts(s, self, p, seed);
        if K::NORMALISED { normalised(s, sample, variance) } else { sample }
    }

    #[inline(always)]
    fn row_values<S: Lanes, const SCALED: bool>(
        &self,
        s: S,
        row: &Row<N, SCALED>,
        seed: u32,
        columns: &mut Stretch<N>,
        values: &mut [f32],
    ) {
        rows::<K, S, N, SCALED, false>(
            s,
            self,
            row,
            seed,
            columns,
            values,
            &mut [(); N].map(|()| &mut [][..]),
        );
    }

    #[inline(always)]
    fn row_samples<S: Lanes, const SCALED: bool>(
        &self,
        s: S,
        row: &Row<N, SCALED>,
        seed: u32,
        columns: &mut Stretch<N>,
        values: &mut [f32],
        gradients: &mut [&mut [f32]; N],
    ) {
        rows::<K, S, N, SCALED, true>(s, self, row, seed, columns, values, gradients);
    }

    fn statistics(&self) -> &'static Statistics {
        CellNoise::statistics(self)
    }

    fn standard_deviation(&self) -> f32 {
        CellNoise::standard_deviation(self)
    }

    fn absolute_moments(&self) -> [f32; 4] {
        CellNoise::absolute_moments(self)
    }
}
