//! The plan of a bake: sizes and the source, and the name by which a later run knows its tiles.

use serde_json::{Value, json};

use crate::bake::maps::Plane;
use crate::bake::source::{Row, Source};
use crate::failure::Result;
use crate::output::sha256;

/// The least side of a tile in texels.
pub(crate) const LEAST_TILE: u32 = 64;

/// Format of the tiles' files; another number for another one.
const FORMAT: u32 = 1;

/// All that the texels follow from.
pub(crate) struct Plan {
    pub(crate) source: Box<dyn Source>,
    /// Texels along a side.
    pub(crate) size: u32,
    /// Texels along the side of a tile.
    pub(crate) tile: u32,
    /// Samples along the side of a texel.
    pub(crate) samples: u32,
    /// The distance up to which horizons are looked for, in texels.
    pub(crate) reach: u32,
    /// Whether the square continues on its other side.
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

    /// A row of texels from a column on, on the square's other side where it continues there.
    pub(crate) const fn row(&self, row: i64, column: i64) -> Row {
        Row { size: self.size, samples: self.samples, row, column }
    }

    /// The first and the last of the wanted tiles, counted from 1; all if none are named.
    pub(crate) fn some(&self, wanted: Option<[u32; 2]>) -> Result<[u32; 2]> {
        let all = self.tiles() * self.tiles();
        match wanted {
            Some([_, last]) if last > all => Err(format!("tile {last}: there are {all} tiles").into()),
            wanted => Ok(wanted.unwrap_or([1, all])),
        }
    }

    /// Parameters of everything that the texels follow from, whatever the tiles.
    pub(crate) fn describe(&self) -> Value {
        json!({
            "source": self.source.describe(),
            "size": self.size,
            "samples_per_texel": self.samples * self.samples,
            "occlusion_reach_in_texels": self.reach,
            "tileable": self.tileable,
        })
    }

    /// A name that the plan shares with no other, nor with another build of the program.
    pub(crate) fn key(&self, program: &[u8]) -> String {
        let all = json!({ "plan": self.describe(), "tile": self.tile, "format": FORMAT, "program": sha256(program) });
        sha256(all.to_string().as_bytes())[..16].into()
    }

    /// The greatest difference between opposite edges, at as many points as an edge has texels, up to 4096: of heights, colours and
    /// other values, and of slopes.
    pub(crate) fn seam(&self) -> [f32; 2] {
        let points = self.size.min(4096);
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

    /// Refuses a square that does not continue on its other side.
    pub(crate) fn checked(self) -> Result<Self> {
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
