//! The torus Hermite surface: periodic, non-separable, continuously differentiable.

use crate::numeric::interval::{Bounded, Interval};
use crate::numeric::polynomial::UNIT;
use crate::surface::hermite_patch::Patch;
use crate::surface::self_affine::torus_error::TorusError;
use crate::surface::self_affine::torus_limits::{Limits, spectral_norm};
use crate::surface::self_affine::torus_node::{TorusNode, TorusStorage, TorusView};

/// A periodic fractal surface through given heights with given gradients, once continuously differentiable, that is no
/// product of curves and has no grain along the axes.
///
/// ```text
/// f(x) = p(x) + s f(M x mod 1),   x in the unit torus
/// ∇f(x) = ∇p(x) + s Mᵀ ∇f(M x mod 1)
/// p: bicubic Hermite patches without twist between nodes v with p(v) = z_v − s z_{Mv}, ∇p(v) = d_v − s Mᵀ d_{Mv}
/// ```
///
/// M is an integer matrix, so it maps nodes to nodes, and `f(v) = z_v`, `∇f(v) = d_v` at all of them. Values converge for
/// `|s| < 1` and gradients for `|s| ‖M‖₂ < 1`; the latter is Hölder continuous ([`TorusSurface::gradient_modulus`]).
/// M = ((2, −1), (1, 2)) repeats the surface five times per step, turned by 26.57°, an irrational part of a turn.
///
/// - **Domain:** the plane with period 1; a coordinate is reduced exactly. Where bits lie under 2⁻¹²⁸ they are cut off, and
///   the bounds contain that. NaN and infinities give NaN.
/// - **Accuracy:** at the given nodes exact. Else within the reported bound, 10⁻¹⁵ of the data's magnitude for values where
///   |s| = 3/8 and 10⁻¹³ for gradients where |s| ‖M‖₂ = 0.84: addresses are integers, so depth loses nothing.
///
/// The sources stop at products of curves, whose grain shows (Cochran, Lewis, Hart 2000, §6.1 asks for others).
///
/// ```
/// use asperity_fif::FixedTorus;
/// let z = [0.0, 1.0, -0.5, 0.25];
/// let d = [[0.0, 1.0], [-2.0, 0.0], [0.5, 0.5], [0.0, 0.0]];
/// let surface = FixedTorus::<4>::new(2, [[2, -1], [1, 2]], 0.375, &z, &d)?;
/// assert_eq!(surface.height(0.0, 0.5), 1.0);
/// assert_eq!(surface.gradient(0.0, 0.5).x, -2.0);
/// assert_eq!(surface.height(0.375, 0.8125), surface.height(-3.625, 1.8125));
/// # Ok::<(), asperity_fif::TorusError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct TorusSurface<S> {
    pub(crate) nodes: S,
    pub(crate) bits: u32,
    pub(crate) matrix: [[i32; 2]; 2],
    pub(crate) factor: f64,
    pub(crate) limits: Limits,
}

impl<S: TorusStorage> TorusSurface<S> {
    /// The surface with heights `z` and gradients `d` at `side`² nodes: node (i, j) lies at `(i, j)/side` and is entry
    /// `i · side + j` of both lists.
    ///
    /// # Errors
    /// A [`TorusError`] names the rule that the data break.
    pub fn new(
        side: usize,
        matrix: [[i32; 2]; 2],
        factor: f64,
        z: &[f64],
        d: &[[f64; 2]],
    ) -> Result<Self, TorusError> {
        if !side.is_power_of_two() || !(2..=1 << 15).contains(&side) {
            return Err(TorusError::NotPowerOfTwo { side });
        }
        let expected = side * side;
        if z.len() != expected || d.len() != expected {
            return Err(TorusError::Length { expected, heights: z.len(), gradients: d.len() });
        }
        let [[a, b], [c, e]] = matrix.map(|row| row.map(i64::from));
        let determinant = (a * e).saturating_sub(b * c);
        if determinant.abs() < 2 {
            return Err(TorusError::Determinant { determinant });
        }
        let norm = spectral_norm(&matrix);
        let contraction = factor.abs() * norm * (1.0 + 4.0 * UNIT);
        if contraction.is_nan() || contraction >= 1.0 {
            return Err(TorusError::NotContractive { factor, norm });
        }
        let given = || z.iter().zip(d).map(|(&z, &[x, y])| [z, x, y]);
        let mut magnitude = [0.0_f64; 3];
        for (index, data) in given().enumerate() {
            for (most, value) in magnitude.iter_mut().zip(data) {
                if !value.is_finite() {
                    return Err(TorusError::NotFinite { node: [index / side, index % side], value });
                }
                *most = most.max(value.abs());
            }
        }
        let mut nodes = S::with_len(expected).map_err(|found| TorusError::Storage { expected, found })?;
        for (node, data) in nodes.as_mut().iter_mut().zip(given()) {
            node.data = data;
        }
        let bits = side.trailing_zeros();
        for index in 0..expected {
            let from =
                at_node(nodes.as_ref(), bits, moved_node([index >> bits, index & (side - 1)], &matrix));
            let Some(node) = nodes.as_mut().get_mut(index) else { continue };
            let ([z, x, y], [moved_z, moved_x, moved_y], width) = (node.data, from.data, 1.0 / side as f64);
            let entry = matrix.map(|row| row.map(f64::from));
            node.corner = [
                z - factor * moved_z,
                (x - factor * (entry[0][0] * moved_x + entry[1][0] * moved_y)) * width,
                (y - factor * (entry[0][1] * moved_x + entry[1][1] * moved_y)) * width,
            ];
        }
        let limits = Limits::new(nodes.as_ref(), bits, &matrix, factor, [norm, contraction], magnitude);
        let finite = limits.steepest.is_finite() && limits.range.magnitude().is_finite();
        if !(finite && limits.bend.is_finite() && limits.noise.iter().all(|noise| noise.is_finite())) {
            let magnitude = magnitude.into_iter().fold(0.0, f64::max);
            return Err(TorusError::TooLarge { magnitude });
        }
        Ok(Self { nodes, bits, matrix, factor, limits })
    }
}

impl<S: AsRef<[TorusNode]>> TorusSurface<S> {
    /// The same surface over borrowed nodes.
    #[inline]
    #[must_use]
    pub fn view(&self) -> TorusView<'_> {
        let &Self { ref nodes, bits, matrix, factor, limits } = self;
        TorusSurface { nodes: nodes.as_ref(), bits, matrix, factor, limits }
    }

    /// The number of nodes along a side.
    #[inline]
    #[must_use]
    pub const fn side(&self) -> usize {
        1 << self.bits
    }

    /// The matrix M.
    #[inline]
    #[must_use]
    pub const fn matrix(&self) -> [[i32; 2]; 2] {
        self.matrix
    }

    /// The vertical factor s.
    #[inline]
    #[must_use]
    pub const fn factor(&self) -> f64 {
        self.factor
    }

    /// A rigorous enclosure of all heights.
    #[inline]
    #[must_use]
    pub const fn range(&self) -> Interval {
        self.limits.range
    }

    /// Rigorous enclosures of `∂f/∂x` and `∂f/∂y`.
    #[inline]
    #[must_use]
    pub const fn slope_range(&self) -> [Interval; 2] {
        self.limits.slopes
    }

    /// The mean height over a period, exact up to the rounding error that is reported.
    ///
    /// ```text
    /// ∫ f = ∫ p / (1 − s) = (Σ_v z_v − s Σ_v z_{Mv}) / (n² (1 − s))
    /// ```
    ///
    /// Slopes of the nodes cancel between neighbouring patches. For an odd determinant M permutes the nodes, and this is the
    /// mean of the data.
    ///
    /// ```
    /// # use asperity_fif::FixedTorus;
    /// let z = [0.0, 1.0, -0.5, 0.25];
    /// let surface = FixedTorus::<4>::new(2, [[2, -1], [1, 2]], 0.375, &z, &[[3.0, -1.0]; 4])?;
    /// let mean = surface.mean();
    /// assert!((mean.value - 0.1875).abs() <= mean.bound && mean.bound < 1e-14);
    /// # Ok::<(), asperity_fif::TorusError>(())
    /// ```
    #[must_use]
    pub fn mean(&self) -> Bounded {
        let nodes = self.nodes.as_ref();
        let (count, gap) = (nodes.len() as f64, 1.0 - self.factor);
        let (mut sum, mut size) = (0.0, 0.0);
        for node in nodes {
            sum += node.corner[0];
            size += node.corner[0].abs() + 2.0 * node.data[0].abs();
        }
        let value = sum / count / gap;
        Bounded { value, bound: 1.01 * UNIT * ((count + 6.0) * size / count / gap + 4.0 * value.abs()) }
    }

    /// `s M`.
    pub(crate) fn scaled_matrix(&self) -> [[f64; 2]; 2] {
        self.matrix.map(|row| row.map(|entry| self.factor * f64::from(entry)))
    }

    /// The patch of p over a cell.
    #[inline]
    pub(crate) fn patch(&self, cell: [usize; 2]) -> Patch {
        patch_of(self.nodes.as_ref(), self.bits, cell)
    }
}

/// Where M sends a node.
fn moved_node([i, j]: [usize; 2], matrix: &[[i32; 2]; 2]) -> [usize; 2] {
    // Wrapping arithmetic is that of the remainders, as the side is a power of two.
    matrix.map(|[a, b]| i.wrapping_mul(a as isize as usize).wrapping_add(j.wrapping_mul(b as isize as usize)))
}

/// The node of an index pair, modulo the side.
#[inline]
pub(crate) fn at_node(nodes: &[TorusNode], bits: u32, [i, j]: [usize; 2]) -> TorusNode {
    let mask = (1 << bits) - 1;
    nodes.get((i & mask) << bits | j & mask).copied().unwrap_or(TorusNode::EMPTY)
}

#[inline]
pub(crate) fn patch_of(nodes: &[TorusNode], bits: u32, [i, j]: [usize; 2]) -> Patch {
    let corner = |i, j| at_node(nodes, bits, [i, j]).corner;
    let [next_i, next_j] = [i.wrapping_add(1), j.wrapping_add(1)];
    Patch([[corner(i, j), corner(i, next_j)], [corner(next_i, j), corner(next_i, next_j)]])
}
