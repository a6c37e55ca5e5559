//! The same bits at every SIMD level: batches against single points, for every kind, dimension and sum.

use asperity_noise::{
    Batch, Field, Gaussian, GaussianOctaves, Grid, Kernel, Level, Normalisation, Octaves, Perlin2002, Point,
    Rotation, Sample, Seeded, Simplex, Spectrum,
    glam::{Vec2, Vec3, Vec4},
};
use asperity_tests::{
    noise_kinds::{Testable, Visit, every_kind, every_kind_by_permutation},
    random::Random,
};

/// Value and gradient, bit by bit.
fn bits<V: Point<N>, const N: usize>(sample: Sample<V>) -> [u32; 5] {
    let mut bits = [sample.value.to_bits(), 0, 0, 0, 0];
    for (to, x) in bits[1..].iter_mut().zip(sample.gradient.coordinates()) {
        *to = x.to_bits();
    }
    bits
}

/// What a batch fills: values alone, and values with gradients.
struct Filled<const N: usize> {
    alone: Vec<f32>,
    values: Vec<f32>,
    gradients: [Vec<f32>; N],
}

impl<const N: usize> Filled<N> {
    fn new(count: usize) -> Self {
        // Not a number that a noise gives, so that a place left out is seen.
        let empty = vec![f32::NAN; count];
        Self {
            alone: empty.clone(),
            values: empty.clone(),
            gradients: std::array::from_fn(|_| empty.clone()),
        }
    }

    fn assert_bits(&self, expected: &[[u32; 5]], what: &dyn Fn(usize) -> String) {
        for (i, bits) in expected.iter().enumerate() {
            assert_eq!(self.alone[i].to_bits(), bits[0], "{}: value alone", what(i));
            assert_eq!(self.values[i].to_bits(), bits[0], "{}: value", what(i));
            for (axis, gradient) in self.gradients.iter().enumerate() {
                assert_eq!(gradient[i].to_bits(), bits[axis + 1], "{}: gradient {axis}", what(i));
            }
        }
    }
}

/// Grids of a field at every level have the bits of `sample`.
fn grid<V: Point<N>, F: Field<N>, const N: usize>(
    name: &str,
    field: &F,
    sample: &impl Fn(V) -> Sample<V>,
    grid: &Grid<V, N>,
) {
    let index = |mut i: usize| {
        grid.size.map(|n| {
            let along = i % n;
            i /= n;
            along
        })
    };
    let expected: Vec<_> = (0..grid.len()).map(|i| bits(sample(grid.point(index(i))))).collect();
    for level in Level::available() {
        let batch = Batch::with_level(level);
        let mut filled = Filled::<N>::new(grid.len());
        batch.fill_grid(field, grid, &mut filled.alone).unwrap();
        let gradients = filled.gradients.each_mut().map(Vec::as_mut_slice);
        batch.fill_grid_with_gradients(field, grid, &mut filled.values, gradients).unwrap();
        filled.assert_bits(&expected, &|i| format!("{name}, {level}, {:?}", grid.point(index(i))));
        let mut row = vec![f32::NAN; grid.size[0]];
        batch.fill_row(field, grid.origin, grid.step.coordinates()[0], &mut row);
        let same = row.iter().zip(&expected).all(|(x, bits)| x.to_bits() == bits[0]);
        assert!(same, "{name}, {level}: the row from {:?}", grid.origin);
    }
}

/// Points near the origin, on lattice points, far out, beyond all cells and not finite, mixed within every register.
fn coordinate(random: &mut Random) -> f32 {
    let x = random.uniform() as f32 - 0.5;
    match random.bits() >> 32 & 63 {
        0..=47 => x * 16.0,
        48..=51 => (x * 16.0).floor(),
        52..=54 => x * 1e6,
        55..=57 => x * 6e9,
        58 => x * f32::MAX,
        59 => x * 1e-40,
        60 => -0.0,
        61 => f32::NAN,
        62 => f32::INFINITY.copysign(x),
        _ => 2_147_483_648.0_f32.copysign(x),
    }
}

/// Lists of points of a field at every level have the bits of `sample`.
fn points<V: Point<N>, F: Field<N>, const N: usize>(
    name: &str,
    field: &F,
    sample: &impl Fn(V) -> Sample<V>,
    count: usize,
) {
    let mut random = Random(count as u64);
    // The first half is near the origin, so that whole registers take the way of near points.
    let coordinates: [Vec<f32>; N] = std::array::from_fn(|_| {
        (0..count)
            .map(|i| if i < count / 2 { (random.uniform() - 0.5) as f32 * 64.0 } else { coordinate(&mut random) })
            .collect()
    });
    let point = |i: usize| V::from_coordinates(std::array::from_fn(|axis| coordinates[axis][i]));
    let expected: Vec<_> = (0..count).map(|i| bits(sample(point(i)))).collect();
    for level in Level::available() {
        let batch = Batch::with_level(level);
        let mut filled = Filled::<N>::new(count);
        let lists = coordinates.each_ref().map(Vec::as_slice);
        batch.fill_points(field, lists, &mut filled.alone).unwrap();
        let gradients = filled.gradients.each_mut().map(Vec::as_mut_slice);
        batch.fill_points_with_gradients(field, lists, &mut filled.values, gradients).unwrap();
        filled.assert_bits(&expected, &|i| format!("{name}, {level}, point {:?}", point(i)));
    }
}

const SIZES: [[usize; 4]; 4] = [[301, 1, 1, 1], [103, 5, 1, 1], [43, 4, 3, 1], [21, 3, 2, 2]];

fn cut<const N: usize, T: Copy>(all: [T; 4]) -> [T; N] {
    std::array::from_fn(|axis| all[axis])
}

/// Steps of all sizes and signs; far out, across 2³¹, not finite; −0; rows shorter and longer than what is done at once.
fn grids<V: Point<N>, F: Field<N>, const N: usize>(
    name: &str,
    field: &F,
    sample: &impl Fn(V) -> Sample<V>,
    cases: &[([f32; 4], [f32; 4])],
) {
    for &(origin, step) in cases {
        let [origin, step] = [origin, step].map(|all| V::from_coordinates(cut(all)));
        grid(name, field, sample, &Grid { origin, step, size: cut(SIZES[N - 1]) });
    }
}

const ORIGIN: [f32; 4] = [-3.0, -2.5, 0.7, -0.1];
const LARGE: f32 = 2_147_483_648.0;

fn near_cases() -> Vec<([f32; 4], [f32; 4])> {
    [0.05, -0.11, 0.37, 1.3, -2.9, 1.0, -0.5, 0.0, 1e-9].map(|x| (ORIGIN, [x, 0.3, 0.21, -0.4])).to_vec()
}

fn far_cases() -> Vec<([f32; 4], [f32; 4])> {
    let step = [0.05, 0.3, 0.21, -0.4];
    let mut cases = vec![
        ([2.0e9, -2.5, 0.7, -0.1], [1e7, 0.3, 0.21, 0.4]),
        ([-2.0e9, -2.5, 0.7, -0.1], [-1e7, 0.3, 0.21, 0.4]),
        ([LARGE - 3.0 * 128.0, 2.0, 0.7, -0.1], [64.0, 0.3, 0.21, 0.4]),
        ([0.0, LARGE - 128.0, LARGE, -LARGE], [0.3, 128.0, 256.0, -256.0]),
        ([1e6, 1e6, -1e6, 1e6], step),
        ([8_388_600.0, 0.0, 0.5, 0.0], [0.25, 0.3, 0.21, 0.4]),
        ([f32::MAX, 0.3, f32::MIN, 0.4], [1e36, 0.3, 0.21, 0.4]),
        ([0.0, 0.3, 0.2, 0.4], [f32::MAX, 1e38, 0.21, 0.4]),
        ([-0.0, -0.0, -0.0, -0.0], [-0.0, 0.5, -0.0, 0.5]),
        ([1e-40, -1e-40, 1e-30, -1e-30], [1e-41, 1e-40, -1e-39, 1e-45]),
    ];
    for bad in [f32::NAN, f32::INFINITY, f32::NEG_INFINITY] {
        for axis in 0..4 {
            let mut origin = ORIGIN;
            origin[axis] = bad;
            cases.push((origin, step));
        }
        cases.push((ORIGIN, [bad, 0.3, 0.21, 0.4]));
    }
    cases
}

/// A row that is filled in several stretches, and rows of every short length.
fn lengths<V: Point<N>, F: Field<N>, const N: usize>(
    name: &str,
    field: &F,
    sample: &impl Fn(V) -> Sample<V>,
) {
    let [origin, step] = [ORIGIN, [0.013, 0.3, 0.2, 0.1]].map(|all| V::from_coordinates(cut(all)));
    for length in (0..36).chain([255, 256, 257, 1500]) {
        let mut size = [1; N];
        size[0] = length;
        if length > 1000 || length < 36 {
            grid(name, field, sample, &Grid { origin, step, size });
        }
        // Backwards too, and in steps of many cells.
        let step = V::from_coordinates(cut([-0.7, 0.3, 0.2, 0.1]));
        grid(name, field, sample, &Grid { origin, step, size });
    }
}

struct Near;
struct Far;
struct Lengths;
struct Points;

impl Visit for Near {
    fn visit<V: Point<N> + Sync, K: Testable<V, N>, const N: usize>(&mut self, name: &str, noise: K) {
        grids(name, &Seeded(noise, 7), &|p: V| noise.sample(p, 7), &near_cases());
    }
}

impl Visit for Far {
    fn visit<V: Point<N> + Sync, K: Testable<V, N>, const N: usize>(&mut self, name: &str, noise: K) {
        grids(name, &Seeded(noise, 7), &|p: V| noise.sample(p, 7), &far_cases());
    }
}

impl Visit for Lengths {
    fn visit<V: Point<N> + Sync, K: Testable<V, N>, const N: usize>(&mut self, name: &str, noise: K) {
        lengths(name, &Seeded(noise, u32::MAX), &|p: V| noise.sample(p, u32::MAX));
    }
}

impl Visit for Points {
    fn visit<V: Point<N> + Sync, K: Testable<V, N>, const N: usize>(&mut self, name: &str, noise: K) {
        let (field, sample) = (Seeded(noise, 7), |p: V| noise.sample(p, 7));
        points(name, &field, &sample, 4001);
        for count in 0..20 {
            points(name, &field, &sample, count);
        }
        // The value alone is the sample's.
        let mut random = Random(5);
        for _ in 0..1000 {
            let p = V::from_coordinates([(); N].map(|()| coordinate(&mut random)));
            let [alone, value] = [noise.value(p, 7), noise.sample(p, 7).value].map(f32::to_bits);
            assert_eq!(alone, value, "{name} at {p:?}");
        }
    }
}

#[test]
fn near_grids_have_the_scalar_bits() {
    every_kind(&mut Near);
    every_kind_by_permutation(&mut Near);
}

#[test]
fn far_grids_have_the_scalar_bits() {
    every_kind(&mut Far);
}

#[test]
fn rows_of_any_length_have_the_scalar_bits() {
    every_kind(&mut Lengths);
}

#[test]
fn points_have_the_scalar_bits() {
    every_kind(&mut Points);
    every_kind_by_permutation(&mut Points);
}

fn sum<V: Point<N>, K: Kernel<N> + Copy, const N: usize>(name: &str, noise: K) {
    for rotation in [Rotation::Random, Rotation::Aligned] {
        for normalisation in [Normalisation::Range, Normalisation::Variance] {
            let octaves = Octaves::<K, N>::new(noise, Spectrum::default(), normalisation, 3);
            let octaves = octaves.with_rotation(rotation);
            let name = format!("{name} {N}-D {rotation:?} {normalisation:?}");
            for count in [3.4, 1.0, 0.0] {
                let (field, sample) = (octaves.first(count), |p: V| octaves.sample(p, count));
                grids(&name, &field, &sample, &near_cases()[..4]);
                points(&name, &field, &sample, 501);
            }
            let (field, sample) = (octaves.first(2.5), |p: V| octaves.sample(p, 2.5));
            grids(&name, &field, &sample, &far_cases());
            let step = V::from_coordinates(cut([-0.01, 0.3, 0.2, 0.1]));
            let mut size = [1; N];
            size[0] = 700;
            grid(&name, &field, &sample, &Grid { origin: V::from_coordinates(cut(ORIGIN)), step, size });
            let p = V::from_coordinates(cut(ORIGIN));
            assert_eq!(octaves.value(p, 3.4).to_bits(), octaves.sample(p, 3.4).value.to_bits(), "{name}");
        }
    }
}

fn sums<K: Kernel<1> + Kernel<2> + Kernel<3> + Kernel<4> + Copy>(name: &str, noise: K) {
    sum::<f32, K, 1>(name, noise);
    sum::<Vec2, K, 2>(name, noise);
    sum::<Vec3, K, 3>(name, noise);
    sum::<Vec4, K, 4>(name, noise);
}

#[test]
fn sums_have_the_scalar_bits() {
    sums("Perlin 2002", Perlin2002::default());
    sums("simplex", Simplex::CONTINUOUS);
    sums("Gaussian", Gaussian::default());
}

fn gaussian_sum<V: Point<N>, const N: usize>() {
    let octaves = GaussianOctaves::<N>::new(Spectrum::default(), 3);
    for count in [3.4, 1.0, 0.0] {
        let (field, sample) = (octaves.first(count), |p: V| octaves.sample(p, count));
        grids("Gaussian octaves", &field, &sample, &near_cases()[..4]);
        grids("Gaussian octaves", &field, &sample, &far_cases());
        points("Gaussian octaves", &field, &sample, 501);
    }
}

#[test]
fn gaussian_sums_have_the_scalar_bits() {
    gaussian_sum::<f32, 1>();
    gaussian_sum::<Vec2, 2>();
    gaussian_sum::<Vec3, 3>();
    gaussian_sum::<Vec4, 4>();
}

#[test]
fn an_unavailable_level_falls_back_to_the_same_bits() {
    let (noise, p) = (Perlin2002::default(), [0.3, 1.7, -2.4]);
    for level in [Level::Scalar, Level::Sse2, Level::Avx512, Level::Neon, Level::Wasm128] {
        let mut values = [0.0; 3];
        Batch::with_level(level).fill_points(&Seeded(noise, 1), [&p], &mut values).unwrap();
        let expected = p.map(|x| asperity_noise::Noise::<f32>::value(&noise, x, 1));
        assert_eq!(values, expected, "{level}");
    }
}
