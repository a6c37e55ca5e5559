//! A height field of octave noise.

use asperity_noise::{
    Cellular, Fbm, FbmSpectrum, Field, GaussianNoise, Perlin, Sample, Simplex, SparseConvolution, ValueNoise,
};
use asperity_shading::normal_map::SlopeMoments;
use glam::{Vec2, Vec3};
use serde_json::{Value, json};

use crate::bake::source::{Row, Source, Varies};
use crate::bake::sources::finish::Finish;
use crate::bake::texel::Texel;
use crate::cli::bake::BakedNoise;
use crate::failure::Result;

/// Parameters of the height field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Parameters {
    pub(crate) kind: BakedNoise,
    /// Lattice cells of the first octave along a side.
    pub(crate) cells: u32,
    pub(crate) octaves: u32,
    pub(crate) lacunarity: f32,
    pub(crate) gain: f32,
    /// Standard deviation of the heights, in units of the side.
    pub(crate) height: f32,
    pub(crate) seed: u32,
    pub(crate) tileable: bool,
}

/// The height field.
pub(crate) struct Noise {
    parameters: Parameters,
    finish: Finish,
    field: Box<dyn Field<Vec2> + Send + Sync>,
}

impl Noise {
    /// Builds the height field from its parameters.
    pub(crate) fn new(parameters: Parameters, finish: Finish) -> Result<Self> {
        let field = field(&parameters).map_err(|error| match parameters.tileable {
            true => format!("`--tileable`: {error}"),
            false => error.to_string(),
        })?;
        Ok(Self { parameters, finish, field })
    }

    /// Returns values and gradients at a lattice position.
    fn sample(&self, at: [f64; 2]) -> Vec2 {
        Vec2::from(at.map(|x| (x * f64::from(self.parameters.cells)) as f32))
    }
}

/// Returns octave noise in the plane, periodic if requested.
fn field(wanted: &Parameters) -> Result<Box<dyn Field<Vec2> + Send + Sync>> {
    let Parameters { kind, cells, seed, tileable, .. } = *wanted;
    let spectrum = FbmSpectrum::new(wanted.lacunarity, wanted.gain, wanted.octaves)?;
    macro_rules! in_the_plane {
        ($noise:expr) => {{
            let sum = Fbm::<_, Vec2>::new($noise, spectrum);
            if tileable { Box::new(sum.tiled([cells; 2])?) } else { Box::new(sum) }
        }};
    }
    Ok(match kind {
        BakedNoise::Gaussian => in_the_plane!(GaussianNoise::new(seed)),
        BakedNoise::Perlin => in_the_plane!(Perlin::new(seed)),
        BakedNoise::Value => in_the_plane!(ValueNoise::new(seed)),
        BakedNoise::Sparse => in_the_plane!(SparseConvolution::new(seed)),
        BakedNoise::Cellular => in_the_plane!(Cellular::new(seed)),
        BakedNoise::Simplex if tileable => {
            // In the plane, the simplicial lattice is not periodic along the axes.
            Box::new(Slice(Fbm::<_, Vec3>::new(Simplex::new(seed), spectrum).tiled([cells; 3])?))
        }
        BakedNoise::Simplex => Box::new(Fbm::<_, Vec2>::new(Simplex::new(seed), spectrum)),
    })
}

/// A field in space, sliced at z = 0.
struct Slice<F>(F);

impl<F: Field<Vec3>> Field<Vec2> for Slice<F> {
    fn sample(&self, p: Vec2) -> Sample<Vec2> {
        let Sample { value, gradient } = self.0.sample(p.extend(0.0));
        Sample { value, gradient: gradient.truncate() }
    }

    fn range(&self) -> [f32; 2] {
        self.0.range()
    }
}

impl Source for Noise {
    fn describe(&self) -> Value {
        let Parameters { kind, cells, octaves, lacunarity, gain, height, seed, .. } = self.parameters;
        json!({
            "noise": format!("{kind:?}").to_lowercase(), "cells": cells, "octaves": octaves, "lacunarity": lacunarity,
            "gain": gain, "height": height, "seed": seed, "finish": self.finish.describe(),
        })
    }

    fn varies(&self) -> Varies {
        Varies { color: self.finish.is_colored(), metallic: false, height: true }
    }

    fn range(&self) -> Option<[f32; 2]> {
        let range = self.field.range().map(|value| self.parameters.height * value);
        range.iter().all(|height| height.is_finite()).then_some(range)
    }

    fn texels(&self, row: &Row, texels: &mut [Texel]) {
        let Parameters { height, cells, .. } = self.parameters;
        let points: Vec<Vec2> =
            (0..texels.len()).flat_map(|k| row.points(k)).map(|at| self.sample(at)).collect();
        let mut samples = vec![Sample { value: 0.0, gradient: Vec2::ZERO }; points.len()];
        // One value per point.
        let _ = self.field.samples(&points, &mut samples);
        let each = (row.samples * row.samples) as usize;
        for (texel, samples) in texels.iter_mut().zip(samples.chunks_exact(each)) {
            let slope =
                |sample: &Sample<Vec2>| (1.0, SlopeMoments::point(-height * cells as f32 * sample.gradient));
            let share = 1.0 / each as f32;
            *texel = Texel {
                slopes: SlopeMoments::mixed(samples.iter().map(slope)),
                alpha2: self.finish.alpha * self.finish.alpha,
                height: height * samples.iter().map(|sample| share * sample.value).sum::<f32>(),
                color: samples.iter().map(|sample| share * self.finish.color(sample.value)).sum(),
                metallic: self.finish.metallic,
                occlusion: 1.0,
            };
        }
    }

    fn heights(&self, row: &Row, heights: &mut [f32]) {
        let points: Vec<Vec2> = (0..heights.len()).map(|k| self.sample(row.middle(k))).collect();
        let _ = self.field.values(&points, heights);
        heights.iter_mut().for_each(|value| *value *= self.parameters.height);
    }

    fn point(&self, at: [f64; 2]) -> Texel {
        let Sample { value, gradient } = self.field.sample(self.sample(at));
        let slope = -self.parameters.height * self.parameters.cells as f32 * gradient;
        Texel {
            height: self.parameters.height * value,
            slopes: SlopeMoments::point(slope),
            ..Texel::default()
        }
    }
}
