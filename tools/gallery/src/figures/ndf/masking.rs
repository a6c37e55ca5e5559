//! Smith masking, and the visible normals from a direction.

use asperity_ndf_sampling::{AshikhminShirley, Beckmann, BlinnPhong, Ggx, Microfacet, StudentT};
use asperity_render::{sampling::low_discrepancy::r2, scenes::peak};
use glam::{Vec2, Vec3};

use crate::figure::{Context, Drawn, Panel};
use crate::panels::disk;
use crate::plot::{Axis, Names, Plot, Stroke};
use asperity::failure::Result;

const ALPHA: f32 = 0.45;
const ANGLES: [f32; 4] = [0.0, 45.0, 70.0, 88.0];
const DOTS: u32 = 400;

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn> {
    let ggx = Ggx::isotropic(ALPHA)?;
    let mut panels = vec![shares()?];
    for angle in ANGLES {
        let (sin, cos) = angle.to_radians().sin_cos();
        let v = Vec3::new(sin, 0.0, cos);
        let dots: Vec<Vec2> = (0..DOTS)
            .map(|k| Vec2::from(r2(k).map(|x| x as f32)))
            .map(|u| ggx.sample_visible(v, u).truncate())
            .collect();
        let seen = |m: Vec3| ggx.visible_pdf(v, m);
        // Over the map, where a direction near the horizon takes less area: D_v/cos θ would be
        // infinite there.
        let peak = peak(seen);
        let radius = 2.2 / (0.43 * context.size as f32);
        let image = disk(context, 1.0, |m| {
            let dot = dots.iter().any(|dot| dot.distance_squared(m.truncate()) < radius * radius);
            let line = (m.dot(v) / sin.max(1e-3)).abs() < 0.006 && angle > 0.0;
            if dot || line { 1.0 } else { 0.7 * seen(m) / peak }
        })?;
        let alt = format!("Visible normals from {angle} degrees, with dots at sampled normals.");
        panels.push(Panel::new(format!("visible-{angle}"), format!("seen from {angle}°"), alt, image));
    }
    Ok(Drawn::new(5, panels).fact("roughness", ALPHA))
}

/// Plots `G₁` against the view angle.
fn shares() -> Result<Panel> {
    let (beckmann, ggx) = (Beckmann::isotropic(ALPHA)?, Ggx::isotropic(ALPHA)?);
    let student = StudentT::new(ALPHA, ALPHA, 1.6)?;
    let phong = BlinnPhong::from_roughness(ALPHA)?;
    let ashikhmin = AshikhminShirley::new(2.0 / (ALPHA * ALPHA) - 2.0, 60.0)?;
    let (x, y) = (Axis::linear("view angle, °", [0.0, 90.0], 30.0), Axis::linear("G₁", [0.0, 1.0], 0.25));
    let mut plot = Plot::new([330.0, 330.0], x, y, Names::Above);
    let curves: [(&str, &dyn Microfacet, Stroke); 5] = [
        ("Student-t 1.6", &student, Stroke::dashed(1)),
        ("GGX", &ggx, Stroke::solid(1).wide(2.0)),
        ("A–S", &ashikhmin, Stroke::dashed(3)),
        ("Blinn–Phong", &phong, Stroke::solid(3)),
        ("Beckmann", &beckmann, Stroke::solid(2).wide(2.0)),
    ];
    for (name, ndf, stroke) in curves {
        let points = (0..=179).map(|k| f64::from(k) * 0.5).map(|degrees| {
            let (sin, cos) = degrees.to_radians().sin_cos();
            [degrees, f64::from(ndf.g1(Vec3::new(sin as f32, 0.0, cos as f32)))]
        });
        plot = plot.curve(name, points, stroke);
    }
    let alt = "The visible fraction of facets against the view angle";
    plot.panel("masking", "G₁ against the view angle", alt)
}
