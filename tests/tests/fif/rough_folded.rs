//! The folded surface with a factor per node: nodes, functional equation, edges, bounds, rays.
#![expect(clippy::unwrap_used, reason = "a test that cannot build its surface has failed")]

use std::cell::Cell;

use asperity_fif::glam::DVec2;
use asperity_fif::{
    Bounded, FifError, FoldedSurface, Intersect, Interval, RoughFoldedSurface, Surface, SurfaceBounds,
};
use asperity_tests::random::Random;

use crate::surface_rays::random_rays;

/// Knots of both axes, factors up to a magnitude, heights, gradients.
struct Given {
    x: Vec<f64>,
    y: Vec<f64>,
    factors: Vec<f64>,
    z: Vec<f64>,
    d: Vec<[f64; 2]>,
}

impl Given {
    fn new(random: &mut Random, most: f64) -> Self {
        let mut uniform = |lo: f64, hi: f64| lo + (hi - lo) * random.uniform();
        let mut knots = || -> Vec<f64> {
            let count = uniform(3.0, 6.0) as usize;
            let steps = (0..count).map(|_| uniform(0.5, 1.0));
            steps.fold(vec![-0.75], |mut knots, step| {
                knots.push(knots.last().unwrap() + step);
                knots
            })
        };
        let (x, y) = (knots(), knots());
        let count = x.len() * y.len();
        let mut list = |most: f64| -> Vec<f64> { (0..count).map(|_| uniform(-most, most)).collect() };
        let (factors, z, slopes) = (list(most), list(1.0), list(3.0));
        Self { x, y, factors, z, d: slopes.iter().map(|&s| [s, 0.5 - s]).collect() }
    }

    fn surface(&self) -> RoughFoldedSurface {
        RoughFoldedSurface::new(&self.x, &self.y, &self.factors, &self.z, &self.d).unwrap()
    }
}

#[test]
fn rough_folded_interpolates_and_is_continuous() {
    let mut random = Random(21);
    for _ in 0..40 {
        let given = Given::new(&mut random, 0.6);
        let (surface, Given { x, y, z, .. }) = (given.surface(), &given);
        for (i, &px) in x.iter().enumerate() {
            for (j, &py) in y.iter().enumerate() {
                let got = surface.evaluate(px, py, 0.0);
                assert_eq!((got.value, got.bound), (z[i * y.len() + j], 0.0), "node ({i}, {j})");
            }
        }
        let [wide, deep] = surface.domain();
        for (lines, side, along_x) in [(x, deep, true), (y, wide, false)] {
            for &line in &lines[1..lines.len() - 1] {
                let s = side.lo + random.uniform() * side.width();
                let at = |line: f64| if along_x { [line, s] } else { [s, line] };
                for near in [1e-3, 1e-8, 1e-13] {
                    let ([a, b], [p, q]) = (at(line - near), at(line + near));
                    let bounds = surface.bounds(Interval::new(a, p), Interval::new(b, q));
                    let ends = [surface.evaluate(a, b, 0.0), surface.evaluate(p, q, 0.0)];
                    for end in ends {
                        assert!(bounds.inflated(end.bound).contains(end.value), "{end:?} {bounds:?}");
                    }
                    // Powers of the factor 0.6 that make `near` a cell.
                    let widths = lines.windows(2).map(|pair| pair[1] - pair[0]);
                    let least = widths.fold(f64::INFINITY, f64::min);
                    let share = least / (lines[lines.len() - 1] - lines[0]);
                    let most =
                        8.0 * surface.range().width() * 0.6_f64.powf((near * 4.0).ln() / share.ln() - 1.0);
                    let change = (ends[0].value - ends[1].value).abs();
                    assert!(change <= most, "{change} over {most} beside {line}");
                    assert!(near > 1e-12 || change < 0.02, "{change} beside {line}");
                }
            }
        }
    }
}

#[test]
fn rough_folded_with_one_factor_is_folded() {
    let mut random = Random(22);
    for round in 0..60 {
        let given = Given { factors: vec![], ..Given::new(&mut random, 0.0) };
        let Given { x, y, z, d, .. } = &given;
        let factor = if round == 0 { 0.0 } else { 0.13 * (random.uniform() - 0.5) };
        let rough = RoughFoldedSurface::new(x, y, &vec![factor; z.len()], z, d).unwrap();
        let folded = FoldedSurface::new(x, y, factor, z, d).unwrap();
        for _ in 0..50 {
            let [px, py] = [x, y].map(|knots| {
                let (lo, hi) = (knots[0], knots[knots.len() - 1]);
                lo + (hi - lo) * (1.1 * random.uniform() - 0.05)
            });
            let (a, b) = (rough.evaluate(px, py, 0.0), folded.evaluate(px, py, 0.0));
            assert!((a.value - b.value).abs() <= a.bound + b.bound && a.bound < 1e-12, "{a:?} {b:?}");
            assert!(folded.range().inflated(b.bound).contains(a.value));
        }
        assert!(rough.range().width() < 3.0 * folded.range().width());
    }
}

/// On dyadic cells with all data zero on the border except heights between corners, G is 0 and
/// positions are exact.
#[test]
fn rough_folded_functional_equation() {
    let knots = [0.0, 0.25, 0.5, 0.75, 1.0];
    let mut random = Random(23);
    for _ in 0..20 {
        let inner = |index: usize| !(index / 5).is_multiple_of(4) && !(index % 5).is_multiple_of(4);
        let corner = |index: usize| (index / 5).is_multiple_of(4) && (index % 5).is_multiple_of(4);
        let mut list = |most: f64, keep: &dyn Fn(usize) -> bool| -> Vec<f64> {
            let one = |k| if keep(k) { most * (2.0 * random.uniform() - 1.0) } else { 0.0 };
            (0..25).map(one).collect()
        };
        let (factors, z) = (list(0.95, &|_| true), list(1.0, &|k| !corner(k)));
        let d: Vec<[f64; 2]> = list(2.0, &inner).into_iter().map(|s| [s, -0.5 * s]).collect();
        let surface = RoughFoldedSurface::new(&knots, &knots, &factors, &z, &d).unwrap();
        let smooth = RoughFoldedSurface::new(&knots, &knots, &[0.0; 25], &z, &d).unwrap();
        for _ in 0..100 {
            let place = [(); 2].map(|()| (random.uniform() * 1_048_576.0).floor() / 1_048_576.0);
            let [(i, u), (j, v)] = place.map(|t| ((4.0 * t) as usize, (4.0 * t).fract()));
            let [p, q] = [(i, u), (j, v)].map(|(i, u)| if i % 2 == 0 { u } else { 1.0 - u });
            let s = |a: usize, b: usize| factors[5 * (i + a) + j + b];
            let factor =
                (1.0 - u) * ((1.0 - v) * s(0, 0) + v * s(0, 1)) + u * ((1.0 - v) * s(1, 0) + v * s(1, 1));
            let [left, right] = [surface.evaluate(place[0], place[1], 0.0), surface.evaluate(p, q, 0.0)];
            let h = smooth.evaluate(place[0], place[1], 0.0);
            let off = left.value - (h.value + factor * right.value);
            assert!(off.abs() <= left.bound + h.bound + right.bound + 1e-15, "{place:?}: {off:e}");
            assert!(left.bound < 1e-11, "{left:?}");
        }
    }
}

#[test]
fn rough_folded_bounds_and_tolerances() {
    let mut random = Random(24);
    for _ in 0..40 {
        let surface = Given::new(&mut random, 0.9).surface();
        for size in [-1.0, -4.0, -10.0, -30.0] {
            let part = surface.domain().map(|side| {
                let lo = side.lo + (1.05 * random.uniform() - 0.05) * side.width();
                Interval::new(lo, lo + f64::exp2(size) * side.width())
            });
            let bounds = surface.bounds(part[0], part[1]);
            for _ in 0..30 {
                let [px, py] = part.map(|side| (side.lo + random.uniform() * side.width()).min(side.hi));
                let fine = surface.evaluate(px, py, 0.0);
                assert!(bounds.inflated(fine.bound).contains(fine.value), "{fine:?} {bounds:?}");
                assert!(surface.range().inflated(fine.bound).contains(fine.value));
                for tolerance in [1e-1, 1e-4, 1e-8] {
                    let coarse = surface.evaluate(px, py, tolerance);
                    assert!(coarse.bound <= tolerance.max(fine.bound), "{coarse:?} {fine:?}");
                    assert!((coarse.value - fine.value).abs() <= coarse.bound + fine.bound, "{coarse:?}");
                }
            }
        }
        let [x, y] = surface.domain();
        let extrema = surface.extrema_over(x, y, 0.5 * surface.range().width());
        assert!(extrema.maximum.hi <= surface.range().hi && surface.range().lo <= extrema.minimum.lo);
        assert_eq!(surface.bounds(Interval::EMPTY, y), surface.range());
        assert_eq!(surface.bounds(x, Interval::new(f64::NAN, 0.0)), surface.range());
        assert!(surface.height(f64::NAN, 0.0).is_nan());
        assert_eq!(surface.height(f64::INFINITY, -1e300), surface.height(x.hi, y.lo));
    }
}

#[test]
fn rough_folded_is_rough_where_its_factors_are() {
    // Factors 0 in the west, 0.8 in the east, on cells of a quarter.
    let knots = [0.0, 0.25, 0.5, 0.75, 1.0];
    let factors: Vec<f64> = (0..25).map(|k| [0.0, 0.0, 0.0, 0.8, 0.8][k / 5]).collect();
    let z: Vec<f64> = (0..25).map(|k| f64::from(k * 7 % 5) / 5.0).collect();
    let surface = RoughFoldedSurface::new(&knots, &knots, &factors, &z, &[[0.0; 2]; 25]).unwrap();
    let sway = |from: f64| {
        let steps = (0..1000).map(|k| from + 0.2 * f64::from(k) / 1000.0);
        let heights: Vec<f64> = steps.map(|x| surface.height(x, 0.37)).collect();
        heights.windows(2).map(|pair| (pair[1] - pair[0]).abs()).sum::<f64>()
    };
    let (west, east) = (sway(0.2), sway(0.78));
    assert!(east > 20.0 * west, "{east} {west}");
}

/// Counts the surface evaluations of a ray.
struct Counted<'a> {
    surface: &'a RoughFoldedSurface,
    evaluations: Cell<u32>,
    bounds: Cell<u32>,
}

impl Surface for Counted<'_> {
    fn domain(&self) -> [Interval; 2] {
        self.surface.domain()
    }

    fn range(&self) -> Interval {
        self.surface.range()
    }

    fn evaluate(&self, x: f64, y: f64, tolerance: f64) -> Bounded {
        self.evaluations.set(self.evaluations.get() + 1);
        self.surface.evaluate(x, y, tolerance)
    }

    fn bounds(&self, x: Interval, y: Interval) -> SurfaceBounds {
        self.bounds.set(self.bounds.get() + 1);
        Surface::bounds(self.surface, x, y)
    }

    fn gradient_near(&self, _: f64, _: f64, _: f64) -> Option<DVec2> {
        None
    }
}

impl Intersect for Counted<'_> {}

#[test]
fn a_ray_ends_at_its_limit_on_the_roughest_surface() {
    const LIMIT: u32 = 1 << 16;
    // All squares of five levels, and two heights with their rounding at every smallest square.
    const AFTER: u32 = 2 * (1 + 4 + 16 + 64 + 256 + 1024) + 6 * 1024;
    let mut random = Random(4);
    let z: Vec<f64> = (0..9).map(|_| 4.0 * random.uniform() - 2.0).collect();
    let factors: Vec<f64> = (0..9).map(|_| if random.uniform() < 0.5 { 0.9 } else { -0.9 }).collect();
    let surface =
        RoughFoldedSurface::new(&[0.0, 0.4, 1.0], &[0.0, 0.5, 1.0], &factors, &z, &[[0.0; 2]; 9]).unwrap();
    let mut most = 0;
    for ray in random_rays(&surface, 12) {
        let counted = Counted { surface: &surface, evaluations: Cell::new(0), bounds: Cell::new(0) };
        let hit = counted.intersect(&ray);
        let asked = counted.evaluations.get() + 2 * counted.bounds.get();
        assert!(asked <= LIMIT + AFTER, "{ray:?}: {asked}");
        assert!(asked < LIMIT || hit.is_none_or(|hit| !hit.certain), "{ray:?}: {asked}, {hit:?}");
        most = most.max(asked);
    }
    assert!(most > LIMIT, "no ray came to the limit: {most}");
}

#[test]
fn rough_folded_errors_name_the_parameter() {
    let (knots, z, d) = ([0.0, 1.0, 2.0], [0.5; 9], [[0.0; 2]; 9]);
    let new = |factors: &[f64], z: &[f64]| RoughFoldedSurface::new(&knots, &knots, factors, z, &d).err();
    assert_eq!(new(&[0.999; 9], &z), None);
    for bad in [1.0, -1.5, f64::NAN, f64::INFINITY, 1.0 - f64::EPSILON] {
        let mut factors = [0.5; 9];
        factors[5] = bad;
        let error = new(&factors, &z).unwrap();
        assert!(matches!(error, FifError::NodeScaling { node: [1, 2], .. }), "{error:?}");
        let sentence = format!("`scaling` must be under 1 in magnitude, got {bad} at node (1, 2)");
        assert_eq!(error.to_string(), sentence);
    }
    let length = FifError::Length { parameter: "scaling", expected: 9, got: 8 };
    assert_eq!(new(&[0.5; 8], &z), Some(length));
    assert!(matches!(new(&[0.5; 9], &[1e308; 9]), None | Some(FifError::TooLarge { .. })));
    let mut high = [1e308; 9];
    high[4] = -1e308;
    assert!(matches!(new(&[0.5; 9], &high), Some(FifError::TooLarge { .. })));
}
