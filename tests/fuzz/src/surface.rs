//! Fractal surfaces and rays: heights are within their bounds, and every ray terminates.

use asperity_fif::{
    Curvature, Fif, FoldedSurface, HeightField, Intersect, Interval, PeriodicSurface, Ray, RoughFoldedSurface,
};
use glam::DVec3;

use crate::numbers::Numbers;

fn direction(numbers: &mut Numbers<'_>) -> DVec3 {
    match numbers.byte() {
        0..=219 => DVec3::new(numbers.share().into(), numbers.share().into(), -f64::from(numbers.share())),
        _ => DVec3::new(numbers.double(), numbers.double(), numbers.double()),
    }
}

/// Checks an invariant of every surface: its heights, its bounds, or a ray.
fn check(surface: &impl Intersect, numbers: &mut Numbers<'_>) {
    let ([x, y], range) = (surface.domain(), surface.range());
    assert!(x.lo < x.hi && y.lo < y.hi);
    match numbers.byte() % 16 {
        0..=6 => {
            let at = [x, y].map(|axis| match numbers.byte() {
                0..=199 => axis.lo + axis.width() * f64::from(numbers.share()),
                _ => numbers.double(),
            });
            let got = surface.evaluate(at[0], at[1], numbers.double());
            assert!(
                at.iter().any(|x| !x.is_finite()) || range.inflated(got.bound).contains(got.value),
                "{got:?} at {at:?} in {range}"
            );
            let _ = surface.gradient_near(at[0], at[1], numbers.double());
        }
        7..=13 => {
            let box_ = [(); 2].map(|()| Interval::new(numbers.double(), numbers.double()));
            let _ = surface.bounds(box_[0], box_[1]);
        }
        // On an almost maximally rough surface, 2¹⁶ evaluations.
        kind if numbers.is_one_in(512) => ray(surface, kind == 14, numbers),
        _ => {}
    }
}

fn ray(surface: &impl Intersect, first: bool, numbers: &mut Numbers<'_>) {
    let ([x, y], range) = (surface.domain(), surface.range());
    let target = DVec3::new(x.middle(), y.middle(), range.middle());
    let direction = direction(numbers);
    let origin = if numbers.byte() < 220 { target - 2.0 * direction } else { direction };
    let (ray, reach) = (Ray { origin, direction }, Interval::new(numbers.double(), numbers.double()));
    let hit = if first {
        surface.intersect(&ray)
    } else {
        let _ = surface.occluded(&ray, reach);
        surface.intersect_within(&ray, reach, numbers.tolerance(range.width()))
    };
    if let Some(hit) = hit {
        assert!(hit.t >= 0.0 && x.contains(hit.x) && y.contains(hit.y), "{ray:?}: {hit:?}");
    }
}

/// Returns a system of three maps with slopes, from ordinary or arbitrary data.
fn curve(numbers: &mut Numbers<'_>) -> Option<Fif<4>> {
    let width = if numbers.byte() < 200 { 1.0 } else { numbers.between(1e-9, 1e9).into() };
    let x = [0.0, 0.3 * width, 0.6 * width, width];
    let data: [f64; 8] = std::array::from_fn(|_| match numbers.byte() {
        0..=239 => 4.0 * f64::from(numbers.share()) - 2.0,
        _ => numbers.double(),
    });
    let alpha: [f64; 3] = std::array::from_fn(|_| 0.58 * f64::from(numbers.share()) - 0.29);
    Fif::hermite(&x, &data[..4], &data[4..], &alpha).ok()
}

fn nodes<const N: usize>(numbers: &mut Numbers<'_>) -> ([f64; N], [[f64; 2]; N]) {
    let mut number = || match numbers.byte() {
        0..=239 => 4.0 * f64::from(numbers.share()) - 2.0,
        _ => numbers.double(),
    };
    (std::array::from_fn(|_| number()), std::array::from_fn(|_| [number(), number()]))
}

pub(crate) fn attack(numbers: &mut Numbers<'_>) {
    let factor = if numbers.byte() < 220 { 1.2 * f64::from(numbers.share()) - 0.6 } else { numbers.double() };
    match numbers.byte() % 4 {
        0 => {
            let (Some(f), Some(g)) = (curve(numbers), curve(numbers)) else { return };
            let surface = HeightField::new(f, g);
            check(&surface, numbers);
            let _ = surface.normal(numbers.double(), numbers.double());
            let _ = surface.area_means(Interval::new(0.1, 0.4), Interval::new(0.0, 0.2));
            if numbers.byte() < 20 {
                check(&surface.tabulated_with(16), numbers);
            }
        }
        // Its ranges are expensive.
        1 if numbers.is_one_in(256) => {
            let (z, d) = nodes::<4>(numbers);
            let matrix = [(); 2].map(|()| {
                [(); 2].map(|()| {
                    if numbers.byte() < 220 { numbers.count(4) as i32 - 2 } else { numbers.word() as i32 }
                })
            });
            match PeriodicSurface::new(2, matrix, factor, &z, &d) {
                Ok(torus) => {
                    check(&torus, numbers);
                    let _ = torus.evaluate_ratio(
                        [i64::from(numbers.word()), -3],
                        numbers.word(),
                        numbers.double(),
                    );
                    let _ = torus.mean_over(Interval::new(0.0, 0.3), Interval::new(0.1, 0.2), 4);
                }
                Err(error) => assert_eq!(error.to_string().lines().count(), 1),
            }
        }
        1 | 2 => {
            let (z, d) = nodes::<9>(numbers);
            let knots =
                [(); 2].map(|()| [0.0, 0.5, if numbers.byte() < 220 { 1.0 } else { numbers.double() }]);
            match FoldedSurface::new(&knots[0], &knots[1], factor, &z, &d) {
                Ok(folded) => check(&folded, numbers),
                Err(error) => assert_eq!(error.to_string().lines().count(), 1),
            }
        }
        _ => {
            let (z, d) = nodes::<9>(numbers);
            let factors: [f64; 9] = std::array::from_fn(|_| 1.8 * f64::from(numbers.share()) - 0.9);
            match RoughFoldedSurface::new(&[0.0, 0.4, 1.0], &[0.0, 0.5, 1.0], &factors, &z, &d) {
                Ok(folded) => check(&folded, numbers),
                Err(error) => assert_eq!(error.to_string().lines().count(), 1),
            }
        }
    }
    let curvature = Curvature::of_graph(
        glam::DVec2::new(numbers.double(), numbers.double()),
        [numbers.double(), numbers.double(), numbers.double()],
    );
    let _ = curvature.principal();
}
