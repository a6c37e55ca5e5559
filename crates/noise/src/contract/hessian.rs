//! Second derivatives: a noise's value, gradient and Hessian from one evaluation.

use crate::{
    contract::field::{Field, Seeded},
    contract::kernel::{Kernel, evaluated},
    contract::point::Point,
    kinds::gaussian::Gaussian,
    simd::lanes::Scalar,
    sums::gaussian_octaves::FirstGaussianOctaves,
    sums::octave::{Layer, Rotation},
    sums::octaves::FirstOctaves,
};

/// Value, gradient and Hessian at a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Jet<V, const N: usize> {
    /// The value, dimensionless.
    pub value: f32,
    /// ∂value/∂p, per unit length of the input.
    pub gradient: V,
    /// ∂²value/∂pᵢ∂pⱼ, per unit length squared; symmetric, bit for bit.
    pub hessian: [[f32; N]; N],
}

impl<const N: usize> Jet<[f32; N], N> {
    pub(crate) const ZERO: Self = Self { value: 0.0, gradient: [0.0; N], hessian: [[0.0; N]; N] };

    fn at<V: Point<N>>(self) -> Jet<V, N> {
        Jet { value: self.value, gradient: V::from_coordinates(self.gradient), hessian: self.hessian }
    }
}

/// A kind of noise that knows its second derivatives.
///
/// [`Perlin1985`](crate::Perlin1985), [`Perlin2002`](crate::Perlin2002), [`Simplex`](crate::Simplex),
/// [`Gaussian`], [`Value`](crate::Value) and [`ValueGradient`](crate::ValueGradient) do, in 1 to 4 dimensions. Value and gradient have the bits of
/// [`Noise::sample`](crate::Noise::sample).
///
/// - **Continuity:** quintic weights are C², so that the Hessians of Perlin's noise of 2002 and of Gaussian noise are continuous;
///   that of simplex noise with r² = ½ is even smooth. Cubic weights are C¹ only: the Hessian of
///   [`Perlin1985`](crate::Perlin1985) leaps at the borders of cells, where w″ goes from −6 to 6. On a border the cell above it
///   counts. Wide simplex noise leaps itself.
/// - Points that are not finite give 0, as everywhere.
///
/// ```
/// use asperity_noise::{Curved, Noise, Perlin2002, glam::Vec2};
///
/// let (noise, p, h) = (Perlin2002::default(), Vec2::new(0.4, -2.7), 1e-3);
/// let jet = noise.jet(p, 1);
/// assert_eq!(jet.gradient, noise.sample(p, 1).gradient);
///
/// let [ahead, behind] = [h, -h].map(|h| noise.sample(p + Vec2::new(h, 0.0), 1).gradient);
/// let difference = (ahead - behind) / (2.0 * h);
/// assert!((jet.hessian[0][0] - difference.x).abs() < 0.01 && (jet.hessian[0][1] - difference.y).abs() < 0.01);
/// ```
pub trait Curved<const N: usize>: Kernel<N> {
    /// Value, gradient and Hessian at a point whose coordinates are at most 2³¹ in magnitude.
    #[must_use]
    fn near_jet(&self, p: [f32; N], seed: u32) -> Jet<[f32; N], N>;

    /// Value, gradient and Hessian at any point.
    #[must_use]
    #[inline]
    fn jet<V: Point<N>>(&self, p: V, seed: u32) -> Jet<V, N> {
        evaluated::<Self, N>(p.coordinates()).map_or(Jet::ZERO, |p| self.near_jet(p, seed)).at()
    }
}

/// A field that knows its second derivatives: a [`Curved`] noise with its seed, or a sum of octaves of one.
///
/// ```text
/// H = Σ wᵢ aᵢ Mᵢᵀ Hᵢ(Mᵢ p + oᵢ) Mᵢ / N,   Mᵢ = fᵢ Rᵢ
/// ```
///
/// ```
/// use asperity_noise::{CurvedField, Field, Octaves, Perlin2002, Spectrum, glam::Vec3};
///
/// let octaves = Octaves::new(Perlin2002::default(), Spectrum::default(), Default::default(), 1);
/// let p = Vec3::new(0.1, 0.2, 0.3);
/// let jet = octaves.first(3.5).jet(p);
/// assert_eq!((jet.value, jet.gradient), (octaves.value(p, 3.5), octaves.sample(p, 3.5).gradient));
/// ```
pub trait CurvedField<const N: usize>: Field<N> {
    /// Value, gradient and Hessian at any point.
    #[must_use]
    fn jet<V: Point<N>>(&self, p: V) -> Jet<V, N>;
}

impl<K: Curved<N>, const N: usize> CurvedField<N> for Seeded<K> {
    #[inline]
    fn jet<V: Point<N>>(&self, p: V) -> Jet<V, N> {
        self.0.jet(p, self.1)
    }
}

impl<K: Curved<N>, const N: usize> CurvedField<N> for FirstOctaves<'_, K, N> {
    fn jet<V: Point<N>>(&self, p: V) -> Jet<V, N> {
        sum(self.noise(), self.active(), self.rotation(), self.factor(), p.coordinates()).at()
    }
}

impl<const N: usize> CurvedField<N> for FirstGaussianOctaves<'_, N> {
    fn jet<V: Point<N>>(&self, p: V) -> Jet<V, N> {
        sum(&Gaussian::default(), self.active(), Rotation::Random, self.factor(), p.coordinates()).at()
    }
}

/// factor · Σ amplitude · octave.
fn sum<'a, K: Curved<N>, const N: usize>(
    noise: &K,
    octaves: impl Iterator<Item = (f32, &'a Layer<N>)>,
    rotation: Rotation,
    factor: f32,
    p: [f32; N],
) -> Jet<[f32; N], N> {
    let (mut sum, mut hessian) = ((0.0, [0.0; N]), [[0.0; N]; N]);
    for (amplitude, layer) in octaves {
        let octave;
        if rotation == Rotation::Random {
            octave = noise.jet(Coordinates(layer.points(Scalar, p)), layer.seed);
            layer.accumulate(Scalar, &mut sum, amplitude, (octave.value, octave.gradient.0));
        } else {
            octave = noise.jet(Coordinates(layer.aligned(Scalar, p)), layer.seed);
            layer.accumulate_aligned(Scalar, &mut sum, amplitude, (octave.value, octave.gradient.0));
        }
        // M as the rows of what it makes of the axes: H M, then Mᵀ (H M).
        let turned = octave.hessian.map(|row| layer.pull_back(Scalar, row));
        for i in 0..N {
            for j in i..N {
                let entry = (0..N).fold(0.0, |entry, k| entry + layer.matrix[k][i] * turned[k][j]);
                hessian[i][j] += amplitude * entry;
            }
        }
    }
    let (value, gradient) = sum;
    mirror(&mut hessian);
    Jet {
        value: value * factor,
        gradient: gradient.map(|g| g * factor),
        hessian: hessian.map(|row| row.map(|x| x * factor)),
    }
}

/// Copies what is above the diagonal to below it.
pub(crate) fn mirror<const N: usize>(matrix: &mut [[f32; N]; N]) {
    for i in 0..N {
        for j in 0..i {
            matrix[i][j] = matrix[j][i];
        }
    }
}

/// Coordinates as a point of any dimension.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Coordinates<const N: usize>([f32; N]);

impl<const N: usize> Default for Coordinates<N> {
    fn default() -> Self {
        Self([0.0; N])
    }
}

impl<const N: usize> Point<N> for Coordinates<N> {
    fn coordinates(self) -> [f32; N] {
        self.0
    }
    fn from_coordinates(coordinates: [f32; N]) -> Self {
        Self(coordinates)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        contract::noise::Noise, kinds::perlin::Perlin1985, kinds::perlin::Perlin2002,
        kinds::simplex::simplex::Simplex, sums::octaves::Octaves, sums::spectrum::Spectrum,
    };
    use glam::{Vec2, Vec3, Vec4};

    fn bits<V: Point<N>, K: Curved<N> + Noise<V>, const N: usize>(noise: &K, p: V) {
        let (jet, sample) = (noise.jet(p, 7), noise.sample(p, 7));
        assert_eq!((jet.value, jet.gradient), (sample.value, sample.gradient), "{p:?}");
        for i in 0..N {
            for j in 0..N {
                assert_eq!(jet.hessian[i][j], jet.hessian[j][i], "{p:?}");
            }
        }
    }

    #[test]
    fn value_and_gradient_are_the_sample() {
        for i in 0..50_i16 {
            let x = f32::from(i) * 0.37 - 9.0;
            let p = Vec4::new(x, 2.0 - 0.61 * x, x * x * 0.1, -0.3 * x);
            bits(&Perlin1985::default(), p);
            bits(&Perlin2002::default(), p.truncate());
            bits(&Simplex::CONTINUOUS, p);
            bits(&Simplex::WIDE, p.truncate().truncate());
            bits(&Gaussian::default(), p.truncate());
            bits(&Gaussian::default(), x);
        }
    }

    #[test]
    fn jets_of_sums_are_those_of_the_sums() {
        let p = Vec3::new(0.3, -4.2, 1.9);
        for rotation in [Rotation::Random, Rotation::Aligned] {
            let octaves = Octaves::new(Simplex::CONTINUOUS, Spectrum::default(), Default::default(), 3);
            let octaves = octaves.with_rotation(rotation);
            let (jet, sample) = (octaves.first(4.5).jet(p), octaves.sample(p, 4.5));
            assert_eq!((jet.value, jet.gradient), (sample.value, sample.gradient), "{rotation:?}");
        }
    }

    #[test]
    fn points_that_are_none_have_jets_of_zero() {
        let jet = Gaussian::default().jet(Vec2::new(f32::NAN, 1.0), 1);
        assert_eq!(jet, Jet { value: 0.0, gradient: Vec2::ZERO, hessian: [[0.0; 2]; 2] });
        let far = Simplex::CONTINUOUS.jet(Vec2::new(f32::MAX, -3e9), 1);
        assert!(far.hessian.iter().flatten().all(|x| x.is_finite()));
    }

    #[test]
    fn the_hessian_of_1985_leaps_where_cells_meet() {
        let leap = |jets: [Jet<Vec2, 2>; 2]| {
            let [below, at] = jets;
            assert!((below.gradient - at.gradient).length() < 1e-5);
            (below.hessian[0][0] - at.hessian[0][0]).abs()
        };
        let leaps = |noise: &dyn Fn(Vec2) -> Jet<Vec2, 2>| {
            (1..20_u8).fold(0.0, |greatest: f32, k| {
                let y = f32::from(k) * 0.37;
                greatest.max(leap([3.0_f32.next_down(), 3.0].map(|x| noise(Vec2::new(x, y)))))
            })
        };
        assert!(leaps(&|p| Perlin1985::default().jet(p, 1)) > 1.0);
        assert!(leaps(&|p| Perlin2002::default().jet(p, 1)) < 1e-4);
    }
}
