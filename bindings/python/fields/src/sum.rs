//! Parameters of sums of octaves.

use asperity_noise::{
    Billow, FbmSpectrum, Normalization, Plasma, Ridged, Rotation, Shape, Signed, Turbulence,
};

/// What a sum of octaves is made with.
#[derive(Clone, Copy, Debug)]
pub struct Sum {
    /// Lacunarity, gain and the maximum number of octaves.
    pub spectrum: FbmSpectrum,
    /// The number of octaves.
    pub octaves: f32,
    /// The shape of every octave.
    pub shape: AnyShape,
    /// The divisor; the default of the field if `None`.
    pub normalization: Option<Normalization>,
    /// Whether octaves are rotated.
    pub rotation: Rotation,
    /// The feedback of a ridged multifractal.
    pub feedback: Option<f32>,
    /// The footprint that the sum is band-limited to.
    pub footprint: f32,
}

/// One of the shapes, chosen at run time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AnyShape {
    /// n.
    Signed,
    /// |n|.
    Turbulence,
    /// 1 − |n|.
    Plasma,
    /// 2|n| − 1.
    Billow,
    /// (1 − |n|)².
    Ridged,
}

impl AnyShape {
    /// Returns the shape of a name.
    ///
    /// # Errors
    ///
    /// If the name is unknown.
    pub fn new(name: &str) -> Result<Self, String> {
        Ok(match name {
            "signed" => Self::Signed,
            "turbulence" => Self::Turbulence,
            "plasma" => Self::Plasma,
            "billow" => Self::Billow,
            "ridged" => Self::Ridged,
            _ => {
                return Err(format!(
                    "`shape` must be signed, turbulence, plasma, billow or ridged, got `{name}`"
                ));
            }
        })
    }
}

macro_rules! of_shape {
    ($self:ident, $method:ident($($argument:expr),*)) => {
        match $self {
            Self::Signed => Signed.$method($($argument),*),
            Self::Turbulence => Turbulence.$method($($argument),*),
            Self::Plasma => Plasma.$method($($argument),*),
            Self::Billow => Billow.$method($($argument),*),
            Self::Ridged => Ridged.$method($($argument),*),
        }
    };
}

impl Shape for AnyShape {
    #[inline(always)]
    fn value(self, n: f32) -> f32 {
        of_shape!(self, value(n))
    }
    #[inline(always)]
    fn slope(self, n: f32) -> f32 {
        of_shape!(self, slope(n))
    }
    fn range(self, bound: f32) -> [f32; 2] {
        of_shape!(self, range(bound))
    }
    fn mean_and_deviation(self, standard_deviation: f32, moments: [f32; 4]) -> [f32; 2] {
        of_shape!(self, mean_and_deviation(standard_deviation, moments))
    }
}
