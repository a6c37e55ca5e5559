//! `Field::range` holds for every value: an adversarial search over lattices, seeds and points.

use asperity_core::SplitMix64;
use asperity_noise::{
    Billow, Cellular, CellularOutput, Fbm, FbmSpectrum, Field, GaussianNoise, Grid, Lattice, Metric,
    Normalization, Perlin, PerlinClassic, Plasma, Point, Ridged, RidgedMultifractal, Sample, Shape, Signed,
    Simplex, SparseConvolution, Turbulence, ValueCatmullRom, ValueGradient, ValueNoise, Warp, WhiteNoise,
    glam::{Vec2, Vec3, Vec4},
    ops::{Add, Blend, Clamp, Multiply, Power, ScaleBias, Unit},
};

struct Random(SplitMix64);

impl Random {
    fn word(&mut self) -> u32 {
        (self.0.word() >> 32) as u32
    }

    fn below(&mut self, count: u32) -> usize {
        (self.word() % count) as usize
    }

    /// A word of a lattice point: arbitrary, or an end of the range of values.
    fn lattice_word(&mut self) -> u32 {
        [self.word(), 0, u32::MAX, 0x7fff_ffff, 0x8000_0000][self.below(5)]
    }

    /// A coordinate: in cells near and far, close to an end or the center of a cell and between.
    fn coordinate(&mut self) -> f32 {
        let cell = f64::from(self.word() % (1 << self.below(22))) * [1.0, -1.0][self.below(2)];
        let near = (-f64::from(self.word() % 26)).exp2();
        let position =
            [f64::from(self.word()) / 4_294_967_296.0, near, 1.0 - near, 0.5 + near][self.below(4)];
        (cell + position) as f32
    }
}

/// The words that the search chooses.
type Words = [u32; 256];

/// A lattice with these words, selected by the last two bits of the cell's coordinates, for all
/// octaves.
#[derive(Clone, Copy, Debug)]
struct Chosen(Words);

impl Lattice for Chosen {
    fn word<const N: usize>(&self, cell: [i32; N], _: u32) -> u32 {
        self.0[cell.iter().fold(0, |index, x| index << 2 | (x & 3) as usize)]
    }
}

/// Climbs to values far from the middle of the range, and returns the largest excess over it, with
/// its position.
fn excess<V, F, const N: usize>(random: &mut Random, field: impl Fn(Words) -> F) -> (f32, String)
where
    V: Point<Coordinates = [f32; N]>,
    F: Field<V>,
{
    let corners = 1 << (2 * N);
    let distance = |words, p: [f32; N]| {
        let field = field(words);
        let ([low, high], value) = (field.range(), field.value(V::from_coordinates(p)));
        // NaN counts as the worst value.
        if value.is_nan() { f32::INFINITY } else { (value - high).max(low - value) }
    };
    let (mut worst, mut position) = (f32::NEG_INFINITY, String::new());
    for _ in 0..200 {
        let mut words = [(); 256].map(|()| random.lattice_word());
        let mut p = [(); N].map(|()| random.coordinate());
        let mut best = distance(words, p);
        for _ in 0..300 {
            let (mut w, mut q) = (words, p);
            let axis = random.below(N as u32);
            match random.below(4) {
                0 => w[random.below(corners)] = random.lattice_word(),
                1 => q[axis] = random.coordinate(),
                2 => q[axis] += (f64::from(random.word()) / 4_294_967_296.0 - 0.5) as f32 * 0.1,
                _ => {
                    let bits = q[axis].to_bits().wrapping_add(random.word() % 9).wrapping_sub(4);
                    q[axis] = f32::from_bits(bits);
                }
            }
            let found = distance(w, q);
            if found >= best {
                (words, p, best) = (w, q, found);
            }
        }
        if best > worst {
            (worst, position) = (best, format!("{p:?} on {:x?}", &words[..corners as usize]));
        }
    }
    (worst, position)
}

/// The search in 1 to 4 dimensions.
macro_rules! search {
    ($random:ident, $found:ident, $name:expr, $field:expr) => {
        search!(@ $random, $found, $name, $field, f32 1, Vec2 2, Vec3 3, Vec4 4)
    };
    (@ $random:ident, $found:ident, $name:expr, $field:expr, $($point:ident $n:literal),*) => {
        $({
            let (excess, position) = excess::<$point, _, $n>(&mut $random, $field);
            if excess > 0.0 {
                $found.push(format!("{} {}-D: {excess:e} beyond the range at {position}", $name, $n));
            }
        })*
    };
}

#[test]
fn range_of_every_kind_holds_near_and_far() {
    let (mut random, mut found) = (Random(SplitMix64 { state: 1 }), Vec::new());
    search!(random, found, "white", |w| WhiteNoise::new(0).with_lattice(Chosen(w)));
    search!(random, found, "value", |w| ValueNoise::new(0).with_lattice(Chosen(w)));
    search!(random, found, "value, Catmull–Rom", |w| ValueCatmullRom::new(0).with_lattice(Chosen(w)));
    search!(random, found, "Perlin 1985", |w| PerlinClassic::new(0).with_lattice(Chosen(w)));
    search!(random, found, "Perlin 2002", |w| Perlin::new(0).with_lattice(Chosen(w)));
    for weight in [0.0, 1e-6, 0.5, 1.0] {
        let noise = ValueGradient::new(0).with_weight(weight).unwrap();
        search!(random, found, format!("value-gradient {weight}"), |w| noise.with_lattice(Chosen(w)));
    }
    search!(random, found, "simplex", |w| Simplex::new(0).with_lattice(Chosen(w)));
    search!(random, found, "wide simplex", |w| Simplex::new(0).with_classic_radius().with_lattice(Chosen(w)));
    search!(random, found, "Gaussian", |w| GaussianNoise::new(0).with_lattice(Chosen(w)));
    for impulses in [1, SparseConvolution::MAX_IMPULSES] {
        let noise = SparseConvolution::new(0).with_impulses(impulses).unwrap();
        search!(random, found, format!("sparse {impulses}"), |w| noise.with_lattice(Chosen(w)));
    }
    for metric in [Metric::Euclidean, Metric::Manhattan, Metric::Chebyshev] {
        for basis in [CellularOutput::F1, CellularOutput::F2, CellularOutput::F2MinusF1, CellularOutput::Cell]
        {
            for jitter in [0.0, 1.0] {
                let noise =
                    Cellular::new(0).with_metric(metric).with_output(basis).with_jitter(jitter).unwrap();
                let name = format!("{metric:?} {basis:?} of jitter {jitter}");
                search!(random, found, name, |w| noise.with_lattice(Chosen(w)));
            }
        }
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

/// Sums whose octaves are all at the same end of their range.
fn sums<T: Shape>(random: &mut Random, found: &mut Vec<String>, shape: T) {
    for _ in 0..2000 {
        let word = [0, u32::MAX][random.below(2)];
        let gain = 0.3 + 0.6 * (f64::from(random.word()) / 4_294_967_296.0) as f32;
        let octaves = 1.0 + 9.0 * (f64::from(random.word()) / 4_294_967_296.0) as f32;
        let normalisation = [Normalization::UnitRange, Normalization::UnitVariance][random.below(2)];
        let footprint = [0.0, 0.05, 0.3][random.below(3)];
        let sum = Fbm::<_, Vec2>::new(
            WhiteNoise::new(0).with_lattice(Chosen([word; 256])),
            FbmSpectrum::new(2.0, gain, 10).expect("a gain below 1"),
        )
        .with_shape(shape)
        .with_normalization(normalisation)
        .with_octaves(octaves)
        .band_limited(footprint);
        let ([low, high], value) = (Field::<Vec2>::range(&sum), sum.value(Vec2::new(0.3, 0.7)));
        if !(low..=high).contains(&value) {
            found.push(format!("{shape:?} of {octaves} octaves, gain {gain}: {value} of [{low}, {high}]"));
        }
    }
}

#[test]
fn range_of_octaves_holds_with_all_octaves_at_a_bound() {
    let (mut random, mut found) = (Random(SplitMix64 { state: 2 }), Vec::new());
    sums(&mut random, &mut found, Signed);
    sums(&mut random, &mut found, Turbulence);
    sums(&mut random, &mut found, Plasma);
    sums(&mut random, &mut found, Billow);
    sums(&mut random, &mut found, Ridged);
    let spectrum = FbmSpectrum::default();
    search!(random, found, "fBm of simplex", |w| {
        Fbm::new(Simplex::new(0).with_lattice(Chosen(w)), spectrum)
            .with_normalization(Normalization::UnitRange)
    });
    search!(random, found, "ridged multifractal", |w| {
        RidgedMultifractal::new(ValueNoise::new(0).with_lattice(Chosen(w)), spectrum, 2.0).unwrap()
    });
    // A kind with a range smaller than 1, so that a ridged octave is never 0 and a weak octave is
    // smaller.
    search!(random, found, "ridged multifractal of low cells", |w| {
        let cells = Cellular::new(0).with_jitter(0.0).unwrap().with_lattice(Chosen(w));
        RidgedMultifractal::new(cells, spectrum, 0.1).unwrap()
    });
    search!(random, found, "unit", |w| Unit(Simplex::new(0).with_lattice(Chosen(w))));
    let (excess, position) = excess::<Vec2, _, 2>(&mut random, |w| {
        let simplex = Simplex::new(0).with_lattice(Chosen(w));
        Warp::new(simplex, [simplex; 2], 1e3).unwrap()
    });
    assert!(found.is_empty() && excess <= 0.0, "{} warp {excess:e} at {position}", found.join("\n"));
}

/// A field with the same value everywhere.
#[derive(Clone, Copy)]
struct Constant(f32);

impl Field<f32> for Constant {
    fn sample(&self, _: f32) -> Sample<f32> {
        Sample { value: self.0, gradient: 0.0 }
    }
    fn range(&self) -> [f32; 2] {
        [self.0; 2]
    }
}

#[test]
fn range_of_transforms_holds_for_constants() {
    let mut random = Random(SplitMix64 { state: 3 });
    for _ in 0..100_000 {
        let [a, b, c] = [(); 3].map(|()| {
            let x = (f64::from(random.word()) / 2_147_483_648.0 - 1.0) as f32;
            [x, x, 0.0, 1.0][random.below(4)]
        });
        let power = random.below(9) as u8;
        let fields: [Box<dyn Field<f32>>; 7] = [
            Box::new(Add(Constant(a), Constant(b))),
            Box::new(Multiply(Constant(a), Constant(b))),
            Box::new(Blend(Constant(a), Constant(b), Constant(c))),
            Box::new(Blend(Constant(a), Constant(b), Constant(c.abs()))),
            Box::new(Clamp(Constant(a), b.min(c), b.max(c))),
            Box::new(ScaleBias(Constant(a), b, c)),
            Box::new(Power(Constant(a), power)),
        ];
        for (k, field) in fields.iter().enumerate() {
            let ([low, high], value) = (field.range(), field.value(0.0));
            assert!(
                (low..=high).contains(&value),
                "transform {k} of {a} {b} {c}: {value} of [{low}, {high}]"
            );
        }
    }
}

#[test]
fn range_of_simplex_holds_on_rows_and_lists_with_the_same_bits() {
    // Within ±1000 of the origin about one value in 10⁵ is beyond 1 before the clamp.
    for seed in 0..8 {
        let noise = Simplex::new(seed);
        for origin in [Vec2::new(-900.0, 850.0), Vec2::new(5e5, 1e5), Vec2::new(3.0, 4.0)] {
            let grid = Grid { origin, step: Vec2::splat(0.11), size: [300, 40] };
            let mut values = vec![0.0; grid.len()];
            noise.grid_values(&grid, &mut values).unwrap();
            for (k, value) in values.into_iter().enumerate() {
                let p = grid.origin + grid.step * Vec2::new((k % 300) as f32, (k / 300) as f32);
                assert!(value.abs() <= 1.0, "{value} at {p}");
                assert_eq!(value.to_bits(), noise.value(p).to_bits(), "{p}");
            }
        }
    }
}
