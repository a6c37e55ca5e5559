//! Values, integrals and extrema of fractal interpolation functions against exact rationals.
#![expect(clippy::unwrap_used, reason = "a test that cannot read its reference has failed")]

use asperity_fif::Fif;
use asperity_tests::fif_systems::{Reference, decimal, digits_of_double, ratio};
use asperity_tests::{even_systems, systems};

/// Largest error allowed where the address is exact; the worst measured is written beside each test.
const EXACT: f64 = 1e-12;

fn check_points<const C: usize, const K: usize, const L: usize>(name: &str) -> [f64; 4] {
    let r = Reference::<C>::load(name);
    let f = &r.system;
    let int1: Fif<K> = f.integral(0.0).unwrap();
    let int2: Fif<L> = int1.integral(0.0).unwrap();
    let mut worst = [0.0_f64; 4];
    for point in r.points() {
        let checks = [
            (f.value_at_address(point.address(), 1e-14), point.y_dec),
            (int1.value_at_address(point.address(), 1e-14), point.int1_dec),
            (int2.value_at_address(point.address(), 1e-14), point.int2_dec),
        ];
        for (k, (got, want)) in checks.into_iter().enumerate() {
            let got = got.unwrap();
            let error = (got.value - want).abs();
            assert!(error <= EXACT, "{name} x = {} ({k}): {got:?} != {want}", point.x);
            assert!(
                error <= got.bound + 4.0 * f64::EPSILON * r.scale(),
                "{name} x = {} ({k}): {got:?} != {want}",
                point.x
            );
            worst[k] = worst[k].max(error);
        }
    }
    for (x, y, integral, address) in r.simple() {
        let got = f.value_at_address(address.iter().copied(), 1e-14).unwrap();
        assert!((got.value - y).abs() <= EXACT, "{name} x = {x}: {got:?} != {y}");
        let got = int1.value_at_address(address.iter().copied(), 1e-14).unwrap();
        assert!((got.value - integral).abs() <= EXACT, "{name} ∫ to {x}: {got:?} != {integral}");
    }
    for p in r.doubles() {
        // The address of the very double, by exact arithmetic on the rational knots.
        let digits = digits_of_double(&r, p.x);
        let got = f.value_at_address(digits.iter().copied(), 1e-14).unwrap();
        let error = (got.value - p.y).abs();
        assert!(error <= EXACT, "{name} x = {}: {got:?} != {}", p.x, p.y);
        worst[3] = worst[3].max(error);
        let got = int1.value_at_address(digits.iter().copied(), 1e-14).unwrap();
        assert!((got.value - p.int1).abs() <= EXACT, "{name} ∫ to {}: {got:?} != {}", p.x, p.int1);
    }
    for (j, piece) in f.pieces().iter().enumerate() {
        let (int1, int2) = (&int1.pieces()[j], &int2.pieces()[j]);
        r.check_integral("integral_system", j, int1.map().alpha, &int1.map().q, int1.y());
        r.check_integral("second_integral_system", j, int2.map().alpha, &int2.map().q, int2.y());
        for (x, y) in piece.x().into_iter().zip(piece.y()) {
            let got = f.evaluate(x, 1e-6);
            assert_eq!((got.value, got.bound), (y, 0.0), "{name} knot {x}");
        }
    }
    worst
}

#[test]
fn values_and_integrals_equal_the_exact_rationals() {
    // Worst measured: f 8e-15, first integral 1e-14, second integral 2e-14, doubles by their exact address 2e-14.
    let worst = [
        check_points::<1, 2, 3>("cantor"),
        check_points::<4, 5, 6>("cubic5"),
        check_points::<2, 3, 4>("nonuni3"),
        check_points::<2, 3, 4>("paper_f"),
        check_points::<2, 3, 4>("paper_g"),
        check_points::<3, 4, 5>("paper_f_int"),
        check_points::<4, 5, 6>("paper_f_int2"),
        check_points::<3, 4, 5>("paper_g_int"),
        check_points::<2, 3, 4>("parabola"),
        check_points::<2, 3, 4>("takagi"),
    ];
    println!("{worst:?}");
}

fn check_doubles<const C: usize>(name: &str) -> f64 {
    let r = Reference::<C>::load(name);
    let mut bound = 0.0_f64;
    for p in r.doubles() {
        let got = r.system.evaluate(p.x, 1e-13);
        let error = (got.value - p.y).abs();
        assert!(error <= EXACT && error <= got.bound, "{name} x = {}: {got:?} != {}", p.x, p.y);
        bound = bound.max(got.bound);
    }
    bound
}

#[test]
fn values_at_doubles_equal_the_exact_ones() {
    // On equally spaced knots the address of a double is exact; the worst error measured is 5e-14, the worst bound 2e-13.
    for bound in even_systems!(check_doubles) {
        assert!(bound <= EXACT, "bound {bound:e}");
    }
    backward_stable::<2>("nonuni3");
    backward_stable::<4>("cubic5");
}

/// Knots such as 1/5 and −1/3 are no doubles, so the system itself is another one, and so is the point of the float
/// orbit, by a few units in the last place: the exact value must be one that f takes that near. The address of the
/// same doubles, on the exact knots, gives 1e-12 (above).
fn backward_stable<const C: usize>(name: &str) {
    let r = Reference::<C>::load(name);
    let mut worst = 0.0_f64;
    for p in r.doubles() {
        let got = r.system.evaluate(p.x, 1e-13);
        let near = 8.0 * f64::EPSILON * r.system.domain().magnitude();
        let taken = r.system.extrema_over(p.x - near, p.x + near, 1e-13).unwrap().enclosure().inflated(EXACT);
        assert!(taken.contains(p.y), "{name} x = {}: {} not in {taken:?}", p.x, p.y);
        assert!(
            taken.inflated(got.bound).contains(got.value),
            "{name} x = {}: {got:?} not in {taken:?}",
            p.x
        );
        worst = worst.max((got.value - p.y).abs());
    }
    // Measured: 3e-10 and 6e-9, 38 and 37 of 40 points over 1e-12. That is the conditioning, not the sum.
    assert!(worst < 1e-8, "{name}: worst {worst:e}");
}

#[test]
fn extrema_are_bracketed_to_the_requested_width() {
    fn check<const C: usize>(name: &str) {
        let r = Reference::<C>::load(name);
        let json = &r.json["extrema"];
        let bracket = |key: &str| {
            let end = |end: &str| json[format!("{key}_{end}")].as_f64().unwrap();
            (end("lo"), end("hi"))
        };
        for width in [1e-3, 1e-6, 1e-9] {
            let e = r.system.extrema(width);
            for (got, want) in [(e.minimum, bracket("min")), (e.maximum, bracket("max"))] {
                assert!(got.width() <= width, "{name}: {got:?} is wider than {width:e}");
                assert!(got.lo <= want.1 && want.0 <= got.hi, "{name}: {got:?} misses {want:?}");
            }
            let range = r.system.range();
            assert!(range.lo <= e.minimum.hi && e.maximum.lo <= range.hi, "{name}: {range:?} {e:?}");
        }
        let candidate = decimal(&json["max_candidate"]["y_dec"]);
        let found = json["max_candidate"]["inside_bounds"] == true;
        assert!(
            !found || r.system.extrema(1e-6).maximum.inflated(1e-15).contains(candidate),
            "{name}: {candidate}"
        );
    }
    systems!(check);
}

#[test]
fn integrals_over_intervals_are_differences_of_the_integral() {
    fn check<const C: usize, const K: usize>(name: &str) {
        let r = Reference::<C>::load(name);
        let integral: Fif<K> = r.system.integral(0.0).unwrap();
        for (l, right, want) in r.integrals() {
            // Conditioning: the integral's slope is f, so a rounded end costs an ulp of x.
            let got = integral.evaluate(right, 1e-14).value - integral.evaluate(l, 1e-14).value;
            assert!((got - want).abs() <= EXACT, "{name} [{l}, {right}]: {got} != {want}");
        }
        let want = r.moment(0);
        assert!(
            (r.system.total_integral() - want).abs() <= EXACT,
            "{name}: {} != {want}",
            r.system.total_integral()
        );
    }
    check::<1, 2>("cantor");
    check::<4, 5>("cubic5");
    check::<2, 3>("nonuni3");
    check::<2, 3>("paper_f");
    check::<2, 3>("paper_g");
    check::<3, 4>("paper_f_int");
    check::<4, 5>("paper_f_int2");
    check::<3, 4>("paper_g_int");
    check::<2, 3>("parabola");
    check::<2, 3>("takagi");
}

#[test]
fn derivatives_equal_the_exact_ones() {
    fn check<const C: usize, const D: usize>(name: &str) {
        let r = Reference::<C>::load(name);
        let slope: Fif<D> = r.system.derivative().unwrap();
        let mut seen = 0;
        for point in r.points() {
            let Some(want) = point.dy_dec else { continue };
            let got = slope.value_at_address(point.address(), 1e-14).unwrap();
            assert!((got.value - want).abs() <= EXACT, "{name} x = {}: {got:?} != {want}", point.x);
            seen += 1;
        }
        for p in r.doubles() {
            let Some(want) = p.dy else { continue };
            let got = slope.evaluate(p.x, 1e-13);
            assert!((got.value - want).abs() <= EXACT, "{name} x = {}: {got:?} != {want}", p.x);
            seen += 1;
        }
        assert!(seen >= 80, "{name}: only {seen} slopes in the reference");
    }
    check::<3, 2>("paper_f_int");
    check::<4, 3>("paper_f_int2");
    check::<3, 2>("paper_g_int");
    check::<2, 1>("parabola");
}

#[test]
fn ratios_are_read_exactly() {
    assert_eq!(ratio("-1/3"), -1.0 / 3.0);
    assert_eq!(ratio("2"), 2.0);
}
