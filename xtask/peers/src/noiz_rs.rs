//! `noiz`: `f32`, hashes, gradients of its own for all but sums.

use bevy_math::{Vec2, Vec3, Vec4};
use noiz::{
    cells::WithGradient,
    layering::{FractalLayers, LayeredNoise, Normed, Octave, Persistence},
    prelude::{Noise, SampleableFor, SeedableNoise, common_noise},
};

use crate::{
    inputs::SEED,
    measure::Contender,
    row::{Form, Kind, Row},
    scalar::{derivatives, values},
};

const NAME: &str = "noiz";

pub(crate) fn contender(row: Row, step: f32) -> Option<Contender> {
    let with_gradient =
        matches!(row.form, Form::GridGradients | Form::PointsGradients | Form::CallsGradients);
    match row.dimension {
        2 if with_gradient && row.kind != Kind::Octaves => Some(derivatives_2(row, step)),
        3 if with_gradient && row.kind != Kind::Octaves => Some(derivatives_3(row, step)),
        4 if with_gradient && row.kind != Kind::Octaves => Some(derivatives_4(row, step)),
        2 => Some(values_of::<Vec2, 2>(row, step)),
        3 => Some(values_of::<Vec3, 3>(row, step)),
        4 => Some(values_of::<Vec4, 4>(row, step)),
        _ => None,
    }
}

type Sum = common_noise::Fbm<common_noise::Perlin>;

fn seeded<N>(noise: impl Into<Noise<N>>) -> Noise<N> {
    let mut noise = noise.into();
    noise.set_seed(SEED);
    noise
}

fn values_of<V: From<[f32; N]> + 'static, const N: usize>(row: Row, step: f32) -> Contender
where
    Noise<common_noise::Perlin>: SampleableFor<V, f32>,
    Noise<common_noise::Value>: SampleableFor<V, f32>,
    Noise<common_noise::Simplex>: SampleableFor<V, f32>,
    Noise<Sum>: SampleableFor<V, f32>,
{
    match row.kind {
        Kind::Perlin => of::<V, N>(row, step, seeded(common_noise::Perlin::default())),
        Kind::Value => of::<V, N>(row, step, seeded(common_noise::Value::default())),
        Kind::Simplex => of::<V, N>(row, step, seeded(common_noise::Simplex::default())),
        Kind::Octaves => {
            let layers =
                FractalLayers { layer: Octave(common_noise::Perlin::default()), lacunarity: 2.0, amount: 5 };
            of::<V, N>(row, step, seeded(LayeredNoise::new(Normed::default(), Persistence(0.5), layers)))
        }
    }
}

fn of<V: From<[f32; N]>, const N: usize>(
    row: Row,
    step: f32,
    noise: impl SampleableFor<V, f32> + 'static,
) -> Contender {
    values(NAME, row.form, step, move |p: [f32; N]| noise.sample(V::from(p)))
}

macro_rules! derivatives_in {
    ($name:ident, $vector:ty, $n:literal) => {
        fn $name(row: Row, step: f32) -> Contender {
            match row.kind {
                Kind::Value => {
                    let noise = seeded(common_noise::ValueWithDerivative::default());
                    derivatives(NAME, row.form, step, move |p: [f32; $n]| {
                        let of: WithGradient<f32, [f32; $n]> = noise.sample(<$vector>::from(p));
                        (of.value, of.gradient)
                    })
                }
                Kind::Simplex => {
                    let noise = seeded(common_noise::SimplexWithDerivative::default());
                    derivatives(NAME, row.form, step, move |p: [f32; $n]| {
                        let of: WithGradient<f32, $vector> = noise.sample(<$vector>::from(p));
                        (of.value, of.gradient.to_array())
                    })
                }
                Kind::Perlin | Kind::Octaves => {
                    let noise = seeded(common_noise::PerlinWithDerivative::default());
                    derivatives(NAME, row.form, step, move |p: [f32; $n]| {
                        let of: WithGradient<f32, $vector> = noise.sample(<$vector>::from(p));
                        (of.value, of.gradient.to_array())
                    })
                }
            }
        }
    };
}

derivatives_in!(derivatives_2, Vec2, 2);
derivatives_in!(derivatives_3, Vec3, 3);
derivatives_in!(derivatives_4, Vec4, 4);
