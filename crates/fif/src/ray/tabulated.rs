//! A surface with a quadtree of bounds over its domain.

use alloc::vec::Vec;
use asperity_core::Interval;
use glam::DVec2;

use crate::numeric::estimate::Bounded;
use crate::ray::intersect::Intersect;
use crate::ray::ray::{Hit, Ray};
use crate::ray::traversal::{Context, Square, Squares};
use crate::surface::bounds::{Surface, SurfaceBounds};
use crate::surface::self_affine::rough_folded::RoughFoldedSurface;
use crate::surface::self_affine::self_affine::{Fold, SelfAffine};

/// A surface with bounds over a quadtree of its domain, for several times faster ray intersection.
///
/// The bounds are `f32`, rounded outward: 24 bytes per square, 0.5 MB for the 128² smallest of
/// [`Tabulated::new`].
///
/// ```
/// use asperity_fif::{Intersect, Ray, PeriodicSurface, glam::DVec3};
/// let z = [0.0, 1.0, -0.5, 0.25];
/// let surface = PeriodicSurface::new(2, [[2, -1], [1, 2]], 0.375, &z, &[[3.0, -1.0]; 4])?;
/// let ray = Ray { origin: DVec3::new(0.1, 0.2, 4.0), direction: DVec3::new(0.1, 0.15, -1.0) };
/// let plain = surface.intersect(&ray).unwrap();
/// let fast = surface.tabulated().intersect(&ray).unwrap();
/// assert!((plain.t - fast.t).abs() < 1e-12);
/// # Ok::<(), asperity_fif::FifError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Tabulated<S> {
    surface: S,
    levels: u32,
    /// Level by level, rows along y: the range of the heights, of ∂f/∂x, of ∂f/∂y.
    squares: Vec<[[f32; 2]; 3]>,
}

impl<S: Surface> Tabulated<S> {
    /// Computes bounds over a domain divided into quarters seven times.
    #[must_use]
    pub fn new(surface: S) -> Self {
        Self::with_levels(surface, 7)
    }

    /// Computes bounds over a domain divided into quarters `levels` times, at most ten.
    #[must_use]
    pub fn with_levels(surface: S, levels: u32) -> Self {
        let levels = levels.min(10);
        let [x, y] = surface.domain();
        let mut squares = alloc::vec![[[f32::INFINITY, f32::NEG_INFINITY]; 3]; first(levels + 1)];
        let side = 1_u32 << levels;
        let pad = |side: Interval| 32.0 * f64::EPSILON * (side.magnitude() + side.width());
        for at in (0..side).flat_map(|i| (0..side).map(move |j| [i, j])) {
            let square = Square { level: levels, at };
            let over = |axis: usize, domain: Interval| square.side(axis, domain).inflated(pad(domain));
            let bounds = surface.bounds(over(0, x), over(1, y));
            if let Some(place) = squares.get_mut(number(square)) {
                *place = [bounds.height, bounds.slopes[0], bounds.slopes[1]].map(rounded);
            }
        }
        for level in (0..levels).rev() {
            let side = 1_u32 << level;
            for at in (0..side).flat_map(|i| (0..side).map(move |j| [i, j])) {
                let mut all = [[f32::INFINITY, f32::NEG_INFINITY]; 3];
                for (right, far) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                    let part = Square { level: level + 1, at: [2 * at[0] + right, 2 * at[1] + far] };
                    let Some(part) = squares.get(number(part)) else { continue };
                    for (all, part) in all.iter_mut().zip(part) {
                        *all = [all[0].min(part[0]), all[1].max(part[1])];
                    }
                }
                if let Some(place) = squares.get_mut(number(Square { level, at })) {
                    *place = all;
                }
            }
        }
        Self { surface, levels, squares }
    }

    fn square(&self, square: Square) -> [[f32; 2]; 3] {
        self.squares.get(number(square)).copied().unwrap_or([[f32::NEG_INFINITY, f32::INFINITY]; 3])
    }
}

impl<F: Fold> Intersect for SelfAffine<F> {}

impl<F: Fold> SelfAffine<F> {
    /// Adds narrower global ranges and a table of bounds, for several times faster hits.
    #[must_use]
    pub fn tabulated(self) -> Tabulated<Self> {
        Tabulated::new(self.narrowed())
    }
}

impl Intersect for RoughFoldedSurface {}

impl RoughFoldedSurface {
    /// Adds a table of bounds, for faster hits.
    #[must_use]
    pub fn tabulated(self) -> Tabulated<Self> {
        Tabulated::new(self)
    }
}

impl<S: Surface> Squares for Tabulated<S> {
    #[inline]
    fn finest(&self) -> u32 {
        self.levels
    }

    #[inline]
    fn heights(&self, square: Square, _: Interval, _: Interval) -> Interval {
        interval(self.square(square)[0])
    }

    #[inline]
    fn leaf(&self, square: Square, _: Interval, _: Interval) -> SurfaceBounds {
        let [height, x, y] = self.square(square).map(interval);
        SurfaceBounds { height, slopes: [x, y] }
    }
}

impl<S: Surface> Surface for Tabulated<S> {
    fn domain(&self) -> [Interval; 2] {
        self.surface.domain()
    }

    fn range(&self) -> Interval {
        self.surface.range()
    }

    fn evaluate(&self, x: f64, y: f64, tolerance: f64) -> Bounded {
        self.surface.evaluate(x, y, tolerance)
    }

    fn bounds(&self, x: Interval, y: Interval) -> SurfaceBounds {
        self.surface.bounds(x, y)
    }

    fn gradient_near(&self, x: f64, y: f64, distance: f64) -> Option<DVec2> {
        self.surface.gradient_near(x, y, distance)
    }
}

impl<S: Surface> Intersect for Tabulated<S> {
    fn intersect_within(&self, ray: &Ray, t: Interval, tolerance: f64) -> Option<Hit> {
        Context::new(&self.surface).first(self, ray, t, tolerance)
    }

    fn occluded(&self, ray: &Ray, t: Interval) -> bool {
        Context::new(&self.surface).any(self, ray, t)
    }
}

/// The index of the first square of a level.
const fn first(level: u32) -> usize {
    ((1 << (2 * level)) - 1) / 3
}

#[inline]
const fn number(Square { level, at: [i, j] }: Square) -> usize {
    first(level) + ((i as usize) << level | j as usize)
}

#[inline]
fn interval([lo, hi]: [f32; 2]) -> Interval {
    Interval::new(f64::from(lo), f64::from(hi))
}

/// Rounded outward.
fn rounded(range: Interval) -> [f32; 2] {
    let (lo, hi) = (range.lo as f32, range.hi as f32);
    [
        if f64::from(lo) <= range.lo { lo } else { lo.next_down() },
        if f64::from(hi) >= range.hi { hi } else { hi.next_up() },
    ]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::PeriodicSurface;

    fn torus() -> PeriodicSurface {
        let z = [0.0, 1.0, -0.5, 0.25];
        PeriodicSurface::new(2, [[2, -1], [1, 2]], 0.375, &z, &[[3.0, -1.0]; 4]).unwrap()
    }

    #[test]
    fn squares_contain_their_quarters() {
        let table = Tabulated::with_levels(torus(), 3);
        for level in 0..3_u32 {
            for (i, j) in (0..1 << level).flat_map(|i| (0..1 << level).map(move |j| (i, j))) {
                let whole = table.square(Square { level, at: [i, j] });
                let parts = [[0, 0], [0, 1], [1, 0], [1, 1]].map(|[right, far]| {
                    table.square(Square { level: level + 1, at: [2 * i + right, 2 * j + far] })
                });
                for k in 0..3 {
                    let lo = parts.iter().map(|part| part[k][0]).fold(f32::INFINITY, f32::min);
                    let hi = parts.iter().map(|part| part[k][1]).fold(f32::NEG_INFINITY, f32::max);
                    assert_eq!(whole[k], [lo, hi], "level {level}, ({i}, {j})");
                }
            }
        }
        // Beyond the last level nothing is known.
        assert_eq!(table.square(Square { level: 4, at: [0, 0] }), [[f32::NEG_INFINITY, f32::INFINITY]; 3]);
    }
}
