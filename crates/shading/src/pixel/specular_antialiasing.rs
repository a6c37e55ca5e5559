//! Specular anti-aliasing: roughness for the normals that a pixel averages.

use glam::Vec2;

use crate::math::{clamp_to, sqrt};
use crate::pixel::principal_axis::principal_axis;

/// Specular anti-aliasing: the roughness that replaces the curvature within a pixel.
///
/// A pixel averages the normals of a curved surface. Their slopes have a covariance, which adds to
/// the slopes of the facets.
///
/// ```text
/// Σ = σ² (δx δxᵀ + δy δyᵀ),        δx, δy: change of the shading normal per pixel, in its tangent frame
/// α² I → α² I + 2 Σ, where 2 Σ is scaled so that its larger eigenvalue is at most κ
/// isotropic: α² → α² + min(σ² (|∂n/∂x|² + |∂n/∂y|²), κ)
/// ```
///
/// - **Derivatives:** per pixel, as of `dpdx` in a fragment shader. Those along both axes of a
///   [`PixelEllipse`](crate::PixelEllipse) have the same Σ. Derivatives of the half vector in place
///   of the normal filter the highlight of one light.
/// - **Any input:** derivatives that are not finite count as the limit κ. Without derivatives the
///   roughness does not change.
/// - **Accuracy:** Σ of a sphere and of a torus, averaged over a Gaussian pixel, is within 0.5 %
///   relative where the normal turns by 0.1 per pixel, and within 5 % for 0.3.
///
/// Tokuyoshi, Kaplanyan 2019, *Improved Geometric Specular Antialiasing*, eq. 2 and listing 1; 2021,
/// *Stable Geometric Specular Antialiasing with Projected-Space NDF Filtering*, listing 1. The
/// sources clamp each axis of 2 Σ; the larger eigenvalue does not depend on the frame.
///
/// ```
/// use asperity_shading::{glam::Vec2, pixel::SpecularAntialiasing};
///
/// let filter = SpecularAntialiasing::default();
/// // The surface is bent along x only.
/// let bent = [Vec2::new(0.3, 0.0), Vec2::ZERO];
/// let [xx, xy, yy] = filter.slope_covariance(bent);
/// assert!((xx - 0.09 / core::f32::consts::TAU).abs() < 1e-6 && xy == 0.0 && yy == 0.0);
/// assert_eq!(filter.roughness(0.2, [Vec2::ZERO; 2]), 0.2);
/// assert!(filter.roughness(0.2, bent) > 0.22);
/// ```
#[doc(alias = "toksvig")]
#[doc(alias = "ndf filtering")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpecularAntialiasing {
    /// σ²: variance of the Gaussian pixel filter, in square pixels. 1/(2π) by default.
    pub variance: f32,
    /// κ: maximum of the added α². 0.18 by default.
    pub max_alpha_squared: f32,
}

impl Default for SpecularAntialiasing {
    fn default() -> Self {
        Self { variance: 0.5 * core::f32::consts::FRAC_1_PI, max_alpha_squared: 0.18 }
    }
}

impl SpecularAntialiasing {
    /// Σ: the covariance `[xx, xy, yy]` of the slopes that the pixel averages.
    ///
    /// Add it to the variance of bumps that the pixel does not resolve.
    #[must_use]
    pub fn slope_covariance(&self, normal_derivatives: [Vec2; 2]) -> [f32; 3] {
        let [dx, dy] = normal_derivatives;
        let [variance, most] = [self.variance, 0.5 * self.max_alpha_squared].map(|x| clamp_to(x, f32::MAX));
        let [xx, xy, yy] = [dx.x * dx.x + dy.x * dy.x, dx.x * dx.y + dy.x * dy.y, dx.y * dx.y + dy.y * dy.y]
            .map(|sum| variance * sum);
        let (_, apart) = principal_axis([xx, xy, yy]);
        let larger = 0.5 * (xx + yy) + apart;
        if larger <= most {
            [xx, xy, yy]
        } else if larger < f32::MAX {
            [xx, xy, yy].map(|c| c * (most / larger))
        } else {
            [most, 0.0, most]
        }
    }

    /// The widened roughness of isotropic facets, for a lobe that stays isotropic.
    #[must_use]
    pub fn roughness(&self, alpha: f32, normal_derivatives: [Vec2; 2]) -> f32 {
        let [dx, dy] = normal_derivatives;
        let [variance, most] = [self.variance, self.max_alpha_squared].map(|x| clamp_to(x, f32::MAX));
        let turned = variance * (dx.length_squared() + dy.length_squared());
        let added = if turned.is_nan() { most } else { turned.min(most) };
        let alpha = clamp_to(alpha, 1.0);
        if added > 0.0 { sqrt(alpha * alpha + added).min(1.0) } else { alpha }
    }

    /// The widened roughness along the principal axes of the pixel, and the unit vector of the
    /// first one in the tangent frame.
    ///
    /// `alpha` is the roughness along x and y. The first axis is the rougher one. Without
    /// derivatives the axes are x and y.
    #[must_use]
    pub fn anisotropic_roughness(&self, alpha: Vec2, normal_derivatives: [Vec2; 2]) -> (Vec2, Vec2) {
        let alpha = alpha.map(|a| clamp_to(a, 1.0));
        let [xx, xy, yy] = self.slope_covariance(normal_derivatives).map(|c| 2.0 * c);
        let (xx, yy) = (xx + alpha.x * alpha.x, yy + alpha.y * alpha.y);
        let (axis, apart) = principal_axis([xx, xy, yy]);
        let larger = 0.5 * (xx + yy) + apart;
        // Without the difference of nearly equal numbers; the facets are never narrower than before.
        let smaller = if xy == 0.0 { xx.min(yy) } else { (xx * yy - xy * xy) / larger };
        let narrowest = alpha.min_element();
        let sides = Vec2::new(larger, smaller.max(narrowest * narrowest));
        (sides.map(|square| if square < 1.0 { sqrt(square) } else { 1.0 }), axis)
    }
}
