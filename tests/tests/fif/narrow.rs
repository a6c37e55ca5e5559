//! Bounds over intervals of a few units in the last place, against exact arithmetic.
#![expect(clippy::unwrap_used, reason = "a test that cannot build its system has failed")]

use asperity_fif::{Estimate, Fif, HeightField, Interval, RecurrentFif};
use asperity_tests::random::Random;

use super::exact::{Big, Exact};

/// A system and its exact counterpart.
struct Pair<const C: usize> {
    name: String,
    fif: Fif<C>,
    exact: Exact,
}

/// Collects failures, so that one run shows all of them.
#[derive(Default)]
struct Report(Vec<String>, usize);

impl Report {
    fn check(&mut self, what: impl Fn() -> String, value: f64, bound: f64, want: Big) {
        self.1 += 1;
        let within = value.is_finite() && {
            let error = (Big::from(value) - want).abs().approx();
            error <= bound
        };
        if !within {
            self.0.push(format!("{}: {value:e} ± {bound:e}, exact {:e}", what(), want.approx()));
        }
    }

    fn estimate(&mut self, what: impl Fn() -> String, got: Estimate, want: Big) {
        self.check(what, got.value, got.bound, want);
    }

    fn finish(self) {
        let first = self.0.iter().take(40).map(String::as_str).collect::<Vec<_>>().join("\n");
        assert!(self.0.is_empty(), "{} of {} bounds do not hold:\n{first}", self.0.len(), self.1);
    }
}

fn next(x: f64, ulps: u64) -> f64 {
    (0..ulps).fold(x, |x, _| x.next_up())
}

/// Intervals of one to several units in the last place: anywhere, at knots, at both ends of the
/// domain.
fn intervals(x: &[f64], random: &mut Random, count: usize) -> Vec<[f64; 2]> {
    let (first, last) = (x[0], x[x.len() - 1]);
    (0..count)
        .map(|k| {
            let place = match k % 5 {
                0..=2 => first + random.uniform() * (last - first),
                3 => x[(random.uniform() * x.len() as f64) as usize],
                _ => first.max(first + 1e-15) + random.uniform() * 1e-12,
            };
            let ulps = [1, 1, 2, 3, 40][(random.uniform() * 5.0) as usize];
            let below = (random.uniform() * 2.0) as u64;
            let l = (0..below).fold(place, |x, _| x.next_down()).max(first);
            [l.min(last), next(l, ulps).min(last)]
        })
        .filter(|[l, r]| r - l > 1e-30)
        .collect()
}

fn knots(random: &mut Random, maps: usize, kind: usize) -> (Vec<f64>, bool) {
    let start = [0.0, -1.0, 4.0 * random.uniform() - 2.0, 1000.1][kind % 4];
    if kind.is_multiple_of(3) {
        let width = [1.0, 3.7][kind / 3 % 2];
        return ((0..=maps).map(|j| start + width * (j as f64 / maps as f64)).collect(), true);
    }
    let mut x = vec![start];
    for j in 0..maps {
        let narrow = kind % 3 == 2 && j % 2 == 1;
        let gap = if narrow { 1e-7 } else { 0.05 + random.uniform() };
        x.push(x[j] + gap);
    }
    (x, false)
}

fn affine(random: &mut Random, kind: usize) -> (Vec<f64>, Pair<2>) {
    let maps = 2 + kind % 4 + kind % 3 / 2;
    let (x, equal) = knots(random, maps, kind);
    let y: Vec<f64> = (0..=maps).map(|_| 4.0 * random.uniform() - 2.0).collect();
    let alpha: Vec<f64> = (0..maps).map(|_| 1.8 * random.uniform() - 0.9).collect();
    let fif = Fif::affine(&x, &y, &alpha).unwrap();
    let exact = Exact::affine(&x, &y, &alpha, equal);
    let name = format!("affine({x:?}, {y:?}, {alpha:?})");
    (x, Pair { name, fif, exact })
}

fn hermite(random: &mut Random, kind: usize) -> (Vec<f64>, Pair<4>) {
    let maps = 2 + kind % 3 + kind % 3 / 2;
    let (x, equal) = knots(random, maps, kind);
    let y: Vec<f64> = (0..=maps).map(|_| 4.0 * random.uniform() - 2.0).collect();
    let slope: Vec<f64> = (0..=maps).map(|_| 4.0 * random.uniform() - 2.0).collect();
    let width = x[maps] - x[0];
    let alpha: Vec<f64> =
        (0..maps).map(|j| (1.8 * random.uniform() - 0.9) * (x[j + 1] - x[j]) / width).collect();
    let fif = Fif::hermite(&x, &y, &slope, &alpha).unwrap();
    let exact = Exact::hermite(&x, &y, &slope, &alpha, equal);
    let name = format!("hermite({x:?}, {y:?}, {slope:?}, {alpha:?})");
    (x, Pair { name, fif, exact })
}

fn check_calculus<const C: usize>(pair: &Pair<C>, places: &[[f64; 2]], report: &mut Report) {
    let Pair { name, fif, exact } = pair;
    for (k, p) in [(0, 1), (1, 1), (2, 1), (0, 2), (1, 2), (0, 3)] {
        let moments = exact.moments(k, p);
        for &[l, r] in places {
            let (want, length) = (moments.over(l, r), Big::from(r) - Big::from(l));
            let at = |what: &str| format!("{name}.{what} over {l:?}, {r:?}");
            report.estimate(
                || at(&format!("moment_over({k}, {p})")),
                fif.moment_over(k, p, l, r).unwrap(),
                want,
            );
            match (k, p) {
                (0, 1) => {
                    report.estimate(|| at("integral_over"), fif.integral_over(l, r), want);
                    report.estimate(|| at("mean"), fif.mean(l, r), want.over(length));
                }
                (0, 2) => {
                    report.estimate(|| at("mean_square"), fif.mean_square(l, r).unwrap(), want.over(length));
                }
                _ => {}
            }
        }
    }
}

#[test]
fn integral_over_one_ulp_unequal_knots() {
    let (x, y) = ([-1.0, 0.4, 1.4, 2.7], [0.3, 1.0, -0.5, 0.25]);
    let alpha = [0.4, -0.6, 0.95];
    let fif = Fif::affine(&x, &y, &alpha).unwrap();
    let pair = Pair { name: "f".into(), fif, exact: Exact::affine(&x, &y, &alpha, false) };
    let mean = pair.fif.mean(0.170_904_910_825_903_3, 0.170_904_910_825_903_34);
    assert!((mean.value - 0.729_724_97).abs() < 1e-7 && mean.bound < 1e-10, "{mean:?}");
    let moment =
        pair.fif.moment_over(1, 1, 0.625_686_116_448_412_2, next(0.625_686_116_448_412_2, 1)).unwrap();
    assert!(moment.value > 3e-17 && moment.bound < 1e-26, "{moment:?}");
    let mut report = Report::default();
    let mut places = intervals(&x, &mut Random(1), 40);
    places.extend([
        [0.170_904_910_825_903_3, 0.170_904_910_825_903_34],
        [0.625_686_116_448_412_2, next(0.625_686_116_448_412_2, 1)],
    ]);
    check_calculus(&pair, &places, &mut report);
    report.finish();
}

#[test]
fn calculus_over_few_ulps_affine() {
    let mut report = Report::default();
    let mut random = Random(5);
    for kind in 0..24 {
        let (x, pair) = affine(&mut random, kind);
        check_calculus(&pair, &intervals(&x, &mut random, 10), &mut report);
    }
    report.finish();
}

#[test]
fn calculus_over_few_ulps_hermite() {
    let mut report = Report::default();
    let mut random = Random(6);
    for kind in 0..9 {
        let (x, pair) = hermite(&mut random, kind);
        check_calculus(&pair, &intervals(&x, &mut random, 4), &mut report);
    }
    report.finish();
}

#[test]
fn calculus_next_to_zero() {
    let mut report = Report::default();
    for (x, equal) in
        [(vec![0.0, 0.5, 1.0], true), (vec![0.0, 0.3, 1.0], false), (vec![0.0, 1.0, 3.7], false)]
    {
        let (y, alpha) = ([0.3, 1.0, -0.5], [0.4, -0.9]);
        let fif = Fif::affine(&x, &y, &alpha).unwrap();
        let pair = Pair { name: format!("{x:?}"), fif, exact: Exact::affine(&x, &y, &alpha, equal) };
        let places = [[0.0, 1e-40], [1e-30, next(1e-30, 3)], [1e-40, next(1e-40, 1)]];
        check_calculus(&pair, &places, &mut report);
    }
    report.finish();
}

#[test]
fn area_means_over_few_ulps() {
    let mut report = Report::default();
    let mut random = Random(7);
    for kind in 0..9 {
        let ((x, f), (y, g)) = (hermite(&mut random, kind), hermite(&mut random, kind + 1));
        let surface = HeightField::new(f.fif.view(), g.fif.view());
        let lines = |pair: &Pair<4>, [l, r]: [f64; 2]| {
            let length = Big::from(r) - Big::from(l);
            let over = |integral: Big| integral.over(length);
            let slope = pair.exact.derivative();
            let [a, b] = [l, r].map(|x| pair.exact.value(x));
            let half = Big::from(0.5);
            [
                over(pair.exact.moment(0, 1, l, r)),
                over(pair.exact.moment(0, 2, l, r)),
                over(b - a),
                over(slope.moment(0, 2, l, r)),
                over(half * (b * b - a * a)),
            ]
        };
        let places = intervals(&x, &mut random, 4).into_iter().zip(intervals(&y, &mut random, 4));
        for (over_x, over_y) in places {
            let (a, b) = (lines(&f, over_x), lines(&g, over_y));
            let means = surface
                .area_means(Interval::new(over_x[0], over_x[1]), Interval::new(over_y[0], over_y[1]))
                .unwrap();
            let at = |what: &str| format!("{} × {}, {what} over {over_x:?} × {over_y:?}", f.name, g.name);
            report.estimate(|| at("height"), means.height, a[0] * b[0]);
            report.estimate(|| at("height_squared"), means.height_squared, a[1] * b[1]);
            // Narrow cells may have slopes that are discontinuous within the tolerance.
            let Some(slopes) = means.slopes else { continue };
            report.estimate(|| at("slope x"), slopes.slope[0], a[2] * b[0]);
            report.estimate(|| at("slope y"), slopes.slope[1], a[0] * b[2]);
            report.estimate(|| at("squared x"), slopes.squared[0], a[3] * b[1]);
            report.estimate(|| at("squared y"), slopes.squared[1], a[1] * b[3]);
            report.estimate(|| at("product"), slopes.product, a[4] * b[4]);
        }
    }
    report.finish();
}

#[test]
fn integrals_from_the_left_end_over_few_ulps() {
    let mut report = Report::default();
    let mut random = Random(8);
    for kind in 0..12 {
        let (x, pair) = affine(&mut random, kind);
        let Pair { name, fif, exact } = &pair;
        let (y, alpha): (Vec<f64>, Vec<f64>) = (
            fif.pieces().iter().map(|p| p.y()[0]).chain([fif.end_values()[1]]).collect(),
            fif.pieces().iter().map(|p| p.map().alpha).collect(),
        );
        let recurrent = RecurrentFif::affine(&x, &y, &alpha, &vec![[0, alpha.len()]; alpha.len()]).unwrap();
        let (table, [whole, first]) = (fif.table(1e-6).ok(), [0, 1].map(|k| exact.moments(k, 1)));
        for [l, r] in intervals(&x, &mut random, 8) {
            for end in [l, r] {
                let want = whole.over(x[0], end);
                let at = |what: &str| format!("{name}.{what} to {end:?}");
                report.estimate(|| at("nth_integral(1)"), fif.nth_integral(1, end).unwrap(), want);
                // ∫∫ f = x ∫ f − ∫ x f.
                let twice = Big::from(end) * want - first.over(x[0], end);
                report.estimate(|| at("nth_integral(2)"), fif.nth_integral(2, end).unwrap(), twice);
                let got = recurrent.integral(end);
                report.check(|| at("recurrent integral"), got.value, got.bound, want);
                if let Some(table) = &table {
                    let got = table.evaluate_jet(end).integral;
                    report.check(|| at("table integral"), got.value, got.bound, want);
                }
            }
        }
    }
    report.finish();
}

#[test]
fn table_integrals_of_smooth_functions_over_few_ulps() {
    let mut report = Report::default();
    let mut random = Random(9);
    for kind in 0..9 {
        let (x, pair) = hermite(&mut random, kind);
        let Pair { name, fif, exact } = &pair;
        let (table, whole) = (fif.table(1e-9).unwrap(), exact.moments(0, 1));
        for [l, r] in intervals(&x, &mut random, 4) {
            for end in [l, r] {
                let got = table.evaluate_jet(end).integral;
                let want = whole.over(x[0], end);
                report.check(|| format!("{name}.table to {end:?}"), got.value, got.bound, want);
            }
        }
    }
    report.finish();
}

#[test]
fn whole_integrals_and_inner_products_narrow_cells() {
    let mut report = Report::default();
    let mut random = Random(10);
    for kind in 0..12 {
        let (x, pair) = affine(&mut random, kind);
        let Pair { name, fif, exact } = &pair;
        let (first, last) = (x[0], x[x.len() - 1]);
        for (k, p) in [(0, 1), (1, 1), (3, 1), (0, 2), (1, 2), (0, 4)] {
            let got = fif.moment(k, p).unwrap();
            report.estimate(|| format!("{name}.moment({k}, {p})"), got, exact.moment(k, p, first, last));
        }
        let product = fif.inner_product(fif).unwrap();
        report.estimate(|| format!("{name}.inner_product"), product, exact.moment(0, 2, first, last));
        let sum = fif.integral_over(first, last);
        report.estimate(|| format!("{name}.integral_over"), sum, exact.moment(0, 1, first, last));
    }
    report.finish();
}
