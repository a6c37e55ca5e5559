//! A fractal surface that is periodic by construction, `PeriodicSurface`.

use asperity_fif::{PeriodicSurface, glam::DVec2};
use asperity_shading::normal_map::SlopeMoments;
use glam::Vec2;
use serde_json::{Value, json};

use crate::bake::source::{Row, Source, Varies};
use crate::bake::sources::finish::Finish;
use crate::bake::texel::Texel;
use crate::failure::Result;
use crate::output::sha256;

/// Parameters of the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Parameters {
    /// Nodes along a side.
    pub(crate) nodes: u32,
    /// The vertical scaling s, which controls the roughness: |s| < 1/√5.
    pub(crate) scaling: f32,
    /// Standard deviation of the heights, in units of the side.
    pub(crate) height: f32,
    pub(crate) seed: u32,
}

/// The surface.
pub(crate) struct Fractal {
    parameters: Parameters,
    finish: Finish,
    surface: PeriodicSurface,
    /// Offset and scale of its heights.
    mean: f64,
    scale: f64,
}

/// Grid points per side for estimating the height variance.
const GRID: usize = 128;

impl Fractal {
    /// Builds the surface from its parameters.
    pub(crate) fn new(parameters: Parameters, finish: Finish) -> Result<Self> {
        let Parameters { nodes, scaling, height, seed } = parameters;
        let count = (nodes as usize).saturating_mul(nodes as usize).min(1 << 20);
        // Uniform within [−1, 1], from the digest of seed and index.
        let random = |k: usize| {
            let digest = sha256(format!("{seed} {k}").as_bytes());
            let word = u32::from_str_radix(&digest[..8], 16).unwrap_or_default();
            f64::from(word) / 2_147_483_648.0 - 1.0
        };
        let z: Vec<f64> = (0..count).map(random).collect();
        let steep = f64::from(nodes);
        let d: Vec<[f64; 2]> =
            (0..count).map(|k| [1, 2].map(|part| steep * random(part * count + k))).collect();
        let surface =
            PeriodicSurface::new(nodes as usize, [[2, -1], [1, 2]], f64::from(scaling), &z, &d)?.narrowed();
        let heights: Vec<f64> = (0..GRID * GRID)
            .map(|k| [k % GRID, k / GRID].map(|i| (i as f64 + 0.5) / GRID as f64))
            .map(|[x, y]| surface.evaluate(x, y, 1e-4).value)
            .collect();
        let mean = surface.mean().value;
        let variance = heights.iter().map(|z| (z - mean).powi(2)).sum::<f64>() / heights.len() as f64;
        let scale = f64::from(height) / variance.sqrt();
        Ok(Self { parameters, finish, surface, mean, scale })
    }

    fn height(&self, [x, y]: [f64; 2]) -> f32 {
        // A thousandth of a 16-bit texel step.
        (self.scale * (self.surface.evaluate(x, y, 1e-8).value - self.mean)) as f32
    }

    fn slope(&self, [x, y]: [f64; 2]) -> Vec2 {
        let [dx, dy] = self.surface.evaluate_gradient(x, y, 1e-4);
        (-self.scale * DVec2::new(dx.value, dy.value)).as_vec2()
    }
}

impl Source for Fractal {
    fn describe(&self) -> Value {
        let Parameters { nodes, scaling, height, seed } = self.parameters;
        json!({
            "fractal": "periodic", "nodes": nodes, "scaling": scaling, "height": height, "seed": seed,
            "finish": self.finish.describe(),
        })
    }

    fn varies(&self) -> Varies {
        Varies { color: self.finish.is_colored(), metallic: false, height: true }
    }

    fn texels(&self, row: &Row, texels: &mut [Texel]) {
        let share = 1.0 / (row.samples * row.samples) as f32;
        let deviation = self.parameters.height;
        for (k, texel) in texels.iter_mut().enumerate() {
            let (mut height, mut color) = (0.0, glam::Vec3::ZERO);
            let slopes = SlopeMoments::mixed(row.points(k).map(|at| {
                let own = self.height(at);
                height += share * own;
                color += share * self.finish.color(own / deviation);
                (1.0, SlopeMoments::point(self.slope(at)))
            }));
            *texel = Texel {
                slopes,
                alpha2: self.finish.alpha * self.finish.alpha,
                height,
                color,
                metallic: self.finish.metallic,
                occlusion: 1.0,
            };
        }
    }

    fn heights(&self, row: &Row, heights: &mut [f32]) {
        for (k, height) in heights.iter_mut().enumerate() {
            *height = self.height(row.middle(k));
        }
    }

    fn point(&self, at: [f64; 2]) -> Texel {
        Texel { height: self.height(at), slopes: SlopeMoments::point(self.slope(at)), ..Texel::default() }
    }
}
