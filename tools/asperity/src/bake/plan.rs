//! The plan of a bake: sizes and the source, and the name by which a later run knows its tiles.

use serde_json::{Value, json};

use crate::bake::maps::Plane;
use crate::bake::source::{Row, Source};
use asperity::failure::Result;
use asperity::output::sha256;

/// The least side of a tile in texels.
pub(crate) const LEAST_TILE: u32 = 64;

/// Texels along the side of all parts, at most: a place in `f32` is then a sixteenth of a texel.
pub(crate) const MOST_TEXELS: u32 = 1 << 20;

/// Format of the tiles' files; another number for another one.
const FORMAT: u32 = 1;

/// Which of the parts that a texture is cut into.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Part {
    /// Parts along a side of the texture; 1 of one that is whole.
    pub(crate) of: u32,
    /// Column and row, from the upper left.
    pub(crate) at: [u32; 2],
}

impl Part {
    /// The part of a number, counted from 1 row by row.
    pub(crate) const fn numbered(number: u32, of: u32) -> Self {
        Self { of, at: [(number - 1) % of, (number - 1) / of] }
    }

    /// The name of its folder: `u1_v1` is the one at the lower left.
    pub(crate) fn folder(self) -> Option<String> {
        let [column, row] = self.at;
        (self.of > 1).then(|| format!("u{}_v{}", column + 1, self.of - row))
    }
}

/// All that the texels follow from.
pub(crate) struct Plan {
    pub(crate) source: Box<dyn Source>,
    pub(crate) part: Part,
    /// Texels along a side of the part.
    pub(crate) size: u32,
    /// Texels along the side of a tile.
    pub(crate) tile: u32,
    /// Samples along the side of a texel.
    pub(crate) samples: u32,
    /// The distance up to which horizons are looked for, in texels.
    pub(crate) reach: u32,
    /// Whether the texture continues on its other side.
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

    /// The planes that the tiles have.
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

    /// A row of texels from a column on, both of the part.
    pub(crate) fn row(&self, row: i64, column: i64) -> Row {
        let [first_column, first_row] = self.origin();
        let (row, column) = (first_row + row, first_column + column);
        Row { size: self.whole(), samples: self.samples, row, column }
    }

    /// The lowest and the highest point that all parts share, of one that is cut into them.
    pub(crate) fn shared_range(&self) -> Option<[f32; 2]> {
        self.source.range().filter(|_| self.part.of > 1)
    }

    /// The first and the last of the wanted tiles, counted from 1; all if none are named.
    pub(crate) fn some(&self, wanted: Option<[u32; 2]>) -> Result<[u32; 2]> {
        let all = self.tiles() * self.tiles();
        match wanted {
            Some([_, last]) if last > all => Err(format!("tile {last}: the last one is {all}").into()),
            wanted => Ok(wanted.unwrap_or([1, all])),
        }
    }

    /// Parameters of everything that the texels follow from, whatever the tiles.
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

    /// A name that the plan shares with no other, nor with another build of the program.
    pub(crate) fn key(&self, program: &[u8]) -> String {
        let all = json!({ "plan": self.describe(), "tile": self.tile, "format": FORMAT, "program": sha256(program) });
        sha256(all.to_string().as_bytes())[..16].into()
    }

    /// The greatest difference between opposite edges, at as many points as an edge has texels, up to 4096: of heights, colours and
    /// other values, and of slopes.
    pub(crate) fn seam(&self) -> [f32; 2] {
        let points = self.whole().min(4096);
        let (mut value, mut slope) = (0.0_f32, 0.0_f32);
        for k in 0..points {
            let t = (f64::from(k) + 0.5) / f64::from(points);
            for ends in [[[0.0, t], [1.0, t]], [[t, 0.0], [t, 1.0]]] {
                let [a, b] = ends.map(|end| self.source.point(end));
                let colour = (a.colour - b.colour).abs().max_element();
                let others = [a.height - b.height, a.alpha2 - b.alpha2, a.metallic - b.metallic];
                value = others.into_iter().map(f32::abs).fold(value.max(colour), f32::max);
                slope = slope.max((a.slopes.mean - b.slopes.mean).abs().max_element());
            }
        }
        [value, slope]
    }

    /// Refuses parts that would not fit together, and a square that does not continue on its other side.
    pub(crate) fn checked(self) -> Result<Self> {
        if self.part.of > 1 && self.source.varies().height && self.source.range().is_none() {
            return Err("`--parts`: the lowest and the highest point of all parts are not known beforehand of this surface".into());
        }
        if self.tileable {
            let seam = self.seam();
            if seam != [0.0; 2] {
                let ([value, slope], why) = (seam, self.source.why_not());
                return Err(format!(
                    "`--tileable`: opposite edges differ by {value} in value, {slope} in slope: {why}"
                )
                .into());
            }
        }
        Ok(self)
    }
}
