//! The octaves of one point, evaluated one per lane and then added in order.
//!
//! A lane has the same bits as the octave evaluated alone, and the sum has a fixed order. The sum
//! therefore has the same bits as a sum evaluated octave by octave.

use crate::{
    contract::kernel::{Kernel, OctaveSamples},
    kinds::gaussian::GaussianNoise,
    lanes::{LaneSample, Scalar},
    lattice::lattice::Lattice,
    sums::octave::Layers,
    sums::shape::Shape,
    sums::spectrum::MAX_OCTAVES,
    sums::whitened::Whitening,
};

const OCTAVES: usize = MAX_OCTAVES as usize;

/// Value and gradient of a sum, before its factor.
pub(crate) type Sum<const N: usize> = LaneSample<Scalar, N>;

/// The octaves of a sum at a point.
pub(crate) struct AtPoint<'a, const N: usize> {
    pub(crate) layers: &'a Layers<[f32; N]>,
    pub(crate) amplitudes: &'a [f32; OCTAVES],
    pub(crate) count: usize,
    pub(crate) p: [f32; N],
}

impl<const N: usize> AtPoint<'_, N> {
    /// Adds the octaves to a sum; `None` if there is only one lane. Values alone would be at most a
    /// fourth faster.
    #[inline(always)]
    pub(crate) fn add<K: Kernel<N>, T: Shape>(&self, noise: &K, shape: T, sum: &mut Sum<N>) -> Option<()> {
        let points = self.layers.points(self.p);
        let octaves = self.layers.octaves_at(&points, self.count);
        let mut samples = OctaveSamples::ZERO;
        noise.octaves_at(octaves, &mut samples)?;
        if !T::IS_IDENTITY {
            for i in 0..OCTAVES {
                let n = samples.values[i];
                samples.values[i] = shape.value(n);
                let slope = shape.slope(n);
                for axis in 0..N {
                    samples.gradients[axis][i] *= slope;
                }
            }
        }
        self.add_up(&samples, sum);
        Some(())
    }

    /// Adds both channels of the octaves to their sums; `None` if there are fewer lanes than two
    /// points fill.
    #[inline(always)]
    pub(crate) fn add_pair<L: Lattice>(
        &self,
        noise: &GaussianNoise<L>,
        sums: &mut [Sum<N>; 2],
    ) -> Option<()> {
        let points = self.layers.points(self.p);
        let octaves = self.layers.octaves_at(&points, self.count);
        let mut samples = [OctaveSamples::ZERO; 2];
        noise.pairs_at(octaves, &mut samples)?;
        for (samples, sum) in samples.iter().zip(sums) {
            self.add_up(samples, sum);
        }
        Some(())
    }

    /// Returns the sum of the whitened gradients of the octaves.
    #[inline(always)]
    pub(crate) fn whitened<L: Lattice>(&self, noise: &GaussianNoise<L>, tangents: [[f32; N]; 2]) -> [f32; 2] {
        let &Self { layers, p, count, .. } = self;
        let mut z = [[0.0; OCTAVES]; 2];
        Whitening { layers, p, tangents, count, z: &mut z }.run(noise);
        z.map(|z| {
            z.iter().zip(self.amplitudes).take(count).fold(0.0, |sum, (z, amplitude)| sum + amplitude * z)
        })
    }

    /// Adds amplitude times value of the octaves, and the gradients rotated back.
    #[inline(always)]
    fn add_up(&self, samples: &OctaveSamples<N>, sum: &mut Sum<N>) {
        let gradients = self.layers.pulled_back(&samples.gradients);
        for i in 0..self.count.min(OCTAVES) {
            sum.0 += self.amplitudes[i] * samples.values[i];
            for axis in 0..N {
                sum.1[axis] += self.amplitudes[i] * gradients[axis][i];
            }
        }
    }
}
