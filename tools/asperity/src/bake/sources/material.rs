//! A material on a flat square, through the metallic–roughness model.

use asperity_render::scene::Surface;
use asperity_shading::material::MetallicRoughness;
use asperity_shading::{Footprint, SurfacePoint};
use glam::{Vec2, Vec3};
use serde_json::{Value, json};

use crate::bake::source::{Row, Source, Varies};
use crate::bake::texel::Texel;
use asperity::failure::Result;

/// A material of `render` on a square of a side in metres.
pub(crate) struct Flat {
    name: String,
    parameters: Value,
    surface: Box<Surface<'static>>,
    side: f32,
    /// The lowest and the highest point that there may be, in sides.
    range: Option<[f32; 2]>,
    varies: Varies,
    coat: Option<f32>,
}

/// Places along a side that tell what varies; no period of patterns is a whole part of it.
const GRID: usize = 61;

impl Flat {
    /// The material on the square.
    pub(crate) fn new(
        name: String,
        parameters: Value,
        surface: Box<Surface<'static>>,
        side: f32,
    ) -> Result<Self> {
        let range = surface.height_range().map(|range| range.map(|height| height / side));
        let varies = Varies { colour: true, metallic: true, height: range.is_some_and(|[a, b]| a < b) };
        let mut flat = Self { name, parameters, surface, side, range, varies, coat: None };
        let (mut colours, mut metals) = (Vec::new(), Vec::new());
        for k in 0..GRID * GRID {
            let at = [k % GRID, k / GRID].map(|i| (i as f64 + 0.381_966) / GRID as f64);
            let Some(seen) = flat.seen(at, 0.0) else {
                return Err(format!(
                    "{} is no surface that has a base colour: light goes through it",
                    flat.name
                )
                .into());
            };
            colours.push(seen.base_colour);
            metals.push(seen.metallic);
            flat.coat = seen.coat.or(flat.coat);
        }
        flat.varies.colour = colours.iter().any(|colour| *colour != colours[0]);
        flat.varies.metallic = metals.iter().any(|metal| *metal != metals[0]);
        Ok(flat)
    }

    /// A point of the square with the pixel that a sample of this side is.
    fn place(&self, at: [f64; 2], sample: f32) -> SurfacePoint {
        let place = Vec2::from(at.map(|x| (x * f64::from(self.side)) as f32));
        let pixel = Footprint::from_width(sample * self.side);
        SurfacePoint::new(place.extend(0.0), Vec3::Z, pixel).with_uv(place, [Vec3::X, Vec3::Y])
    }

    /// The surface at a point, as a sample of this side sees it.
    fn seen(&self, at: [f64; 2], sample: f32) -> Option<MetallicRoughness> {
        // From below: from above facets steeper than 45° would be turned towards the eye, and lose their slope.
        MetallicRoughness::of(&self.surface.bsdf(&self.place(at, sample), Vec3::NEG_Z))
    }

    /// The height of a point in sides, as a sample of this side sees it.
    fn height(&self, at: [f64; 2], sample: f32) -> f32 {
        if self.varies.height { self.surface.height(&self.place(at, sample)) / self.side } else { 0.0 }
    }

    fn texel(&self, at: [f64; 2], sample: f32) -> Texel {
        let seen = self.seen(at, sample);
        seen.map_or(Texel::default(), |seen| Texel {
            slopes: seen.slopes,
            alpha2: seen.alpha2,
            height: self.height(at, sample),
            colour: seen.base_colour,
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
        "the material's lattices have no period"
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
