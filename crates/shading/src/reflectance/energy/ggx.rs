//! The directional albedo of GGX mirrors.

use asperity_ndf_sampling::Ggx;
use glam::Vec3;

use crate::math::{clamp_to, sqrt};
use crate::reflectance::energy::albedo::DirectionalAlbedo;
use crate::reflectance::energy::spline::{as_number, blend, place, weights};
use crate::reflectance::energy::tables::{
    GGX, GGX_ANISOTROPIC, GGX_ANISOTROPIC_MEAN, GGX_ANISOTROPIC_SCHLICK, GGX_ANISOTROPIC_SCHLICK_MEAN,
    GGX_MEAN, GGX_SCHLICK, GGX_SCHLICK_MEAN,
};

/// The directional albedo of white GGX facets with height-correlated masking, from a table.
///
/// ```text
/// E(ωo) = ∫ D G₂/(4 cos θ_i cos θ_o) cos θ_i dω_i,        quadratic B-splines over √(μ (1 + 2α)/(μ + 2α)) and √α
/// anisotropic: E(ωo) = C E(μ, α_φ),   α_φ² = α_x² cos²φ + α_y² sin²φ,   C over cos²φ, √α, the ratio of the roughnesses and μ
/// ```
///
/// - **Domain:** any view; its cosine μ is clamped to `[0, 1]`, NaN is 0. Roughnesses above 1 are
///   read as 1.
/// - **Range:** `(0, 1]`.
/// - **Accuracy:** for isotropic roughness from 0.04 to 1 within 3·10⁻⁴ relative at every angle.
///   Anisotropic roughness is within 0.5 % up to the ratio 4, and within 3 % up to 10.
/// - **Size:** 13 KB. `cargo xtask tables` computes them.
///
/// Kulla, Conty 2017, *Revisiting Physically Based Shading at Imageworks*, who tabulate E the same
/// way.
///
/// ```
/// use asperity_shading::reflectance::{DirectionalAlbedo, GgxAlbedo, directional_albedo};
/// use asperity_shading::{CookTorrance, Ggx, glam::Vec3};
///
/// let (ggx, wo) = (Ggx::isotropic(0.5)?, Vec3::new(0.6, 0.0, 0.8));
/// let exact = directional_albedo(&CookTorrance::new(ggx, Vec3::ONE), wo, 1 << 14).x;
/// assert!((GgxAlbedo::new(&ggx).albedo(wo) / exact - 1.0).abs() < 1e-3);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GgxAlbedo {
    /// The larger roughness.
    rough: f32,
    /// The smaller roughness over the larger.
    ratio: f32,
    x_is_rough: bool,
}

/// An albedo from the sum of table entries.
#[inline]
pub(super) fn as_albedo(sum: f32) -> f32 {
    sum.clamp(1e-3, 1.0)
}

/// A roughness of the tables.
#[inline]
pub(super) fn tabulated(alpha: f32) -> f32 {
    clamp_to(alpha, 1.0).max(1e-3)
}

impl GgxAlbedo {
    /// The albedo of these facets.
    #[must_use]
    pub fn new(ggx: &Ggx) -> Self {
        let [x, y] = [ggx.alpha_x(), ggx.alpha_y()].map(tabulated);
        let rough = x.max(y);
        Self { rough, ratio: x.min(y) / rough, x_is_rough: x >= y }
    }

    /// The roughness towards a view, and the fraction of the rough axis in its azimuth.
    fn towards(&self, wo: Vec3) -> (f32, f32) {
        let (rough, fine) = if self.x_is_rough { (wo.x, wo.y) } else { (wo.y, wo.x) };
        let fraction = clamp_to(rough * rough / (rough * rough + fine * fine), 1.0);
        (self.rough * sqrt(fraction + (1.0 - fraction) * self.ratio * self.ratio), fraction)
    }

    /// A table of anisotropic facets seen at this place of the cosine.
    fn anisotropic(&self, table: &[[[u16; 12]; 6]; 40], fraction: f32, place: f32) -> f32 {
        let (slice, around) = weights(fraction, 5);
        let (first, down) = weights(sqrt(self.rough), 8);
        let (row, through) = weights(self.ratio, 6);
        let (column, across) = weights(place, 12);
        let entry = |k: usize, j: usize, i: usize, h: usize| {
            as_number(table[8 * (slice + k) + first + j][row + i][column + h])
        };
        blend(around, |k| blend(down, |j| blend(through, |i| blend(across, |h| entry(k, j, i, h)))))
    }

    fn mean_of(&self, round: &[u16; 16], anisotropic: &[[u16; 6]; 8]) -> f32 {
        if self.ratio == 1.0 {
            let (first, at) = weights(sqrt(self.rough), 16);
            return blend(at, |i| as_number(round[first + i]));
        }
        let (first, down) = weights(sqrt(self.rough), 8);
        let (row, through) = weights(self.ratio, 6);
        blend(down, |j| blend(through, |i| as_number(anisotropic[first + j][row + i])))
    }

    /// The Schlick moment `E₅(ωo)`: the albedo with the facet reflectance `(1 − ωo·h)⁵`.
    ///
    /// ```text
    /// E₅(ωo) = ∫ (1 − ωo·h)⁵ D G₂/(4 cos θ_i cos θ_o) cos θ_i dω_i
    /// albedo of facets with F = F₀ + (F₉₀ − F₀)(1 − ωo·h)⁵:  F₀ (E − E₅) + F₉₀ E₅
    /// ```
    ///
    /// - **Range:** `[0, 1]`, at most [`albedo`](DirectionalAlbedo::albedo).
    /// - **Accuracy:** for isotropic roughness from 0.04 to 1 within 4·10⁻⁴ at every angle. The
    ///   albedo with F₀ = 0.04 is within 8·10⁻⁴ relative. For anisotropic
    ///   roughness up to the ratio 4 the latter is within 5 %, up to 10 within 16 %.
    ///
    /// The split into two integrals is that of Karis 2013, *Real Shading in Unreal Engine 4*.
    ///
    /// ```
    /// use asperity_shading::reflectance::{DirectionalAlbedo, GgxAlbedo, directional_albedo};
    /// use asperity_shading::{CookTorrance, Ggx, Schlick, glam::Vec3};
    ///
    /// let (ggx, wo) = (Ggx::isotropic(0.5)?, Vec3::new(0.8, 0.0, 0.6));
    /// let (e, e5) = (GgxAlbedo::new(&ggx).albedo(wo), GgxAlbedo::new(&ggx).schlick_moment(wo));
    /// let exact = directional_albedo(&CookTorrance::new(ggx, Schlick::new(0.04)?), wo, 1 << 14).x;
    /// assert!((0.04 * (e - e5) + e5 - exact).abs() < 1e-4);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    #[must_use]
    pub fn schlick_moment(&self, wo: Vec3) -> f32 {
        self.moments(wo)[1]
    }

    /// `E(ωo)` and `E₅(ωo)`.
    pub(in crate::reflectance) fn moments(&self, wo: Vec3) -> [f32; 2] {
        let (mu, (alpha, fraction)) = (clamp_to(wo.z, 1.0), self.towards(wo));
        let at = place(mu, 2.0 * alpha);
        let mut cosine = entry(&GGX_SCHLICK, alpha, sqrt(mu));
        if self.ratio < 1.0 {
            cosine += self.anisotropic(&GGX_ANISOTROPIC_SCHLICK, fraction, at) - 0.5;
        }
        let (e, angle) = (self.albedo_at(alpha, fraction, at), 1.0 - cosine.clamp(0.0, 1.0));
        [e, e * (angle * angle) * (angle * angle) * angle]
    }

    /// The albedo at the place of a cosine.
    fn albedo_at(&self, alpha: f32, fraction: f32, at: f32) -> f32 {
        let round = entry(&GGX, alpha, at);
        let factor =
            if self.ratio < 1.0 { 2.0 * self.anisotropic(&GGX_ANISOTROPIC, fraction, at) } else { 1.0 };
        as_albedo(round * factor)
    }

    /// The mean of [`schlick_moment`](Self::schlick_moment) over views, weighted by the cosine.
    ///
    /// ```text
    /// 2 ∫ E₅(cos θ) cos θ dcos θ
    /// ```
    ///
    /// Within 2·10⁻⁴ for isotropic roughness from 0.04 to 1, and 8·10⁻⁴ for anisotropic.
    #[must_use]
    pub fn mean_schlick_moment(&self) -> f32 {
        self.mean_of(&GGX_SCHLICK_MEAN, &GGX_ANISOTROPIC_SCHLICK_MEAN).clamp(0.0, 1.0)
    }

    /// The entries of the tables for WGSL: 16 rows of 24 albedos, then 16 means, then as many for the
    /// Schlick moment; then for anisotropic facets 5 · 8 · 6 rows of 12 and 8 rows of 6 means, twice.
    pub fn table() -> impl Iterator<Item = f32> {
        let albedos = GGX.as_flattened().iter().chain(&GGX_MEAN);
        let schlick = GGX_SCHLICK.as_flattened().iter().chain(&GGX_SCHLICK_MEAN);
        let rows = |table: &'static [[[u16; 12]; 6]; 40], means: &'static [[u16; 6]; 8]| {
            table.as_flattened().as_flattened().iter().chain(means.as_flattened())
        };
        albedos
            .chain(schlick)
            .chain(rows(&GGX_ANISOTROPIC, &GGX_ANISOTROPIC_MEAN))
            .chain(rows(&GGX_ANISOTROPIC_SCHLICK, &GGX_ANISOTROPIC_SCHLICK_MEAN))
            .map(|&entry| as_number(entry))
    }
}

/// The number of a table at a roughness and a place of the cosine.
fn entry(table: &[[u16; 24]; 16], alpha: f32, place: f32) -> f32 {
    let (column, across) = weights(place, 24);
    let (row, down) = weights(sqrt(alpha), 16);
    blend(down, |i| blend(across, |j| as_number(table[row + i][column + j])))
}

impl DirectionalAlbedo for GgxAlbedo {
    fn albedo(&self, wo: Vec3) -> f32 {
        let (alpha, fraction) = self.towards(wo);
        self.albedo_at(alpha, fraction, place(clamp_to(wo.z, 1.0), 2.0 * alpha))
    }

    fn mean_albedo(&self) -> f32 {
        as_albedo(self.mean_of(&GGX_MEAN, &GGX_ANISOTROPIC_MEAN))
    }
}
