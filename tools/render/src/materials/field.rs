//! Noises for bumps, by name.

use asperity_noise::{FbmSpectrum, GaussianFbm, GaussianNoise, Perlin, Simplex};
use asperity_shading::level_of_detail::{GaussianField, IndependentChannels, RemappedOctaves, ResolvedBumps};
use asperity_shading::{BumpField, Frame};
use glam::{DVec3, Vec3};

use crate::failure::Failure;

/// The type of a noise.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NoiseKind {
    /// The slopes of one noise, exactly Gaussian at every point, for every number of octaves.
    Gaussian,
    /// Two channels with the same distribution, without a relief.
    Channels,
    /// Gradient noise of 2002, made Gaussian through its measured distribution.
    Perlin,
    /// Simplex noise, made Gaussian through its measured distribution.
    Simplex,
}

/// Noise parameters of the bumps.
#[derive(Clone, Copy, Debug)]
pub struct Bumps {
    pub kind: NoiseKind,
    /// Lattice cells of the first octave per unit of length.
    pub frequency: f32,
    /// Maximum number of octaves, up to 16.
    pub octaves: u32,
    /// Ratio of successive octave amplitudes.
    pub gain: f32,
}

impl Bumps {
    /// Returns the bump map in space, in coordinates relative to an anchor. Near the anchor it is
    /// exact at any zoom.
    pub fn field(&self, seed: u32, anchor: DVec3) -> Result<BumpField<Field>, Failure> {
        /// Not a round number, so that the lattices of neighboring octaves do not coincide.
        const LACUNARITY: f32 = 2.17;
        if self.octaves == 0 {
            return Ok(BumpField::new(Field(None), self.frequency)?);
        }
        let spectrum = FbmSpectrum::new(LACUNARITY, self.gain, self.octaves)?;
        let at = anchor * f64::from(self.frequency);
        let sum = GaussianFbm::<Vec3>::new(GaussianNoise::new(seed), spectrum);
        let noise: Box<Noise> = match self.kind {
            NoiseKind::Gaussian => Box::new(sum.anchored(at)),
            NoiseKind::Channels => Box::new(IndependentChannels(sum.anchored(at))),
            NoiseKind::Perlin => {
                Box::new(RemappedOctaves::new(Perlin::default(), spectrum, seed)?.anchored(at))
            }
            NoiseKind::Simplex => {
                Box::new(RemappedOctaves::new(Simplex::new(0), spectrum, seed)?.anchored(at))
            }
        };
        Ok(BumpField::new(Field(Some(noise)), self.frequency)?)
    }
}

type Noise = dyn GaussianField + Send + Sync;

/// The bumps of octave noise in space. Without octaves the surface looks distant at
/// every distance.
pub struct Field(Option<Box<Noise>>);

impl GaussianField for Field {
    fn coordinates(&self, p: Vec3, frame: &Frame, octaves: f32) -> ResolvedBumps {
        self.0.as_ref().map_or(ResolvedBumps::FAR, |field| field.coordinates(p, frame, octaves))
    }

    fn lacunarity(&self) -> f32 {
        self.0.as_ref().map_or(2.0, |field| field.lacunarity())
    }

    fn max_octaves(&self) -> f32 {
        self.0.as_ref().map_or(0.0, |field| field.max_octaves())
    }
}

#[cfg(test)]
mod tests {
    use asperity_shading::Footprint;

    use super::*;

    #[test]
    fn kinds_differ_and_zero_octaves_are_flat() {
        let p = Vec3::new(0.3, 0.7, -1.9);
        let at = |kind, octaves| {
            let bumps = Bumps { kind, frequency: 1.0, octaves, gain: 0.8 }.field(3, DVec3::ZERO).unwrap();
            bumps.coordinates(p, &Frame::IDENTITY, Footprint::from_width(0.1)).z
        };
        let kinds = [NoiseKind::Gaussian, NoiseKind::Channels, NoiseKind::Perlin, NoiseKind::Simplex];
        for (i, &kind) in kinds.iter().enumerate() {
            assert_eq!(at(kind, 0), glam::Vec2::ZERO);
            assert!(kinds[..i].iter().all(|&other| at(other, 16) != at(kind, 16)), "{kind:?}");
        }
    }
}
