//! Batches at every SIMD level compared with single points, bit by bit.

use asperity_noise::{
    Field, Grid, Point, Sample,
    simd::{Batch, Level},
};

/// The linear congruential generator of Numerical Recipes; only its upper bits are used.
#[derive(Clone, Debug)]
pub struct Random(pub u32);

impl Random {
    /// The next 24 bits.
    pub const fn bits(&mut self) -> u32 {
        self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        self.0 >> 8
    }

    /// Uniform in [0, 1).
    pub const fn uniform(&mut self) -> f32 {
        self.bits() as f32 / 16_777_216.0
    }
}

/// Value and gradient, bit by bit.
fn bits<V: Point>(sample: Sample<V>) -> [u32; 5] {
    let mut bits = [sample.value.to_bits(), 0, 0, 0, 0];
    for (to, x) in bits[1..].iter_mut().zip(sample.gradient.coordinates().as_ref()) {
        *to = x.to_bits();
    }
    bits
}

/// Results of a batch: values alone, and values with gradients.
struct Filled<V: Point> {
    alone: Vec<f32>,
    values: Vec<f32>,
    gradients: V::Array<Vec<f32>>,
}

impl<V: Point> Filled<V> {
    fn new(count: usize) -> Self {
        // A number that no noise returns, so that skipped points are detected.
        let empty = || vec![f32::NAN; count];
        Self { alone: empty(), values: empty(), gradients: V::array(|_| empty()) }
    }

    /// The values, and one slice for each component of the gradient.
    fn slices(&mut self) -> (&mut [f32], V::Array<&mut [f32]>) {
        let mut gradients = self.gradients.as_mut().iter_mut();
        (&mut self.values, V::array(|_| gradients.next().map(Vec::as_mut_slice).unwrap_or_default()))
    }

    fn assert_bits(&self, expected: &[[u32; 5]], what: &dyn Fn(usize) -> String) {
        for (i, bits) in expected.iter().enumerate() {
            assert_eq!(self.alone[i].to_bits(), bits[0], "{}: value alone", what(i));
            assert_eq!(self.values[i].to_bits(), bits[0], "{}: value", what(i));
            for (axis, gradient) in self.gradients.as_ref().iter().enumerate() {
                assert_eq!(gradient[i].to_bits(), bits[axis + 1], "{}: gradient {axis}", what(i));
            }
        }
    }
}

/// Checks that grids of a field at every level have the bits of `sample`.
///
/// # Panics
/// If a bit differs.
pub fn grid<V: Point>(name: &str, field: &dyn Field<V>, grid: &Grid<V>) {
    let point = |mut i: usize| {
        grid.point(V::array(|axis| {
            let n = grid.size.as_ref()[axis];
            let along = i % n;
            i /= n;
            along
        }))
    };
    let expected: Vec<_> = (0..grid.len()).map(|i| bits(field.sample(point(i)))).collect();
    for level in Level::available() {
        let batch = Batch::with_level(level);
        let mut filled = Filled::<V>::new(grid.len());
        batch.grid_values(field, grid, &mut filled.alone).expect("lists of one length");
        let (values, gradients) = filled.slices();
        batch.grid_samples(field, grid, values, gradients).expect("lists of one length");
        filled.assert_bits(&expected, &|i| format!("{name}, {level}, {:?}", point(i)));
    }
}

/// Points near the origin, on lattice points, far away, beyond all cells and not finite, mixed
/// within every register.
#[must_use]
pub fn coordinate(random: &mut Random) -> f32 {
    let x = random.uniform() - 0.5;
    match random.bits() >> 18 {
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

/// Checks that lists of points of a field at every level have the bits of `sample`.
///
/// # Panics
/// If a bit differs.
pub fn points<V: Point>(name: &str, field: &dyn Field<V>, count: usize) {
    let mut random = Random(count as u32);
    // The first half is near the origin, so that whole registers use the code for near points.
    let coordinates = V::array(|_| -> Vec<f32> {
        (0..count)
            .map(|i| if i < count / 2 { (random.uniform() - 0.5) * 64.0 } else { coordinate(&mut random) })
            .collect()
    });
    let points: Vec<V> = (0..count).map(|i| V::from_axes(|axis| coordinates.as_ref()[axis][i])).collect();
    let expected: Vec<_> = points.iter().map(|&p| bits(field.sample(p))).collect();
    for level in Level::available() {
        let batch = Batch::with_level(level);
        let mut filled = Filled::<V>::new(count);
        let lists = || V::array(|axis| coordinates.as_ref()[axis].as_slice());
        batch.list_values(field, lists(), &mut filled.alone).expect("lists of one length");
        let (values, gradients) = filled.slices();
        batch.list_samples(field, lists(), values, gradients).expect("lists of one length");
        filled.assert_bits(&expected, &|i| format!("{name}, {level}, point {:?}", points[i]));
        let mut samples = vec![Sample::default(); count];
        batch.values(field, &points, &mut filled.alone).expect("lists of one length");
        batch.samples(field, &points, &mut samples).expect("lists of one length");
        filled.assert_bits(&expected, &|i| format!("{name}, {level}, point {:?} of a slice", points[i]));
        for (i, sample) in samples.into_iter().enumerate() {
            assert_eq!(bits(sample), expected[i], "{name}, {level}, sample at {:?}", points[i]);
        }
    }
}

const SIZES: [[usize; 4]; 4] = [[301, 1, 1, 1], [103, 5, 1, 1], [43, 4, 3, 1], [23, 3, 2, 2]];

/// The first coordinates of four.
#[must_use]
pub fn cut<V: Point>(all: [f32; 4]) -> V {
    V::from_axes(|axis| all[axis])
}

/// Checks grids with the given origin and steps.
///
/// # Panics
/// If a bit differs.
pub fn grids<V: Point>(name: &str, field: &dyn Field<V>, cases: &[([f32; 4], [f32; 4])]) {
    let dimension = V::default().coordinates().as_ref().len();
    for &(origin, step) in cases {
        let size = V::array(|axis| SIZES[dimension - 1][axis]);
        grid(name, field, &Grid { origin: cut(origin), step: cut(step), size });
    }
}

/// The origin of most grids.
pub const ORIGIN: [f32; 4] = [-3.0, -2.5, 0.7, -0.1];
const LARGE: f32 = 2_147_483_648.0;

/// Steps of all sizes and signs near the origin.
#[must_use]
pub fn near_cases() -> Vec<([f32; 4], [f32; 4])> {
    let mut cases =
        [0.05, -0.11, 0.37, 1.3, -2.9, 1.0, -0.5, 0.0, 1e-9].map(|x| (ORIGIN, [x, 0.3, 0.21, -0.4])).to_vec();
    cases.push((ORIGIN, [0.05, -0.3, -0.21, 0.4]));
    cases.push(([300.0, -250.0, 200.0, -100.0], [0.003, 0.07, -0.05, 0.4]));
    cases.push(([-700.0, -200.0, 60.0, -20.0], [0.21, 0.9, -0.05, 0.4]));
    cases
}

/// Origins and steps far away, across 2³¹, not finite, −0 and subnormal.
#[must_use]
pub fn far_cases() -> Vec<([f32; 4], [f32; 4])> {
    let step = [0.05, 0.3, 0.21, -0.4];
    let mut cases = vec![
        ([2.0e9, -2.5, 0.7, -0.1], [1e7, 0.3, 0.21, 0.4]),
        ([-2.0e9, -2.5, 0.7, -0.1], [-1e7, 0.3, 0.21, 0.4]),
        ([LARGE - 3.0 * 128.0, 2.0, 0.7, -0.1], [64.0, 0.3, 0.21, 0.4]),
        ([0.0, LARGE - 128.0, LARGE, -LARGE], [0.3, 128.0, 256.0, -256.0]),
        ([1e6, 1e6, -1e6, 1e6], step),
        ([2e5, 1e3, -1e4, 1e3], [0.21, 0.3, 0.21, -0.4]),
        ([2e3, 2e3, -2e3, 1e3], [0.05, 0.3, 0.21, -0.4]),
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

/// Checks a row that is filled in several intervals, and rows of every short length, alone and as
/// several rows that reuse edges.
///
/// # Panics
/// If a bit differs.
pub fn lengths<V: Point>(name: &str, field: &dyn Field<V>) {
    for length in (0..36).chain(255..274).chain([511, 512, 513, 1500]) {
        let size = || {
            V::array(|axis| match axis {
                0 => length,
                1 if length % 3 == 1 => 256 / length + 1,
                _ => 1,
            })
        };
        let origin = cut(ORIGIN);
        if !(36..=1000).contains(&length) {
            grid(name, field, &Grid { origin, step: cut([0.013, 0.3, 0.2, 0.1]), size: size() });
        }
        // Also backwards, and in steps of many cells.
        grid(name, field, &Grid { origin, step: cut([-0.7, 0.3, 0.2, 0.1]), size: size() });
    }
}
