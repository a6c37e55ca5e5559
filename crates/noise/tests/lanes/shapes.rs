//! Batches of turbulence and its like against single points, bit by bit, at every SIMD level.

use asperity_noise::{
    Batch, Field, Grid, Kernel, LaneSample, Lanes, Level, Normalisation, Octaves, Power, RidgedMultifractal,
    Rotation, Spectrum, Statistics, Turbulence, White, glam::Vec2,
};

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

/// Bumps in cells, equal for all seeds: as little code as a kind can have, for what is compiled at every level.
#[derive(Clone, Copy)]
struct Bumps;

impl Kernel<2> for Bumps {
    fn lane_values<S: Lanes>(&self, s: S, p: [S::F; 2], seed: u32) -> S::F {
        self.lane_samples(s, p, seed).0
    }

    fn lane_samples<S: Lanes>(&self, s: S, [x, y]: [S::F; 2], _: u32) -> LaneSample<S, 2> {
        let (x, y) = (x - s.floor(x), y - s.floor(y));
        let (one, two, four) = (s.float(1.0), s.float(2.0), s.float(4.0));
        (four * (x * (one - x) - y * (one - y)), [four * (one - two * x), four * (two * y - one)])
    }

    fn statistics(&self) -> &'static Statistics {
        Kernel::<2>::statistics(&White::default())
    }
}

#[test]
fn grids_of_shaped_sums_have_the_bits_of_single_points() {
    let octaves = Octaves::<_, 2>::new(Bumps, Spectrum::default(), Normalisation::Variance, 4);
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
    let ridges = RidgedMultifractal::<_, 2>::new(Bumps, Spectrum::CLOUD, 2.0, 1).unwrap();
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
