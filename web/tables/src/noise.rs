//! Noise of every type, dimension and sum, by numbers: words of uniforms, values and gradients at
//! points.
//!
//! A field is encoded by the numbers of [`Spec`], followed by the other arguments of the query.

use alloc::{string::String, string::ToString, vec::Vec};

use asperity_noise::glam::{Vec2, Vec3, Vec4};
use asperity_noise::gpu::{FbmUniform2d, FbmUniform3d, FbmUniform4d};
use asperity_noise::{
    Billow, Cellular, CellularOutput, Fbm, FbmSpectrum, Field, GaussianNoise, Metric, Moments, Normalization,
    Perlin, PerlinClassic, Plasma, Point, Ridged, Sample, Shape, Signed, Simplex, SparseConvolution,
    Turbulence, ValueCatmullRom, ValueGradient, ValueNoise, WhiteNoise,
};

use crate::{float, number, words};

/// A noise chosen at run time.
///
/// A single type, so that sums, warps and batches are compiled once per dimension.
#[derive(Clone, Copy, Debug)]
enum Kind {
    White(WhiteNoise),
    Value(ValueNoise),
    CatmullRom(ValueCatmullRom),
    PerlinClassic(PerlinClassic),
    Perlin(Perlin),
    ValueGradient(ValueGradient),
    Simplex(Simplex),
    Sparse(SparseConvolution),
    Gaussian(GaussianNoise),
    Cellular(Cellular),
}

macro_rules! each {
    ($kind:expr, $noise:ident => $value:expr) => {
        match $kind {
            Kind::White($noise) => $value,
            Kind::Value($noise) => $value,
            Kind::CatmullRom($noise) => $value,
            Kind::PerlinClassic($noise) => $value,
            Kind::Perlin($noise) => $value,
            Kind::ValueGradient($noise) => $value,
            Kind::Simplex($noise) => $value,
            Kind::Sparse($noise) => $value,
            Kind::Gaussian($noise) => $value,
            Kind::Cellular($noise) => $value,
        }
    };
}

macro_rules! field {
    ($vector:ty, $dimension:literal: $($kind:ident),*) => {
        impl Field<$vector> for Kind {
            fn sample(&self, p: $vector) -> Sample<$vector> {
                let _ = p;
                match self {
                    $(Self::$kind(noise) => noise.sample(p),)*
                    _ => Sample::default(),
                }
            }

            /// Unbounded: the page displays measured ranges.
            fn range(&self) -> [f32; 2] {
                [-1.0, 1.0]
            }

            fn moments(&self) -> Option<Moments> {
                if let Self::Cellular(noise) = self {
                    return Field::<$vector>::moments(noise);
                }
                let [standard_deviation, absolute @ ..] = self.moments($dimension);
                Some(Moments { mean: 0.0, standard_deviation, absolute })
            }

            fn seed(&self) -> u32 {
                each!(self, noise => Field::<$vector>::seed(noise))
            }

            fn with_octave_seed(&self, seed: u32) -> Option<Self> {
                let _ = seed;
                match self {
                    $(Self::$kind(noise) => Some(Self::$kind(noise.with_seed(seed))),)*
                    _ => Some(*self),
                }
            }
        }
    };
}

field!(Vec2, 2:);
field!(Vec3, 3: Perlin);
field!(Vec4, 4:);

impl Kind {
    /// Returns standard deviation and absolute moments in two to four dimensions: the crate's
    /// numbers without its distribution tables.
    fn moments(&self, dimension: usize) -> [f32; 5] {
        let row = match self {
            Self::White(_) | Self::Cellular(_) => 0,
            Self::Value(_) => 1,
            Self::CatmullRom(_) => 2,
            Self::PerlinClassic(_) => 3,
            Self::Perlin(_) => 4,
            Self::ValueGradient(_) => 5,
            Self::Simplex(noise) => {
                if noise.radius_squared() > 0.5 {
                    7
                } else {
                    6
                }
            }
            Self::Sparse(_) => 8,
            Self::Gaussian(_) => 9,
        };
        MOMENTS[row][dimension.clamp(2, 4) - 2]
    }
}

/// Numbers of [`Kind::moments`] by noise and dimension.
const MOMENTS: [[[f32; 5]; 3]; 10] = [
    [
        [0.5773919, 0.5, 0.33333334, 0.25, 0.2],
        [0.5773298, 0.5, 0.33333334, 0.25, 0.2],
        [0.57723147, 0.5, 0.33333334, 0.25, 0.2],
    ],
    [
        [0.4523424, 0.37837744, 0.20446168, 0.12968361, 0.09028866],
        [0.40053722, 0.3300845, 0.16030562, 0.09324836, 0.060399774],
        [0.3544084, 0.28815567, 0.12567042, 0.0669737, 0.04032589],
    ],
    [
        [0.30100214, 0.250851, 0.09051935, 0.038586993, 0.018160513],
        [0.21722761, 0.17862236, 0.04718223, 0.0150150135, 0.005352762],
        [0.15676045, 0.12746914, 0.024575373, 0.0058078887, 0.0015583999],
    ],
    [
        [0.29933193, 0.24096896, 0.08961822, 0.041041654, 0.021271652],
        [0.21075515, 0.17101581, 0.044365298, 0.014182023, 0.0051762713],
        [0.15724237, 0.1273838, 0.024726365, 0.0059461696, 0.0016426502],
    ],
    [
        [0.32634497, 0.26654628, 0.10652046, 0.051993575, 0.028686183],
        [0.26052728, 0.21252717, 0.067942336, 0.026501851, 0.011724584],
        [0.19045784, 0.15477757, 0.03632891, 0.010486159, 0.003452656],
    ],
    [
        [0.27272198, 0.22487889, 0.074377276, 0.029604813, 0.013218229],
        [0.22854115, 0.1868215, 0.05223106, 0.017771091, 0.0068308464],
        [0.19637597, 0.15884116, 0.03856352, 0.011561864, 0.003956423],
    ],
    [
        [0.54358596, 0.47109926, 0.2954812, 0.20851243, 0.1570514],
        [0.39238557, 0.31395093, 0.15403585, 0.09302674, 0.06323871],
        [0.25369492, 0.17663564, 0.06432908, 0.032241628, 0.019176608],
    ],
    [
        [0.47218463, 0.40576988, 0.22299792, 0.14022994, 0.095634624],
        [0.43461967, 0.36018768, 0.18895745, 0.11768127, 0.081005216],
        [0.29993027, 0.22854008, 0.089936756, 0.04603103, 0.027398402],
    ],
    [
        [0.99916714, 0.75179833, 0.99674565, 1.7337363, 3.604708],
        [1.0015045, 0.72093296, 0.9985783, 1.8955398, 4.408499],
        [0.99966854, 0.6942725, 1.0025611, 2.063683, 5.3205633],
    ],
    [
        [1.0, 0.7978846, 1.0, 1.5957692, 3.0],
        [1.0, 0.7978846, 1.0, 1.5957692, 3.0],
        [1.0, 0.7978846, 1.0, 1.5957692, 3.0],
    ],
];

/// A shape chosen at run time, by its number in shaders.
#[derive(Clone, Copy, Debug)]
struct AnyShape(u32);

macro_rules! shaped {
    ($number:expr, $shape:ident => $value:expr) => {
        match $number {
            1 => {
                let $shape = Turbulence;
                $value
            }
            2 => {
                let $shape = Plasma;
                $value
            }
            3 => {
                let $shape = Billow;
                $value
            }
            4 => {
                let $shape = Ridged;
                $value
            }
            _ => {
                let $shape = Signed;
                $value
            }
        }
    };
}

impl Shape for AnyShape {
    fn value(self, n: f32) -> f32 {
        shaped!(self.0, shape => shape.value(n))
    }

    fn slope(self, n: f32) -> f32 {
        shaped!(self.0, shape => shape.slope(n))
    }

    fn range(self, bound: f32) -> [f32; 2] {
        shaped!(self.0, shape => shape.range(bound))
    }

    fn mean_and_deviation(self, standard_deviation: f32, moments: [f32; 4]) -> [f32; 2] {
        shaped!(self.0, shape => shape.mean_and_deviation(standard_deviation, moments))
    }
}

/// The encoding of a field.
struct Spec {
    dimension: u32,
    kind: u32,
    seed: u32,
    /// 0 is one octave, 1 a sum, 2 the octaves of a ridged multifractal.
    sum: u32,
    shape: AnyShape,
    spectrum: FbmSpectrum,
    octaves: f32,
    normalisation: Normalization,
    footprint: f32,
    basis: CellularOutput,
    metric: Metric,
    jitter: f32,
}

/// Sums in a shader's uniform: the field, its warp fields, and the second field of a flow in space.
const FLOW: u32 = 4;

impl Spec {
    fn new(numbers: &[f64]) -> Result<Self, String> {
        let word = |at| number(numbers, at) as u32;
        let spectrum = FbmSpectrum::new(float(numbers, 5), float(numbers, 6), FbmSpectrum::MAX_OCTAVES)
            .map_err(|error| error.to_string())?;
        Ok(Self {
            dimension: word(0),
            kind: word(1),
            seed: word(2),
            sum: word(3),
            shape: AnyShape(word(4)),
            spectrum,
            octaves: float(numbers, 7),
            normalisation: if word(8) == 0 { Normalization::UnitRange } else { Normalization::UnitVariance },
            footprint: float(numbers, 9),
            basis: [CellularOutput::F1, CellularOutput::F2, CellularOutput::F2MinusF1, CellularOutput::Cell]
                [word(12).min(3) as usize],
            metric: [Metric::Euclidean, Metric::Manhattan, Metric::Chebyshev][word(13).min(2) as usize],
            jitter: float(numbers, 14),
        })
    }

    fn noise(&self, seed: u32) -> Result<Kind, String> {
        Ok(match self.kind {
            0 => Kind::White(WhiteNoise::new(seed)),
            1 => Kind::Value(ValueNoise::new(seed)),
            2 => Kind::CatmullRom(ValueCatmullRom::new(seed)),
            3 => Kind::PerlinClassic(PerlinClassic::new(seed)),
            4 => Kind::Perlin(Perlin::new(seed)),
            5 => Kind::ValueGradient(ValueGradient::new(seed)),
            6 => Kind::Simplex(Simplex::new(seed)),
            7 => Kind::Simplex(Simplex::new(seed).with_classic_radius()),
            8 => Kind::Sparse(SparseConvolution::new(seed)),
            9 => Kind::Gaussian(GaussianNoise::new(seed)),
            _ => Kind::Cellular(
                Cellular::new(seed)
                    .with_output(self.basis)
                    .with_metric(self.metric)
                    .with_jitter(self.jitter)
                    .map_err(|error| error.to_string())?,
            ),
        })
    }

    fn octaves<V: Point>(&self, seed: u32, shape: AnyShape) -> Result<Sum<V>, String>
    where
        Kind: Field<V>,
    {
        let noise = self.noise(seed)?;
        let sum = if self.sum == 0 {
            Fbm::single(noise)
        } else {
            Fbm::new(noise, self.spectrum).with_normalization(self.normalisation).with_octaves(self.octaves)
        };
        Ok(sum.with_shape(shape).band_limited(self.footprint))
    }

    /// Returns the shape of the field itself, which is the shape of its sum. Warp fields have none.
    fn shape(&self) -> AnyShape {
        if self.sum == 1 { self.shape } else { AnyShape(0) }
    }
}

type Sum<V> = Fbm<Kind, V, AnyShape>;

macro_rules! uniform {
    ($spec:expr, $vector:ty, $uniform:ident) => {{
        let mut sums = Vec::new();
        for sum in 0..=FLOW {
            let shape = if sum == 0 || sum == FLOW { $spec.shape() } else { AnyShape(0) };
            let octaves = $spec.octaves::<$vector>($spec.seed.wrapping_add(sum), shape)?;
            let mut uniform = octaves.with_shape(Signed).gpu();
            [uniform.spectrum.mean, uniform.spectrum.deviation] = octaves.octave_moments();
            uniform.spectrum.shape = shape.0;
            sums.push(uniform);
        }
        words(&$uniform::array(&sums))
    }};
}

/// Returns the uniform of a field's sums.
pub(crate) fn noise_uniform(numbers: &[f64], _: &[u32]) -> Result<Vec<u32>, String> {
    let spec = Spec::new(numbers)?;
    Ok(match spec.dimension {
        2 => uniform!(spec, Vec2, FbmUniform2d),
        3 => uniform!(spec, Vec3, FbmUniform3d),
        _ => uniform!(spec, Vec4, FbmUniform4d),
    })
}

/// Returns mean and deviation of one octave, in 32 bits.
pub(crate) fn noise_moments(numbers: &[f64], _: &[u32]) -> Result<Vec<u32>, String> {
    fn moments<V: Point>(kind: &impl Field<V>) -> Vec<u32> {
        let moments = kind.moments().map(|moments| [moments.mean, moments.standard_deviation]);
        moments.unwrap_or_default().map(f32::to_bits).to_vec()
    }
    let spec = Spec::new(numbers)?;
    let kind = spec.noise(spec.seed)?;
    Ok(match spec.dimension {
        2 => moments::<Vec2>(&kind),
        3 => moments::<Vec3>(&kind),
        _ => moments::<Vec4>(&kind),
    })
}

/// Returns the value and the slopes of a field at each of the points in bulk, for unwarped sums of
/// Perlin noise in space.
///
/// All other fields, which the GPU evaluates, would take a quarter of the page.
pub(crate) fn noise_samples(numbers: &[f64], bulk: &[u32]) -> Result<Vec<u32>, String> {
    fn samples<V: Point<Coordinates = [f32; N]>, const N: usize>(sum: Sum<V>, points: &[f32]) -> Vec<u32>
    where
        Kind: Field<V>,
    {
        let mut words = Vec::with_capacity(points.len() / N * (1 + N));
        for p in points.as_chunks::<N>().0 {
            let sample = sum.sample(V::from_coordinates(*p));
            words.push(sample.value.to_bits());
            words.extend(sample.gradient.coordinates().map(f32::to_bits));
        }
        words
    }
    let spec = Spec::new(numbers)?;
    let points: Vec<f32> = bulk.iter().map(|&word| f32::from_bits(word)).collect();
    match (spec.noise(spec.seed)?, spec.dimension, spec.sum) {
        (Kind::Perlin(_), 3, 0 | 1) => {
            Ok(samples::<Vec3, 3>(spec.octaves(spec.seed, spec.shape())?, &points))
        }
        _ => Err("This noise is drawn here, but not told by the module.".to_string()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const KINDS: u32 = 11;
    const SPEC: usize = 15;

    fn spec(dimension: u32, kind: u32, sum: u32) -> [f64; SPEC] {
        let all = [dimension, kind, 7, sum].map(f64::from);
        let further = [3.0, 2.17, 0.5, 4.5, 1.0, 0.02, 2.0, 0.0, 2.0, 0.0, 0.8];
        core::array::from_fn(|i| if i < 4 { all[i] } else { further[i - 4] })
    }

    #[test]
    fn moments_match_the_crate() {
        macro_rules! moments {
            ($vector:ty, $dimension:literal, $kind:expr) => {{
                let noise = Spec::new(&spec($dimension, $kind, 1)).unwrap().noise(0).unwrap();
                each!(noise, noise => {
                    let moments = Field::<$vector>::moments(&noise).unwrap();
                    let [a, b, c, d] = moments.absolute;
                    [moments.standard_deviation, a, b, c, d]
                })
            }};
        }
        let crates: Vec<_> = (0..10)
            .map(|kind| [moments!(Vec2, 2, kind), moments!(Vec3, 3, kind), moments!(Vec4, 4, kind)])
            .collect();
        assert_eq!(MOMENTS, *crates, "{crates:?}");
    }

    #[test]
    fn field_matches_the_crate() {
        let p = Vec3::new(0.3, -1.2, 4.5);
        let spectrum = FbmSpectrum::new(2.17, 0.5, 16).unwrap();
        let sum = Fbm::<_, Vec3>::new(Perlin::new(7), spectrum)
            .with_shape(Billow)
            .with_octaves(4.5)
            .band_limited(0.02);
        let sample = noise_samples(&spec(3, 4, 1), &p.to_array().map(f32::to_bits)).unwrap();
        assert_eq!(sample[0], sum.sample(p).value.to_bits());
        assert_eq!(sample[1], sum.sample(p).gradient.x.to_bits());
        let words = noise_uniform(&spec(3, 4, 1), &[]).unwrap();
        assert_eq!(words[..264], super::words(&sum.gpu()));
    }

    #[test]
    fn invalid_numbers_are_one_sentence() {
        for (at, x) in [(5, 0.5), (6, f64::NAN), (14, 2.0)] {
            for kind in 0..KINDS {
                let mut spec = spec(2, kind, 2);
                spec[at] = x;
                let told = noise_uniform(&spec, &[]);
                assert!(told.is_ok() || told.is_err_and(|error| error.lines().count() == 1));
            }
        }
        assert!(noise_samples(&spec(4, 4, 1), &[]).is_err());
        assert!(noise_uniform(&[2.0], &[]).is_err());
    }
}
