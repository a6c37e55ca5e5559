//! Properties of random fractal interpolation functions, and of surfaces built from them.

use std::ops::{Range, RangeInclusive};
use std::sync::LazyLock;

use asperity_fif::glam::DVec3;
use asperity_fif::{Fif, FifRef, FixedFif, HeightField, Intersect, Ray, cochran_2000};
use proptest::prelude::*;

/// The functions of the source as axes of one type, because ray code is compiled for every number
/// of coefficients.
macro_rules! axes {
    ($($name:ident: $coefficients:literal;)+) => {$(
        pub(super) fn $name() -> FifRef<'static, $coefficients> {
            static AXIS: LazyLock<FixedFif<2, $coefficients>> = LazyLock::new(|| cochran_2000::$name().unwrap());
            AXIS.view()
        }
    )+};
}
axes! { f: 2; g: 2; f_hat: 3; g_hat: 3; }

/// Affine systems with this many maps from `start`, with random cells and factors.
pub(super) fn affine_over(
    maps: RangeInclusive<usize>,
    start: Range<f64>,
    gap: impl Strategy<Value = f64> + Clone,
    factor: impl Strategy<Value = f64> + Clone,
) -> impl Strategy<Value = Fif<2>> {
    (maps, start)
        .prop_flat_map(move |(maps, start)| {
            let gaps = prop::collection::vec(gap.clone(), maps);
            let y = prop::collection::vec(-2.0..2.0_f64, maps + 1);
            (Just(start), gaps, y, prop::collection::vec(factor.clone(), maps))
        })
        .prop_map(|(start, gaps, y, alpha)| {
            Fif::affine(&knots(start, &gaps), &y, &alpha).expect("the data are in order")
        })
}

/// Returns knots from the first knot and the cell widths.
pub(super) fn knots(start: f64, gaps: &[f64]) -> Vec<f64> {
    let rest = gaps.iter().scan(start, |at, gap| {
        *at += gap;
        Some(*at)
    });
    std::iter::once(start).chain(rest).collect()
}

/// Random affine systems: 2 to 64 maps, gaps up to 1 : 100, factors of magnitude up to `steepest`.
pub(super) fn affine(steepest: f64) -> impl Strategy<Value = Fif<2>> {
    affine_over(2..=64, -5.0..5.0, 0.01..1.0_f64, -steepest..steepest)
}

/// Random Hermite systems on 2 to 6 equal or unequal maps.
pub(super) fn hermite() -> impl Strategy<Value = Fif<4>> {
    (2_usize..=6)
        .prop_flat_map(|maps| {
            let list = |range: Range<f64>, len| prop::collection::vec(range, len);
            (
                list(0.3..1.0, maps),
                list(-1.0..1.0, maps + 1),
                list(-2.0..2.0, maps + 1),
                list(-0.9..0.9, maps),
            )
        })
        .prop_map(|(gaps, y, slopes, share)| {
            let total: f64 = gaps.iter().sum();
            let alpha: Vec<f64> = gaps.iter().zip(share).map(|(gap, share)| share * gap / total).collect();
            Fif::hermite(&knots(0.0, &gaps), &y, &slopes, &alpha).expect("the data are in order")
        })
}

/// Returns a configuration with a number of cases and a seed.
pub(super) fn seeded(seed: u64, cases: u32) -> ProptestConfig {
    let rng_seed = proptest::test_runner::RngSeed::Fixed(seed);
    ProptestConfig { cases, rng_seed, failure_persistence: None, ..ProptestConfig::default() }
}

pub(super) fn config(cases: u32) -> ProptestConfig {
    seeded(0x00A5_9E71, cases)
}

proptest! {
    #![proptest_config(config(96))]

    #[test]
    fn functional_equation_within_bound(
        f in affine(0.999),
        digits in prop::collection::vec(0_usize..64, 24),
        first in 0_usize..64,
    ) {
        let maps = f.pieces().len();
        let digits: Vec<usize> = digits.into_iter().map(|j| j % maps).collect();
        let first = first % maps;
        // x = L_i(L_j(…(x_0))), then the left end repeated.
        let x = digits.iter().rev().fold(f.domain().lo, |x, &j| f.pieces()[j].map().apply(x, 0.0).0);
        let address = || digits.iter().copied().chain(std::iter::repeat(0));
        let inner = f.value_at_address(address(), 1e-12).unwrap();
        let outer = f.value_at_address(std::iter::once(first).chain(address()), 1e-12).unwrap();
        let map = f.pieces()[first].map();
        let want = map.apply(x, inner.value).1;
        // The slope of q times the rounding of x.
        let rounding = 1e-14 * (1.0 + map.q[0].abs() + map.q[1].abs() * (1.0 + x.abs()));
        let bound = outer.bound + map.alpha.abs() * inner.bound + rounding;
        prop_assert!((outer.value - want).abs() <= bound, "{} != {want} ± {bound:e}", outer.value);
    }

    #[test]
    fn knots_are_hit_exactly(f in affine(0.999), tolerance in 1e-15..1.0_f64) {
        for piece in f.pieces() {
            for (x, y) in piece.x().into_iter().zip(piece.y()) {
                let got = f.evaluate(x, tolerance);
                prop_assert_eq!((got.value, got.bound), (y, 0.0));
            }
        }
        let (below, above) = (f.evaluate(f.domain().lo - 1.0, 1e-6), f.evaluate(f64::INFINITY, 1e-6));
        prop_assert_eq!([below.value, above.value], f.end_values());
    }

    #[test]
    fn doubles_on_even_knots_have_exact_addresses(
        y in prop::collection::vec(-1.0..1.0_f64, 8),
        alpha in prop::collection::vec(-0.95..0.95_f64, 7),
        maps in 2_usize..=7,
        fraction in 1_u64..1 << 53,
    ) {
        let x: Vec<f64> = (0..=maps).map(|j| j as f64 / maps as f64).collect();
        let f = Fif::affine(&x, &y[..=maps], &alpha[..maps]).unwrap();
        let mut rest = u128::from(fraction);
        let digits: Vec<usize> = (0..1200).map(|_| {
            rest *= maps as u128;
            let digit = rest >> 53;
            rest &= (1 << 53) - 1;
            usize::try_from(digit).unwrap()
        }).collect();
        let point = fraction as f64 / 9_007_199_254_740_992.0;
        let (by_point, by_address) = (f.evaluate(point, 1e-13), f.value_at_address(digits.iter().copied(), 1e-13).unwrap());
        let bound = by_point.bound + by_address.bound;
        prop_assert!((by_point.value - by_address.value).abs() <= bound, "{by_point:?} {by_address:?}");
        prop_assert!(bound < 1e-10);
        prop_assert!(f.address(point).zip(&digits).take(300).all(|(got, &want)| got == want));
    }

    #[test]
    fn tolerance_is_within_bound(f in affine(0.95), s in 0.0..1.0_f64) {
        let x = f.domain().lo + s * f.domain().width();
        let fine = f.evaluate(x, 0.0);
        for tolerance in [1e-1, 1e-4, 1e-8] {
            let coarse = f.evaluate(x, tolerance);
            prop_assert!(coarse.bound <= tolerance, "{coarse:?} at {tolerance:e}");
            prop_assert!((coarse.value - fine.value).abs() <= coarse.bound + fine.bound, "{coarse:?} {fine:?}");
        }
    }

    #[test]
    fn no_surface_before_the_first_hit(
        f in hermite(), g in hermite(),
        from in prop::array::uniform3(-2.0..2.0_f64), to in prop::array::uniform2(0.0..1.0_f64),
    ) {
        let surface = HeightField::new(f.view(), g.view());
        let cached = surface.clone().tabulated_with(64);
        let target = DVec3::new(to[0] * f.domain().width(), to[1] * g.domain().width(), 0.0);
        let origin = DVec3::new(3.0 * from[0], 3.0 * from[1], from[2]);
        let target = DVec3::new(target.x, target.y, surface.height(target.x, target.y));
        let ray = Ray { origin, direction: target - origin };
        // The target is on the surface, so there is a hit at t ≤ 1.
        let hit = cached.intersect(&ray);
        prop_assert!(hit.is_some(), "{ray:?} passes");
        let hit = hit.unwrap();
        prop_assert!(hit.t <= 1.0 + 1e-9, "{hit:?}");
        prop_assert!((ray.at(hit.t).z - hit.height).abs() < 1e-10, "{hit:?}");
        let plain = surface.intersect(&ray).unwrap();
        prop_assert!((plain.t - hit.t).abs() < 1e-7, "{} != {}", plain.t, hit.t);
        let inside = |p: DVec3| f.domain().contains(p.x) && g.domain().contains(p.y);
        let mut side = None;
        for k in 0..400 {
            let p = ray.at((hit.t - 1e-7) * f64::from(k) / 399.0);
            if inside(p) {
                let above = p.z > surface.height(p.x, p.y);
                prop_assert!(side.is_none_or(|side| side == above), "{ray:?} crosses before {hit:?}");
                side = Some(above);
            }
        }
    }
}

proptest! {
    #![proptest_config(config(12))]

    /// Factors up to 0.999 and up to 64 maps: everything terminates, nothing panics, and bounds are
    /// consistent.
    #[test]
    fn near_critical_systems_end(f in affine(0.999), g in affine(0.999), o in prop::array::uniform3(-3.0..3.0_f64)) {
        let surface = HeightField::new(f.view(), g.view()).tabulated();
        let corner = DVec3::new(f.domain().middle(), g.domain().middle(), 0.0);
        let origin = DVec3::from_array(o) * 10.0;
        let hit = surface.intersect(&Ray { origin, direction: corner - origin });
        if let Some(hit) = hit {
            prop_assert!(hit.t >= 0.0 && f.domain().contains(hit.x) && g.domain().contains(hit.y), "{hit:?}");
        }
        let deep = f.evaluate(f.domain().lo + 0.618 * f.domain().width(), 1e-12);
        prop_assert!(deep.value.is_finite() && f.range().inflated(deep.bound).contains(deep.value), "{deep:?}");
        let extrema = f.extrema(1e-6);
        prop_assert!(extrema.maximum.lo <= extrema.maximum.hi && extrema.minimum.lo <= extrema.minimum.hi);
    }
}

#[test]
fn slowest_system_reports_its_depth() {
    // Both factors 0.999: 4096 steps leave 0.999^4096 = 0.017 of the range, and the bound reports
    // it.
    let f = Fif::affine(&[0.0, 0.4, 1.0], &[0.0, 1.0, 0.0], &[0.999, 0.999]).unwrap();
    let got = f.evaluate(0.123, 1e-12);
    let left = 0.999_f64.powi(4096) * 0.5 * f.range().width();
    assert!(got.bound >= left && got.bound <= 1.01 * left, "{got:?}, {left}");
}
