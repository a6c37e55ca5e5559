//! Scratches: hashed grooves in the cells of a texture.

use asperity_ndf_sampling::Beckmann;
use asperity_noise::filtered_fraction;
use glam::{Vec2, Vec3};

use crate::bump::slope_facets::facets_along;
use crate::bump::{Facet, bumped_normal};
use crate::error::ShadingError;
use crate::material::interface::Material;
use crate::material::segment::Segments;
use crate::material::surface_point::SurfacePoint;
use crate::math::{clamp_to, exp_m1, floor, sqrt};
use crate::parameter::{as_roughness, as_share, as_size, color, direction_in_plane, parameters, range};
use crate::pixel::principal_axis::principal_axis;
use crate::reflectance::{Bsdf, CookTorrance};

parameters! {
    /// The parameters of [`Scratches`]. Lengths are in texture coordinates.
    pub struct ScratchesParameters of Scratches {
        /// The side of a cell, within `[10⁻⁶, 10⁶]`, the maximum length of scratches. Default 0.05.
        scratch_size: f32 = 0.05, as_size;
        /// The length of a scratch over the side of a cell, within `[0.01, 1]`. Default 1.
        scratch_length: f32 = 1.0, range([0.01, 1.0]);
        /// The width of a scratch over the side of a cell, within `[10⁻⁴, 0.5]`. Default 0.01.
        scratch_width: f32 = 0.01, range([1e-4, 0.5]);
        /// The depth of a scratch over half its width, within `[0, 1]`. Default 0.5.
        scratch_strength: f32 = 0.5, as_share;
        /// The mean number of scratches per cell, within `[0, 4]`. Default 2.
        scratch_cover: f32 = 2.0, range([0.0, 4.0]);
        /// The mean direction. Default (1, 0).
        scratch_direction: Vec2 = Vec2::X;
        /// Spread around the direction: 0 is parallel, 1 all directions. Default 1.
        scratch_spread: f32 = 1.0, as_share;
        /// The specular color of the metal. Default 0.7.
        specular: Vec3 = Vec3::splat(0.7), color;
        /// The roughness of the metal: Beckmann's α, within `[0.01, 1]`. Default 0.3.
        roughness: f32 = 0.3, as_roughness;
        /// Random seed.
        seed: u32 = 1;
    }
}

/// Scratches: grooves with midpoints, directions and presence from hashes of the cell.
///
/// ```text
/// amount = Σ (1 − (d/W)²)² (1 − t²) w/W,   |d| < W, |t| < 1,   W² = w² + (footprint/2)²
/// height = −strength · w · amount
/// ```
///
/// with d across a scratch, t along it from −1 to 1, and w half its width. The steepest slope is
/// 1.54 times the strength.
///
/// # Level of detail
///
/// A pixel wider than a scratch sees a wider and shallower scratch, so that the mean amount is the
/// same at every footprint, and in closed form: [`mean`](Self::mean). Where a pixel becomes as wide
/// as a cell, the amount fades to the mean. The mean square slope is in closed form as well. The
/// part removed by the footprint becomes facets of the [`Bsdf`].
///
/// Nilsson 2008, §6.2, describes the problem and leaves it open.
///
/// ```
/// use asperity_shading::glam::{Vec2, Vec3};
/// use asperity_shading::{Footprint, Material, Scratches, ScratchesParameters, SurfacePoint};
///
/// let scratches = Scratches::new(ScratchesParameters::default())?;
/// let point = SurfacePoint::new(Vec3::ZERO, Vec3::Z, Footprint::from_width(1.0))
///     .with_uv(Vec2::new(0.3, 0.2), [Vec3::X, Vec3::Y]);
/// let elsewhere = SurfacePoint { uv: Vec2::new(7.3, -1.8), ..point };
/// let seen = |point| scratches.bsdf(point, Vec3::Z).eval_cos(Vec3::Z, Vec3::Z);
/// assert_eq!(seen(&point), seen(&elsewhere));
/// # Ok::<(), asperity_shading::ShadingError>(())
/// ```
#[doc(alias = "wear")]
#[doc(alias = "brushed")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scratches {
    parameters: ScratchesParameters,
    segments: Segments,
    /// Half the width of a scratch.
    half: f32,
}

/// Scratches as seen by a pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
struct ScratchedSurface {
    /// The unit normal.
    normal: Vec3,
    /// The fraction of the pixel that is scratched, which has all of that variance.
    ///
    /// Its mean is the same at every footprint: 1 − e^(−λ), where λ is the area of all scratches
    /// per area.
    covered: f32,
    /// The standard deviations of its slope along their two principal directions.
    axes: [Vec3; 2],
}

/// The fraction of the facet in the middle of a groove.
///
/// Slopes across it have a kurtosis of 1.5 to 2.1, compared with 3 for a Gaussian.
const FLOOR: f32 = 0.2;

impl ScratchedSurface {
    /// Facets for the slopes removed by the footprint, on a surface of unit normal `n`.
    ///
    /// Each has a fraction and a unit normal.
    ///
    /// The smooth fraction of the surface, usually most of it, has one facet. The scratched
    /// fraction has seven, across its grooves.
    fn facets(&self, n: Vec3) -> impl Iterator<Item = Facet> + use<> {
        let Self { normal, covered, axes, .. } = *self;
        let smooth = (covered < 1.0).then_some(Facet::new(1.0 - covered, normal));
        let grooves = (covered > 0.0).then(|| facets_along(n, normal, axes, FLOOR));
        smooth.into_iter().chain(grooves.into_iter().flatten().map(move |facet| facet.part(covered)))
    }
}

/// Scratches at a point of the texture.
struct Grooves {
    amount: f32,
    slope: Vec2,
    /// The fraction of the pixel inside one or more grooves.
    covered: f32,
    /// The second moments of the slopes that the pixel does not resolve: uu, uv, vv.
    removed: Vec3,
}

impl Scratches {
    /// Creates scratches from these parameters.
    ///
    /// # Errors
    /// [`ShadingError`] with the first parameter that is out of its range, or for a
    /// `scratch_direction` that is zero or not finite.
    pub fn new(parameters: ScratchesParameters) -> Result<Self, ShadingError> {
        parameters.check()?;
        let (p, cell) = (&parameters, parameters.scratch_size);
        let segments = Segments {
            cell,
            length: cell * p.scratch_length,
            cover: p.scratch_cover,
            direction: direction_in_plane("scratch_direction", p.scratch_direction)?,
            spread: p.scratch_spread,
            seed: p.seed,
        };
        Ok(Self { segments, half: 0.5 * cell * p.scratch_width, parameters })
    }

    /// The mean amount over the surface, at every footprint.
    ///
    /// ```text
    /// density · 16/15 w · 2/3 length
    /// ```
    #[must_use]
    pub fn mean(&self) -> f32 {
        self.segments.density() * (16.0 / 15.0) * self.half * (2.0 / 3.0) * self.segments.length
    }

    /// The fraction covered by scratches from afar, and the mean square slopes across: uu, uv, vv.
    pub(crate) fn far(&self) -> (f32, Vec3) {
        (
            -exp_m1(-self.segments.density() * 2.0 * self.half * self.segments.length),
            self.mean_square_slope(self.half) * self.segments.mean_square_across(),
        )
    }

    /// The segments of the scratches.
    pub(crate) const fn segments(&self) -> &Segments {
        &self.segments
    }

    /// Half the width of a scratch, in texture coordinates.
    pub(crate) const fn half_width(&self) -> f32 {
        self.half
    }

    /// The mean square slope of grooves of this half width: density · strength² w⁴/W³ · 256/105 ·
    /// 8/15 length.
    fn mean_square_slope(&self, wide: f32) -> f32 {
        let (strength, ratio) = (self.parameters.scratch_strength, self.half / wide);
        let across = strength * strength * self.half * ratio * ratio * ratio * (256.0 / 105.0);
        self.segments.density() * across * (8.0 / 15.0) * self.segments.length
    }

    /// The amount at a point of the texture, and the slope of the height.
    ///
    /// The pixel has this width in texture coordinates.
    ///
    /// The mean without slope where a coordinate is not finite or beyond 2²³ cells.
    fn grooves(&self, uv: Vec2, width: f32) -> Grooves {
        let kept = 1.0 - filtered_fraction(width, 1.0 / self.segments.cell);
        let (covered, removed) = self.far();
        let far = Grooves { amount: self.mean(), slope: Vec2::ZERO, covered, removed };
        if kept <= 0.0 || !uv.is_finite() {
            return far;
        }
        let (wide, mut bare) = (self.wide(width), 1.0);
        let shallow = self.half / wide;
        let mut near = Grooves { amount: 0.0, slope: Vec2::ZERO, covered: 0.0, removed: Vec3::ZERO };
        // The part of all squares of slopes across that a groove of this width lacks, as far as it
        // concerns this pixel.
        let strength = self.parameters.scratch_strength;
        let lost = (1.0 - kept * shallow * shallow * shallow) * strength * strength * (128.0 / 105.0);
        // Wider than `wide`, the root of the squares, and as far as its own width overlaps the
        // pixel.
        let aside = self.half + 0.5 * width;
        self.segments.visit(uv, aside, |groove| {
            let (s, t) = (groove.across / wide, groove.along);
            let (side, taper) = (1.0 - s * s, 1.0 - t * t);
            if taper > 0.0 {
                bare *= 1.0 - overlap(groove.across, self.half, width);
            }
            if side > 0.0 && taper > 0.0 {
                near.amount += side * side * taper * shallow;
                // d/ds and d/dt, over the width and half the length.
                let across = groove.direction.perp();
                let by_across = -4.0 * s * side * taper / wide;
                let by_along = side * side * -2.0 * t / (0.5 * self.segments.length);
                near.slope += (across * by_across + groove.direction * by_along) * shallow;
                // The width of the widened groove.
                let spread = side * side * shallow * (15.0 / 8.0);
                near.removed += Vec3::new(across.x * across.x, across.x * across.y, across.y * across.y)
                    * (lost * spread * taper * taper);
            }
        });
        near.covered = 1.0 - bare;
        let depth = strength * self.half;
        Grooves {
            amount: far.amount + kept * (near.amount - far.amount),
            slope: near.slope * (-depth * kept),
            covered: far.covered + kept * (near.covered - far.covered),
            removed: far.removed + kept * (near.removed - far.removed),
        }
    }

    fn wide(&self, width: f32) -> f32 {
        sqrt(self.half * self.half + 0.25 * width * width)
    }

    /// Normal and unresolved slopes at a pixel; accepts every input.
    fn surface(&self, point: &SurfacePoint) -> ScratchedSurface {
        let texture = point.texture();
        let Grooves { slope, covered, removed, .. } = self.grooves(point.uv, texture.width(&point.pixel));
        // A slope in the texture is a slope on the surface, regardless of the scale of the texture.
        let on_surface = |slope: Vec2| texture.of(slope).normalize_or_zero() * slope.length();
        let axes = if covered > 0.0 { principal(removed / covered) } else { [Vec2::ZERO; 2] };
        ScratchedSurface {
            normal: bumped_normal(point.normal, on_surface(slope)),
            covered,
            axes: axes.map(on_surface),
        }
    }
}

impl Material for Scratches {
    fn bsdf(&self, point: &SurfacePoint, wo: Vec3) -> Bsdf<'_> {
        let (p, frame) = (&self.parameters, point.frame());
        let facets = self.surface(point).facets(point.normal);
        let metal = CookTorrance::new(Beckmann::new_clamped(p.roughness, p.roughness), p.specular);
        let local = facets.map(|facet| Facet { normal: frame.to_local(facet.normal), ..facet });
        let mut bsdf = Bsdf::new(frame, wo);
        bsdf.add_layer(local, [metal.into()]);
        bsdf
    }

    fn height(&self, point: &SurfacePoint) -> f32 {
        let width = point.texture().width(&point.pixel);
        -self.parameters.scratch_strength * self.half * self.grooves(point.uv, width).amount
    }

    fn height_range(&self) -> Option<[f32; 2]> {
        // The maximum number per cell, and its neighbors.
        let most = 9.0 * (floor(self.segments.cover) + 1.0);
        Some([-self.parameters.scratch_strength * self.half * most, 0.0])
    }
}

/// The fraction of [d − width/2, d + width/2] inside [−half, half].
fn overlap(d: f32, half: f32, width: f32) -> f32 {
    if width > 1e-4 * half {
        let (low, high) = ((d - 0.5 * width).max(-half), (d + 0.5 * width).min(half));
        clamp_to((high - low) / width, 1.0)
    } else if d.abs() < half {
        1.0
    } else {
        0.0
    }
}

/// The principal axes of second moments (xx, xy, yy), with the standard deviations as lengths.
fn principal(moments: Vec3) -> [Vec2; 2] {
    let middle = 0.5 * (moments.x + moments.z);
    let (first, apart) = principal_axis(moments.to_array());
    [first * sqrt(middle + apart), first.perp() * sqrt((middle - apart).max(0.0))]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pixel::Footprint;
    use approx::assert_relative_eq;
    use asperity_core::assert_abs_diff_eq;

    fn wide() -> Scratches {
        Scratches::new(ScratchesParameters { scratch_width: 0.1, scratch_cover: 1.5, ..Default::default() })
            .unwrap()
    }

    #[test]
    fn scratch_slopes_match_finite_differences() {
        let scratches = wide();
        let h = 1e-5;
        let depth = scratches.parameters.scratch_strength * scratches.half;
        let mut steep = 0;
        for i in 0..2000_u16 {
            let uv = Vec2::new(f32::from(i % 50) * 0.0107, f32::from(i / 50) * 0.0131);
            let Grooves { slope, .. } = scratches.grooves(uv, 0.004);
            let height = |du, dv| -depth * scratches.grooves(uv + Vec2::new(du, dv), 0.004).amount;
            let difference =
                Vec2::new(height(h, 0.0) - height(-h, 0.0), height(0.0, h) - height(0.0, -h)) / (2.0 * h);
            // Ends of scratches have a crease along; rounding of positions 0.5 · 6e-8 · slope/h.
            assert_abs_diff_eq!(slope, difference, epsilon = 0.03, "{uv}");
            steep += u16::from(slope.length() > 0.1);
        }
        assert!(steep > 100, "{steep}");
    }

    #[test]
    fn amount_and_slope_have_the_stated_means() {
        let scratches = wide();
        let cell = scratches.segments.cell;
        let point = |uv| {
            SurfacePoint::new(Vec3::ZERO, Vec3::Z, Footprint::from_width(0.0)).with_uv(uv, [Vec3::X, Vec3::Y])
        };
        let mut random = 1_u32;
        let mut uniform = || {
            random = random.wrapping_mul(747_796_405).wrapping_add(2_891_336_453);
            (random >> 8) as f32 / 16_777_216.0
        };
        for width in [0.0, 0.05 * cell, 0.15 * cell, 0.4 * cell] {
            let (mut amount, mut squares, mut removed, mut covered) = (0.0, 0.0, 0.0, 0.0);
            for _ in 0..20_000 {
                let at = Vec2::new(uniform(), uniform()) * 1000.0 * cell;
                let grooves = scratches.grooves(at, width);
                amount += grooves.amount;
                squares += grooves.slope.length_squared();
                removed += grooves.removed.x + grooves.removed.z;
                let seen = SurfacePoint { pixel: Footprint::from_width(width).into(), ..point(at) };
                covered += scratches.surface(&seen).covered;
            }
            let kept = 1.0 - filtered_fraction(width, 1.0 / cell);
            // Standard deviations are about twice and four times the means: five standard errors,
            // and the slopes of the tapers.
            assert_abs_diff_eq!(amount / 20_000.0 / scratches.mean(), 1.0, epsilon = 0.07, "{width}");
            let expected = scratches.mean_square_slope(scratches.wide(width)) * kept * kept;
            assert_abs_diff_eq!(squares / 20_000.0 / expected, 1.0, epsilon = 0.15, "{width}");
            // The rest is unresolved, and the scratched fraction is that of the far view.
            let whole = scratches.mean_square_slope(scratches.half);
            let rest = (removed / 20_000.0 + expected) / whole;
            assert_abs_diff_eq!(rest, 1.0, epsilon = 0.1, "{width}");
            // Four standard errors of Bernoulli variables, and 1 % because the numbers of scratches
            // are not Poisson distributed.
            let far = SurfacePoint { pixel: Footprint::from_width(10.0 * cell).into(), ..point(Vec2::ZERO) };
            let far = scratches.surface(&far).covered;
            assert_abs_diff_eq!(covered / 20_000.0 / far, 1.0, epsilon = 0.08, "{width}");
        }
    }

    #[test]
    fn facets_have_the_variance_of_the_pixel() {
        let scratches = wide();
        for (x, width) in [(0.3, 0.004), (0.31, 0.02), (0.37, 0.05), (0.4, 1.0)] {
            let point = SurfacePoint::new(Vec3::ZERO, Vec3::Z, Footprint::from_width(width))
                .with_uv(Vec2::new(x, 0.2), [Vec3::X, Vec3::Y]);
            let surface = scratches.surface(&point);
            let slope = |m: Vec3| Vec3::Z - m / m.z;
            let (mut shares, mut squares) = (0.0, 0.0);
            for Facet { weight: share, normal: m } in surface.facets(Vec3::Z) {
                shares += share;
                squares += share * (slope(m) - slope(surface.normal)).length_squared();
            }
            assert_abs_diff_eq!(shares, 1.0, epsilon = 1e-5, "{x}, {width}");
            let Grooves { removed, .. } = scratches.grooves(point.uv, width);
            assert_relative_eq!(squares, removed.x + removed.z, epsilon = 1e-5, max_relative = 1e-3);
        }
    }
}
