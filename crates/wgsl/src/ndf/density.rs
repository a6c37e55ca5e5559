//! Closed forms of normal distributions, and their numeric functions and frames.

use crate::part::{Part, part};

/// Exponential, logarithm, sine and cosine with the bits of [`Ggx`](asperity_ndf_sampling::Ggx) and
/// [`Beckmann`](asperity_ndf_sampling::Beckmann).
///
/// Compilers cannot transform their operations.
pub(crate) static ELEMENTARY: Part = part!("ndf/numeric/elementary");

/// Gaussian distribution function, its tail and its quantile in 32 bits:
/// [`gaussian_cdf`](asperity_ndf_sampling::gaussian_cdf),
/// [`inverse_gaussian_cdf`](asperity_ndf_sampling::inverse_gaussian_cdf).
pub(crate) static NORMAL_DISTRIBUTION: Part = part!("ndf/numeric/normal_distribution", ELEMENTARY);

/// Clamped roughness, and vectors stretched by it.
pub(crate) static ROUGHNESS: Part = part!("ndf/density/roughness", ELEMENTARY);

/// Smith masking and shadowing for any Λ, and views from below:
/// [`Microfacet`](asperity_ndf_sampling::Microfacet).
pub(crate) static MICROFACET: Part = part!("ndf/microfacet", ELEMENTARY);

/// Tangent frames by the minimal rotation: [`Frame`](asperity_ndf_sampling::Frame).
pub(crate) static FRAME: Part = part!("ndf/frame", ELEMENTARY);

/// Gaussian coordinates, split into a resolved part and the rest:
/// [`GaussianSplit`](asperity_ndf_sampling::GaussianSplit).
pub(crate) static GAUSSIAN_SPLIT: Part = part!("ndf/level_of_detail/gaussian_split", ELEMENTARY);

/// Gaussian slopes of any mean and covariance,
/// [`OffsetBeckmann`](asperity_ndf_sampling::OffsetBeckmann), in 32 bits.
pub(crate) static OFFSET_BECKMANN: Part =
    part!("ndf/level_of_detail/offset_beckmann", ELEMENTARY, GAUSSIAN_SPLIT);

/// GGX: density, bijection and inverse, samples, visible normals, masking, conditional density,
/// with the bits of [`Ggx`](asperity_ndf_sampling::Ggx).
pub static GGX: Part = part!("ndf/density/ggx", ELEMENTARY, ROUGHNESS, MICROFACET, GAUSSIAN_SPLIT);

/// Slopes along a view of Gaussian slopes, for visible normals of [`BECKMANN`].
pub(crate) static VISIBLE_SLOPES: Part = part!("ndf/density/visible_slopes", ELEMENTARY, NORMAL_DISTRIBUTION);

/// Beckmann: density, bijection and inverse, samples, visible normals, masking, conditional
/// density.
///
/// It has the bits of [`Beckmann`](asperity_ndf_sampling::Beckmann), with visible normals as in its
/// batch methods and masking in 32 bits.
pub static BECKMANN: Part = part!(
    "ndf/density/beckmann",
    ELEMENTARY,
    NORMAL_DISTRIBUTION,
    ROUGHNESS,
    MICROFACET,
    GAUSSIAN_SPLIT,
    VISIBLE_SLOPES,
);

/// Student's t in one dimension, for masking and visible normals of [`STUDENT_T`].
pub(crate) static STUDENT_DISTRIBUTION: Part =
    part!("ndf/density/student_distribution", ELEMENTARY, NORMAL_DISTRIBUTION);

/// Student's t: density, bijection and inverse, samples, visible normals and masking in 32 bits;
/// [`StudentT`](asperity_ndf_sampling::StudentT).
pub static STUDENT_T: Part =
    part!("ndf/density/student_t", ELEMENTARY, ROUGHNESS, MICROFACET, STUDENT_DISTRIBUTION);

/// Blinn–Phong, by Student's t; [`BlinnPhong`](asperity_ndf_sampling::BlinnPhong).
pub static BLINN_PHONG: Part = part!("ndf/density/blinn_phong", ELEMENTARY, ROUGHNESS, STUDENT_T);

/// The lobe of Ward; everything else of [`Ward`](asperity_ndf_sampling::Ward) is [`BECKMANN`].
pub static WARD: Part = part!("ndf/density/ward", ELEMENTARY);

/// Ashikhmin–Shirley: density, bijection and inverse, and samples in 32 bits;
/// [`AshikhminShirley`](asperity_ndf_sampling::AshikhminShirley).
pub static ASHIKHMIN_SHIRLEY: Part = part!("ndf/density/ashikhmin_shirley", ELEMENTARY);
