//! The rectangle folded by zig-zags along both axes, with its nodes.

use alloc::vec::Vec;
use asperity_core::Interval;

use crate::numeric::polynomial::UNIT;
use crate::surface::hermite_patch::{Corner, Magnitudes, Patch};
use crate::surface::self_affine::error::magnitudes;
use crate::surface::self_affine::limits::Limits;
use crate::surface::self_affine::self_affine::Part;
use crate::system::error::FifError;

/// A rectangle folded by zig-zags, affine from every cell of a grid onto the whole.
///
/// They alternately increase and decrease.
#[derive(Clone, Debug)]
pub struct ZigZag {
    pub(crate) nodes: Vec<Node>,
    pub(crate) cells: [usize; 2],
    pub(crate) domain: [Interval; 2],
}

/// A node: its position, its data and the data of the repeated part.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Node {
    /// In units of the domain.
    pub(crate) at: [f64; 2],
    /// `z` and `d` as given.
    pub(crate) data: Corner,
    /// `H − G` and its slopes per width of the domain.
    pub(crate) own: Corner,
}

/// A grid with its nodes, and the data for the constructors of surfaces.
pub(crate) struct Grid {
    pub(crate) fold: ZigZag,
    /// Widths of the narrowest and the widest cell along either axis, in units of the domain.
    pub(crate) narrowest: f64,
    pub(crate) widest: f64,
    /// The maximum magnitudes of heights and of both slopes.
    pub(crate) magnitudes: [f64; 3],
}

/// A cell of one axis, and a position in it.
#[derive(Clone, Copy)]
pub(crate) struct Strip {
    pub(crate) index: usize,
    /// In units of the domain.
    pub(crate) width: f64,
    /// In units of the cell.
    pub(crate) u: f64,
}

impl Strip {
    /// Image of the position under Φ.
    #[inline]
    pub(crate) fn folded(self) -> f64 {
        if self.index.is_multiple_of(2) { self.u } else { 1.0 - self.u }
    }

    /// The slope of Φ, or of the zig-zag along this axis.
    #[inline]
    pub(crate) fn slope(self) -> f64 {
        if self.index.is_multiple_of(2) { 1.0 / self.width } else { -1.0 / self.width }
    }
}

impl ZigZag {
    /// Creates the grid of knots `x` and `y` with heights `z` and gradients `d` at its nodes, row
    /// by row.
    pub(crate) fn through(x: &[f64], y: &[f64], z: &[f64], d: &[[f64; 2]]) -> Result<Grid, FifError> {
        let along = [knots("x", x)?, knots("y", y)?];
        let magnitudes = magnitudes(x.len().saturating_mul(y.len()), y.len(), z, d)?;
        let domain = along.map(|axis| axis.domain);
        let corner = |i: usize, j: usize| {
            z.get(i * (x.len() - 1) * y.len() + j * (y.len() - 1)).copied().unwrap_or(0.0)
        };
        let corners = [[corner(0, 0), corner(0, 1)], [corner(1, 0), corner(1, 1)]];
        let node = |(index, (&z, &[z_x, z_y])): (usize, (&f64, &[f64; 2]))| {
            let (i, j) = (index / y.len(), index % y.len());
            let knot = |along: &[f64], k: usize| along.get(k).copied().unwrap_or(0.0);
            let at = [part_of(domain[0], knot(x, i)), part_of(domain[1], knot(y, j))];
            let [base, base_x, base_y] = bilinear(&corners, at);
            let (ends_x, ends_y) = (i == 0 || i + 1 == x.len(), j == 0 || j + 1 == y.len());
            let own = [
                if ends_x && ends_y { 0.0 } else { z - base },
                if ends_x { 0.0 } else { z_x * domain[0].width() - base_x },
                if ends_y { 0.0 } else { z_y * domain[1].width() - base_y },
            ];
            Node { at, data: [z, z_x, z_y], own }
        };
        let nodes = z.iter().zip(d).enumerate().map(node).collect();
        Ok(Grid {
            fold: Self { nodes, cells: [x.len() - 1, y.len() - 1], domain },
            narrowest: along[0].narrowest.min(along[1].narrowest),
            widest: along[0].widest.max(along[1].widest),
            magnitudes,
        })
    }

    /// Knot `index` of an axis, in units of the domain.
    #[inline]
    fn knot(&self, axis: usize, index: usize) -> f64 {
        let number = if axis == 0 { index * (self.cells[1] + 1) } else { index };
        self.nodes.get(number).map_or(0.0, |node| if axis == 0 { node.at[0] } else { node.at[1] })
    }

    /// A whole cell of an axis.
    pub(crate) fn strip_of(&self, axis: usize, index: usize) -> Strip {
        Strip { index, width: self.knot(axis, index + 1) - self.knot(axis, index), u: 0.0 }
    }

    /// The cell of an axis that contains a position, in units of the domain.
    #[inline]
    pub(crate) fn strip(&self, axis: usize, place: f64) -> Strip {
        let count = if axis == 0 { self.cells[0] } else { self.cells[1] };
        let mut index = ((place * count as f64) as usize).min(count - 1);
        while index > 0 && place < self.knot(axis, index) {
            index -= 1;
        }
        while index + 1 < count && place >= self.knot(axis, index + 1) {
            index += 1;
        }
        let left = self.knot(axis, index);
        let width = self.knot(axis, index + 1) - left;
        let u = (place - left) / width;
        Strip { index, width, u: if u > 1.0 { 1.0 } else { u } }
    }

    /// The patch of a function over a cell, with slopes per width of the cell.
    #[inline]
    pub(crate) fn patch(&self, [x, y]: [Strip; 2], part: Part) -> Patch {
        let corner = |i: usize, j: usize| {
            let node = self.node([i, j]);
            let ([z, z_x, z_y], scale) = match part {
                Part::Data => (node.data, self.domain.map(Interval::width)),
                Part::Own => (node.own, [1.0; 2]),
            };
            [z, z_x * (x.width * scale[0]), z_y * (y.width * scale[1])]
        };
        let ([i, j], [next_i, next_j]) = ([x.index, y.index], [x.index + 1, y.index + 1]);
        Patch([[corner(i, j), corner(i, next_j)], [corner(next_i, j), corner(next_i, next_j)]])
    }

    /// The node of an index pair.
    #[inline]
    pub(crate) fn node(&self, [i, j]: [usize; 2]) -> Node {
        const NONE: Node = Node { at: [0.0; 2], data: [0.0; 3], own: [0.0; 3] };
        self.nodes.get(i * (self.cells[1] + 1) + j).copied().unwrap_or(NONE)
    }
}

/// A position in units of the domain, clamped to it; NaN for NaN.
#[inline]
pub(crate) fn part_of(domain: Interval, x: f64) -> f64 {
    let x = if x < domain.lo { domain.lo } else { x };
    let x = if x > domain.hi { domain.hi } else { x };
    (x - domain.lo) / (domain.hi - domain.lo)
}

/// Spacing of the knots of an axis; widths in units of the domain.
#[derive(Clone, Copy)]
struct Spacing {
    domain: Interval,
    /// The narrowest cell.
    cell: usize,
    narrowest: f64,
    widest: f64,
}

fn knots(parameter: &'static str, at: &[f64]) -> Result<Spacing, FifError> {
    let (&[first, ..], &[.., last]) = (at, at) else {
        return Err(FifError::TooFew { parameter, min: 3, got: at.len() });
    };
    if at.len() < 3 {
        return Err(FifError::TooFew { parameter, min: 3, got: at.len() });
    }
    let not_increasing = |knot, value| Err(FifError::NotIncreasing { parameter, index: knot, value });
    if !first.is_finite() {
        return not_increasing(0, first);
    }
    let domain = Interval::new(first, last);
    let mut spacing = Spacing { domain, cell: 0, narrowest: f64::INFINITY, widest: 0.0 };
    for (cell, pair) in at.windows(2).enumerate() {
        let &[left, right] = pair else { continue };
        if !(right.is_finite() && right > left) {
            return not_increasing(cell + 1, right);
        }
    }
    for (cell, pair) in at.windows(2).enumerate() {
        let &[left, right] = pair else { continue };
        let width = part_of(domain, right) - part_of(domain, left);
        // Far more than the rounding of positions in units of the domain.
        if width.is_nan() || width < 1e-9 {
            return not_increasing(cell + 1, right);
        }
        if width < spacing.narrowest {
            (spacing.narrowest, spacing.cell) = (width, cell);
        }
        spacing.widest = spacing.widest.max(width);
    }
    Ok(spacing)
}

/// The bilinear function through the corners of the unit square, and its slopes.
pub(crate) fn bilinear(corners: &[[f64; 2]; 2], [t, u]: [f64; 2]) -> Corner {
    let [[a, b], [c, d]] = *corners;
    let (s, v) = (1.0 - t, 1.0 - u);
    [s * (v * a + u * b) + t * (v * c + u * d), v * (c - a) + u * (d - b), s * (b - a) + t * (d - c)]
}

/// The limits of a folded surface whose narrowest and widest cells have these relative widths.
pub(crate) fn limits(fold: &ZigZag, factor: f64, [narrowest, widest]: [f64; 2], contraction: f64) -> Limits {
    const SWEEPS: u32 = 64;
    let up = 1.0 + 64.0 * UNIT;
    let stretch = up / narrowest;
    let mut limits = Limits {
        stretch,
        contraction,
        gain: [up / (1.0 - factor.abs()), up / (1.0 - contraction)],
        shift: shift(widest),
        ..Limits::EMPTY
    };
    let [[h, h_x, h_y], [e, e_x, e_y]] = patches(fold, &mut limits);
    let reach = e.magnitude() * limits.gain[0] * up;
    limits.own = Interval::new(-reach, reach);
    for _ in 0..SWEEPS {
        limits.own = limits.own.intersection(e.sum(limits.own.scaled(factor)));
    }
    limits.own_slopes = [e_x, e_y].map(|range| {
        let most = range.magnitude() * limits.gain[1] * up;
        Interval::new(-most, most)
    });
    limits.range = h.sum(limits.own.scaled(factor));
    limits.slopes = [0, 1].map(|k| [h_x, h_y][k].sum(limits.own_slopes[k].scaled(contraction)));
    limits.steepest = steepest(&limits);
    limits
}

/// The precision of an orbit, in units of the domain, for this relative width of the widest cell.
///
/// The computed orbit is exact for a point within this distance.
pub(crate) fn shift(widest: f64) -> f64 {
    // 16 roundings per step; going back along the orbit, the relative width of a cell makes them
    // smaller.
    16.0 * UNIT * (1.0 + (1.0 + 64.0 * UNIT) / (1.0 - widest))
}

/// Ranges of values and slopes of the patches of both functions, which are added to the limits with
/// their noise.
pub(crate) fn patches(fold: &ZigZag, limits: &mut Limits) -> [[Interval; 3]; 2] {
    let mut ranges = [[Interval::EMPTY; 3]; 2];
    let [m, n] = fold.cells;
    for (i, j) in (0..m).flat_map(|i| (0..n).map(move |j| (i, j))) {
        let strips = [fold.strip_of(0, i), fold.strip_of(1, j)];
        let width = strips[0].width.min(strips[1].width);
        for (all, part) in ranges.iter_mut().zip([Part::Data, Part::Own]) {
            let patch = fold.patch(strips, part);
            let [value, along_x, along_y] = patch.ranges([0.0, 1.0], [0.0, 1.0]);
            let scaled = |range: Interval, k: usize| range.scaled(1.0 / strips[k].width).inflated(0.0);
            let here = [value, scaled(along_x, 0), scaled(along_y, 1)];
            *all = [0, 1, 2].map(|k| all[k].hull(here[k]));
            add(limits, &patch, width);
        }
    }
    let [noise, noise_slope] = limits.noise;
    let ranges =
        ranges.map(|[value, x, y]| [value.inflated(noise), x.inflated(noise_slope), y.inflated(noise_slope)]);
    let most = |k: usize| ranges[0][k].magnitude().max(ranges[1][k].magnitude());
    limits.patch = [most(0), most(1).max(most(2))];
    ranges
}

/// The maximum slope of f along either axis.
pub(crate) fn steepest(limits: &Limits) -> f64 {
    limits.slopes[0].magnitude().max(limits.slopes[1].magnitude())
}

/// Includes a patch over a cell whose narrower side is `width`.
fn add(limits: &mut Limits, patch: &Patch, width: f64) {
    let mut corner = [0.0_f64; 3];
    for data in patch.0.iter().flatten() {
        corner = [0, 1, 2].map(|k| corner[k].max(data[k].abs()));
    }
    let magnitudes = Magnitudes::new(corner);
    // Corners are differences of the data and a bilinear function: 12 roundings of twice as much.
    let value = UNIT * ((Patch::ROUNDINGS + 24.0) * magnitudes.value + 2.0 * magnitudes.slope);
    let slope = UNIT / width * ((Patch::ROUNDINGS + 24.0) * magnitudes.slope + 2.0 * magnitudes.second);
    limits.noise = [limits.noise[0].max(value), limits.noise[1].max(slope)];
    limits.bend = limits.bend.max(2.0 * magnitudes.second / (width * width));
}

/// Rounding of a value after `steps` terms: of the patches, of powers of s, of partial sums, and of
/// the orbit.
pub(crate) fn value_rounding(limits: &Limits, steps: u32) -> f64 {
    let steps = f64::from(steps);
    let weight = if steps < limits.gain[0] { steps + 1.0 } else { limits.gain[0] + 1.0 };
    let scale = limits.range.magnitude() + limits.patch[0];
    let moved = 2.0 * limits.shift * (limits.steepest + weight * limits.patch[1]);
    1.01 * (weight * limits.noise[0]
        + UNIT * (2.0 * (steps + 2.0) * scale + 2.0 * weight * (weight * limits.patch[0] + scale))
        + moved)
}

/// Rounding of a slope after `steps` terms, including widths of cells.
///
/// It excludes the change of the gradient over the rounding of the point.
pub(crate) fn slope_rounding(limits: &Limits, steps: u32) -> f64 {
    let steps = f64::from(steps);
    let weight = if steps < limits.gain[1] { steps + 1.0 } else { limits.gain[1] + 1.0 };
    let [_, patch] = limits.patch;
    let scale = limits.steepest + patch;
    1.01 * (weight * (limits.noise[1] + limits.bend * 2.0 * limits.shift)
        + UNIT
            * (2.0 * (steps + 2.0) * scale
                + (4.0 + 16.0 * limits.stretch) * weight * (weight * patch + scale)))
}
