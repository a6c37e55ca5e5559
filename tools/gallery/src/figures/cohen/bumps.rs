//! Bump mapping by three methods, next to the displaced surface; bump-mapped brick, close and up to
//! the horizon; and bevels along the edges of a plate.

use std::f32::consts::PI;

use asperity_render::geometry::{mesh::TracedMesh, relief::relief, shape::Shape};
use asperity_render::light::lamps::{Lamps, direction, studio};
use asperity_render::materials::{chalk, sky};
use asperity_render::scene::{Backdrop, Light, Object, Scene};
use asperity_render::{image::tone::hex, integrator::pixels::Sampling, sampling::sampler::hash};
use asperity_shading::Frame;
use asperity_shading::bump::{
    Facet, bumped_normal, displace, finite_difference_gradient, project_to_tangent_plane, surface_gradient,
};
use asperity_shading::material::Material;
use asperity_shading::noise::{Fbm, FbmSpectrum, Normalization, Perlin, Sample};
use asperity_shading::reflectance::{Bsdf, Lobe, SchlickF82};
use asperity_shading::texture::{Bevel, BevelParameters, Edge};
use asperity_shading::{Brdf, Brick, CookTorrance, Ggx, PixelEllipse, SurfacePoint, reflect};
use glam::{Vec2, Vec3};

use crate::figure::{Context, Drawn, Panel};
use asperity::failure::Result;

const HEIGHT: f32 = 0.055;
const FREQUENCY: f32 = 3.2;
/// Between neighbors, in radians.
const STEP: f32 = 2e-3;

type Noise = Fbm<Perlin, Vec3>;

/// The shading normal at a point.
type Normal<'a> = dyn Fn(&SurfacePoint) -> Vec3 + Sync + 'a;

/// Returns the height over the sphere, and its gradient in space.
fn height(noise: &Noise, p: Vec3) -> (f32, Vec3) {
    let Sample { value, gradient } = noise.sample_with_octaves(p * FREQUENCY, 3.0);
    (HEIGHT * value, HEIGHT * FREQUENCY * gradient)
}

/// Returns the point of the sphere at a longitude and a latitude, with its derivatives.
fn sphere(uv: Vec2) -> (Vec3, [Vec3; 2]) {
    let ((sx, cx), (sy, cy)) = (uv.x.sin_cos(), uv.y.sin_cos());
    (Vec3::new(cy * cx, cy * sx, sy), [Vec3::new(-cy * sx, cy * cx, 0.0), Vec3::new(-sy * cx, -sy * sx, cy)])
}

pub(crate) fn draw_bumps(context: &Context<'_>) -> Result<Drawn> {
    let noise = Fbm::new(Perlin::new(7), FbmSpectrum::default()).with_normalization(Normalization::UnitRange);
    let displaced = Shape::Mesh(TracedMesh::new(relief(|t, phi| {
        let (sin, cos) = (t * PI).sin_cos();
        let p = Vec3::new(sin * phi.cos(), sin * phi.sin(), cos);
        p * (1.0 + height(&noise, p).0)
    })));
    let by_gradient = |hit: &SurfacePoint| {
        bumped_normal(hit.normal, project_to_tangent_plane(hit.normal, height(&noise, hit.position).1))
    };
    let by_neighbors = |hit: &SurfacePoint| {
        let slope = finite_difference_gradient(|uv| height(&noise, sphere(uv).0).0, hit.uv, STEP);
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
    let alt = "A sphere with hills and dales";
    let ways: [([&str; 3], (Shape, &Normal<'_>)); 3] = [
        (["gradient", "Tangential gradient of the noise", alt], (Shape::Sphere, &by_gradient)),
        (["neighbors", "Heights of four neighbors", alt], (Shape::Sphere, &by_neighbors)),
        (["displaced", "Displaced surface with its normal", alt], (displaced, &of_displaced)),
    ];
    let drawn = Drawn::pictures(3, ways, |(shape, normal)| {
        let clay = |point: &SurfacePoint, wo: Vec3| {
            let (m, color) = (normal(point), Vec3::new(0.62, 0.58, 0.53));
            chalk(point.frame(), wo, point.frame().to_local(m), color, 0.28 * color * sky(m))
        };
        let light = Light::lamps(vec![Lamps::one(direction(-132.0, 40.0), Vec3::splat(1.1))]);
        let scene = Scene::new(vec![Object::shaded(shape, clay)], light, Backdrop::Studio);
        let view = [Vec3::new(0.0, -4.9, 1.2), Vec3::ZERO];
        Ok(context.look(&scene, context.sampling([12, 12], 2), view, 0.47)?.exposed(1.0))
    })?;
    Ok(drawn
        .fact("height", format!("{HEIGHT} of the radius"))
        .fact("noise", format!("Perlin 2002, three octaves, {FREQUENCY} cells per radius"))
        .fact("step between neighbors", format!("{STEP} radians")))
}

pub(crate) fn draw_brick(context: &Context<'_>) -> Result<Drawn> {
    let wall = Brick::default();
    let wide = context.sampling([24, 8], 4);
    let scale = 1.1 / wide.width as f32;
    let image = context.render(wide, |x, y| {
        shade(&wall, Vec2::new(x, wide.height as f32 - y) * scale + Vec2::new(0.04, 0.02), Vec2::ZERO)
    })?;
    let alt = "A brick wall with recessed mortar";
    let mut panels = vec![Panel { span: 3, ..Panel::new("wall", "The wall", alt, image.exposed(1.0)) }];
    for (stem, label, samples, filtered) in [
        ("plain", "One sample per pixel", 1, false),
        ("filtered", "One filtered sample per pixel", 1, true),
        ("mean", "256 samples per pixel", 256, false),
    ] {
        let sampling = Sampling { samples_per_pixel: samples, ..context.sampling([12, 8], 1) };
        let (half, height) = (0.5 * sampling.width as f32, sampling.height as f32);
        let image = context.render(sampling, |x, y| {
            // A single sample is at the pixel's center.
            let (x, y) = if samples == 1 { (x.floor() + 0.5, y.floor() + 0.5) } else { (x, y) };
            let at = |x: f32, y: f32| {
                let distance = 0.35 * height / (y + 0.02 * height).max(0.02);
                Vec2::new((x - half) / (0.8 * height) * distance, distance)
            };
            let (dx, dy) = (at(x + 0.5, y) - at(x - 0.5, y), at(x, y + 0.5) - at(x, y - 0.5));
            let widths = if filtered { dx.abs() + dy.abs() } else { Vec2::ZERO };
            shade(&wall, at(x, y), widths)
        })?;
        let alt = format!("A floor of bricks to the horizon, {}", label.to_lowercase());
        panels.push(Panel::new(stem, label, alt, image.exposed(1.0)));
    }
    Ok(Drawn::new(3, panels).fact("depth of the mortar", DEPTH).fact("facets of a distant pixel", "50"))
}

const DEPTH: f32 = 0.004;

/// Shades the wall under one lamp and a sky, with a separate color per brick that a pixel resolves.
fn shade(wall: &Brick, uv: Vec2, widths: Vec2) -> Vec3 {
    let sun = direction(126.0, 34.0);
    let [column, row] = wall.sample(uv).cell;
    let own = hash(column as u32 ^ hash(row as u32)) as f32 / 4_294_967_296.0 - 0.5;
    // Several bricks in a pixel are averaged.
    let resolved = (1.0 - widths.x.max(3.0 * widths.y) / 0.25).clamp(0.0, 1.0);
    let clay = hex(0xa5_4f3c) * (1.0 + 0.5 * own * resolved);
    let mut light = Vec3::ZERO;
    wall.facets(uv, PixelEllipse::aligned(widths), |share, brick, slope| {
        let gradient = surface_gradient(Vec3::Z, [Vec3::X, Vec3::Y], DEPTH * slope);
        let normal = bumped_normal(Vec3::Z, gradient);
        let color = hex(0xb4_aea4).lerp(clay, brick);
        let facet = chalk(Frame::IDENTITY, Vec3::Z, normal, color, 0.3 * color);
        light += share * (facet.emitted() + 1.35 * PI * facet.eval_cos(Vec3::Z, sun));
    });
    light
}

/// Width of the plateau and of the whole ridge.
const WIDTHS: [f32; 2] = [0.02, 0.13];

pub(crate) fn draw_bevel(context: &Context<'_>) -> Result<Drawn> {
    let corner =
        |k: u32| Vec2::from_angle(PI * (0.5 + 0.2 * k as f32)) * if k.is_multiple_of(2) { 0.95 } else { 0.5 };
    let corners: Vec<_> = (0..10).map(corner).collect();
    let steel = CookTorrance::new(Ggx::isotropic(0.3)?, SchlickF82::new(0.62, 0.9)?);
    let eye = Vec3::new(0.0, 0.06, 6.0);
    let field = 2.0 * (1.0_f32 / 6.0).atan();
    let bevels = [
        ("rolling", "top 0, bottom 1", [0.0, 1.0]),
        ("running-out", "top 1, bottom 0", [1.0, 0.0]),
        ("chamfer", "top and bottom 1/2", [0.5, 0.5]),
        ("groove", "top and bottom −1/2", [-0.5, -0.5]),
    ];
    let words = |label| format!("A star-shaped plate with beveled edges, {label}");
    let pictures =
        bevels.map(|(stem, label, heights)| ([stem.to_owned(), label.to_owned(), words(label)], heights));
    let drawn = Drawn::pictures(4, pictures, |[top, bottom]| {
        let bevel = Bevel::new(BevelParameters { plateau: WIDTHS[0], ridge: WIDTHS[1], top, bottom })?;
        let plate = Object::new(Shape::Plane, Plate { corners: corners.clone(), bevel, steel });
        let light = Light::lamps(vec![Lamps::open(studio(Vec3::splat(2.4 / PI)))]);
        let scene = Scene::new(vec![plate], light, Backdrop::Studio);
        Ok(context.look(&scene, context.square(), [eye, eye.with_z(0.0)], field)?.exposed(1.0))
    })?;
    Ok(drawn.fact("plateau", WIDTHS[0]).fact("ridge", WIDTHS[1]))
}

/// A plate of steel on a dark ground.
struct Plate {
    corners: Vec<Vec2>,
    bevel: Bevel,
    steel: CookTorrance<Ggx, SchlickF82>,
}

impl Material for Plate {
    fn bsdf(&self, point: &SurfacePoint, wo: Vec3) -> Bsdf<'_> {
        let frame = point.frame();
        let bsdf = Bsdf::new(frame, wo);
        let edge = Edge::nearest(&self.corners, point.uv).filter(|_| inside(&self.corners, point.uv));
        let Some(edge) = edge else { return bsdf.with_emitted(hex(0x2a_2d33)) };
        let [_, slope] = self.bevel.profile(edge.distance);
        let gradient = surface_gradient(Vec3::Z, [Vec3::X, Vec3::Y], slope * edge.away);
        let normal = bumped_normal(Vec3::Z, gradient);
        bsdf.with([Facet::new(1.0, normal)], [Lobe::from(&self.steel as &dyn Brdf)])
            .with_emitted(0.55 * hex(0xc9_ced6) * sky(reflect(frame.to_local(wo), normal)))
    }
}

/// Tests by the parity of edges to the right of the point.
fn inside(corners: &[Vec2], p: Vec2) -> bool {
    let before = corners.iter().cycle().skip(corners.len() - 1);
    let crosses = |(a, b): &(&Vec2, &Vec2)| {
        (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)
    };
    corners.iter().zip(before).filter(crosses).count() % 2 == 1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inside_a_square() {
        let square = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
        assert!(inside(&square, Vec2::new(0.5, 0.2)));
        assert!(!inside(&square, Vec2::new(1.5, 0.2)) && !inside(&square, Vec2::new(0.5, -0.2)));
    }
}
