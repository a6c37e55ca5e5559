//! Glints counted by hashes, with the NDF as their mean.

use core::f32::consts::FRAC_PI_3;

use asperity_ndf_sampling::{Frame, Ndf, gaussian_cdf, inverse_gaussian_cdf};
use asperity_noise::{IntegerHash, Lattice};
use glam::{Vec2, Vec3};

use crate::error::ShadingError;
use crate::math::{clamp_to, cos, exp, exp_m1, floor, ln_1p, log2, sin, sqrt};
use crate::parameter::{as_size, within};
use crate::pixel::{Footprint, PixelEllipse};
use crate::reflectance::lobe::CountedFacets;

/// Mirror-like flakes with any NDF, single up close and counted from afar.
///
/// A pixel of width w sees (w/spacing)² flakes. A flake mirrors the light into the pixel if its
/// Gaussian coordinates T⁻¹(m) are in the same bin as those of the half vector. The number of such
/// flakes in a cell of 4ˡ flakes is binomial, drawn by a hash of cell, bin and level:
///
/// ```text
/// D̂(h) = D(h) Σ_bins w(h, bin) count(bin)/(N q(bin)),   count ~ B(N, q),   q(bin) = ∫_bin N(z; 0, I) dz,   Σ w = 1
/// count in a cell, given the coarser one's:   count ~ B(count above, ¼)
/// ```
///
/// and two levels are blended by the logarithm of the width. A pixel that sees at most one flake
/// sees that flake, with the normal that [`flake`](Self::flake) returns.
///
/// The flakes of a cell are those flakes of the coarser cell around it that it contains: a quarter
/// of them on average, drawn by another hash. A distant glint therefore persists in ever smaller
/// cells as the viewer comes closer, down to four flakes. Only the last step, to single flakes,
/// uses different ones.
///
/// - **Energy:** the mean of D̂(h) over the surface is D(h), at every width and for every NDF: E
///   count = N q.
/// - **Far view:** the variance decreases as 1/N, and D̂ tends to D. The smooth lobe of the paint
///   remains, and nothing has to fade.
/// - **Near view:** more flakes become visible as single ones as a pixel sees fewer of them, up to
///   the last. The gaps between sparkles close, which flakes of a fixed width on the screen cannot
///   do.
/// - **Pixels and lights:** [`density`](Self::density) for round pixels and point lights,
///   [`density_over`](Self::density_over) for elongated pixels and lights with a solid angle.
/// - **Domain:** half vectors in the frame of the surface. The result is D where the position is
///   2²³ cells away or not finite, and for widths beyond 2¹⁴ spacings; 0 where D is 0.
///
/// Proposed in Nilsson 2008, §6.3. Bins and binomial counts after Deliot, Belcour 2023, *Real-Time
/// Rendering of Glinty Appearances using Distributed Binomial Laws on Anisotropic Grids*. Here they
/// are in the Gaussian coordinates of the NDF instead of slopes, so any NDF is supported and the
/// mean is exact.
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

/// One flake of a [`GlintField`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GlintFlake {
    /// Its unit normal in the frame of the surface, distributed by the NDF of the field.
    pub normal: Vec3,
    /// A point in it, nearer to it than to any other flake.
    pub center: Vec3,
}

/// The coarsest level: cells of 2²⁸ flakes.
const LEVELS: f32 = 14.0;
/// The expected count from which cells are drawn independently, with a deviation of 6 %.
const CERTAIN: f32 = 256.0;
/// The largest ratio of the axes of a pixel.
const LONGEST: f32 = 16.0;
/// Largest coordinate at which cells can be distinguished.
const FARTHEST: f32 = 8_388_608.0;

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
        let density = self.ndf.d(h);
        if density.is_nan() || density <= 0.0 {
            return 0.0;
        }
        // Both factors are large only where h is not a unit vector.
        (density * self.relative_at(&self.bins(self.ndf.invert(h), 0), position, footprint)).min(f32::MAX)
    }

    /// The density D̂ of the flakes within an elongated pixel that mirror a light of some size, in
    /// sr⁻¹.
    ///
    /// ```text
    /// D̂ = D̄ Σ_k w_k count_k/(N q) / Σ_k w_k,     D̄: the mean of D over the half vectors of the light
    /// w_k = clamp((r + 1)/2 − |k|, 0, 1),         r: ratio of the axes of the pixel
    /// ```
    ///
    /// The pixel is the sum of round ones along its long axis, so it sees the flakes of all of them.
    /// Further ones fade in as the pixel becomes longer. A light wider than a bin uses bins of its own
    /// size, two levels of which are blended.
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
        let z = self.ndf.invert(h);
        // How many times the light is wider than a bin, by the logarithm.
        let level = log2((self.width(h, z, spread) / self.bin).clamp(1.0, 2.0 / self.bin));
        let (lower, upper_share) = (floor(level), level - floor(level));
        let mut relative = self.relative_over(&self.bins(z, lower as u32), position, pixel);
        if upper_share > 0.0 {
            let wider = self.relative_over(&self.bins(z, lower as u32 + 1), position, pixel);
            relative += upper_share * (wider - relative);
        }
        (density * relative).min(f32::MAX)
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
    fn width(&self, h: Vec3, z: Vec2, spread: f32) -> f32 {
        if spread <= 0.0 {
            return 0.0;
        }
        let frame = Frame::from_normal(h);
        // Towards the normal, where there are half vectors above the horizon.
        let inward = |axis: Vec3| if axis.z > 0.0 { axis } else { -axis };
        let [u, v] = [frame.tangent, frame.bitangent]
            .map(|axis| self.ndf.invert((h + spread * inward(axis)).normalize_or_zero()) - z);
        let area = u.perp_dot(v).abs();
        if area.is_finite() { 2.0 * sqrt(area) } else { 0.0 }
    }

    /// The bins around a coordinate, 2ˡ times as wide as those of point lights.
    fn bins(&self, z: Vec2, level: u32) -> Bins {
        let level = level.min(16);
        let seed = if level == 0 { self.seed } else { IntegerHash.word([level as i32], self.seed) };
        Bins::new(z, self.bin * (1_u32 << level) as f32, seed)
    }

    /// The mean of D̂/D over round pixels along the long axis of a pixel.
    fn relative_over(&self, bins: &Bins, position: Vec3, pixel: &PixelEllipse) -> f32 {
        let ([major, _], long, short) = (pixel.axes(), pixel.long().width(), pixel.short().width());
        let width = short.max(long / LONGEST);
        let ratio = long / width;
        // A pixel without axes or bounds is one round pixel.
        if ratio.is_nan() || ratio <= 1.0 || major == Vec3::ZERO || !major.is_finite() {
            return self.relative_at(bins, position, pixel.long());
        }
        let (step, footprint) = (major / ratio, Footprint::from_width(width));
        let (mut sum, mut total) = (0.0, 0.0);
        for k in -8_i8..=8 {
            let weight = (0.5 * (ratio + 1.0) - f32::from(k.abs())).min(1.0);
            if weight > 0.0 {
                sum += weight * self.relative_at(bins, position + f32::from(k) * step, footprint);
                total += weight;
            }
        }
        sum / total
    }

    /// D̂/D of a round pixel.
    fn relative_at(&self, bins: &Bins, position: Vec3, footprint: Footprint) -> f32 {
        let level = log2((footprint.width() / self.spacing).max(1.0));
        let Some(place) = self.place(position).filter(|_| level < LEVELS) else {
            return 1.0;
        };
        let lower = floor(level);
        let upper_share = level - lower;
        let single = (lower == 0.0).then(|| bins.bin(self.tilt(nearest(place, self.seed).0)));
        let base = cell_of(place);
        bins.sum(|bin, q| {
            let own = single.map(|own| if own == bin { 1.0 / q } else { 0.0 });
            if let Some(own) = own.filter(|_| upper_share == 0.0) {
                return own;
            }
            let [fine, coarse] = relative_counts(bins.seed, base, bin, q, lower as i32);
            let fine = own.unwrap_or(fine);
            fine + upper_share * (coarse - fine)
        })
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

/// count/(N q) of a bin in the cells of this level and of the next, around the cell of a single
/// flake.
///
/// Starts at a level where the number is nearly certain, and descends from cell to cell.
fn relative_counts(seed: u32, base: [i32; 3], bin: [i32; 2], q: f32, level: i32) -> [f32; 2] {
    let size = |level: i32| (1_u32 << level) as f32;
    let flakes = |level: i32| size(level) * size(level);
    let seed = IntegerHash.word(bin, seed);
    // The floor of a half is half of the floor.
    let word = |level: i32| IntegerHash.word(base.map(|x| x >> level), seed.wrapping_add(level as u32));
    let drawn = |level: i32| binomial(flakes(level), q, uniform(word(level)));
    // The logarithm of a positive number; its cast is in range.
    let certain = (0.5 * log2(CERTAIN / q) + 1.0) as i32;
    let start = certain.clamp(level, (LEVELS as i32).max(level));
    let mut count = drawn(start);
    let mut coarse = if start == level { drawn(level + 1) / (flakes(level + 1) * q) } else { 0.0 };
    for finer in (level..start).rev() {
        coarse = count / (flakes(finer + 1) * q);
        if count <= 0.0 {
            break;
        }
        count = quarter(count, flakes(finer + 1), word(finer));
    }
    [count / (flakes(level) * q), coarse]
}

/// The cell of a position that is less than 2²³ cells away.
fn cell_of(place: Vec3) -> [i32; 3] {
    place.to_array().map(|x| {
        let whole = x as i32;
        whole - i32::from(whole as f32 > x)
    })
}

/// The jittered center of a cell, in cells.
fn center(cell: [i32; 3], seed: u32) -> Vec3 {
    let word = IntegerHash.word(cell, seed);
    let jitter = [word, word >> 10, word >> 20].map(|w| (w & 1023) as f32 / 2048.0 + 0.25);
    Vec3::from(cell.map(|x| x as f32)) + Vec3::from(jitter)
}

/// The cell of the nearest jittered center, and the center, in cells.
fn nearest(place: Vec3, seed: u32) -> ([i32; 3], Vec3) {
    let base = cell_of(place);
    // No other center is nearer if all possible centers of its cell are farther than the center of
    // the cell of the point. Distant centers are rounded.
    let bound = place.distance_squared(center(base, seed)) * 1.000_1;
    let slack = place.abs().max_element() * f32::EPSILON + 1e-6;
    let squares = core::array::from_fn(|axis| {
        let within = place[axis] - base[axis] as f32;
        let gaps = [within + 0.25, (0.25 - within).max(within - 0.75), 1.25 - within];
        gaps.map(|gap| (gap - slack).max(0.0)).map(|gap| gap * gap)
    });
    let [across, along, up]: [[f32; 3]; 3] = squares;
    let mut best = (f32::INFINITY, base, Vec3::ZERO);
    for (k, up) in (-1..).zip(up) {
        for (j, along) in (-1..).zip(along) {
            for (i, across) in (-1..).zip(across) {
                if across + along + up <= bound {
                    let cell = [base[0] + i, base[1] + j, base[2] + k];
                    let center = center(cell, seed);
                    let distance = place.distance_squared(center);
                    if distance < best.0 {
                        best = (distance, cell, center);
                    }
                }
            }
        }
    }
    (best.1, best.2)
}

impl<N: Ndf> CountedFacets for GlintField<N> {
    fn relative(&self, h: Vec3, position: Vec3, footprint: Footprint) -> f32 {
        let all = self.ndf.d(h);
        if all > 0.0 { self.density(h, position, footprint) / all } else { 0.0 }
    }
}

/// The four bins about a coordinate, each with its weight and the probability of a flake in it.
struct Bins {
    /// The lower bin along each axis.
    low: [f32; 2],
    /// The weight of the upper one.
    upper: [f32; 2],
    /// The probabilities of both along each axis.
    mass: [[f32; 2]; 2],
    width: f32,
    /// The seed of their counts.
    seed: u32,
}

impl Bins {
    fn new(z: Vec2, width: f32, seed: u32) -> Self {
        let place = (z / width - 0.5).to_array();
        let low = place.map(floor);
        let mass = low.map(|k| [k, k + 1.0].map(|k| mass(k, width)));
        let upper = [place[0] - low[0], place[1] - low[1]];
        Self { low, upper, mass, width, seed }
    }

    /// Σ w f(bin, q); a bin that no flake will ever be in has the value 1, its mean.
    fn sum(&self, f: impl Fn([i32; 2], f32) -> f32) -> f32 {
        let mut sum = 0.0;
        for i in 0..2 {
            for j in 0..2 {
                let weight =
                    |axis: usize, k: usize| if k == 1 { self.upper[axis] } else { 1.0 - self.upper[axis] };
                let q = self.mass[0][i] * self.mass[1][j];
                let bin = [self.low[0] as i32 + i as i32, self.low[1] as i32 + j as i32];
                sum += weight(0, i) * weight(1, j) * if q > 1e-25 { f(bin, q) } else { 1.0 };
            }
        }
        sum
    }

    /// The bin of a coordinate.
    fn bin(&self, z: Vec2) -> [i32; 2] {
        (z / self.width).to_array().map(|z| floor(z) as i32)
    }
}

/// The probability that a standard Gaussian number is between `k` and `k + 1` widths.
///
/// ```text
/// w φ(m) Σ_j He_2j(m) (w/2)^2j / (2j + 1)!,   m = (k + ½) w,   He the polynomials of Hermite
/// ```
///
/// up to j = 3 for narrow bins, accurate to 2·10⁻⁸ and the rounding of m².
fn mass(k: f32, width: f32) -> f32 {
    let middle = (k + 0.5) * width;
    if width * (middle.abs() + 2.0) <= 1.0 {
        const FRAC_1_SQRT_2PI: f32 = 0.398_942_3;
        let (m2, w2) = (middle * middle, width * width * 0.25);
        let terms = [m2 - 1.0, (m2 - 6.0) * m2 + 3.0, ((m2 - 15.0) * m2 + 45.0) * m2 - 15.0];
        let series = 1.0 + w2 * (terms[0] / 6.0 + w2 * (terms[1] / 120.0 + w2 * (terms[2] / 5040.0)));
        return width * FRAC_1_SQRT_2PI * exp(-0.5 * m2) * series;
    }
    // The tail on the far side, so that differences of numbers near 1 do not lose it.
    let side = if k < 0.0 { 1.0 } else { -1.0 };
    let [a, b] = [0.0, 1.0].map(|i| gaussian_cdf(f64::from(side * (k + i) * width)));
    (b - a).abs() as f32
}

/// A number in (0, 1).
fn uniform(word: u32) -> f32 {
    (word as f32 + 0.5) / 4_294_967_296.0
}

/// The number of the flakes of a bin, `count` of `n`, in one of four quarters; the mean is a
/// quarter.
///
/// Drawn with 32 random bits.
///
/// By inversion for few flakes, with a non-integer count rounded up or down at random. Otherwise a
/// number with the mean and the variance of drawing without replacement, from the sum of four
/// bytes.
fn quarter(count: f32, n: f32, word: u32) -> f32 {
    let mean = 0.25 * count;
    if mean > 16.0 {
        /// Standard deviation of the sum of four bytes: `√(4 (256² − 1)/12)`.
        const DEVIATION: f32 = 147.801;
        let sum: i32 = word.to_le_bytes().into_iter().map(i32::from).sum();
        // At most 3.5 standard deviations, which are at most 4 √mean.
        return mean + sqrt((0.75 * mean * (1.0 - count / n)).max(0.0)) / DEVIATION * (sum - 510) as f32;
    }
    // Twelve bits for one, twenty for the other.
    let whole = floor(count + ((word & 0xfff) as f32 + 0.5) / 4096.0);
    if whole > 0.0 { binomial(whole, 0.25, ((word >> 12) as f32 + 0.5) / 1_048_576.0) } else { 0.0 }
}

/// A number of successes of `n` trials of probability `q`, with the mean `n q`.
///
/// From a uniform number in (0, 1).
///
/// By inversion up to 16 expected successes. Beyond, a Gaussian of the same mean and variance,
/// truncated at the same distance on both sides, which keeps the mean. It is not an integer.
fn binomial(n: f32, q: f32, uniform: f32) -> f32 {
    let mean = n * q;
    if mean > 16.0 {
        let deviation = sqrt(mean * (1.0 - q));
        let z = inverse_gaussian_cdf(f64::from(uniform)) as f32;
        let most = (mean / deviation).min(4.0);
        return mean + deviation * z.clamp(-most, most);
    }
    let log = ln_1p(-q);
    // P(count > k), from above: small probabilities keep their digits.
    let mut above = -exp_m1(n * log);
    let mut chance = mean * exp((n - 1.0) * log);
    let mut k = 0.0;
    while uniform < above && k < 64.0 {
        k += 1.0;
        above -= chance;
        chance *= (n - k) / (k + 1.0) * q / (1.0 - q);
    }
    k
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;
    use asperity_ndf_sampling::{Beckmann, Ggx};

    #[test]
    fn binomial_has_mean_and_variance() {
        for (n, q) in [(4.0, 0.3), (16.0, 1e-3), (1024.0, 4e-4), (4096.0, 0.01), (65_536.0, 0.1)] {
            let count = 20_000;
            let (mut sum, mut squares) = (0.0, 0.0);
            for i in 0..count {
                let k = f64::from(binomial(n, q, (f32::from(i as u16) + 0.5) / count as f32));
                sum += k;
                squares += k * k;
            }
            let mean = sum / f64::from(count);
            let variance = squares / f64::from(count) - mean * mean;
            let expected = f64::from(n * q);
            // Equally spaced numbers: only the last steps are truncated.
            assert_abs_diff_eq!(mean / expected, 1.0, epsilon = 2e-3, "{n}, {q}");
            assert_abs_diff_eq!(variance / (expected * f64::from(1.0 - q)), 1.0, epsilon = 0.01, "{n}, {q}");
        }
    }

    #[test]
    fn density_is_finite_for_vectors_of_any_length() {
        let field = GlintField::new(Beckmann::new_clamped(0.3, 0.3), 1_208.794_2, 0.756_862_7, 3_250_700_737);
        let (field, tiny) = (field.unwrap(), 3e-45);
        let at = Vec3::new(-16_777_213.0, tiny, tiny);
        let density = field.density(Vec3::new(tiny, -1e-45, tiny), at, Footprint::from_width(tiny));
        assert!(density > 1e38 && density.is_finite(), "{density}");
    }

    #[test]
    fn quarter_has_a_mean_of_one_quarter() {
        for (count, n) in [(1.0, 64.0), (3.4, 64.0), (40.0, 1e4), (64.0, 1e4), (65.0, 1e4), (900.5, 4e3)] {
            let (mut sum, mut squares) = (0.0, 0.0);
            for i in 0..10_000_u16 {
                let k = f64::from(quarter(count, n, IntegerHash.word([i32::from(i)], 5)));
                sum += k / 1e4;
                squares += k * k / 1e4;
            }
            let (mean, variance) = (f64::from(0.25 * count), f64::from(0.1875 * count));
            // Four standard errors.
            assert_abs_diff_eq!(sum, mean, epsilon = 0.04 * (variance + 0.03).sqrt(), "{count}");
            // Within the effect of missing replacement and rounding.
            assert!((squares - sum * sum) < 1.2 * variance + 0.03, "{count}: {}", squares - sum * sum);
            assert!((squares - sum * sum) > 0.7 * variance, "{count}: {}", squares - sum * sum);
        }
    }

    #[test]
    fn flakes_of_a_cell_belong_to_the_coarser_cell() {
        let field = GlintField::new(Ggx::new(0.3, 0.3).unwrap(), 1.0, 0.1, 3).unwrap();
        let mut lit = [0, 0];
        for i in 0..4000_u16 {
            let p = Vec3::new(f32::from(i) * 7.3, f32::from(i % 61) * 11.9, 0.4);
            let cell = cell_of(p);
            for level in 0..13 {
                let [fine, coarse] = relative_counts(field.seed, cell, [2, -1], 0.002, level);
                let again = relative_counts(field.seed, cell, [2, -1], 0.002, level + 1);
                // Nothing is discontinuous where a level ends.
                assert_eq!(coarse, again[0], "{p}, {level}");
                lit[0] += u32::from(fine > 0.0);
                lit[1] += u32::from(fine > 0.0 && coarse > 0.0);
            }
        }
        assert!(lit[0] > 200 && lit[0] == lit[1], "{lit:?}");
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
    fn mass_is_the_difference_of_phi_at_the_ends() {
        for (width, k) in
            [0.001, 0.03, 0.1, 0.3, 0.49, 1.0].into_iter().flat_map(|w| (-60..60).map(move |k| (w, k as f32)))
        {
            let ends = [k, k + 1.0].map(|k| gaussian_cdf(-(f64::from(k) * f64::from(width)).abs()));
            let exact = if k < 0.0 { ends[1] - ends[0] } else { ends[0] - ends[1] };
            if exact > 1e-25 {
                let relative = f64::from(mass(k, width)) / exact.abs() - 1.0;
                // A rounding of the middle m, by dφ/φ = m² of it, and a few of the result; the
                // difference itself has 1e-15 of its ends.
                let m2 = f64::from((k + 0.5) * width).powi(2);
                let bound = 6e-8 * (m2 + 4.0) + 3e-16 * ends[0] / exact.abs();
                assert!(relative.abs() < bound, "{k}, {width}: {relative:e} of {bound:e}");
            }
        }
    }

    #[test]
    fn nearest_finds_the_nearest_of_27_centers() {
        for i in 0..3000_u16 {
            // The last ones are where the rounding of positions is an eighth of a cell.
            let far = if i < 2000 { 1.0 } else { 50_000.0 };
            let place =
                Vec3::new(f32::from(i) * 0.173, f32::from(i % 97) * 0.291 - 70.0, f32::from(i % 31) * 0.37)
                    * far;
            let base = cell_of(place);
            let around = (0..27).map(|k| [base[0] + k % 3 - 1, base[1] + k / 3 % 3 - 1, base[2] + k / 9 - 1]);
            let distances = around.map(|cell| (place.distance_squared(center(cell, 3)), cell));
            let best = distances.reduce(|best, next| if next.0 < best.0 { next } else { best }).unwrap();
            assert_eq!(nearest(place, 3), (best.1, center(best.1, 3)), "{place}");
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
