//! Slopes that a pixel does not resolve, as a few facets.

use asperity_ndf_sampling::Frame;
use glam::Vec3;

use crate::bump::surface_gradient::bumped_normal;
use crate::math::sqrt;

/// A facet of a surface: a normal with a share of a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facet {
    /// The share of the pixel, in [0, 1].
    pub share: f32,
    /// The unit normal.
    pub normal: Vec3,
}

impl Facet {
    /// The whole of a surface that is flat, in its own frame.
    pub const FLAT: Self = Self { share: 1.0, normal: Vec3::Z };

    /// A facet of this share and normal.
    #[must_use]
    pub const fn new(share: f32, normal: Vec3) -> Self {
        Self { share, normal }
    }

    /// A part of the facet: the normal with a share of its share.
    pub(crate) fn part(self, share: f32) -> Self {
        Self { share: self.share * share, ..self }
    }
}

/// Facets that stand for Gaussian slopes about a bumped normal, with their shares.
///
/// ```text
/// slopes g and g + 2√variance (cos kπ/3, sin kπ/3),   shares 1/2 and six times 1/12,   g the slope of `bumped`
/// ```
///
/// `variance` is that along each axis: what fading took from the bumps of a material. The mean of any lighting model over the facets is what the pixel shows, exactly so for models that are
/// polynomials of the slope up to the fifth degree (Stroud 1971, *Approximate Calculation of Multiple Integrals*, E₂^{r²} 5-1). A
/// lobe of the width α = √2 · deviation or more sees no gaps between them; for a narrower one α² + 2 · variance is the better
/// approximation.
///
/// Facets may be turned from the eye: see [`facing`](crate::bump::facing).
///
/// - **Domain:** unit `n` and `bumped`. One facet, `bumped`, for a variance that is not positive and finite, and for a normal that is
///   not above the surface.
///
/// ```
/// use asperity_shading::bump::slope_facets;
/// use asperity_shading::glam::Vec3;
///
/// // Bumps take from a lamp straight above what they give to their sides.
/// let mean = |light: Vec3| -> f32 {
///     slope_facets(Vec3::Z, Vec3::Z, 0.01).map(|f| f.share * f.normal.dot(light).max(0.0)).sum()
/// };
/// assert!((mean(Vec3::Z) - (1.0 - 0.01)).abs() < 3e-4);
/// ```
pub fn slope_facets(n: Vec3, bumped: Vec3, variance: f32) -> impl Iterator<Item = Facet> + use<> {
    let Frame { tangent, bitangent, .. } = Frame::from_normal(n);
    let deviation = if variance > 0.0 { sqrt(variance) } else { 0.0 };
    facets_along(n, bumped, [tangent * deviation, bitangent * deviation], 0.5)
}

/// Facets for slopes with these deviations along two axes, with this share of the facet in the middle.
///
/// ```text
/// √(2/(1 − middle)) (u cos kπ/3 + v sin kπ/3),   shares (1 − middle)/6
/// ```
pub(crate) fn facets_along(
    n: Vec3,
    bumped: Vec3,
    [u, v]: [Vec3; 2],
    middle: f32,
) -> impl Iterator<Item = Facet> + use<> {
    let cosine = bumped.dot(n);
    let rough = (u != Vec3::ZERO || v != Vec3::ZERO) && u.is_finite() && v.is_finite();
    let rough = rough && cosine > 0.0 && bumped.is_finite();
    let slope = n - bumped / cosine;
    let radius = sqrt(2.0 / (1.0 - middle));
    let (middle, sides) = if rough { (middle, HEXAGON.as_slice()) } else { (1.0, [].as_slice()) };
    let share = (1.0 - middle) / 6.0;
    let facet = move |[x, y]: [f32; 2]| Facet::new(share, bumped_normal(n, slope + (u * x + v * y) * radius));
    core::iter::once(Facet::new(middle, bumped)).chain(sides.iter().copied().map(facet))
}

const HEIGHT: f32 = 0.866_025_4;

const HEXAGON: [[f32; 2]; 6] =
    [[1.0, 0.0], [0.5, HEIGHT], [-0.5, HEIGHT], [-1.0, 0.0], [-0.5, -HEIGHT], [0.5, -HEIGHT]];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn facets_have_the_moments_of_gaussian_slopes() {
        let n = Vec3::new(0.36, 0.48, 0.8);
        let Frame { tangent, bitangent, .. } = Frame::from_normal(n);
        let bumped = bumped_normal(n, 0.2 * tangent - 0.1 * bitangent);
        let mut moments = [0.0_f32; 6];
        for Facet { share, normal: m } in slope_facets(n, bumped, 0.09) {
            let slope = n - m / m.dot(n);
            let (x, y) = (slope.dot(tangent) - 0.2, slope.dot(bitangent) + 0.1);
            let terms = [1.0, x, y, x * x, x * y, x * x * y * y];
            for (moment, term) in moments.iter_mut().zip(terms) {
                *moment += share * term;
            }
        }
        let expected = [1.0, 0.0, 0.0, 0.09, 0.0, 0.0081];
        for (got, expected) in moments.into_iter().zip(expected) {
            assert_abs_diff_eq!(got, expected, epsilon = 1e-6, "{moments:?}");
        }
    }

    #[test]
    fn what_is_no_variance_is_one_facet() {
        let bumped = Vec3::new(0.6, 0.0, 0.8);
        for variance in [0.0, -1.0, f32::NAN, f32::INFINITY] {
            assert!(slope_facets(Vec3::Z, bumped, variance).eq([Facet::new(1.0, bumped)]), "{variance}");
        }
        for bumped in [Vec3::NEG_Z, Vec3::X, Vec3::ZERO] {
            assert!(slope_facets(Vec3::Z, bumped, 0.1).eq([Facet::new(1.0, bumped)]), "{bumped}");
        }
        assert_eq!(slope_facets(Vec3::Z, Vec3::NAN, 0.1).count(), 1);
        // A large variance is a flank in every direction, and stays a unit normal.
        assert!(slope_facets(Vec3::Z, Vec3::Z, 1e30).all(|f| (f.normal.length() - 1.0).abs() < 1e-5));
    }
}
