//! Sums of Gaussian noise about a focus, and painted densities.

use alloc::{format, string::String, string::ToString, vec::Vec};

use asperity_ndf_sampling::{Measure, NdfMap, Reconstruction};
use asperity_noise::gpu::FbmUniform3d;
use asperity_noise::{FbmSpectrum, GaussianFbm, GaussianNoise, glam::Vec3};

use crate::{float, number, words};

/// Returns the levels of Gaussian variates.
pub(crate) fn gaussian_levels(_: &[f64], _: &[u32]) -> Result<Vec<u32>, String> {
    Ok(GaussianNoise::gpu_levels().map(f32::to_bits).collect())
}

/// Returns the uniform of a sum about up to eight foci, from lacunarity, gain, octaves, seed and
/// the foci in cells.
pub(crate) fn gaussian_anchors(numbers: &[f64], _: &[u32]) -> Result<Vec<u32>, String> {
    let sum = sum(numbers)?;
    let foci = numbers.get(4..).unwrap_or_default().chunks_exact(3);
    let sums: Vec<_> = foci.map(|at| sum.anchored([at[0], at[1], at[2]]).gpu()).collect();
    Ok(words(&FbmUniform3d::array(&sums)))
}

fn sum(numbers: &[f64]) -> Result<GaussianFbm<Vec3>, String> {
    let spectrum = FbmSpectrum::new(float(numbers, 0), float(numbers, 1), number(numbers, 2) as u32)
        .map_err(|error| error.to_string())?;
    Ok(GaussianFbm::new(GaussianNoise::new(number(numbers, 3) as u32), spectrum))
}

/// Returns the uniform of a painted density (24 words) and its table, from the painting's side and
/// its texels in `bulk`.
pub(crate) fn painted_map(numbers: &[f64], bulk: &[u32]) -> Result<Vec<u32>, String> {
    let side = number(numbers, 0) as usize;
    let texels: Vec<f32> = bulk.iter().map(|&word| f32::from_bits(word)).collect();
    let map =
        NdfMap::from_texels(side, side, &texels, Measure::ProjectedSolidAngle, Reconstruction::Bilinear)
            .map_err(|error| format!("The painting is not a density: {error}."))?;
    let mut answer = words(&map.view().gpu());
    answer.extend(map.array().iter().map(|x| x.to_bits()));
    Ok(answer)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn painted_map_of_black_is_one_sentence() {
        let error = painted_map(&[4.0], &[0; 16]).unwrap_err();
        assert!(
            error.starts_with("The painting is not a density: ") && error.lines().count() == 1,
            "{error}"
        );
        assert_eq!(painted_map(&[4.0], &[1.0_f32.to_bits(); 16]).map(|words| words.len() > 24), Ok(true));
    }
}
