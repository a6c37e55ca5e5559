//! Distributions of the values of a noise: measured, Gaussian, or known by their kurtosis.

pub(crate) mod distribution;
pub(crate) mod kurtotic_noise;
pub(crate) mod noise_cdf;
