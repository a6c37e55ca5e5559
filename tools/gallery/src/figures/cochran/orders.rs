//! Traversal order of child boxes by ray direction: figure 5 of Cochran, Lewis and Hart.

use crate::figure::{Context, Drawn, Panel};
use crate::plot::{Axis, HPos, Ink, Names, Plot, Stroke};
use asperity::failure::Result;

/// Knots of f along x and of g along y: three maps by two, six children.
const KNOTS: ([f64; 4], [f64; 3]) = ([0.0, 0.8, 1.9, 3.0], [0.0, 1.2, 2.0]);

/// Signs of the directions, each with a line in that direction through the center of a box.
const CASES: [(&str, [f64; 2]); 4] =
    [("+x, +y", [1.0, 0.55]), ("+x, −y", [1.0, -0.55]), ("−x, +y", [-1.0, 0.55]), ("−x, −y", [-1.0, -0.55])];

const SIZE: [f64; 2] = [300.0, 220.0];

/// Returns the indices of every child in traversal order: column by column along the ray, and along
/// the ray within each column.
fn ordered([dx, dy]: [f64; 2]) -> Vec<[usize; 2]> {
    let along = |step: f64, count: usize| (0..count).map(move |k| if step < 0.0 { count - 1 - k } else { k });
    let (columns, rows) = (KNOTS.0.len() - 1, KNOTS.1.len() - 1);
    along(dx, columns).flat_map(|i| along(dy, rows).map(move |j| [i, j])).collect()
}

/// Returns the parameter interval of a line over a child; empty if the second number does not
/// exceed the first.
fn within([i, j]: [usize; 2], from: [f64; 2], direction: [f64; 2]) -> [f64; 2] {
    let sides = [[KNOTS.0[i], KNOTS.0[i + 1]], [KNOTS.1[j], KNOTS.1[j + 1]]];
    (0..2).fold([f64::NEG_INFINITY, f64::INFINITY], |[near, far], axis| {
        let [a, b] = sides[axis].map(|side| (side - from[axis]) / direction[axis]);
        [near.max(a.min(b)), far.min(a.max(b))]
    })
}

pub(crate) fn draw(_: &Context<'_>) -> Result<Drawn> {
    let panels = CASES.map(|(name, direction)| case(name, direction)).into_iter().collect::<Result<_>>()?;
    let knots = |knots: &[f64]| knots.iter().map(f64::to_string).collect::<Vec<_>>().join(", ");
    Ok(Drawn::new(4, panels).fact("knots of f", knots(&KNOTS.0)).fact("knots of g", knots(&KNOTS.1)))
}

fn case(name: &str, direction: [f64; 2]) -> Result<Panel> {
    let from = [1.5, 1.0];
    let along = |t: f64| [from[0] + t * direction[0], from[1] + t * direction[1]];
    let axis = |range| Axis::linear("", range, 1.0).with_ticks(&[]);
    let mut plot = Plot::new(SIZE, axis([-0.25, 3.25]), axis([-0.25, 2.25]), Names::Hidden);
    let order = ordered(direction);
    for (k, &[i, j]) in order.iter().enumerate() {
        let ([x0, x1], [y0, y1]) = ([KNOTS.0[i], KNOTS.0[i + 1]], [KNOTS.1[j], KNOTS.1[j + 1]]);
        let [near, far] = within([i, j], from, direction);
        // Boxes under the ray, darker in traversal order.
        let fill = if near < far { 0.12 + 0.06 * k as f64 } else { 0.0 };
        // In the corner that the ray misses.
        let share = if direction[0] * direction[1] > 0.0 { 0.82 } else { 0.18 };
        let corner = [x0, y0 + share * (y1 - y0)];
        plot = plot.frame([x0, x1], [y0, y1], 1, fill, 1.0).words(HPos::Right, corner, (k + 1).to_string());
    }
    let [start, tip] = [-1.62, 1.62].map(along);
    let [dx, dy] = direction.map(|d| 0.11 * d);
    let barbs = [[-dx - 0.5 * dy, -dy + 0.5 * dx], [-dx + 0.5 * dy, -dy - 0.5 * dx]];
    let head = barbs.map(|[x, y]| [tip[0] + x, tip[1] + y]);
    let alt = format!("Six boxes from above, numbered in the traversal order of a ray toward {name}");
    plot.line([start, tip], Stroke::solid(2).wide(1.5))
        .line([head[0], tip, head[1]], Stroke::solid(2).wide(1.5))
        .dots([start], Ink::Series(2), 2.6)
        .panel(format!("case-{}", name.replace(", ", "").replace('−', "m").replace('+', "p")), name, alt)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn order_never_puts_a_hidden_child_first() {
        for (name, [sx, sy]) in CASES {
            let order = ordered([sx, sy]);
            for k in 0..400 {
                let slope = f64::from(k % 20 + 1) / 7.0;
                let from = [f64::from(k / 20) * 0.15, 1.07];
                let direction = [sx.signum(), slope * sy.signum()];
                let met: Vec<f64> = order
                    .iter()
                    .map(|&child| within(child, from, direction))
                    .filter(|[near, far]| near < far)
                    .map(|[near, _]| near)
                    .collect();
                assert!(!met.is_empty() && met.is_sorted(), "{name}, slope {slope} from {from:?}: {met:?}");
            }
        }
    }
}
