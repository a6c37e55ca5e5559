//! One tile: its texels, their ambient occlusion, and all levels up to one texel.

use std::sync::atomic::AtomicBool;

use rayon::prelude::*;

use crate::bake::occlusion::{Places, Surroundings};
use crate::bake::plan::Plan;
use crate::bake::texel::{Texel, halved};
use crate::failure::{Interrupted, Result};

/// A finished tile in file layout: planes of all levels, range of heights, top texel.
pub(super) struct Tile {
    pub(super) bytes: Vec<u8>,
}

/// Bytes after the planes: the range of heights, and the top texel.
pub(super) const TAIL: usize = 8 + crate::bake::texel::BYTES;

/// Returns the offset of a plane's level within a tile's file. For a level past the last, the end
/// of all planes.
pub(super) fn offset(plan: &Plan, plane: usize, level: u32) -> usize {
    let texels = |level: u32| (plan.tile as usize >> level).pow(2);
    let level_bytes = |level| plan.planes().map(super::maps::Plane::bytes).sum::<usize>() * texels(level);
    let before: usize = (0..level).map(level_bytes).sum();
    before + plan.planes().take(plane).map(|plane| plane.bytes() * texels(level)).sum::<usize>()
}

/// Returns the length of a tile's file.
pub(super) fn length(plan: &Plan) -> usize {
    offset(plan, 0, plan.top() + 1) + TAIL
}

impl Tile {
    /// Bakes the tile of a column and a row.
    pub(super) fn baked(plan: &Plan, [column, row]: [u32; 2], interrupted: &AtomicBool) -> Result<Self> {
        let side = plan.tile as usize;
        let [first_column, first_row] = [column, row].map(|k| i64::from(k * plan.tile));
        let mut texels = vec![Texel::default(); side * side];
        texels.par_chunks_mut(side).enumerate().try_for_each(|(k, texels)| {
            plan.source.texels(&plan.row(first_row + k as i64, first_column), texels);
            Interrupted::check(interrupted)
        })?;
        let shades = plan.source.varies().height && plan.reach > 0;
        let around = shades.then(|| surroundings(plan, [first_column, first_row]));
        let places = around.as_ref().map(Places::new);
        texels.par_chunks_mut(side).enumerate().try_for_each(|(row, texels)| {
            for (column, texel) in texels.iter_mut().enumerate() {
                let normal = plan.source.shown(texel).0;
                let lit = around.as_ref().zip(places.as_ref());
                texel.occlusion =
                    lit.map_or(1.0, |(around, places)| places.occlusion(around, [column, row], normal));
            }
            Interrupted::check(interrupted)
        })?;
        drop(around);
        let range = texels.iter().fold([f32::INFINITY, f32::NEG_INFINITY], |[low, high], texel| {
            [low.min(texel.height), high.max(texel.height)]
        });
        let mut bytes = Vec::with_capacity(length(plan));
        let mut side = side;
        loop {
            for plane in plan.planes() {
                let written = |row: &[Texel]| {
                    let mut bytes = Vec::with_capacity(row.len() * plane.bytes());
                    row.iter().for_each(|texel| plane.write(plan.source.as_ref(), texel, &mut bytes));
                    bytes
                };
                let rows: Vec<_> = texels.par_chunks(side).map(written).collect();
                rows.iter().for_each(|row| bytes.extend_from_slice(row));
            }
            if side == 1 {
                break;
            }
            texels = halved(&texels, side);
            side /= 2;
        }
        range.iter().for_each(|x| bytes.extend_from_slice(&x.to_le_bytes()));
        bytes.extend_from_slice(&texels.first().copied().unwrap_or_default().to_bytes());
        Ok(Self { bytes })
    }
}

/// Returns the heights of the tile and of everything within reach of its horizons.
pub(super) fn surroundings(plan: &Plan, [column, row]: [i64; 2]) -> Surroundings {
    let (margin, whole, origin) = (plan.reach as usize, i64::from(plan.whole()), plan.origin());
    let side = plan.tile as usize + 2 * margin;
    let mut heights = vec![0.0; side * side];
    heights.par_chunks_mut(side).enumerate().for_each(|(k, heights)| {
        let (row, first) = (row + k as i64 - margin as i64, column - margin as i64);
        if !plan.tileable {
            return plan.source.heights(&plan.row(row, first), heights);
        }
        // In pieces inside the square, where every number equals the number of the texel itself.
        let mut done = 0;
        while done < heights.len() {
            let [column, row] = [(first + done as i64, origin[0]), (row, origin[1])]
                .map(|(at, origin)| (at + origin).rem_euclid(whole) - origin);
            let count = (heights.len() - done).min((whole - origin[0] - column) as usize);
            plan.source.heights(&plan.row(row, column), &mut heights[done..done + count]);
            done += count;
        }
    });
    Surroundings { heights, side, margin, texel: 1.0 / plan.whole() as f32 }
}
