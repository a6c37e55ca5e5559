//! NDFs as distributions of normals for the random number generators of the crate `rand`.

use glam::{Vec2, Vec3};
use rand::{Rng, RngExt, distr::Distribution};

use crate::density::ashikhmin_shirley::AshikhminShirley;
use crate::density::beckmann::Beckmann;
use crate::density::blinn_phong::BlinnPhong;
use crate::density::ggx::Ggx;
#[cfg(feature = "alloc")]
use crate::density::isotropic::Isotropic;
use crate::density::mixture::Mixture;
use crate::density::rotated::Rotated;
use crate::density::student_t::StudentT;
use crate::density::ward::Ward;
#[cfg(feature = "alloc")]
use crate::map::packed::ndf_map::NdfMap;
use crate::ndf::Ndf;
use crate::radial::Radial;

macro_rules! distribution {
    ($density:ty $(, $parameter:ident: $bound:ident)*) => {
        /// A normal with the density `D` over the macro surface: [`Ndf::sample`] of two uniform
        /// numbers.
        impl<$($parameter: $bound),*> Distribution<Vec3> for $density {
            fn sample<R: Rng + ?Sized>(&self, rng: &mut R) -> Vec3 {
                let u = Vec2::new(rng.random(), rng.random());
                Ndf::sample(self, u)
            }
        }
    };
}

distribution!(Ggx);
distribution!(Beckmann);
distribution!(StudentT);
distribution!(Ward);
distribution!(BlinnPhong);
distribution!(AshikhminShirley);
distribution!(Rotated<N>, N: Ndf);
distribution!(Mixture<A, B>, A: Radial, B: Radial);
#[cfg(feature = "alloc")]
distribution!(Isotropic);
#[cfg(feature = "alloc")]
distribution!(NdfMap);

#[cfg(test)]
mod tests {
    use rand::{SeedableRng, rngs::SmallRng};

    use super::*;

    #[test]
    fn rng_sample_uses_two_uniform_numbers() {
        let ggx = Ggx::new(0.2, 0.4).unwrap();
        let mut rng = SmallRng::seed_from_u64(7);
        let mut same = rng.clone();
        for _ in 0..100 {
            let u = Vec2::from_array([same.random(), same.random()]);
            assert_eq!(rng.sample(ggx), Ndf::sample(&ggx, u));
        }
    }
}
