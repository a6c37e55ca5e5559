//! Cellular noise in three metrics: the distance to the nearest feature point, to the borders
//! between regions, and the regions.

use asperity_noise::{Cellular, CellularOutput, Field, Metric};
use glam::Vec2;

use crate::figure::{Context, Drawn, Panel};
use crate::figures::noise::plane::{Window, gray};
use asperity::failure::Result;

/// Cells along a side of each image.
const CELLS: f32 = 8.0;

const PANELS: [(CellularOutput, Metric, [f32; 2], [&str; 3]); 6] = [
    (
        CellularOutput::F1,
        Metric::Euclidean,
        [0.0, 1.0],
        ["f1", "F₁", "Dark round spots with a bright crease halfway between neighbors."],
    ),
    (
        CellularOutput::F2,
        Metric::Euclidean,
        [0.0, 1.3],
        ["f2", "F₂", "Dark spots joined by dark bridges, bright creases between."],
    ),
    (
        CellularOutput::F2MinusF1,
        Metric::Euclidean,
        [0.0, 0.8],
        ["f2-f1", "F₂ − F₁", "Bright irregular polygons separated by thin black lines."],
    ),
    (
        CellularOutput::Cell,
        Metric::Euclidean,
        [-1.0, 1.0],
        ["cell", "cell", "Irregular polygons, each a uniform gray."],
    ),
    (
        CellularOutput::F2MinusF1,
        Metric::Manhattan,
        [0.0, 0.9],
        [
            "manhattan",
            "F₂ − F₁, Manhattan",
            "Regions with borders along axes and diagonals, like tangled streets.",
        ],
    ),
    (
        CellularOutput::F1,
        Metric::Chebyshev,
        [0.0, 0.9],
        ["chebyshev", "F₁, Chebyshev", "Dark intersecting square pyramids."],
    ),
];

pub(crate) fn draw(context: &Context<'_>) -> Result<Drawn> {
    let panel = |(basis, metric, [black, white], words): (CellularOutput, Metric, [f32; 2], [&str; 3])| {
        let noise = Cellular::new(context.seed).with_output(basis).with_metric(metric);
        let shade = |p: Vec2| gray((noise.value(p) - black) / (white - black));
        Window::new(context, CELLS).draw(context, words, shade)
    };
    let panels: Vec<Panel> = PANELS.into_iter().map(panel).collect::<Result<_>>()?;
    Ok(Drawn::new(3, panels).fact("image", format!("{CELLS} × {CELLS} cells, jitter 1")))
}
