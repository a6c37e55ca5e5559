//! The tables of noise: the lattice of a seed, and the measured distributions G of each noise type.

use asperity_noise::lattice::PermutationTable;
use asperity_noise::{
    GaussianNoise, IntegerHash, Lattice, Noise, Perlin, PerlinClassic, Simplex, Statistics,
};
use asperity_render::image::formats::{F32, U8, npy};
use serde_json::{Map, json};

use super::made::Made;
use crate::failure::Failure;
use asperity_render::{image::Image, image::tone::ember};

/// Lattice points per side.
const SIDE: i32 = 128;

pub(super) fn lattice(seed: u32) -> Result<Made, Failure> {
    let permutation = PermutationTable::new(seed);
    let points = (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y)));
    let variates: Vec<[f32; 4]> = points
        .map(|(x, y)| {
            let [(value, [gx, gy, gz]), _] = GaussianNoise::variates(IntegerHash.word([x, y, 0], seed));
            [value, gx, gy, gz]
        })
        .collect();
    let side = SIDE as usize;
    let files = vec![
        ("permutation.npy".into(), npy(U8, &[256], permutation.entries())),
        ("gaussian_variates.npy".into(), npy(F32, &[side, side, 4], variates.as_flattened())),
    ];
    let picture = Image::from_fn(256, 256, |x, y| {
        let index = (y as usize / 2) * side + x as usize / 2;
        ember(0.5 + variates.get(index).map_or(0.0, |v| v[0]) / 6.0)
    });
    Ok(Made {
        text: "The permutation of a seed, and the GaussianNoise value and gradient of the integer hash at the lattice points \
               (x, y, 0), x and y from 0 to 127. The image shows the values."
            .into(),
        parameters: json!({ "kind": "noise lattice", "seed": seed, "order": "value, gradient x, y, z" }),
        files,
        picture,
    })
}

pub(super) fn distributions() -> Result<Made, Failure> {
    let kinds = [
        ("perlin_1985", statistics(&PerlinClassic::default())),
        ("perlin_2002", statistics(&Perlin::default())),
        ("simplex_continuous", statistics(&Simplex::new(0))),
        ("simplex_wide", statistics(&Simplex::new(0).with_classic_radius())),
        ("gaussian", statistics(&GaussianNoise::default())),
    ];
    let kinds: Vec<(String, &Statistics)> = kinds
        .iter()
        .flat_map(|(name, all)| {
            (1..).zip(all).map(move |(dimension, kind)| (format!("{name}_{dimension}d"), *kind))
        })
        .collect();
    let mut parameters = Map::new();
    let mut files = Vec::new();
    for (name, kind) in &kinds {
        files.push((format!("{name}.npy"), npy(F32, &[kind.cdf.len()], kind.cdf)));
        let numbers = json!({
            "standard_deviation": kind.standard_deviation,
            "excess_kurtosis": kind.excess_kurtosis,
            "range": kind.range,
        });
        parameters.insert(name.clone(), numbers);
    }
    Ok(Made {
        text: "G of each noise, measured over eight octaves with gain 0.5 and unit variance, at equal steps over ±4 standard \
               deviations; standard deviation, excess kurtosis and range of one octave. The image shows the slopes of G: \
               one row per noise."
            .into(),
        parameters: json!({ "kind": "noise distribution", "range": 4.0, "kinds": parameters }),
        picture: slopes(&kinds),
        files,
    })
}

/// The statistics of a noise in 1 to 4 dimensions.
fn statistics(noise: &impl Noise) -> [&'static Statistics; 4] {
    [1, 2, 3, 4].map(|dimension| noise.statistics(dimension))
}

/// Draws the density of each noise as a band of color.
fn slopes(kinds: &[(String, &'static Statistics)]) -> Image {
    Image::from_fn(256, 256, |x, y| {
        let Some((_, kind)) = kinds.get(y as usize * kinds.len() / 256) else { return ember(0.0) };
        let cells = kind.cdf.len().saturating_sub(1);
        let cell = x as usize * cells / 256;
        let (Some(a), Some(b)) = (kind.cdf.get(cell), kind.cdf.get(cell + 1)) else { return ember(0.0) };
        // The peak of a Gaussian is 0.4 per standard deviation.
        ember((b - a) * cells as f32 / 8.0 / 0.44)
    })
}
