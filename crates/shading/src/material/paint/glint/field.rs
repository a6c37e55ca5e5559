//! Flakes with any NDF: their density in a pixel, and its samples.

use core::f32::consts::FRAC_PI_3;

use asperity_ndf_sampling::{Frame, Ndf, inverse_gaussian_cdf};
use asperity_noise::{IntegerHash, Lattice};
use glam::{Vec2, Vec3};

use super::axis::{Axis, Bin};
use super::counts::Flakes;
use super::flakes::{GlintFlake, corners, nearest};
use crate::error::ShadingError;
use crate::math::{clamp_to, cos, floor, log2, sin, sqrt};
use crate::parameter::{as_size, within};
use crate::pixel::{Footprint, PixelEllipse};
use crate::reflectance::lobe::CountedFacets;

/// Mirror-like flakes with any NDF, single up close and counted from afar.
///
/// A pixel of width w sees about (w/spacing)² flakes. A flake mirrors the light into the pixel if
/// its Gaussian coordinates T⁻¹(m) are in the bin of the half vector:
///
/// ```text
/// D̂(h) = D(h) Σ_bins w(h, bin) c(bin)/q(bin),     q(bin) = ∫ N(z; 0, I) w(z, bin) dz,   Σ w = 1
/// c(bin) = Σ_corners w(corner) count(corner, bin)/4ˡ,     Σ_bins c = 1
/// ```
///
/// The position is in a tetrahedron of a lattice with 2ˡ spacings between its corners, each with 4ˡ
/// flakes. The range of their tilts is bisected until a bin is reached, and a hash draws how many
/// flakes are in either half: binomial numbers, whose mean is 4ˡ q. Two levels are blended by the
/// logarithm of the width. A pixel up to 1.6 spacings wide sees the flake at its center, with the
/// normal that [`flake`](Self::flake) returns.
///
/// - **Energy:** the mean of D̂(h) over the surface is D(h), at every width and for every NDF. Within
///   each pixel D̂ is an NDF: `∫ D̂(h) cos θ dω = 1`.
/// - **Sampling:** [`sample`](Self::sample) draws normals with the density D̂, for example to find the
///   light that the flakes of a pixel mirror from an environment.
/// - **Far view:** the variance decreases as 1/N. From 13,000 to 26,000 spacings D̂ is blended into D.
/// - **Near view:** more flakes become visible as single ones as a pixel sees fewer of them, until
///   they cover the surface.
/// - **Motion:** D̂ is continuous in the position, the pixel, the light and h, except at the borders of
///   single flakes. A corner of a coarse lattice is a corner of all finer ones, where it has some of
///   the same flakes.
/// - **Pixels and lights:** [`density`](Self::density) for round pixels and point lights,
///   [`density_over`](Self::density_over) for elongated pixels and lights with a solid angle.
/// - **Domain:** half vectors in the frame of the surface. The result is D where the position is
///   2²³ spacings away or not finite, and for widths beyond 26,000 spacings; 0 where D is 0.
///
/// Proposed in Nilsson 2008, §6.3. Bins and binomial counts after Deliot, Belcour 2023, *Real-Time
/// Rendering of Glinty Appearances using Distributed Binomial Laws on Anisotropic Grids*. Here they
/// are in the Gaussian coordinates of the NDF instead of slopes, so any NDF is supported and the
/// mean is exact, and a tree of bins can be sampled. Kemppinen, Paulin, Thonat, Thiery, Nivoliers,
/// Boubekeur 2025, *Evaluating and Sampling Glinty NDFs in Constant Time*, sample glints by other
/// means.
///
/// ```
/// use asperity_shading::material::GlintField;
/// use asperity_shading::{Beckmann, Footprint, Ndf, glam::Vec3};
///
/// let ndf = Beckmann::new(0.3, 0.3)?;
/// let flakes = GlintField::new(ndf, 1e-4, 0.1, 7)?;
/// let h = Vec3::new(0.1, 0.2, 1.0).normalize();
/// let afar = flakes.density(h, Vec3::new(0.3, 0.1, 0.2), Footprint::from_width(1.0));
/// assert!((afar / ndf.d(h) - 1.0).abs() < 0.02);
/// # Ok::<(), Box<dyn core::error::Error>>(())
/// ```
#[doc(alias = "glitter")]
#[doc(alias = "sparkle")]
#[doc(alias = "glints")]
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GlintField<N> {
    ndf: N,
    spacing: f32,
    bin: f32,
    seed: u32,
}

/// The level that is smooth: its lattice points would have 2²⁸ flakes.
const LEVELS: f32 = 14.0;
/// The distance of lattice points over the width of a pixel: √E[Σ w²] of the weights of four
/// corners, with which a pixel sees as many flakes as one that counts a single point.
const OVERLAP: f32 = 0.632_455_5;
/// The largest ratio of the axes of a pixel.
const LONGEST: f32 = 16.0;
/// Largest coordinate at which cells can be distinguished.
const FARTHEST: f32 = 8_388_608.0;

/// A part of the flakes that a pixel sees.
#[derive(Clone, Copy)]
enum Part {
    /// More than are counted.
    Smooth,
    /// A single flake with these Gaussian coordinates.
    Single(Vec2),
    Counted(Flakes),
}

impl<N> GlintField<N> {
    /// Offsets of the seeds of the two tilt coordinates from the seed of the field.
    pub(crate) const TILTS: [u32; 2] = [0x51ab_0f31, 0xa3c7_59e5];
}

impl<N: Ndf> GlintField<N> {
    /// Creates flakes `spacing` apart that mirror a light over `bin` standard deviations of their
    /// tilt.
    ///
    /// The bin represents the size of the light and the roughness of the flakes. A smaller bin has
    /// fewer and brighter lit flakes.
    ///
    /// # Errors
    /// [`ShadingError::OutOfRange`] unless `flake_spacing` is within `[10⁻⁶, 10⁶]` and `flake_bin`
    /// within `[0.001, 1]`.
    pub fn new(ndf: N, spacing: f32, bin: f32, seed: u32) -> Result<Self, ShadingError> {
        let spacing = as_size("flake_spacing", spacing)?;
        Ok(Self { ndf, spacing, bin: within("flake_bin", bin, [0.001, 1.0])?, seed })
    }

    /// The NDF of all flakes.
    #[must_use]
    pub const fn ndf(&self) -> &N {
        &self.ndf
    }

    /// The distance between flakes and the bin in standard deviations; the seed.
    pub(crate) const fn parts(&self) -> ([f32; 2], u32) {
        ([self.spacing, self.bin], self.seed)
    }

    /// The flake at a point: the nearest jittered center, one per cell.
    ///
    /// `None` where cells cannot be distinguished or a coordinate is not finite. Centers are within
    /// a quarter of a cell of the center of the cell.
    #[must_use]
    pub fn flake(&self, position: Vec3) -> Option<GlintFlake> {
        let (cell, center) = nearest(self.place(position)?, self.seed);
        Some(GlintFlake { normal: self.ndf.warp_gaussian(self.tilt(cell)), center: center * self.spacing })
    }

    /// The density D̂(h) of the flakes within a pixel, in sr⁻¹, which replaces D(h).
    ///
    /// Finite for an `h` of any length.
    #[must_use]
    pub fn density(&self, h: Vec3, position: Vec3, footprint: Footprint) -> f32 {
        self.density_over(h, 0.0, position, &footprint.into())
    }

    /// The density D̂ of the flakes within an elongated pixel that mirror a light of some size, in
    /// sr⁻¹.
    ///
    /// ```text
    /// D̂ = D̄ Σ_k w_k c_k/q / Σ_k w_k,         D̄: the mean of D over the half vectors of the light
    /// w_k = clamp((r + 1)/2 − |k|, 0, 1),     r: ratio of the axes of the pixel
    /// ```
    ///
    /// The pixel is the sum of round ones along its long axis, so it sees the flakes of all of them.
    /// A light wider than a bin mirrors all flakes of joined bins; two sizes of bins are blended.
    ///
    /// - **`spread`:** the angular radius of the half vectors in radians, 0 for a point light. A light
    ///   of the radius ρ has `spread ≈ ρ/(2 √(ωo·h))`, because `dω_h = dω_i/(4 ωo·h)`. It is clamped
    ///   to `[0, 1]`; NaN is read as 0.
    /// - **Energy:** the mean over the surface is D̄, for every pixel and light. D̄ is evaluated at
    ///   seven half vectors, exact for cubic functions of the plane around `h`.
    /// - **Limits:** for a round pixel and a point light it is [`density`](Self::density), bit for bit.
    ///   Pixels longer than 16 times their width are as wide as a 16th of their length.
    ///
    /// Light with a solid angle after Kneiphof, Klein 2024, *Real-Time Rendering of Glints in the
    /// Presence of Area Lights*, who count the flakes whose mirrored direction hits the light.
    ///
    /// ```
    /// use asperity_shading::material::GlintField;
    /// use asperity_shading::{Beckmann, Ndf, PixelEllipse, glam::Vec3};
    ///
    /// let ndf = Beckmann::new(0.3, 0.3)?;
    /// let flakes = GlintField::new(ndf, 1e-4, 0.1, 7)?;
    /// let h = Vec3::new(0.1, 0.2, 1.0).normalize();
    /// let pixel = PixelEllipse::from_derivatives(0.1 * Vec3::X, 1.6 * Vec3::Y);
    /// let afar = flakes.density_over(h, 0.05, Vec3::new(0.3, 0.1, 0.2), &pixel);
    /// assert!((afar / ndf.d(h) - 1.0).abs() < 0.05);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    #[must_use]
    pub fn density_over(&self, h: Vec3, spread: f32, position: Vec3, pixel: &PixelEllipse) -> f32 {
        let spread = clamp_to(spread, 1.0);
        let density = self.mean_density(h, spread);
        if density.is_nan() || density <= 0.0 {
            return 0.0;
        }
        let (z, bins) = (self.ndf.invert(h), Axis::new(self.bin));
        // How often bins are joined for the light, by the logarithm.
        let joined = log2((self.light_width(h, spread) / self.bin).max(1.0)).min(bins.splits() as f32);
        let (lower, upper_share) = (floor(joined), joined - floor(joined));
        let mut relative = self.relative(&bins.joined(lower as usize), z, position, pixel);
        if upper_share > 0.0 {
            let wider = self.relative(&bins.joined(lower as usize + 1), z, position, pixel);
            relative += upper_share * (wider - relative);
        }
        // Both factors are large only where h is not a unit vector.
        (density * relative).min(f32::MAX)
    }

    /// A normal of the flakes within a pixel, with the density `D̂(m) cos θ` in sr⁻¹.
    ///
    /// The density of a sample is `m.z` times [`density_over`](Self::density_over) for a point light.
    /// The light that the flakes of a pixel mirror from an environment is the mean over samples of
    /// `L(ωi) F G ωo·m/(ωo.z m.z)`, ωi being ωo mirrored at m. Uniform numbers outside `[0, 1)` are
    /// clamped.
    ///
    /// ```
    /// use asperity_shading::material::GlintField;
    /// use asperity_shading::{Beckmann, Footprint, glam::{Vec2, Vec3}};
    ///
    /// // Close up all samples are near the normal of the only flake.
    /// let flakes = GlintField::new(Beckmann::new(0.3, 0.3)?, 1e-2, 0.05, 7)?;
    /// let (p, pixel) = (Vec3::new(0.3, 0.1, 0.2), Footprint::from_width(1e-3));
    /// let m = flakes.sample(Vec2::new(0.7, 0.2), p, &pixel.into());
    /// assert!(m.dot(flakes.flake(p).unwrap().normal) > 0.99);
    /// # Ok::<(), Box<dyn core::error::Error>>(())
    /// ```
    #[must_use]
    pub fn sample(&self, u: Vec2, position: Vec3, pixel: &PixelEllipse) -> Vec3 {
        let [mut u, mut v] = u.to_array().map(|u| clamp_to(u, 0.999_999_94));
        let (mut chosen, mut left, mut rest) = (Part::Smooth, u, [0.0, 1.0]);
        // The part in which the first number falls.
        self.parts_of(position, pixel, |weight, part| {
            if left >= 0.0 && weight > 0.0 {
                (chosen, rest) = (part, [left, weight]);
            }
            left -= weight;
        });
        u = clamp_to(rest[0] / rest[1], 0.999_999_94);
        let axis = Axis::new(self.bin);
        let z = match chosen {
            Part::Smooth => Vec2::from([u, v].map(gaussian)),
            Part::Single(tilt) => {
                Vec2::new(axis.sample(axis.index(tilt.x), u), axis.sample(axis.index(tilt.y), v))
            }
            Part::Counted(flakes) => {
                let [x, y] = flakes.sample(&axis, [&mut u, &mut v]);
                Vec2::new(axis.sample(x, u), axis.sample(y, v))
            }
        };
        self.ndf.warp_gaussian(z)
    }

    /// D̄ of half vectors within an angular radius.
    fn mean_density(&self, h: Vec3, spread: f32) -> f32 {
        let center = self.ndf.d(h);
        if spread <= 0.0 {
            return center;
        }
        let (frame, radius) = (Frame::from_normal(h), 0.816_496_6 * spread);
        let at = |k: u8| {
            let turn = FRAC_PI_3 * f32::from(k);
            let aside = radius * (cos(turn) * frame.tangent + sin(turn) * frame.bitangent);
            self.ndf.d((h + aside).normalize_or_zero())
        };
        0.25 * center + 0.125 * (0..6).map(at).sum::<f32>()
    }

    /// The width of a light in Gaussian coordinates: twice the geometric mean of its radii.
    ///
    /// `spread` is the angular radius of its half vectors around `h` in radians. Shaders take it in
    /// place of the spread. 0 for a point light.
    #[must_use]
    pub fn light_width(&self, h: Vec3, spread: f32) -> f32 {
        let spread = clamp_to(spread, 1.0);
        if spread <= 0.0 {
            return 0.0;
        }
        let (frame, z) = (Frame::from_normal(h), self.ndf.invert(h));
        // Towards the normal, where there are half vectors above the horizon.
        let inward = |axis: Vec3| if axis.z > 0.0 { axis } else { -axis };
        let [u, v] = [frame.tangent, frame.bitangent]
            .map(|axis| self.ndf.invert((h + spread * inward(axis)).normalize_or_zero()) - z);
        let area = u.perp_dot(v).abs();
        if area.is_finite() { 2.0 * sqrt(area) } else { 0.0 }
    }

    /// D̂/D at these Gaussian coordinates.
    fn relative(&self, axis: &Axis, z: Vec2, position: Vec3, pixel: &PixelEllipse) -> f32 {
        if axis.splits() == 0 {
            return 1.0;
        }
        let counted = self.level(pixel.long().width()) > 0.0;
        let bins = z.to_array().map(|z| axis.bins(z, counted));
        let mut sum = 0.0;
        self.parts_of(position, pixel, |weight, part| {
            if weight > 0.0 {
                sum += weight * relative_to_mean(part, axis, &bins);
            }
        });
        sum
    }

    /// Visits the parts of the flakes within a pixel with their weights, whose sum is 1.
    fn parts_of(&self, position: Vec3, pixel: &PixelEllipse, mut visit: impl FnMut(f32, Part)) {
        let ([major, _], long, short) = (pixel.axes(), pixel.long().width(), pixel.short().width());
        let width = short.max(long / LONGEST);
        let ratio = long / width;
        // A pixel without axes or bounds is one round pixel.
        if ratio.is_nan() || ratio <= 1.0 || major == Vec3::ZERO || !major.is_finite() {
            return self.parts_at(position, long, 1.0, &mut visit);
        }
        let (step, weight) =
            (major / ratio, |k: i8| (0.5 * (ratio + 1.0) - f32::from(k.abs())).clamp(0.0, 1.0));
        let total: f32 = (-8..=8).map(weight).sum();
        for k in (-8..=8).filter(|&k| weight(k) > 0.0) {
            self.parts_at(position + f32::from(k) * step, width, weight(k) / total, &mut visit);
        }
    }

    /// The same for a round pixel of this weight.
    fn parts_at(&self, position: Vec3, width: f32, weight: f32, visit: &mut impl FnMut(f32, Part)) {
        let level = self.level(width);
        let Some(place) = self.place(position).filter(|_| level < LEVELS) else {
            return visit(weight, Part::Smooth);
        };
        let upper_share = level - floor(level);
        for (level, share) in [(floor(level), 1.0 - upper_share), (floor(level) + 1.0, upper_share)] {
            if share <= 0.0 {
                continue;
            }
            if level >= LEVELS {
                visit(weight * share, Part::Smooth);
            } else if level == 0.0 {
                visit(weight * share, Part::Single(self.tilt(nearest(place, self.seed).0)));
            } else {
                for (corner, flakes) in corners(place, level as u32, self.seed) {
                    visit(weight * share * corner, Part::Counted(flakes));
                }
            }
        }
    }

    /// The level of the lattice that a round pixel sees; 0 shows single flakes.
    fn level(&self, width: f32) -> f32 {
        log2((OVERLAP * width / self.spacing).max(1.0))
    }

    /// The Gaussian coordinates of the normal of the flake of a cell.
    fn tilt(&self, cell: [i32; 3]) -> Vec2 {
        let uniform = |k: u32| (f64::from(IntegerHash.word(cell, self.seed ^ k)) + 0.5) / 4_294_967_296.0;
        Vec2::new(
            inverse_gaussian_cdf(uniform(Self::TILTS[0])) as f32,
            inverse_gaussian_cdf(uniform(Self::TILTS[1])) as f32,
        )
    }

    /// The position in cells of single flakes, where they can be distinguished.
    fn place(&self, position: Vec3) -> Option<Vec3> {
        let place = position / self.spacing;
        // Written so that NaN returns `None`.
        (place.abs().max_element() < FARTHEST && !place.is_nan()).then_some(place)
    }
}

/// Σ w c/q over the bins at a coordinate.
fn relative_to_mean(part: Part, axis: &Axis, [x, y]: &[[Bin; 2]; 2]) -> f32 {
    let mut sum = 0.0;
    for x in x.iter().filter(|x| x.weight > 0.0) {
        for y in y.iter().filter(|y| y.weight > 0.0) {
            let fraction = match part {
                Part::Smooth => return 1.0,
                Part::Single(tilt) => {
                    let same = axis.index(tilt.x) == x.index() && axis.index(tilt.y) == y.index();
                    f32::from(u8::from(same))
                }
                Part::Counted(flakes) => flakes.fraction(x, y, axis.splits()),
            };
            if fraction > 0.0 {
                sum += x.weight * y.weight * fraction / (x.mass * y.mass).max(f32::MIN_POSITIVE);
            }
        }
    }
    sum
}

fn gaussian(u: f32) -> f32 {
    inverse_gaussian_cdf(f64::from(u.max(1e-8))) as f32
}

impl<N: Ndf> CountedFacets for GlintField<N> {
    fn density(&self, h: Vec3, position: Vec3, pixel: &PixelEllipse) -> f32 {
        self.density_over(h, 0.0, position, pixel)
    }

    fn relative(&self, h: Vec3, position: Vec3, pixel: &PixelEllipse) -> f32 {
        let all = self.ndf.d(h);
        if all > 0.0 { self.density_over(h, 0.0, position, pixel) / all } else { 0.0 }
    }

    fn sample(&self, u: Vec2, position: Vec3, pixel: &PixelEllipse) -> Vec3 {
        self.sample(u, position, pixel)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_ndf_sampling::{Beckmann, Ggx};

    #[test]
    fn density_is_finite_for_vectors_of_any_length() {
        let field = GlintField::new(Beckmann::new_clamped(0.3, 0.3), 1_208.794_2, 0.756_862_7, 3_250_700_737);
        let (field, tiny) = (field.unwrap(), 3e-45);
        let at = Vec3::new(-16_777_213.0, tiny, tiny);
        let density = field.density(Vec3::new(tiny, -1e-45, tiny), at, Footprint::from_width(tiny));
        assert!(density > 1e38 && density.is_finite(), "{density}");
    }

    #[test]
    fn density_is_nonzero_where_the_flake_mirrors() {
        let field = GlintField::new(Ggx::new(0.3, 0.3).unwrap(), 0.01, 0.05, 3).unwrap();
        let near = Footprint::from_width(0.001);
        for i in 0..40_u8 {
            let p = Vec3::new(f32::from(i) * 0.37, 0.1, 0.2);
            let flake = field.flake(p).unwrap();
            assert!(p.distance(flake.center) < 0.01 * 1.5);
            let lit = field.density(flake.normal, p, near);
            assert!(lit > 50.0 * field.ndf().d(flake.normal), "{p}: {lit}");
            assert_eq!(field.density(field.ndf().warp_gaussian(Vec2::splat(5.0)), p, near), 0.0);
        }
    }

    #[test]
    fn nearest_centers_are_in_neighboring_cells() {
        let field = GlintField::new(Ggx::new(0.3, 0.3).unwrap(), 1.0, 0.05, 3).unwrap();
        for i in 0..500_u16 {
            let p = Vec3::new(f32::from(i) * 0.173, f32::from(i) * 0.291 - 70.0, f32::from(i) * 0.117);
            let own = field.flake(p).unwrap().center;
            // No center outside of the 27 cells is nearer than 1.25, measured from the cell of the
            // point.
            assert!(p.distance(own) < 1.25, "{p}: {own}");
        }
    }
}
