//! The directional albedo of rough GGX glass.

use asperity_ndf_sampling::Ggx;
use glam::Vec3;

use crate::math::{clamp_to, sqrt};
use crate::reflectance::energy::albedo::DirectionalAlbedo;
use crate::reflectance::energy::ggx::{as_albedo, tabulated};
use crate::reflectance::energy::spline::{as_number, blend, place, weights};
use crate::reflectance::energy::tables::{GLASS_DENSE, GLASS_DENSE_TOTAL, GLASS_RARE};
use crate::reflectance::fresnel::Dielectric;

/// The directional albedo of [`RoughDielectric`](crate::reflectance::RoughDielectric) with GGX
/// facets: the light that it reflects and transmits, seen from either side, from a table.
///
/// ```text
/// E(ωo) = ∫ f(ωo, ωi) |cos θ_i| dω_i        over both hemispheres, radiance over η²
/// quadratic B-splines over a place of the cosine, √α and √(η − 1), for either side of the surface and of the critical angle
/// ```
///
/// - **Domain:** any view, on either side by the sign of `wo.z`; NaN is the horizon. Relative
///   indices from 1.05 to 2.5, or from 1/2.5 to 1/1.05; others are clamped to the nearest of these.
///   Roughnesses above 1 are read as 1. Anisotropic facets are read as isotropic ones of
///   `α² = ½ (α_x² cos²φ + α_y² sin²φ) + ¼ (α_x² + α_y²)`. For the index 1.5
///   that is off by up to 3 % for (0.2, 0.4), 4 % for (0.1, 0.4) and 9 % for (0.1, 1) seen from the rarer
///   side, and 7 %, 12 % and 32 % from the denser. Lower indices are worse near the horizon.
/// - **Range:** `(0, 1]`.
/// - **Accuracy:** for roughness from 0.05 to 1 at every angle and indices from 1.3 to 2.5: within 0.1 %
///   relative seen from the rarer side, within 0.25 % from the denser. Within 0.4 % for 1.05.
/// - **Size:** 16 KB. `cargo xtask tables` computes them.
///
/// Turquin 2019, *Practical multiple scattering compensation for microfacet models*, §3.2, who
/// tabulates E of glass the same way.
///
/// ```
/// use asperity_shading::reflectance::{DirectionalAlbedo, GlassAlbedo};
/// use asperity_shading::{Dielectric, Ggx, glam::Vec3};
///
/// let glass = GlassAlbedo::new(&Ggx::isotropic(1.0)?, &Dielectric::new(1.5)?);
/// // Less light returns from inside.
/// assert!(glass.albedo(Vec3::Z) > 0.89 && glass.albedo(Vec3::NEG_Z) < 0.42);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GlassAlbedo {
    /// The squares of the roughnesses.
    squares: [f32; 2],
    /// The place of the index.
    index: f32,
    /// The cosine of the critical angle in the denser medium.
    critical: f32,
    dense_below: bool,
}

/// The shipped indices.
const INDICES: [f32; 2] = [1.05, 2.5];

/// The place of an index above 1 in the table: `√(η − 1)`, scaled to `[0, 1]`.
#[inline]
fn index_place(eta: f32) -> f32 {
    let [low, high] = INDICES.map(|eta| sqrt(eta - 1.0));
    (sqrt(eta - 1.0) - low) / (high - low)
}

impl GlassAlbedo {
    /// The albedo of the surface of a body of glass with these facets.
    #[must_use]
    pub fn new(ggx: &Ggx, fresnel: &Dielectric) -> Self {
        let eta = fresnel.relative_index();
        let index = eta.max(1.0 / eta).clamp(INDICES[0], INDICES[1]);
        Self {
            squares: [ggx.alpha_x(), ggx.alpha_y()].map(|alpha| tabulated(alpha) * tabulated(alpha)),
            index: index_place(index),
            critical: sqrt(1.0 - 1.0 / (index * index)),
            dense_below: eta >= 1.0,
        }
    }

    /// The entries of the table for WGSL: 10 · 10 rows of 17 albedos seen from the rarer side, then
    /// 18 · 14 rows of 10 from the denser side, then 18 · 14 rows of 14 beyond the critical angle.
    pub fn table() -> impl Iterator<Item = f32> {
        let (rare, dense) = (GLASS_RARE.as_flattened().as_flattened(), GLASS_DENSE.as_flattened());
        let beyond = GLASS_DENSE_TOTAL.as_flattened().as_flattened();
        rare.iter().chain(dense.as_flattened()).chain(beyond).map(|&entry| as_number(entry))
    }

    /// The roughness of isotropic facets with about the same albedo.
    fn alpha(&self, wo: Vec3) -> f32 {
        let ([x, y], [along, across]) = (self.squares, [wo.x * wo.x, wo.y * wo.y]);
        // At the zenith every azimuth would do.
        let share = clamp_to(along / (along + across), 1.0);
        sqrt(0.5 * (y + share * (x - y)) + 0.25 * (x + y))
    }

    fn look_up<const N: usize, const M: usize, const K: usize>(
        &self,
        table: &[[[u16; N]; M]; K],
        alpha: f32,
        place: f32,
    ) -> f32 {
        let (column, across) = weights(place, N);
        let (row, down) = weights(sqrt(alpha), M);
        let (slice, through) = weights(self.index, K);
        let entry = |k: usize, i: usize, j: usize| as_number(table[slice + k][row + i][column + j]);
        as_albedo(blend(through, |k| blend(down, |i| blend(across, |j| entry(k, i, j)))))
    }
}

impl DirectionalAlbedo for GlassAlbedo {
    fn albedo(&self, wo: Vec3) -> f32 {
        let (mu, alpha) = (clamp_to(wo.z.abs(), 1.0), self.alpha(wo));
        if (wo.z < 0.0) != self.dense_below {
            return self.look_up(&GLASS_RARE, alpha, place(mu, 2.0 * alpha));
        }
        if mu >= self.critical {
            let above = 1.0 - self.critical;
            let width = 4.0 * alpha / above;
            return self.look_up(&GLASS_DENSE, alpha, place((mu - self.critical) / above, width));
        }
        let (t, narrow) = (mu / self.critical, alpha / self.critical);
        let both = place(t, 2.0 * narrow) + 1.0 - place(1.0 - t, 4.0 * narrow);
        self.look_up(&GLASS_DENSE_TOTAL, alpha, 0.5 * both)
    }
}
