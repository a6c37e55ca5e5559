//! A set: its maps with all levels, assembled from tiles.

use std::sync::atomic::AtomicBool;

use indicatif::ProgressBar;

use crate::bake::formats::{ending, has_levels};
use crate::bake::maps::Map;
use crate::bake::plan::Plan;
use crate::bake::scratch::Levels;
use crate::cli::bake::BakedFormat as Format;
use crate::failure::{Interrupted, Result};

/// Side of a uniform map: the side of a compressed block.
const UNIFORM: usize = 4;

/// The data from which all files are written.
pub(super) struct Set<'a> {
    pub(super) plan: &'a Plan,
    pub(super) levels: &'a Levels<'a>,
    pub(super) formats: &'a [Format],
    pub(super) interrupted: &'a AtomicBool,
    pub(super) bar: &'a ProgressBar,
}

impl Set<'_> {
    /// Returns the maps of the set, including height maps if the surface has heights.
    pub(super) fn maps(&self) -> Vec<MapLevels<'_>> {
        let all = Map::ALL.into_iter().map(|map| MapLevels { map, set: self });
        all.filter(|map| map.map != Map::Height || self.plan.source.varies().height).collect()
    }
}

/// A map of the set with its levels.
pub(super) struct MapLevels<'a> {
    pub(super) map: Map,
    pub(super) set: &'a Set<'a>,
}

impl MapLevels<'_> {
    /// Returns the name of its file in a format.
    pub(super) fn file(&self, format: Format) -> String {
        format!("{}.{}", self.map.name(), ending(format))
    }

    /// Whether the map varies between texels.
    pub(super) fn differs(&self) -> bool {
        self.map.planes().iter().any(|plane| plane.differs(self.set.plan.source.varies()))
    }

    /// Texels along the side of a level.
    pub(super) fn side(&self, level: u32) -> usize {
        if self.differs() { self.set.levels.side(level) } else { UNIFORM >> level }
    }

    /// The level with a single texel.
    pub(super) fn last(&self) -> u32 {
        self.side(0).ilog2()
    }

    /// Texels in a file, for progress.
    pub(super) fn texels_of(&self, format: Format) -> u64 {
        let levels = if has_levels(format) { self.last() } else { 0 };
        (0..=levels).map(|level| self.side(level).pow(2) as u64).sum()
    }

    /// Returns rows of a level, with 16 bits per channel.
    pub(super) fn rows(&self, level: u32, first: usize, rows: usize) -> Result<Vec<u16>> {
        let planes = self.planes(level, first, rows)?;
        let planes: Vec<&[u8]> = planes.iter().map(Vec::as_slice).collect();
        let mut texels = Vec::with_capacity(rows * self.side(level) * self.map.channels());
        self.map.texels(&planes, self.set.levels.tops.range, &mut texels);
        Ok(texels)
    }

    /// Returns rows of the map's planes as scratch bytes.
    pub(super) fn planes(&self, level: u32, first: usize, rows: usize) -> Result<Vec<Vec<u8>>> {
        Interrupted::check(self.set.interrupted)?;
        let (side, source) = (self.side(level), self.set.plan.source.as_ref());
        self.set.bar.inc((rows * side) as u64);
        let plane = |&plane: &crate::bake::maps::Plane| {
            if plane.differs(source.varies()) {
                return self.set.levels.band(plane, level, first, rows);
            }
            let (mut bytes, whole) = (Vec::new(), self.set.levels.tops.whole());
            (0..rows * side).for_each(|_| plane.write(source, &whole, &mut bytes));
            Ok(bytes)
        };
        self.map.planes().iter().map(plane).collect()
    }

    /// Returns the texel of a uniform map.
    pub(super) fn uniform(&self) -> Result<Vec<u16>> {
        self.rows(self.last(), 0, 1)
    }
}
