//! Dents: sparse low bumps, from noise with some of its gradients dropped.

use asperity_noise::{IntegerHash, Lattice, Sample, Simplex};
use glam::Vec3;

use crate::bump::project_to_tangent_plane;
use crate::error::ShadingError;
use crate::material::fbm::{SLOPE_VARIANCE, SizedFbm, spectrum};
use crate::parameter::{as_share, as_size, parameters};
use crate::pixel::Footprint;

/// A lattice with some inverted gradients.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Turned {
    /// Words below this are dropped ones.
    dropped: u32,
    /// The bits of a word that invert its gradient, or 0.
    turn: u32,
}

/// The signs of the components of a gradient in space are the three uppermost bits of its word.
const SIGNS: u32 = 7 << 29;

impl Lattice for Turned {
    fn word<const N: usize>(&self, cell: [i32; N], seed: u32) -> u32 {
        let word = IntegerHash.word(cell, seed);
        if IntegerHash.word(cell, !seed) < self.dropped { word ^ self.turn } else { word }
    }
}

parameters! {
    /// The parameters of [`Dents`], as in [`VariationsParameters`](crate::VariationsParameters).
    pub struct DentsParameters of Dents {
        /// The size of dents in units of the positions, within `[10⁻⁶, 10⁶]`. Default 0.1.
        dent_size: f32 = 0.1, as_size;
        /// The fraction of lattice gradients that is kept, within `[0, 1]`. Default 0.3.
        dent_cover: f32 = 0.3, as_share;
        /// The number of octaves, of lacunarity 2 and gain ½, from 1 to 8. Default 2.
        dent_detail: u32 = 2;
        /// Random seed.
        seed: u32 = 1;
    }
}

/// Dents: octaves of noise with a fraction of the lattice gradients dropped.
///
/// ```text
/// value = Σ aᵢ N_q(fᵢ p/size)/Σ aᵢ,   every gradient of N_q kept with probability cover = 1 − q
/// ```
///
/// The fewer gradients are kept, the more of the surface is flat, and the more isolated are the
/// dents; up to q = 0.7 they look natural. The variance is 1 − q times the variance without drops.
/// Octaves that a pixel cannot resolve fade to 0, their mean.
///
/// The height is `strength · size · value`, whose slope does not depend on the size.
///
/// It is computed as the mean of two simplex noises, one of which has the dropped gradients
/// inverted, so they cancel.
///
/// Nilsson 2008, §4.5.3.
///
/// ```
/// use asperity_shading::material::{Dents, DentsParameters};
/// use asperity_shading::{Footprint, glam::Vec3};
///
/// let dents = Dents::new(DentsParameters { dent_cover: 0.3, ..Default::default() })?;
/// assert!(dents.sample(Vec3::new(0.3, 0.1, 0.2), Footprint::from_width(1e-4)).value.abs() <= 1.0);
/// # Ok::<(), asperity_shading::ShadingError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dents {
    kept: SizedFbm<Simplex<Turned>>,
    turned: SizedFbm<Simplex<Turned>>,
    parameters: DentsParameters,
    dropped: u32,
}

impl Dents {
    /// Creates the dents of these parameters.
    ///
    /// # Errors
    /// [`ShadingError::OutOfRange`] with the first parameter that is out of its range.
    pub fn new(parameters: DentsParameters) -> Result<Self, ShadingError> {
        parameters.check()?;
        let DentsParameters { dent_size: size, dent_cover: cover, dent_detail, seed } = parameters;
        let spectrum = spectrum("dent_detail", [2.0, 0.5], dent_detail)?;
        // A cast of values beyond the largest word saturates.
        let dropped = ((1.0 - cover) * 4_294_967_296.0) as u32;
        let noise =
            |turn| SizedFbm::of(Simplex::new(0).with_lattice(Turned { dropped, turn }), spectrum, size, seed);
        Ok(Self { kept: noise(0), turned: noise(SIGNS), parameters, dropped })
    }

    /// The noise without inverted gradients.
    pub(crate) const fn noise(&self) -> &SizedFbm<Simplex<Turned>> {
        &self.kept
    }

    /// Words of the lattice below this are dropped gradients.
    pub(crate) const fn dropped(&self) -> u32 {
        self.dropped
    }

    /// Value, and gradient by p/size; both 0 where a coordinate is not finite.
    #[must_use]
    pub fn sample(&self, position: Vec3, footprint: Footprint) -> Sample<Vec3> {
        let [a, b] = [&self.kept, &self.turned].map(|noise| noise.sample(position, footprint));
        Sample { value: 0.5 * (a.value + b.value), gradient: 0.5 * (a.gradient + b.gradient) }
    }

    /// The height of dents of this strength.
    #[must_use]
    pub fn height(&self, strength: f32, position: Vec3, footprint: Footprint) -> f32 {
        strength * self.sample(position, footprint).value / self.kept.frequencies()[0]
    }

    /// The surface gradient of dents of this strength, for the unit normal `n`.
    #[must_use]
    pub fn gradient(&self, strength: f32, position: Vec3, n: Vec3, footprint: Footprint) -> Vec3 {
        project_to_tangent_plane(n, self.sample(position, footprint).gradient) * strength
    }

    /// The slope variance along each axis that a pixel does not resolve.
    #[must_use]
    pub fn removed_slope(&self, strength: f32, footprint: Footprint) -> f32 {
        strength * strength * self.kept.removed_slope(footprint, SLOPE_VARIANCE * self.parameters.dent_cover)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inverted_words_have_opposite_gradients() {
        for i in 0..1000_u32 {
            let word = i.wrapping_mul(0x9e37_79b9);
            let [a, b] = [word, word ^ SIGNS].map(asperity_noise::Perlin::gradient::<3>);
            assert_eq!(a, b.map(|x| -x), "{word}");
        }
    }

    #[test]
    fn dropped_gradients_leave_flat_areas() {
        let near = Footprint::from_width(0.0);
        let dents = |dent_cover, dent_detail| {
            Dents::new(DentsParameters { dent_size: 1.0, dent_cover, dent_detail, seed: 1 }).unwrap()
        };
        let (none, full, sparse) = (dents(0.0, 2), dents(1.0, 1), dents(0.1, 1));
        let mut flat = 0;
        for i in 0..1000_u16 {
            let p =
                Vec3::new(f32::from(i % 10) * 1.7, f32::from(i / 10 % 10) * 1.3, f32::from(i / 100) * 1.9);
            let sample = none.sample(p, near);
            assert!(sample.value.abs() < 1e-6 && sample.gradient.length() < 1e-5, "{p}: {sample:?}");
            assert!(full.sample(p, near).value.abs() <= 1.0);
            flat += u16::from(sparse.sample(p, near).gradient.length() < 1e-5);
        }
        // About three corners contribute at a point; 0.9³ = 0.73 and less.
        assert!((500..850).contains(&flat), "{flat}");
    }
}
