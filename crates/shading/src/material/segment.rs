//! Short oriented segments in the cells of a plane, drawn by hashes: what scratches and fibres lie along.

use asperity_noise::{IntegerHash, Lattice};
use glam::{Vec2, Vec3};

use crate::math::{cos, floor, sin};

/// A number in [0, 1) of 24 bits of a hash.
pub(crate) fn unit(word: u32) -> f32 {
    (word >> 8) as f32 / 16_777_216.0
}

/// The most segments that begin in a cell.
pub(crate) const MOST: u32 = 8;

/// Segments with their midpoints anywhere in square cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Segments {
    /// The side of a cell.
    pub(crate) cell: f32,
    /// The length of a segment, at most the side of a cell.
    pub(crate) length: f32,
    /// The mean number of segments of a cell, at most [`MOST`].
    pub(crate) cover: f32,
    /// The unit direction that they are spread about.
    pub(crate) direction: Vec2,
    /// Spread of directions: 1 is a quarter of a turn to either side, all directions.
    pub(crate) spread: f32,
    pub(crate) seed: u32,
}

/// A segment near a point.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Near {
    /// Place of the point along it, −1 and 1 at its ends.
    pub(crate) along: f32,
    /// The distance to its left.
    pub(crate) across: f32,
    /// Its unit direction.
    pub(crate) direction: Vec2,
    /// Two random numbers in [0, 1) of its own.
    pub(crate) random: [f32; 2],
}

impl Segments {
    /// Visits every segment whose midpoint is within a cell's side of the point; none where cells cannot be told apart.
    pub(crate) fn visit(&self, at: Vec2, mut f: impl FnMut(Near)) {
        const FARTHEST: f32 = 8_388_608.0;
        let place = at / self.cell;
        if place.is_nan() || place.abs().max_element() >= FARTHEST {
            return;
        }
        let base = Vec2::new(floor(place.x), floor(place.y));
        for i in 0..9_u8 {
            let corner = base + Vec2::new(f32::from(i % 3) - 1.0, f32::from(i / 3) - 1.0);
            let [x, y] = [corner.x as i32, corner.y as i32];
            for k in 0..MOST {
                let word = |j: u32| IntegerHash.word([x, y, (3 * k + j) as i32], self.seed);
                // Segment k is there with probability clamp(cover − k, 0, 1).
                let left = self.cover - k as f32;
                if left <= 0.0 {
                    break;
                }
                if left < 1.0 && unit(word(0)) >= left {
                    continue;
                }
                let middle = word(1);
                let midpoint = corner + Vec2::new((middle >> 16) as f32, (middle & 0xffff) as f32) / 65_536.0;
                let from = place - midpoint;
                if from.length_squared() > 1.0 {
                    continue;
                }
                let own = word(2);
                let field =
                    |shift: u32, bits: u32| ((own >> shift) & ((1 << bits) - 1)) as f32 / (1 << bits) as f32;
                let turn = (2.0 * field(20, 12) - 1.0) * self.spread * core::f32::consts::FRAC_PI_2;
                let direction = Vec2::new(cos(turn), sin(turn)).rotate(self.direction);
                let from = from * self.cell;
                f(Near {
                    along: from.dot(direction) / (0.5 * self.length),
                    across: direction.perp_dot(from),
                    direction,
                    random: [field(10, 10), field(0, 10)],
                });
            }
        }
    }

    /// The mean squares of the unit direction across a segment: along x, along both, along y.
    pub(crate) fn mean_square_across(&self) -> Vec3 {
        // Of an even spread over ±turn, E cos 2φ = sin(2 turn)/(2 turn).
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
