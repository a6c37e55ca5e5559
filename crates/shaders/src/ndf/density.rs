//! Closed forms of densities of normals, and the numbers and frames beneath them.

use crate::part::{Part, part};

/// Exponential, logarithm, sine and cosine that no compiler takes apart: those of
/// [`Ggx`](asperity_ndf_sampling::Ggx) and [`Beckmann`](asperity_ndf_sampling::Beckmann), bit for bit.
pub static ELEMENTARY: Part = part!("ndf/numeric/elementary");

/// Gaussian distribution function, its tail and quantile in 32 bits: [`phi`](fn@asperity_ndf_sampling::phi),
/// [`inverse_phi`](asperity_ndf_sampling::inverse_phi).
pub static NORMAL_DISTRIBUTION: Part = part!("ndf/numeric/normal_distribution", ELEMENTARY);

/// Roughness, repaired, and vectors stretched by it.
pub static ROUGHNESS: Part = part!("ndf/density/roughness", ELEMENTARY);

/// Smith's masking and shadowing of any Λ, views from below: [`Microfacet`](asperity_ndf_sampling::Microfacet).
pub static MICROFACET: Part = part!("ndf/microfacet", ELEMENTARY);

/// Tangent frames by the minimal rotation: [`Frame`](asperity_ndf_sampling::Frame).
pub static FRAME: Part = part!("ndf/frame", ELEMENTARY);

/// Gaussian coordinates, split into what is resolved and the rest: [`GaussianSplit`](asperity_ndf_sampling::GaussianSplit).
pub static GAUSSIAN_SPLIT: Part = part!("ndf/level_of_detail/gaussian_split", ELEMENTARY);

/// Gaussian slopes of any mean and covariance, [`OffsetBeckmann`](asperity_ndf_sampling::level_of_detail::OffsetBeckmann), to 32 bits.
pub static OFFSET_BECKMANN: Part = part!("ndf/level_of_detail/offset_beckmann", ELEMENTARY, GAUSSIAN_SPLIT);

/// GGX: density, bijection and inverse, samples, visible normals, masking, conditional density; the bits of
/// [`Ggx`](asperity_ndf_sampling::Ggx).
pub static GGX: Part = part!("ndf/density/ggx", ELEMENTARY, ROUGHNESS, MICROFACET, GAUSSIAN_SPLIT);

/// Slopes along a view of Gaussian slopes, for visible normals of [`BECKMANN`].
pub static VISIBLE_SLOPES: Part = part!("ndf/density/visible_slopes", ELEMENTARY, NORMAL_DISTRIBUTION);

/// Beckmann: density, bijection and inverse, samples, visible normals, masking, conditional density; the bits of
/// [`Beckmann`](asperity_ndf_sampling::Beckmann), visible normals those of its plural calls, masking to 32 bits.
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
pub static STUDENT_DISTRIBUTION: Part =
    part!("ndf/density/student_distribution", ELEMENTARY, NORMAL_DISTRIBUTION);

/// Student's t: density, bijection and inverse, samples, visible normals, masking, to 32 bits;
/// [`StudentT`](asperity_ndf_sampling::StudentT).
pub static STUDENT_T: Part =
    part!("ndf/density/student_t", ELEMENTARY, ROUGHNESS, MICROFACET, STUDENT_DISTRIBUTION);

/// Blinn–Phong, by Student's t; [`BlinnPhong`](asperity_ndf_sampling::BlinnPhong).
pub static BLINN_PHONG: Part = part!("ndf/density/blinn_phong", ELEMENTARY, ROUGHNESS, STUDENT_T);

/// Ward's lobe; everything else of [`Ward`](asperity_ndf_sampling::Ward) is [`BECKMANN`].
pub static WARD: Part = part!("ndf/density/ward", ELEMENTARY);

/// Ashikhmin–Shirley: density, bijection and inverse, samples, to 32 bits;
/// [`AshikhminShirley`](asperity_ndf_sampling::AshikhminShirley).
pub static ASHIKHMIN_SHIRLEY: Part = part!("ndf/density/ashikhmin_shirley", ELEMENTARY);
