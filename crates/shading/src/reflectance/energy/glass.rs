//! The directional albedo of rough GGX glass.

use asperity_ndf_sampling::Ggx;
use glam::Vec3;

use crate::math::{clamp_to, sqrt};
use crate::reflectance::energy::albedo::DirectionalAlbedo;
use crate::reflectance::energy::ggx::{as_albedo, tabulated};
use crate::reflectance::energy::glass_tables::{
    GLASS_ANISOTROPIC_DENSE, GLASS_ANISOTROPIC_RARE, GLASS_FINE_ABOVE, GLASS_FINE_BELOW, GLASS_RARE,
    GLASS_ROUGH_ABOVE, GLASS_ROUGH_BELOW,
};
use crate::reflectance::energy::spline::{as_number, blend, place, weights};
use crate::reflectance::fresnel::Dielectric;

/// The directional albedo of [`RoughDielectric`](crate::reflectance::RoughDielectric) with GGX
/// facets: the light that it reflects and transmits, seen from either side, from a table.
///
/// ```text
/// E(ωo) = ∫ f(ωo, ωi) |cos θ_i| dω_i        over both hemispheres, radiance over η²
/// isotropic:   quadratic B-splines over places of cos θ_o, √α and ∜(η − 1)
/// anisotropic: E(ωo) = C E(μ, α)            C over cos²φ, √α, the ratio of both α, √μ and ∜(η − 1)
///              α² = α_x² x² + α_y² y² + ½ (α_x² + α_y²) z²,     ωo = (x, y, z)
/// ```
///
/// Seen from the denser side the albedo of fine facets has a kink at the critical angle. Rough facets
/// have a kink at the cosine 1/η instead, where facets across the surface begin to transmit. Each has
/// its own tables, split at its kink.
///
/// - **Domain:** any view, on either side by the sign of `wo.z`; NaN is the horizon. Relative
///   indices from 1.05 to 2.5, or from 1/2.5 to 1/1.05; others are clamped to the nearest of these.
///   Roughnesses above 1 are read as 1. C of ratios above 4 is read at the ratio 4.
/// - **Range:** `(0, 1]`.
/// - **Accuracy:** for roughness from 0.05 to 1 at every angle and indices from 1.05 to 2.4, relative:
///   isotropic facets within 0.13 %, and within 0.04 % for indices from 1.33. Anisotropic facets up to the
///   ratio 4 within 0.7 % seen from the rarer side and 1 % from the denser, 0.1 % in the root mean square.
///   The roughnesses (0.1, 1) with the index 1.5 are within 12 % and 15 %, and with 1.05 up to 25 %.
///   At √α = 0.6 the albedo from the denser side has a step of up to 0.11 %.
/// - **Size:** 15 KB, and 14 KB for anisotropic facets. `cargo xtask tables` computes them.
/// - **Cost:** a value reads 27 entries, of anisotropic facets 270.
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
    /// The larger roughness.
    rough: f32,
    /// The smaller roughness over the larger.
    ratio: f32,
    x_is_rough: bool,
    /// The place of the index.
    index: f32,
    /// The sine and cosine of the critical angle in the denser medium; the sine is 1/η.
    critical: [f32; 2],
    dense_below: bool,
}

/// The shipped indices.
const INDICES: [f32; 2] = [1.05, 2.5];

/// `√α` where the table of the denser side changes.
const SPLIT: f32 = 0.6;

/// The first `√α` of the tables of anisotropic facets.
const FIRST: f32 = 0.28;

/// The place of an index above 1 in the tables: `∜(η − 1)`, scaled to `[0, 1]`.
#[inline]
fn index_place(eta: f32) -> f32 {
    let [low, high] = INDICES.map(|eta| sqrt(sqrt(eta - 1.0)));
    (sqrt(sqrt(eta - 1.0)) - low) / (high - low)
}

impl GlassAlbedo {
    /// The albedo of the surface of a body of glass with these facets.
    #[must_use]
    pub fn new(ggx: &Ggx, fresnel: &Dielectric) -> Self {
        let [x, y] = [ggx.alpha_x(), ggx.alpha_y()].map(tabulated);
        let rough = x.max(y);
        let eta = fresnel.relative_index();
        let index = eta.max(1.0 / eta).clamp(INDICES[0], INDICES[1]);
        Self {
            rough,
            ratio: x.min(y) / rough,
            x_is_rough: x >= y,
            index: index_place(index),
            critical: [1.0 / index, sqrt(1.0 - 1.0 / (index * index))],
            dense_below: eta >= 1.0,
        }
    }

    /// The entries of the tables for WGSL: 10 · 13 rows of 15 albedos seen from the rarer side. Then from
    /// the denser side 12 · 10 rows of 12 above the critical angle and of 18 beyond it, for `√α` below
    /// 0.6, and 12 · 6 rows of 10 above the cosine 1/η and of 18 below it. Then the factors of anisotropic
    /// facets: 4 · 4 · 5 · 4 rows of 9 from the rarer side, 8 · 7 · 5 · 4 rows of 10 from the denser.
    pub fn table() -> impl Iterator<Item = f32> {
        let fine = GLASS_FINE_ABOVE.as_flattened().as_flattened().iter();
        let fine = fine.chain(GLASS_FINE_BELOW.as_flattened().as_flattened());
        let rough = GLASS_ROUGH_ABOVE.as_flattened().as_flattened().iter();
        let rough = rough.chain(GLASS_ROUGH_BELOW.as_flattened().as_flattened());
        let albedos = GLASS_RARE.as_flattened().as_flattened().iter().chain(fine).chain(rough);
        let factors = GLASS_ANISOTROPIC_RARE.as_flattened().as_flattened().iter();
        let factors = factors.chain(GLASS_ANISOTROPIC_DENSE.as_flattened().as_flattened());
        albedos.map(|&entry| as_number(entry)).chain(factors.map(|&entry| as_factor(entry)))
    }

    /// The fraction of the rough axis in the azimuth of a view; any azimuth at the zenith.
    fn fraction(&self, wo: Vec3) -> f32 {
        let (rough, fine) = if self.x_is_rough { (wo.x, wo.y) } else { (wo.y, wo.x) };
        clamp_to(rough * rough / (rough * rough + fine * fine), 1.0)
    }

    /// The albedo of isotropic facets.
    fn isotropic(&self, alpha: f32, mu: f32, dense: bool) -> f32 {
        let root = sqrt(alpha);
        if !dense {
            let at = 0.8 * place(mu, 2.0 * alpha) + 0.2 * (1.0 - place(1.0 - mu, 1.0));
            return self.look_up(&GLASS_RARE, root, at);
        }
        let ([sine, cosine], fine) = (self.critical, root < SPLIT);
        let edge = if fine { cosine } else { sine };
        let row = if fine { root / SPLIT } else { (root - SPLIT) / (1.0 - SPLIT) };
        if mu >= edge {
            let above = 1.0 - edge;
            let at = place((mu - edge) / above, 6.0 * alpha / above);
            return if fine {
                self.look_up(&GLASS_FINE_ABOVE, row, at)
            } else {
                self.look_up(&GLASS_ROUGH_ABOVE, row, at)
            };
        }
        let (t, narrow) = (mu / edge, alpha / edge);
        let width = if fine { 3.0 * narrow } else { 2.0 * cosine * cosine };
        let at = 0.7 * place(t, width) + 0.3 * (1.0 - place(1.0 - t, 4.0 * narrow));
        if fine {
            self.look_up(&GLASS_FINE_BELOW, row, at)
        } else {
            self.look_up(&GLASS_ROUGH_BELOW, row, at)
        }
    }

    fn look_up<const N: usize, const M: usize, const K: usize>(
        &self,
        table: &[[[u16; N]; M]; K],
        row: f32,
        column: f32,
    ) -> f32 {
        let (slice, through) = weights(self.index, K);
        let (row, down) = weights(row, M);
        let (column, across) = weights(column, N);
        let entry = |k: usize, i: usize, j: usize| as_number(table[slice + k][row + i][column + j]);
        blend(through, |k| blend(down, |i| blend(across, |j| entry(k, i, j))))
    }

    /// The albedo over that of isotropic facets, from a table with this number of indices and azimuths.
    fn factor<const N: usize>(
        &self,
        table: &[[[u8; N]; 4]],
        [indices, shares]: [usize; 2],
        share: f32,
        mu: f32,
    ) -> f32 {
        let ratio = self.ratio.max(0.25);
        let towards = sqrt(share + (1.0 - share) * ratio * ratio);
        let (slice, through) = weights(self.index, indices);
        let (azimuth, around) = weights(share * (1.0 + 0.5 * ratio) / (towards + 0.5 * ratio), shares);
        let (first, down) = weights((sqrt(self.rough) - FIRST) / (1.0 - FIRST), 5);
        let (row, along) = weights(2.0 * sqrt(ratio) - 1.0, 4);
        let (column, across) = weights(sqrt(mu), N);
        blend(through, |k| {
            blend(around, |g| {
                let from = 5 * ((slice + k) * shares + azimuth + g) + first;
                let entry = |j: usize, i: usize, h: usize| as_factor(table[from + j][row + i][column + h]);
                blend(down, |j| blend(along, |i| blend(across, |h| entry(j, i, h))))
            })
        })
    }
}

/// The factor of a table entry.
#[inline]
fn as_factor(entry: u8) -> f32 {
    f32::from(entry) * (1.0 / 100.0)
}

impl DirectionalAlbedo for GlassAlbedo {
    fn albedo(&self, wo: Vec3) -> f32 {
        let (mu, dense) = (clamp_to(wo.z.abs(), 1.0), (wo.z < 0.0) == self.dense_below);
        if self.ratio == 1.0 {
            return as_albedo(self.isotropic(self.rough, mu, dense));
        }
        let share = self.fraction(wo);
        let [rough, fine] = [self.rough, self.rough * self.ratio].map(|alpha| alpha * alpha);
        let towards = (1.0 - mu * mu) * (share - 0.5) * (rough - fine);
        let alpha = sqrt(0.5 * (rough + fine) + towards);
        let factor = if dense {
            self.factor(&GLASS_ANISOTROPIC_DENSE, [8, 7], share, mu)
        } else {
            self.factor(&GLASS_ANISOTROPIC_RARE, [4, 4], share, mu)
        };
        as_albedo(self.isotropic(alpha, mu, dense) * factor)
    }
}
