//! Bounds of the top levels of cells, computed once.

use alloc::vec::Vec;

use crate::numeric::interval::{Bounded, Interval};
use crate::surface::height_field::axis::{Axis, sealed::Descend};
use crate::surface::height_field::axis_tables::AxisTables;
use crate::surface::height_field::jet_table::Jets;

/// An axis with a table of the value and slope ranges of its top levels of cells; makes ray hits fast.
///
/// The product of two tables bounds every box of a height field's top levels: `2 N^K` numbers in place of `N^{2K}`. The
/// ranges are hulls of those of finer cells, tighter than any that the descent computes on the fly.
///
/// ```
/// use asperity_fif::{Cached, FixedSmooth, HeightField, Ray, paper};
/// use glam::DVec3;
/// let axis = FixedSmooth::<2, 3, 2>::integral(paper::f()?, 0.0)?;
/// let surface = HeightField::new(Cached::new(axis), Cached::new(axis));
/// let down = Ray { origin: DVec3::new(0.3, 1.2, 9.0), direction: DVec3::NEG_Z };
/// let hit = surface.first_hit(&down).unwrap();
/// assert!((hit.t - (9.0 - surface.height(0.3, 1.2))).abs() < 1e-12);
/// # Ok::<(), asperity_fif::SystemError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Cached<A: Axis> {
    axis: A,
    /// Level after level; the children of cell `i` are `i N + 1` to `i N + N`.
    bounds: Vec<[Interval; 2]>,
    /// The cells of the last level.
    leaves: Vec<A::Cell>,
    /// Ranges over runs of leaves, and values and slopes, where a table can have them.
    tables: Option<AxisTables<A::Jets>>,
}

impl<A: Axis> Cached<A> {
    /// With at most 1024 cells in the last level.
    #[must_use]
    pub fn new(axis: A) -> Self {
        Self::with_cells(axis, 1024)
    }

    /// With at most `cells` cells in the last level; 0 and 1 keep the domain's own bounds only.
    #[must_use]
    pub fn with_cells(axis: A, cells: usize) -> Self {
        // Levels below the last one that its bounds are drawn from.
        const BELOW: u32 = 3;
        let maps = axis.count().max(2);
        let mut leaves: Vec<A::Cell> = alloc::vec![axis.root()];
        let mut level_sizes = alloc::vec![1_usize];
        while leaves.len().saturating_mul(maps) <= cells {
            leaves = leaves.iter().flat_map(|cell| (0..maps).map(|j| axis.child(cell, j))).collect();
            level_sizes.push(leaves.len());
        }
        let below = if maps.pow(2) > 64 { 1 } else { BELOW };
        // From the last level up, then turned round.
        let mut levels: Vec<Vec<[Interval; 2]>> = Vec::with_capacity(level_sizes.len());
        levels.push(leaves.iter().map(|cell| finer(&axis, cell, below)).collect());
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
        Self { axis, bounds, leaves, tables }
    }

    /// The axis itself.
    #[must_use]
    pub const fn axis(&self) -> &A {
        &self.axis
    }

    /// Memory of the tables, without the axis itself.
    ///
    /// ```
    /// use asperity_fif::{Cached, FixedSmooth, paper};
    /// let axis = Cached::new(FixedSmooth::<2, 3, 2>::integral(paper::g()?, 0.0)?);
    /// assert!(axis.bytes() < 500_000);
    /// # Ok::<(), asperity_fif::SystemError>(())
    /// ```
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
fn finer<A: Axis>(axis: &A, cell: &A::Cell, levels: u32) -> [Interval; 2] {
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
pub enum CachedCell<Cell> {
    /// By its number in the table.
    Top(usize),
    /// By what its bounds are computed from.
    Below(Cell),
}

impl<A: Axis> Descend for Cached<A> {
    type Cell = CachedCell<A::Cell>;
    type Jets = A::Jets;

    #[inline]
    fn root(&self) -> Self::Cell {
        CachedCell::Top(0)
    }

    #[inline]
    fn count(&self) -> usize {
        self.axis.count()
    }

    #[inline]
    fn part(&self, j: usize) -> [f64; 2] {
        self.axis.part(j)
    }

    #[inline]
    fn child(&self, cell: &Self::Cell, j: usize) -> Self::Cell {
        match cell {
            CachedCell::Top(i) if *i < self.first_leaf() => CachedCell::Top(i * self.count() + 1 + j),
            CachedCell::Top(i) => {
                let leaf =
                    self.leaves.get(i - self.first_leaf()).copied().unwrap_or_else(|| self.axis.root());
                CachedCell::Below(self.axis.child(&leaf, j))
            }
            CachedCell::Below(cell) => CachedCell::Below(self.axis.child(cell, j)),
        }
    }

    #[inline]
    fn bounds(&self, cell: &Self::Cell) -> [Interval; 2] {
        match cell {
            CachedCell::Top(i) => self.bounds.get(*i).copied().unwrap_or([Interval::ENTIRE; 2]),
            CachedCell::Below(cell) => self.axis.bounds(cell),
        }
    }

    #[inline]
    fn near(&self, x: f64) -> Bounded {
        match &self.tables {
            Some(AxisTables { jets, .. }) => {
                let (steps, bound) = jets.finest();
                Bounded { value: jets.jet(jets.part(x), steps)[0], bound }
            }
            None => self.axis.near(x),
        }
    }

    #[inline]
    fn top(&self) -> Option<&AxisTables<Self::Jets>> {
        self.tables.as_ref()
    }
}

impl<A: Axis> Axis for Cached<A> {
    fn domain(&self) -> Interval {
        self.axis.domain()
    }

    fn range(&self) -> Interval {
        self.bounds.first().map_or_else(|| self.axis.range(), |b| b[0])
    }

    fn evaluate(&self, x: f64, tolerance: f64) -> Bounded {
        self.axis.evaluate(x, tolerance)
    }

    fn slope(&self, x: f64) -> Option<f64> {
        self.axis.slope(x)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{FifBuf, FixedSmooth, paper};

    #[test]
    fn every_cell_of_the_table_lies_in_its_parent_and_holds_its_samples() {
        let axis: FifBuf<2> =
            FifBuf::affine(&[0.0, 0.2, 0.7, 1.0], &[0.3, 1.0, -0.5, 0.25], &[0.4, -0.6, 0.5]).unwrap();
        let cached = Cached::with_cells(axis, 100);
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
        let axis = FixedSmooth::<2, 3, 2>::integral(paper::g().unwrap(), 0.0).unwrap();
        let cached = Cached::with_cells(axis, 16);
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
        for rough in [paper::f(), paper::g()] {
            let cached = Cached::new(FixedSmooth::<2, 3, 2>::integral(rough.unwrap(), 0.0).unwrap());
            assert!(cached.top().is_some() && cached.bytes() < 500_000);
        }
        assert!(Cached::new(paper::f().unwrap()).top().is_none());
    }

    #[test]
    fn a_table_of_one_cell_works() {
        let cached = Cached::with_cells(paper::f().unwrap(), 0);
        assert_eq!((cached.leaves.len(), cached.bounds.len()), (1, 1));
        assert!(cached.range().contains(4.0 / 3.0));
        assert!(matches!(cached.child(&cached.root(), 1), CachedCell::Below(_)));
    }
}
