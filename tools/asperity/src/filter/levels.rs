//! The mip levels of a roughness map, each with the variance of slopes that it loses.

use std::sync::atomic::AtomicBool;

use asperity_render::failure::Interrupted;
use rayon::prelude::*;

use crate::filter::tails::Spread;
use crate::filter::texels::Texels;

/// What a texel of a level covers.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Texel {
    pub(super) slopes: Spread,
    /// The mean of occlusion, roughness and metallic: what a loader's mip levels have.
    pub(super) plain: [f32; 3],
}

impl Texel {
    /// Returns `α² = α₀² + 2 Σ` along both axes of the slopes, in `[0, 1]`, and the direction of
    /// the first, along which it is larger. Less of Σ is added where few texels are steep.
    pub(super) fn alpha2_along(self) -> ([f32; 2], [f32; 2]) {
        let [xx, xy, yy] = self.added();
        let (mean, apart) = (0.5 * (xx + yy), f32::hypot(0.5 * (xx - yy), xy));
        let angle = 0.5 * f32::atan2(xy, 0.5 * (xx - yy));
        let alpha2 =
            [mean + apart, mean - apart].map(|variance| (self.alpha2() + 2.0 * variance).clamp(0.0, 1.0));
        (alpha2, [angle.cos(), angle.sin()])
    }

    /// Returns the roughness with the mean of both variances: `α² = α₀² + tr Σ`, or less where few
    /// texels are steep.
    pub(super) fn roughness(self) -> f32 {
        let [xx, _, yy] = self.added();
        (self.alpha2() + xx + yy).clamp(0.0, 1.0).sqrt().sqrt()
    }

    /// Returns the covariance that is added.
    fn added(self) -> [f32; 3] {
        let kept = self.slopes.kept(self.alpha2());
        self.slopes.moments.covariance.map(|variance| kept * variance)
    }

    /// Returns α₀² of the plain level.
    ///
    /// The mean of α² would widen the lobes of maps with smooth and rough texels, although no
    /// normal is lost.
    fn alpha2(self) -> f32 {
        self.plain[1].powi(4)
    }
}

/// A mip level.
struct Level {
    size: [usize; 2],
    texels: Vec<Texel>,
}

/// All mip levels of a material's roughness.
pub(super) struct Levels {
    /// The first level.
    pub(super) texels: Texels,
    /// The others, to one texel.
    further: Vec<Level>,
}

impl Levels {
    /// Computes all levels.
    pub(super) fn new(texels: Texels, interrupted: &AtomicBool) -> Result<Self, Interrupted> {
        let mut further: Vec<Level> = Vec::new();
        let mut finer = texels.size;
        while finer != [1, 1] {
            Interrupted::check(interrupted)?;
            let size = finer.map(|side| (side / 2).max(1));
            let all = match further.last() {
                None => covered(size, finer, |k| Texel { slopes: texels.spread(k), ..first(&texels, k) }),
                Some(level) => covered(size, finer, |k| level.texels[k]),
            };
            further.push(Level { size, texels: all });
            finer = size;
        }
        Ok(Self { texels, further })
    }

    pub(super) fn count(&self) -> usize {
        1 + self.further.len()
    }

    pub(super) fn size(&self, level: usize) -> [usize; 2] {
        level.checked_sub(1).map_or(self.texels.size, |k| self.further[k].size)
    }

    /// Returns a texel. The first level loses no slopes.
    pub(super) fn texel(&self, level: usize, k: usize) -> Texel {
        level.checked_sub(1).map_or_else(|| first(&self.texels, k), |level| self.further[level].texels[k])
    }

    /// Computes a value of each texel of a level.
    pub(super) fn map<T: Send>(&self, level: usize, of: impl Fn(Texel) -> T + Sync) -> Vec<T> {
        let [width, height] = self.size(level);
        (0..width * height).into_par_iter().map(|k| of(self.texel(level, k))).collect()
    }
}

/// Returns a texel of the maps as they are.
fn first(texels: &Texels, k: usize) -> Texel {
    let plain = texels.texel(k);
    Texel { plain, ..Texel::default() }
}

/// Returns the texels of a level from the finer level that they cover.
fn covered(size: [usize; 2], finer: [usize; 2], texel: impl Fn(usize) -> Texel + Sync) -> Vec<Texel> {
    let mean = |k: usize| {
        let (mut parts, mut all) = ([(0.0, Spread::default()); 9], 0.0);
        let mut mean = Texel::default();
        let rows = overlaps(k / size[0], size[1], finer[1]);
        let covered = rows.flat_map(|(row, high)| {
            overlaps(k % size[0], size[0], finer[0])
                .map(move |(column, wide)| ((high * wide) as f32, row * finer[0] + column))
        });
        for (part, (weight, k)) in parts.iter_mut().zip(covered) {
            let texel = texel(k);
            *part = (weight, texel.slopes);
            all += weight;
            mean.plain = [0, 1, 2].map(|k| mean.plain[k] + weight * texel.plain[k]);
        }
        mean.slopes = Spread::mixed(&parts);
        mean.plain = mean.plain.map(|sum| sum / all);
        mean
    };
    (0..size[0] * size[1]).into_par_iter().map(mean).collect()
}

/// Returns the texels of `finer` that the texel `k` of `coarser` covers, at most three, and the
/// covered part of each in units of `1/coarser`.
fn overlaps(k: usize, coarser: usize, finer: usize) -> impl Iterator<Item = (usize, usize)> + Clone {
    let (start, end) = (k * finer, (k + 1) * finer);
    let overlap = move |i: usize| end.min((i + 1) * coarser) - start.max(i * coarser);
    (start / coarser..end.div_ceil(coarser)).map(move |i| (i, overlap(i)))
}
