//! The finish of a relief surface: colors, roughness and metalness.

use asperity_render::image::tone::srgb;
use glam::Vec3;
use serde_json::{Value, json};

/// Colors and gloss of a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Finish {
    /// Linear colors of the highest and the lowest areas.
    pub(crate) colors: [Vec3; 2],
    /// α of the surface between its slopes.
    pub(crate) alpha: f32,
    pub(crate) metallic: f32,
}

impl Finish {
    /// Whether high and low areas differ in color.
    pub(super) fn is_colored(&self) -> bool {
        self.colors[0] != self.colors[1]
    }

    /// Returns the color at a height in standard deviations, interpolated between −2 and 2.
    pub(super) fn color(&self, height: f32) -> Vec3 {
        self.colors[1].lerp(self.colors[0], (0.5 + 0.25 * height).clamp(0.0, 1.0))
    }

    pub(super) fn describe(&self) -> Value {
        let hex = self.colors.map(|color| {
            let [r, g, b] = color.to_array().map(|x| (255.0 * srgb(x)).round() as u8);
            format!("{r:02x}{g:02x}{b:02x}")
        });
        json!({ "color": hex[0], "low_color": hex[1], "alpha": self.alpha, "metallic": self.metallic })
    }
}
