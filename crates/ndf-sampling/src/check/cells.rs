//! Cells of the sphere or its upper half with equal sample counts, and integrals over them.

use alloc::vec;
use alloc::vec::Vec;
use core::f64::consts::PI;

use glam::Vec3;

use asperity_core::math;

/// Halvings of the domain: 2⁸ cells.
const HALVINGS: usize = 8;

/// The lowest coordinate of a tilt: 8e-11 rad, inside the narrowest possible lobe.
const ZENITH: f64 = -24.0;

/// A rectangle in Mercator coordinates.
///
/// They are `ln tan(θ/2)` from the zenith to 0 at the horizon and on to the nadir, and the azimuth.
type Rectangle = [[f64; 2]; 2];

const HEMISPHERE: Rectangle = [[ZENITH, 0.0], [-PI, PI]];
const SPHERE: Rectangle = [[ZENITH, -ZENITH], [-PI, PI]];

/// Mercator coordinates of a direction.
///
/// Lobes around the zenith are about 1 wide in them for every roughness.
fn coordinates(m: Vec3) -> [f64; 2] {
    let [x, y, z] = m.to_array().map(f64::from);
    let across = math::sqrt_f64(x * x + y * y);
    let tilt = math::ln_f64(across / (math::sqrt_f64(across * across + z * z) + z.abs())).max(ZENITH);
    [if z < 0.0 { -tilt } else { tilt }, math::atan2_f64(y, x)]
}

/// The direction at a point, and `dω = sin² θ` per area of the coordinates.
fn direction([tilt, azimuth]: [f64; 2]) -> (Vec3, f64) {
    let t = math::exp_f64(tilt);
    let (sin, cos) = (2.0 * t / (1.0 + t * t), (1.0 - t * t) / (1.0 + t * t));
    let (x, y) = (sin * math::cos_f64(azimuth), sin * math::sin_f64(azimuth));
    (Vec3::new(x as f32, y as f32, cos as f32), sin * sin)
}

/// The parts of a rectangle on both sides of a cut.
fn split(rectangle: Rectangle, axis: usize, cut: f64) -> [Rectangle; 2] {
    let mut halves = [rectangle; 2];
    (halves[0][axis][1], halves[1][axis][0]) = (cut, cut);
    halves
}

/// Cells of directions for χ² tests.
///
/// The domain is halved at the median of pilot samples, along the coordinate with the larger
/// spread.
///
/// In cells of the sphere, quadrature stops at the horizon, where BRDFs are discontinuous.
///
/// ```
/// use asperity_ndf_sampling::{Ggx, Ndf, check::{Cells, p_value}, glam::Vec2};
///
/// let ggx = Ggx::new(0.2, 0.4)?;
/// let sample = |k: u32| ggx.sample(Vec2::new((k as f32 * 0.754_877_7).fract(), (k as f32 * 0.569_840_3).fract()));
/// let cells = Cells::of_hemisphere((0..4096).map(sample));
/// let masses = cells.integrate(|m| f64::from(ggx.d(m) * m.z));
/// assert!((masses.iter().sum::<f64>() - 1.0).abs() < 1e-3);
/// assert!(p_value(&cells.count((4096..8192).map(sample)), &masses, 4096) > 1e-6);
/// # Ok::<(), asperity_ndf_sampling::NdfError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Cells {
    domain: Rectangle,
    /// The coordinate and position of each cut; the children of cut `k` are `2k + 1` and `2k + 2`.
    cuts: Vec<(usize, f64)>,
    /// The parts of each cell, and the bounding rectangle of the pilot samples in each.
    parts: Vec<Vec<[Rectangle; 2]>>,
}

impl Cells {
    /// 256 cells of the upper hemisphere, from samples of it.
    #[must_use]
    pub fn of_hemisphere(pilot: impl IntoIterator<Item = Vec3>) -> Self {
        Self::of(HEMISPHERE, pilot)
    }

    /// 256 cells of the sphere, from samples of it.
    #[must_use]
    pub fn of_sphere(pilot: impl IntoIterator<Item = Vec3>) -> Self {
        Self::of(SPHERE, pilot)
    }

    fn of(domain: Rectangle, pilot: impl IntoIterator<Item = Vec3>) -> Self {
        let [low, high] = domain[0];
        let mut places: Vec<[f64; 2]> = pilot
            .into_iter()
            .map(coordinates)
            .filter(|[tilt, azimuth]| !tilt.is_nan() && !azimuth.is_nan())
            .map(|[tilt, azimuth]| [tilt.clamp(low, high), azimuth.clamp(-PI, PI)])
            .collect();
        let cuts = vec![(0, 0.0); (1 << HALVINGS) - 1];
        let mut cells = Self { domain, cuts, parts: Vec::with_capacity(1 << HALVINGS) };
        cells.halve(0, &mut places, domain);
        cells
    }

    fn halve(&mut self, node: usize, places: &mut [[f64; 2]], rectangle: Rectangle) {
        if node >= self.cuts.len() {
            let mut parts = Vec::new();
            part_at_gaps(rectangle, places, &mut parts);
            return self.parts.push(parts);
        }
        let span = spanned(places);
        let middle = places.len() / 2;
        let axis = usize::from(span[1][1] - span[1][0] > span[0][1] - span[0][0]);
        let cut = if places.is_empty() {
            0.5 * (rectangle[axis][0] + rectangle[axis][1])
        } else {
            places.select_nth_unstable_by(middle, |a, b| a[axis].total_cmp(&b[axis]));
            places[middle][axis]
        };
        self.cuts[node] = (axis, cut);
        let [low, high] = split(rectangle, axis, cut);
        let (below, above) = places.split_at_mut(middle);
        self.halve(2 * node + 1, below, low);
        self.halve(2 * node + 2, above, high);
    }

    /// The index of the cell that contains a direction.
    fn index(&self, m: Vec3) -> usize {
        let (place, mut node) = (coordinates(m), 0);
        while let Some(&(axis, cut)) = self.cuts.get(node) {
            node = 2 * node + 1 + usize::from(place[axis] >= cut);
        }
        node - self.cuts.len()
    }

    /// Counts directions per cell.
    #[must_use]
    pub fn count(&self, directions: impl IntoIterator<Item = Vec3>) -> Vec<u64> {
        let mut counts = vec![0; self.parts.len()];
        for m in directions {
            counts[self.index(m)] += 1;
        }
        counts
    }

    /// The integral of `f` over the solid angle of each cell, by adaptive quadrature.
    #[must_use]
    pub fn integrate(&self, f: impl Fn(Vec3) -> f64) -> Vec<f64> {
        self.integrate_all(|m| [f(m)]).into_iter().map(|[integral]| integral).collect()
    }

    /// Integrals of several functions over the solid angle of each cell, from the same directions.
    #[must_use]
    pub fn integrate_all<const N: usize>(&self, f: impl Fn(Vec3) -> [f64; N]) -> Vec<[f64; N]> {
        let of = |parts: &Vec<[Rectangle; 2]>| {
            parts.iter().fold([0.0; N], |sum, &[part, span]| plus(sum, graded(part, span, &f)))
        };
        self.parts.iter().map(of).collect()
    }
}

fn sort(places: &mut [[f64; 2]], axis: usize) {
    places.sort_unstable_by(|a, b| a[axis].total_cmp(&b[axis]));
}

/// The bounding rectangle of points. Without points it is empty, from ∞ to −∞.
fn spanned(places: &[[f64; 2]]) -> Rectangle {
    [0, 1].map(|axis| {
        let of = places.iter().map(|place| place[axis]);
        [of.clone().fold(f64::INFINITY, f64::min), of.fold(f64::NEG_INFINITY, f64::max)]
    })
}

/// Splits a rectangle on one side of the horizon at gaps wider than half of its points' extent.
fn part_at_gaps(rectangle: Rectangle, places: &mut [[f64; 2]], to: &mut Vec<[Rectangle; 2]>) {
    if rectangle[0][0] < 0.0 && rectangle[0][1] > 0.0 {
        sort(places, 0);
        return part_at(rectangle, 0, 0.0, places, to);
    }
    if places.is_empty() {
        return to.push([rectangle; 2]);
    }
    let span = spanned(places);
    for axis in [0, 1] {
        sort(places, axis);
        // A wide gap among few points is not significant: two points are nothing but a gap.
        let wide = (0.5 + 1.0 / places.len() as f64) * (span[axis][1] - span[axis][0]);
        let gap = places.windows(2).position(|pair| pair[1][axis] - pair[0][axis] > wide);
        if let Some(gap) = gap {
            return part_at(rectangle, axis, 0.5 * (places[gap][axis] + places[gap + 1][axis]), places, to);
        }
    }
    to.push([rectangle, span]);
}

/// Splits a rectangle at a cut of its points, which are sorted along the axis.
fn part_at(
    rectangle: Rectangle,
    axis: usize,
    cut: f64,
    places: &mut [[f64; 2]],
    to: &mut Vec<[Rectangle; 2]>,
) {
    let [low, high] = split(rectangle, axis, cut);
    let (below, above) = places.split_at_mut(places.partition_point(|place| place[axis] < cut));
    part_at_gaps(low, below, to);
    part_at_gaps(high, above, to);
}

/// The integral over a rectangle by nested frames around the bounding rectangle of its samples.
///
/// Each frame is three times as wide as the next inner one, so a narrow lobe in a wide cell lies in
/// the inner frames.
fn graded<const N: usize>(rectangle: Rectangle, span: Rectangle, f: &impl Fn(Vec3) -> [f64; N]) -> [f64; N] {
    let mut sum = [0.0; N];
    let mut add = |part: Rectangle| {
        if part.iter().all(|[low, high]| low < high) {
            sum = plus(sum, adaptive(part, gauss(part, f), DEEPEST, f));
        }
    };
    let within = |by: f64, span: Rectangle| {
        [0, 1].map(|axis| {
            let ([low, high], [from, to]) = (rectangle[axis], span[axis]);
            // The bounding rectangle of a single sample has no width.
            let wider = by * (to - from).max(1e-7);
            [(from - wider).clamp(low, high), (to + wider).clamp(low, high)]
        })
    };
    let mut inner = within(0.0, span);
    add(inner);
    while inner != rectangle {
        let outer = within(1.0, inner);
        add([[outer[0][0], inner[0][0]], outer[1]]);
        add([[inner[0][1], outer[0][1]], outer[1]]);
        add([inner[0], [outer[1][0], inner[1][0]]]);
        add([inner[0], [inner[1][1], outer[1][1]]]);
        inner = outer;
    }
    sum
}

/// The largest change of the quadrature of a part when it is halved: a thousandth of the fraction
/// of a cell, divided among its parts.
const TOLERANCE: f64 = 4e-6;

/// Halvings of a part for more digits, before its kinks are accepted.
const DEEPEST: u32 = 16;

/// Halves a rectangle along the side with the larger change until the change is negligible.
fn adaptive<const N: usize>(
    rectangle: Rectangle,
    coarse: [f64; N],
    deepest: u32,
    f: &impl Fn(Vec3) -> [f64; N],
) -> [f64; N] {
    let parts = [0, 1].map(|axis| {
        let [from, to] = rectangle[axis];
        split(rectangle, axis, 0.5 * (from + to)).map(|half| (half, gauss(half, f)))
    });
    let [tilt, azimuth] = parts.map(|[low, high]| {
        let fine = plus(low.1, high.1);
        fine.iter().zip(coarse).fold(0.0, |most: f64, (fine, coarse)| most.max((fine - coarse).abs()))
    });
    let [low, high] = if azimuth > tilt { parts[1] } else { parts[0] };
    if deepest == 0 || tilt.max(azimuth) <= TOLERANCE {
        return plus(low.1, high.1);
    }
    plus(adaptive(low.0, low.1, deepest - 1, f), adaptive(high.0, high.1, deepest - 1, f))
}

/// Three Gauss–Legendre nodes along each side.
fn gauss<const N: usize>([tilts, azimuths]: Rectangle, f: &impl Fn(Vec3) -> [f64; N]) -> [f64; N] {
    // √(3/5)/2 around the middle, with the weights 5/18 and 4/9.
    const NODES: [(f64, f64); 3] =
        [(0.112_701_665_379_258_31, 5.0 / 18.0), (0.5, 4.0 / 9.0), (0.887_298_334_620_741_7, 5.0 / 18.0)];
    let at = |[from, to]: [f64; 2], t: f64| from + (to - from) * t;
    let whole = (tilts[1] - tilts[0]) * (azimuths[1] - azimuths[0]);
    let mut sum = [0.0; N];
    for ((s, weight), (t, other)) in NODES.into_iter().flat_map(|a| NODES.map(|b| (a, b))) {
        let (m, area) = direction([at(tilts, s), at(azimuths, t)]);
        sum = plus(sum, f(m).map(|value| weight * other * area * whole * value));
    }
    sum
}

/// The element-wise sum of two lists.
fn plus<const N: usize>(mut a: [f64; N], b: [f64; N]) -> [f64; N] {
    a.iter_mut().zip(b).for_each(|(a, b)| *a += b);
    a
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Ggx, Ndf};
    use asperity_core::assert_abs_diff_eq;

    fn ggx(count: u32) -> impl Iterator<Item = Vec3> {
        let ggx = Ggx::new(0.05, 0.4).unwrap();
        (0..count).map(move |k| {
            ggx.sample(glam::Vec2::new((k as f32 * 0.618_034).fract(), (k as f32 * 0.754_877_7).fract()))
        })
    }

    #[test]
    fn cells_cover_the_hemisphere_once() {
        let cells = Cells::of_hemisphere(ggx(4096));
        let areas = cells.integrate(|_| 1.0);
        assert_abs_diff_eq!(areas.iter().sum::<f64>(), 2.0 * PI, epsilon = 2e-4);
        // Each contains its fraction of the samples, except for samples that share a coordinate
        // with a cut.
        let counts = cells.count(ggx(4096));
        assert!(counts.iter().sum::<u64>() == 4096 && counts.iter().all(|count| (12..=20).contains(count)));
    }

    #[test]
    fn cells_cover_the_sphere_once() {
        let cells = Cells::of_sphere(ggx(1024).chain(ggx(1024).map(|m| -m)));
        let [whole, upper] = cells
            .integrate_all(|m| [1.0, if m.z > 0.0 { 1.0 } else { 0.0 }])
            .into_iter()
            .fold([0.0; 2], plus);
        assert_abs_diff_eq!(whole, 4.0 * PI, epsilon = 4e-4);
        assert_abs_diff_eq!(upper, 2.0 * PI, epsilon = 2e-4);
        assert_eq!(
            Cells::of_sphere([Vec3::NAN]).count([Vec3::NAN, Vec3::Z, -Vec3::X]).iter().sum::<u64>(),
            3
        );
    }

    #[test]
    fn integrate_finds_narrow_lobe_in_wide_cells() {
        // A lobe of 1e-4 rad at 60°, on a floor with most of the samples.
        let lobe = Vec3::new(0.866_025_4, 0.0, 0.5);
        let round = crate::Beckmann::new(1e-4, 1e-4).unwrap();
        let near = (0..64).map(|k| {
            let u = glam::Vec2::new((k as f32 + 0.5) / 64.0, (k as f32 * 0.618_034).fract());
            glam::Quat::from_rotation_arc(Vec3::Z, lobe) * round.sample(u)
        });
        let cells = Cells::of_hemisphere(ggx(4032).chain(near));
        let at = |m: Vec3| math::exp_f64(-f64::from((m - lobe).length_squared()) / 1e-8) / (PI * 1e-8);
        // One part of 64 lies beyond the outermost of 64 samples.
        assert_abs_diff_eq!(cells.integrate(at).iter().sum::<f64>(), 1.0, epsilon = 1.0 / 64.0);
    }

    #[test]
    fn direction_round_trips() {
        for place in [[-20.0, 0.3], [-3.0, -3.1], [-0.1, 2.0], [0.1, 2.0], [3.0, 1.0], [20.0, -0.3]] {
            let back = coordinates(direction(place).0);
            assert_abs_diff_eq!(back[0], place[0], epsilon = 1e-6, "{place:?}");
            assert_abs_diff_eq!(back[1], place[1], epsilon = 1e-6, "{place:?}");
        }
        assert_eq!(coordinates(Vec3::Z)[0], ZENITH);
    }
}
