//! The plan of a bake: sizes, source, and the key that identifies its tiles in later runs.

use serde_json::{Value, json};

use crate::bake::maps::Plane;
use crate::bake::source::{Row, Source};
use crate::failure::Result;
use crate::output::sha256;

/// Minimum side of a tile in texels.
pub(crate) const LEAST_TILE: u32 = 64;

/// Maximum texels along the side of all parts: a position in `f32` then has a resolution of a
/// sixteenth of a texel.
pub(crate) const MOST_TEXELS: u32 = 1 << 20;

/// Version of the tile file format.
const FORMAT: u32 = 1;

/// Position of a part within a texture that is split into parts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Part {
    /// Parts along a side of the texture; 1 for a whole texture.
    pub(crate) of: u32,
    /// Column and row, from the upper left.
    pub(crate) at: [u32; 2],
}

impl Part {
    /// Returns the part of a number, counted from 1 row by row.
    pub(crate) const fn numbered(number: u32, of: u32) -> Self {
        Self { of, at: [(number - 1) % of, (number - 1) / of] }
    }

    /// Returns the folder name: `u1_v1` is the lower left part.
    pub(crate) fn folder(self) -> Option<String> {
        let [column, row] = self.at;
        (self.of > 1).then(|| format!("u{}_v{}", column + 1, self.of - row))
    }
}

/// Everything that determines the texels.
pub(crate) struct Plan {
    pub(crate) source: Box<dyn Source>,
    pub(crate) part: Part,
    /// Texels along a side of the part.
    pub(crate) size: u32,
    /// Texels along the side of a tile.
    pub(crate) tile: u32,
    /// Samples along the side of a texel.
    pub(crate) samples: u32,
    /// Maximum distance of horizon samples, in texels.
    pub(crate) reach: u32,
    /// Whether the texture is periodic.
    pub(crate) tileable: bool,
}

impl Plan {
    /// Tiles along a side.
    pub(crate) const fn tiles(&self) -> u32 {
        self.size / self.tile
    }

    /// The level at which a tile is one texel.
    pub(crate) const fn top(&self) -> u32 {
        self.tile.ilog2()
    }

    /// The planes stored in the tiles.
    pub(crate) fn planes(&self) -> impl Iterator<Item = Plane> + use<> {
        let varies = self.source.varies();
        Plane::ALL.into_iter().filter(move |plane| plane.differs(varies))
    }

    /// Texels along the side of all parts.
    pub(crate) const fn whole(&self) -> u32 {
        self.size * self.part.of
    }

    /// The part's first column and row among the texels of all parts.
    pub(crate) fn origin(&self) -> [i64; 2] {
        self.part.at.map(|k| i64::from(k) * i64::from(self.size))
    }

    /// A row of texels from a column on, in coordinates of the part.
    pub(crate) fn row(&self, row: i64, column: i64) -> Row {
        let [first_column, first_row] = self.origin();
        let (row, column) = (first_row + row, first_column + column);
        Row { size: self.whole(), samples: self.samples, row, column }
    }

    /// The range of heights shared by all parts, for a texture that is split.
    pub(crate) fn shared_range(&self) -> Option<[f32; 2]> {
        self.source.range().filter(|_| self.part.of > 1)
    }

    /// Returns the first and the last requested tile, counted from 1, or all tiles by default.
    pub(crate) fn some(&self, wanted: Option<[u32; 2]>) -> Result<[u32; 2]> {
        let all = self.tiles() * self.tiles();
        match wanted {
            Some([_, last]) if last > all => {
                Err(format!("tile {last} is out of range (expected 1 to {all})").into())
            }
            wanted => Ok(wanted.unwrap_or([1, all])),
        }
    }

    /// Describes everything that determines the texels, independent of tiling.
    pub(crate) fn describe(&self) -> Value {
        let mut all = json!({
            "source": self.source.describe(),
            "size": self.size,
            "samples_per_texel": self.samples * self.samples,
            "occlusion_reach_in_texels": self.reach,
            "tileable": self.tileable,
        });
        if self.part.of > 1 {
            let [column, row] = self.part.at;
            all["part"] = json!({ "column": column, "row": row, "along_a_side": self.part.of });
        }
        all
    }

    /// Returns a key unique to the plan and the build of the program.
    pub(crate) fn key(&self, program: &[u8]) -> String {
        let all = json!({ "plan": self.describe(), "tile": self.tile, "format": FORMAT, "program": sha256(program) });
        sha256(all.to_string().as_bytes())[..16].into()
    }

    /// Returns the maximum difference between opposite edges, of values (heights, colors and
    /// others) and of slopes. Each edge is sampled at one point per texel, up to 4096 points.
    pub(crate) fn seam(&self) -> [f32; 2] {
        let points = self.whole().min(4096);
        let (mut value, mut slope) = (0.0_f32, 0.0_f32);
        for k in 0..points {
            let t = (f64::from(k) + 0.5) / f64::from(points);
            for ends in [[[0.0, t], [1.0, t]], [[t, 0.0], [t, 1.0]]] {
                let [a, b] = ends.map(|end| self.source.point(end));
                let color = (a.color - b.color).abs().max_element();
                let others = [a.height - b.height, a.alpha2 - b.alpha2, a.metallic - b.metallic];
                value = others.into_iter().map(f32::abs).fold(value.max(color), f32::max);
                slope = slope.max((a.slopes.mean - b.slopes.mean).abs().max_element());
            }
        }
        [value, slope]
    }

    /// Returns an error for parts that would not fit together, and for a tileable square whose
    /// opposite edges differ.
    pub(crate) fn checked(self) -> Result<Self> {
        if self.part.of > 1 && self.source.varies().height && self.source.range().is_none() {
            return Err(
                "`--parts`: not supported for this surface, because its height range is not known in advance"
                    .into(),
            );
        }
        if self.tileable {
            let seam = self.seam();
            if seam != [0.0; 2] {
                let ([value, slope], why) = (seam, self.source.why_not());
                return Err(format!(
                    "`--tileable`: opposite edges differ by {value} in value and {slope} in slope ({why})"
                )
                .into());
            }
        }
        Ok(self)
    }
}
