//! Conditional densities: the unresolved part of a density within a pixel, by resolved fraction.

use asperity_ndf_sampling::{Ggx, residual_ndf};
use asperity_render::{materials::SharedNdf, scenes::peak};
use glam::{Vec2, Vec3};

use crate::figure::{Context, Drawn, Panel};
use crate::panels::disk;
use asperity::failure::Result;
use asperity::input::density::painted;

const SHARES: [f32; 5] = [0.0, 0.25, 0.5, 0.75, 0.95];
/// The resolved facet.
const FACET: Vec2 = Vec2::new(-0.9, 0.7);

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn> {
    let (ggx, painted) = (Ggx::new(0.25, 0.5)?, painted()?);
    let subjects: [(&str, &str, &SharedNdf); 2] =
        [("ggx", "GGX 0.25, 0.5", &ggx), ("painted", "painted", &painted)];
    let h = Vec3::new(0.15, -0.2, 0.968).normalize();
    let mut panels = Vec::new();
    let mut rows = Vec::new();
    for (stem, name, ndf) in subjects {
        let mut row = vec![name.to_owned()];
        for s in SHARES {
            let seen = |m: Vec3| residual_ndf(ndf, m, FACET, s);
            let label = format!("{name}, s = {s}");
            let alt = format!("The density {name} given a facet, with {s} of the variance resolved.");
            let image = disk(context, peak(seen), seen)?;
            panels.push(Panel::new(format!("{stem}-{s}"), label, alt, image));
            row.push(format!("{:.5}", mean(ndf, h, s)));
        }
        row.push(format!("{:.5}", ndf.d(h)));
        rows.push(row);
    }
    let shares = SHARES.map(|s| format!("s = {s}"));
    let head = ["mean over the surface".to_owned()].into_iter().chain(shares).chain(["D(h)".to_owned()]);
    Ok(Drawn::new(5, panels)
        .fact("facet", format!("z = ({}, {})", FACET.x, FACET.y).replace('-', "\u{2212}"))
        .fact("half-vector of the table", "(0.15, −0.2, 0.968)")
        .table(head, rows))
}

/// Computes `∫∫ p_s(h | z_b) N(z_b) dz_b` by the trapezoidal rule, with an error far below the
/// digits shown.
fn mean(ndf: &SharedNdf, h: Vec3, s: f32) -> f64 {
    const REACH: f64 = 7.0;
    const POINTS: i32 = 420;
    let step = 2.0 * REACH / f64::from(POINTS);
    let gaussian = |z: f64| (-0.5 * z * z).exp() / std::f64::consts::TAU.sqrt();
    let places = || (0..=POINTS).map(|k| f64::from(k) * step - REACH);
    let row = |x: f64| {
        let seen = move |y: f64| f64::from(residual_ndf(ndf, h, Vec2::new(x as f32, y as f32), s));
        places().map(move |y| seen(y) * gaussian(x) * gaussian(y))
    };
    places().flat_map(row).sum::<f64>() * step * step
}
