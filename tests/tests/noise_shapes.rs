//! Turbulence and its like: against their octaves, against differences, their measured means, the clamp, batches.

use asperity_noise::{
    Batch, Billow, Field, Gaussian, Grid, Kernel, Level, Normalisation, Octaves, Perlin1985, Perlin2002,
    Plasma, Point, Power, Ridged, RidgedMultifractal, Rotation, Sample, Shape, Signed, Simplex, Sparse,
    Spectrum, Turbulence, Value, ValueCatmullRom, White,
    glam::{Vec2, Vec3, Vec4},
};
use asperity_tests::random::Random;

/// Coordinates in ±8 with twelve bits of fraction.
fn point<V: Point<N>, const N: usize>(random: &mut Random) -> V {
    V::from_coordinates([(); N].map(|()| ((random.uniform() - 0.5) * 65_536.0).round() as f32 / 4096.0))
}

/// φ and φ′ once more.
type Phi = fn(f64) -> [f64; 2];

fn turbulence(n: f64) -> [f64; 2] {
    [n.abs(), n.signum()]
}

fn plasma(n: f64) -> [f64; 2] {
    [1.0 - n.abs(), -n.signum()]
}

fn billow(n: f64) -> [f64; 2] {
    [2.0 * n.abs() - 1.0, 2.0 * n.signum()]
}

fn ridged(n: f64) -> [f64; 2] {
    [(1.0 - n.abs()).powi(2), -2.0 * (1.0 - n.abs()) * n.signum()]
}

/// Value and gradient of octave i at a point, from the signed sums of i and i + 1 octaves.
fn octave<V: Point<N>, K: Kernel<N>, const N: usize>(signed: &Octaves<K, N>, p: V, i: u8) -> (f64, [f64; N]) {
    let spectrum = signed.spectrum();
    let sum = |count: u8| {
        let sample = signed.sample(p, f32::from(count));
        let norm = f64::from(spectrum.sum_of_amplitudes(f32::from(count)));
        let g = sample.gradient.coordinates().map(|g| norm * f64::from(g));
        (norm * f64::from(sample.value), g)
    };
    let (below, above) = (sum(i), sum(i + 1));
    let amplitude = f64::from(spectrum.amplitude(u32::from(i)));
    let slope = |axis: usize| (above.1[axis] - below.1[axis]) / amplitude;
    ((above.0 - below.0) / amplitude, std::array::from_fn(slope))
}

/// Sums of four octaves, the last at half weight, against φ of their octaves.
fn follows<V: Point<N>, K: Kernel<N> + Copy, T: Shape, const N: usize>(kind: K, shape: T, phi: Phi) {
    let spectrum = Spectrum::default();
    let mut random = Random(11);
    for rotation in [Rotation::Random, Rotation::Aligned] {
        for seed in 0..40 {
            let signed = Octaves::new(kind, spectrum, Normalisation::Range, seed).with_rotation(rotation);
            let p: V = point(&mut random);
            let octaves: Vec<_> = (0..4).map(|i| octave(&signed, p, i)).collect();
            if octaves.iter().any(|(n, _)| n.abs() < 1e-5) {
                continue;
            }
            let (mut value, mut gradient, mut norm) = (0.0, [0.0; N], 0.0);
            for (i, (n, g)) in octaves.into_iter().enumerate() {
                let [f, slope] = phi(n);
                let amplitude = 0.5_f64.powi(i as i32) * if i == 3 { 0.5 } else { 1.0 };
                value += amplitude * f;
                norm += amplitude;
                for axis in 0..N {
                    gradient[axis] += amplitude * slope * g[axis];
                }
            }
            let sample: Sample<V> = signed.with_shape(shape).sample(p, 3.5);
            // Octaves come out of sums by differences: a few roundings of values under 2 and gradients under 30.
            assert!((f64::from(sample.value) - value / norm).abs() < 4e-6, "{shape:?} {N}-D at {p:?}");
            for (got, slope) in sample.gradient.coordinates().into_iter().zip(gradient) {
                let (got, expected) = (f64::from(got), slope / norm);
                assert!((got - expected).abs() < 1e-4, "{shape:?} {N}-D at {p:?}: {got}, not {expected}");
            }
        }
    }
}

#[test]
fn shaped_sums_are_sums_of_shaped_octaves() {
    fn every_shape<V: Point<N>, K: Kernel<N> + Copy, const N: usize>(kind: K) {
        follows::<V, K, _, N>(kind, Signed, |n| [n, 1.0]);
        follows::<V, K, _, N>(kind, Turbulence, turbulence);
        follows::<V, K, _, N>(kind, Plasma, plasma);
        follows::<V, K, _, N>(kind, Billow, billow);
        follows::<V, K, _, N>(kind, Ridged, ridged);
    }
    every_shape::<f32, _, 1>(Perlin2002::default());
    every_shape::<Vec2, _, 2>(Perlin1985::default());
    every_shape::<Vec3, _, 3>(Simplex::CONTINUOUS);
    every_shape::<Vec4, _, 4>(Gaussian::default());
}

/// The greatest difference of a field's gradient and central differences, over points where no crease is near.
fn by_differences<V: Point<N>, F: Field<N>, const N: usize>(field: &F) -> f64 {
    const H: f32 = 1.0 / 512.0;
    let mut random = Random(5);
    let mut errors = Vec::new();
    for _ in 0..300 {
        let p: V = point(&mut random);
        let sample = field.sample(p);
        for axis in 0..N {
            let at = |steps: f32| {
                let mut q = p.coordinates();
                q[axis] += steps * H;
                f64::from(field.value(V::from_coordinates(q)))
            };
            let [ahead, here, behind] = [1.0, 0.0, -1.0].map(at);
            let [rise, fall] = [ahead - here, here - behind].map(|x| x / f64::from(H));
            // A crease between the points shows as different slopes on its sides.
            if (rise - fall).abs() < 0.4 {
                let got = f64::from(sample.gradient.coordinates()[axis]);
                errors.push((got - 0.5 * (rise + fall)).abs());
            }
        }
    }
    assert!(errors.len() > 150 * N, "{} slopes of {}", errors.len(), 300 * N);
    errors.sort_by(f64::total_cmp);
    // Some creases are slight enough to pass; nine of ten points have none.
    errors[errors.len() * 9 / 10]
}

#[test]
fn gradients_are_limits_of_differences() {
    // Rounding of values, 4e-7, over H = 1/512, and H²/6 times third derivatives, which reach 3000 for the third octave.
    // Worst seen 1.6e-3, for ridged simplex noise.
    fn check<V: Point<N>, F: Field<N>, const N: usize>(name: &str, field: &F) {
        let error = by_differences::<V, F, N>(field);
        println!("{name}: {error:.1e}");
        assert!(error < 3e-3, "{name}: {error:e}");
    }
    let spectrum = Spectrum::CLOUD;
    let octaves = Octaves::<_, 2>::new(Simplex::CONTINUOUS, spectrum, Normalisation::Range, 1);
    check::<Vec2, _, 2>("turbulence", &octaves.with_shape(Turbulence).first(2.5));
    check::<Vec2, _, 2>("clamped turbulence", &octaves.with_shape(Turbulence).first(2.5).clamped(0.2));
    check::<Vec2, _, 2>("ridged", &octaves.with_shape(Ridged).first(2.5));
    let octaves = Octaves::<_, 3>::new(Perlin2002::default(), spectrum, Normalisation::Range, 1);
    check::<Vec3, _, 3>("plasma", &octaves.with_shape(Plasma).first(2.5));
    check::<Vec3, _, 3>("billow", &octaves.with_shape(Billow).first(2.5));
    check::<Vec3, _, 3>("threads", &Power(octaves.with_shape(Plasma).first(2.5), 7));
    let ridges = RidgedMultifractal::<_, 3>::new(Perlin2002::default(), spectrum, 0.8, 1).unwrap();
    check::<Vec3, _, 3>("ridged multifractal", &ridges.first(2.5));
}

/// Whether the mean and deviation of a sum of three octaves are the stated ones, clamped or not.
fn has_moments<V: Point<N>, K: Kernel<N> + Copy, T: Shape, const N: usize>(kind: K, shape: T) {
    const SEEDS: u32 = 600;
    const POINTS: usize = 48;
    let mut random = Random(3);
    for normalisation in [Normalisation::Range, Normalisation::Variance] {
        let (mut means, mut squares, mut clamped) = (Vec::new(), Vec::new(), Vec::new());
        let mut stated = [0.0; 2];
        for seed in 0..SEEDS {
            let sum = Octaves::new(kind, Spectrum::THREADS, normalisation, seed).with_shape(shape);
            stated = [sum.mean(3.0), sum.standard_deviation(3.0)].map(f64::from);
            let (whole, part) = (sum.first(3.0), sum.first(3.0).clamped(0.15));
            let (mut mean, mut square, mut mean_clamped) = (0.0, 0.0, 0.0);
            for _ in 0..POINTS {
                let p: V = point(&mut random);
                let value = f64::from(whole.value(p));
                mean += value / POINTS as f64;
                square += (value - stated[0]).powi(2) / POINTS as f64;
                mean_clamped += f64::from(part.value(p)) / POINTS as f64;
            }
            means.push(mean);
            squares.push(square);
            clamped.push(mean_clamped);
        }
        // 4 kinds and dimensions, 5 shapes, 2 normalisations, 3 numbers: 5 standard errors are 7e-5 for all of them
        // together; the stated moments have errors of a sixth of these.
        let agrees = |what: &str, samples: &[f64], expected: f64| {
            let count = samples.len() as f64;
            let mean = samples.iter().sum::<f64>() / count;
            let variance = samples.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (count - 1.0);
            let error = (variance / count).sqrt();
            assert!(
                (mean - expected).abs() < 5.0 * error,
                "{what} of {shape:?} {N}-D {normalisation:?}: {mean}, not {expected}, ±{error}"
            );
        };
        agrees("mean", &means, stated[0]);
        agrees("variance", &squares, stated[1] * stated[1]);
        agrees("clamped mean", &clamped, stated[0]);
    }
}

#[test]
fn sums_have_their_means_and_deviations() {
    fn every_shape<V: Point<N>, K: Kernel<N> + Copy, const N: usize>(kind: K) {
        has_moments::<V, K, _, N>(kind, Signed);
        has_moments::<V, K, _, N>(kind, Turbulence);
        has_moments::<V, K, _, N>(kind, Plasma);
        has_moments::<V, K, _, N>(kind, Billow);
        has_moments::<V, K, _, N>(kind, Ridged);
    }
    every_shape::<Vec2, _, 2>(Perlin1985::default());
    every_shape::<Vec3, _, 3>(Simplex::WIDE);
    every_shape::<Vec3, _, 3>(Perlin2002::default());
    every_shape::<f32, _, 1>(Gaussian::default());
    has_moments::<Vec2, _, _, 2>(Value::default(), Turbulence);
    has_moments::<Vec2, _, _, 2>(ValueCatmullRom::default(), Turbulence);
    has_moments::<Vec2, _, _, 2>(Sparse::default(), Turbulence);
    has_moments::<Vec2, _, _, 2>(White::default(), Ridged);
}

#[test]
fn clamping_takes_the_finest_octaves_first() {
    let octaves = Octaves::<_, 2>::new(Perlin2002::default(), Spectrum::CLOUD, Normalisation::Range, 2);
    let sum = octaves.with_shape(Turbulence);
    let p = Vec2::new(0.3, 5.25);
    // Frequencies 1, 2, 4: at 0.15 the third is removed altogether, the second by smoothstep(0.3) = 0.15625, the first not.
    let parts: Vec<f64> = (0..3).map(|i| octave(&octaves, p, i).0.abs()).collect();
    let mean = f64::from(sum.mean(3.0));
    let expected = (parts[0] + 0.5 * (parts[1] + 0.15625 * (mean - parts[1])) + 0.25 * mean) / 1.75;
    let clamped = sum.first(3.0).clamped(0.15).sample(p);
    assert!((f64::from(clamped.value) - expected).abs() < 1e-6, "{} is not {expected}", clamped.value);
    // Without a footprint nothing changes, not a bit; with an endless one the mean remains.
    for footprint in [0.0, -1.0, f32::NAN] {
        assert_eq!(sum.first(3.0).clamped(footprint).sample(p), sum.sample(p, 3.0), "{footprint}");
    }
    let far = sum.first(3.0).clamped(f32::INFINITY).sample(p);
    assert!((f64::from(far.value) - mean).abs() < 1e-7 && far.gradient == Vec2::ZERO);
    assert_eq!(octaves.first(3.0).clamped(f32::INFINITY).value(p), 0.0);
}

#[test]
fn ranges_hold_for_every_gain() {
    let mut random = Random(9);
    for (gain, lacunarity) in [(0.5, 2.0), (1.0, 2.0), (2.7, 2.4)] {
        let spectrum = Spectrum::new(lacunarity, gain, 6).unwrap();
        for seed in 0..200 {
            let sum = Octaves::<_, 2>::new(Perlin2002::default(), spectrum, Normalisation::Range, seed);
            let p: Vec2 = point(&mut random);
            assert!(sum.value(p, 5.5).abs() <= 1.0);
            for value in [sum.with_shape(Turbulence).value(p, 5.5), sum.with_shape(Ridged).value(p, 5.5)] {
                assert!((-1e-6..=1.0 + 1e-6).contains(&value), "gain {gain}: {value}");
            }
            let threads = Power(sum.with_shape(Plasma).first(4.0), 7).value(p);
            assert!((-1e-6..=1.0 + 1e-6).contains(&threads), "gain {gain}: {threads}");
        }
    }
}

/// The points of a grid.
const SIZE: [usize; 2] = [53, 4];
const COUNT: usize = SIZE[0] * SIZE[1];

fn grid() -> Grid<Vec2, 2> {
    Grid { origin: Vec2::new(-3.3, 7.1), step: Vec2::new(0.043, 0.61), size: SIZE }
}

/// What a batch has filled against single points, bit for bit.
fn same_bits<F: Field<2>>(name: &str, field: &F, got: [&[f32]; 4]) {
    for k in 0..COUNT {
        let sample = field.sample(grid().point([k % SIZE[0], k / SIZE[0]]));
        let expected = [sample.value, sample.value, sample.gradient.x, sample.gradient.y];
        assert_eq!(got.map(|list| list[k].to_bits()), expected.map(f32::to_bits), "{name}, point {k}");
    }
}

#[test]
fn grids_of_shaped_sums_have_the_bits_of_single_points() {
    let octaves =
        Octaves::<_, 2>::new(Perlin2002::default(), Spectrum::default(), Normalisation::Variance, 4);
    for rotation in [Rotation::Random, Rotation::Aligned] {
        let turbulence = octaves.with_rotation(rotation).with_shape(Turbulence);
        for footprint in [0.0, 0.1, 9.0] {
            let field = turbulence.first(3.5).clamped(footprint);
            for level in Level::available() {
                let batch = Batch::with_level(level);
                let [mut values, mut alone, mut dx, mut dy] = [[0.0_f32; COUNT]; 4];
                batch.fill_grid(&field, &grid(), &mut alone).unwrap();
                batch.fill_grid_with_gradients(&field, &grid(), &mut values, [&mut dx, &mut dy]).unwrap();
                let name = format!("{rotation:?}, footprint {footprint}, {level}");
                same_bits(&name, &field, [&alone, &values, &dx, &dy]);
            }
        }
    }
}

#[test]
fn points_of_a_ridged_multifractal_have_the_bits_of_single_points() {
    let ridges = RidgedMultifractal::<_, 2>::new(Simplex::CONTINUOUS, Spectrum::CLOUD, 2.0, 1).unwrap();
    let field = Power(ridges.first(3.5), 2);
    let points: Vec<Vec2> = (0..COUNT).map(|k| grid().point([k % SIZE[0], k / SIZE[0]])).collect();
    let [x, y]: [Vec<f32>; 2] = [0, 1].map(|axis| points.iter().map(|p| p[axis]).collect());
    for level in Level::available() {
        let [mut values, mut dx, mut dy] = [[0.0_f32; COUNT]; 3];
        let batch = Batch::with_level(level);
        batch.fill_points_with_gradients(&field, [&x, &y], &mut values, [&mut dx, &mut dy]).unwrap();
        same_bits(&level.to_string(), &field, [&values, &values, &dx, &dy]);
    }
}
