//! Brackets of the extrema of a surface, by branch and bound.

use asperity_core::Interval;
use glam::DVec2;

use crate::surface::bounds::Surface;

/// Brackets of the two extrema of a surface over a rectangle, and their positions.
#[derive(Clone, Copy, Debug, PartialEq)]
#[must_use]
pub struct SurfaceExtrema {
    /// Contains the minimum height.
    pub minimum: Interval,
    /// Contains the maximum height.
    pub maximum: Interval,
    /// A point whose height lies in `minimum`.
    pub lowest: DVec2,
    /// A point whose height lies in `maximum`.
    pub highest: DVec2,
}

/// Maximum number of rectangles that a search for an extremum visits.
const BUDGET: u32 = 1 << 16;

/// Maximum number of times that a search splits a rectangle.
const DEPTH: usize = 64;

/// Brackets at most `width` wide, if the budget permits.
pub(crate) fn extrema<S: Surface>(surface: &S, rectangle: [Interval; 2], width: f64) -> SurfaceExtrema {
    let (maximum, highest) = largest(surface, rectangle, width, 1.0);
    let (minimum, lowest) = largest(surface, rectangle, width, -1.0);
    SurfaceExtrema { minimum: Interval::new(-minimum.hi, -minimum.lo), maximum, lowest, highest }
}

/// A bracket of the maximum of `sign · f`, and the position of its lower end.
fn largest<S: Surface>(surface: &S, rectangle: [Interval; 2], width: f64, sign: f64) -> (Interval, DVec2) {
    let upper = |[x, y]: [Interval; 2]| {
        let range = surface.bounds(x, y).height;
        if sign < 0.0 { -range.lo } else { range.hi }
    };
    let (mut best, mut highest) = (Interval::new(f64::NEG_INFINITY, f64::NEG_INFINITY), DVec2::ZERO);
    let top = search(rectangle, DEPTH, upper, |[x, y]| {
        let middle = DVec2::new(x.middle(), y.middle());
        let center = surface.evaluate(middle.x, middle.y, 0.0).interval().scaled(sign);
        if center.lo > best.lo {
            (best, highest) = (center, middle);
        }
        best.lo + width
    });
    (Interval::new(best.lo, best.hi.max(top)), highest)
}

/// The maximum of `upper` over the squares after dividing into quarters `depth` times.
///
/// The bound of a square is at most the bound of the larger square around it. If the budget ends
/// before, larger squares are used.
pub(crate) fn ceiling(rectangle: [Interval; 2], depth: u32, upper: impl Fn([Interval; 2]) -> f64) -> f64 {
    search(rectangle, depth.min(24) as usize, upper, |_| f64::NEG_INFINITY)
}

/// Divides a rectangle into quarters, those with the largest bounds first; returns the maximum
/// bound.
///
/// Quarters are divided at most `depth` times, and only if their bound exceeds `enough` of the
/// part.
fn search(
    rectangle: [Interval; 2],
    depth: usize,
    upper: impl Fn([Interval; 2]) -> f64,
    mut enough: impl FnMut([Interval; 2]) -> f64,
) -> f64 {
    let mut stack = [(rectangle, f64::INFINITY, 0); 3 * DEPTH + 4];
    let (mut filled, mut visited, mut top) = (1, 0, f64::NEG_INFINITY);
    while let Some(&(part, bound, level)) = stack.get(..filled).and_then(<[_]>::last) {
        filled -= 1;
        if bound <= top {
            continue;
        }
        visited += 1;
        if bound <= enough(part) || visited > BUDGET || level >= depth {
            top = bound;
            continue;
        }
        let mut parts = quarters(part).map(|part| (part, upper(part).min(bound), level + 1));
        parts.sort_unstable_by(|a, b| a.1.total_cmp(&b.1));
        for part in parts {
            if let Some(place) = stack.get_mut(filled) {
                *place = part;
                filled += 1;
            }
        }
    }
    top
}

fn quarters([x, y]: [Interval; 2]) -> [[Interval; 2]; 4] {
    let split = |range: Interval| {
        let middle = range.middle();
        [Interval::new(range.lo, middle), Interval::new(middle, range.hi)]
    };
    let ([west, east], [south, north]) = (split(x), split(y));
    [[west, south], [east, south], [west, north], [east, north]]
}
