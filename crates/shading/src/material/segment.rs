//! Short oriented segments in the cells of a plane, drawn by hashes: the lines of scratches and
//! fibers.

use asperity_noise::{IntegerHash, Lattice};
use glam::{Vec2, Vec3, Vec4};

use crate::math::{floor, sin};

/// A number in [0, 1) of 24 bits of a hash.
pub(crate) fn unit(word: u32) -> f32 {
    (word >> 8) as f32 / 16_777_216.0
}

/// The maximum number of segments that begin in a cell.
pub(crate) const MOST: u32 = 8;

/// Segments of a cell that are hashed together.
const QUARTET: usize = 4;
/// Segments that are rotated together.
const BATCH: usize = 8;

/// Segments with nearby midpoints, with space for four more than a batch.
#[derive(Default)]
struct Batch {
    /// The point from the midpoint, in cells.
    x: [f32; BATCH + QUARTET],
    y: [f32; BATCH + QUARTET],
    /// Its cell, and its index in the cell.
    name: [[i32; 3]; BATCH + QUARTET],
    count: usize,
}

impl Batch {
    /// Adds a segment if it is present; otherwise the next one overwrites it.
    #[inline(always)]
    fn push(&mut self, [x, y]: [f32; 2], own: [i32; 3], there: bool) {
        if let (Some(to_x), Some(to_y), Some(name)) =
            (self.x.get_mut(self.count), self.y.get_mut(self.count), self.name.get_mut(self.count))
        {
            (*to_x, *to_y, *name) = (x, y, own);
            self.count += usize::from(there);
        }
    }

    /// Removes a whole batch.
    fn drop_first(&mut self) {
        self.x.copy_within(BATCH.., 0);
        self.y.copy_within(BATCH.., 0);
        self.name.copy_within(BATCH.., 0);
        self.count -= BATCH;
    }
}

/// `(cos t, sin t)` for |t| ≤ π/2 by their series to t¹² and t¹¹, accurate to 1e-7.
#[inline(always)]
fn cos_sin(t: Vec4) -> [Vec4; 2] {
    /// Ratio of each term to the previous one.
    const COS: [f32; 6] = [1.0 / 2.0, 1.0 / 12.0, 1.0 / 30.0, 1.0 / 56.0, 1.0 / 90.0, 1.0 / 132.0];
    const SIN: [f32; 5] = [1.0 / 6.0, 1.0 / 20.0, 1.0 / 42.0, 1.0 / 72.0, 1.0 / 110.0];
    let t2 = t * t;
    let cos = COS.iter().rev().fold(Vec4::ONE, |sum, &ratio| 1.0 - t2 * ratio * sum);
    let sin = SIN.iter().rev().fold(Vec4::ONE, |sum, &ratio| 1.0 - t2 * ratio * sum);
    [cos, t * sin]
}

/// Segments with their midpoints anywhere in square cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Segments {
    /// The side of a cell.
    pub cell: f32,
    /// The length of a segment, at most the side of a cell.
    pub length: f32,
    /// The mean number of segments of a cell, at most [`MOST`].
    pub cover: f32,
    /// The unit mean direction.
    pub direction: Vec2,
    /// Spread of directions: 1 is a quarter of a turn to either side, all directions.
    pub spread: f32,
    /// The seed of the lattice.
    pub seed: u32,
}

/// A segment near a point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Near {
    /// Position of the point along it, −1 and 1 at its ends.
    pub(crate) along: f32,
    /// The distance to its left.
    pub(crate) across: f32,
    /// Its unit direction.
    pub(crate) direction: Vec2,
    /// Two random numbers in [0, 1), specific to it.
    pub(crate) random: [f32; 2],
}

impl Segments {
    /// Visits the segments that may reach the point.
    ///
    /// The distance of their midpoint is at most half their length along, `aside` across, and less
    /// than the side of a cell. Visits none where cells cannot be distinguished.
    pub(crate) fn visit(&self, at: Vec2, aside: f32, mut f: impl FnMut(Near)) {
        const FARTHEST: f32 = 8_388_608.0;
        let place = at / self.cell;
        if place.is_nan() || place.abs().max_element() >= FARTHEST {
            return;
        }
        let base = Vec2::new(floor(place.x), floor(place.y));
        let [along, aside] = [0.5 * self.length, aside].map(|reach| reach / self.cell);
        // Slightly more, for rounding.
        let farthest = ((along * along + aside * aside) * 1.000_1).min(1.0);
        let within = place - base;
        let gaps = [within, Vec2::ZERO, Vec2::ONE - within];
        // If all are certain, presence is not tested.
        let certain = self.cover == floor(self.cover);
        let mut batch = Batch::default();
        for i in 0..9_u8 {
            let (column, row) = (i % 3, i / 3);
            let gap = Vec2::new(gaps[usize::from(column)].x, gaps[usize::from(row)].y);
            if gap.length_squared() > farthest {
                continue;
            }
            let corner = base + Vec2::new(f32::from(column) - 1.0, f32::from(row) - 1.0);
            let [x, y] = [corner.x as i32, corner.y as i32];
            let from = place - corner;
            for first in (0..MOST).step_by(QUARTET) {
                // Segment k is present with probability clamp(cover − k, 0, 1).
                let left = self.cover - first as f32;
                if left <= 0.0 {
                    break;
                }
                let words = |j: u32| -> [u32; QUARTET] {
                    core::array::from_fn(|k| {
                        IntegerHash.word([x, y, (3 * (first + k as u32) + j) as i32], self.seed)
                    })
                };
                let middles = words(1);
                let from_x =
                    from.x - Vec4::from(middles.map(|word| (word >> 16) as i32 as f32)) * (1.0 / 65_536.0);
                let from_y =
                    from.y - Vec4::from(middles.map(|word| (word & 0xffff) as i32 as f32)) * (1.0 / 65_536.0);
                let near = (from_x * from_x + from_y * from_y).cmple(Vec4::splat(farthest)).bitmask();
                let chances = if certain || left >= QUARTET as f32 { [0; QUARTET] } else { words(0) };
                let [from_x, from_y] = [from_x, from_y].map(|from| from.to_array());
                for k in 0..QUARTET {
                    let there = near >> k & 1 == 1 && unit(chances[k]) < left - k as f32;
                    batch.push([from_x[k], from_y[k]], [x, y, (first + k as u32) as i32], there);
                }
                if batch.count >= BATCH {
                    self.finish(&batch, BATCH, &mut f);
                    batch.drop_first();
                }
            }
        }
        self.finish(&batch, batch.count, &mut f);
    }

    /// Passes on the first segments of a batch.
    #[inline(always)]
    fn finish(&self, batch: &Batch, count: usize, f: &mut impl FnMut(Near)) {
        let turns = 2.0 * self.spread * core::f32::consts::FRAC_PI_2;
        let (to_along, d) = (self.cell / (0.5 * self.length), self.direction);
        for first in (0..count.min(BATCH)).step_by(QUARTET) {
            // Only for near segments: the hash of each.
            let own: [u32; QUARTET] = core::array::from_fn(|k| {
                let [x, y, name] = batch.name[first + k];
                IntegerHash.word([x, y, 3 * name + 2], self.seed)
            });
            let turn = (Vec4::from(own.map(|own| (own >> 20) as i32 as f32)) * (1.0 / 4096.0) - 0.5) * turns;
            let [cos, sin] = cos_sin(turn);
            let (x, y) = (d.x * cos - d.y * sin, d.y * cos + d.x * sin);
            let part = |from: &[f32; BATCH + QUARTET]| Vec4::from_slice(&from[first..first + QUARTET]);
            let (from_x, from_y) = (part(&batch.x), part(&batch.y));
            let along = ((from_x * x + from_y * y) * to_along).to_array();
            let across = ((x * from_y - y * from_x) * self.cell).to_array();
            let [x, y] = [x, y].map(|c| c.to_array());
            for k in 0..QUARTET.min(count - first) {
                let field = |shift: u32| (own[k] >> shift & 1023) as i32 as f32 / 1024.0;
                f(Near {
                    along: along[k],
                    across: across[k],
                    direction: Vec2::new(x[k], y[k]),
                    random: [field(10), field(0)],
                });
            }
        }
    }

    /// The mean squares of the unit direction across a segment: xx, xy, yy.
    pub(crate) fn mean_square_across(&self) -> Vec3 {
        // For a uniform spread over ±turn, E cos 2φ = sin(2 turn)/(2 turn).
        let turn = core::f32::consts::PI * self.spread;
        let lean = if turn > 1e-3 { sin(turn) / turn } else { 1.0 };
        let (d, across) = (self.direction, self.direction.perp());
        let of = |a: Vec2| Vec3::new(a.x * a.x, a.x * a.y, a.y * a.y);
        of(across) * (0.5 + 0.5 * lean) + of(d) * (0.5 - 0.5 * lean)
    }

    /// Number of segments per unit of area.
    pub(crate) fn density(&self) -> f32 {
        self.cover / (self.cell * self.cell)
    }
}
