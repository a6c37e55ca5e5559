//! Smooth coats: mirrors, and the medium behind them.

use core::f32::consts::TAU;

use asperity_ndf_sampling::Beckmann;
use glam::{Vec2, Vec3, Vec4};

use crate::bump::{Facet, bumped_normal, flip_to_visible, slope_facets};
use crate::direction::{along, reflect};
use crate::math::{clamp_to, cos, ln_1p, sin, sqrt};
use crate::reflectance::absorption::through_wall;
use crate::reflectance::brdf::{BsdfSample, SampleKind};
use crate::reflectance::cook_torrance::CookTorrance;
use crate::reflectance::fresnel::{Dielectric, Fresnel};
use crate::reflectance::lobe::{Lobe, LobePart};
use crate::reflectance::rough_dielectric::RoughDielectric;

/// A smooth surface over the layers of a [`Bsdf`](crate::reflectance::Bsdf), or without layers.
///
/// Varnish, a pane, a body of glass, or a polished metal.
///
/// It scatters light into single directions, specular [samples](crate::Bsdf::sample). Unresolved
/// slopes blur them: each direction then belongs to a facet that is selected by random numbers.
#[doc(alias = "clearcoat")]
#[doc(alias = "varnish")]
#[doc(alias = "mirror")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coat {
    normal: Vec3,
    slopes: Slopes,
    /// Beckmann's α of the reflection; 0 for a smooth coat.
    roughness: f32,
    behind: Behind,
}

/// The unresolved slopes of a coat, in the frame of the surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Slopes {
    /// Gaussian, with this variance along each axis.
    Gaussian(f32),
    /// Slopes of a sine with this maximum slope.
    Sine(Vec3),
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Behind {
    Clearcoat(Dielectric),
    ThinDielectric(Dielectric, Vec3),
    Dielectric(Dielectric),
    Conductor(Vec3),
    Transparent(Vec3),
}

/// A direction of light that a smooth surface scatters into `wo`, with its weight.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Delta {
    /// The unit direction to the light; any finite vector if the weight is 0.
    wi: Vec3,
    /// The fraction of its radiance, in [0, 1]³.
    weight: Vec3,
}

/// `α²/v` of the narrowest lobe that has no gaps between the facets of slopes of the variance v.
const GAPLESS: f32 = 1.4;

impl Coat {
    const fn flat(behind: Behind) -> Self {
        Self { normal: Vec3::Z, slopes: Slopes::Gaussian(0.0), roughness: 0.0, behind }
    }

    /// A varnish over the layers, which receive the transmitted light: `(1 − F(ωi)) (1 − F(ωo))`.
    #[must_use]
    pub const fn clearcoat(fresnel: Dielectric) -> Self {
        Self::flat(Behind::Clearcoat(fresnel))
    }

    /// A thin tinted dielectric slab (no refraction offset).
    ///
    /// `R = 2F/(1 + F)` of both its surfaces, `T = (1 − R) tint^(1/cos θ_t)`.
    ///
    /// `tint` is the transmittance at normal incidence. At an angle the path is longer, by the
    /// Beer–Lambert law.
    #[must_use]
    pub const fn thin_dielectric(fresnel: Dielectric, tint: Vec3) -> Self {
        Self::flat(Behind::ThinDielectric(fresnel, tint))
    }

    /// The refracting surface of a body (Snell's law), seen from inside if `wo` is below the
    /// surface.
    ///
    /// The weight of transmission is `1 − F`. It omits the change of radiance by η², which is
    /// undone where the light leaves.
    #[must_use]
    pub const fn dielectric(fresnel: Dielectric) -> Self {
        Self::flat(Behind::Dielectric(fresnel))
    }

    /// A polished metal with this reflectance.
    #[must_use]
    pub const fn conductor(color: Vec3) -> Self {
        Self::flat(Behind::Conductor(color))
    }

    /// A transparent layer with the given transmittance, e.g. ray-marched gas.
    #[must_use]
    pub const fn transparent(transmittance: Vec3) -> Self {
        Self::flat(Behind::Transparent(transmittance))
    }

    /// Sets the normal, in the frame of the surface, and the slope variance around it.
    #[must_use]
    pub fn bumped(self, normal: Vec3, slope_variance: f32) -> Self {
        self.with_slopes(normal, Slopes::Gaussian(slope_variance))
    }

    /// Makes the reflection rough with a Beckmann NDF of this width; 0 is smooth.
    ///
    /// It becomes a lobe of the [`Bsdf`](crate::reflectance::Bsdf) in place of a single direction.
    ///
    /// A rough pane or body also scatters the transmitted light: it is a [`RoughDielectric`], and
    /// has no specular samples.
    ///
    /// Unresolved slopes are [facets](slope_facets()) of a rough coat. If the lobe is too narrow to
    /// fill the gaps between them, with α below 1.2 standard deviations, it is widened by a
    /// fraction of the slopes. The lobe of a pane is not widened, so its facets remain visible.
    #[must_use]
    pub fn rough(self, alpha: f32) -> Self {
        Self { roughness: clamp_to(alpha, 1.0), ..self }
    }

    /// The width of the lobe of a rough coat, and the slope variance of its facets.
    ///
    /// A lobe narrower than the gaps between facets takes a fraction β of the slope variance v that
    /// fills the gaps:
    ///
    /// ```text
    /// α′² = α² + 2βv,   v′ = (1 − β) v,   α′² ≥ 1.4 v′
    /// ```
    ///
    /// Compared with the mean over slopes for α = √v = 0.1, a mirror seen from 0° and 60° errs by 5
    /// % and 3 % of its peak. With unchanged α it errs by 12 % and 6 %, and for α = 0.02 by four
    /// times the peak. A pane keeps its width, because slopes do not deflect the light transmitted
    /// straight through it.
    fn widened(&self) -> (f32, f32) {
        let square = self.roughness * self.roughness;
        match self.slopes {
            Slopes::Gaussian(v) if v.is_finite() && square < GAPLESS * v && !self.is_pane() => {
                let taken = (GAPLESS * v - square) / (2.0 + GAPLESS);
                (sqrt(square + 2.0 * taken), v - taken)
            }
            Slopes::Gaussian(v) => (self.roughness, v),
            Slopes::Sine(_) => (self.roughness, 0.0),
        }
    }

    /// The uniforms of the coat in a shader, and the index of its kind in the order of the
    /// constructors.
    ///
    /// They are normal and slope variance; the maximum slope of a sine and Beckmann's α; color and
    /// relative index.
    pub(crate) fn parts(&self) -> ([Vec4; 3], u32) {
        let (variance, swing) = match self.slopes {
            Slopes::Gaussian(variance) => (variance, Vec3::ZERO),
            Slopes::Sine(swing) => (0.0, swing),
        };
        let (color, index, kind) = match self.behind {
            Behind::Clearcoat(fresnel) => (Vec3::ONE, fresnel.relative_index(), 0),
            Behind::ThinDielectric(fresnel, tint) => (tint, fresnel.relative_index(), 1),
            Behind::Dielectric(fresnel) => (Vec3::ONE, fresnel.relative_index(), 2),
            Behind::Conductor(color) => (color, 1.0, 3),
            Behind::Transparent(transmittance) => (transmittance, 1.0, 4),
        };
        ([self.normal.extend(variance), swing.extend(self.roughness), color.extend(index)], kind)
    }

    fn is_pane(&self) -> bool {
        matches!(self.behind, Behind::ThinDielectric(..))
    }

    /// The part of a smooth coat without the lobe of a rough one; `None` if it transmits.
    pub(super) fn smooth_part(&self) -> Option<LobePart> {
        match self.behind {
            Behind::Clearcoat(_) => Some(LobePart::Varnish(0.0)),
            Behind::Conductor(color) => Some(LobePart::Glossy(color, 0.0)),
            Behind::ThinDielectric(..) | Behind::Dielectric(_) | Behind::Transparent(_) => None,
        }
    }

    /// Whether it is rough, so that its lobe is a layer.
    pub(super) fn is_rough(&self) -> bool {
        self.roughness > 0.0
    }

    /// The lobe of a rough coat.
    pub(super) fn lobe<'a>(&self) -> Option<Lobe<'a>> {
        let (alpha, _) = self.widened();
        let facets = Beckmann::new_clamped(alpha, alpha);
        (self.roughness > 0.0).then_some(match self.behind {
            Behind::Clearcoat(fresnel) => CookTorrance::new(facets, fresnel).into(),
            Behind::Dielectric(fresnel) => RoughDielectric::new(facets, fresnel).into(),
            Behind::ThinDielectric(fresnel, tint) => RoughDielectric::thin(facets, fresnel, tint).into(),
            Behind::Conductor(color) => CookTorrance::new(facets, color).into(),
            Behind::Transparent(_) => Lobe::default(),
        })
    }

    /// Facets that represent its slopes.
    ///
    /// Three facets for a sine, at −√3/2, 0 and √3/2 of its amplitude, by Gauss–Chebyshev
    /// quadrature.
    pub(super) fn facets(&self) -> impl Iterator<Item = Facet> + use<> {
        let (_, variance) = self.widened();
        let (swing, share) = match self.slopes {
            Slopes::Gaussian(_) => (Vec3::ZERO, 1.0),
            Slopes::Sine(swing) => (0.866_025_4 * swing, 1.0 / 3.0),
        };
        let sine = swing != Vec3::ZERO && self.normal.z > 0.0;
        let share = if sine { share } else { 1.0 };
        let sides = if sine { [-1.0, 1.0].as_slice() } else { [].as_slice() };
        let slope = Vec3::Z - self.normal / self.normal.z;
        slope_facets(Vec3::Z, self.normal, variance).map(move |facet| facet.part(share)).chain(
            sides.iter().map(move |side| Facet::new(share, bumped_normal(Vec3::Z, slope + *side * swing))),
        )
    }

    /// Sets the normal and the slopes.
    pub(crate) fn with_slopes(self, normal: Vec3, slopes: Slopes) -> Self {
        Self { normal, slopes, ..self }
    }

    /// The fraction of light from one direction that reaches the layers.
    pub(super) fn through(&self, w: Vec3) -> f32 {
        match self.behind {
            Behind::Clearcoat(fresnel) => fresnel.transmittance(w.dot(self.normal)),
            _ => 1.0,
        }
    }

    /// The facet for a random number, rotated to be visible from `wo`.
    fn facet(&self, wo: Vec3, u: Vec2) -> Vec3 {
        let (x, y) = (clamp_to(u.x, 1.0), clamp_to(u.y, 1.0));
        let slope = match self.slopes {
            Slopes::Gaussian(variance) if variance > 0.0 => {
                let radius = sqrt(-2.0 * variance * ln_1p(-x.min(0.999_999)));
                Vec3::new(radius * cos(TAU * y), radius * sin(TAU * y), 0.0)
            }
            Slopes::Sine(swing) => swing * cos(TAU * x),
            Slopes::Gaussian(_) => Vec3::ZERO,
        };
        let rough = slope != Vec3::ZERO && self.normal.z > 0.0;
        let facet = if rough {
            bumped_normal(Vec3::Z, Vec3::Z - self.normal / self.normal.z + slope)
        } else {
            self.normal
        };
        flip_to_visible(Vec3::Z, facet, wo)
    }

    /// The approximate weight of specular samples; 0 only if it is 0 at every facet.
    pub(super) fn strength(&self, wo: Vec3) -> f32 {
        let opaque = |weight: Vec3| if wo.z > 0.0 { weight.max_element() } else { 0.0 };
        let smooth = match self.behind {
            Behind::Transparent(transmittance) => return clamp_to(transmittance.max_element(), 1.0),
            Behind::Clearcoat(fresnel) => opaque(fresnel.reflectance_rgb(wo.dot(self.normal))),
            Behind::Conductor(color) => opaque(color),
            Behind::ThinDielectric(..) | Behind::Dielectric(_) => 1.0,
        };
        if self.is_rough() { 0.0 } else { clamp_to(smooth, 1.0) }
    }

    /// Specular reflection and transmission, each with its fraction of the weight as probability.
    pub(super) fn samples(&self, wo: Vec3, u: Vec2) -> [Option<BsdfSample>; 2] {
        let [mirrored, transmitted] = self.deltas(wo, u);
        let all = mirrored.weight.max_element() + transmitted.weight.max_element();
        [
            (mirrored.wi, mirrored.weight, SampleKind::SpecularReflection),
            (transmitted.wi, transmitted.weight, SampleKind::SpecularTransmission),
        ]
        .map(|(wi, eval_cos, kind)| {
            let pdf = eval_cos.max_element() / all;
            (pdf > 0.0).then_some(BsdfSample { wi, eval_cos, pdf, kind })
        })
    }

    /// Reflection and transmission into `wo` of any length.
    ///
    /// A random point of the unit square selects the facet.
    fn deltas(&self, wo: Vec3, u: Vec2) -> [Delta; 2] {
        let dark = [Delta::default(); 2];
        // A vector that is unit to rounding is unchanged.
        let unit = (wo.length_squared() - 1.0).abs() < 1e-5;
        let Some(wo) = (if unit { Some(wo) } else { along(wo) }) else { return dark };
        if wo.z == 0.0 {
            return dark;
        }
        // From below everything is mirrored.
        let (side, inside) = (if wo.z < 0.0 { Vec3::new(1.0, 1.0, -1.0) } else { Vec3::ONE }, wo.z < 0.0);
        let up = wo * side;
        let turned = Self {
            normal: if inside { self.normal * Vec3::new(-1.0, -1.0, 1.0) } else { self.normal },
            ..*self
        };
        let m = turned.facet(up, u);
        let cosine = up.dot(m);
        let smooth = if self.roughness > 0.0 { 0.0 } else { 1.0 };
        // Light that a bump reflects into the surface is reflected out again.
        let bounced = reflect(up, m);
        let wi = bounced.with_z(bounced.z.abs()) * side;
        let mirrored = |share: Vec3| Delta { wi, weight: share * smooth };
        let straight = |share: Vec3| Delta { wi: -wo, weight: share.clamp(Vec3::ZERO, Vec3::ONE) };
        match self.behind {
            Behind::Clearcoat(fresnel) if !inside => {
                [mirrored(fresnel.reflectance_rgb(cosine)), Delta::default()]
            }
            Behind::Conductor(color) if !inside => {
                [mirrored(color.reflectance_rgb(cosine)), Delta::default()]
            }
            Behind::Clearcoat(_) | Behind::Conductor(_) => dark,
            Behind::Transparent(transmittance) => [Delta::default(), straight(transmittance)],
            Behind::ThinDielectric(fresnel, tint) => {
                let once = fresnel.reflectance(cosine);
                let both = 2.0 * once / (1.0 + once);
                let tint = through_wall(tint, cosine, fresnel.relative_index());
                [mirrored(Vec3::splat(both)), straight(tint * ((1.0 - both) * smooth))]
            }
            Behind::Dielectric(fresnel) => {
                let fresnel = if inside { fresnel.reversed() } else { fresnel };
                let (share, eta) = (fresnel.reflectance(cosine), 1.0 / fresnel.relative_index());
                // Snell: sin θ_t = sin θ_i/η.
                let below = 1.0 - eta * eta * (1.0 - cosine * cosine).max(0.0);
                let wi = (eta * cosine - sqrt(below.max(0.0))) * m - eta * up;
                let kept = if below > 0.0 && wi.z < 0.0 { (1.0 - share) * smooth } else { 0.0 };
                [mirrored(Vec3::splat(share)), Delta { wi: wi * side, weight: Vec3::splat(kept) }]
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn views_of_any_length_have_unit_deltas() {
        let glass = Dielectric::new(1.5).unwrap();
        let coats = [
            Coat::clearcoat(glass),
            Coat::thin_dielectric(glass, Vec3::ONE),
            Coat::dielectric(glass),
            Coat::conductor(Vec3::ONE),
        ];
        let coats = coats.map(|coat| coat.bumped(Vec3::new(0.28, 0.0, 0.96), 0.0));
        for wo in [Vec3::new(0.6, 0.0, 0.8), Vec3::new(0.0, 0.6, -0.8)] {
            for length in [f32::MIN_POSITIVE, 1e-20, 0.5, 3.0, 1e20, f32::MAX] {
                for coat in coats {
                    let [of_any, of_unit] = [length * wo, wo].map(|wo| coat.deltas(wo, Vec2::splat(0.5)));
                    for (any, unit) in of_any.into_iter().zip(of_unit) {
                        assert_abs_diff_eq!(any.wi, unit.wi, epsilon = 1e-6);
                        assert_abs_diff_eq!(any.weight, unit.weight, epsilon = 1e-6);
                        assert!(
                            unit.weight == Vec3::ZERO || (unit.wi.length() - 1.0).abs() < 1e-6,
                            "{unit:?}"
                        );
                    }
                }
            }
        }
        for wo in [Vec3::ZERO, Vec3::NAN, Vec3::INFINITY, Vec3::X] {
            assert_eq!(Coat::conductor(Vec3::ONE).deltas(wo, Vec2::ZERO), [Delta::default(); 2], "{wo}");
        }
    }

    #[test]
    fn parts_of_every_kind() {
        let (glass, red) = (Dielectric::new(1.5).unwrap(), Vec3::new(0.9, 0.2, 0.1));
        let normal = Vec3::new(0.28, 0.0, 0.96);
        let kinds = [
            (Coat::clearcoat(glass), Vec3::ONE, 1.5),
            (Coat::thin_dielectric(glass, red), red, 1.5),
            (Coat::dielectric(glass), Vec3::ONE, 1.5),
            (Coat::conductor(red), red, 1.0),
            (Coat::transparent(red), red, 1.0),
        ];
        for (number, (coat, color, index)) in (0..).zip(kinds) {
            let gaussian = coat.bumped(normal, 0.03).rough(0.4).parts();
            let [slopes, own] = [normal.extend(0.03), Vec3::ZERO.extend(0.4)];
            assert_eq!(gaussian, ([slopes, own, color.extend(index)], number));
            let sine = coat.with_slopes(normal, Slopes::Sine(Vec3::X)).parts();
            let [slopes, own] = [normal.extend(0.0), Vec3::X.extend(0.0)];
            assert_eq!(sine, ([slopes, own, color.extend(index)], number));
        }
    }
}
