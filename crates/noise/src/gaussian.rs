//! Value-gradient noise, normalised so that it is exactly Gaussian at every point.

use glam::{Vec2, Vec3};

use crate::{
    blend::{Corners, blend2, blend3},
    fade::Fade,
    integer_hash::{IntegerHash, second_word},
    lattice::{Lattice, cell},
    math,
    noise::Noise,
    sample::Sample,
    space::Point,
    statistics::Statistics,
    statistics_tables as tables,
    variates::{gaussian_variates_2, gaussian_variates_3},
};

/// Noise with the distribution N(0, 1) at every point; C² before, and C² after normalisation.
///
/// ```text
/// n(p) = Σ_c W_c(p) (s_c + 2 g_c·(p − c)),   v(p) = Σ_c W_c(p)² (1 + 4 |p − c|²),   z = n/√v
/// ```
///
/// Each corner c of the cell carries independent N(0, 1) variates, a value s_c and a gradient g_c; W are the products
/// of 6t⁵ − 15t⁴ + 10t³. Given p, n is a linear combination of Gaussians with variance v, so z is N(0, 1): at lattice
/// points, in cell centres and between. v is from 0.75 to 1.07 in 2-D and from 0.5 to 1.09 in 3-D, least in cell centres.
///
/// - **Gradient:** ∇z = (∇n − n ∇v/(2v))/√v.
/// - **Range:** all of ℝ up to the variates' 12 bits, see [`gaussian_variates_2`].
///
/// ```
/// use asperity_noise::{Gaussian, Noise, glam::Vec3};
///
/// let noise = Gaussian::default();
/// let mean_square = (0..10_000).map(|seed| noise.value(Vec3::ZERO, seed).powi(2)).sum::<f32>() / 10_000.0;
/// assert!((mean_square - 1.0).abs() < 0.05);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Gaussian<L = IntegerHash>(
    /// The lattice that the variates are drawn from.
    pub L,
);

impl Default for Gaussian {
    fn default() -> Self {
        Self(IntegerHash)
    }
}

impl<L: Lattice> Gaussian<L> {
    /// Two channels from one walk of the lattice, independent of each other.
    ///
    /// The first is [`sample`](Noise::sample)'s; the second has its own variates at each corner. Cells and weights are
    /// shared, so that the pair costs less than two noises.
    #[must_use]
    #[inline]
    pub fn pair<V: Point>(&self, p: V, seed: u32) -> [Sample<V>; 2] {
        V::linear::<L, 2>(&self.0, p, seed).normalised()
    }

    /// The noise before normalisation, n, and its variance, v, each with its gradient.
    ///
    /// Both are 0 where p is not finite.
    #[must_use]
    #[inline]
    pub fn with_variance<V: Point>(&self, p: V, seed: u32) -> (Sample<V>, Sample<V>) {
        let Linear { noise: [noise], variance } = V::linear::<L, 1>(&self.0, p, seed);
        (noise, variance)
    }
}

impl<L: Lattice> Noise<Vec2> for Gaussian<L> {
    #[inline]
    fn sample(&self, p: Vec2, seed: u32) -> Sample<Vec2> {
        let [sample] = linear2::<L, 1>(&self.0, p, seed).normalised();
        sample
    }

    fn statistics(&self) -> &'static Statistics {
        &tables::GAUSSIAN_2
    }
}

impl<L: Lattice> Noise<Vec3> for Gaussian<L> {
    #[inline]
    fn sample(&self, p: Vec3, seed: u32) -> Sample<Vec3> {
        let [sample] = linear3::<L, 1>(&self.0, p, seed).normalised();
        sample
    }

    fn statistics(&self) -> &'static Statistics {
        &tables::GAUSSIAN_3
    }
}

/// Linear combinations of Gaussian variates with common weights, and their variance.
#[derive(Clone, Copy, Debug)]
pub struct Linear<V, const C: usize> {
    pub(crate) noise: [Sample<V>; C],
    pub(crate) variance: Sample<V>,
}

impl<V: Point, const C: usize> Linear<V, C> {
    fn zero() -> Self {
        Self { noise: [Sample::default(); C], variance: Sample::default() }
    }

    /// n/√v and its gradient; 0 where v is 0, off the finite points.
    #[inline(always)]
    pub(crate) fn normalised(&self) -> [Sample<V>; C] {
        let v = self.variance;
        if v.value == 0.0 {
            return [Sample::default(); C];
        }
        let inverse = 1.0 / math::sqrt(v.value);
        let half_inverse_v = 0.5 * inverse * inverse;
        self.noise.map(|n| {
            let value = n.value * inverse;
            let gradient = n.gradient.scaled(inverse).add_scaled(-(value * half_inverse_v), v.gradient);
            Sample { value, gradient }
        })
    }
}

/// The sums of one axis that v is made of: P = Σ w², Q = Σ w² d², with their derivatives.
struct AxisVariance {
    p: f32,
    q: f32,
    dp: f32,
    dq: f32,
}

impl AxisVariance {
    #[inline(always)]
    fn new(t: f32, fade: Fade) -> Self {
        let (high, slope) = (fade.weight, fade.slope);
        let (low, rest) = (1.0 - high, 1.0 - t);
        let (low_t, high_rest) = (low * t, high * rest);
        Self {
            p: low * low + high * high,
            q: low_t * low_t + high_rest * high_rest,
            dp: 2.0 * slope * (high - low),
            dq: 2.0 * (low_t * (low - slope * t) + high_rest * (slope * rest - high)),
        }
    }
}

#[inline(always)]
pub(crate) fn linear2<L: Lattice, const C: usize>(lattice: &L, p: Vec2, seed: u32) -> Linear<Vec2, C> {
    if !p.is_finite() {
        return Linear::zero();
    }
    let [(x, tx), (y, ty)] = [cell(p.x), cell(p.y)];
    let mut ends = [[Corners::<2, 2>::ZERO; C]; 2];
    for (end, channels) in ends.iter_mut().enumerate() {
        for lane in 0..2 {
            let mut word = lattice.hash2(x.wrapping_add(end as i32), y.wrapping_add(lane as i32), seed);
            for corners in channels.iter_mut() {
                let [s, gx, gy] = gaussian_variates_2(word);
                corners.value[lane] = s;
                corners.gradient[0][lane] = gx;
                corners.gradient[1][lane] = gy;
                word = second_word(word);
            }
        }
        let dx = tx - end as f32;
        let dy = [ty, ty - 1.0];
        for corners in channels.iter_mut() {
            for (lane, dy) in dy.into_iter().enumerate() {
                let [gx, gy] = [corners.gradient[0][lane] * 2.0, corners.gradient[1][lane] * 2.0];
                corners.gradient[0][lane] = gx;
                corners.gradient[1][lane] = gy;
                corners.value[lane] += gx * dx + gy * dy;
            }
        }
    }
    let fades = [Fade::quintic(tx), Fade::quintic(ty)];
    let [low, high] = ends;
    let mut noise = [Sample::default(); C];
    for (noise, (low, high)) in noise.iter_mut().zip(low.iter().zip(&high)) {
        *noise = blend2(low, high, fades);
    }
    let [ax, ay] = [AxisVariance::new(tx, fades[0]), AxisVariance::new(ty, fades[1])];
    let variance = Sample {
        value: ax.p * ay.p + 4.0 * (ax.q * ay.p + ax.p * ay.q),
        gradient: Vec2::new(
            ax.dp * ay.p + 4.0 * (ax.dq * ay.p + ax.dp * ay.q),
            ax.p * ay.dp + 4.0 * (ax.q * ay.dp + ax.p * ay.dq),
        ),
    };
    Linear { noise, variance }
}

#[inline(always)]
pub(crate) fn linear3<L: Lattice, const C: usize>(lattice: &L, p: Vec3, seed: u32) -> Linear<Vec3, C> {
    if !p.is_finite() {
        return Linear::zero();
    }
    let [(x, tx), (y, ty), (z, tz)] = [cell(p.x), cell(p.y), cell(p.z)];
    let mut ends = [[Corners::<4, 3>::ZERO; C]; 2];
    for (end, channels) in ends.iter_mut().enumerate() {
        for lane in 0..4 {
            let mut word = lattice.hash3(
                x.wrapping_add(end as i32),
                y.wrapping_add((lane & 1) as i32),
                z.wrapping_add((lane >> 1) as i32),
                seed,
            );
            for corners in channels.iter_mut() {
                let [s, gx, gy, gz] = gaussian_variates_3(word);
                corners.value[lane] = s;
                corners.gradient[0][lane] = gx;
                corners.gradient[1][lane] = gy;
                corners.gradient[2][lane] = gz;
                word = second_word(word);
            }
        }
        let dx = tx - end as f32;
        let dy = [ty, ty - 1.0, ty, ty - 1.0];
        let dz = [tz, tz, tz - 1.0, tz - 1.0];
        for corners in channels.iter_mut() {
            for lane in 0..4 {
                let [gx, gy, gz] = corners.gradient.map(|g| g[lane] * 2.0);
                corners.gradient[0][lane] = gx;
                corners.gradient[1][lane] = gy;
                corners.gradient[2][lane] = gz;
                corners.value[lane] += gx * dx + gy * dy[lane] + gz * dz[lane];
            }
        }
    }
    let fades = [Fade::quintic(tx), Fade::quintic(ty), Fade::quintic(tz)];
    let [low, high] = ends;
    let mut noise = [Sample::default(); C];
    for (noise, (low, high)) in noise.iter_mut().zip(low.iter().zip(&high)) {
        *noise = blend3(low, high, fades);
    }
    let ax = AxisVariance::new(tx, fades[0]);
    let ay = AxisVariance::new(ty, fades[1]);
    let az = AxisVariance::new(tz, fades[2]);
    let pyz = ay.p * az.p;
    let qyz = ay.q * az.p + ay.p * az.q;
    let variance = Sample {
        value: ax.p * pyz + 4.0 * (ax.q * pyz + ax.p * qyz),
        gradient: Vec3::new(
            ax.dp * pyz + 4.0 * (ax.dq * pyz + ax.dp * qyz),
            (ax.p + 4.0 * ax.q) * ay.dp * az.p + 4.0 * ax.p * (ay.dq * az.p + ay.dp * az.q),
            (ax.p + 4.0 * ax.q) * ay.p * az.dp + 4.0 * ax.p * (ay.q * az.dp + ay.p * az.dq),
        ),
    };
    Linear { noise, variance }
}
