//! The error of a filtered highlight, compared with 1,024 samples of the maps in a pixel.

use asperity_ndf_sampling::{Ggx, Ndf};
use glam::{DVec2, Mat3, Vec2, Vec3};
use rayon::prelude::*;

use crate::filter::levels::Levels;
use crate::filter::tails::SHARPEST;

/// Samples along a side of a pixel, and the level whose texels have as many of the finest along a
/// side.
const SIDE: usize = 32;
const LEVEL: usize = 5;
/// Pixels along a side of the map, at most.
const PIXELS: usize = 8;
/// Half vectors for each of both distributions.
const HALVES: u32 = 128;

/// A GGX distribution around a slope.
#[derive(Clone, Copy)]
struct Lobe {
    /// From the frame of the normal.
    frame: Mat3,
    ggx: Ggx,
}

impl Lobe {
    /// Creates a lobe whose first α is along a direction of the slopes.
    fn new(slope: Vec2, alpha: [f32; 2], along: [f32; 2]) -> Self {
        let normal = slope.extend(1.0).normalize();
        let x = Vec2::from(along).extend(0.0).reject_from_normalized(normal).normalize();
        let [alpha_x, alpha_y] = alpha.map(|alpha| alpha.max(SHARPEST));
        Self { frame: Mat3::from_cols(x, normal.cross(x), normal), ggx: Ggx::new_clamped(alpha_x, alpha_y) }
    }

    fn isotropic(slope: Vec2, roughness: f32) -> Self {
        Self::new(slope, [roughness * roughness; 2], [1.0, 0.0])
    }

    fn density(self, h: Vec3) -> f32 {
        self.ggx.d(self.frame.transpose() * h)
    }

    fn sample(self, u: [f32; 2]) -> Vec3 {
        self.frame * self.ggx.sample(u.into())
    }
}

/// Returns the root mean square of the error of D over the root mean square of D, with plain mip
/// levels and with filtered ones.
///
/// Half vectors follow the mean of both distributions, and both sums have their inverse density as
/// weight.
pub(super) fn errors(levels: &Levels, anisotropic: bool) -> [f64; 2] {
    let level = LEVEL.min(levels.count() - 1);
    let [width, height] = levels.size(level);
    let count = [width, height].map(|side| side.min(PIXELS));
    let sums = (0..count[0] * count[1]).into_par_iter().map(|k| {
        let column = (k % count[0]) * width / count[0];
        let row = (k / count[0]) * height / count[1];
        pixel(levels, level, [column, row], anisotropic, k as u32)
    });
    let sums = sums.reduce(|| [[0.0; 2]; 2], |a, b| [0, 1].map(|i| [0, 1].map(|j| a[i][j] + b[i][j])));
    sums.map(|[error, all]| if all > 0.0 { (error / all).sqrt() } else { 0.0 })
}

/// Returns the sums of squares of error and reference, for both ways.
fn pixel(
    levels: &Levels,
    level: usize,
    [column, row]: [usize; 2],
    anisotropic: bool,
    seed: u32,
) -> [[f64; 2]; 2] {
    let [width, height] = levels.size(level);
    let lobe = |k: usize| {
        let within = DVec2::new((k % SIDE) as f64 + 0.5, (k / SIDE) as f64 + 0.5) / SIDE as f64;
        let place = DVec2::new(column as f64, row as f64) + within;
        let uv = place / DVec2::new(width as f64, height as f64);
        let [_, roughness, _] = levels.texels.surface(uv);
        Lobe::isotropic(levels.texels.slope(uv), roughness)
    };
    let lobes: Vec<Lobe> = (0..SIDE * SIDE).map(lobe).collect();
    let reference = |h: Vec3| lobes.iter().map(|lobe| lobe.density(h)).sum::<f32>() / lobes.len() as f32;
    let texel = levels.texel(level, row * width + column);
    let mean = texel.slopes.moments.mean;
    let filtered = if anisotropic {
        let (alpha2, along) = texel.alpha2_along();
        Lobe::new(mean, alpha2.map(f32::sqrt), along)
    } else {
        Lobe::isotropic(mean, texel.roughness())
    };
    [Lobe::isotropic(mean, texel.plain[1]), filtered].map(|one| {
        let mut sums = [0.0; 2];
        for k in 0..2 * HALVES {
            // The R₂ sequence.
            let index = (seed * 2 * HALVES + k) as f32;
            let u = [0.754_877_7, 0.569_840_3].map(|step: f32| (0.5 + index * step).fract());
            let of = if k % 2 == 0 { one } else { lobes[(k as usize / 2 * 8 + 3) % lobes.len()] };
            let h = of.sample(u);
            let (exact, got) = (reference(h), one.density(h));
            let weight = 1.0 / f64::from(0.5 * (exact + got)).max(1e-30);
            sums[0] += weight * f64::from(got - exact).powi(2);
            sums[1] += weight * f64::from(exact).powi(2);
        }
        sums
    })
}
