//! The tables of noise: the lattice of a seed, and the measured distributions G of the kinds.

use asperity_noise::{
    Gaussian, Lattice, Noise, Perlin1985, Perlin2002, PermutationTable, Simplex, Statistics,
    gaussian_variates_3,
    glam::{Vec2, Vec3},
};
use serde_json::{Map, json};

use super::{Made, formats::npy};
use crate::{figure::Failure, image::Image, scene::hemisphere::ember};

/// Lattice points per side.
const SIDE: i32 = 128;

pub(super) fn lattice(seed: u32) -> Result<Made, Failure> {
    let permutation = PermutationTable::new(seed);
    let points = (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y)));
    let variates: Vec<[f32; 4]> =
        points.map(|(x, y)| gaussian_variates_3(asperity_noise::IntegerHash.hash3(x, y, 0, seed))).collect();
    let side = SIDE as usize;
    let files = vec![
        ("permutation.npy".into(), npy(&[256], permutation.entries())),
        ("gaussian_variates.npy".into(), npy(&[side, side, 4], variates.as_flattened())),
    ];
    let picture = Image::from_fn(256, 256, |x, y| {
        let index = (y as usize / 2) * side + x as usize / 2;
        ember(0.5 + variates.get(index).map_or(0.0, |v| v[0]) / 6.0)
    });
    Ok(Made {
        text: "The permutation of a seed, and of the integer hash the Gaussian value and gradient at the lattice points \
               (x, y, 0), x and y from 0 to 127; the picture shows the values."
            .into(),
        parameters: json!({ "kind": "noise lattice", "seed": seed, "order": "value, gradient x, y, z" }),
        files,
        picture,
    })
}

pub(super) fn distributions() -> Result<Made, Failure> {
    let mut kinds: Vec<(&str, &'static Statistics)> = Vec::new();
    macro_rules! both {
        ($noise:expr, $name2:literal, $name3:literal) => {
            kinds.push(($name2, Noise::<Vec2>::statistics(&$noise)));
            kinds.push(($name3, Noise::<Vec3>::statistics(&$noise)));
        };
    }
    both!(Perlin1985::default(), "perlin_1985_2d", "perlin_1985_3d");
    both!(Perlin2002::default(), "perlin_2002_2d", "perlin_2002_3d");
    both!(Simplex::CONTINUOUS, "simplex_continuous_2d", "simplex_continuous_3d");
    both!(Simplex::WIDE, "simplex_wide_2d", "simplex_wide_3d");
    both!(Gaussian::default(), "gaussian_2d", "gaussian_3d");
    let mut statistics = Map::new();
    let mut files = Vec::new();
    for (name, kind) in &kinds {
        files.push((format!("{name}.npy"), npy(&[kind.cdf.len()], kind.cdf)));
        let numbers = json!({
            "standard_deviation": kind.standard_deviation,
            "excess_kurtosis": kind.excess_kurtosis,
            "range": kind.range,
        });
        statistics.insert((*name).into(), numbers);
    }
    Ok(Made {
        text: "G of each kind, measured over eight octaves with gain 0.5 and unit variance, at equal steps over ±4 standard \
               deviations; standard deviation, excess kurtosis and range of one octave. The picture shows the slopes of G: \
               each row is a kind."
            .into(),
        parameters: json!({ "kind": "noise distribution", "range": 4.0, "kinds": statistics }),
        picture: slopes(&kinds),
        files,
    })
}

/// The density of each kind as a band of colour.
fn slopes(kinds: &[(&str, &'static Statistics)]) -> Image {
    Image::from_fn(256, 256, |x, y| {
        let Some((_, kind)) = kinds.get(y as usize * kinds.len() / 256) else { return ember(0.0) };
        let cells = kind.cdf.len().saturating_sub(1);
        let cell = x as usize * cells / 256;
        let (Some(a), Some(b)) = (kind.cdf.get(cell), kind.cdf.get(cell + 1)) else { return ember(0.0) };
        // The peak of a Gaussian is 0.4 per standard deviation.
        ember((b - a) * cells as f32 / 8.0 / 0.44)
    })
}
