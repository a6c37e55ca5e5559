//! A material on a flat square, converted to the metallic–roughness model.

use asperity_render::scene::Surface;
use asperity_shading::material::MetallicRoughness;
use asperity_shading::{Footprint, SurfacePoint};
use glam::{Vec2, Vec3};
use serde_json::{Value, json};

use crate::bake::source::{Row, Source, Varies};
use crate::bake::texel::Texel;
use crate::failure::Result;

/// A material of `render` on a square with its side in meters.
pub(crate) struct Flat {
    name: String,
    parameters: Value,
    surface: Box<Surface<'static>>,
    side: f32,
    /// Bounds of the height in units of the side.
    range: Option<[f32; 2]>,
    varies: Varies,
    coat: Option<f32>,
}

/// Grid points per side for detecting which properties vary. The number shares no factor with
/// periods of patterns.
const GRID: usize = 61;

impl Flat {
    /// Builds the material on the square.
    pub(crate) fn new(
        name: String,
        parameters: Value,
        surface: Box<Surface<'static>>,
        side: f32,
    ) -> Result<Self> {
        let range = surface.height_range().map(|range| range.map(|height| height / side));
        let varies = Varies { color: true, metallic: true, height: range.is_some_and(|[a, b]| a < b) };
        let mut flat = Self { name, parameters, surface, side, range, varies, coat: None };
        let (mut colors, mut metals) = (Vec::new(), Vec::new());
        for k in 0..GRID * GRID {
            let at = [k % GRID, k / GRID].map(|i| (i as f64 + 0.381_966) / GRID as f64);
            let Some(seen) = flat.seen(at, 0.0) else {
                return Err(format!(
                    "`--material {}` is not supported: transmissive materials have no base color",
                    flat.name
                )
                .into());
            };
            colors.push(seen.base_color);
            metals.push(seen.metallic);
            flat.coat = seen.coat.or(flat.coat);
        }
        flat.varies.color = colors.iter().any(|color| *color != colors[0]);
        flat.varies.metallic = metals.iter().any(|metal| *metal != metals[0]);
        Ok(flat)
    }

    /// Returns a point of the square, with a sample of this side as its pixel.
    fn place(&self, at: [f64; 2], sample: f32) -> SurfacePoint {
        let place = Vec2::from(at.map(|x| (x * f64::from(self.side)) as f32));
        let pixel = Footprint::from_width(sample * self.side);
        SurfacePoint::new(place.extend(0.0), Vec3::Z, pixel).with_uv(place, [Vec3::X, Vec3::Y])
    }

    /// Returns the surface at a point, filtered to a sample of this side.
    fn seen(&self, at: [f64; 2], sample: f32) -> Option<MetallicRoughness> {
        // Seen from below: from above, facets steeper than 45° would be turned toward the viewer
        // and lose their slope.
        MetallicRoughness::of(&self.surface.bsdf(&self.place(at, sample), Vec3::NEG_Z))
    }

    /// Returns the height of a point in units of the side, filtered to a sample of this side.
    fn height(&self, at: [f64; 2], sample: f32) -> f32 {
        if self.varies.height { self.surface.height(&self.place(at, sample)) / self.side } else { 0.0 }
    }

    fn texel(&self, at: [f64; 2], sample: f32) -> Texel {
        let seen = self.seen(at, sample);
        seen.map_or(Texel::default(), |seen| Texel {
            slopes: seen.slopes,
            alpha2: seen.alpha2,
            height: self.height(at, sample),
            color: seen.base_color,
            metallic: seen.metallic,
            occlusion: 1.0,
        })
    }
}

impl Source for Flat {
    fn describe(&self) -> Value {
        json!({ "material": self.name, "parameters": self.parameters, "side_in_metres": self.side })
    }

    fn varies(&self) -> Varies {
        self.varies
    }

    fn why_not(&self) -> &'static str {
        "the material's lattices are not periodic"
    }

    fn range(&self) -> Option<[f32; 2]> {
        self.range
    }

    fn coat(&self) -> Option<f32> {
        self.coat
    }

    fn texels(&self, row: &Row, texels: &mut [Texel]) {
        let share = 1.0 / (row.samples * row.samples) as f32;
        for (k, texel) in texels.iter_mut().enumerate() {
            *texel = Texel::mixed(row.points(k).map(|at| (share, self.texel(at, row.sample()))));
        }
    }

    fn heights(&self, row: &Row, heights: &mut [f32]) {
        for (k, height) in heights.iter_mut().enumerate() {
            *height = self.height(row.middle(k), row.texel());
        }
    }

    fn point(&self, at: [f64; 2]) -> Texel {
        self.texel(at, 0.0)
    }
}
