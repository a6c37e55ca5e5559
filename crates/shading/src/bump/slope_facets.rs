//! Unresolved slopes as a few facets.

use asperity_ndf_sampling::Frame;
use glam::Vec3;

use crate::bump::surface_gradient::bumped_normal;
use crate::math::sqrt;

/// A facet of a surface: a normal with its fraction of a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facet {
    /// The fraction of the pixel, in [0, 1].
    pub weight: f32,
    /// The unit normal.
    pub normal: Vec3,
}

impl Facet {
    /// A flat surface in its own frame.
    pub const FLAT: Self = Self { weight: 1.0, normal: Vec3::Z };

    /// Creates a facet with this fraction and normal.
    #[must_use]
    pub const fn new(share: f32, normal: Vec3) -> Self {
        Self { weight: share, normal }
    }

    /// A part of the facet: the normal with a fraction of its fraction.
    pub(crate) fn part(self, share: f32) -> Self {
        Self { weight: self.weight * share, ..self }
    }
}

/// Approximates Gaussian slopes around a bumped normal by facets with weights.
///
/// ```text
/// slopes g, g + √(6 − 2√3) σ (cos kπ/3, sin kπ/3) and g + √(6 + 2√3) σ (sin kπ/3, cos kπ/3),
/// weights 1/3, six times (2 + √3)/36 and six times (2 − √3)/36,   σ² = variance,   g the slope of `bumped`
/// ```
///
/// `variance` is the variance along each axis, which level of detail removed from the bumps of a
/// material. The mean of a lighting model over the facets is the radiance of the pixel. It is exact
/// for models that are polynomials of the slope up to the fifth degree, and polynomials of |slope −
/// g|² up to the fourth. The rule is Gauss–Radau quadrature for the Laguerre weight, with hexagons
/// in place of circles (Stroud 1971, *Approximate Calculation of Multiple Integrals*, §2.7). A
/// Beckmann lobe of α = √2 · σ or more has no gaps between the facets. With σ = 0.1 a mirror of
/// this width errs by 1.3 % of its peak directly above, and a mirror of half this width by 56 %.
/// For narrower lobes α² + 2 · variance is the better approximation.
///
/// Facets may face away from the eye: see [`flip_to_visible`](crate::bump::flip_to_visible).
///
/// - **Domain:** unit `n` and `bumped`. A variance that is not positive and finite, or a normal
///   that is not above the surface, returns one facet, `bumped`.
///
/// ```
/// use asperity_shading::bump::slope_facets;
/// use asperity_shading::glam::Vec3;
///
/// // Bumps reduce the light from straight above and reflect it to the sides.
/// let mean = |light: Vec3| -> f32 {
///     slope_facets(Vec3::Z, Vec3::Z, 0.01).map(|f| f.weight * f.normal.dot(light).max(0.0)).sum()
/// };
/// assert!((mean(Vec3::Z) - (1.0 - 0.01)).abs() < 3e-4);
/// ```
pub fn slope_facets(n: Vec3, bumped: Vec3, variance: f32) -> impl Iterator<Item = Facet> + use<> {
    let Frame { tangent, bitangent, .. } = Frame::from_normal(n);
    let deviation = if variance > 0.0 { sqrt(variance) } else { 0.0 };
    let root = sqrt(3.0);
    let rings = [-root, root].map(|root| [(2.0 - root) / 6.0, sqrt(6.0 + 2.0 * root)]);
    in_rings(n, bumped, [tangent * deviation, bitangent * deviation], rings)
}

/// Fewer facets for slopes with these deviations along two axes.
///
/// The facet in the middle has the given fraction.
///
/// ```text
/// √(2/(1 − middle)) (u cos kπ/3 + v sin kπ/3),   weights (1 − middle)/6
/// ```
///
/// Exact up to the fifth degree if the middle has one half (Stroud 1971, E₂^{r²} 5-1).
pub fn facets_along(
    n: Vec3,
    bumped: Vec3,
    axes: [Vec3; 2],
    middle: f32,
) -> impl Iterator<Item = Facet> + use<> {
    in_rings(n, bumped, axes, [[1.0 - middle, sqrt(2.0 / (1.0 - middle))]])
}

/// A facet in the middle and six in each ring of this fraction and radius.
///
/// Every other ring is rotated by a twelfth of a turn.
fn in_rings<const RINGS: usize>(
    n: Vec3,
    bumped: Vec3,
    [u, v]: [Vec3; 2],
    rings: [[f32; 2]; RINGS],
) -> impl Iterator<Item = Facet> + use<RINGS> {
    let cosine = bumped.dot(n);
    let rough = (u != Vec3::ZERO || v != Vec3::ZERO) && u.is_finite() && v.is_finite();
    let rough = rough && cosine > 0.0 && bumped.is_finite();
    let slope = n - bumped / cosine;
    let middle = if rough { 1.0 - rings.iter().map(|[share, _]| share).sum::<f32>() } else { 1.0 };
    let count = if rough { RINGS } else { 0 };
    let sides = rings.into_iter().take(count).enumerate().flat_map(move |(ring, [share, radius])| {
        HEXAGON.into_iter().map(move |[x, y]| {
            let [x, y] = if ring % 2 == 0 { [x, y] } else { [y, x] };
            Facet::new(share / 6.0, bumped_normal(n, slope + (u * x + v * y) * radius))
        })
    });
    core::iter::once(Facet::new(middle, bumped)).chain(sides)
}

const HEIGHT: f32 = 0.866_025_4;

const HEXAGON: [[f32; 2]; 6] =
    [[1.0, 0.0], [0.5, HEIGHT], [-0.5, HEIGHT], [-1.0, 0.0], [-0.5, -HEIGHT], [0.5, -HEIGHT]];

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn facets_have_the_moments_of_gaussian_slopes() {
        let n = Vec3::new(0.36, 0.48, 0.8);
        let Frame { tangent, bitangent, .. } = Frame::from_normal(n);
        let bumped = bumped_normal(n, 0.2 * tangent - 0.1 * bitangent);
        let mut moments = [0.0_f32; 8];
        for Facet { weight: share, normal: m } in slope_facets(n, bumped, 0.09) {
            let slope = n - m / m.dot(n);
            let (x, y) = (slope.dot(tangent) - 0.2, slope.dot(bitangent) + 0.1);
            let (square, xy) = (x * x + y * y, x * y);
            let terms = [1.0, x, y, x * x, xy, xy * xy, square.powi(3) / 48.0, square.powi(4) / 384.0];
            for (moment, term) in moments.iter_mut().zip(terms) {
                *moment += share * term;
            }
        }
        let expected = [1.0, 0.0, 0.0, 0.09, 0.0, 0.0081, 0.09_f32.powi(3), 0.09_f32.powi(4)];
        for (got, expected) in moments.into_iter().zip(expected) {
            assert_abs_diff_eq!(got, expected, epsilon = 1e-6, "{moments:?}");
        }
    }

    #[test]
    fn slope_facets_of_invalid_variance_is_one_facet() {
        let bumped = Vec3::new(0.6, 0.0, 0.8);
        for variance in [0.0, -1.0, f32::NAN, f32::INFINITY] {
            assert!(slope_facets(Vec3::Z, bumped, variance).eq([Facet::new(1.0, bumped)]), "{variance}");
        }
        for bumped in [Vec3::NEG_Z, Vec3::X, Vec3::ZERO] {
            assert!(slope_facets(Vec3::Z, bumped, 0.1).eq([Facet::new(1.0, bumped)]), "{bumped}");
        }
        assert_eq!(slope_facets(Vec3::Z, Vec3::NAN, 0.1).count(), 1);
        // A large variance has steep slopes in every direction, and the normals remain unit
        // vectors.
        assert!(slope_facets(Vec3::Z, Vec3::Z, 1e30).all(|f| (f.normal.length() - 1.0).abs() < 1e-5));
    }
}
