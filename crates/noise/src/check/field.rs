//! Checks of a field, optionally with second derivatives.

use alloc::{format, string::String, vec, vec::Vec};

use asperity_core::check::{Limit, Report, Settings};

use crate::{
    check::{
        difference::{REACH, root_mean_square, slope},
        settings::points,
    },
    contract::field::{Field, HasHessian},
    point::Point,
    row::grid::Grid,
    sample::Sample,
};

/// The number of points at which slopes are compared.
const POINTS: usize = 1024;

/// The largest accepted error of a slope beyond the error of the differences, over the root mean
/// square slope.
const SLOPE: f64 = 1e-3;

/// The accepted excess over a range, relative to its width, for the rounding of values.
const RANGE: f64 = 1e-6;

/// Checks of a [`Field`]: gradients, range, lists and grids, totality.
///
/// - **gradient:** its components match finite differences within a thousandth of the root mean
///   square slope plus the error of the differences. They must match at nine of ten points along
///   each axis, so that kinks are allowed.
/// - **range:** no value at 4096 points is beyond [`Field::range`].
/// - **lists and grids:** [`Field::value`], lists and grids have the bits of [`Field::sample`],
///   also at odd points.
/// - **totality:** values and gradients are finite at NaN, infinities, and huge and tiny numbers.
///
/// # Accuracy
///
/// Differences `D(h)` use steps from 2⁻¹⁴ to 2⁻⁴, as long as they agree. Their error is bounded by
/// `|D(h) − D(2h)|`, half of the second difference over `h`, and the rounding of values and
/// positions over `h`. The step with the smallest bound is used. The report contains the median
/// bound: an error of a gradient that is smaller everywhere is not detected.
///
/// ```
/// use asperity_noise::{Field, Perlin, Sample, check, glam::Vec2};
///
/// /// A custom field whose gradient is wrong by a hundredth along y.
/// struct Off(Perlin);
/// impl Field<Vec2> for Off {
///     fn sample(&self, p: Vec2) -> Sample<Vec2> {
///         let Sample { value, gradient } = self.0.sample(p);
///         Sample { value, gradient: gradient * Vec2::new(1.0, 1.01) }
///     }
/// }
///
/// let report = check::field(&Off(Perlin::new(1)), check::Settings::default());
/// assert!(report.failures().eq(["gradient"]), "{report}");
/// ```
#[must_use]
pub fn field<V: Point, F: Field<V> + ?Sized>(field: &F, settings: Settings) -> Report {
    let mut report = Report::default();
    let gradients =
        Slopes { functions: 1, f: &|_, p| field.value(p), slope: &|_, p| field.sample(p).gradient };
    gradients.add(&mut report, "gradient", "|∇f − differences|/|∇f|, exceeded at a tenth", settings);
    add_range(&mut report, field, settings);
    add_batches(&mut report, field, settings);
    add_totality(&mut report, field);
    report
}

/// Checks of a [`HasHessian`] field: the checks of [`field`](field()), and Hessians.
///
/// - **bits:** value and gradient of [`HasHessian::sample_with_hessian`] equal the sample, and the
///   Hessian is symmetric, bit for bit.
/// - **Hessian:** its rows match finite differences of the gradient, with the same limits as
///   gradients.
///
/// ```
/// use asperity_noise::{Simplex, check, glam::Vec3};
///
/// let report = check::hessian::<Vec3, _>(&Simplex::new(1), check::Settings::default());
/// assert!(report.passed(), "{report}");
/// ```
#[must_use]
pub fn hessian<V: Point, F: HasHessian<V> + ?Sized>(of: &F, settings: Settings) -> Report
where
    V::Matrix: AsRef<[V::Coordinates]>,
{
    let mut report = field(of, settings);
    let (mut point, mut broken) = (points(settings, 2, REACH), Broken::default());
    for p in (0..POINTS).map(|_| point()) {
        let (there, sample) = (of.sample_with_hessian(p), of.sample(p));
        let entry = |i: usize, j: usize| there.hessian.as_ref()[i].as_ref()[j];
        let symmetric =
            (0..axes::<V>()).all(|i| (0..i).all(|j| entry(i, j).to_bits() == entry(j, i).to_bits()));
        let same = same(there.value, sample.value) && same_point(there.gradient, sample.gradient);
        broken.unless(symmetric && same, || format!("second_order({p:?}) = {there:?}, sample {sample:?}"));
    }
    broken.add(&mut report, "bits of second order", "cases with different bits");
    let hessians = Slopes {
        functions: axes::<V>(),
        f: &|i, p| of.sample(p).gradient.coordinates().as_ref()[i],
        slope: &|i, p| V::from_coordinates(of.sample_with_hessian(p).hessian.as_ref()[i]),
    };
    hessians.add(&mut report, "Hessian", "|H − differences|/|H|, exceeded at a tenth", settings);
    report
}

/// The number of axes.
pub(super) fn axes<V: Point>() -> usize {
    V::default().coordinates().as_ref().len()
}

/// Functions with their slopes.
struct Slopes<'a, V> {
    functions: usize,
    f: &'a dyn Fn(usize, V) -> f32,
    slope: &'a dyn Fn(usize, V) -> V,
}

impl<V: Point> Slopes<'_, V> {
    /// Adds the difference of slopes from finite differences.
    fn add(&self, report: &mut Report, name: &'static str, quantity: &'static str, settings: Settings) {
        let mut point = points(settings, 0, REACH);
        let cases: Vec<(V, usize)> = (0..POINTS).map(|k| (point(), k % self.functions)).collect();
        let size = cases.iter().fold(0.0, |most: f64, &(p, i)| most.max(f64::from((self.f)(i, p)).abs()));
        let slopes: Vec<V::Coordinates> =
            cases.iter().map(|&(p, i)| (self.slope)(i, p).coordinates()).collect();
        let steep = root_mean_square(slopes.iter().flat_map(AsRef::as_ref).map(|&x| f64::from(x)));
        // A constant function has no slope to compare with.
        let scale = steep.max(1e-3 * size).max(f64::MIN_POSITIVE);
        let mut bounds = Vec::new();
        let mut errors: Vec<Vec<(f64, V)>> = (0..axes::<V>()).map(|_| Vec::new()).collect();
        for (&(p, i), slopes) in cases.iter().zip(&slopes) {
            for (axis, &stated) in slopes.as_ref().iter().enumerate() {
                let [difference, bound] = slope(&|p| f64::from((self.f)(i, p)), p, axis, size, steep);
                let error = (f64::from(stated) - difference).abs() - bound;
                errors[axis].push((if error <= 0.0 { 0.0 } else { error / scale }, p));
                bounds.push(bound / scale);
            }
        }
        let (mut worst, mut place) = (0.0_f64, String::new());
        for (axis, errors) in errors.iter_mut().enumerate() {
            let most = errors.len() * 9 / 10;
            let (_, &mut (error, p), _) = errors.select_nth_unstable_by(most, |a, b| a.0.total_cmp(&b.0));
            if error > worst || error.is_nan() {
                (worst, place) = (error, format!("along axis {axis} at {p:?}, "));
            }
        }
        let middle = bounds.len() / 2;
        let median = *bounds.select_nth_unstable_by(middle, f64::total_cmp).1;
        let place = format!("{place}half of the differences are within {median:.0e}");
        report.add(name, quantity, worst, Limit::AtMost(SLOPE), place);
    }
}

/// Adds the excess of values over the range.
fn add_range<V: Point, F: Field<V> + ?Sized>(report: &mut Report, field: &F, settings: Settings) {
    let [low, high] = field.range().map(f64::from);
    let mut point = points(settings, 1, REACH);
    let (mut worst, mut place) = (0.0_f64, String::new());
    for p in (0..4 * POINTS).map(|_| point()) {
        let value = f64::from(field.value(p));
        let beyond = (value - high).max(low - value) / (high - low);
        if beyond > worst || value.is_nan() {
            (worst, place) = (if value.is_nan() { value } else { beyond }, format!("{value} at {p:?}"));
        }
    }
    report.add("range", "excess over the width", worst, Limit::AtMost(RANGE), place);
}

/// Whether both are the same number or both NaN.
fn same(a: f32, b: f32) -> bool {
    a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan()
}

fn same_point<V: Point>(a: V, b: V) -> bool {
    let (a, b) = (a.coordinates(), b.coordinates());
    a.as_ref().iter().zip(b.as_ref()).all(|(&a, &b)| same(a, b))
}

/// Whether value and gradient are the same.
pub(super) fn same_sample<V: Point>(a: Sample<V>, b: Sample<V>) -> bool {
    same(a.value, b.value) && same_point(a.gradient, b.gradient)
}

/// Adds the check that values, lists and grids have the bits of samples.
fn add_batches<V: Point, F: Field<V> + ?Sized>(report: &mut Report, field: &F, settings: Settings) {
    let mut broken = Broken::default();
    let mut point = points(settings, 3, 64.0);
    let points: Vec<V> = (0..999).map(|_| point()).chain(odd_points()).collect();
    let expected: Vec<Sample<V>> = points.iter().map(|&p| field.sample(p)).collect();
    let (mut values, mut samples) = (vec![0.0; points.len()], vec![Sample::default(); points.len()]);
    let _ = (field.values(&points, &mut values), field.samples(&points, &mut samples));
    for (((&p, &expected), &value), &sample) in points.iter().zip(&expected).zip(&values).zip(&samples) {
        broken.unless(same(field.value(p), expected.value), || format!("value({p:?})"));
        broken.unless(same(value, expected.value), || format!("values at {p:?}: {value}"));
        broken.unless(same_sample(sample, expected), || format!("samples at {p:?}: {sample:?}"));
    }

    // Rows whose length is not a multiple of the lanes, over several cells and within one.
    for step in [0.37, 1.0 / 256.0] {
        let grid = Grid {
            origin: point(),
            step: V::from_axes(|axis| if axis == 0 { step } else { 0.71 }),
            size: V::array(|axis| [53, 5, 3, 2][axis.min(3)]),
        };
        let (mut values, mut with) = (vec![0.0; grid.len()], vec![0.0; grid.len()]);
        let mut gradients: Vec<Vec<f32>> = (0..axes::<V>()).map(|_| vec![0.0; grid.len()]).collect();
        let mut lists = gradients.iter_mut();
        let lists = V::array(|_| lists.next().map_or(&mut [][..], |list| &mut list[..]));
        let _ = (field.grid_values(&grid, &mut values), field.grid_samples(&grid, &mut with, lists));
        for (k, (&value, &sampled)) in values.iter().zip(&with).enumerate() {
            let p = grid.point(grid.index(k % grid.width(), k / grid.width()));
            let sample = field.sample(p);
            broken.unless(same(value, sample.value), || format!("grid_values at {p:?}: {value}"));
            let gradient = V::from_axes(|axis| gradients[axis][k]);
            let got = Sample { value: sampled, gradient };
            broken.unless(same_sample(got, sample), || format!("grid_samples at {p:?}: {got:?}"));
        }
    }
    broken.add(report, "lists and grids", "points with different bits");
}

/// Points with one odd coordinate, and points with odd coordinates only.
fn odd_points<V: Point>() -> impl Iterator<Item = V> {
    const ODD: [f32; 14] = [
        f32::NAN,
        f32::INFINITY,
        f32::NEG_INFINITY,
        0.0,
        -0.0,
        1e-40,
        f32::MIN_POSITIVE,
        8_388_607.5,
        -16_777_218.0,
        2_147_483_648.0,
        -2_147_483_904.0,
        1e19,
        f32::MAX,
        f32::MIN,
    ];
    let places = axes::<V>() + 1;
    ODD.into_iter().flat_map(move |x| {
        (0..places).map(move |k| V::from_axes(|axis| if axis == k || k + 1 == places { x } else { 0.3 }))
    })
}

/// Adds the check that samples are total.
fn add_totality<V: Point, F: Field<V> + ?Sized>(report: &mut Report, field: &F) {
    let mut broken = Broken::default();
    for p in odd_points::<V>() {
        let sample = field.sample(p);
        let finite =
            sample.value.is_finite() && sample.gradient.coordinates().as_ref().iter().all(|x| x.is_finite());
        broken.unless(finite, || format!("sample({p:?}) = {sample:?}"));
    }
    broken.add(report, "totality", "points with a non-finite result");
}

/// Counts violations, with the first case.
#[derive(Default)]
pub(super) struct Broken {
    count: u32,
    first: String,
}

impl Broken {
    pub(super) fn unless(&mut self, kept: bool, case: impl FnOnce() -> String) {
        if !kept {
            if self.count == 0 {
                self.first = case();
            }
            self.count += 1;
        }
    }

    pub(super) fn add(self, report: &mut Report, name: &'static str, quantity: &'static str) {
        let Self { count, first } = self;
        report.add(name, quantity, f64::from(count), Limit::AtMost(0.0), first);
    }
}
