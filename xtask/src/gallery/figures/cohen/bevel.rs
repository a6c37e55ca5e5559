//! Bevels along the edges of a plate.

use std::f32::consts::PI;

use asperity_render::{
    geometry::{camera::Camera, shape::Shape},
    image::tone::hex,
    light::lamps::{Lamps, studio},
    materials::sky,
    scene::{Backdrop, Light, Object, Scene},
};
use asperity_shading::bump::{bumped_normal, surface_gradient};
use asperity_shading::reflectance::SchlickF82;
use asperity_shading::texture::{Bevel, Edge};
use asperity_shading::{
    Brdf, CookTorrance, Ggx, SurfacePoint,
    bump::Facet,
    material::Material,
    reflect,
    reflectance::{Bsdf, Lobe},
};
use glam::{Vec2, Vec3};

use crate::{
    failure::Failure,
    gallery::figure::{Context, Drawn, Panel},
};

/// Width of the plateau and of the whole ridge.
const WIDTHS: [f32; 2] = [0.02, 0.13];

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn, Failure> {
    let sampling = context.square();
    let corners: Vec<Vec2> = (0..10)
        .map(|k| {
            let angle = PI * (0.5 + 0.2 * k as f32);
            Vec2::from_angle(angle) * if k % 2 == 0 { 0.95 } else { 0.5 }
        })
        .collect();
    let lamps = studio(Vec3::splat(2.4 / PI));
    let eye = Vec3::new(0.0, 0.06, 6.0);
    let field = 2.0 * (1.0_f32 / 6.0).atan();
    let camera = Camera::new(eye, eye.with_z(0.0), field, sampling.width, sampling.height);
    let mut panels = Vec::new();
    for (stem, label, top, bottom) in [
        ("rolling", "top 0, bottom 1", 0.0, 1.0),
        ("running-out", "top 1, bottom 0", 1.0, 0.0),
        ("chamfer", "top and bottom 1/2", 0.5, 0.5),
        ("groove", "top and bottom \u{2212}1/2", -0.5, -0.5),
    ] {
        let bevel = Bevel::new(WIDTHS[0], WIDTHS[1], top, bottom)?;
        let steel = CookTorrance::new(Ggx::isotropic(0.3)?, SchlickF82::new(0.62, 0.9)?);
        let plate = Plate { corners: corners.clone(), bevel, steel };
        let light = Light::lamps(vec![Lamps::open(lamps.clone())]);
        let scene = Scene::new(vec![Object::new(Shape::Plane, plate)], light, Backdrop::Studio);
        let image = context.draw(&scene, sampling, &camera)?;
        panels.push(Panel::raster(
            stem,
            label,
            format!("A star-shaped plate with bevelled edges, {label}"),
            image.exposed(1.0),
        ));
    }
    Ok(Drawn::new(4, panels).fact("plateau", WIDTHS[0].to_string()).fact("ridge", WIDTHS[1].to_string()))
}

/// A plate of steel on a dark ground.
struct Plate {
    corners: Vec<Vec2>,
    bevel: Bevel,
    steel: CookTorrance<Ggx, SchlickF82>,
}

impl Material for Plate {
    fn bsdf(&self, point: &SurfacePoint, wo: Vec3) -> Bsdf<'_> {
        let bsdf = Bsdf::new(wo);
        let edge = Edge::nearest(&self.corners, point.uv).filter(|_| inside(&self.corners, point.uv));
        let Some(edge) = edge else { return bsdf.with_emitted(hex(0x2a_2d33)) };
        let [_, slope] = self.bevel.profile(edge.distance);
        let gradient = surface_gradient(Vec3::Z, [Vec3::X, Vec3::Y], slope * edge.away);
        let normal = bumped_normal(Vec3::Z, gradient);
        bsdf.with([Facet::new(1.0, normal)], [Lobe::from(&self.steel as &dyn Brdf)])
            .with_emitted(0.55 * hex(0xc9_ced6) * sky(reflect(wo, normal)))
    }
}

/// By the parity of the edges to the right of the point.
fn inside(corners: &[Vec2], p: Vec2) -> bool {
    let before = corners.iter().cycle().skip(corners.len() - 1);
    let crossings = corners
        .iter()
        .zip(before)
        .filter(|(a, b)| (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x));
    crossings.count() % 2 == 1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_are_found_inside_a_square() {
        let square = [Vec2::ZERO, Vec2::X, Vec2::ONE, Vec2::Y];
        assert!(inside(&square, Vec2::new(0.5, 0.2)));
        assert!(!inside(&square, Vec2::new(1.5, 0.2)) && !inside(&square, Vec2::new(0.5, -0.2)));
    }
}
