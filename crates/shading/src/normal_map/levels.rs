//! Levels of a map, each half as wide as the previous one, with the lobes of every texel.

use glam::Vec2;

use crate::normal_map::slope_lobes::SlopeLobes;

/// The size of a level; the last is 1 × 1.
pub(super) const fn level_size(width: usize, height: usize, level: u32) -> [usize; 2] {
    let [w, h] = [width >> level, height >> level];
    [if w > 1 { w } else { 1 }, if h > 1 { h } else { 1 }]
}

/// The last level, of one texel.
pub(super) const fn last_level(width: usize, height: usize) -> u32 {
    let longer = if width > height { width } else { height };
    longer.ilog2()
}

/// Index of the first lobe of a level among those of all levels.
pub(super) const fn level_start(width: usize, height: usize, level: u32) -> usize {
    let (mut start, mut k) = (0, 0);
    while k < level {
        let [w, h] = level_size(width, height, k);
        start += w * h;
        k += 1;
    }
    start
}

/// Fills all levels.
pub(super) fn fill<const K: usize>(
    [width, height]: [usize; 2],
    slopes: &[Vec2],
    centers: &[Vec2; K],
    lobes: &mut [SlopeLobes<K>],
) {
    for (k, texel) in lobes.iter_mut().take(width * height).enumerate() {
        *texel = over_texel([width, height], slopes, centers, [k % width, k / width]);
    }
    for level in 0..last_level(width, height) {
        let [above, below] = [level, level + 1].map(|level| level_size(width, height, level));
        let (done, rest) = lobes.split_at_mut(level_start(width, height, level + 1).min(lobes.len()));
        let finer = done.get(level_start(width, height, level)..).unwrap_or_default();
        for (k, texel) in rest.iter_mut().take(below[0] * below[1]).enumerate() {
            let rows = overlaps(k / below[0], below[1], above[1]);
            *texel = SlopeLobes::mixed(rows.flat_map(|(row, high)| {
                overlaps(k % below[0], below[0], above[0]).map(move |(column, wide)| {
                    let part = finer.get(row * above[0] + column).copied().unwrap_or_default();
                    ((high * wide) as f32, part)
                })
            }));
        }
    }
}

/// The `finer` texels covered by the texel `k` of `coarser`, and the covered part of each.
///
/// The unit is `1/coarser`.
fn overlaps(k: usize, coarser: usize, finer: usize) -> impl Iterator<Item = (usize, usize)> + Clone {
    let (start, end) = (k * finer, (k + 1) * finer);
    let overlap = move |i: usize| (end.min((i + 1) * coarser)) - start.max(i * coarser);
    (start / coarser..end.div_ceil(coarser)).map(move |i| (i, overlap(i)))
}

/// The lobes of the bilinear field over the square of a texel.
///
/// By the 2 × 2 Gauss rule in each quarter, between four centers: exact for moments, which are
/// quadratic there.
fn over_texel<const K: usize>(
    [width, height]: [usize; 2],
    slopes: &[Vec2],
    centers: &[Vec2; K],
    [column, row]: [usize; 2],
) -> SlopeLobes<K> {
    // ¼ ± 1/(4√3), on both sides of the center.
    const PLACES: [f32; 4] = [-0.394_337_57, -0.105_662_43, 0.105_662_43, 0.394_337_57];
    let at = |i: usize, j: usize| {
        let [i, j] = [(column + width + i - 1) % width, (row + height + j - 1) % height];
        slopes.get(j * width + i).copied().unwrap_or_default()
    };
    let middle = at(1, 1);
    SlopeLobes::mixed(PLACES.into_iter().flat_map(|y| PLACES.map(|x| (x, y))).map(|(x, y)| {
        let [i, j] = [x, y].map(|t| if t < 0.0 { 0 } else { 2 });
        let (x, y) = (x.abs(), y.abs());
        let slope = middle.lerp(at(i, 1), x).lerp(at(1, j).lerp(at(i, j), x), y);
        (1.0, SlopeLobes::point(slope, centers))
    }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::normal_map::{SlopePyramid, slope_moments::SlopeMoments};
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn texels_have_the_moments_of_the_bilinear_field() {
        const SIZE: [usize; 2] = [5, 4];
        let values: [Vec2; 20] =
            core::array::from_fn(|k| Vec2::new((k * 7 % 20) as f32, (k * 13 % 9) as f32) * 0.1);
        let map = SlopePyramid { size: SIZE, slopes: &values[..], centers: [Vec2::ZERO], lobes: &[][..] };
        for k in 0..20 {
            let got = over_texel(SIZE, &values, &[Vec2::ZERO], [k % 5, k / 5]).moments();
            let points = (0..4096).map(|i| {
                let place = Vec2::new((i % 64) as f32 + 0.5, (i / 64) as f32 + 0.5) / 64.0;
                let uv = (Vec2::new((k % 5) as f32, (k / 5) as f32) + place) / Vec2::new(5.0, 4.0);
                (1.0, SlopeMoments::point(map.slope(uv)))
            });
            let expected = SlopeMoments::mixed(points);
            assert_abs_diff_eq!(got.mean, expected.mean, epsilon = 1e-4, "{k}");
            for (got, expected) in got.covariance.into_iter().zip(expected.covariance) {
                assert_abs_diff_eq!(got, expected, epsilon = 3e-4, "{k}");
            }
        }
    }

    #[test]
    fn every_level_has_the_moments_of_the_map() {
        for (width, height) in [(16, 16), (7, 5), (1, 9), (24, 3), (1, 1)] {
            let mut values = [Vec2::ZERO; 256];
            for (k, value) in values.iter_mut().enumerate() {
                *value = Vec2::new((k * 37 % 101) as f32, (k * 53 % 89) as f32) * 0.01;
            }
            let values = &values[..width * height];
            let last = last_level(width, height);
            let mut lobes = [SlopeLobes::default(); 512];
            let lobes = &mut lobes[..level_start(width, height, last + 1)];
            let centers = [Vec2::ZERO, Vec2::new(0.7, 0.3), Vec2::new(0.2, 0.8)];
            fill([width, height], values, &centers, lobes);
            let whole = |level| {
                let [w, h] = level_size(width, height, level);
                let start = level_start(width, height, level);
                SlopeMoments::mixed(lobes[start..start + w * h].iter().map(|texel| (1.0, texel.moments())))
            };
            let all = whole(0);
            for level in 1..=last {
                let got = whole(level);
                assert_abs_diff_eq!(got.mean, all.mean, epsilon = 1e-5, "{width} × {height}, {level}");
                for (got, all) in got.covariance.into_iter().zip(all.covariance) {
                    assert_abs_diff_eq!(got, all, epsilon = 1e-5, "{width} × {height}, {level}");
                }
            }
        }
    }
}
