//! Bumps of a normal density: two channels of Gaussian noise mapped by `m = T(z)`.

use std::sync::Arc;

use asperity_noise::{Fbm, FbmSpectrum, GaussianNoise, IntegerHash, lattice::Tiled};
use asperity_render::materials::SharedNdf;
use asperity_shading::Footprint;
use asperity_shading::level_of_detail::ResolvedBumps;
use asperity_shading::normal_map::SlopeMoments;
use asperity_shading::pixel::FrequencyClamp;
use glam::{Vec2, Vec3};
use serde_json::{Value, json};

use crate::bake::source::{Row, Source, Varies};
use crate::bake::sources::finish::Finish;
use crate::bake::texel::Texel;
use crate::failure::Result;
use crate::fields::tile_error;

/// Parameters of the bumps.
pub(crate) struct Parameters {
    /// The specification of the density.
    pub(crate) spec: String,
    pub(crate) ndf: Arc<SharedNdf>,
    /// Lattice cells of the first octave along a side.
    pub(crate) cells: u32,
    pub(crate) octaves: u32,
    pub(crate) lacunarity: f32,
    pub(crate) gain: f32,
    pub(crate) seed: u32,
    pub(crate) tileable: bool,
}

/// The bumps.
///
/// The moments of texels are moments of the Gaussian coordinates z, not of slopes. A level resolves
/// the mean of z. The density of the rest is as wide as the variation of z about that mean. In the
/// limit of distance the result is the density itself, exactly.
pub(crate) struct Bumps {
    parameters: Parameters,
    finish: Finish,
    channels: Channels,
    clamp: FrequencyClamp,
    /// α along x and y of the GGX density with the same median slopes.
    alpha: [f32; 2],
}

/// Two independent channels of octave noise.
enum Channels {
    Turned(Fbm<GaussianNoise, Vec2>),
    Tiled(Fbm<GaussianNoise<Tiled<IntegerHash, 2>>, Vec2>),
}

impl Bumps {
    /// Builds the bumps from their parameters.
    pub(crate) fn new(parameters: Parameters, finish: Finish) -> Result<Self> {
        let spectrum = FbmSpectrum::new(parameters.lacunarity, parameters.gain, parameters.octaves)?;
        let noise = GaussianNoise::new(parameters.seed);
        let sum = Fbm::new(noise, spectrum);
        let channels = if parameters.tileable {
            let tiled = sum.tiled([parameters.cells; 2]);
            Channels::Tiled(tiled.map_err(|error| tile_error(&error))?)
        } else {
            Channels::Turned(sum)
        };
        let (cells, octaves) = (parameters.cells as f32, parameters.octaves as f32);
        let clamp = FrequencyClamp::new(cells, parameters.lacunarity, octaves)?;
        let alpha = equivalent_alpha(parameters.ndf.as_ref());
        Ok(Self { parameters, finish, channels, clamp, alpha })
    }

    /// Returns the coordinates at a point, and the fraction of octaves that a sample of this side
    /// resolves.
    fn coordinates(&self, at: [f64; 2], sample: f32) -> ResolvedBumps {
        let p = Vec2::from(at.map(|x| (x * f64::from(self.parameters.cells)) as f32));
        let octaves = self.clamp.octaves(Footprint::from_width(sample));
        let (pair, spectrum) = match &self.channels {
            Channels::Turned(noise) => (noise.pair_with_octaves(p, octaves), noise.spectrum()),
            Channels::Tiled(noise) => (noise.pair_with_octaves(p, octaves), noise.spectrum()),
        };
        let z = Vec2::new(pair[0].value, pair[1].value);
        // Limited to the existing octaves: finer octaves contribute nothing.
        let share =
            spectrum.resolved_variance(octaves) / spectrum.resolved_variance(spectrum.max_octaves() as f32);
        ResolvedBumps { z, variance: share.min(1.0), blend: spectrum.weight(octaves, 0) }
    }
}

/// Returns α along x and y of the GGX density with the median slopes of `ndf`.
///
/// ```text
/// median |s_x| = α_x/√3   of GGX, whose slopes along an axis have the distribution ½ + ½ s/√(α² + s²)
/// ```
fn equivalent_alpha(ndf: &SharedNdf) -> [f32; 2] {
    const SIDE: u32 = 64;
    let mut slopes = [0, 1].map(|_| Vec::with_capacity((SIDE * SIDE) as usize));
    for k in 0..SIDE * SIDE {
        let u = [k % SIDE, k / SIDE].map(|i| (i as f32 + 0.5) / SIDE as f32);
        let m = ndf.sample(Vec2::from(u));
        let steep = m.z.max(f32::MIN_POSITIVE);
        slopes[0].push((m.x / steep).abs());
        slopes[1].push((m.y / steep).abs());
    }
    slopes.map(|mut slopes| {
        slopes.sort_by(f32::total_cmp);
        let middle = slopes.len() / 2;
        3_f32.sqrt() * 0.5 * (slopes[middle - 1] + slopes[middle])
    })
}

impl Source for Bumps {
    fn describe(&self) -> Value {
        let Parameters { spec, cells, octaves, lacunarity, gain, seed, .. } = &self.parameters;
        json!({
            "density": spec, "cells": cells, "octaves": octaves, "lacunarity": lacunarity, "gain": gain, "seed": seed,
            "alpha": self.alpha, "finish": self.finish.describe(),
        })
    }

    fn varies(&self) -> Varies {
        Varies { color: false, metallic: false, height: false }
    }

    fn texels(&self, row: &Row, texels: &mut [Texel]) {
        for (k, texel) in texels.iter_mut().enumerate() {
            let slopes = row.points(k).map(|at| {
                let ResolvedBumps { z, variance: share, .. } = self.coordinates(at, row.sample());
                let rest = 1.0 - share;
                (1.0, SlopeMoments { mean: share.sqrt() * z, covariance: [rest, 0.0, rest] })
            });
            *texel = Texel {
                slopes: SlopeMoments::mixed(slopes),
                alpha2: self.finish.alpha * self.finish.alpha,
                height: 0.0,
                color: self.finish.colors[0],
                metallic: self.finish.metallic,
                occlusion: 1.0,
            };
        }
    }

    fn point(&self, at: [f64; 2]) -> Texel {
        Texel { slopes: SlopeMoments::point(self.coordinates(at, 0.0).z), ..Texel::default() }
    }

    fn shown(&self, texel: &Texel) -> (Vec3, f32) {
        let SlopeMoments { mean, covariance: [xx, _, yy] } = texel.slopes;
        let [x, y] = self.alpha.map(|alpha| alpha * alpha);
        (self.parameters.ndf.warp_gaussian(mean), texel.alpha2 + 0.5 * (x * xx + y * yy))
    }
}
