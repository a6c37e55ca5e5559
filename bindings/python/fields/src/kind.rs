//! Kinds of noise, by name and parameters.

use asperity_noise::{
    Cellular, CellularOutput, Field, GaussianNoise, Metric, NoiseError, Perlin, PerlinClassic, Simplex,
    SparseConvolution, ValueCatmullRom, ValueGradient, ValueNoise, WhiteNoise,
};

/// A kind of noise on the standard lattice.
#[derive(Clone, Copy, Debug)]
pub enum Kind {
    /// One value per cell.
    White(WhiteNoise),
    /// Lattice values with quintic weights.
    Value(ValueNoise),
    /// Lattice values with a spline.
    ValueCatmullRom(ValueCatmullRom),
    /// Unit gradients with cubic weights.
    PerlinClassic(PerlinClassic),
    /// Edge directions with quintic weights.
    Perlin(Perlin),
    /// A weighted sum of value noise and gradient noise.
    ValueGradient(ValueGradient),
    /// Gradient noise on simplices.
    Simplex(Simplex),
    /// Impulses convolved with a kernel.
    Sparse(SparseConvolution),
    /// Distances to feature points.
    Cellular(Cellular),
    /// N(0, 1) at every point.
    Gaussian(GaussianNoise),
}

/// The parameters of all kinds; each kind uses its own.
#[derive(Clone, Copy, Debug)]
pub struct Parameters<'a> {
    /// The seed.
    pub seed: u32,
    /// The weight of the value noise of value-gradient noise.
    pub weight: f32,
    /// The impulses per cell of sparse noise.
    pub impulses: u32,
    /// The output of cellular noise.
    pub output: &'a str,
    /// The metric of cellular noise.
    pub metric: &'a str,
    /// The jitter of cellular noise.
    pub jitter: f32,
    /// Whether simplex noise has the classic radius.
    pub classic: bool,
}

impl Kind {
    /// Creates a kind from its name.
    ///
    /// # Errors
    ///
    /// If a name is unknown or a parameter is out of range.
    pub fn new(name: &str, parameters: &Parameters<'_>) -> Result<Self, String> {
        let Parameters { seed, weight, impulses, output, metric, jitter, classic } = *parameters;
        let said = |error: NoiseError| error.to_string();
        Ok(match name {
            "white" => Self::White(WhiteNoise::new(seed)),
            "value" => Self::Value(ValueNoise::new(seed)),
            "value_catmull_rom" => Self::ValueCatmullRom(ValueCatmullRom::new(seed)),
            "perlin_classic" => Self::PerlinClassic(PerlinClassic::new(seed)),
            "perlin" => Self::Perlin(Perlin::new(seed)),
            "value_gradient" => {
                Self::ValueGradient(ValueGradient::new(seed).with_weight(weight).map_err(said)?)
            }
            "simplex" if classic => Self::Simplex(Simplex::new(seed).with_classic_radius()),
            "simplex" => Self::Simplex(Simplex::new(seed)),
            "sparse_convolution" => {
                Self::Sparse(SparseConvolution::new(seed).with_impulses(impulses).map_err(said)?)
            }
            "cellular" => Self::Cellular(
                Cellular::new(seed)
                    .with_output(output_of(output)?)
                    .with_metric(metric_of(metric)?)
                    .with_jitter(jitter)
                    .map_err(said)?,
            ),
            "gaussian" => Self::Gaussian(GaussianNoise::new(seed)),
            _ => return Err(format!("unknown kind of noise `{name}`")),
        })
    }
}

impl Kind {
    /// Returns the kind with another seed; 0 selects the kind itself.
    #[must_use]
    pub fn reseeded(self, by: u32) -> Self {
        macro_rules! kinds {
            ($($kind:ident),+) => {
                match self {
                    $(Self::$kind(noise) => {
                        let seed = Field::<f32>::seed(&noise).wrapping_add(by.wrapping_mul(0x9E37_79B9));
                        Self::$kind(noise.with_seed(seed))
                    })+
                }
            };
        }
        kinds!(
            White,
            Value,
            ValueCatmullRom,
            PerlinClassic,
            Perlin,
            ValueGradient,
            Simplex,
            Sparse,
            Cellular,
            Gaussian
        )
    }
}

fn output_of(name: &str) -> Result<CellularOutput, String> {
    Ok(match name {
        "f1" => CellularOutput::F1,
        "f2" => CellularOutput::F2,
        "f2_minus_f1" => CellularOutput::F2MinusF1,
        "cell" => CellularOutput::Cell,
        _ => return Err(format!("`output` must be f1, f2, f2_minus_f1 or cell, got `{name}`")),
    })
}

fn metric_of(name: &str) -> Result<Metric, String> {
    Ok(match name {
        "euclidean" => Metric::Euclidean,
        "manhattan" => Metric::Manhattan,
        "chebyshev" => Metric::Chebyshev,
        _ => return Err(format!("`metric` must be euclidean, manhattan or chebyshev, got `{name}`")),
    })
}
