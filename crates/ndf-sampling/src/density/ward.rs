//! The NDF implied by Ward's reflection model, isotropic and anisotropic.

use core::f32::consts::PI;

use glam::Vec3;

use crate::density::beckmann::Beckmann;
use crate::density::delegate::delegate_ndf;
use crate::density::roughness::{Roughness, roughness_parameters};
use asperity_core::math;

/// The NDF of Ward's half vectors, with the roughnesses `alpha_x`, `alpha_y`.
///
/// ```text
/// lobe(h) = exp(−(hx²/αx² + hy²/αy²)/hz²) / (4π αx αy)          D(h) = 4 lobe(h)/hz⁴          in sr⁻¹
/// ```
///
/// Ward's model draws half vectors with Gaussian slopes. As an NDF this is [`Beckmann`], which
/// computes everything except [`lobe`](Self::lobe).
///
/// ```
/// use asperity_ndf_sampling::{Beckmann, Ndf, Ward, glam::Vec3};
///
/// let (ward, beckmann) = (Ward::new(0.2, 0.4)?, Beckmann::new(0.2, 0.4)?);
/// let h = Vec3::new(0.3, -0.2, 0.93).normalize();
/// assert_eq!(ward.d(h), beckmann.d(h));
/// assert!((4.0 * ward.lobe(h) / h.z.powi(4) / ward.d(h) - 1.0).abs() < 1e-6);
/// # Ok::<(), asperity_ndf_sampling::NdfError>(())
/// ```
///
/// Ward 1992, "Measuring and Modeling Anisotropic Reflection", eq. 5a; Walter 2005, "Notes on the
/// Ward BRDF", section 3, for the density of the sampled half vectors.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ward {
    alpha: Roughness,
}

roughness_parameters!(Ward);
delegate_ndf!(Ward, facets, Microfacet, VisibleWarp, Radial);

impl Ward {
    /// Ward's specular BRDF over `ρ_s/√(cos θ_i cos θ_o)`: the normalized exponential, in sr⁻¹.
    ///
    /// `h` is the half vector, of which only the slope matters; 0 for `h.z ≤ 0` and NaN.
    #[must_use]
    pub fn lobe(self, h: Vec3) -> f32 {
        let (x, y) = (h.x / (self.alpha.x * h.z), h.y / (self.alpha.y * h.z));
        let falloff = math::exp(-(x * x + y * y));
        if h.z > 0.0 && falloff > 0.0 { falloff / (4.0 * PI * self.alpha.x * self.alpha.y) } else { 0.0 }
    }

    const fn facets(self) -> Beckmann {
        Beckmann { alpha: self.alpha }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn lobe_accepts_every_input() {
        let ward = Ward::isotropic(0.1).unwrap();
        for h in
            [Vec3::NAN, Vec3::NEG_Z, Vec3::X, Vec3::new(f32::INFINITY, 0.0, 1.0), Vec3::new(1.0, 0.0, 1e-40)]
        {
            assert_eq!(ward.lobe(h), 0.0, "{h}");
        }
        assert_abs_diff_eq!(ward.lobe(Vec3::Z) * 0.04 * PI, 1.0, epsilon = 1e-6);
    }
}
