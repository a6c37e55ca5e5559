//! Shades a point of a mesh with metallic paint, from the numbers that any renderer has.
#![expect(clippy::print_stdout, reason = "an example prints its result")]

use asperity_shading::glam::{Vec2, Vec3};
use asperity_shading::{Material, MetallicPaint, MetallicPaintParameters, PixelEllipse, SurfacePoint};

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let pigment = Vec3::new(0.02, 0.05, 0.3);
    let paint = MetallicPaint::new(MetallicPaintParameters { pigment, ..Default::default() })?;

    // An intersection in world space, with ray differentials.
    let (p, n, uv) = ([0.3, 0.1, 0.8], [0.48, 0.6, 0.64], Vec2::new(0.3, 0.1));
    let (dpdu, dpdv) = ([0.8, 0.0, -0.6], [-0.36, 0.8, -0.48]);
    let (dpdx, dpdy) = ([0.0008, 0.0, -0.0006], [-0.0009, 0.002, -0.0012]);
    let pixel = PixelEllipse::from_derivatives(dpdx.into(), dpdy.into());
    let point = SurfacePoint::new(p.into(), n.into(), pixel).with_uv(uv, [dpdu.into(), dpdv.into()]);

    let (wo, wi) = (Vec3::new(0.0, 0.6, 0.8), Vec3::new(0.8, 0.6, 0.0));
    let bsdf = paint.bsdf(&point, wo);
    let lamp = bsdf.eval_cos(wo, wi);
    let next = bsdf.sample(wo, 0.0, Vec2::new(0.3, 0.7)).ok_or("no light")?;

    println!("lamp: {lamp}, next ray: {}, weight {}", next.wi, next.weight());
    assert!(lamp.z > lamp.x && lamp.min_element() > 0.0);
    assert!(next.is_specular() && next.wi.dot(n.into()) > 0.0);
    Ok(())
}
