//! Table L: lookup errors by spacing, chart and interpolation.

use asperity_ndf_sampling::normal_table::{Chart, Spacing, TableLayout};
use asperity_ndf_sampling::{Ggx, Ndf, NormalLut};
use asperity_render::image::tone::ember;
use glam::{Vec2, Vec3};

use crate::figure::{Context, Drawn, Shown};
use asperity::failure::Result;

const SIZE: usize = 256;
/// Error at full brightness, in degrees.
const BRIGHTEST: f32 = 0.1;

const SPACINGS: [(Spacing, &str); 3] = [
    (Spacing::Coordinates, "by z"),
    (Spacing::Warped, "by z, denser in the middle"),
    (Spacing::Quantiles, "by u"),
];
const CHARTS: [(Chart, &str); 3] =
    [(Chart::Stereographic, "stereographic"), (Chart::Projected, "(n_x, n_y)"), (Chart::Slopes, "slopes")];

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn> {
    let ggx = Ggx::new(0.2, 0.4)?;
    let default = NormalLut::standard(&ggx);
    let layout = TableLayout { spacing: Spacing::Quantiles, ..TableLayout::default() };
    let by_u = NormalLut::with_layout(&ggx, SIZE, layout)?;
    let alt = "Errors of a lookup over the square of coordinates.";
    let looks: [([&str; 3], Shown<'_, Vec2, Vec3>); 4] = [
        (["nearest", "by z, nearest", alt], &|z| default.nearest(z).normal),
        (["bilinear", "by z, bilinear", alt], &|z| default.bilinear(z).normal),
        (["u-nearest", "by u, nearest", alt], &|z| by_u.nearest(z).normal),
        (["u-bilinear", "by u, bilinear", alt], &|z| by_u.bilinear(z).normal),
    ];
    let drawn = Drawn::pictures(4, looks, |look_up| {
        let side = context.size as f32;
        context.render(context.square(), |x, y| {
            let z = Vec2::new(x / side * 2.0 - 1.0, 1.0 - y / side * 2.0) * Spacing::RANGE;
            let (found, exact) = (look_up(z), ggx.warp_gaussian(z));
            // The sine of small angles retains the precision that their cosine loses.
            let angle = found.cross(exact).length().min(1.0).asin().to_degrees();
            ember((angle / BRIGHTEST).sqrt())
        })
    })?;
    let mut rows = Vec::new();
    for (spacing, index) in SPACINGS {
        for (chart, entries) in CHARTS {
            let table = NormalLut::with_layout(&ggx, SIZE, TableLayout { spacing, chart })?;
            let accuracy = table.accuracy(&ggx);
            let [nearest, bilinear, half] = [accuracy.nearest, accuracy.bilinear, accuracy.bilinear_half];
            let angles = [nearest.rms, bilinear.rms, bilinear.largest, half.rms, accuracy.largest_step];
            let [a, b, c, d, e] = angles.map(|angle| format!("{:.4}", angle.to_degrees()));
            rows.push([index.to_owned(), entries.to_owned(), a, b, c, d, e]);
        }
    }
    let head = [
        "index",
        "entries",
        "nearest, rms °",
        "bilinear, rms °",
        "largest °",
        "half floats, rms °",
        "between neighbors, °",
    ];
    Ok(drawn
        .fact("density", "GGX 0.2, 0.4")
        .fact("table", format!("{SIZE} × {SIZE}"))
        .fact("picture", format!("±{} deviations, brightest at {BRIGHTEST}°", Spacing::RANGE))
        .table(head, rows))
}
