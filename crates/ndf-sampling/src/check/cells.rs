//! Cells of the hemisphere that hold equally many samples, and integrals over them.

use alloc::vec;
use alloc::vec::Vec;
use core::f64::consts::PI;

use glam::Vec3;

use crate::math;

/// Halvings of the hemisphere: 2⁸ cells.
const HALVINGS: usize = 8;

/// The lowest coordinate of a tilt: 8e-11 rad, inside the narrowest lobe there is.
const ZENITH: f64 = -24.0;

/// A rectangle in Mercator's coordinates of the hemisphere: `ln tan(θ/2)` from the zenith to 0, and the azimuth.
type Rectangle = [[f64; 2]; 2];

const HEMISPHERE: Rectangle = [[ZENITH, 0.0], [-PI, PI]];

/// Mercator's coordinates of a direction. Lobes about the zenith are about 1 wide in them, whatever their roughness.
fn coordinates(m: Vec3) -> [f64; 2] {
    let [x, y, z] = m.to_array().map(f64::from);
    let across = math::sqrt_f64(x * x + y * y);
    let tilt = math::ln_f64(across / (math::sqrt_f64(across * across + z * z) + z));
    [tilt.clamp(ZENITH, 0.0), math::atan2_f64(y, x)]
}

/// The direction at a place, and `dω = sin² θ` per area of the coordinates.
fn direction([tilt, azimuth]: [f64; 2]) -> (Vec3, f64) {
    let t = math::exp_f64(tilt);
    let (sin, cos) = (2.0 * t / (1.0 + t * t), (1.0 - t * t) / (1.0 + t * t));
    let (x, y) = (sin * math::cos_f64(azimuth), sin * math::sin_f64(azimuth));
    (Vec3::new(x as f32, y as f32, cos as f32), sin * sin)
}

/// A tree of halvings: each at the median of the pilot samples, along the coordinate in which they are spread the farther.
pub(super) struct Cells {
    /// The coordinate and the place of each cut; the cuts of cut `k` are `2k + 1` and `2k + 2`.
    cuts: Vec<(usize, f64)>,
}

impl Cells {
    pub(super) fn new(pilot: impl Iterator<Item = Vec3>) -> Self {
        let mut places: Vec<[f64; 2]> = pilot.map(coordinates).collect();
        let mut cells = Self { cuts: vec![(0, 0.0); (1 << HALVINGS) - 1] };
        cells.halve(0, &mut places, HEMISPHERE);
        cells
    }

    fn halve(&mut self, node: usize, places: &mut [[f64; 2]], [tilts, azimuths]: Rectangle) {
        if node >= self.cuts.len() {
            return;
        }
        let middle = places.len() / 2;
        let range = |axis: usize| {
            let of = places.iter().map(|place| place[axis]);
            of.clone().fold(f64::MIN, f64::max) - of.fold(f64::MAX, f64::min)
        };
        let axis = usize::from(range(1) > range(0));
        let rectangle = [tilts, azimuths];
        let cut = if places.is_empty() {
            0.5 * (rectangle[axis][0] + rectangle[axis][1])
        } else {
            places.select_nth_unstable_by(middle, |a, b| a[axis].total_cmp(&b[axis]));
            places[middle][axis]
        };
        self.cuts[node] = (axis, cut);
        let (mut low, mut high) = (rectangle, rectangle);
        (low[axis][1], high[axis][0]) = (cut, cut);
        let (below, above) = places.split_at_mut(middle);
        self.halve(2 * node + 1, below, low);
        self.halve(2 * node + 2, above, high);
    }

    /// The cell that holds a direction.
    pub(super) fn index(&self, m: Vec3) -> usize {
        let (place, mut node) = (coordinates(m), 0);
        while let Some(&(axis, cut)) = self.cuts.get(node) {
            node = 2 * node + 1 + usize::from(place[axis] >= cut);
        }
        node - self.cuts.len()
    }

    /// Counts of directions by their cells.
    pub(super) fn count(&self, directions: impl Iterator<Item = Vec3>) -> Vec<u64> {
        let mut counts = vec![0; self.cuts.len() + 1];
        for m in directions {
            counts[self.index(m)] += 1;
        }
        counts
    }

    /// The integral of `f` over each cell's solid angle.
    pub(super) fn integrate(&self, f: impl Fn(Vec3) -> f64) -> Vec<f64> {
        let mut integrals = Vec::with_capacity(self.cuts.len() + 1);
        self.integrate_node(0, HEMISPHERE, &f, &mut integrals);
        integrals
    }

    fn integrate_node(&self, node: usize, rectangle: Rectangle, f: &impl Fn(Vec3) -> f64, to: &mut Vec<f64>) {
        let Some(&(axis, cut)) = self.cuts.get(node) else {
            let coarse = gauss(rectangle, f);
            return to.push(adaptive(rectangle, coarse, DEEPEST, f));
        };
        let (mut low, mut high) = (rectangle, rectangle);
        (low[axis][1], high[axis][0]) = (cut, cut);
        self.integrate_node(2 * node + 1, low, f, to);
        self.integrate_node(2 * node + 2, high, f, to);
    }
}

/// By how much the quadrature of a part may change when it is halved: two in a thousand of a cell's share, divided among its parts.
const TOLERANCE: f64 = 2e-6;

/// Halvings of a cell in search of more digits, before its kinks are taken as they are.
const DEEPEST: u32 = 16;

/// Halves a rectangle along its side of the larger change until that no longer counts.
fn adaptive(rectangle: Rectangle, coarse: f64, deepest: u32, f: &impl Fn(Vec3) -> f64) -> f64 {
    let halves = |axis: usize| {
        let middle = 0.5 * (rectangle[axis][0] + rectangle[axis][1]);
        let (mut low, mut high) = (rectangle, rectangle);
        (low[axis][1], high[axis][0]) = (middle, middle);
        [(low, gauss(low, f)), (high, gauss(high, f))]
    };
    let change = |[low, high]: &[(Rectangle, f64); 2]| (low.1 + high.1 - coarse).abs();
    let parts = [halves(0), halves(1)];
    let [tilt, azimuth] = parts.each_ref().map(change);
    let [low, high] = if azimuth > tilt { parts[1] } else { parts[0] };
    if deepest == 0 || tilt.max(azimuth) <= TOLERANCE {
        return low.1 + high.1;
    }
    adaptive(low.0, low.1, deepest - 1, f) + adaptive(high.0, high.1, deepest - 1, f)
}

/// Three nodes of Gauss and Legendre along each side.
fn gauss([tilts, azimuths]: Rectangle, f: &impl Fn(Vec3) -> f64) -> f64 {
    // √(3/5)/2 about the middle, with the weights 5/18 and 4/9.
    const NODES: [(f64, f64); 3] =
        [(0.112_701_665_379_258_31, 5.0 / 18.0), (0.5, 4.0 / 9.0), (0.887_298_334_620_741_7, 5.0 / 18.0)];
    let at = |[from, to]: [f64; 2], t: f64| from + (to - from) * t;
    let mut sum = 0.0;
    for ((s, weight), (t, other)) in NODES.into_iter().flat_map(|a| NODES.map(|b| (a, b))) {
        let (m, area) = direction([at(tilts, s), at(azimuths, t)]);
        sum += weight * other * area * f(m);
    }
    sum * (tilts[1] - tilts[0]) * (azimuths[1] - azimuths[0])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Ggx, Ndf};

    #[test]
    fn cells_cover_the_hemisphere_once() {
        let ggx = Ggx::new(0.05, 0.4).unwrap();
        let at = |k: u32| {
            ggx.sample(glam::Vec2::new((k as f32 * 0.618_034).fract(), (k as f32 * 0.754_877_7).fract()))
        };
        let cells = Cells::new((0..4096).map(at));
        let areas = cells.integrate(|_| 1.0);
        assert_abs_diff_eq!(areas.iter().sum::<f64>(), 2.0 * PI, epsilon = 2e-4);
        assert_eq!(cells.count((0..4096).map(at)).iter().sum::<u64>(), 4096);
        // Each holds its share of the samples, but for those that share a coordinate with a cut.
        assert!(cells.count((0..4096).map(at)).iter().all(|count| (12..=20).contains(count)));
    }

    #[test]
    fn directions_keep_their_coordinates() {
        for place in [[-20.0, 0.3], [-3.0, -3.1], [-0.1, 2.0]] {
            let back = coordinates(direction(place).0);
            assert_abs_diff_eq!(back[0], place[0], epsilon = 1e-6, "{place:?}");
            assert_abs_diff_eq!(back[1], place[1], epsilon = 1e-6, "{place:?}");
        }
        assert_eq!(coordinates(Vec3::Z)[0], ZENITH);
    }
}
