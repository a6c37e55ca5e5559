//! Bounds of the top levels of cells, computed once.

use alloc::vec::Vec;

use crate::calculus::moment_basis::MomentError;
use crate::numeric::interval::{Bounded, Interval};
use crate::surface::height_field::axis::{Axis, CellOf, Curve, LineMeans, sealed::Descend};
use crate::surface::height_field::axis_tables::AxisTables;
use crate::surface::height_field::function::Function;
use crate::surface::height_field::jet_table::Jets;

/// A curve with a table of the value and slope ranges of its top levels of cells; made by
/// [`HeightField::tabulated`](crate::HeightField::tabulated).
#[derive(Clone, Debug)]
pub struct TabulatedCurve<F: Function> {
    curve: Curve<F>,
    /// Level after level; the children of cell `i` are `i N + 1` to `i N + N`.
    bounds: Vec<[Interval; 2]>,
    /// The cells of the last level.
    leaves: Vec<CellOf<F>>,
    /// Ranges over runs of leaves, and values and slopes, where a table can have them.
    tables: Option<AxisTables<F::Jets>>,
}

impl<F: Function> TabulatedCurve<F> {
    /// With at most `cells` cells in the last level; 0 and 1 keep the domain's own bounds only.
    pub(crate) fn new(curve: Curve<F>, cells: usize) -> Self {
        // Levels below the last one that its bounds are drawn from.
        const BELOW: u32 = 3;
        let axis = &curve;
        let maps = axis.count().max(2);
        let mut leaves: Vec<CellOf<F>> = alloc::vec![axis.root()];
        let mut level_sizes = alloc::vec![1_usize];
        while leaves.len().saturating_mul(maps) <= cells {
            leaves = leaves.iter().flat_map(|cell| (0..maps).map(|j| axis.child(cell, j))).collect();
            level_sizes.push(leaves.len());
        }
        let below = if maps.pow(2) > 64 { 1 } else { BELOW };
        // From the last level up, then turned round.
        let mut levels: Vec<Vec<[Interval; 2]>> = Vec::with_capacity(level_sizes.len());
        levels.push(leaves.iter().map(|cell| finer(axis, cell, below)).collect());
        let jets = if cells > 1 { axis.jets() } else { None };
        let tables = jets.zip(levels.first()).map(|(jets, last)| AxisTables::new(last, jets, axis.domain()));
        while let Some(last) = levels.last()
            && last.len() > 1
        {
            let hull = |group: &[[Interval; 2]]| {
                group.iter().fold([Interval::EMPTY; 2], |h, b| [h[0].hull(b[0]), h[1].hull(b[1])])
            };
            let above = last.chunks(maps).map(hull).collect();
            levels.push(above);
        }
        let bounds = levels.into_iter().rev().flatten().collect();
        Self { curve, bounds, leaves, tables }
    }

    /// The curve.
    #[must_use]
    pub const fn curve(&self) -> &Curve<F> {
        &self.curve
    }

    /// Memory of the tables in bytes.
    #[must_use]
    pub fn bytes(&self) -> usize {
        size_of_val(self.bounds.as_slice())
            + size_of_val(self.leaves.as_slice())
            + self.tables.as_ref().map_or(0, |tables| tables.ranges.bytes() + tables.jets.bytes())
    }

    fn first_leaf(&self) -> usize {
        self.bounds.len() - self.leaves.len()
    }
}

/// The bounds of a cell as the hull of its descendants' some levels below.
fn finer<F: Function>(axis: &Curve<F>, cell: &CellOf<F>, levels: u32) -> [Interval; 2] {
    let own = axis.bounds(cell);
    if levels == 0 {
        return own;
    }
    let mut hull = [Interval::EMPTY; 2];
    for j in 0..axis.count() {
        let child = finer(axis, &axis.child(cell, j), levels - 1);
        hull = [hull[0].hull(child[0]), hull[1].hull(child[1])];
    }
    [hull[0].intersection(own[0]), hull[1].intersection(own[1])]
}

/// A cell of the table or below it.
#[derive(Clone, Copy, Debug)]
pub enum TableCell<Cell> {
    /// By its number in the table.
    Top(usize),
    /// By what its bounds are computed from.
    Below(Cell),
}

impl<F: Function> Descend for TabulatedCurve<F> {
    type Cell = TableCell<<Curve<F> as Descend>::Cell>;
    type Jets = F::Jets;

    #[inline]
    fn root(&self) -> Self::Cell {
        TableCell::Top(0)
    }

    #[inline]
    fn count(&self) -> usize {
        self.curve.count()
    }

    #[inline]
    fn part(&self, j: usize) -> [f64; 2] {
        self.curve.part(j)
    }

    #[inline]
    fn child(&self, cell: &Self::Cell, j: usize) -> Self::Cell {
        match cell {
            TableCell::Top(i) if *i < self.first_leaf() => TableCell::Top(i * self.count() + 1 + j),
            TableCell::Top(i) => {
                let leaf =
                    self.leaves.get(i - self.first_leaf()).copied().unwrap_or_else(|| self.curve.root());
                TableCell::Below(self.curve.child(&leaf, j))
            }
            TableCell::Below(cell) => TableCell::Below(self.curve.child(cell, j)),
        }
    }

    #[inline]
    fn bounds(&self, cell: &Self::Cell) -> [Interval; 2] {
        match cell {
            TableCell::Top(i) => self.bounds.get(*i).copied().unwrap_or([Interval::ENTIRE; 2]),
            TableCell::Below(cell) => self.curve.bounds(cell),
        }
    }

    #[inline]
    fn near(&self, x: f64) -> Bounded {
        match &self.tables {
            Some(AxisTables { jets, .. }) => {
                let (steps, bound) = jets.finest();
                Bounded { value: jets.jet(jets.part(x), steps)[0], bound }
            }
            None => self.curve.near(x),
        }
    }

    fn means(&self, l: f64, r: f64) -> Result<LineMeans, MomentError> {
        self.curve.means(l, r)
    }

    #[inline]
    fn top(&self) -> Option<&AxisTables<Self::Jets>> {
        self.tables.as_ref()
    }
}

impl<F: Function> Axis for TabulatedCurve<F> {
    fn domain(&self) -> Interval {
        self.curve.domain()
    }

    fn range(&self) -> Interval {
        self.bounds.first().map_or_else(|| self.curve.range(), |b| b[0])
    }

    fn evaluate(&self, x: f64, tolerance: f64) -> Bounded {
        self.curve.evaluate(x, tolerance)
    }

    fn slope(&self, x: f64) -> Option<f64> {
        self.curve.slope(x)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Fif, paper};

    #[test]
    fn every_cell_of_the_table_lies_in_its_parent_and_holds_its_samples() {
        let f = Fif::affine(&[0.0, 0.2, 0.7, 1.0], &[0.3, 1.0, -0.5, 0.25], &[0.4, -0.6, 0.5]).unwrap();
        let cached = TabulatedCurve::new(Curve::new(f), 100);
        assert_eq!(cached.leaves.len(), 81);
        assert_eq!(cached.bounds.len(), 1 + 3 + 9 + 27 + 81);
        let mut cells = alloc::vec![(cached.root(), 0.0, 1.0)];
        for _ in 0..6 {
            let mut next = alloc::vec![];
            for (cell, left, width) in cells {
                let bounds = cached.bounds(&cell)[0];
                for k in 0..=4 {
                    let x = left + width * f64::from(k) / 4.0;
                    let y = cached.evaluate(x, 1e-14);
                    // A sample at the border may be the neighbour's: an ulp of x moves f by 1e-9 here.
                    assert!(bounds.inflated(1e-9).contains(y.value), "{bounds:?} {x} {y:?}");
                }
                for j in 0..3 {
                    let [s0, s1] = cached.part(j);
                    next.push((cached.child(&cell, j), left + width * s0, width * (s1 - s0)));
                }
            }
            cells = next;
        }
    }

    #[test]
    fn slopes_lie_in_their_ranges() {
        let cached = TabulatedCurve::new(Curve::new(paper::g_hat().unwrap()), 16);
        let mut cells = alloc::vec![(cached.root(), 0.0, 2.0)];
        for _ in 0..7 {
            for (cell, left, width) in &cells {
                let bounds = cached.bounds(cell)[1];
                for k in 0..=4 {
                    let x = left + width * f64::from(k) / 4.0;
                    assert!(bounds.inflated(1e-12).contains(cached.slope(x).unwrap()), "{bounds:?} {x}");
                }
            }
            cells = cells
                .iter()
                .flat_map(|(cell, left, width)| {
                    [0, 1].map(|j| (cached.child(cell, j), left + 0.5 * width * j as f64, 0.5 * width))
                })
                .collect();
        }
    }

    #[test]
    fn smooth_axes_on_even_knots_have_values_in_their_tables() {
        for smooth in [paper::f_hat(), paper::g_hat()] {
            let cached = TabulatedCurve::new(Curve::new(smooth.unwrap()), 1024);
            assert!(cached.top().is_some() && cached.bytes() < 500_000);
        }
        assert!(TabulatedCurve::new(Curve::new(paper::f().unwrap()), 1024).top().is_none());
    }

    #[test]
    fn a_table_of_one_cell_works() {
        let cached = TabulatedCurve::new(Curve::new(paper::f().unwrap()), 0);
        assert_eq!((cached.leaves.len(), cached.bounds.len()), (1, 1));
        assert!(cached.range().contains(4.0 / 3.0));
        assert!(matches!(cached.child(&cached.root(), 1), TableCell::Below(_)));
    }
}
