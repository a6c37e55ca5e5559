//! Whitened gradients of Gaussian noise are two independent N(0, 1) at every position of a cell, in
//! every tangent plane and for every number of octaves.

use asperity_noise::{
    FbmSpectrum, GaussianFbm, GaussianNoise, Point,
    glam::{DMat2, DVec2, Vec2, Vec3},
};
use asperity_tests::assert_abs_diff_eq;
use asperity_tests::histogram::Histogram;
use asperity_tests::random::Random;
use rayon::prelude::*;

fn sum<V: Point<Coordinates = [f32; N]>, const N: usize>(seed: u32) -> GaussianFbm<V> {
    GaussianFbm::new(GaussianNoise::new(seed), FbmSpectrum::default())
}

/// The map of the first octave into its lattice: matrix by rows, and offset.
struct Octave<const N: usize> {
    matrix: [[f32; N]; N],
    offset: [f32; N],
}

/// A sum of Gaussian noise with its first octave.
trait FirstOctave<const N: usize> {
    fn octave(&self) -> Octave<N>;
}

impl FirstOctave<2> for GaussianFbm<Vec2> {
    fn octave(&self) -> Octave<2> {
        let layer = self.gpu().layers[0];
        let [a, b, c, d] = layer.rows;
        Octave { matrix: [[a, b], [c, d]], offset: layer.offset }
    }
}

impl FirstOctave<3> for GaussianFbm<Vec3> {
    fn octave(&self) -> Octave<3> {
        let layer = self.gpu().layers[0];
        let rows = [layer.row_x, layer.row_y, layer.row_z];
        Octave { matrix: rows.map(|[a, b, c, _]| [a, b, c]), offset: rows.map(|row| row[3]) }
    }
}

/// Returns a random orthonormal pair of vectors.
fn frame<const N: usize>(random: &mut Random) -> [[f64; N]; 2] {
    let mut draw = || std::array::from_fn(|_| random.gaussians()[0]);
    let (a, b): ([f64; N], [f64; N]) = (draw(), draw());
    let dot = |a: &[f64; N], b: &[f64; N]| -> f64 { (0..N).map(|k| a[k] * b[k]).sum() };
    let a = a.map(|x| x / dot(&a, &a).sqrt());
    let along = dot(&a, &b);
    let b: [f64; N] = std::array::from_fn(|k| b[k] - along * a[k]);
    [a, b.map(|x| x / dot(&b, &b).sqrt())]
}

fn vector<V: Point<Coordinates = [f32; N]>, const N: usize>(v: [f64; N]) -> V {
    V::from_axes(|axis| v[axis] as f32)
}

/// Returns the point that the octave maps to `q`, for a rotation of frequency 1.
fn point_of<const N: usize>(octave: &Octave<N>, q: [f64; N]) -> [f64; N] {
    std::array::from_fn(|k| {
        (0..N).map(|i| f64::from(octave.matrix[i][k]) * (q[i] - f64::from(octave.offset[i]))).sum()
    })
}

/// The variance v of n and the covariance C of ∇n at a position in a cell, corner by corner, with
/// Cov(n, ∇n).
fn covariances<const N: usize>(t: [f64; N]) -> (f64, [f64; N], [[f64; N]; N]) {
    let weight = |t: f64| t * t * t * (t * (t * 6.0 - 15.0) + 10.0);
    let slope = |t: f64| 30.0 * t * t * (t - 1.0) * (t - 1.0);
    let (mut v, mut cross, mut covariance) = (0.0, [0.0; N], [[0.0; N]; N]);
    for corner in 0..1 << N {
        let end: [f64; N] = std::array::from_fn(|k| f64::from(corner >> k & 1));
        let d: [f64; N] = std::array::from_fn(|k| t[k] - end[k]);
        let w: [f64; N] =
            std::array::from_fn(|k| if end[k] == 1.0 { weight(t[k]) } else { 1.0 - weight(t[k]) });
        let dw: [f64; N] = std::array::from_fn(|k| (2.0 * end[k] - 1.0) * slope(t[k]));
        let product = w.iter().product::<f64>();
        let gradient: [f64; N] =
            std::array::from_fn(|i| (0..N).map(|k| if k == i { dw[k] } else { w[k] }).product());
        // The value s has the factor W; component k of the gradient g has 2 W d_k.
        // Their derivatives along i are ∂W and 2 (∂W d_k + W δ_ik).
        v += product * product * (1.0 + 4.0 * d.iter().map(|d| d * d).sum::<f64>());
        let derivative = |i: usize, k: usize| 2.0 * (gradient[i] * d[k] + if i == k { product } else { 0.0 });
        for i in 0..N {
            cross[i] +=
                product * gradient[i] + (0..N).map(|k| 2.0 * product * d[k] * derivative(i, k)).sum::<f64>();
            for j in 0..N {
                covariance[i][j] += gradient[i] * gradient[j]
                    + (0..N).map(|k| derivative(i, k) * derivative(j, k)).sum::<f64>();
            }
        }
    }
    (v, cross, covariance)
}

/// Returns the whitened gradient of one octave in `f64`, from value and gradient of the sum.
fn reference<V: Point<Coordinates = [f32; N]>, const N: usize>(
    sum: &GaussianFbm<V>,
    p: V,
    tangents: [[f64; N]; 2],
) -> DVec2
where
    GaussianFbm<V>: FirstOctave<N>,
{
    let octave = sum.octave();
    let coordinates = p.coordinates();
    let q: [f64; N] = std::array::from_fn(|i| {
        (0..N).map(|k| f64::from(octave.matrix[i][k]) * f64::from(coordinates[k])).sum::<f64>()
            + f64::from(octave.offset[i])
    });
    let turned = |v: [f64; N]| -> [f64; N] {
        std::array::from_fn(|i| (0..N).map(|k| f64::from(octave.matrix[i][k]) * v[k]).sum())
    };
    let (v, cross, covariance) = covariances(q.map(|x| x - x.floor()));
    let sample = sum.sample_with_octaves(p, 1.0);
    let z = f64::from(sample.value);
    let dz = turned(sample.gradient.coordinates().map(f64::from));
    // n = z √v, and ∇v/2 = Cov(n, ∇n).
    let dn: [f64; N] = std::array::from_fn(|i| v.sqrt() * dz[i] + z * cross[i] / v.sqrt());
    let b = tangents.map(turned);
    let product = |x: &[f64; N], y: &[f64; N]| -> f64 {
        (0..N).map(|i| (0..N).map(|j| x[i] * covariance[i][j] * y[j]).sum::<f64>()).sum()
    };
    let along = |x: &[f64; N]| -> f64 { (0..N).map(|i| x[i] * dn[i]).sum() };
    let (uu, uv, vv) = (product(&b[0], &b[0]), product(&b[0], &b[1]), product(&b[1], &b[1]));
    // The inverse root by eigenvectors.
    let angle = 0.5 * (2.0 * uv).atan2(uu - vv);
    let (middle, radius) = (0.5 * (uu + vv), (0.25 * (uu - vv).powi(2) + uv * uv).sqrt());
    let axes = DMat2::from_angle(angle);
    let scaled =
        DMat2::from_diagonal(DVec2::new((middle + radius).sqrt().recip(), (middle - radius).sqrt().recip()));
    axes * scaled * axes.transpose() * DVec2::new(along(&b[0]), along(&b[1]))
}

fn assert_reference<V: Point<Coordinates = [f32; N]>, const N: usize>()
where
    GaussianFbm<V>: FirstOctave<N>,
{
    let (mut random, mut error) = (Random(3), 0.0_f64);
    for seed in 0..2000 {
        let sum = sum::<V, N>(seed);
        let p: V = vector(std::array::from_fn(|_| f64::from(random.coordinate()) / 16.0));
        let tangents = frame::<N>(&mut random);
        let z = sum.whitened_gradient_with_octaves(p, tangents.map(vector), 1.0);
        let z = DVec2::from(z.map(f64::from));
        error = error.max((z - reference(&sum, p, tangents)).abs().max_element());
    }
    // Coordinates of 4 cells have a spacing of 2⁻²², and the second derivatives of z are below 30.
    assert!(error < 2e-5, "{N}-D: {error:e}");
}

#[test]
fn whitened_gradient_matches_eigenvectors_in_f64() {
    assert_reference::<Vec2, 2>();
    assert_reference::<Vec3, 3>();
}

/// Asserts moments of one octave at a position in its cell, over 200,000 cells, each with its own
/// tangent plane.
fn assert_standard_at<V: Point<Coordinates = [f32; N]>, const N: usize>(place: [f64; N])
where
    GaussianFbm<V>: FirstOctave<N>,
{
    const CELLS: usize = 200_000;
    let noise = sum::<V, N>(11);
    let (octave, mut random) = (noise.octave(), Random(17));
    let mut sums = [0.0; 8];
    for _ in 0..CELLS {
        let cell: [f64; N] =
            std::array::from_fn(|k| f64::from((random.coordinate() * 8.0).floor()) + place[k]);
        let tangents = frame::<N>(&mut random).map(vector);
        let [a, b] = noise
            .whitened_gradient_with_octaves(vector(point_of(&octave, cell)), tangents, 1.0)
            .map(f64::from);
        let terms = [a, b, a * a, b * b, a.powi(4), b.powi(4), a * b, (a * a - 1.0) * (b * b - 1.0)];
        for (sum, term) in sums.iter_mut().zip(terms) {
            *sum += term / CELLS as f64;
        }
    }
    // 4.5 standard errors for significance 0.001/144.
    let n = CELLS as f64;
    let [x, y, xx, yy, x4, y4, xy, squares] = sums;
    for (name, value, expected, variance) in [
        ("mean", x, 0.0, 1.0),
        ("mean", y, 0.0, 1.0),
        ("variance", xx, 1.0, 2.0),
        ("variance", yy, 1.0, 2.0),
        ("fourth moment", x4, 3.0, 96.0),
        ("fourth moment", y4, 3.0, 96.0),
        ("correlation", xy, 0.0, 1.0),
        ("correlation of squares", squares, 0.0, 4.0),
    ] {
        let epsilon = 4.5 * f64::sqrt(variance / n);
        assert_abs_diff_eq!(value, expected, epsilon = epsilon, "{name} at {place:?}");
    }
}

#[test]
fn moments_are_equal_at_every_position() {
    for place in [[0.0, 0.0], [0.5, 0.0], [0.0, 0.25], [0.5, 0.5], [0.3, 0.8]] {
        assert_standard_at::<Vec2, 2>(place);
    }
    for place in [[0.0; 3], [0.5, 0.0, 0.0], [0.5, 0.0, 0.5], [0.5; 3], [0.25, 0.0, 0.8], [0.1, 0.7, 0.4]] {
        assert_standard_at::<Vec3, 3>(place);
    }
}

/// Returns histograms of both components over space in random tangent planes, and the mean of their
/// product.
fn over_space<V: Point<Coordinates = [f32; N]>, const N: usize>(
    octaves: f32,
    seeds: u32,
) -> ([Histogram; 2], f64) {
    const POINTS: u32 = 2048;
    let empty = || ([Histogram::new(), Histogram::new()], 0.0);
    let (histograms, product) = (0..seeds)
        .into_par_iter()
        .fold(empty, |(mut histograms, mut product), seed| {
            let (noise, mut random) =
                (sum::<V, N>(seed).with_octaves(octaves), Random(u64::from(seed) << 32 | 5));
            for _ in 0..POINTS {
                let p: V = vector(std::array::from_fn(|_| f64::from(random.coordinate()) * 16.0));
                let z = noise.whitened_gradient(p, frame::<N>(&mut random).map(vector));
                for (histogram, z) in histograms.iter_mut().zip(z) {
                    histogram.add(z);
                }
                product += f64::from(z[0]) * f64::from(z[1]);
            }
            (histograms, product)
        })
        .reduce(empty, |([a, b], product), ([c, d], other)| ([a.join(&c), b.join(&d)], product + other));
    (histograms, product / (f64::from(seeds) * f64::from(POINTS)))
}

fn assert_gaussian<V: Point<Coordinates = [f32; N]>, const N: usize>(octaves: f32, seeds: u32) {
    let (histograms, product) = over_space::<V, N>(octaves, seeds);
    let n = histograms[0].count() as f64;
    let [a, b] = histograms.map(|histogram| histogram.distance());
    // Significance 0.0001: 2.2/√n.
    let limit = 2.2 / n.sqrt();
    assert!(a < limit && b < limit, "{N}-D, {octaves} octaves: {a} {b} (limit {limit})");
    assert_abs_diff_eq!(product, 0.0, epsilon = 4.0 / n.sqrt(), "{N}-D, {octaves} octaves");
}

#[test]
fn whitened_gradient_is_gaussian_for_every_number_of_octaves() {
    for octaves in [1.0, 2.5] {
        assert_gaussian::<Vec2, 2>(octaves, 512);
    }
    for octaves in [0.5, 1.0, 1.5, 3.0, 4.75, 8.0] {
        assert_gaussian::<Vec3, 3>(octaves, 512);
    }
}

/// A hundred million points and more, in 2-D and in tangent planes in 3-D.
#[test]
#[ignore = "slow: weekly"]
fn whitened_gradient_is_gaussian_over_a_hundred_million_points() {
    for octaves in [1.0, 1.5, 2.0, 3.25, 5.0, 8.0] {
        assert_gaussian::<Vec2, 2>(octaves, 6144);
        assert_gaussian::<Vec3, 3>(octaves, 6144);
    }
}

#[test]
fn whitened_gradient_rotates_with_the_tangents() {
    let (noise, mut random) = (sum::<Vec3, 3>(4).with_octaves(5.5), Random(9));
    for _ in 0..1000 {
        let p = Vec3::new(random.coordinate(), random.coordinate(), random.coordinate()) / 8.0;
        let [t, b]: [Vec3; 2] = frame::<3>(&mut random).map(vector);
        let angle = random.uniform() as f32 * 6.0;
        let (sin, cos) = angle.sin_cos();
        let z = Vec2::from(noise.whitened_gradient(p, [t, b]));
        let turned = Vec2::from(noise.whitened_gradient(p, [cos * t + sin * b, cos * b - sin * t]));
        let expected = Vec2::new(cos * z.x + sin * z.y, cos * z.y - sin * z.x);
        assert!((turned - expected).abs().max_element() < 2e-5, "{turned} {expected}");
        assert_abs_diff_eq!(Vec2::from(noise.whitened_gradient(p, [3.0 * t, 3.0 * b])), z, epsilon = 2e-5);
    }
}

#[test]
fn octaves_fade_in_and_sums_agree_on_every_lattice() {
    let (noise, mut random) = (sum::<Vec3, 3>(8), Random(31));
    let spectrum = FbmSpectrum::new(2.0, 0.5, 6).unwrap();
    let tiled = GaussianFbm::new(GaussianNoise::new(8), spectrum).tiled([7, 7, 7]).unwrap();
    for _ in 0..200 {
        let p = Vec3::new(random.coordinate(), random.coordinate(), random.coordinate()) / 16.0;
        let tangents: [Vec3; 2] = frame::<3>(&mut random).map(vector);
        let at = |octaves| Vec2::from(noise.whitened_gradient_with_octaves(p, tangents, octaves));
        for count in 1..8_u8 {
            let count = f32::from(count);
            assert_abs_diff_eq!(at(count), at(count + 1e-4), epsilon = 2e-3);
        }
        assert_eq!(at(3.5), Vec2::from(noise.with_octaves(3.5).whitened_gradient(p, tangents)));
        let anchored = noise.anchored([0.0; 3]).with_octaves(6.5).whitened_gradient(p, tangents);
        assert_abs_diff_eq!(Vec2::from(anchored), at(6.5), epsilon = 1e-4);
        let z = Vec2::from(tiled.whitened_gradient(p, tangents));
        let next = Vec2::from(tiled.whitened_gradient(p + Vec3::new(7.0, 0.0, -7.0), tangents));
        assert_abs_diff_eq!(z, next, epsilon = 2e-3);
    }
}

#[test]
fn octaves_of_huge_frequencies_have_variance_one() {
    // The frequency of the sixteenth octave is 8¹⁵ = 3.5·10¹³.
    let spectrum = FbmSpectrum::new(8.0, 0.95, 16).unwrap();
    let (noise, mut random) = (GaussianFbm::<Vec3>::new(GaussianNoise::new(3), spectrum), Random(12));
    // The last octave by the difference of the sums of sixteen and of fifteen.
    let amplitude = |i: i32| 0.95_f64.powi(i);
    let norm = |count| (0..count).map(|i| amplitude(i).powi(2)).sum::<f64>().sqrt();
    let mut square = 0.0;
    for _ in 0..20_000 {
        let p = Vec3::new(random.coordinate(), random.coordinate(), random.coordinate()) * 1e-9;
        let tangents: [Vec3; 2] = frame::<3>(&mut random).map(vector);
        let [all, most] = [16.0, 15.0].map(|count| noise.whitened_gradient_with_octaves(p, tangents, count));
        for k in 0..2 {
            let last = (f64::from(all[k]) * norm(16) - f64::from(most[k]) * norm(15)) / amplitude(15);
            square += last * last / 40_000.0;
        }
    }
    // Six standard errors.
    assert_abs_diff_eq!(square, 1.0, epsilon = 6.0 * f64::sqrt(2.0 / 40_000.0));
    let [z, scaled] = [1.0, 1e12].map(|k| noise.whitened_gradient(Vec3::ONE, [Vec3::X * k, Vec3::Y * k]));
    assert_abs_diff_eq!(Vec2::from(z), Vec2::from(scaled), epsilon = 1e-5);
}

#[test]
fn invalid_points_and_tangents_return_zero() {
    let noise = sum::<Vec3, 3>(2);
    let [x, y] = [Vec3::X, Vec3::Y];
    let p = Vec3::new(0.3, 0.4, 0.5);
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        assert_eq!(noise.whitened_gradient(p.with_y(bad), [x, y]), [0.0; 2]);
        assert_eq!(noise.whitened_gradient(p, [x * bad, y]), [0.0; 2]);
    }
    for octaves in [f32::NAN, f32::NEG_INFINITY, -1.0, 0.0] {
        assert_eq!(noise.whitened_gradient_with_octaves(p, [x, y], octaves), [0.0; 2], "{octaves}");
    }
    assert_eq!(noise.whitened_gradient(p, [Vec3::ZERO; 2]), [0.0; 2]);
    assert_eq!(noise.whitened_gradient(p, [x, Vec3::ZERO]), [0.0; 2]);
    assert!(noise.whitened_gradient(p, [x, x]).iter().all(|z| z.is_finite()));
    for far in [1e9, 1e20, f32::MAX] {
        assert!(noise.whitened_gradient(Vec3::splat(far), [x, y]).iter().all(|z| z.is_finite()));
    }
}
