//! The torus Hermite surface: periodic, non-separable, continuously differentiable.

use alloc::vec::Vec;
use asperity_core::Interval;

use crate::numeric::estimate::Bounded;
use crate::numeric::matrix2::product;
use crate::numeric::polynomial::UNIT;
use crate::surface::bounds::SurfaceBounds;
use crate::surface::self_affine::address::Address;
use crate::surface::self_affine::error::magnitudes;
use crate::surface::self_affine::limits::Limits;
use crate::surface::self_affine::self_affine::{Cell, FoldParts, Part, SelfAffine};
use crate::surface::self_affine::torus_fold::{
    Node, TorusFold, limits, slope_rounding, spectral_norm, value_rounding,
};
use crate::system::error::FifError;

#[doc = include_str!("../../../docs/torus.md")]
#[doc(alias = "seamless")]
#[doc(alias = "tileable")]
pub type PeriodicSurface = SelfAffine<TorusFold>;

impl SelfAffine<TorusFold> {
    /// Creates the surface with heights `z` and gradients `d` at `side`² nodes.
    ///
    /// Node (i, j) lies at `(i, j)/side` and is entry `i · side + j` of both lists.
    ///
    /// # Errors
    /// [`FifError`] for invalid data.
    pub fn new(
        side: usize,
        matrix: [[i32; 2]; 2],
        scaling: f64,
        z: &[f64],
        d: &[[f64; 2]],
    ) -> Result<Self, FifError> {
        if !side.is_power_of_two() || !(2..=1 << 15).contains(&side) {
            return Err(FifError::Side { value: side });
        }
        let largest = magnitudes(side * side, side, z, d)?;
        let [[a, b], [c, e]] = matrix.map(|row| row.map(i64::from));
        let determinant = (a * e).saturating_sub(b * c);
        if determinant.abs() < 2 {
            return Err(FifError::Determinant { value: determinant });
        }
        let norm = spectral_norm(&matrix);
        let contraction = scaling.abs() * norm * (1.0 + 4.0 * UNIT);
        if contraction.is_nan() || contraction >= 1.0 {
            return Err(FifError::SurfaceScaling { value: scaling, max: 1.0 / norm });
        }
        let bits = side.trailing_zeros();
        let entry = matrix.map(|row| row.map(f64::from));
        let given = |[i, j]: [usize; 2]| {
            let index = (i & (side - 1)) << bits | j & (side - 1);
            z.get(index).zip(d.get(index)).map_or([0.0; 3], |(&z, &[x, y])| [z, x, y])
        };
        let nodes = (0..side * side).map(|index| {
            let at = [index >> bits, index & (side - 1)];
            let (data, moved, width) = (given(at), given(moved_node(at, &matrix)), 1.0 / side as f64);
            let corner = [
                data[0] - scaling * moved[0],
                (data[1] - scaling * (entry[0][0] * moved[1] + entry[1][0] * moved[2])) * width,
                (data[2] - scaling * (entry[0][1] * moved[1] + entry[1][1] * moved[2])) * width,
            ];
            Node { corner, data }
        });
        let scaled = entry.map(|row| row.map(|entry| scaling * entry));
        let fold = TorusFold { nodes: nodes.collect::<Vec<_>>(), bits, matrix, scaled };
        let limits = limits(&fold, scaling, [norm, contraction], largest).checked(largest)?;
        Ok(Self { fold, factor: scaling, limits })
    }

    /// The number of nodes along a side.
    #[inline]
    #[must_use]
    pub const fn side(&self) -> usize {
        self.fold.side()
    }

    /// The matrix M.
    #[inline]
    #[must_use]
    pub const fn matrix(&self) -> [[i32; 2]; 2] {
        self.fold.matrix
    }

    /// [`SelfAffine::evaluate`] at the rational point `numerators / denominator`, with an exact
    /// orbit.
    ///
    /// NaN for the denominator 0.
    ///
    /// ```
    /// # use asperity_fif::PeriodicSurface;
    /// let z = [0.0, 1.0, -0.5, 0.25];
    /// let surface = PeriodicSurface::new(2, [[2, -1], [1, 2]], 0.375, &z, &[[0.0; 2]; 4])?;
    /// assert_eq!(surface.evaluate_ratio([1, -3], 2, 1e-12).value, 0.25); // (1/2, −3/2), a node
    /// assert!(surface.evaluate_ratio([1, 2], 3, 1e-12).bound <= 1e-12);
    /// # Ok::<(), asperity_fif::FifError>(())
    /// ```
    pub fn evaluate_ratio(&self, numerators: [i64; 2], denominator: u32, tolerance: f64) -> Bounded {
        Address::ratio(numerators, denominator).map_or(Bounded::NAN, |at| self.value_from(at, tolerance))
    }

    /// [`SelfAffine::evaluate_gradient`] at the rational point `numerators / denominator`.
    ///
    /// The gradient is only Hölder continuous, so the gradient at the nearest double may differ by
    /// far more than its rounding: [`SelfAffine::gradient_modulus`]. NaN for the denominator 0.
    pub fn evaluate_gradient_ratio(
        &self,
        numerators: [i64; 2],
        denominator: u32,
        tolerance: f64,
    ) -> [Bounded; 2] {
        let at = Address::ratio(numerators, denominator);
        at.map_or([Bounded::NAN; 2], |at| self.gradient_from(at, 0.0, tolerance))
    }
}

impl FoldParts for TorusFold {
    type Position = Address;

    fn domain(&self) -> [Interval; 2] {
        [Interval::new(0.0, 1.0); 2]
    }

    #[inline]
    fn locate(&self, x: f64, y: f64) -> Option<(Address, f64)> {
        Address::of(x, y)
    }

    #[inline]
    fn cell(&self, at: Address, _: Part) -> Cell {
        let (index, position) = at.cell(self.bits);
        let node = at.is_corner(self.bits).then(|| self.node(index).data);
        Cell { index, patch: self.patch(index), at: position, widths: [1.0 / self.side() as f64; 2], node }
    }

    #[inline]
    fn next(&self, at: Address, _: &Cell) -> Address {
        at.moved(&self.matrix)
    }

    #[inline]
    fn turned(&self, jacobian: &[[f64; 2]; 2], _: &Cell, _: f64) -> [[f64; 2]; 2] {
        product(&self.scaled, jacobian)
    }

    #[inline]
    fn value_enough(limits: &Limits, tolerance: f64) -> f64 {
        let floor = limits.noise[0] + 2.0 * UNIT * limits.range.magnitude();
        if tolerance > floor { 0.5 * tolerance } else { floor }
    }

    #[inline]
    fn value_rounding(limits: &Limits, steps: u32) -> f64 {
        if steps == 0 { 0.0 } else { value_rounding(limits, steps) }
    }

    #[inline]
    fn slope_enough(limits: &Limits, tolerance: f64) -> f64 {
        let floor = limits.noise[1] + 2.0 * UNIT * limits.steepest;
        if tolerance > floor { 0.5 * tolerance } else { floor }
    }

    #[inline]
    fn slope_rounding(limits: &Limits, steps: u32, largest: f64) -> f64 {
        if steps == 0 { 0.0 } else { slope_rounding(limits, steps, largest) }
    }

    fn narrowest(&self, _: &Limits) -> f64 {
        1.0 / self.side() as f64
    }

    fn bounds(surface: &PeriodicSurface, x: Interval, y: Interval) -> SurfaceBounds {
        surface.bounds_and_mean(x, y).bounds
    }

    fn narrow(surface: &mut PeriodicSurface) {
        surface.narrow();
    }

    fn mean(surface: &PeriodicSurface) -> Bounded {
        let nodes = &surface.fold.nodes;
        let (count, gap) = (nodes.len() as f64, 1.0 - surface.factor);
        let (mut sum, mut size) = (0.0, 0.0);
        for node in nodes {
            sum += node.corner[0];
            size += node.corner[0].abs() + 2.0 * node.data[0].abs();
        }
        let value = sum / count / gap;
        Bounded { value, bound: 1.01 * UNIT * ((count + 6.0) * size / count / gap + 4.0 * value.abs()) }
    }

    fn searched(&self, x: Interval, y: Interval) -> [Interval; 2] {
        [x, y].map(|range| {
            let finite = range.lo.is_finite() && range.hi.is_finite() && range.width() >= 0.0;
            if finite && range.width() < 1.0 { range } else { Interval::new(0.0, 1.0) }
        })
    }
}

/// The image of a node under M.
fn moved_node([i, j]: [usize; 2], matrix: &[[i32; 2]; 2]) -> [usize; 2] {
    // Wrapping arithmetic equals that of the remainders, because the side is a power of two.
    matrix.map(|[a, b]| i.wrapping_mul(a as isize as usize).wrapping_add(j.wrapping_mul(b as isize as usize)))
}
