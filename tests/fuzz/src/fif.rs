//! Fractal interpolation functions: any data is rejected, or gives a function with consistent
//! bounds.

use asperity_fif::{Fif, FixedFif, Interval, RecurrentFif, box_dimension, fit, oscillation_exponent};

use crate::numbers::Numbers;

/// Returns knots, mostly in order.
fn knots(numbers: &mut Numbers<'_>) -> Vec<f64> {
    let mut x = numbers.list(8, Numbers::double);
    if numbers.byte() < 220 {
        x.sort_by(f64::total_cmp);
        x.dedup();
    }
    x
}

fn factor(numbers: &mut Numbers<'_>) -> f64 {
    match numbers.byte() {
        0..=219 => 1.998 * f64::from(numbers.share()) - 0.999,
        _ => numbers.double(),
    }
}

/// Checks an invariant of every system.
fn system<const C: usize>(f: &Fif<C>, numbers: &mut Numbers<'_>) {
    let (domain, range) = (f.domain(), f.range());
    assert!(
        domain.lo < domain.hi && range.lo <= range.hi && range.magnitude().is_finite(),
        "{domain} {range}"
    );
    let searches = numbers.is_one_in(8);
    match (searches, numbers.byte() % 4) {
        (false, 0) => values(f, numbers),
        (false, 1) => integrals(f, numbers),
        (false, 2) => shape(f, numbers),
        (false, _) => sums(f, numbers),
        (true, 0 | 1) => extrema(f, numbers),
        (true, 2) => table(f, numbers),
        (true, _) => {
            let x = numbers.double();
            assert_eq!(f.conditioning(x).is_nan(), x.is_nan(), "{x}");
        }
    }
}

fn values<const C: usize>(f: &Fif<C>, numbers: &mut Numbers<'_>) {
    let (x, tolerance) = (numbers.double(), numbers.double());
    let (domain, range) = (f.domain(), f.range());
    for x in [x, domain.lo + domain.width() * f64::from(numbers.share()), domain.hi] {
        let got = f.evaluate(x, tolerance);
        assert_eq!(got.value.is_nan(), x.is_nan(), "{got:?} at {x}");
        if !x.is_nan() {
            assert!(got.bound >= 0.0 && got.bound.is_finite(), "{got:?} at {x}");
            assert!(range.inflated(got.bound).contains(got.value), "{got:?} at {x} in {range}");
        }
        assert!(f.address(x).take(20).all(|j| j < f.pieces().len()));
    }
    let _ = f.algorithm_two(x, tolerance);
    assert!(f.chaos_game(7).take(20).all(|(x, _)| x.is_finite()));
}

fn integrals<const C: usize>(f: &Fif<C>, numbers: &mut Numbers<'_>) {
    let (x, l, r) = (numbers.double(), numbers.double(), numbers.double());
    for estimate in [f.integral_over(l, r), f.mean(l, r)] {
        assert!(estimate.bound >= 0.0 || estimate.bound.is_nan(), "{estimate:?} over {l} {r}");
    }
    assert!(!f.total_integral().is_nan());
    let (k, p) = (numbers.count(5), numbers.count(5));
    for moment in [f.moment(k, p), f.moment_over(k, p, l, r), f.nth_integral(k, x)] {
        if let Err(error) = moment {
            assert_eq!(error.to_string().lines().count(), 1);
        }
    }
}

fn extrema<const C: usize>(f: &Fif<C>, numbers: &mut Numbers<'_>) {
    let (range, l, r) = (f.range(), numbers.double(), numbers.double());
    let extrema = f.extrema(numbers.tolerance(range.width()));
    assert!(
        extrema.maximum.lo <= extrema.maximum.hi && extrema.minimum.lo <= extrema.minimum.hi,
        "{extrema:?}"
    );
    let _ = f.extrema_over(l, r, numbers.tolerance(range.width()));
    let _ = f.supremum_norm(numbers.tolerance(range.magnitude()));
}

fn shape<const C: usize>(f: &Fif<C>, numbers: &mut Numbers<'_>) {
    let (range, distance) = (f.range(), numbers.double());
    let dimension = f.dimension();
    assert!(dimension.lo >= 1.0 - 1e-12 && dimension.hi <= 2.0 + 1e-12, "{dimension}");
    assert!(f.modulus().at(distance) >= 0.0 || distance.is_nan(), "{distance}");
    let mut grid = [0.0; 9];
    match f.grid(&mut grid) {
        Ok(bound) => {
            assert!(bound >= 0.0 && grid.iter().all(|y| range.inflated(bound).contains(*y)), "{grid:?}")
        }
        Err(error) => assert_eq!(error.to_string().lines().count(), 1),
    }
}

fn sums<const C: usize>(f: &Fif<C>, numbers: &mut Numbers<'_>) {
    if let Ok(other) = &f.scaled(numbers.double()) {
        let x = numbers.double();
        let _ = f.sum(other).map(|sum| sum.evaluate(x, 1e-6));
        let _ = f.inner_product(other);
    }
}

fn table<const C: usize>(f: &Fif<C>, numbers: &mut Numbers<'_>) {
    let x = numbers.double();
    match f.table(numbers.tolerance(f.range().width())) {
        Ok(table) => {
            assert!(table.bound() >= 0.0 && table.bound().is_finite());
            let got = table.evaluate(x);
            assert_eq!(got.value.is_nan(), x.is_nan(), "{got:?} at {x}");
            let _ = (table.jet(x), table.derivatives::<3>(x));
            let small = table.to_f32();
            assert_eq!(small.value(x as f32).is_nan(), x.is_nan(), "{x}");
        }
        Err(error) => assert_eq!(error.to_string().lines().count(), 1),
    }
}

/// Checks an invariant of an affine system, or of its integral.
fn affine(f: &Fif<2>, numbers: &mut Numbers<'_>) {
    if numbers.byte() < 192 {
        system(f, numbers);
    } else if let Ok(integral) = f.integral::<Vec<_>, 3>(numbers.double()) {
        system(&integral, numbers);
        let _ = integral.derivative::<Vec<_>, 2>();
    }
}

fn recurrent(numbers: &mut Numbers<'_>) {
    let x = knots(numbers);
    let y = numbers.list(8, Numbers::double);
    let alpha = numbers.list(8, factor);
    let sources = numbers.list(8, |numbers| [numbers.count(8), numbers.count(8)]);
    match RecurrentFif::affine(&x, &y, &alpha, &sources) {
        Ok(f) => {
            let x = numbers.double();
            let got = f.evaluate(x, numbers.double());
            assert_eq!(got.value.is_nan(), x.is_nan(), "{got:?} at {x}");
            let _ = (f.integral(x), f.range(), f.domain());
        }
        Err(error) => assert_eq!(error.to_string().lines().count(), 1),
    }
}

fn fits(numbers: &mut Numbers<'_>) {
    let x = knots(numbers);
    let mut y: Vec<f64> = x.iter().map(|_| numbers.double()).collect();
    if numbers.byte() < 40 {
        y.pop();
    }
    match fit::knots(&x, &y, numbers.double(), numbers.count(9)) {
        Ok(knots) => {
            let _ = fit::affine(&x, &y, &knots);
            let _ = fit::refine(&x, &y, &knots, 3);
        }
        Err(error) => assert_eq!(error.to_string().lines().count(), 1),
    }
    let knots = numbers.list(5, |numbers| numbers.count(9));
    if let Err(error) = fit::affine(&x, &y, &knots) {
        assert_eq!(error.to_string().lines().count(), 1);
    }
    let values = numbers.list(40, Numbers::double);
    let _ = box_dimension(&values, numbers.count(40));
    let _ = oscillation_exponent(&values, numbers.count(40), numbers.double());
}

pub(crate) fn attack(numbers: &mut Numbers<'_>) {
    match numbers.byte() % 6 {
        0 | 1 => {
            let x = knots(numbers);
            let y: Vec<f64> = x.iter().map(|_| numbers.double()).collect();
            let alpha: Vec<f64> = x.iter().skip(1).map(|_| factor(numbers)).collect();
            match Fif::affine(&x, &y, &alpha) {
                Ok(f) => affine(&f, numbers),
                Err(error) => assert_eq!(error.to_string().lines().count(), 1),
            }
        }
        2 => {
            let x = knots(numbers);
            let alpha = numbers.list(8, factor);
            let q = numbers.list(8, |numbers| [(); 3].map(|()| numbers.double()));
            match Fif::new(&x, &alpha, &q) {
                Ok(f) => system(&f, numbers),
                Err(error) => assert_eq!(error.to_string().lines().count(), 1),
            }
            let fixed = FixedFif::<2, 3>::new(&x, &alpha, &q);
            assert_eq!(fixed.is_ok(), x.len() == 3 && Fif::new(&x, &alpha, &q).is_ok());
        }
        3 => {
            let x = knots(numbers);
            let y: Vec<f64> = x.iter().map(|_| numbers.double()).collect();
            let slopes: Vec<f64> = x.iter().map(|_| numbers.double()).collect();
            let alpha: Vec<f64> = x.iter().skip(1).map(|_| 0.3 * factor(numbers)).collect();
            match Fif::hermite(&x, &y, &slopes, &alpha) {
                Ok(f) => system(&f, numbers),
                Err(error) => assert_eq!(error.to_string().lines().count(), 1),
            }
        }
        4 => recurrent(numbers),
        _ => fits(numbers),
    }
    let (a, b) = (
        Interval::new(numbers.double(), numbers.double()),
        Interval::new(numbers.double(), numbers.double()),
    );
    let _ = (
        a.hull(b),
        a.intersection(b),
        a.sum(b),
        a.product(b),
        a.scaled(numbers.double()),
        a.width(),
        a.middle(),
    );
}
