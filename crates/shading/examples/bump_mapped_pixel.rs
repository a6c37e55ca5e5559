//! Shades one pixel of bump-mapped copper under one light.
#![expect(clippy::print_stdout, reason = "an example prints its result")]

use asperity_shading::glam::Vec3;
use asperity_shading::noise::{FbmSpectrum, GaussianFbm, GaussianNoise};
use asperity_shading::{BumpField, BumpMapped, Footprint, Ggx, LevelOfDetail, Material, SurfacePoint};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let bumps = BumpField::new(GaussianFbm::new(GaussianNoise::new(1), FbmSpectrum::default()), 20.0)?;
    let (ndf, rule, color) = (Ggx::new(0.2, 0.4)?, LevelOfDetail::Exact, Vec3::new(0.95, 0.64, 0.54));
    let copper = BumpMapped { ndf, bumps, rule, color };

    let (position, normal) = (Vec3::new(0.3, 0.1, 0.8), Vec3::Z);
    let (wo, wi) = (Vec3::new(-0.36, 0.48, 0.8), Vec3::new(0.6, 0.0, 0.8));
    let pixel = Footprint::from_distance(50.0, 1e-3, wo.dot(normal));
    let point = SurfacePoint::new(position, normal, pixel);
    let radiance = 3.0 * copper.bsdf(&point, wo).eval_cos(wo, wi);

    println!("{radiance}");
    assert!(radiance.min_element() > 0.0 && radiance.x > radiance.z);
    Ok(())
}
