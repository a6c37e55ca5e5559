//! Bump mapping three ways, beside the surface that is really displaced.

use asperity_render::{
    geometry::{camera::Camera, mesh::TracedMesh, relief::relief, shape::Shape},
    light::lamps::{Lamps, direction},
    materials::{chalk, sky},
    scene::{Backdrop, Light, Object, Scene},
};
use asperity_shading::SurfacePoint;
use asperity_shading::bump::{bumped_normal, differences, displace, surface_gradient, tangential};
use asperity_shading::noise::{Field, Normalisation, Octaves, Perlin2002, Sample, Spectrum};
use glam::{Vec2, Vec3};

use crate::failure::Failure;
use crate::gallery::figure::{Context, Drawn, Panel};

const HEIGHT: f32 = 0.055;
const FREQUENCY: f32 = 3.2;
/// Between neighbours, in radians.
const STEP: f32 = 2e-3;

type Noise = Octaves<Perlin2002, 3>;

/// The shading normal at a point.
type Normal<'a> = dyn Fn(&SurfacePoint) -> Vec3 + Sync + 'a;

/// The height over the sphere, and its gradient in space.
fn height(noise: &Noise, p: Vec3) -> (f32, Vec3) {
    let Sample { value, gradient } = noise.detail(3.0).sample(p * FREQUENCY);
    (HEIGHT * value, HEIGHT * FREQUENCY * gradient)
}

/// The point of the sphere at a longitude and a latitude, with its derivatives by both.
fn sphere(uv: Vec2) -> (Vec3, [Vec3; 2]) {
    let ((sx, cx), (sy, cy)) = (uv.x.sin_cos(), uv.y.sin_cos());
    (Vec3::new(cy * cx, cy * sx, sy), [Vec3::new(-cy * sx, cy * cx, 0.0), Vec3::new(-sy * cx, -sy * sx, cy)])
}

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn, Failure> {
    let noise =
        Octaves::new(Perlin2002::new(7), Spectrum::default()).with_normalisation(Normalisation::Range);
    let displaced = Shape::Mesh(TracedMesh::new(relief(|t, phi| {
        let (sin, cos) = (t * std::f32::consts::PI).sin_cos();
        let p = Vec3::new(sin * phi.cos(), sin * phi.sin(), cos);
        p * (1.0 + height(&noise, p).0)
    })));
    let by_gradient = |hit: &SurfacePoint| {
        bumped_normal(hit.normal, tangential(hit.normal, height(&noise, hit.position).1))
    };
    let by_neighbours = |hit: &SurfacePoint| {
        let slope = differences(|uv| height(&noise, sphere(uv).0).0, hit.uv, STEP);
        bumped_normal(hit.normal, surface_gradient(hit.normal, hit.tangents, slope))
    };
    let of_displaced = |hit: &SurfacePoint| {
        let n = hit.position.normalize_or(hit.normal);
        let uv = Vec2::new(n.y.atan2(n.x), n.z.clamp(-1.0, 1.0).asin());
        let (p, tangents) = sphere(uv);
        let (height, gradient) = height(&noise, p);
        let slope = Vec2::from(tangents.map(|t| gradient.dot(t)));
        displace(p, n, tangents, tangents, height, slope).normal
    };
    let sampling = context.sampling([12, 12], 2);
    let ways: [(&str, &str, Shape, &Normal<'_>); 3] = [
        ("gradient", "The noise's gradient along the surface", Shape::Sphere, &by_gradient),
        ("neighbours", "Heights of four neighbours", Shape::Sphere, &by_neighbours),
        ("displaced", "Displaced, with its own normal", displaced, &of_displaced),
    ];
    let mut panels = Vec::new();
    for (stem, label, shape, normal) in ways {
        let camera =
            Camera::new(Vec3::new(0.0, -4.9, 1.2), Vec3::ZERO, 0.47, sampling.width, sampling.height);
        let clay = |point: &SurfacePoint, wo: Vec3| {
            let (m, colour) = (normal(point), Vec3::new(0.62, 0.58, 0.53));
            chalk(wo, point.frame().to_local(m), colour, 0.28 * colour * sky(m))
        };
        let lamps = vec![Lamps::one(direction(-132.0, 40.0), Vec3::splat(1.1))];
        let objects = vec![Object::shaded(shape, clay)];
        let image =
            context.draw(&Scene::new(objects, Light::lamps(lamps), Backdrop::Studio), sampling, &camera)?;
        panels.push(Panel::raster(stem, label, "A sphere with hills and dales", image.exposed(1.0)));
    }
    Ok(Drawn::new(3, panels)
        .fact("height", format!("{HEIGHT} of the radius"))
        .fact("noise", format!("Perlin 2002, three octaves, {FREQUENCY} cells per radius"))
        .fact("step between neighbours", format!("{STEP} radians")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn neighbours_and_gradient_give_the_same_normal() {
        let noise =
            Octaves::new(Perlin2002::new(7), Spectrum::default()).with_normalisation(Normalisation::Range);
        for k in 0..60_u8 {
            let uv = Vec2::new(f32::from(k) * 0.1 - 3.0, f32::from(k % 11) * 0.2 - 1.0);
            let (p, tangents) = sphere(uv);
            let (_, gradient) = height(&noise, p);
            let a = bumped_normal(p, tangential(p, gradient));
            let slope = differences(|uv| height(&noise, sphere(uv).0).0, uv, STEP);
            let b = bumped_normal(p, surface_gradient(p, tangents, slope));
            // The third derivative of 12.8 cells per radius over 2e-3: measured 2e-3.
            assert!((a - b).length() < 5e-3, "{uv}: {a} {b}");
        }
    }
}
