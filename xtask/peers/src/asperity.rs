//! Asperity itself.

use asperity_noise::{
    Noise, Perlin2002, Point, Simplex,
    glam::{Vec2, Vec3},
};

use crate::{
    inputs::SEED,
    measure::Contender,
    row::{Form, Kind, Row},
    scalar::{derivatives, values},
};

/// How the table calls it.
pub(crate) const NAME: &str = "asperity";

pub(crate) fn contenders(row: Row, step: f32) -> Vec<Contender> {
    match row.dimension {
        2 => scalar::<Vec2, 2>(row, step).into_iter().collect(),
        3 => scalar::<Vec3, 3>(row, step).into_iter().collect(),
        _ => Vec::new(),
    }
}

fn scalar<V, const N: usize>(row: Row, step: f32) -> Option<Contender>
where
    V: Point + From<[f32; N]> + Into<[f32; N]> + 'static,
    Perlin2002: Noise<V>,
    Simplex: Noise<V>,
{
    match row.kind {
        Kind::Perlin => Some(of(row, step, Perlin2002::default())),
        Kind::Simplex => Some(of(row, step, Simplex::CONTINUOUS)),
        Kind::Value | Kind::Octaves => None,
    }
}

fn of<V, const N: usize>(row: Row, step: f32, noise: impl Noise<V> + 'static) -> Contender
where
    V: From<[f32; N]> + Into<[f32; N]>,
{
    match row.form {
        Form::Grid | Form::Points | Form::Calls => {
            values(NAME, row.form, step, move |p: [f32; N]| noise.value(V::from(p), SEED))
        }
        Form::GridGradients | Form::PointsGradients | Form::CallsGradients => {
            derivatives(NAME, row.form, step, move |p: [f32; N]| {
                let sample = noise.sample(V::from(p), SEED);
                (sample.value, sample.gradient.into())
            })
        }
    }
}
