//! Scaling of oscillations of data: box dimension and multifractal spectrum of a series or an
//! image.

use asperity_core::math::{ln_f64, pow_f64, sqrt_f64};

/// A power law fitted to data: its exponent and the quality of the fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scaling {
    /// The exponent, or the dimension computed from it.
    pub value: f64,
    /// Standard error of the slope over the scales; errors common to all scales are not included.
    pub error: f64,
    /// The smallest and the largest blocks of the fit, in samples along a side.
    pub scales: [usize; 2],
}

/// Minimum number of blocks along the data at the largest scale of the fit.
const FEWEST: usize = 8;

/// Maximum number of scales; blocks are powers of two.
const SCALES: usize = usize::BITS as usize;

/// The box-counting dimension of the graph of a series, or of an image as a height field.
///
/// ```text
/// D = 1 − τ(1)        N(s) = Σ_blocks oscillation/s ~ s^{−D}
/// ```
///
/// Boxes over a block are counted by the height that they fill, so the unit of the heights cancels.
/// For a series of Hurst exponent H the dimension is 2 − H, for an image 3 − H. For samples of a
/// fractal interpolation function it equals [`System::dimension`](crate::System::dimension) within
/// the errors of [`oscillation_exponent`], whose requirements apply.
///
/// Dubuc, Quiniou, Roques-Carmes, Tricot, Zucker, *Evaluating the fractal dimension of profiles*,
/// Physical Review A 39, 1989.
///
/// ```
/// use asperity_fif::{box_dimension, cochran_2000};
/// let g = cochran_2000::g()?;
/// let mut samples = [0.0; 4097];
/// g.grid(&mut samples).unwrap();
/// let measured = box_dimension(&samples, samples.len()).unwrap();
/// assert!((measured.value - g.dimension().middle()).abs() < 0.05);
/// # Ok::<(), asperity_fif::FifError>(())
/// ```
#[doc(alias = "hurst")]
#[doc(alias = "minkowski")]
#[must_use]
pub fn box_dimension(values: &[f64], columns: usize) -> Option<Scaling> {
    let scaling = oscillation_exponent(values, columns, 1.0)?;
    Some(Scaling { value: 1.0 - scaling.value, ..scaling })
}

#[doc = include_str!("../../docs/oscillation.md")]
#[doc(alias = "multifractal")]
#[must_use]
pub fn oscillation_exponent(values: &[f64], columns: usize, q: f64) -> Option<Scaling> {
    let rows = values.len().checked_div(columns)?;
    let whole = rows * columns == values.len() && q.is_finite() && values.iter().all(|v| v.is_finite());
    let side = if rows == 1 { columns } else { rows.min(columns) }.saturating_sub(1);
    if !whole || side < FEWEST * FEWEST {
        return None;
    }
    let count = (side / FEWEST).ilog2() as usize + 1;
    let scales = || (0..count).map(|k| 1_usize << k);
    let mut means = [0.0; SCALES];
    for (mean, scale) in means.iter_mut().zip(scales()) {
        *mean = moment(values, [rows, columns], scale, [0.0, 1.0]);
    }
    // The part missed by the samples cancels in the differences, a s^H (2^H − 1).
    let rises = || means.iter().zip(means.iter().skip(1)).take(count - 1).map(|(a, b)| b - a);
    let [hurst, _] = slope(scales().zip(rises()))?;
    let growth = pow_f64(2.0, hurst) - 1.0;
    let missed =
        means.iter().zip(rises()).take(4).map(|(mean, rise)| 0.25 * (rise / growth - mean)).sum::<f64>();
    let missed = if missed > 0.0 && missed.is_finite() { missed } else { 0.0 };
    let moments = scales().map(|scale| (scale, moment(values, [rows, columns], scale, [missed, q])));
    let [rise, error] = slope(moments)?;
    let plane = if rows == 1 { 1.0 } else { 2.0 };
    Some(Scaling { value: rise - plane, error, scales: [1, 1 << (count - 1)] })
}

/// The slope of `ln y` over `ln x`, and its standard error; `None` unless all are positive.
fn slope(points: impl Iterator<Item = (usize, f64)>) -> Option<[f64; 2]> {
    let (mut count, mut sums) = (0.0, [0.0_f64; 5]);
    for (x, y) in points {
        let (x, y) = (ln_f64(x as f64), if y > 0.0 { ln_f64(y) } else { return None });
        for (sum, term) in sums.iter_mut().zip([x, y, x * x, x * y, y * y]) {
            *sum += term;
        }
        count += 1.0;
    }
    let [x, y, xx, xy, yy] = sums.map(|sum| sum / count);
    let (spread, slope) = (xx - x * x, (xy - x * y) / (xx - x * x));
    let left = (yy - y * y - slope * slope * spread).max(0.0);
    (slope.is_finite() && left.is_finite()).then(|| [slope, sqrt_f64(left / ((count - 2.0) * spread))])
}

/// The mean over whole blocks of the q-th powers of the oscillations, corrected for the part missed
/// by samples.
fn moment(values: &[f64], [rows, columns]: [usize; 2], scale: usize, [missed, q]: [f64; 2]) -> f64 {
    let down = if rows == 1 { 0 } else { scale };
    let (across, along) = ((columns - 1) / scale, ((rows - 1) / scale).max(1));
    let mut sum = 0.0;
    for (i, j) in (0..along).flat_map(|i| (0..across).map(move |j| (i, j))) {
        let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
        for row in i * down..=i * down + down {
            let start = row * columns + j * scale;
            for &value in values.get(start..=start + scale).unwrap_or_default() {
                least = if value < least { value } else { least };
                most = if value > most { value } else { most };
            }
        }
        let oscillation = most - least + missed;
        if oscillation > 0.0 {
            sum += if q == 1.0 { oscillation } else { pow_f64(oscillation, q) };
        }
    }
    sum / (along * across) as f64
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn box_dimension_of_a_line_and_a_plane() {
        let line: [f64; 300] = core::array::from_fn(|i| i as f64);
        let measured = box_dimension(&line, 300).unwrap();
        assert!((measured.value - 1.0).abs() < 1e-12 && measured.error < 1e-6, "{measured:?}");
        let plane: alloc::vec::Vec<f64> =
            (0..300 * 260).map(|i| f64::from(i / 300) + f64::from(i % 300)).collect();
        let measured = box_dimension(&plane, 300).unwrap();
        assert!((measured.value - 2.0).abs() < 1e-12, "{measured:?}");
        assert!((oscillation_exponent(&plane, 300, 0.0).unwrap().value + 2.0).abs() < 1e-12);
    }

    #[test]
    fn oscillation_exponent_of_degenerate_data_is_none() {
        let line: [f64; 300] = core::array::from_fn(|i| i as f64);
        let mut broken = line;
        broken[7] = f64::NAN;
        for (values, columns, q) in [
            (&line[..], 0, 1.0),
            (&line[..], 7, 1.0),
            (&line[..], 150, 1.0),
            (&line[..64], 64, 1.0),
            (&line[..], 300, f64::NAN),
            (&broken[..], 300, 1.0),
            (&[1.0; 300][..], 300, 1.0),
            (&[], 300, 1.0),
        ] {
            assert_eq!(oscillation_exponent(values, columns, q), None, "{columns} {q}");
        }
        assert!(box_dimension(&line[..65], 65).is_some());
    }
}
