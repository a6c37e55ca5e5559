//! Moments over the square of a texel, from which texture levels are made and combined.

use asperity_shading::normal_map::SlopeMoments;
use glam::{Vec2, Vec3};
use rayon::prelude::*;

/// Numbers per texel in a file.
const NUMBERS: usize = 12;

/// Bytes per texel in a file.
pub(crate) const BYTES: usize = 4 * NUMBERS;

/// Means of a surface over a square.
///
/// Slopes are `(n_x, n_y)/n_z` of the normals, or the Gaussian coordinates of a density's normals,
/// depending on the source. Levels combine only their first and second moments.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Texel {
    pub(crate) slopes: SlopeMoments,
    /// The mean of α² of the surface between the slopes.
    pub(crate) alpha2: f32,
    /// In units of the texture's side.
    pub(crate) height: f32,
    /// Base color, linear.
    pub(crate) color: Vec3,
    pub(crate) metallic: f32,
    /// The fraction of uniform sky light that reaches the surface.
    pub(crate) occlusion: f32,
}

impl Texel {
    /// Returns the weighted mean of parts of the square.
    pub(crate) fn mixed(parts: impl IntoIterator<Item = (f32, Self)>) -> Self {
        let (mut all, mut mixed) = (0.0, Self::default());
        for (share, part) in parts {
            all += share;
            mixed.slopes = SlopeMoments::mixed([(all - share, mixed.slopes), (share, part.slopes)]);
            mixed.alpha2 += share * part.alpha2;
            mixed.height += share * part.height;
            mixed.color += share * part.color;
            mixed.metallic += share * part.metallic;
            mixed.occlusion += share * part.occlusion;
        }
        mixed
    }

    /// Returns the parent of four texels.
    pub(crate) fn above(four: [Self; 4]) -> Self {
        Self::mixed(four.map(|part| (0.25, part)))
    }

    pub(crate) fn to_bytes(self) -> [u8; BYTES] {
        let ([xx, xy, yy], mean) = (self.slopes.covariance, self.slopes.mean);
        let Vec3 { x: r, y: g, z: b } = self.color;
        let numbers: [f32; NUMBERS] =
            [mean.x, mean.y, xx, xy, yy, self.alpha2, self.height, r, g, b, self.metallic, self.occlusion];
        let mut bytes = [0; BYTES];
        for (place, number) in bytes.chunks_exact_mut(4).zip(numbers) {
            place.copy_from_slice(&number.to_le_bytes());
        }
        bytes
    }

    pub(crate) fn from_bytes(bytes: &[u8; BYTES]) -> Self {
        let mut numbers = [0.0; NUMBERS];
        for (number, place) in numbers.iter_mut().zip(bytes.chunks_exact(4)) {
            *number = f32::from_le_bytes([place[0], place[1], place[2], place[3]]);
        }
        let [x, y, xx, xy, yy, alpha2, height, r, g, b, metallic, occlusion] = numbers;
        let slopes = SlopeMoments { mean: Vec2::new(x, y), covariance: [xx, xy, yy] };
        Self { slopes, alpha2, height, color: Vec3::new(r, g, b), metallic, occlusion }
    }
}

/// Halves a square of texels repeatedly, down to a single texel.
pub(crate) fn halved(texels: &[Texel], side: usize) -> Vec<Texel> {
    let half = side / 2;
    (0..half * half)
        .into_par_iter()
        .map(|k| {
            let first = 2 * (k / half) * side + 2 * (k % half);
            Texel::above([0, 1, side, side + 1].map(|step| texels[first + step]))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn some(k: f32) -> Texel {
        Texel {
            slopes: SlopeMoments { mean: Vec2::new(0.1 * k, -0.3), covariance: [0.2, 0.01 * k, 0.4] },
            alpha2: 0.3 + k,
            height: -k,
            color: Vec3::new(0.1, k, 0.9),
            metallic: 0.25,
            occlusion: 0.75,
        }
    }

    #[test]
    fn bytes_round_trip() {
        assert_eq!(Texel::from_bytes(&some(0.7).to_bytes()), some(0.7));
    }

    #[test]
    fn above_keeps_lost_variance_as_covariance() {
        let level = halved(&[0.0, 1.0, 2.0, 3.0].map(some), 2);
        assert_eq!(level.len(), 1);
        // The mean of (0, 0.1, 0.2, 0.3), and its variance in addition to the variance of the
        // parts.
        let [xx, ..] = level[0].slopes.covariance;
        assert!((level[0].slopes.mean.x - 0.15).abs() < 1e-6 && (xx - 0.2125).abs() < 1e-6, "{level:?}");
        assert!((level[0].alpha2 - 1.8).abs() < 1e-6 && (level[0].height + 1.5).abs() < 1e-6, "{level:?}");
    }
}
