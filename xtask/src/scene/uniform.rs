//! Normals spread evenly over the map of normals: what a bump map has that knows nothing of its reflectance.

use std::f32::consts::FRAC_1_PI;

use asperity_shading::Ndf;
use glam::{Vec2, Vec3};

/// The density `D = 1/π`, uniform over the disk of `(n_x, n_y)`.
///
/// ```text
/// T(z) = (r z/ρ, √(1 − r²)),   r² = 1 − exp(−ρ²/2),   ρ = |z|
/// ```
#[derive(Clone, Copy, Debug)]
pub(crate) struct UniformNormals;

impl Ndf for UniformNormals {
    fn density(&self, m: Vec3) -> f32 {
        if m.z > 0.0 { FRAC_1_PI } else { 0.0 }
    }

    fn from_gaussian(&self, z: Vec2) -> Vec3 {
        let rho2 = z.length_squared().min(160.0);
        let r = (-(-0.5 * rho2).exp_m1()).sqrt();
        let direction = z.normalize_or_zero();
        (direction * r).extend((-0.25 * rho2).exp())
    }

    fn to_gaussian(&self, m: Vec3) -> Vec2 {
        let rho = (-4.0 * m.z.clamp(1e-17, 1.0).ln()).sqrt();
        Vec2::new(m.x, m.y).normalize_or_zero() * rho
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn half_of_the_gaussian_plane_covers_half_of_the_disk() {
        // P(ρ² < 2 ln 2) = 1/2, and half of the disk's area is inside r² = 1/2.
        let m = UniformNormals.from_gaussian(Vec2::new(0.0, (2.0 * 2.0_f32.ln()).sqrt()));
        assert!((m.y * m.y - 0.5).abs() < 1e-6 && (m.length() - 1.0).abs() < 1e-6, "{m}");
    }

    #[test]
    fn the_map_and_its_inverse_agree() {
        for z in [Vec2::new(0.3, -1.2), Vec2::new(-2.0, 0.1), Vec2::ZERO] {
            let back = UniformNormals.to_gaussian(UniformNormals.from_gaussian(z));
            assert!(back.abs_diff_eq(z, 1e-4), "{z}: {back}");
        }
    }
}
