//! Normal distribution functions: closed forms, tables over the cosine, and compositions.

pub(crate) mod ashikhmin_shirley;
pub(crate) mod beckmann;
pub(crate) mod blend;
pub(crate) mod blinn_phong;
pub(crate) mod closed_form;
pub(crate) mod delegate;
pub(crate) mod gaussian_lanes;
pub(crate) mod ggx;
pub(crate) mod isotropic;
pub(crate) mod isotropic_cell;
pub(crate) mod mixture;
pub(crate) mod rotated;
pub(crate) mod roughness;
pub(crate) mod student_distribution;
pub(crate) mod student_t;
pub(crate) mod view_axis;
pub(crate) mod visible_slopes;
pub(crate) mod ward;

#[cfg(test)]
mod tests {
    use glam::{Vec2, Vec3};

    use crate::density::roughness::{MAX_ALPHA, MIN_ALPHA};
    use crate::microfacet::totality;
    use crate::ndf::Ndf;
    use crate::{AshikhminShirley, Beckmann, BlinnPhong, Ggx, Mixture, Rotated, StudentT};

    #[test]
    fn ndfs_accept_every_input() {
        for alpha in [MIN_ALPHA, 1e-4, 1.0, MAX_ALPHA] {
            totality::check(&Ggx::isotropic(alpha).unwrap());
            totality::check(&Beckmann::isotropic(alpha).unwrap());
        }
        let (least, most) = (StudentT::MIN_GAMMA, StudentT::MAX_GAMMA);
        for (alpha, gamma) in [(MIN_ALPHA, least), (1e-4, most), (1.0, 2.0), (MAX_ALPHA, least)] {
            totality::check(&StudentT::new(alpha, alpha, gamma).unwrap());
        }
        let most = BlinnPhong::MAX_EXPONENT;
        for (n_u, n_v) in [(0.0, most), (most, most), (3.0, 1e4)] {
            totality::check(&AshikhminShirley::new(n_u, n_v).unwrap());
        }
        let ggx = Ggx::isotropic(0.3).unwrap();
        totality::check(&Mixture::new(ggx, BlinnPhong::new(0.0).unwrap(), 0.5).unwrap());
        totality::check(&Rotated::new(ggx, -1e30).unwrap());
        #[cfg(feature = "alloc")]
        crate::ndf::totality::check(&crate::Isotropic::new(&[0.0, 0.0, f32::MAX, 0.0]).unwrap());
    }

    #[test]
    fn to_gaussian_of_the_zenith_is_zero() {
        for ndf in [&Ggx::new(0.2, 0.4).unwrap() as &dyn Ndf, &Beckmann::new(0.2, 0.4).unwrap()] {
            assert_eq!((ndf.warp_gaussian(Vec2::ZERO), ndf.invert(Vec3::Z)), (Vec3::Z, Vec2::ZERO));
        }
    }

    #[test]
    fn beckmann_density_vanishes_near_the_horizon() {
        // Where exp and mz⁴ both underflow.
        let beckmann = Beckmann::isotropic(0.5).unwrap();
        for z in [1e-3, 1e-9, 1e-20, 1e-40] {
            assert_eq!(beckmann.d(Vec3::new(1.0, 0.0, z)), 0.0, "{z}");
        }
    }
}
