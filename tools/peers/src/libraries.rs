//! The libraries that return one value per call.

use bevy_math::{Vec2, Vec3, Vec4};

use crate::{
    inputs::SEED,
    measure::Contender,
    row::{Kind, Row},
    scalar::{derivatives, values},
};

/// Contenders of the libraries for a row.
pub(crate) const ALL: [fn(Row, f32) -> Option<Contender>; 7] =
    [noise, noise_functions, fastnoise_lite, libnoise, noiz, opensimplex2, bracket_noise];

/// An expression in which this constant is the row's dimension.
macro_rules! in_dimension {
    ($row:expr, $n:ident, $of:expr) => {
        in_dimension!($row, $n, $of, 2 3 4)
    };
    ($row:expr, $n:ident, $of:expr, $($dimension:literal)*) => {
        match $row.dimension {
            $($dimension => {
                const $n: usize = $dimension;
                Some($of)
            })*
            _ => None,
        }
    };
}

/// The oldest Rust library: `f64` and permutation tables; its simplex noise has derivatives.
fn noise(row: Row, step: f32) -> Option<Contender> {
    use noise::{
        Fbm, MultiFractal, NoiseFn, Perlin, Simplex, Value, Worley,
        core::{simplex, worley},
        permutationtable::PermutationTable,
    };

    const NAME: &str = "noise";

    fn of<const N: usize>(row: Row, step: f32, noise: impl NoiseFn<f64, N> + 'static) -> Contender {
        values(NAME, row, step, move |p: [f64; N]| noise.get(p) as f32)
    }

    fn narrow<const N: usize>((value, gradient): (f64, [f64; N])) -> (f32, [f32; N]) {
        (value as f32, gradient.map(|x| x as f32))
    }

    if row.kind != Kind::Simplex || !row.gradients {
        let nearest = || Worley::new(SEED).set_return_type(worley::ReturnType::Distance);
        let sum = || Fbm::<Perlin>::new(SEED).set_octaves(5).set_lacunarity(2.0).set_persistence(0.5);
        return in_dimension!(
            row,
            N,
            match row.kind {
                Kind::Perlin => of::<N>(row, step, Perlin::new(SEED)),
                Kind::Value => of::<N>(row, step, Value::new(SEED)),
                Kind::Simplex => of::<N>(row, step, Simplex::new(SEED)),
                Kind::Fbm => of::<N>(row, step, sum()),
                Kind::Cellular => of::<N>(row, step, nearest()),
            }
        );
    }
    let table = PermutationTable::new(SEED);
    Some(match row.dimension {
        2 => derivatives(NAME, row, step, move |p: [f64; 2]| narrow(simplex::simplex_2d(p.into(), &table))),
        3 => derivatives(NAME, row, step, move |p: [f64; 3]| narrow(simplex::simplex_3d(p.into(), &table))),
        4 => derivatives(NAME, row, step, move |p: [f64; 4]| narrow(simplex::simplex_4d(p.into(), &table))),
        _ => return None,
    })
}

/// `f32`, hashes and small tables, stateless.
fn noise_functions(row: Row, step: f32) -> Option<Contender> {
    use noise_functions::{CellDistance, Noise, Perlin, Sample, Simplex, Value};

    fn of<const N: usize>(row: Row, step: f32, noise: impl Sample<N> + 'static) -> Contender {
        values("noise-functions", row, step, move |p: [f32; N]| noise.sample_with_seed(p, SEED as i32))
    }

    in_dimension!(
        row,
        N,
        match row.kind {
            Kind::Perlin => of::<N>(row, step, Perlin),
            Kind::Value => of::<N>(row, step, Value),
            Kind::Simplex => of::<N>(row, step, Simplex),
            Kind::Fbm => of::<N>(row, step, Perlin.fbm(5, 0.5, 2.0)),
            Kind::Cellular => of::<N>(row, step, CellDistance::default()),
        }
    )
}

/// One configurable generator, `f32`.
fn fastnoise_lite(row: Row, step: f32) -> Option<Contender> {
    use fastnoise_lite::{
        CellularDistanceFunction, CellularReturnType, FastNoiseLite, FractalType, NoiseType,
    };

    const NAME: &str = "fastnoise-lite";
    let mut noise = FastNoiseLite::with_seed(SEED as i32);
    noise.set_frequency(Some(1.0));
    noise.set_noise_type(Some(match row.kind {
        Kind::Perlin | Kind::Fbm => NoiseType::Perlin,
        Kind::Value => NoiseType::Value,
        Kind::Simplex => NoiseType::OpenSimplex2,
        Kind::Cellular => NoiseType::Cellular,
    }));
    noise.set_cellular_return_type(Some(CellularReturnType::Distance));
    noise.set_cellular_distance_function(Some(CellularDistanceFunction::Euclidean));
    if row.kind == Kind::Fbm {
        noise.set_fractal_type(Some(FractalType::FBm));
        noise.set_fractal_octaves(Some(5));
        noise.set_fractal_lacunarity(Some(2.0));
        noise.set_fractal_gain(Some(0.5));
    }
    match row.dimension {
        2 => Some(values(NAME, row, step, move |[x, y]: [f32; 2]| noise.get_noise_2d(x, y))),
        3 => Some(values(NAME, row, step, move |[x, y, z]: [f32; 3]| noise.get_noise_3d(x, y, z))),
        _ => None,
    }
}

/// `f64`, permutation tables, adapters.
fn libnoise(row: Row, step: f32) -> Option<Contender> {
    use libnoise::{Generator, Source};

    fn of<const N: usize>(row: Row, step: f32, noise: impl Generator<N> + 'static) -> Contender {
        values("libnoise", row, step, move |p: [f64; N]| noise.sample(p) as f32)
    }

    let seed = u64::from(SEED);
    in_dimension!(
        row,
        N,
        match row.kind {
            Kind::Perlin => of(row, step, Source::<N>::improved_perlin(seed)),
            Kind::Value => of(row, step, Source::<N>::value(seed)),
            Kind::Simplex => of(row, step, Source::<N>::simplex(seed)),
            Kind::Fbm => of(row, step, Source::<N>::improved_perlin(seed).fbm(5, 1.0, 2.0, 0.5)),
            Kind::Cellular => of(row, step, Source::<N>::worley(seed)),
        }
    )
}

/// `f32`, hashes, analytic gradients except for sums.
fn noiz(row: Row, step: f32) -> Option<Contender> {
    use noiz::{
        cells::WithGradient,
        layering::{FractalLayers, LayeredNoise, Normed, Octave, Persistence},
        prelude::{Noise, SampleableFor, SeedableNoise, common_noise},
    };

    const NAME: &str = "noiz";

    fn seeded<N>(noise: impl Into<Noise<N>>) -> Noise<N> {
        let mut noise = noise.into();
        noise.set_seed(SEED);
        noise
    }

    macro_rules! in_space {
        ($vector:ty, $n:literal) => {{
            macro_rules! value {
                ($noise:expr) => {{
                    let noise = seeded($noise);
                    values(NAME, row, step, move |p: [f32; $n]| -> f32 { noise.sample(<$vector>::from(p)) })
                }};
            }
            macro_rules! derivative {
                ($noise:expr, $gradient:ty) => {{
                    let noise = seeded($noise);
                    derivatives(NAME, row, step, move |p: [f32; $n]| {
                        let of: WithGradient<f32, $gradient> = noise.sample(<$vector>::from(p));
                        (of.value, of.gradient.into())
                    })
                }};
            }
            match row.kind {
                Kind::Fbm => {
                    let layer = Octave(common_noise::Perlin::default());
                    let layers = FractalLayers { layer, lacunarity: 2.0, amount: 5 };
                    value!(LayeredNoise::new(Normed::<f32>::default(), Persistence(0.5), layers))
                }
                Kind::Perlin if row.gradients => {
                    derivative!(common_noise::PerlinWithDerivative::default(), $vector)
                }
                Kind::Value if row.gradients => {
                    derivative!(common_noise::ValueWithDerivative::default(), [f32; $n])
                }
                Kind::Simplex if row.gradients => {
                    derivative!(common_noise::SimplexWithDerivative::default(), $vector)
                }
                Kind::Cellular => value!(common_noise::Worley::default()),
                Kind::Perlin => value!(common_noise::Perlin::default()),
                Kind::Value => value!(common_noise::Value::default()),
                Kind::Simplex => value!(common_noise::Simplex::default()),
            }
        }};
    }

    match row.dimension {
        2 => Some(in_space!(Vec2, 2)),
        3 => Some(in_space!(Vec3, 3)),
        4 => Some(in_space!(Vec4, 4)),
        _ => None,
    }
}

/// The fast variant of OpenSimplex2, `f64` points.
fn opensimplex2(row: Row, step: f32) -> Option<Contender> {
    use opensimplex2::fast;

    const NAME: &str = "opensimplex2";
    let seed = i64::from(SEED);
    match row.dimension {
        _ if row.kind != Kind::Simplex => None,
        2 => Some(values(NAME, row, step, move |[x, y]: [f64; 2]| fast::noise2(seed, x, y))),
        3 => Some(values(NAME, row, step, move |[x, y, z]: [f64; 3]| fast::noise3_Fallback(seed, x, y, z))),
        4 => Some(values(NAME, row, step, move |[x, y, z, w]: [f64; 4]| {
            fast::noise4_Fallback(seed, x, y, z, w)
        })),
        _ => None,
    }
}

/// The first FastNoise in Rust, `f32` and permutation tables.
fn bracket_noise(row: Row, step: f32) -> Option<Contender> {
    use bracket_noise::prelude::{
        CellularDistanceFunction, CellularReturnType, FastNoise, FractalType, Interp, NoiseType,
    };

    const NAME: &str = "bracket-noise";
    let mut noise = FastNoise::seeded(u64::from(SEED));
    noise.set_frequency(1.0);
    noise.set_interp(Interp::Quintic);
    noise.set_noise_type(match row.kind {
        Kind::Perlin => NoiseType::Perlin,
        Kind::Value => NoiseType::Value,
        Kind::Simplex => NoiseType::Simplex,
        Kind::Fbm => NoiseType::PerlinFractal,
        Kind::Cellular => NoiseType::Cellular,
    });
    noise.set_cellular_return_type(CellularReturnType::Distance);
    noise.set_cellular_distance_function(CellularDistanceFunction::Euclidean);
    noise.set_fractal_type(FractalType::FBM);
    noise.set_fractal_octaves(5);
    noise.set_fractal_lacunarity(2.0);
    noise.set_fractal_gain(0.5);
    match row.dimension {
        2 => Some(values(NAME, row, step, move |[x, y]: [f32; 2]| noise.get_noise(x, y))),
        3 => Some(values(NAME, row, step, move |[x, y, z]: [f32; 3]| noise.get_noise3d(x, y, z))),
        _ => None,
    }
}
