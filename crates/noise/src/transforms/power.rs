//! A field to an integer power, which draws its high parts out.

use crate::{contract::field::Field, contract::kernel::LaneSample, simd::lanes::Lanes};

/// fᵏ with the gradient k fᵏ⁻¹ ∇f.
///
#[cfg_attr(doc, doc = include_str!("../../docs/pictures/power.md"))]
///
/// The mean of a power is not the power of the mean: a sum whose octaves fade to their means inside of a power does not fade to
/// the power's mean.
///
/// ```
/// use asperity_noise::{Field, Normalisation, Octaves, Plasma, Power, Simplex, Spectrum, glam::Vec2};
///
/// // Threads: plasma of three equal octaves to the seventh power (Nilsson 2008, section 4.2.2).
/// let plasma = Octaves::new(Simplex::CONTINUOUS, Spectrum::THREADS, Normalisation::Range, 3).with_shape(Plasma);
/// let threads = Power(plasma.first(3.0), 7);
/// assert!((0.0..=1.0).contains(&threads.value(Vec2::new(0.2, 0.7))));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Power<F>(
    /// f.
    pub F,
    /// k; f⁰ = 1.
    pub u8,
);

impl<F: Field<N>, const N: usize> Field<N> for Power<F> {
    #[inline(always)]
    fn lane_values<S: Lanes>(&self, s: S, p: [S::F; N]) -> S::F {
        let value = self.0.lane_values(s, p);
        let mut power = s.float(1.0);
        for _ in 0..self.1 {
            power = power * value;
        }
        power
    }

    #[inline(always)]
    fn lane_samples<S: Lanes>(&self, s: S, p: [S::F; N]) -> LaneSample<S, N> {
        let (value, mut gradient) = self.0.lane_samples(s, p);
        let (mut power, mut before) = (s.float(1.0), s.float(0.0));
        for _ in 0..self.1 {
            before = power;
            power = power * value;
        }
        let slope = s.float(f32::from(self.1)) * before;
        for axis in 0..N {
            gradient[axis] = slope * gradient[axis];
        }
        (power, gradient)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{contract::field::Seeded, kinds::perlin::Perlin2002};
    use glam::Vec2;

    #[test]
    fn powers_are_powers() {
        let (field, p) = (Seeded(Perlin2002::default(), 3), Vec2::new(0.3, 1.8));
        let n = field.sample(p);
        let [one, itself, cube] = [0, 1, 3].map(|k| Power(field, k).sample(p));
        assert_eq!((one.value, one.gradient), (1.0, Vec2::ZERO));
        assert_eq!(itself, n);
        assert_eq!(cube.value, n.value * n.value * n.value);
        assert_eq!(cube.gradient, 3.0 * (n.value * n.value) * n.gradient);
    }
}
