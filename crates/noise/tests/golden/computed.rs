//! Values with golden bits: every kind and sum in every dimension.
//!
//! Needs neither std nor an allocator.

use asperity_noise::{
    Cellular, CellularOutput, Fbm, FbmSpectrum, Field, GaussianFbm, GaussianNoise, IntegerHash, Lattice,
    Metric, Normalization, Perlin, PerlinClassic, Point, Rotation, Sample, Simplex, SparseConvolution,
    ValueCatmullRom, ValueGradient, ValueNoise, WhiteNoise,
    glam::{Vec2, Vec3, Vec4},
    lattice::PermutationTable,
    simd::{Batch, Level},
};

/// The golden bits of a field: its sample at [`POINT`], and a digest of its samples at many points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Golden {
    pub(crate) dimension: usize,
    /// Value and gradient; 0 for axes that do not exist.
    pub(crate) sample: [u32; 5],
    pub(crate) digest: u32,
}

/// The point whose sample is written out.
const POINT: [f32; 4] = [-3.7, 12.3, 0.45, 7.1];
/// Points of a digest.
const POINTS: usize = 96;

/// The FNV-1a hash of words (Fowler, Noll, Vo), word by word.
fn digest(hash: u32, bits: u32) -> u32 {
    (hash ^ bits).wrapping_mul(0x0100_0193)
}

const START: u32 = 0x811c_9dc5;

/// Point `i` of a digest: near the origin, at lattice points, far away, and beyond all cells.
fn point<const N: usize>(i: u32) -> [f32; N] {
    let mut state = i.wrapping_mul(0x9e37_79b9);
    [(); N].map(|()| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        let x = (state >> 8) as f32 / 16_777_216.0 - 0.5;
        match i % 12 {
            0..=7 => x * 32.0,
            8 => (x * 32.0) as i32 as f32,
            9 => x * 200_000.0,
            10 => x * 6e9,
            _ => -0.0,
        }
    })
}

/// The golden bits of a field of points `V`, behind a pointer so that the digest is compiled once
/// per dimension.
fn golden<V: Point<Coordinates = [f32; N]>, const N: usize>(field: &dyn Fn(V) -> Sample<V>) -> Golden {
    let bits = |p: [f32; N]| {
        let sample = field(V::from_coordinates(p));
        let mut bits = [sample.value.to_bits(), 0, 0, 0, 0];
        for (to, x) in bits[1..].iter_mut().zip(sample.gradient.coordinates()) {
            *to = x.to_bits();
        }
        bits
    };
    let mut hash = START;
    for i in 0..POINTS as u32 {
        hash = bits(point::<N>(i)).into_iter().fold(hash, digest);
    }
    let mut p = [0.0; N];
    p.copy_from_slice(&POINT[..N]);
    Golden { dimension: N, sample: bits(p), digest: hash }
}

/// The digest of a field by a batch at a level.
fn batch_digest<V, const N: usize>(field: &dyn Field<V>, level: Level) -> u32
where
    V: Point<Coordinates = [f32; N]>,
{
    let (mut values, mut lists, mut gradients) = ([0.0; POINTS], [[0.0; POINTS]; N], [[0.0; POINTS]; N]);
    for i in 0..POINTS {
        for (list, x) in lists.iter_mut().zip(point::<N>(i as u32)) {
            list[i] = x;
        }
    }
    let mut slopes = gradients.iter_mut();
    let slopes = V::array(|_| slopes.next().map(|g| &mut g[..]).unwrap_or_default());
    let lists = V::array(|axis| &lists[axis][..]);
    if Batch::with_level(level).list_samples(field, lists, &mut values, slopes).is_err() {
        return 0;
    }
    let mut hash = START;
    for i in 0..POINTS {
        let mut bits = [values[i].to_bits(), 0, 0, 0, 0];
        for (to, component) in bits[1..].iter_mut().zip(&gradients) {
            *to = component[i].to_bits();
        }
        hash = bits.into_iter().fold(hash, digest);
    }
    hash
}

/// The golden bits of a field that is also evaluated in batches.
///
/// The digest is the digest of the first level with different bits, if there is one.
fn batched<V: Point<Coordinates = [f32; N]>, const N: usize>(field: &dyn Field<V>) -> Golden {
    let golden = golden(&|p: V| field.sample(p));
    let other =
        Level::available().map(|level| batch_digest(field, level)).find(|&hash| hash != golden.digest);
    Golden { digest: other.unwrap_or(golden.digest), ..golden }
}

/// A kind in every dimension.
fn kind<K>(name: &'static str, noise: &K, emit: &mut impl FnMut(&'static str, Golden))
where
    K: Field<f32> + Field<Vec2> + Field<Vec3> + Field<Vec4>,
{
    emit(name, golden(&|p: f32| noise.sample(p)));
    emit(name, golden(&|p: Vec2| noise.sample(p)));
    emit(name, golden(&|p: Vec3| noise.sample(p)));
    emit(name, golden(&|p: Vec4| noise.sample(p)));
}

/// A sum of octaves in every dimension. The bits of a sum of unit variance depend on the measured
/// statistics.
fn sum(
    name: &'static str,
    normalisation: Normalization,
    rotation: Rotation,
    emit: &mut impl FnMut(&'static str, Golden),
) {
    fn octaves<V: Point<Coordinates = [f32; N]>, const N: usize>(
        normalisation: Normalization,
        rotation: Rotation,
    ) -> Golden {
        let noise =
            Fbm::<_, V>::new(Perlin::new(17), FbmSpectrum::default()).with_normalization(normalisation);
        let noise = noise.with_rotation(rotation);
        golden(&|p: V| noise.sample_with_octaves(p, 6.5))
    }
    emit(name, octaves::<f32, 1>(normalisation, rotation));
    emit(name, octaves::<Vec2, 2>(normalisation, rotation));
    emit(name, octaves::<Vec3, 3>(normalisation, rotation));
    emit(name, octaves::<Vec4, 4>(normalisation, rotation));
}

fn gaussian_sum<V: Point<Coordinates = [f32; N]>, const N: usize>(
    emit: &mut impl FnMut(&'static str, Golden),
) {
    let noise = GaussianFbm::<V>::new(GaussianNoise::new(17), FbmSpectrum::default());
    emit("Gaussian octaves", golden(&|p: V| noise.sample_with_octaves(p, 6.5)));
    emit("Gaussian octaves, second channel", golden(&|p: V| noise.pair_with_octaves(p, 6.5)[1]));
    if N > 1 {
        let tangents = [0, 1].map(|first| V::from_axes(|axis| if axis == first { 1.0 } else { 0.0 }));
        emit(
            "Gaussian octaves, whitened gradient",
            golden(&|p: V| {
                let [value, other] = noise.whitened_gradient_with_octaves(p, tangents, 6.5);
                Sample { value, gradient: V::from_axes(|_| other) }
            }),
        );
    }
    emit("Gaussian octaves, height", golden(&|p: V| noise.height_with_octaves(p, 6.5)));
    emit("Gaussian, second channel", golden(&|p: V| GaussianNoise::new(17).pair(p)[1]));
    emit("Gaussian, not normalised", golden(&|p: V| GaussianNoise::new(17).unnormalized(p)));
    emit("variance of Gaussian", golden(&|p: V| GaussianNoise::new(17).variance(p)));
}

/// Passes the golden bits of every kind and sum in every dimension to `emit`.
pub(crate) fn fields(emit: &mut impl FnMut(&'static str, Golden)) {
    let table = PermutationTable::new(17);
    kind("Perlin 1985", &PerlinClassic::new(17), emit);
    kind("Perlin 2002", &Perlin::new(17), emit);
    kind("Perlin 2002 by permutation", &Perlin::new(17).with_lattice(table), emit);
    kind("simplex", &Simplex::new(17), emit);
    kind("wide simplex", &Simplex::new(17).with_classic_radius(), emit);
    kind("wide simplex by permutation", &Simplex::new(17).with_classic_radius().with_lattice(table), emit);
    kind("Gaussian", &GaussianNoise::new(17), emit);
    kind("white", &WhiteNoise::new(17), emit);
    kind("value", &ValueNoise::new(17), emit);
    kind("value, Catmull-Rom", &ValueCatmullRom::new(17), emit);
    kind("value-gradient", &ValueGradient::new(17), emit);
    kind("sparse", &SparseConvolution::new(17), emit);
    let cellular = Cellular::new(17);
    kind("cellular, F₁", &cellular, emit);
    kind(
        "cellular, F₂ − F₁, Manhattan",
        &cellular.with_output(CellularOutput::F2MinusF1).with_metric(Metric::Manhattan),
        emit,
    );
    kind(
        "cellular, F₂, Chebyshev",
        &cellular.with_output(CellularOutput::F2).with_metric(Metric::Chebyshev),
        emit,
    );
    kind("cellular, cell", &cellular.with_output(CellularOutput::Cell), emit);
    sum("octaves, range", Normalization::UnitRange, Rotation::Random, emit);
    sum("octaves, variance", Normalization::UnitVariance, Rotation::Random, emit);
    sum("octaves, aligned", Normalization::UnitRange, Rotation::Aligned, emit);
    gaussian_sum::<f32, 1>(emit);
    gaussian_sum::<Vec2, 2>(emit);
    gaussian_sum::<Vec3, 3>(emit);
    gaussian_sum::<Vec4, 4>(emit);
}

/// Passes the golden bits of batches to `emit`; they equal the bits of the same kinds and sums
/// above.
pub(crate) fn batches(emit: &mut impl FnMut(&'static str, Golden)) {
    emit("Perlin 2002", batched::<Vec3, 3>(&Perlin::new(17)));
    emit("simplex", batched::<Vec2, 2>(&Simplex::new(17)));
    emit("Gaussian", batched::<Vec2, 2>(&GaussianNoise::new(17)));
    let sum = GaussianFbm::<Vec2>::new(GaussianNoise::new(17), FbmSpectrum::default());
    emit("Gaussian octaves", batched::<Vec2, 2>(&sum.with_octaves(6.5)));
}

/// The digest of the variates of words.
fn drawn(components: impl IntoIterator<Item = f32>) -> u32 {
    components.into_iter().map(f32::to_bits).fold(START, digest)
}

/// Passes the digests of words, of their variates, and of the numbers of a spectrum to `emit`.
pub(crate) fn numbers(emit: &mut impl FnMut(&'static str, u32)) {
    let hash = |words: &mut dyn FnMut(i32) -> u32| (0..256).map(words).fold(START, digest);
    let cell = |i: i32| [i % 7 - 3, i / 7 - 18, i * 1_000_003, -i];
    let table = PermutationTable::new(17);
    emit("integer hash", hash(&mut |i| IntegerHash.word(cell(i), 17)));
    emit("integer hash, plane", hash(&mut |i| IntegerHash.word([i - 128, 5 * i], i as u32)));
    emit("permutation", hash(&mut |i| u32::from(table.entries()[i as usize])));
    emit("permutation, words", hash(&mut |i| table.word(cell(i), 17)));
    let word = |i: i32| IntegerHash.word([i], 1);
    emit("unit gradients", hash(&mut |i| drawn(PerlinClassic::gradient::<2>(word(i)))));
    emit("unit gradients, 3-D", hash(&mut |i| drawn(PerlinClassic::gradient::<3>(word(i)))));
    emit("unit gradients, 4-D", hash(&mut |i| drawn(PerlinClassic::gradient::<4>(word(i)))));
    emit("edge gradients", hash(&mut |i| drawn(Perlin::gradient::<2>(word(i)))));
    emit("edge gradients, 3-D", hash(&mut |i| drawn(Perlin::gradient::<3>(word(i)))));
    emit("edge gradients, 4-D", hash(&mut |i| drawn(Perlin::gradient::<4>(word(i)))));
    emit(
        "Gaussian corners",
        hash(&mut |i| {
            let [(a, [ax, ay, az, aw]), (b, [bx, by, bz, bw])] = GaussianNoise::variates::<4>(word(i));
            drawn([a, ax, ay, az, aw, b, bx, by, bz, bw])
        }),
    );
    let spectrum = FbmSpectrum::default();
    emit(
        "spectrum",
        hash(&mut |i| {
            let (octave, count) = (i as u32 % 10, i as f32 / 20.0);
            drawn([
                spectrum.frequency(octave),
                spectrum.amplitude(octave),
                spectrum.weight(count, octave),
                spectrum.sum_of_amplitudes(count),
                spectrum.root_sum_of_squares(count),
                spectrum.resolved_variance(count),
                spectrum.kurtosis_ratio(count),
            ])
        }),
    );
}
