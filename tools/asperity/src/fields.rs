//! Noise chosen by options: octaves of a kind in the plane.

use std::fmt::Display;

use asperity_noise::{
    Billow, Cellular, CellularOutput, Fbm, FbmSpectrum, Field, GaussianNoise, Metric, Perlin, Point, Ridged,
    Sample, Shape, Signed, Simplex, SparseConvolution, Turbulence, ValueNoise, WhiteNoise,
};
use glam::{Vec2, Vec3};

use crate::cli::noise::{NoiseKind, Sum};
use crate::failure::{Failure, Result};

/// A field chosen at run time.
pub(crate) type Chosen = Box<dyn Field<Vec2> + Send + Sync>;

/// An error of tiles in the words of the options.
pub(crate) fn tile_error(error: &dyn Display) -> Failure {
    format!("`--tileable`: {}", error.to_string().replace("`periods[0]`", "`--cells`")).into()
}

/// A sum of octaves of a noise.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Octaves {
    pub(crate) kind: NoiseKind,
    pub(crate) output: CellularOutput,
    pub(crate) metric: Metric,
    pub(crate) sum: Sum,
    /// The octaves; one octave if `None`.
    pub(crate) spectrum: Option<FbmSpectrum>,
    pub(crate) seed: u32,
}

impl Octaves {
    /// Returns the field, with these periods if any.
    pub(crate) fn field(&self, periods: Option<[u32; 2]>) -> Result<Chosen> {
        let &Self { kind, output, metric, seed, .. } = self;
        macro_rules! octaves {
            ($noise:expr) => {{
                let octaves = self.octaves($noise);
                match periods {
                    Some(periods) => Box::new(octaves.tiled(periods)?),
                    None => Box::new(octaves),
                }
            }};
        }
        Ok(match (kind, periods) {
            (NoiseKind::Gaussian, _) => octaves!(GaussianNoise::new(seed)),
            (NoiseKind::Perlin, _) => octaves!(Perlin::new(seed)),
            (NoiseKind::Value, _) => octaves!(ValueNoise::new(seed)),
            (NoiseKind::Sparse, _) => octaves!(SparseConvolution::new(seed)),
            (NoiseKind::Cellular, _) => octaves!(Cellular::new(seed).with_output(output).with_metric(metric)),
            (NoiseKind::White, _) => octaves!(WhiteNoise::new(seed)),
            (NoiseKind::Simplex, None) => Box::new(self.octaves(Simplex::new(seed))),
            // In the plane, the simplicial lattice is not periodic along the axes.
            (NoiseKind::Simplex, Some([x, y])) => {
                let octaves: Fbm<_, Vec3, _> = self.octaves(Simplex::new(seed));
                Box::new(Slice(octaves.tiled([x, y, x])?))
            }
        })
    }

    /// Returns the sum of the octaves of a noise.
    fn octaves<F: Field<V>, V: Point>(&self, noise: F) -> Fbm<F, V, Sum> {
        match self.spectrum {
            Some(spectrum) => Fbm::new(noise, spectrum),
            None => Fbm::single(noise),
        }
        .with_shape(self.sum)
    }
}

/// A field in space, sliced at z = 0.
struct Slice<F>(F);

impl<F: Field<Vec3>> Field<Vec2> for Slice<F> {
    fn sample(&self, p: Vec2) -> Sample<Vec2> {
        let Sample { value, gradient } = self.0.sample(p.extend(0.0));
        Sample { value, gradient: gradient.truncate() }
    }

    fn range(&self) -> [f32; 2] {
        self.0.range()
    }
}

/// One of the shapes of the crate. A type for each would multiply the code of all kinds.
macro_rules! delegate {
    ($sum:expr, $shape:ident => $call:expr) => {
        match $sum {
            Sum::Fbm => {
                let $shape = Signed;
                $call
            }
            Sum::Turbulence => {
                let $shape = Turbulence;
                $call
            }
            Sum::Billow => {
                let $shape = Billow;
                $call
            }
            Sum::Ridged => {
                let $shape = Ridged;
                $call
            }
        }
    };
}

impl Shape for Sum {
    fn value(self, n: f32) -> f32 {
        delegate!(self, shape => shape.value(n))
    }

    fn slope(self, n: f32) -> f32 {
        delegate!(self, shape => shape.slope(n))
    }

    fn range(self, bound: f32) -> [f32; 2] {
        delegate!(self, shape => shape.range(bound))
    }

    fn mean_and_deviation(self, standard_deviation: f32, moments: [f32; 4]) -> [f32; 2] {
        delegate!(self, shape => shape.mean_and_deviation(standard_deviation, moments))
    }
}
