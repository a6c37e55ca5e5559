//! Checks that a user's glam, in the oldest version that Asperity allows, is the version used by
//! Asperity.

use asperity_ndf_sampling::{Ggx, Ndf};
use asperity_noise::{Field, Perlin};
use asperity_shading::Footprint;
use glam::{DVec2, Vec2, Vec3};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let z = Vec2::new(0.7, -1.1);
    assert!(Ggx::new(0.2, 0.4)?.warp_gaussian(z).is_normalized());
    assert!(Perlin::new(42).sample(Vec3::new(0.3, -4.2, 7.9)).gradient.is_finite());
    assert!(Footprint::from_distance(3.0, 1e-3, 0.8).width() > 0.0);
    let (g, x) = (asperity_fif::cochran_2000::g()?, DVec2::new(0.3, 0.8));
    assert!(asperity_fif::HeightField::new(g.clone(), g).evaluate(x.x, x.y, 1e-9).value.is_finite());
    Ok(())
}
