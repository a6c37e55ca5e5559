//! The directional albedo of GGX mirrors.

use asperity_ndf_sampling::Ggx;
use glam::Vec3;

use crate::math::{clamp_to, sqrt};
use crate::reflectance::energy::albedo::DirectionalAlbedo;
use crate::reflectance::energy::spline::{as_number, blend, place, weights};
use crate::reflectance::energy::tables::{GGX, GGX_MEAN, GGX_SCHLICK, GGX_SCHLICK_MEAN};

/// The directional albedo of white GGX facets with height-correlated masking, from a table.
///
/// ```text
/// E(ωo) = ∫ D G₂/(4 cos θ_i cos θ_o) cos θ_i dω_i,        quadratic B-splines over √(μ (1 + 2α)/(μ + 2α)) and √α
/// anisotropic: E(ωo) ≈ (E(μ, α_x) + E(μ, α_y))/2
/// ```
///
/// - **Domain:** any view; its cosine μ is clamped to `[0, 1]`, NaN is 0. Roughnesses above 1 are
///   read as 1.
/// - **Range:** `(0, 1]`.
/// - **Accuracy:** for isotropic roughness from 0.04 to 1 within 3·10⁻⁴ relative at every angle.
///   Anisotropic roughness is approximated. The largest relative error is 3 % for the ratio 2, 10 %
///   for (0.1, 0.4), and 50 % for (0.1, 1). `AlbedoTable` is within 0.2 % for
///   them.
/// - **Size:** 1600 bytes. `cargo xtask tables` computes them.
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
    alpha_x: f32,
    alpha_y: f32,
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
        Self { alpha_x: ggx.alpha_x(), alpha_y: ggx.alpha_y() }
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
    ///   albedo with F₀ = 0.04 is within 8·10⁻⁴ relative. Anisotropic roughness is approximated as in
    ///   [`albedo`](DirectionalAlbedo::albedo).
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
        let mu = clamp_to(wo.z, 1.0);
        self.over_axes(|alpha| {
            let angle = 1.0 - entry(&GGX_SCHLICK, alpha, sqrt(mu)).clamp(0.0, 1.0);
            as_albedo(entry(&GGX, alpha, place(mu, 2.0 * alpha))) * (angle * angle) * (angle * angle) * angle
        })
    }

    /// The mean of [`schlick_moment`](Self::schlick_moment) over views, weighted by the cosine.
    ///
    /// ```text
    /// 2 ∫ E₅(cos θ) cos θ dcos θ
    /// ```
    ///
    /// Within 2·10⁻⁴ for isotropic roughness from 0.04 to 1.
    #[must_use]
    pub fn mean_schlick_moment(&self) -> f32 {
        self.over_axes(|alpha| mean_entry(&GGX_SCHLICK_MEAN, alpha)).clamp(0.0, 1.0)
    }

    /// The entries of the tables for WGSL: 16 rows of 24 albedos, then 16 means, then as many for the
    /// Schlick moment.
    pub fn table() -> impl Iterator<Item = f32> {
        let albedos = GGX.as_flattened().iter().chain(&GGX_MEAN);
        let schlick = GGX_SCHLICK.as_flattened().iter().chain(&GGX_SCHLICK_MEAN);
        albedos.chain(schlick).map(|&entry| as_number(entry))
    }

    /// The mean of a function of isotropic roughness over both axes.
    fn over_axes(&self, of: impl Fn(f32) -> f32) -> f32 {
        let at = |alpha| of(tabulated(alpha));
        if self.alpha_x == self.alpha_y {
            at(self.alpha_x)
        } else {
            0.5 * (at(self.alpha_x) + at(self.alpha_y))
        }
    }
}

/// The number of a table at a roughness and a place of the cosine.
fn entry(table: &[[u16; 24]; 16], alpha: f32, place: f32) -> f32 {
    let (column, across) = weights(place, 24);
    let (row, down) = weights(sqrt(alpha), 16);
    blend(down, |i| blend(across, |j| as_number(table[row + i][column + j])))
}

/// The number of a table at a roughness.
fn mean_entry(table: &[u16; 16], alpha: f32) -> f32 {
    let (first, at) = weights(sqrt(alpha), 16);
    blend(at, |i| as_number(table[first + i]))
}

impl DirectionalAlbedo for GgxAlbedo {
    fn albedo(&self, wo: Vec3) -> f32 {
        let mu = clamp_to(wo.z, 1.0);
        as_albedo(self.over_axes(|alpha| entry(&GGX, alpha, place(mu, 2.0 * alpha))))
    }

    fn mean_albedo(&self) -> f32 {
        as_albedo(self.over_axes(|alpha| mean_entry(&GGX_MEAN, alpha)))
    }
}
