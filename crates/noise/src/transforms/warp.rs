//! Domain warping: a field that is looked up where other fields have moved the point to.

use core::{error::Error, fmt};

use crate::{
    contract::field::Field,
    contract::kernel::LaneSample,
    contract::point::Point,
    simd::lanes::{Lanes, Scalar},
};

/// A field seen through a warp: f(q), q = p + s·w(p).
///
#[cfg_attr(doc, doc = include_str!("../../docs/pictures/warp.md"))]
///
/// ```text
/// ∂q/∂p = I + s ∂w/∂p,   ∇(f ∘ q) = (∂q/∂p)ᵀ ∇f(q)
/// ```
///
/// w holds one field per axis. They should be independent: sums of octaves of different seeds are, single noises of different
/// seeds share a lattice. Any field can be warped, warps too. Where s·w is not finite, q is no point and the value is 0.
///
/// Ebert (ed.) 1994, "Texturing and Modeling": textures perturbed by noise.
///
/// ```
/// use asperity_noise::{Field, Octaves, Perlin2002, Seeded, Simplex, Spectrum, Warp, glam::Vec2};
///
/// let by = [1, 2].map(|seed| Octaves::new(Simplex::CONTINUOUS, Spectrum::CLOUD, Default::default(), seed));
/// let warp = Warp::new(Seeded(Perlin2002::default(), 3), by.each_ref().map(|octaves| octaves.first(4.0)), 0.25)?;
///
/// let p = Vec2::new(0.4, -1.7);
/// let [q, f] = [warp.displacement(p).point, p].map(|p| Seeded(Perlin2002::default(), 3).value(p));
/// assert!(warp.value(p) == q && q != f);
/// # Ok::<(), asperity_noise::WarpError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Warp<F, W, const N: usize> {
    field: F,
    by: [W; N],
    strength: f32,
}

/// Where a [`Warp`] takes a point, and how it stretches and turns what lies around it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Displacement<V, const N: usize> {
    /// q = p + s·w(p).
    pub point: V,
    /// ∂q/∂p by rows: row i holds the gradient of coordinate i of q.
    pub jacobian: [[f32; N]; N],
}

impl<F: Field<N>, W: Field<N>, const N: usize> Warp<F, W, N> {
    /// `field` warped by `by`, `strength` times.
    ///
    /// # Errors
    ///
    /// If `strength` is not finite.
    pub fn new(field: F, by: [W; N], strength: f32) -> Result<Self, WarpError> {
        if strength.is_finite() {
            Ok(Self { field, by, strength })
        } else {
            Err(WarpError::StrengthNotFinite(strength))
        }
    }

    /// s.
    #[must_use]
    pub const fn strength(&self) -> f32 {
        self.strength
    }

    /// q and ∂q/∂p at a point.
    #[must_use]
    pub fn displacement<V: Point<N>>(&self, p: V) -> Displacement<V, N> {
        let (q, jacobian) = self.displaced(Scalar, p.coordinates());
        Displacement { point: V::from_coordinates(q), jacobian }
    }

    #[inline(always)]
    fn displaced<S: Lanes>(&self, s: S, p: [S::F; N]) -> ([S::F; N], [[S::F; N]; N]) {
        let strength = s.float(self.strength);
        let (mut q, mut jacobian) = (p, [p; N]);
        for row in 0..N {
            let (value, gradient) = self.by[row].lane_samples(s, p);
            q[row] = p[row] + strength * value;
            for column in 0..N {
                let unit = s.float(if row == column { 1.0 } else { 0.0 });
                jacobian[row][column] = unit + strength * gradient[column];
            }
        }
        (q, jacobian)
    }
}

impl<F: Field<N>, W: Field<N>, const N: usize> Field<N> for Warp<F, W, N> {
    #[inline(always)]
    fn lane_values<S: Lanes>(&self, s: S, p: [S::F; N]) -> S::F {
        let strength = s.float(self.strength);
        let mut q = p;
        for axis in 0..N {
            q[axis] = p[axis] + strength * self.by[axis].lane_values(s, p);
        }
        self.field.lane_values(s, q)
    }

    #[inline(always)]
    fn lane_samples<S: Lanes>(&self, s: S, p: [S::F; N]) -> LaneSample<S, N> {
        let (q, jacobian) = self.displaced(s, p);
        let (value, inner) = self.field.lane_samples(s, q);
        let mut gradient = inner;
        for column in 0..N {
            let mut sum = jacobian[0][column] * inner[0];
            for row in 1..N {
                sum = sum + jacobian[row][column] * inner[row];
            }
            gradient[column] = sum;
        }
        (value, gradient)
    }
}

/// Why a [`Warp`] was refused.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum WarpError {
    /// The strength is infinite or not a number.
    StrengthNotFinite(f32),
}

impl fmt::Display for WarpError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::StrengthNotFinite(value) => write!(f, "strength {value} is not finite"),
        }
    }
}

impl Error for WarpError {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{contract::field::Seeded, kinds::perlin::Perlin2002, kinds::simplex::simplex::Simplex};
    use glam::{Vec2, Vec3};

    #[test]
    fn a_warp_of_strength_zero_is_the_field() {
        let field = Seeded(Perlin2002::default(), 1);
        let warp = Warp::new(field, [2, 3, 4].map(|seed| Seeded(Simplex::CONTINUOUS, seed)), 0.0).unwrap();
        let p = Vec3::new(0.3, -4.1, 7.7);
        assert_eq!(warp.sample(p), field.sample(p));
        assert_eq!(warp.displacement(p).jacobian, [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    }

    #[test]
    fn strengths_must_be_finite_and_points_need_not() {
        let field = Seeded(Perlin2002::default(), 1);
        for strength in [f32::INFINITY, f32::NEG_INFINITY] {
            assert_eq!(Warp::new(field, [field; 2], strength), Err(WarpError::StrengthNotFinite(strength)));
        }
        assert!(Warp::new(field, [field; 2], f32::NAN).is_err());
        let warp = Warp::new(field, [field; 2], 1.0).unwrap();
        for p in [Vec2::new(f32::NAN, 0.0), Vec2::new(0.0, f32::INFINITY)] {
            assert_eq!((warp.value(p), warp.sample(p).gradient), (0.0, Vec2::ZERO), "{p}");
        }
    }
}
