//! Bevels along the edges of a plate.

use asperity_render::{image::tone::hex, integrator::direct::sky, light::lamps::studio};
use asperity_shading::{
    Bevel, Brdf, CookTorrance, Edge, Frame, Ggx, SchlickF82, bumped_normal, surface_gradient,
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
            let angle = std::f32::consts::PI * (0.5 + 0.2 * k as f32);
            Vec2::from_angle(angle) * if k % 2 == 0 { 0.95 } else { 0.5 }
        })
        .collect();
    let steel = CookTorrance::new(Ggx::isotropic(0.3)?, SchlickF82::new(0.62, 0.9)?);
    let lights = studio(Vec3::splat(2.4));
    let side = sampling.width as f32;
    let mut panels = Vec::new();
    for (stem, label, top, bottom) in [
        ("rolling", "top 0, bottom 1", 0.0, 1.0),
        ("running-out", "top 1, bottom 0", 1.0, 0.0),
        ("chamfer", "top and bottom 1/2", 0.5, 0.5),
        ("groove", "top and bottom \u{2212}1/2", -0.5, -0.5),
    ] {
        let bevel = Bevel::new(WIDTHS[0], WIDTHS[1], top, bottom)?;
        let image = context.render(sampling, |x, y| {
            let p = Vec2::new(2.0 * x / side - 1.0, 1.06 - 2.0 * y / side);
            if !inside(&corners, p) {
                return hex(0x2a_2d33);
            }
            let Some(edge) = Edge::nearest(&corners, p) else { return Vec3::ZERO };
            let [_, slope] = bevel.profile(edge.distance);
            let gradient = surface_gradient(Vec3::Z, [Vec3::X, Vec3::Y], slope * edge.away);
            let normal = bumped_normal(Vec3::Z, gradient);
            let frame = Frame::from_normal_tangent(normal, Vec3::X);
            let wo = frame.to_local(Vec3::new(-0.5 * p.x, -0.5 * p.y, 3.0).normalize());
            let start = 0.55 * hex(0xc9_ced6) * sky(asperity_shading::reflect(frame.to_world(wo), normal));
            lights.iter().fold(start, |sum, light| {
                let wi = frame.to_local(light.direction);
                sum + light.colour * steel.value(wi, wo) * wi.z.max(0.0)
            })
        })?;
        panels.push(Panel::raster(
            stem,
            label,
            &format!("A star-shaped plate with bevelled edges, {label}"),
            image.exposed(1.0),
        ));
    }
    Ok(Drawn::new(4, panels).fact("plateau", WIDTHS[0].to_string()).fact("ridge", WIDTHS[1].to_string()))
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
