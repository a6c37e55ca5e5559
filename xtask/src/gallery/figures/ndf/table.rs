//! Table L: what its look-ups lose, by spacing, chart and interpolation.

use asperity_ndf_sampling::normal_table::{Chart, Spacing, TableLayout};
use asperity_ndf_sampling::{Ggx, Ndf, NormalTable};
use asperity_render::integrator::hemisphere::ember;
use glam::{Vec2, Vec3};

use crate::failure::Failure;
use crate::gallery::figure::{Context, Drawn, Panel};

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

/// From coordinates to a normal.
type LookUp<'a> = &'a (dyn Fn(Vec2) -> Vec3 + Sync);

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn, Failure> {
    let ggx = Ggx::new(0.2, 0.4)?;
    let default = NormalTable::standard(&ggx);
    let by_u = NormalTable::with_layout(
        &ggx,
        SIZE,
        TableLayout { spacing: Spacing::Quantiles, ..TableLayout::default() },
    )?;
    let looks: [(&str, &str, LookUp<'_>); 4] = [
        ("nearest", "by z, nearest", &|z| default.nearest(z).normal),
        ("bilinear", "by z, bilinear", &|z| default.bilinear(z).normal),
        ("u-nearest", "by u, nearest", &|z| by_u.nearest(z).normal),
        ("u-bilinear", "by u, bilinear", &|z| by_u.bilinear(z).normal),
    ];
    let mut panels = Vec::new();
    for (stem, label, look_up) in looks {
        let side = context.size as f32;
        let image = context.render(context.square(), |x, y| {
            let z = Vec2::new(x / side * 2.0 - 1.0, 1.0 - y / side * 2.0) * Spacing::RANGE;
            let (found, exact) = (look_up(z), ggx.from_gaussian(z));
            // The sine of small angles keeps what their cosine has lost.
            let angle = found.cross(exact).length().min(1.0).asin().to_degrees();
            ember((angle / BRIGHTEST).sqrt())
        })?;
        panels.push(Panel::raster(stem, label, "Errors of a look-up over the square of coordinates.", image));
    }
    let mut rows = Vec::new();
    for (spacing, index) in SPACINGS {
        for (chart, entries) in CHARTS {
            let table = NormalTable::with_layout(&ggx, SIZE, TableLayout { spacing, chart })?;
            let accuracy = table.accuracy(&ggx);
            let angles = [
                accuracy.nearest.rms,
                accuracy.bilinear.rms,
                accuracy.bilinear.largest,
                accuracy.bilinear_half.rms,
                accuracy.largest_step,
            ];
            let mut row = vec![index.to_owned(), entries.to_owned()];
            row.extend(angles.map(|angle| format!("{:.4}", angle.to_degrees())));
            rows.push(row);
        }
    }
    let head = [
        "index",
        "entries",
        "nearest, rms \u{b0}",
        "bilinear, rms \u{b0}",
        "largest \u{b0}",
        "half floats, rms \u{b0}",
        "between neighbours, \u{b0}",
    ];
    let picture = format!("\u{b1}{} deviations, brightest at {BRIGHTEST}\u{b0}", Spacing::RANGE);
    Ok(Drawn::new(4, panels)
        .fact("density", "GGX 0.2, 0.4")
        .fact("table", format!("{SIZE} \u{d7} {SIZE}"))
        .fact("picture", picture)
        .table(head, rows))
}
