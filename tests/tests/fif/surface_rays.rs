//! Rays against any surface: independent brackets, agreement with products of curves, tolerances,
//! and edge cases.
#![expect(clippy::unwrap_used, reason = "a test that cannot build its surface has failed")]

use asperity_fif::glam::DVec3;
use asperity_fif::{
    FifRef, FixedFif, FoldedSurface, HeightField, Hit, Intersect, Interval, PeriodicSurface, Ray,
    RoughFoldedSurface, Surface, Tabulated,
};
use asperity_tests::assert_abs_diff_eq;
use asperity_tests::random::Random;

use crate::properties::{f_hat, g_hat};

const ALL: Interval = Interval::new(0.0, f64::INFINITY);

/// Knots of the folded surfaces.
pub(crate) const X: [f64; 4] = [-0.5, 0.0, 0.25, 1.0];
pub(crate) const Y: [f64; 3] = [0.0, 0.3, 1.0];

/// Returns random numbers around 0 within a width.
pub(crate) fn numbers(random: &mut Random, count: usize, width: f64) -> Vec<f64> {
    (0..count).map(|_| width * (random.uniform() - 0.5)).collect()
}

/// Returns heights within a width, and gradients, at `count` nodes.
pub(crate) fn nodes(seed: u64, count: usize, width: f64) -> (Vec<f64>, Vec<[f64; 2]>) {
    let mut random = Random(seed);
    let z = numbers(&mut random, count, width);
    (z, numbers(&mut random, 2 * count, 2.0).as_chunks().0.to_vec())
}

fn torus() -> PeriodicSurface {
    let (z, d) = nodes(3, 16, 0.5);
    PeriodicSurface::new(4, [[2, -1], [1, 2]], 0.3, &z, &d).unwrap().narrowed()
}

fn folded() -> FoldedSurface {
    let (z, d) = nodes(4, 12, 0.6);
    FoldedSurface::new(&X, &Y, -0.1, &z, &d).unwrap().narrowed()
}

/// Smooth on one side, with factors up to 0.8 on the other.
fn rough_folded() -> RoughFoldedSurface {
    let mut random = Random(4);
    let z = numbers(&mut random, 12, 0.6);
    let factors: Vec<f64> =
        numbers(&mut random, 12, 0.53).iter().zip(0_u8..).map(|(f, k)| f64::from(k / 3) * f).collect();
    RoughFoldedSurface::new(&X, &Y, &factors, &z, &[[0.0; 2]; 12]).unwrap()
}

fn mirror() -> HeightField<FifRef<'static, 3>, FifRef<'static, 3>> {
    HeightField::new(f_hat(), f_hat())
}

fn ray(o: [f64; 3], d: [f64; 3]) -> Ray {
    Ray { origin: DVec3::from_array(o), direction: DVec3::from_array(d) }
}

/// Rays down onto the domain and past it, from inside the box, and nearly level.
pub(super) fn random_rays<S: Surface>(surface: &S, count: usize) -> Vec<Ray> {
    let mut random = Random(17);
    let ([x, y], z) = (surface.domain(), surface.range());
    (0..count)
        .map(|i| {
            let mut at = |side: Interval, out: f64| {
                side.lo + side.width() * (random.uniform() * (1.0 + 2.0 * out) - out)
            };
            let (origin, to) = match i % 3 {
                0 => (
                    DVec3::new(at(x, 0.0), at(y, 0.0), z.hi + z.width()),
                    DVec3::new(at(x, 0.5), at(y, 0.5), at(z, 0.0)),
                ),
                1 => (
                    DVec3::new(at(x, 0.0), at(y, 0.0), at(z, 0.0)),
                    DVec3::new(at(x, 0.0), at(y, 0.0), at(z, 0.0)),
                ),
                _ => (
                    DVec3::new(x.lo - 0.5 * x.width(), at(y, 0.0), at(z, 0.0)),
                    DVec3::new(x.hi, at(y, 0.0), at(z, 0.0)),
                ),
            };
            Ray { origin, direction: to - origin }
        })
        .collect()
}

/// No root lies before `lo`. If `root` is set, one lies in `[lo, hi]`.
#[derive(Clone, Copy)]
struct Bracket {
    lo: f64,
    hi: f64,
    root: bool,
}

/// Refines to intervals of `finest`, by bisection of the ray and enclosures of heights alone,
/// without slopes, squares or root finding.
fn bracket<S: Surface>(surface: &S, ray: &Ray, finest: f64) -> Option<Bracket> {
    let over = |lo: f64, hi: f64| Interval::new(lo.min(hi) - 1e-14, lo.max(hi) + 1e-14);
    let above = |t: f64| {
        let p = ray.at(t);
        p.z - surface.evaluate(p.x, p.y, 0.0).value
    };
    let span = [(ray.origin.x, ray.direction.x), (ray.origin.y, ray.direction.y)]
        .into_iter()
        .zip(surface.domain())
        .fold(ALL, |span, ((o, d), side)| {
            let (a, b) = ((side.lo - o) / d, (side.hi - o) / d);
            span.intersection(Interval::new(a.min(b), a.max(b)))
        });
    let mut stack = if span.lo <= span.hi { vec![(span.lo, span.hi)] } else { vec![] };
    while let Some((lo, hi)) = stack.pop() {
        let (a, b) = (ray.at(lo), ray.at(hi));
        let z = over(a.z, b.z);
        let h = surface.bounds(over(a.x, b.x), over(a.y, b.y)).height;
        if z.lo > h.hi || z.hi < h.lo {
            continue;
        }
        if hi - lo < finest {
            let (before, after) = ((lo - 4.0 * finest).max(span.lo), (hi + 4.0 * finest).min(span.hi));
            return Some(Bracket {
                lo: before,
                hi: after,
                root: (above(before) < 0.0) != (above(after) < 0.0),
            });
        }
        let middle = 0.5 * (lo + hi);
        stack.push((middle, hi));
        stack.push((lo, middle));
    }
    None
}

/// Counts rays that certainly hit or miss a surface, for each form of the surface.
fn compare_with_brackets<S: Surface>(
    surface: &S,
    forms: &[&dyn Intersect],
    rays: Vec<Ray>,
    finest: f64,
) -> [usize; 2] {
    let mut seen = [0; 2];
    for ray in rays {
        let bracket = bracket(surface, &ray, finest);
        for found in forms.iter().map(|form| form.intersect(&ray)) {
            match bracket {
                None => {
                    assert_eq!(found, None, "{ray:?}: invented");
                    seen[1] += 1;
                }
                Some(Bracket { lo, hi, root: true }) => {
                    let hit = found.unwrap_or_else(|| panic!("{ray:?} is missed, [{lo}, {hi}]"));
                    assert!(lo - 1e-12 <= hit.t && hit.t <= hi + 1e-12, "{ray:?}: {hit:?}, [{lo}, {hi}]");
                    let (height, at) = (surface.evaluate(hit.x, hit.y, 0.0).value, ray.at(hit.t));
                    assert_abs_diff_eq!(at.z, hit.height, epsilon = 1e-10, "{ray:?}: {hit:?}");
                    assert_abs_diff_eq!(height, hit.height, epsilon = 1e-12, "{hit:?}");
                    seen[0] += 1;
                }
                // A grazing ray may hit or miss, but nothing lies before.
                Some(Bracket { lo, .. }) => assert!(found.is_none_or(|hit| hit.t >= lo - 1e-12), "{ray:?}"),
            }
        }
    }
    seen
}

#[test]
fn surface_hits_are_neither_missed_nor_invented() {
    fn any<S: Intersect>(surface: &S, count: usize) -> [usize; 2] {
        let (fast, rays) = (Tabulated::with_levels(surface, 5), random_rays(surface, count));
        compare_with_brackets(surface, &[surface as &dyn Intersect, &fast], rays, 1e-6)
    }
    fn product(axis: FifRef<'_, 3>) -> [usize; 2] {
        let plain = HeightField::new(axis, axis);
        let rays = random_rays(&plain, 450);
        compare_with_brackets(&plain, &[&plain, &plain.clone().tabulated()], rays, 1e-9)
    }
    let [hits, misses] = any(&rough_folded(), 45);
    assert!(hits >= 15 && misses >= 10, "{hits} hits, {misses} misses");
    for [hits, misses] in [any(&torus(), 450), any(&folded(), 450), product(f_hat()), product(g_hat())] {
        assert!(hits >= 150 && misses >= 100, "{hits} hits, {misses} misses");
    }
}

#[test]
fn generic_surface_and_product_have_equal_hits() {
    let surface = mirror();
    let [plain, fast] = [0, 6].map(|levels| Tabulated::with_levels(&surface, levels));
    let (mut hits, mut worst) = (0, 0.0_f64);
    for ray in random_rays(&surface, 600) {
        let own = surface.intersect(&ray);
        for other in [plain.intersect(&ray), fast.intersect(&ray)] {
            assert_eq!(own.is_some(), other.is_some(), "{ray:?}: {own:?} {other:?}");
            if let (Some(own), Some(other)) = (own, other) {
                worst = worst.max((own.t - other.t).abs());
                assert!(own.normal.unwrap().distance(other.normal.unwrap()) < 1e-6, "{own:?} {other:?}");
                hits += 1;
            }
        }
    }
    // Measured 5e-13: the generic search ends at intervals of 10⁻¹² of the domain.
    assert!(hits >= 300 && worst < 1e-11, "{hits}, {worst:e}");
}

#[test]
fn hits_within_a_tolerance_agree_between_forms() {
    let torus = Tabulated::with_levels(torus(), 6);
    let rays = random_rays(&torus, 300);
    let exact: Vec<Option<Hit>> = rays.iter().map(|ray| torus.intersect(ray)).collect();
    for (ray, exact) in rays.iter().zip(&exact) {
        assert_eq!(torus.occluded(ray, ALL), exact.is_some(), "{ray:?}");
    }
    for tolerance in [1e-2, 1e-4, 1e-7, 1e-10] {
        let mut hits = vec![None; rays.len()];
        torus.intersect_batch(&rays, ALL, tolerance, &mut hits).unwrap();
        let mut off = 0;
        for ((ray, exact), hit) in rays.iter().zip(&exact).zip(hits) {
            let near = match (exact, hit) {
                (Some(exact), Some(hit)) => (exact.t - hit.t).abs() * ray.direction.length() <= tolerance,
                (exact, hit) => exact.is_none() && hit.is_none(),
            };
            off += u32::from(!near);
        }
        // Rays that enter the surface for less than the tolerance may miss it there.
        assert!(off <= if tolerance > 1e-3 { 6 } else { 0 }, "{tolerance}: {off}");
    }
}

#[test]
fn rays_at_nodes() {
    let surface = torus();
    let fast = Tabulated::with_levels(&surface, 4);
    let node = |i: u32, j: u32| {
        let (x, y) = (0.25 * f64::from(i), 0.25 * f64::from(j));
        [x, y, surface.height(x, y)]
    };
    for [x, y, z] in [node(0, 0), node(1, 2), node(3, 3), node(2, 0)] {
        for d in [[0.0, 0.0, 1.0], [0.1, 0.2, 0.9], [-0.3, 0.1, -2.0], [1.0, 0.0, 0.0], [0.0, -1.0, 0.0]] {
            for hit in [surface.intersect(&ray([x, y, z], d)), fast.intersect(&ray([x, y, z], d))] {
                let hit = hit.unwrap_or_else(|| panic!("({x}, {y}) {d:?}"));
                assert!(hit.t.abs() < 1e-11, "({x}, {y}) {d:?}: {hit:?}");
            }
        }
        // Straight down and nearly so onto a node; straight up from below it.
        for d in [[0.0, 0.0, -2.0], [1e-9, 0.0, -2.0], [0.0, 1e-12, -2.0]] {
            let hit = fast.intersect(&ray([x, y, z + 4.0], d)).unwrap();
            assert_abs_diff_eq!(hit.t, 2.0, epsilon = 1e-8, "{hit:?}");
            assert_abs_diff_eq!(hit.height, z, epsilon = 1e-8, "{hit:?}");
            assert_eq!(fast.intersect(&ray([x, y, z + 4.0], [d[0], d[1], 2.0])), None);
        }
        assert!(fast.intersect(&ray([x, y, z - 4.0], [0.0, 0.0, 1.0])).is_some());
        // The ends of the interval belong to it.
        let down = ray([x, y, z + 1.0], [0.0, 0.0, -1.0]);
        assert!(fast.intersect_within(&down, Interval::new(0.0, 1.0), 0.0).is_some());
        assert_eq!(fast.intersect_within(&down, Interval::new(0.0, 0.999), 0.0), None);
        assert_eq!(fast.intersect_within(&down, Interval::new(1.001, 9.0), 0.0), None);
        assert_eq!(fast.intersect_within(&down, Interval::new(0.0, f64::NAN), 0.0), None);
        assert!(fast.intersect_within(&down, Interval::new(f64::NAN, 9.0), f64::NAN).is_some());
    }
    // Along a grid line, and level within the range.
    let z = node(2, 1)[2];
    for [o, d] in [[[-1.0, 0.25, z], [1.0, 0.0, 0.0]], [[0.5, 3.0, z], [0.0, -1.0, 0.0]]] {
        let (plain, fast) = (surface.intersect(&ray(o, d)), fast.intersect(&ray(o, d)));
        let [plain, fast] = [plain, fast].map(Option::unwrap);
        assert_abs_diff_eq!(plain.t, fast.t, epsilon = 1e-10, "{plain:?} {fast:?}");
        assert_abs_diff_eq!(plain.height, z, epsilon = 1e-10, "{plain:?} {fast:?}");
    }
    // One period only.
    assert!(fast.intersect(&ray([0.5, 0.5, 9.0], [0.0, 0.0, -1.0])).is_some());
    assert!(fast.intersect(&ray([1.5, 0.5, 9.0], [0.0, 0.0, -1.0])).is_none());
    assert!(fast.intersect(&ray([1.5, 0.5, 9.0], [0.01, 0.0, -1.0])).is_none());
}

/// Invalid rays hit nothing. Directions of any length terminate and hit as expected.
fn check_extreme_rays(surface: &dyn Intersect, [x, y]: [f64; 2], from: [f64; 3], along: [f64; 3]) {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
        for k in 0..3 {
            let (mut o, mut d) = ([x, y, 9.0], [0.01, 0.01, -1.0]);
            assert!(surface.intersect(&ray(o, d)).is_some());
            o[k] = bad;
            assert_eq!(surface.intersect(&ray(o, d)), None, "origin {o:?}");
            o[k] = x;
            d[k] = bad;
            assert_eq!(surface.intersect(&ray(o, d)), None, "direction {d:?}");
            assert!(!surface.occluded(&ray(o, d), ALL), "direction {d:?}");
        }
    }
    for z in [0.0, 0.5, 1.0, 3.0] {
        assert_eq!(surface.intersect(&ray([x, y, z], [0.0; 3])), None, "z = {z}");
    }
    let slanted = |scale: f64| ray(from, along.map(|d| scale * d));
    let t = surface.intersect(&slanted(1.0)).unwrap().t;
    for scale in [1e-300, 1e-12, 1e12, 1e300] {
        let hit = surface.intersect(&slanted(scale)).unwrap();
        assert_abs_diff_eq!(hit.t * scale, t, epsilon = 1e-10, "{scale}: {hit:?}");
    }
    for scale in [1e-320, 1e-308, f64::MAX] {
        let _ = surface.intersect(&slanted(scale));
    }
}

#[test]
fn invalid_and_extreme_rays() {
    let fast = Tabulated::with_levels(folded(), 4);
    check_extreme_rays(&fast, [0.25; 2], [-1.0, -1.0, 2.0], [1.0, 1.0, -1.5]);
    check_extreme_rays(&rough_folded(), [0.25; 2], [-1.0, -1.0, 2.0], [1.0, 1.0, -1.5]);
    for product in [mirror(), mirror().tabulated()] {
        check_extreme_rays(&product, [0.5; 2], [-1.0, -1.0, 3.0], [1.0, 1.0, -1.0]);
    }
}

#[test]
fn level_surface_is_hit_and_grazed() {
    let level =
        FoldedSurface::new(&[0.0, 1.0, 2.0], &[0.0, 1.0, 2.0], 0.4, &[1.0; 9], &[[0.0; 2]; 9]).unwrap();
    // Constants with factors of 1/2 and constant polynomials.
    let one = FixedFif::<2, 1>::new(&[0.0, 1.0, 2.0], &[0.5, 0.5], &[[0.5], [0.5]]).unwrap();
    let product = HeightField::new(one, one);
    for form in [&level as &dyn Intersect, &Tabulated::new(&level), &product, &product.clone().tabulated()] {
        let hit = form.intersect(&ray([-1.0, 0.3, 1.5], [1.0, 0.1, -0.25])).unwrap();
        assert_abs_diff_eq!(hit.t, 2.0, epsilon = 1e-11, "{hit:?}");
        let along = form.intersect(&ray([-1.0, 0.3, 1.0], [1.0, 0.1, 0.0])).unwrap();
        assert_abs_diff_eq!(along.t, 1.0, epsilon = 1e-11, "{along:?}");
        assert_eq!(form.intersect(&ray([-1.0, 0.3, 1.0 + 1e-9], [1.0, 0.1, 0.0])), None);
    }
}
