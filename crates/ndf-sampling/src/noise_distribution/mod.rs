//! Distributions of noise values: measured, Gaussian, or from the kurtosis.

pub(crate) mod distribution;
pub(crate) mod kurtotic_noise;
pub(crate) mod noise_cdf;
