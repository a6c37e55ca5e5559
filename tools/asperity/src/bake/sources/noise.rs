//! A height field of octave noise.

use asperity_noise::{CellularOutput, FbmSpectrum, Metric, Sample};
use asperity_shading::normal_map::SlopeMoments;
use glam::Vec2;
use serde_json::{Value, json};

use crate::bake::source::{Row, Source, Varies};
use crate::bake::sources::finish::Finish;
use crate::bake::texel::Texel;
use crate::cli::noise::{NoiseKind, Sum};
use crate::failure::Result;
use crate::fields::{Chosen, Octaves, tile_error};

/// Parameters of the height field.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Parameters {
    pub(crate) kind: NoiseKind,
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
    field: Chosen,
}

impl Noise {
    /// Builds the height field from its parameters.
    pub(crate) fn new(parameters: Parameters, finish: Finish) -> Result<Self> {
        let Parameters { kind, cells, octaves, lacunarity, gain, seed, tileable, .. } = parameters;
        let octaves = Octaves {
            kind,
            output: CellularOutput::F1,
            metric: Metric::Euclidean,
            sum: Sum::Fbm,
            spectrum: Some(FbmSpectrum::new(lacunarity, gain, octaves)?),
            seed,
        };
        let field = match tileable {
            true => octaves.field(Some([cells; 2])).map_err(|error| tile_error(&error))?,
            false => octaves.field(None)?,
        };
        Ok(Self { parameters, finish, field })
    }

    /// Returns values and gradients at a lattice position.
    fn sample(&self, at: [f64; 2]) -> Vec2 {
        Vec2::from(at.map(|x| (x * f64::from(self.parameters.cells)) as f32))
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
