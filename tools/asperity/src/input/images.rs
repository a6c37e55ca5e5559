//! Options of commands that read density images and normal maps.

use asperity_ndf_sampling::{
    Measure, Reconstruction,
    normal_map::{Blue, TangentSpace},
};
use clap::Args;

use crate::input::words::{Words, one_of};

/// Options for reading images.
#[derive(Clone, Copy, Debug, PartialEq, Args)]
pub struct Images {
    /// Measure over which an image's gray values are a density [default: normals].
    #[arg(long, value_parser = one_of(MEASURES))]
    pub measure: Option<Measure>,
    /// Interpolation of a density between the pixels of its image [default: constant].
    #[arg(long, value_parser = one_of(RECONSTRUCTIONS))]
    pub reconstruction: Option<Reconstruction>,
    /// Direction of the green channel of a normal map [default: opengl].
    #[arg(long, value_parser = one_of(TANGENT_SPACES))]
    pub tangent_space: Option<TangentSpace>,
    /// Content of the blue channel of a normal map [default: z, unless blue is constant].
    #[arg(long, value_parser = one_of(BLUES))]
    pub blue: Option<Blue>,
}

impl Images {
    /// Options with every value unset.
    pub const USUAL: Self = Self { measure: None, reconstruction: None, tangent_space: None, blue: None };
}

const RECONSTRUCTIONS: &Words<Reconstruction> = &[
    ("constant", "Constant on each pixel", Reconstruction::Constant),
    ("bilinear", "Bilinear between pixel centers", Reconstruction::Bilinear),
];

const TANGENT_SPACES: &Words<TangentSpace> = &[
    ("opengl", "Green points up the image", TangentSpace::OpenGl),
    ("directx", "Green points down the image", TangentSpace::DirectX),
];

const BLUES: &Words<Blue> = &[
    ("z", "The z component", Blue::Read),
    ("unused", "Unused: z is computed from x and y", Blue::Reconstructed),
];

const MEASURES: &Words<Measure> = &[
    ("normals", "Over (n_x, n_y): the value is proportional to D", Measure::ProjectedSolidAngle),
    ("solid-angle", "Over solid angle: the value is proportional to D cos θ", Measure::SolidAngle),
];
