//! Options of commands that read images of densities and normal maps.

use asperity_ndf_sampling::{
    Measure, Reconstruction,
    normal_map::{Blue, TangentSpace},
};
use clap::Args;

use crate::input::words::{Words, one_of};

/// Options for reading images.
#[derive(Clone, Copy, Debug, PartialEq, Args)]
pub struct Images {
    /// Measure that an image's grey values are a density over [default: normals].
    #[arg(long, value_parser = one_of(MEASURES))]
    pub measure: Option<Measure>,
    /// Reconstruction of a density between the pixels of its image [default: constant].
    #[arg(long, value_parser = one_of(RECONSTRUCTIONS))]
    pub reconstruction: Option<Reconstruction>,
    /// Which way the green channel of a normal map points [default: opengl].
    #[arg(long, value_parser = one_of(TANGENT_SPACES))]
    pub tangent_space: Option<TangentSpace>,
    /// Content of the blue channel of a normal map [default: z, unless blue is constant].
    #[arg(long, value_parser = one_of(BLUES))]
    pub blue: Option<Blue>,
}

impl Images {
    /// Values of options that are not given.
    pub const USUAL: Self = Self { measure: None, reconstruction: None, tangent_space: None, blue: None };
}

const RECONSTRUCTIONS: &Words<Reconstruction> = &[
    ("constant", "Constant on each pixel", Reconstruction::Constant),
    ("bilinear", "Bilinear between the centres of pixels", Reconstruction::Bilinear),
];

const TANGENT_SPACES: &Words<TangentSpace> =
    &[("opengl", "Up the image", TangentSpace::OpenGl), ("directx", "Down the image", TangentSpace::DirectX)];

const BLUES: &Words<Blue> = &[
    ("z", "The third coordinate", Blue::Read),
    ("unused", "Nothing: the third coordinate is computed from two", Blue::Reconstructed),
];

const MEASURES: &Words<Measure> = &[
    ("normals", "Over (n_x, n_y): the value is D itself, up to a factor", Measure::Normals),
    ("solid-angle", "Over solid angle: the value is D cos θ, up to a factor", Measure::SolidAngle),
];
