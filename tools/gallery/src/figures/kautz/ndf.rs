//! A density displayed as a map, as a relief over the map, and as a lobe.

use std::f32::consts::FRAC_PI_2;

use asperity_ndf_sampling::{Ggx, Ndf};
use asperity_render::geometry::mesh::{Mesh, TracedMesh};
use asperity_render::geometry::{relief::relief, shape::Shape};
use asperity_render::image::{Image, tone::ember, tone::hex};
use asperity_render::light::lamps::{Lamps, direction};
use asperity_render::materials::{SharedNdf, chalk};
use asperity_render::scene::{Backdrop, Light, Object, Scene};
use asperity_render::scenes::peak;
use asperity_shading::SurfacePoint;
use glam::Vec3;

use crate::figure::{Context, Drawn, Panel};
use crate::figures::kautz::objects::ggx;
use crate::panels::density_panel;
use asperity::failure::Result;

const ALPHA: [f32; 2] = [0.25, 0.5];

/// Height of the relief's peak over the unit disk.
const HEIGHT: f32 = 1.15;

/// Length of the lobe at the peak.
const LENGTH: f32 = 1.7;

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn> {
    let ndf = Ggx::new(ALPHA[0], ALPHA[1])?;
    let top = peak(|m| ndf.d(m));
    let share = |x: f32, y: f32| {
        // At the horizon a density is 0 by definition. The rim shows its limit.
        let z = (1.0 - x * x - y * y).max(1e-6).sqrt();
        ndf.d(Vec3::new(x, y, z)) / top
    };
    let hill = relief(|t, phi| {
        // Denser rings near the peak, where the relief is steep. The last rings are the wall below
        // its rim, because a GGX has some facets that face the horizon.
        let t = t / 0.98;
        let r = (t * (0.4 + 0.6 * t)).min(1.0);
        let (x, y) = (r * phi.cos(), r * phi.sin());
        let wall = ((1.02 - t) / 0.02).clamp(0.0, 1.0);
        Vec3::new(x, y, HEIGHT * share(x, y) * wall)
    });
    let view = [Vec3::new(3.3, -4.1, 3.0), Vec3::new(0.0, 0.0, 0.36)];
    let alt = "A steep elongated ridge over a round map.";
    let panels = vec![
        density_panel(context, &ndf, "density", "GGX 0.25, 0.5")?,
        Panel::new("relief", "as a relief", alt, picture(context, hill, view, |p| p.z / HEIGHT)?),
        lobe_panel(context, &ndf, "A flattened upright lobe above a disk.")?,
    ];
    Ok(Drawn::new(3, panels).fact("density", ggx(ALPHA)))
}

/// Displays the density as a lobe: the distance from the center in each direction is the density.
pub(crate) fn lobe_panel(context: &Context<'_>, ndf: &SharedNdf, alt: &str) -> Result<Panel> {
    let top = peak(|m| ndf.d(m));
    let lobe = relief(|t, phi| {
        let (sin, cos) = (t * FRAC_PI_2).sin_cos();
        let m = Vec3::new(sin * phi.cos(), sin * phi.sin(), cos);
        let share = ndf.d(m) / top;
        // Thousands of invisibly small triangles at one point would take the hierarchy half a
        // minute.
        m * if share < 1e-3 { 0.0 } else { LENGTH * share }
    });
    let view = [Vec3::new(3.9, -4.6, 2.1), Vec3::new(0.0, 0.0, 0.72)];
    Ok(Panel::new("lobe", "as a lobe", alt, picture(context, lobe, view, |p| p.length() / LENGTH)?))
}

/// Renders a surface over the unit disk, colored by density relative to its peak.
fn picture(
    context: &Context<'_>,
    mesh: Mesh,
    view: [Vec3; 2],
    value: impl Fn(Vec3) -> f32 + Sync,
) -> Result<Image> {
    let shape = Shape::MeshOnDisk(TracedMesh::new(mesh));
    let finish = |point: &SurfacePoint, wo: Vec3| {
        let (p, normal) = (point.position, point.normal);
        let color = if p.z <= 0.0 { ground(p) } else { shade(value(p), normal) };
        chalk(point.frame(), wo, Vec3::Z, color, color * (0.42 * (0.5 + 0.5 * normal.z)))
    };
    let lamps = vec![Lamps::one(direction(-122.0, 48.0), Vec3::splat(0.95))];
    let mut scene = Scene::new(vec![Object::shaded(shape, finish)], Light::lamps(lamps), Backdrop::Studio);
    // The rim and its wall, a cell apart, would shadow themselves.
    scene.start = 4e-3;
    Ok(context.look(&scene, context.sampling([12, 12], 4), view, 0.39)?.exposed(1.0))
}

/// Returns the color of a density with contour lines of constant width on the surface.
fn shade(value: f32, normal: Vec3) -> Vec3 {
    let base = ember(value.max(0.0).sqrt());
    let steep = (1.0 - normal.z * normal.z).sqrt().max(0.05);
    let off = (value * 10.0 - (value * 10.0).round()).abs() * 0.1 / steep;
    if off < 0.0035 && value > 0.07 { base * 0.42 } else { base }
}

/// The disk of normals with circles every 30° of tilt and its two axes.
fn ground(p: Vec3) -> Vec3 {
    let r = p.x.hypot(p.y);
    let circle = [0.5, 0.75_f32.sqrt(), 0.992].iter().any(|c| (r - c).abs() < 0.005);
    let axis = p.x.abs().min(p.y.abs()) < 0.004;
    if circle || axis { hex(0x8b_8d96) } else { hex(0x4a_4c54) }
}
