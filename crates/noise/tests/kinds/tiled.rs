//! Kinds on a tileable lattice.

use asperity_noise::{
    Cellular, CellularOutput, Field, GaussianNoise, Perlin, PerlinClassic, Point, Simplex, SparseConvolution,
    ValueCatmullRom, ValueGradient, ValueNoise, WhiteNoise,
    glam::{Vec2, Vec3, Vec4},
    lattice::{ChainedTable, PermutationTable},
};

fn tiles<V: Point<Coordinates = [f32; N]>, const N: usize>(noise: &impl Field<V>, periods: [u32; N]) {
    for i in 0..60_u8 {
        let mut axis = 0;
        let p = periods.map(|period| {
            axis += 1;
            // Multiples of 1/8, so that sums are exact; across the border of a period and on it.
            (f32::from(i) * [0.625, -0.375, 1.125, -0.875][axis - 1]) % (2.0 * period as f32)
        });
        let here = noise.sample(V::from_coordinates(p));
        for axis in 0..N {
            for turns in [1.0, -2.0, 1000.0] {
                let mut q = p;
                q[axis] += turns * periods[axis] as f32;
                let there = noise.sample(V::from_coordinates(q));
                let bits = |x: V| x.coordinates().map(f32::to_bits);
                assert_eq!(here.value.to_bits(), there.value.to_bits(), "{p:?} and {q:?}");
                assert_eq!(bits(here.gradient), bits(there.gradient), "{p:?} and {q:?}");
            }
        }
    }
}

#[test]
fn tiled_repeats_every_kind_on_the_integer_lattice() {
    fn kind<K>(noise: &K)
    where
        K: Field<f32> + Field<Vec2> + Field<Vec3> + Field<Vec4>,
    {
        tiles::<f32, 1>(noise, [7]);
        tiles::<Vec2, 2>(noise, [7, 1]);
        tiles::<Vec3, 3>(noise, [7, 1, 12]);
        tiles::<Vec4, 4>(noise, [7, 1, 12, 2]);
    }
    const PERIODS: [u32; 4] = [7, 1, 12, 2];
    kind(&WhiteNoise::new(4).tiled(PERIODS).unwrap());
    kind(&ValueNoise::new(4).tiled(PERIODS).unwrap());
    kind(&ValueCatmullRom::new(4).tiled(PERIODS).unwrap());
    kind(&ValueGradient::new(4).tiled(PERIODS).unwrap());
    kind(&PerlinClassic::new(4).tiled(PERIODS).unwrap());
    kind(&Perlin::new(4).tiled(PERIODS).unwrap());
    kind(&GaussianNoise::new(4).tiled(PERIODS).unwrap());
    kind(&SparseConvolution::new(4).tiled(PERIODS).unwrap());
    kind(&Cellular::new(4).tiled(PERIODS).unwrap());
    kind(&Cellular::new(4).with_output(CellularOutput::Cell).tiled(PERIODS).unwrap());
    let table = PermutationTable::new(1);
    kind(&Perlin::new(4).with_lattice(table).tiled(PERIODS).unwrap());
    kind(&Perlin::new(4).with_lattice(ChainedTable(table)).tiled(PERIODS).unwrap());
}

#[test]
fn tiled_repeats_simplex_in_1d() {
    tiles::<f32, 1>(&Simplex::new(4).tiled([7]).unwrap(), [7]);
    tiles::<f32, 1>(&Simplex::new(4).with_classic_radius().tiled([7]).unwrap(), [7]);
}
