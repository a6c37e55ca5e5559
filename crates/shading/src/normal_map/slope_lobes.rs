//! Slope lobes: a Gaussian mixture for normal maps with non-Gaussian slopes within a pixel.

use asperity_ndf_sampling::{Beckmann, Ndf as _};
use glam::{Vec2, Vec3};

use crate::level_of_detail::ResolvedBumps;
use crate::math::sqrt;
use crate::normal_map::bilinear::bilinear;
use crate::normal_map::slope_moments::SlopeMoments;

/// A part of the slopes within a pixel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SlopeLobe {
    /// Its fraction of the pixel.
    pub weight: f32,
    /// Its moments.
    pub moments: SlopeMoments,
}

/// The slopes within a pixel in `K` groups, each with its fraction and its moments.
///
/// A brick wall is flat nearly everywhere, and steep along few edges. One Gaussian fits neither.
/// The groups are those of a [`SlopePyramid`](crate::SlopePyramid), the same everywhere on the map;
/// `K = 1` is one Gaussian for all slopes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlopeLobes<const K: usize> {
    lobes: [SlopeLobe; K],
}

impl<const K: usize> Default for SlopeLobes<K> {
    fn default() -> Self {
        Self { lobes: [SlopeLobe::default(); K] }
    }
}

impl<const K: usize> SlopeLobes<K> {
    /// One slope, in the group of the nearest center.
    #[must_use]
    pub(super) fn point(slope: Vec2, centers: &[Vec2; K]) -> Self {
        let group = nearest(slope, centers);
        let mut lobes = Self::default();
        if let Some(lobe) = lobes.lobes.get_mut(group) {
            *lobe = SlopeLobe { weight: 1.0, moments: SlopeMoments::point(slope) };
        }
        lobes
    }

    /// A mixture of parts with weights, group by group; non-positive weights are ignored.
    #[must_use]
    pub(super) fn mixed(parts: impl IntoIterator<Item = (f32, Self)>) -> Self {
        let (mut mixed, mut all) = (Self::default(), 0.0);
        for (share, part) in parts {
            if share > 0.0 {
                all += share;
                for (lobe, other) in mixed.lobes.iter_mut().zip(part.lobes) {
                    let weight = share * other.weight;
                    if weight > 0.0 {
                        lobe.weight += weight;
                        lobe.moments = lobe.moments.joined(other.moments, weight / lobe.weight);
                    }
                }
            }
        }
        for lobe in &mut mixed.lobes {
            lobe.weight /= if all > 0.0 { all } else { 1.0 };
        }
        mixed
    }

    /// The groups.
    #[must_use]
    pub const fn lobes(&self) -> &[SlopeLobe; K] {
        &self.lobes
    }

    /// The moments of all groups together.
    #[must_use]
    pub fn moments(&self) -> SlopeMoments {
        SlopeMoments::mixed(self.lobes.iter().map(|lobe| (lobe.weight, lobe.moments)))
    }

    /// The density of facets that the pixel sees, with finer bumps of the NDF `fine`, in sr⁻¹.
    ///
    /// ```text
    /// p(h) = Σ_k w_k N(s(h); μ_k + √t α z/√2, Σ_k + (1 − t) α²/2)/h_z⁴,   t the resolved fraction
    /// ```
    ///
    /// If no finer bump is resolved, `noise` is [`ResolvedBumps::FAR`], and `fine` the roughness of
    /// the surface. See [`SlopeMoments::add_detail`].
    ///
    /// - **Domain:** unit `h` in the frame of the surface without the map, 0 for `h.z ≤ 0`, a zero
    ///   vector and NaN.
    /// - **Range:** at least 0, finite.
    #[must_use]
    pub fn density(&self, fine: Beckmann, noise: ResolvedBumps, h: Vec3) -> f32 {
        if h.z > 0.0 && h.is_finite() {
            let part = |lobe: &SlopeLobe| lobe.weight * lobe.moments.add_detail(fine, noise).d(h);
            self.lobes.iter().filter(|lobe| lobe.weight > 0.0).map(part).sum::<f32>().min(f32::MAX)
        } else {
            0.0
        }
    }
}

/// The group of a slope: the group of the nearest center.
fn nearest<const K: usize>(slope: Vec2, centers: &[Vec2; K]) -> usize {
    let mut best = (0, f32::INFINITY);
    for (k, center) in centers.iter().enumerate() {
        let distance = slope.distance_squared(*center);
        if distance < best.1 {
            best = (k, distance);
        }
    }
    best.0
}

/// Centers of `K` groups of slopes of the bilinear map.
///
/// They are far apart at first, then moved to the medians of their groups.
///
/// Twenty iterations of Lloyd 1982, *Least Squares Quantization in PCM*, from the points of
/// Gonzalez 1985, *Clustering to Minimize the Maximum Intercluster Distance*, with a step of
/// Weiszfeld 1937 to the median in place of the mean. It uses 4096 points evenly distributed over
/// the map. Points between texels are included, because next to an edge one texel wide most slopes
/// are interpolated.
pub(super) fn centers<const K: usize>(size: [usize; 2], slopes: &[Vec2]) -> [Vec2; K] {
    let some = || (0..4096_u32).map(|k| bilinear(evenly_spread(k), size, slopes));
    let mean = some().fold(Vec2::ZERO, |sum, slope| sum + slope / 4096.0);
    let mut centers = [mean; K];
    for k in 1..K {
        let known = centers;
        let away =
            |slope: Vec2| known.iter().take(k).map(|c| slope.distance_squared(*c)).fold(f32::MAX, f32::min);
        let farthest = some().fold((mean, 0.0), |best, slope| {
            let distance = away(slope);
            if distance > best.1 { (slope, distance) } else { best }
        });
        if let Some(center) = centers.get_mut(k) {
            *center = farthest.0;
        }
    }
    for _ in 0..20 {
        let mut sums = [(Vec2::ZERO, 0.0); K];
        for slope in some() {
            let group = nearest(slope, &centers);
            if let (Some((sum, count)), Some(center)) = (sums.get_mut(group), centers.get(group)) {
                let weight = 1.0 / (sqrt(slope.distance_squared(*center)) + 0.05);
                *sum += weight * (slope - *center);
                *count += weight;
            }
        }
        for (center, (sum, count)) in centers.iter_mut().zip(sums) {
            if count > 0.0 {
                *center += sum / count;
            }
        }
    }
    centers
}

/// Point k of a low-discrepancy sequence in the unit square.
///
/// Roberts 2018, *The Unreasonable Effectiveness of Quasirandom Sequences*, in two dimensions.
fn evenly_spread(k: u32) -> Vec2 {
    let place = |step: f64| {
        let x = 0.5 + f64::from(k) * step;
        // Positive, so the cast is the floor.
        (x - x as u64 as f64) as f32
    };
    Vec2::new(place(0.754_877_666_246_692_7), place(0.569_840_290_998_053_2))
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn centers_finds_the_groups() {
        let middles = [Vec2::ZERO, Vec2::new(1.0, 0.2), Vec2::new(-0.5, 0.8)];
        let slopes: [Vec2; 90] = core::array::from_fn(|k| {
            middles[k / 30] + 0.05 * Vec2::new((k as f32 * 1.7).sin(), (k as f32 * 2.9).cos())
        });
        let found = centers::<3>([90, 1], &slopes);
        for middle in middles {
            assert!(found.iter().any(|c| c.distance(middle) < 0.03), "{found:?}");
        }
        let lobes = SlopeLobes::mixed(slopes.map(|s| (2.0, SlopeLobes::point(s, &found))));
        let all = SlopeMoments::mixed(slopes.map(|s| (1.0, SlopeMoments::point(s))));
        assert!(lobes.lobes().iter().all(|lobe| (lobe.weight - 1.0 / 3.0).abs() < 1e-5), "{lobes:?}");
        assert_abs_diff_eq!(lobes.moments().mean, all.mean, epsilon = 1e-5);
        for (got, all) in lobes.moments().covariance.into_iter().zip(all.covariance) {
            assert_abs_diff_eq!(got, all, epsilon = 1e-5);
        }
        // More groups than slopes.
        for center in centers::<4>([1, 1], &[Vec2::ONE]) {
            // Four roundings of the bilinear weights.
            assert_abs_diff_eq!(center, Vec2::ONE, epsilon = 3e-7);
        }
        assert_eq!(centers::<2>([1, 1], &[]), [Vec2::ZERO; 2]);
    }

    #[test]
    fn density_of_invalid_half_vectors_is_zero() {
        let lobes = SlopeLobes::point(Vec2::new(0.3, 0.1), &[Vec2::ZERO]);
        let fine = Beckmann::isotropic(0.2).unwrap();
        for h in [Vec3::ZERO, Vec3::NEG_Z, Vec3::X, Vec3::NAN, Vec3::INFINITY] {
            assert_eq!(lobes.density(fine, ResolvedBumps::FAR, h), 0.0, "{h}");
        }
        assert!(lobes.density(fine, ResolvedBumps::FAR, lobes.moments().normal()) > 5.0);
        assert_eq!(SlopeLobes::<2>::default().density(fine, ResolvedBumps::FAR, Vec3::Z), 0.0);
    }
}
