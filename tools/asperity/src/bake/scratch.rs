//! Tiles on disk. Each is written atomically, so that an interrupted bake can resume.

use std::fs::{self, File};
use std::io::{Read, Seek, SeekFrom};
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;

use crate::bake::maps::Plane;
use crate::bake::plan::Plan;
use crate::bake::texel::{self, Texel, halved};
use crate::bake::tile::{self, Tile};
use crate::failure::Result;
use crate::output::{Output, Shared};

/// Rows of texels per call; a multiple of the 4 rows of a compressed block.
pub(super) const BAND: usize = 64;

/// The folder of a bake's tiles.
pub(super) struct Scratch<'a> {
    plan: &'a Plan,
    output: Output,
    folder: PathBuf,
    /// A shared lock: other runs may read and write the same tiles.
    held: Shared,
}

impl<'a> Scratch<'a> {
    /// Creates the folder of the plan's tiles, inside the folder of the set.
    pub(super) fn new(plan: &'a Plan, output: &Output, program: &[u8]) -> Result<Self> {
        let name = format!(".tiles-{}", plan.key(program));
        let held = Shared::new(output, &format!("{name}.lock"))?;
        Ok(Self { plan, output: output.inside(&name)?, folder: output.path(&name), held })
    }

    fn name([column, row]: [u32; 2]) -> String {
        format!("{column}-{row}.tile")
    }

    /// Returns a line that lists tiles of other bakes in the folder of the set. This plan does not
    /// use them.
    pub(super) fn others(&self, output: &Output) -> Option<String> {
        let folders = fs::read_dir(output.path("")).ok()?.filter_map(Result::ok);
        let others: Vec<_> = folders
            .map(|entry| entry.path())
            .filter(|path| path.is_dir() && *path != self.folder)
            .filter(|path| path.file_name().is_some_and(|name| name.to_string_lossy().starts_with(".tiles-")))
            .collect();
        let first = others.first()?;
        let bytes = |folder: &PathBuf| -> u64 {
            let files = fs::read_dir(folder).into_iter().flatten().filter_map(Result::ok);
            files.filter_map(|file| file.metadata().ok()).map(|file| file.len()).sum()
        };
        let megabytes = others.iter().map(bytes).sum::<u64>() as f64 / 1e6;
        let more = if others.len() > 1 { format!(" and {} more", others.len() - 1) } else { String::new() };
        Some(format!(
            "found {megabytes:.1} MB of unfinished tiles from other bakes (delete them if unneeded): {}{more}",
            first.display()
        ))
    }

    /// Whether a complete tile exists.
    fn has(&self, at: [u32; 2]) -> bool {
        let found = fs::metadata(self.folder.join(Self::name(at)));
        found.is_ok_and(|found| found.len() == tile::length(self.plan) as u64)
    }

    /// Returns the missing tiles of a range, counted from 1 row by row.
    pub(super) fn missing(&self, [first, last]: [u32; 2]) -> Vec<[u32; 2]> {
        let tiles = self.plan.tiles();
        let all = (first - 1..last).map(|k| [k % tiles, k / tiles]);
        all.filter(|&at| !self.has(at)).collect()
    }

    /// Bakes a tile and writes it.
    pub(super) fn bake(&self, at: [u32; 2], interrupted: &AtomicBool) -> Result<()> {
        let Tile { bytes } = Tile::baked(self.plan, at, interrupted)?;
        Ok(self.output.write(&Self::name(at), &bytes)?)
    }

    /// Removes the tiles unless another run uses them.
    pub(super) fn remove(self) {
        self.held.release(|| {
            let _ = fs::remove_dir_all(self.folder);
        });
    }

    fn read(&self, at: [u32; 2], offset: usize, bytes: &mut [u8]) -> Result<()> {
        let path = self.folder.join(Self::name(at));
        let mut read = || -> std::io::Result<()> {
            let mut file = File::open(&path)?;
            file.seek(SeekFrom::Start(offset as u64))?;
            file.read_exact(bytes)
        };
        read().map_err(|cause| format!("cannot read {}: {cause}", path.display()).into())
    }

    /// Reads the tails of all tiles: the range of heights, and the top texel of each tile.
    pub(super) fn tops(&self) -> Result<Tops> {
        let tiles = self.plan.tiles();
        let (mut range, mut texels) = ([f32::INFINITY, f32::NEG_INFINITY], Vec::new());
        for k in 0..tiles * tiles {
            let mut tail = [0; tile::TAIL];
            self.read([k % tiles, k / tiles], tile::length(self.plan) - tile::TAIL, &mut tail)?;
            let number = |k: usize| f32::from_le_bytes([tail[k], tail[k + 1], tail[k + 2], tail[k + 3]]);
            range = [range[0].min(number(0)), range[1].max(number(4))];
            let mut bytes = [0; texel::BYTES];
            bytes.copy_from_slice(&tail[8..]);
            texels.push(Texel::from_bytes(&bytes));
        }
        let mut levels = vec![texels];
        let mut side = tiles as usize;
        while side > 1 {
            levels.extend(levels.last().map(|finest| halved(finest, side)));
            side /= 2;
        }
        Ok(Tops { range: self.plan.shared_range().unwrap_or(range), levels })
    }
}

/// Levels above the tiles.
pub(super) struct Tops {
    /// The lowest and the highest point of the surface. Parts share a common range.
    pub(super) range: [f32; 2],
    /// From the level with one texel per tile to the level with a single texel.
    levels: Vec<Vec<Texel>>,
}

impl Tops {
    /// The mean of all texels.
    pub(super) fn whole(&self) -> Texel {
        self.levels.last().and_then(|level| level.first()).copied().unwrap_or_default()
    }
}

/// Rows of every level, assembled from tiles.
pub(super) struct Levels<'a> {
    pub(super) scratch: &'a Scratch<'a>,
    pub(super) tops: &'a Tops,
}

impl Levels<'_> {
    /// Texels along the side of a level.
    pub(super) const fn side(&self, level: u32) -> usize {
        (self.scratch.plan.size >> level) as usize
    }

    /// Returns rows of a varying plane, starting at `first`.
    pub(super) fn band(&self, plane: Plane, level: u32, first: usize, rows: usize) -> Result<Vec<u8>> {
        let (plan, side) = (self.scratch.plan, self.side(level));
        let width = plane.bytes();
        let position = plan.planes().position(|other| other == plane).unwrap_or_default();
        if level > plan.top() {
            let mut bytes = Vec::with_capacity(rows * side * width);
            let texels = &self.tops.levels[(level - plan.top()) as usize];
            texels[first * side..(first + rows) * side]
                .iter()
                .for_each(|texel| plane.write(plan.source.as_ref(), texel, &mut bytes));
            return Ok(bytes);
        }
        let tile_side = plan.tile as usize >> level;
        let mut bytes = vec![0; rows * side * width];
        // A band of a level may span several rows of tiles.
        let mut row = first;
        while row < first + rows {
            let (tile_row, within) = (row / tile_side, row % tile_side);
            let count = (tile_side - within).min(first + rows - row);
            let mut part = vec![0; count * tile_side * width];
            for column in 0..plan.tiles() {
                let offset = tile::offset(plan, position, level) + within * tile_side * width;
                self.scratch.read([column, tile_row as u32], offset, &mut part)?;
                for (k, line) in part.chunks_exact(tile_side * width).enumerate() {
                    let place = ((row - first + k) * side + column as usize * tile_side) * width;
                    bytes[place..place + line.len()].copy_from_slice(line);
                }
            }
            row += count;
        }
        Ok(bytes)
    }
}
