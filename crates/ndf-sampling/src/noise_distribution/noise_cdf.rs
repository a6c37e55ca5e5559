//! G: maps noise values to uniform and Gaussian numbers by their measured distribution.

use crate::error::NdfError;
use crate::noise_distribution::distribution::NoiseDistribution;
use crate::numeric::normal_distribution::{gaussian_cdf, inverse_gaussian_cdf};

/// The CDF `G` of a noise, linear between the entries of a borrowed table.
///
/// ```text
/// table[k] = G(r_k) = P(noise ≤ r_k),   r_k = low + (high − low) k/(len − 1),   k = 0 … len − 1
/// ```
///
/// Any array will do. The tables that `asperity-noise` has measured for its noises cover ±4
/// standard deviations. For asymmetric sums, such as turbulence, [`NoiseCdfRef::between`] takes
/// both ends.
///
/// If the table is correct, `G(noise)` is uniform on [0, 1] and `Φ⁻¹(G(noise))` is standard
/// Gaussian, the argument of [`Ndf::warp_gaussian`](crate::Ndf::warp_gaussian).
///
/// - **Domain:** all reals. Below `low` the first entry is used, above `high` the last. NaN is read
///   as 0, or as the end nearest to 0.
/// - **Accuracy:** that of the table. An `f32` near 1 has an absolute resolution of 6e-8, so
///   [`invert`](NoiseDistribution::invert) of a table errs by up to 0.002 at `z = 4.5`. Its
///   values end at ±5.29, the quantile of 2⁻²⁴.
///
/// ```
/// use asperity_ndf_sampling::{NoiseCdfRef, NoiseDistribution};
///
/// // A noise that is uniform on ±2.
/// let g = NoiseCdfRef::new(2.0, &[0.0, 0.25, 0.5, 0.75, 1.0])?;
/// assert_eq!(g.cdf(1.0), 0.75);
/// assert_eq!(g.invert(0.0), 0.0);
/// assert_eq!(g.quantile(0.75), 1.0);
/// # Ok::<(), asperity_ndf_sampling::NdfError>(())
/// ```
///
/// Kautz, Heidrich, Seidel 2001, section 4, assumes a Gaussian `G` for every noise. Measured noises
/// differ from it by up to 0.03 in the Kolmogorov–Smirnov distance.
#[derive(Clone, Copy, Debug, PartialEq)]
#[doc(alias = "histogram")]
#[doc(alias = "remap")]
pub struct NoiseCdfRef<'a> {
    low: f32,
    high: f32,
    table: &'a [f32],
}

impl<'a> NoiseCdfRef<'a> {
    /// Creates the distribution from a `table` of values on a uniform grid over ±`range`.
    ///
    /// # Errors
    /// A `range` that is not positive and finite; a table of fewer than two entries; an entry
    /// outside [0, 1] or NaN; an entry below the previous one; equal first and last entries.
    pub fn new(range: f32, table: &'a [f32]) -> Result<Self, NdfError> {
        if range.is_finite() && range > 0.0 {
            Self::between(-range, range, table)
        } else {
            Err(NdfError::Invalid { parameter: "range", value: range, rule: "positive and finite" })
        }
    }

    /// Creates the distribution from a `table` of values on a uniform grid from `low` to `high`.
    ///
    /// # Errors
    /// Ends that are not finite, not increasing, or whose difference overflows `f32`; tables as in
    /// [`NoiseCdfRef::new`].
    ///
    /// ```
    /// use asperity_ndf_sampling::{NoiseCdfRef, NoiseDistribution};
    ///
    /// // Turbulence, a sum of magnitudes, is never negative.
    /// let g = NoiseCdfRef::between(0.0, 2.0, &[0.0, 0.6, 0.9, 1.0])?;
    /// assert_eq!(g.cdf(-1.0), 0.0);
    /// assert!((g.cdf(1.0) - 0.75).abs() < 1e-7);
    /// # Ok::<(), asperity_ndf_sampling::NdfError>(())
    /// ```
    pub fn between(low: f32, high: f32, table: &'a [f32]) -> Result<Self, NdfError> {
        if !(low < high && (high - low).is_finite()) {
            return Err(NdfError::Ends { low, high });
        }
        let (Some(&first), Some(&last), true) = (table.first(), table.last(), table.len() >= 2) else {
            return Err(NdfError::Size {
                parameter: "table.len()",
                value: table.len(),
                min: 2,
                max: usize::MAX,
            });
        };
        let mut previous = 0.0;
        for (index, &value) in table.iter().enumerate() {
            if !(previous..=1.0).contains(&value) {
                return Err(NdfError::Element {
                    parameter: "table",
                    index,
                    value,
                    rule: "in [0, 1] and not below the previous entry",
                });
            }
            previous = value;
        }
        if first == last {
            return Err(NdfError::Invalid { parameter: "table", value: first, rule: "increasing somewhere" });
        }
        Ok(Self { low, high, table })
    }

    fn quantile_f64(self, u: f64) -> f32 {
        let u = if u.is_nan() { 0.5 } else { u };
        let above = self.table.partition_point(|&g| f64::from(g) < u);
        let (Some(below), Some(&g1)) = (above.checked_sub(1), self.table.get(above)) else {
            return if above == 0 { self.low } else { self.high };
        };
        let g0 = f64::from(self.table.get(below).copied().unwrap_or(0.0));
        let k = below as f64 + (u - g0) / (f64::from(g1) - g0);
        let last = (self.table.len() - 1) as f64;
        let (low, high) = (f64::from(self.low), f64::from(self.high));
        (low + (high - low) * (k / last)) as f32
    }

    /// `G(r)` in `f64`: its differences near 1 decide the upper tail.
    fn exact(self, r: f32) -> f64 {
        let r = f64::from(if r.is_nan() { 0.0 } else { r }.clamp(self.low, self.high));
        let last = self.table.len() - 1;
        let (low, high) = (f64::from(self.low), f64::from(self.high));
        let k = (r - low) / (high - low) * last as f64;
        let cell = (k as usize).min(last - 1);
        match self.table.get(cell..) {
            Some(&[g0, g1, ..]) => {
                let (g0, g1) = (f64::from(g0), f64::from(g1));
                g0 + (g1 - g0) * (k - cell as f64)
            }
            _ => 0.5,
        }
    }
}

impl NoiseDistribution for NoiseCdfRef<'_> {
    #[inline]
    fn invert(&self, r: f32) -> f32 {
        const LEAST: f64 = 1.0 / (1u32 << 24) as f64;
        inverse_gaussian_cdf(self.exact(r).clamp(LEAST, 1.0 - LEAST)) as f32
    }

    #[inline]
    fn warp_gaussian(&self, z: f32) -> f32 {
        // In f64, because Φ rounded to f32 would end at z = 5.4 and be coarse long before.
        self.quantile_f64(gaussian_cdf(f64::from(z)))
    }

    #[inline]
    fn cdf(&self, r: f32) -> f32 {
        self.exact(r) as f32
    }

    /// The smallest noise value with `G(r) ≥ u`; the ends of the table beyond its values.
    fn quantile(&self, u: f32) -> f32 {
        self.quantile_f64(f64::from(u))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use asperity_core::assert_abs_diff_eq;

    #[test]
    fn round_trip_of_a_one_sided_table() {
        let g = NoiseCdfRef::between(0.5, 3.0, &[0.0, 0.5, 0.9, 0.95, 1.0, 1.0]).unwrap();
        assert_eq!((g.cdf(f32::NAN), g.cdf(1.25), g.cdf(3.0)), (0.0, 0.7, 1.0));
        assert_eq!((g.quantile(0.5), g.quantile(1.0), g.quantile(0.0)), (1.0, 2.5, 0.5));
        for k in 1..80 {
            let r = 0.5 + 0.025 * k as f32;
            assert_abs_diff_eq!(g.warp_gaussian(g.invert(r)), r, epsilon = 2e-6);
        }
    }

    #[test]
    fn plateaus_and_ends() {
        let g = NoiseCdfRef::new(1.0, &[0.0, 0.25, 0.25, 1.0, 1.0]).unwrap();
        assert_eq!((g.cdf(-9.0), g.cdf(9.0), g.cdf(f32::NAN)), (0.0, 1.0, 0.25));
        assert_eq!((g.cdf(-0.25), g.cdf(f32::INFINITY)), (0.25, 1.0));
        assert_eq!((g.quantile(0.25), g.quantile(1.0), g.quantile(0.0)), (-0.5, 0.5, -1.0));
        assert_eq!((g.quantile(-1.0), g.quantile(2.0)), (-1.0, 1.0));
        assert!(g.invert(9.0) < 5.3 && g.invert(-9.0) > -5.3);
    }
}
