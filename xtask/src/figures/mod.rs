//! Every figure of the gallery, in the order of the page.

mod asperity_mean_radiance;
mod cochran_contractions;
mod cochran_corner;
mod cochran_curves;
mod cochran_mirrors;
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
    cochran_curves::FUNCTIONS,
    cochran_contractions::CONTRACTIONS,
    cochran_curves::INTEGRALS,
    cochran_mirrors::MIRRORS,
    cochran_corner::CORNER,
    asperity_mean_radiance::MEAN_RADIANCE,
];
