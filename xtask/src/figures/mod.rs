//! Every figure of the gallery, in the order of the page.

mod asperity_mean_radiance;
mod kautz_isotropic;
mod kautz_ndf;
mod kautz_pipeline;
mod kautz_sphere;
mod kautz_teapot;
mod panels;

use crate::figure::Figure;

/// The figures, in the order of the page.
pub(crate) const FIGURES: &[Figure] = &[
    kautz_sphere::SPHERE,
    kautz_ndf::NDF,
    kautz_pipeline::PIPELINE,
    kautz_teapot::TEAPOT,
    kautz_isotropic::ISOTROPIC,
    asperity_mean_radiance::MEAN_RADIANCE,
];
