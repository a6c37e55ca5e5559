//! The function along one axis of a height field, with its derivative and bounds of its top cells.

use asperity_core::Interval;

use crate::numeric::double::Double;
use crate::numeric::estimate::{Bounded, Estimate};
#[cfg(feature = "alloc")]
use crate::surface::height_field::axis_tables::AxisTables;
use crate::surface::height_field::function::{Axis, Function};
#[cfg(feature = "alloc")]
use crate::surface::height_field::range_table::RangeTable;
use crate::system::error::FifError;
use crate::system::support::Support;

/// A function along an axis of a [`HeightField`](crate::HeightField).
///
/// It has a derivative if that is continuous, and tables if it was
/// [`tabulated`](crate::HeightField::tabulated).
#[derive(Clone, Debug)]
pub struct Curve<F: Function> {
    function: F,
    derivative: Option<F::Derivative>,
    /// Bounds of a function that is only continuous.
    support: Option<Support>,
    #[cfg(feature = "alloc")]
    levels: Option<Levels<F>>,
}

/// Means of a function over an interval, and of its slope if it exists.
#[derive(Clone, Copy, Debug)]
pub(crate) struct LineMeans {
    /// The mean of `f`.
    pub(crate) value: Estimate,
    /// The mean of `f²`.
    pub(crate) value_squared: Estimate,
    /// The means of `f′`, of `f′²` and of `f f′`.
    pub(crate) slope: Option<[Estimate; 3]>,
}

/// A cell of a function and of its derivative.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Both<V, D> {
    value: V,
    slope: D,
}

/// A cell below the tables: the data for its bounds.
pub(crate) type Below<F> = Both<<F as Axis>::Cell, <<F as Axis>::Derivative as Axis>::Cell>;

/// A cell of a curve.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Cell<B> {
    /// A cell of the table, by its index.
    #[cfg(feature = "alloc")]
    Top(usize),
    Below(B),
}

impl<F: Function> Curve<F> {
    pub(crate) fn new(function: F) -> Self {
        let derivative = function.differentiated();
        Self {
            support: if derivative.is_none() { function.support() } else { None },
            derivative,
            function,
            #[cfg(feature = "alloc")]
            levels: None,
        }
    }

    /// Adds a table of the value and slope ranges of its top levels, with at most `cells` cells in
    /// the last one.
    #[cfg(feature = "alloc")]
    pub(crate) fn tabulated(self, cells: usize) -> Self {
        Self { levels: Some(Levels::new(&self, cells)), ..self }
    }

    /// The function.
    #[must_use]
    pub const fn function(&self) -> &F {
        &self.function
    }

    /// Its derivative, by [`System::derivative`](crate::System::derivative).
    #[must_use]
    pub const fn derivative(&self) -> Option<&F::Derivative> {
        self.derivative.as_ref()
    }

    /// `[x_0, x_N]`.
    pub fn domain(&self) -> Interval {
        self.function.domain()
    }

    /// A rigorous enclosure of the values.
    pub fn range(&self) -> Interval {
        #[cfg(feature = "alloc")]
        if let Some(levels) = &self.levels {
            return levels.bounds(0)[0];
        }
        self.function.range()
    }

    /// The value at `x`, see [`System::evaluate`](crate::System::evaluate).
    pub fn evaluate(&self, x: f64, tolerance: f64) -> Bounded {
        self.function.evaluate(x, tolerance)
    }

    /// The slope at `x` to the rounding error, or `None` for a function that is only continuous.
    #[must_use]
    pub fn slope(&self, x: f64) -> Option<f64> {
        Some(self.derivative.as_ref()?.evaluate(x, 0.0).value)
    }

    /// Memory of the tables in bytes.
    #[cfg(feature = "alloc")]
    #[must_use]
    pub fn bytes(&self) -> usize {
        self.levels.as_ref().map_or(0, Levels::bytes)
    }

    /// Ranges over runs of cells, for shaders.
    ///
    /// Available if the function is smooth, its knots are equally spaced, and the field is
    /// [`tabulated`](crate::HeightField::tabulated).
    #[cfg(feature = "alloc")]
    pub(crate) fn ranges(&self) -> Option<&RangeTable> {
        self.top().map(|top| &top.ranges)
    }

    /// The tables of values and slopes, if any.
    #[cfg(feature = "alloc")]
    #[inline]
    pub(crate) fn top(&self) -> Option<&AxisTables<F::Rows>> {
        self.levels.as_ref()?.tables.as_ref()
    }

    /// The value to the rounding error, consistent with the precision of the coordinates of a ray.
    #[inline]
    pub(crate) fn near(&self, x: f64) -> Bounded {
        #[cfg(feature = "alloc")]
        if let Some(AxisTables { jets, .. }) = self.top() {
            let (steps, bound) = jets.finest();
            return Bounded { value: jets.jet(jets.part(x), steps)[0], bound };
        }
        self.function.evaluate(x, 0.0)
    }

    /// The value at a position between doubles.
    pub(crate) fn at(&self, x: Double, tolerance: f64) -> Bounded {
        self.function.evaluate_between(x, tolerance)
    }

    /// The whole domain.
    pub(crate) fn root(&self) -> Cell<Below<F>> {
        #[cfg(feature = "alloc")]
        if self.levels.is_some() {
            return Cell::Top(0);
        }
        Cell::Below(Self::below())
    }

    /// The whole domain, in the form of a cell below the tables.
    pub(crate) fn below() -> Below<F> {
        Both { value: F::root(), slope: F::Derivative::root() }
    }

    /// The number of children of a cell.
    #[inline]
    pub(crate) fn count(&self) -> usize {
        self.function.count()
    }

    /// Knots of child `j` in units of the width of the cell.
    #[inline]
    pub(crate) fn part(&self, j: usize) -> [f64; 2] {
        self.function.part(j)
    }

    /// Child `j`; the cell itself if it does not exist.
    #[inline]
    pub(crate) fn child(&self, cell: &Cell<Below<F>>, j: usize) -> Cell<Below<F>> {
        match cell {
            #[cfg(feature = "alloc")]
            Cell::Top(i) => match self.levels.as_ref().and_then(|levels| levels.leaf(*i)) {
                Some(leaf) => Cell::Below(self.child_below(leaf, j)),
                None => Cell::Top(i * self.count() + 1 + j),
            },
            Cell::Below(cell) => Cell::Below(self.child_below(cell, j)),
        }
    }

    #[inline]
    pub(crate) fn child_below(&self, cell: &Below<F>, j: usize) -> Below<F> {
        let slope = self.derivative.as_ref().map_or(cell.slope, |slope| slope.child(&cell.slope, j));
        Both { value: self.function.child(&cell.value, j), slope }
    }

    /// Enclosures of the values and slopes over the cell; unknown slopes are [`Interval::ENTIRE`].
    #[inline]
    pub(crate) fn bounds(&self, cell: &Cell<Below<F>>) -> [Interval; 2] {
        match cell {
            #[cfg(feature = "alloc")]
            Cell::Top(i) => self.levels.as_ref().map_or([Interval::ENTIRE; 2], |levels| levels.bounds(*i)),
            Cell::Below(cell) => self.bounds_below(cell),
        }
    }

    #[inline]
    pub(crate) fn bounds_below(&self, cell: &Below<F>) -> [Interval; 2] {
        let slope = self.derivative.as_ref().map_or(Interval::ENTIRE, |slope| slope.cell_range(&cell.slope));
        let value = match &self.support {
            Some(support) => self.function.supported_range(&cell.value, support),
            None => self.function.cell_range(&cell.value),
        };
        [value, slope]
    }

    /// Means over the interval between `l` and `r`, clamped to the domain; the values at `l` if
    /// they are equal.
    pub(crate) fn means(&self, l: f64, r: f64) -> Result<LineMeans, FifError> {
        let (value, value_squared) = (self.function.mean(l, r), self.function.mean_square(l, r)?);
        let Some(derivative) = &self.derivative else {
            return Ok(LineMeans { value, value_squared, slope: None });
        };
        let slope = derivative.mean(l, r);
        // ∫ f f′ = (f(r)² − f(l)²)/2 = (f(r) + f(l))/2 · ∫ f′: the second form does not cancel.
        let [a, b] = [l, r].map(|x| self.function.evaluate(x, 0.0));
        let (sum, size) = (0.5 * (a.value + b.value), 0.5 * (a.value.abs() + b.value.abs()));
        // Values belong to points within eight units in the last place.
        let domain = self.function.domain();
        let far = domain.magnitude() + domain.width();
        let moved = 16.0 * f64::EPSILON * far * derivative.range().magnitude();
        let ends = Estimate::new(sum, size, a.bound + b.bound + moved);
        let slope = [slope, derivative.mean_square(l, r)?, ends.product(slope)];
        Ok(LineMeans { value, value_squared, slope: Some(slope) })
    }
}

/// A table of the value and slope ranges of the top levels of cells of a curve.
#[cfg(feature = "alloc")]
#[derive(Clone, Debug)]
struct Levels<F: Function> {
    /// Level by level; the children of cell `i` are `i N + 1` to `i N + N`.
    bounds: alloc::vec::Vec<[Interval; 2]>,
    /// The cells of the last level.
    leaves: alloc::vec::Vec<Below<F>>,
    /// Ranges over runs of leaves, and values and slopes, if available.
    tables: Option<AxisTables<F::Rows>>,
}

#[cfg(feature = "alloc")]
impl<F: Function> Levels<F> {
    /// Creates at most `cells` cells in the last level; 0 and 1 keep only the bounds of the domain.
    fn new(curve: &Curve<F>, cells: usize) -> Self {
        // Levels below the last one from which its bounds are computed.
        const BELOW: u32 = 3;
        let maps = curve.count().max(2);
        let mut leaves = alloc::vec![Curve::<F>::below()];
        while leaves.len().saturating_mul(maps) <= cells {
            leaves = leaves.iter().flat_map(|cell| (0..maps).map(|j| curve.child_below(cell, j))).collect();
        }
        let below = if maps.pow(2) > 64 { 1 } else { BELOW };
        // From the last level up, then reversed.
        let mut levels: alloc::vec::Vec<alloc::vec::Vec<[Interval; 2]>> =
            alloc::vec![leaves.iter().map(|cell| finer(curve, cell, below)).collect()];
        let slopes = curve.derivative().filter(|_| cells > 1).map(Axis::range);
        let jets = slopes.and_then(|slopes| curve.function().jets(slopes));
        let tables = jets.zip(levels.first()).map(|(jets, last)| AxisTables::new(last, jets, curve.domain()));
        while let Some(last) = levels.last()
            && last.len() > 1
        {
            let above = last.chunks(maps).map(|group| group.iter().copied().fold([Interval::EMPTY; 2], hull));
            levels.push(above.collect());
        }
        Self { bounds: levels.into_iter().rev().flatten().collect(), leaves, tables }
    }

    fn bytes(&self) -> usize {
        let tables = self.tables.as_ref().map_or(0, |tables| tables.ranges.bytes() + tables.jets.bytes());
        size_of_val(self.bounds.as_slice()) + size_of_val(self.leaves.as_slice()) + tables
    }

    /// Enclosures of the values and slopes over a cell of the table.
    #[inline]
    fn bounds(&self, index: usize) -> [Interval; 2] {
        self.bounds.get(index).copied().unwrap_or([Interval::ENTIRE; 2])
    }

    /// A cell of the last level, by its index in the table.
    #[inline]
    fn leaf(&self, index: usize) -> Option<&Below<F>> {
        self.leaves.get(index.checked_sub(self.bounds.len() - self.leaves.len())?)
    }
}

/// The bounds of a cell as the hull of its descendants some levels below.
#[cfg(feature = "alloc")]
fn finer<F: Function>(curve: &Curve<F>, cell: &Below<F>, levels: u32) -> [Interval; 2] {
    let own = curve.bounds_below(cell);
    if levels == 0 {
        return own;
    }
    let children = (0..curve.count()).map(|j| finer(curve, &curve.child_below(cell, j), levels - 1));
    let all = children.fold([Interval::EMPTY; 2], hull);
    [0, 1].map(|k| all[k].intersection(own[k]))
}

#[cfg(feature = "alloc")]
fn hull(a: [Interval; 2], b: [Interval; 2]) -> [Interval; 2] {
    [a[0].hull(b[0]), a[1].hull(b[1])]
}

#[cfg(all(test, feature = "alloc"))]
mod tests {
    use super::*;
    use crate::{Fif, cochran_2000};

    fn tabulated<F: Function>(function: F, cells: usize) -> Curve<F> {
        Curve::new(function).tabulated(cells)
    }

    /// The numbers of leaves and of all cells.
    fn sizes<F: Function>(curve: &Curve<F>) -> Option<[usize; 2]> {
        curve.levels.as_ref().map(|levels| [levels.leaves.len(), levels.bounds.len()])
    }

    #[test]
    fn cells_in_and_below_the_table_contain_their_samples() {
        fn check<F: Function>(function: F, cells: usize, levels: u32, slack: f64) -> Curve<F> {
            let curve = tabulated(function, cells);
            let mut row = alloc::vec![(curve.root(), curve.domain().lo, curve.domain().width())];
            for _ in 0..levels {
                for (cell, left, width) in &row {
                    let [value, slope] = curve.bounds(cell);
                    for k in 0..=4 {
                        let x = left + width * f64::from(k) / 4.0;
                        let y = curve.evaluate(x, 1e-14).value;
                        assert!(value.inflated(slack).contains(y), "{value:?} {x} {y:?}");
                        let rise = curve.slope(x).unwrap_or(0.0);
                        assert!(slope.inflated(slack).contains(rise), "{slope:?} {x} {rise}");
                    }
                }
                let parts = row.iter().flat_map(|&(cell, left, width)| {
                    let curve = &curve;
                    (0..curve.count()).map(move |j| {
                        let [s0, s1] = curve.part(j);
                        (curve.child(&cell, j), left + width * s0, width * (s1 - s0))
                    })
                });
                row = parts.collect();
            }
            curve
        }
        let f = Fif::affine(&[0.0, 0.2, 0.7, 1.0], &[0.3, 1.0, -0.5, 0.25], &[0.4, -0.6, 0.5]).unwrap();
        // A sample at the border may belong to the neighbor: an ulp of x moves f by 1e-9 here.
        let uneven = check(f, 100, 6, 1e-9);
        assert_eq!(sizes(&uneven), Some([81, 1 + 3 + 9 + 27 + 81]));
        check(cochran_2000::g_hat().unwrap(), 16, 7, 1e-12);
    }

    #[test]
    fn table_of_one_cell() {
        let cached = tabulated(cochran_2000::f().unwrap(), 0);
        assert_eq!(sizes(&cached), Some([1, 1]));
        assert!(cached.range().contains(4.0 / 3.0));
        assert!(matches!(cached.child(&cached.root(), 1), Cell::Below(_)));
    }
}
