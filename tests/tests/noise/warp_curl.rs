//! Domain warping and curl noise: gradients and Jacobians against differences, and zero divergence
//! up to rounding.

use asperity_noise::{
    Fbm, FbmSpectrum, Field, GaussianFbm, GaussianNoise, HasHessian, Perlin, Point, Rotation, Simplex,
    Turbulence, Warp,
    curl::{Curl2, Curl3, CurlPotential},
    glam::{Vec2, Vec3},
};
use asperity_tests::random::Random;

const H: f32 = 1.0 / 512.0;
/// Half the spacing of `f32` at 1.
const U: f64 = f64::EPSILON * 268_435_456.0;

/// Returns coordinates within ±8 with twelve fractional bits.
fn point<V: Point<Coordinates = [f32; N]>, const N: usize>(random: &mut Random) -> V {
    V::from_coordinates([(); N].map(|()| ((random.uniform() - 0.5) * 65_536.0).round() as f32 / 4096.0))
}

/// Returns the maximum difference between a Jacobian, row by row, and central differences of a map,
/// relative to the largest entry.
fn jacobian_error<V: Point<Coordinates = [f32; N]>, const N: usize, const M: usize>(
    map: impl Fn(V) -> [f32; M],
    jacobian: impl Fn(V) -> [[f32; N]; M],
) -> f64 {
    let mut random = Random(21);
    let (mut worst, mut largest) = (0.0_f64, 0.0_f64);
    for _ in 0..200 {
        let p: V = point(&mut random);
        let rows = jacobian(p);
        for axis in 0..N {
            let [ahead, behind] = [H, -H].map(|h| {
                let mut q = p.coordinates();
                q[axis] += h;
                map(V::from_coordinates(q))
            });
            for row in 0..M {
                let expected = f64::from(ahead[row] - behind[row]) / f64::from(2.0 * H);
                largest = largest.max(expected.abs());
                worst = worst.max((f64::from(rows[row][axis]) - expected).abs());
            }
        }
    }
    worst / largest
}

/// H²/6 times a third derivative, which is a few hundred times the first for octaves up to
/// frequency 2.17, plus the rounding of values, 4e-7, over H. Maximum seen 1.7e-3.
const TOLERANCE: f64 = 4e-3;

fn assert_close(name: &str, error: f64) {
    assert!(error < TOLERANCE, "{name}: {error:e}");
}

#[test]
fn warps_have_exact_gradients_and_jacobians() {
    let by = [1, 2, 3].map(|seed| Fbm::<_, Vec3>::new(Simplex::new(seed), FbmSpectrum::CLOUD));
    let field = Perlin::new(4);
    let warp = Warp::new(field, by.each_ref().map(|octaves| octaves.with_octaves(1.0)), 0.2).unwrap();
    let gradient = |p: Vec3| [warp.sample(p).gradient.to_array()];
    assert_close("warp", jacobian_error(|p: Vec3| [warp.value(p)], gradient));
    let place = |p: Vec3| warp.displacement(p).point.to_array();
    assert_close("displacement", jacobian_error(place, |p: Vec3| warp.displacement(p).jacobian));

    let by = [5, 6].map(Perlin::new);
    let inner = Warp::new(Simplex::new(7), by, 0.3).unwrap();
    let twice = Warp::new(inner, by, 0.3).unwrap();
    let gradient = |p: Vec2| [twice.sample(p).gradient.to_array()];
    assert_close("warp of a warp", jacobian_error(|p: Vec2| [twice.value(p)], gradient));
    assert_eq!(twice.value(Vec2::new(0.3, 0.4)), twice.sample(Vec2::new(0.3, 0.4)).value);
}

#[test]
fn warp_evaluates_the_displaced_point() {
    let octaves = Fbm::<_, Vec2>::new(Perlin::new(4), FbmSpectrum::CLOUD);
    let field = octaves.with_shape(Turbulence);
    let by = [1, 2].map(Simplex::new);
    let warp = Warp::new(field.with_octaves(3.0), by, 0.7).unwrap();
    let mut random = Random(1);
    for _ in 0..100 {
        let p: Vec2 = point(&mut random);
        let q = p + 0.7 * Vec2::new(by[0].value(p), by[1].value(p));
        assert_eq!(warp.displacement(p).point, q);
        assert_eq!(warp.value(p), field.value_with_octaves(q, 3.0));
    }
}

#[test]
fn curl_2d_has_zero_divergence() {
    let octaves = Fbm::<_, Vec2>::new(Perlin::new(4), FbmSpectrum::default());
    let flow = Curl2(octaves.with_octaves(1.5));
    let jacobian = |p: Vec2| flow.velocity_and_jacobian(p).jacobian;
    assert_close("flow in the plane", jacobian_error(|p: Vec2| flow.velocity(p).to_array(), jacobian));
    let mut random = Random(2);
    for _ in 0..500 {
        let [[xx, _], [_, yy]] = jacobian(point(&mut random));
        assert_eq!(xx + yy, 0.0);
    }
}

/// Asserts that traces are below a bound, and that some are nonzero, so that the bound is
/// meaningful. They reach a third of it.
fn traces(name: &str, jacobian: impl Fn(Vec3) -> [[f32; 3]; 3], bound: impl Fn(Vec3) -> f64) {
    let mut random = Random(3);
    let (mut largest, mut rounded) = (0.0_f64, 0);
    for _ in 0..1000 {
        let p: Vec3 = point(&mut random);
        let [[x, _, _], [_, y, _], [_, _, z]] = jacobian(p);
        let trace = f64::from(x + y + z).abs();
        largest = largest.max(trace / bound(p));
        rounded += usize::from(trace > 0.0);
    }
    assert!(largest <= 1.0 && rounded > 0, "{name}: {largest}");
}

fn cross_product_has_no_divergence<A: HasHessian<Vec3>, B: HasHessian<Vec3>>(name: &str, a: A, b: B) {
    let flow = Curl3(a, b);
    let jacobian = |p: Vec3| flow.velocity_and_jacobian(p).jacobian;
    assert_close(name, jacobian_error(|p: Vec3| flow.velocity(p).to_array(), jacobian));
    // The trace is a sum of twelve rounded products that cancel in pairs, bit for bit. The
    // remainder is the rounding of at most four sums over each of them: the difference of a cross
    // product, the sum of two, and the trace's own two.
    let bound = |p: Vec3| {
        let (a, b) = (flow.0.sample_with_hessian(p), flow.1.sample_with_hessian(p));
        let mut sum = 0.0;
        for (hessian, gradient) in [(a.hessian, b.gradient), (b.hessian, a.gradient)] {
            for (j, row) in hessian.iter().enumerate() {
                let [k, l] = [(j + 1) % 3, (j + 2) % 3];
                let size = |h: f32, g: f32| (f64::from(h) * f64::from(g)).abs();
                sum += size(row[k], gradient[l]) + size(row[l], gradient[k]);
            }
        }
        4.001 * U * sum
    };
    traces(name, jacobian, bound);
}

#[test]
fn curl_of_pairs_has_zero_divergence_up_to_rounding() {
    let [a, b] = [1, 2].map(|seed| Fbm::<_, Vec3>::new(Perlin::new(seed), FbmSpectrum::default()));
    cross_product_has_no_divergence(
        "pair of octaves",
        a.with_octaves(1.5),
        b.with_rotation(Rotation::Aligned).with_octaves(1.5),
    );
    let [a, b] =
        [1, 2].map(|seed| GaussianFbm::<Vec3>::new(GaussianNoise::new(seed), FbmSpectrum::default()));
    cross_product_has_no_divergence("pair of Gaussian octaves", a.with_octaves(1.5), b.with_octaves(1.5));
    cross_product_has_no_divergence("pair of noises", Perlin::new(1), Simplex::new(2));
}

#[test]
fn curl_of_potentials_has_zero_divergence_up_to_rounding() {
    let potential = [1, 2, 3].map(|seed| Fbm::<_, Vec3>::new(Perlin::new(seed), FbmSpectrum::default()));
    let flow = CurlPotential(potential.each_ref().map(|octaves| octaves.with_octaves(1.5)));
    let jacobian = |p: Vec3| flow.velocity_and_jacobian(p).jacobian;
    assert_close("potential", jacobian_error(|p: Vec3| flow.velocity(p).to_array(), jacobian));
    // Six entries that cancel in pairs, each rounded in its difference and in the trace's two sums.
    let bound = |p: Vec3| {
        let [a, b, c] = flow.0.each_ref().map(|field| field.sample_with_hessian(p).hessian);
        let entries = [c[0][1], b[0][2], a[1][2], c[1][0], b[2][0], a[2][1]];
        3.001 * U * entries.iter().map(|&x| f64::from(x.abs())).sum::<f64>()
    };
    traces("potential", jacobian, bound);
}
