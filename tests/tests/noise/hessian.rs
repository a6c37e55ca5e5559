//! Hessians against differences of a plain `f64` evaluation, and Hessians of sums against
//! differences of gradients.

use asperity_noise::{
    Fbm, FbmSpectrum, Field, GaussianFbm, GaussianNoise, HasHessian, Noise, Perlin, PerlinClassic, Point,
    Rotation, Sample, Simplex, ValueGradient, ValueNoise,
    glam::{Vec2, Vec3, Vec4},
};
use asperity_tests::{
    noise_any::{At, at},
    noise_reference::{Kind, difference},
    random::Random,
};

/// Returns coordinates within ±32 with twelve fractional bits.
fn point<const N: usize>(random: &mut Random) -> [f32; N] {
    [(); N].map(|()| ((random.uniform() - 0.5) * 262_144.0).round() as f32 / 4096.0)
}

/// Value and gradient of the Hessian evaluation, the same of `sample`, and the Hessian.
type Jet<const N: usize> = ([At<N>; 2], [[f32; N]; N]);

/// Returns the maximum error of the Hessian in a dimension. Value and gradient must have the bits
/// of the sample.
fn error<V, K, const N: usize>(noise: K, kind: Kind) -> f64
where
    V: Point<Coordinates = [f32; N], Matrix = [[f32; N]; N]>,
    K: HasHessian<V> + Noise + Copy,
{
    relative_error(kind, &|p, seed| {
        let (noise, p) = (noise.with_seed(seed), V::from_coordinates(p));
        let jet = noise.sample_with_hessian(p);
        ([at(Sample { value: jet.value, gradient: jet.gradient }), at(noise.sample(p))], jet.hessian)
    })
}

/// Returns the maximum error of a Hessian, relative to the largest entry seen.
fn relative_error<const N: usize>(kind: Kind, jet: &dyn Fn([f32; N], u32) -> Jet<N>) -> f64 {
    const H: f64 = 1e-4;
    let mut random = Random(7);
    let (mut worst, mut largest, mut compared) = (0.0_f64, 0.0_f64, 0);
    for seed in 0..400 {
        let p = point(&mut random);
        let ([with, without], hessian) = jet(p, seed);
        assert_eq!(with, without);
        let wide = p.map(f64::from);
        let moved = |axis: usize, step: f64| {
            let mut q = wide;
            q[axis] += step;
            q
        };
        let here = kind.lattice_points(wide);
        let inside = |q: [f64; N]| kind.lattice_points(q) == here;
        if (0..N).any(|axis| [4.0 * H, -4.0 * H].into_iter().any(|step| !inside(moved(axis, step)))) {
            continue;
        }
        for (i, row) in hessian.iter().enumerate() {
            for (j, &entry) in row.iter().enumerate() {
                let slope = |q: [f64; N]| {
                    difference(H, |step| {
                        let mut q = q;
                        q[j] += step;
                        kind.value(q, seed)
                    })
                };
                let expected = kind.scales()[N - 1] * difference(H, |step| slope(moved(i, step)));
                largest = largest.max(expected.abs());
                worst = worst.max((f64::from(entry) - expected).abs());
                compared += 1;
            }
        }
    }
    assert!(compared > 300 * N * N, "{compared} entries");
    worst / largest
}

/// Asserts the errors in 1 to 4 dimensions.
fn close<K>(name: &str, noise: K, kind: Kind, tolerance: f64)
where
    K: HasHessian<f32> + HasHessian<Vec2> + HasHessian<Vec3> + HasHessian<Vec4>,
    K: Noise + Field<f32> + Field<Vec2> + Field<Vec3> + Field<Vec4> + Copy,
{
    let errors = [
        error::<f32, K, 1>(noise, kind),
        error::<Vec2, K, 2>(noise, kind),
        error::<Vec3, K, 3>(noise, kind),
        error::<Vec4, K, 4>(noise, kind),
    ];
    assert!(errors.iter().all(|&error| error < tolerance), "{name}: {errors:?}");
}

#[test]
fn hessians_are_second_derivatives() {
    // The differences have errors of 1e-16/H² = 1e-8 of the values, and `f32` about ten roundings
    // of 6e-8. Maximum seen 1.3e-6.
    const CELLS: f64 = 3e-6;
    // Offsets from corners have errors of 2e-7, and third derivatives are up to fifty times second
    // derivatives, because the kernels are narrow. Maximum seen 1.3e-5.
    const SIMPLICES: f64 = 3e-5;
    close("Perlin 1985", PerlinClassic::default(), Kind::PerlinClassic, CELLS);
    close("Perlin 2002", Perlin::default(), Kind::Perlin, CELLS);
    for noise in [Simplex::new(0), Simplex::new(0).with_classic_radius()] {
        let r2 = noise.radius_squared();
        close(&format!("simplex {r2}"), noise, Kind::Simplex(r2.into()), SIMPLICES);
    }
    close("Gaussian", GaussianNoise::default(), Kind::Gaussian(0), CELLS);
    close("value", ValueNoise::default(), Kind::Value, CELLS);
    for weight in [0.0, 0.5, 1.0] {
        let (noise, kind) =
            (ValueGradient::default().with_weight(weight).unwrap(), Kind::ValueGradient(weight.into()));
        close(&format!("value-gradient {weight}"), noise, kind, CELLS);
    }
}

/// Returns the error of a sum's Hessian against central differences of its gradient, relative to
/// its largest entry.
fn sum_error<F: HasHessian<Vec3>>(field: &F) -> f64 {
    const H: f32 = 1.0 / 2048.0;
    let mut random = Random(8);
    let (mut worst, mut largest) = (0.0_f64, 0.0_f64);
    for _ in 0..200 {
        let p = Vec3::from(point(&mut random));
        let jet = field.sample_with_hessian(p);
        for (axis, row) in jet.hessian.iter().enumerate() {
            let [ahead, behind] = [H, -H].map(|h| {
                let mut q = p;
                q[axis] += h;
                field.sample(q).gradient
            });
            for (got, expected) in row.iter().zip(((ahead - behind) / (2.0 * H)).to_array()) {
                largest = largest.max(f64::from(expected.abs()));
                worst = worst.max(f64::from((got - expected).abs()));
            }
        }
    }
    worst / largest
}

#[test]
fn hessians_of_sums_are_differences_of_gradients() {
    // At cell borders third derivatives jump by up to 120, times 2.17³/2 in the second octave: H/4
    // of that is 0.07, for entries up to 30. Gradients are rounded by 3e-6, over H. Maximum seen
    // 2.4e-3.
    for rotation in [Rotation::Random, Rotation::Aligned] {
        let octaves = Fbm::new(Perlin::new(5), FbmSpectrum::default());
        let error = sum_error(&octaves.with_rotation(rotation).with_octaves(2.5));
        println!("{rotation:?}: {error:.1e}");
        assert!(error < 4e-3, "{rotation:?}: {error:e}");
    }
    let error =
        sum_error(&GaussianFbm::<Vec3>::new(GaussianNoise::new(5), FbmSpectrum::default()).with_octaves(2.5));
    println!("Gaussian: {error:.1e}");
    assert!(error < 4e-3, "Gaussian: {error:e}");
}
