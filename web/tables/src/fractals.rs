//! Fractal interpolation functions as curves with bounds.
//!
//! A function is encoded as the number of its knots, their abscissas, their ordinates and the
//! vertical factors.

use alloc::{string::String, string::ToString, vec::Vec};

use asperity_fif::Fif;

use crate::number;

/// Converts an error to the crate's message.
pub(crate) fn told(error: impl ToString) -> String {
    error.to_string()
}

/// Parses a function through knots, and returns the numbers that follow.
pub(crate) fn knots(numbers: &[f64]) -> ([&[f64]; 3], &[f64]) {
    let count = number(numbers, 0) as usize;
    let lists = numbers.get(1..).unwrap_or_default();
    let (x, rest) = lists.split_at(count.min(lists.len()));
    let (y, rest) = rest.split_at(count.min(rest.len()));
    let (factors, rest) = rest.split_at(count.saturating_sub(1).min(rest.len()));
    ([x, y, factors], rest)
}

/// Returns the function, or its integral from 0.
pub(crate) fn function(order: f64, [x, y, factors]: [&[f64]; 3]) -> Result<Fif<3>, String> {
    let f = Fif::<2>::affine(x, y, factors).map_err(told)?;
    if order > 0.0 {
        return f.integral(0.0).map_err(told);
    }
    let parabolas: Vec<_> =
        f.pieces().iter().map(|piece| [piece.map().q[0], piece.map().q[1], 0.0]).collect();
    Fif::with_ordinates(x, y, factors, &parabolas).map_err(told)
}

/// Encodes 64-bit numbers as words.
pub(crate) fn words(numbers: &[f64]) -> Vec<u32> {
    numbers.iter().flat_map(|x| [x.to_bits() as u32, (x.to_bits() >> 32) as u32]).collect()
}

/// Returns the minimum and the maximum of several values in each column of an interval. Arguments:
/// order of integration, ends of the interval, number of columns, tolerance, function. Values
/// outside the domain are NaN.
pub(crate) fn fractal_curve(numbers: &[f64], _: &[u32]) -> Result<Vec<u32>, String> {
    const SAMPLES: u32 = 6;
    let lists = knots(numbers.get(5..).unwrap_or_default()).0;
    let f = function(number(numbers, 0), lists)?;
    let (from, to, columns) = (number(numbers, 1), number(numbers, 2), number(numbers, 3).min(4096.0));
    let at = |k: u32| from + (to - from) * (f64::from(k) / (columns * f64::from(SAMPLES)));
    let mut answer = Vec::new();
    for column in 0..columns as u32 {
        // Columns share the values between them. A rough curve has its knots on spikes that are
        // narrower than the sample distance.
        let ends = at(SAMPLES * column)..=at(SAMPLES * (column + 1));
        let spikes = lists[0].iter().copied().filter(|x| ends.contains(x));
        let samples = (0..=SAMPLES).map(|k| at(SAMPLES * column + k));
        let values = samples.chain(spikes).filter(|x| f.domain().contains(*x));
        let values = values.map(|x| f.evaluate(x, number(numbers, 4)).value);
        let range = values.fold([f64::NAN; 2], |[lo, hi], y| [y.min(lo), y.max(hi)]);
        answer.extend(range);
    }
    Ok(words(&answer))
}

/// Returns an enclosure of the values over an interval, with each end within a width of the
/// optimum. Arguments: order of integration, ends of the interval, width, function.
pub(crate) fn fractal_bounds(numbers: &[f64], _: &[u32]) -> Result<Vec<u32>, String> {
    let f = function(number(numbers, 0), knots(numbers.get(4..).unwrap_or_default()).0)?;
    let range = f.enclosure(number(numbers, 1), number(numbers, 2), number(numbers, 3));
    Ok(range.map_or_else(Vec::new, |range| words(&[range.lo, range.hi])))
}

/// Returns properties of a function: brackets of minimum and maximum with their positions, the
/// integral, a bracket of the dimension. Arguments: order of integration, function.
pub(crate) fn fractal_facts(numbers: &[f64], _: &[u32]) -> Result<Vec<u32>, String> {
    let f = function(number(numbers, 0), knots(numbers.get(1..).unwrap_or_default()).0)?;
    let size = f.range().magnitude();
    let extrema = f.extrema(1e-6 * size);
    let dimension = f.dimension();
    Ok(words(&[
        extrema.minimum.lo,
        extrema.minimum.hi,
        extrema.at_minimum.middle(),
        extrema.maximum.lo,
        extrema.maximum.hi,
        extrema.at_maximum.middle(),
        f.total_integral(),
        dimension.lo,
        dimension.hi,
    ]))
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;

    pub(crate) const F: [f64; 9] = [3.0, 0.0, 1.0, 2.0, 0.0, 1.0, 0.0, 0.5, 0.5];

    pub(crate) fn doubles(words: &[u32]) -> Vec<f64> {
        words.chunks(2).map(|w| f64::from_bits(u64::from(w[0]) | u64::from(w[1]) << 32)).collect()
    }

    #[test]
    fn curve_columns_contain_its_values() {
        let numbers = [&[0.0, -0.5, 2.0, 250.0, 1e-6], F.as_slice()].concat();
        let ends = doubles(&fractal_curve(&numbers, &[]).unwrap());
        assert!(ends[0].is_nan() && ends.len() == 500);
        let top = ends.iter().fold(0.0, |top: f64, x| top.max(*x));
        assert!((top - 4.0 / 3.0).abs() < 1e-3, "{top}");
        let facts = doubles(&fractal_facts(&[&[0.0], F.as_slice()].concat(), &[]).unwrap());
        assert!((facts[4] - 4.0 / 3.0).abs() < 2e-6 && (facts[6] - 2.0).abs() < 1e-12, "{facts:?}");
    }

    #[test]
    fn rough_curve_reaches_its_knots() {
        let rough = [4.0, 0.0, 1.0, 2.0, 3.0, 0.0, 1.0, 0.0, 1.0, 0.7, 0.7, 0.7];
        let numbers = [&[0.0, -0.0101, 3.0499, 50.0, 1e-9], rough.as_slice()].concat();
        let ends = doubles(&fractal_curve(&numbers, &[]).unwrap());
        for (x, y) in [(0.0, 0.0), (1.0, 1.0), (2.0, 0.0), (3.0, 1.0)] {
            let column = ((x + 0.0101) / 3.06 * 50.0) as usize;
            let [low, high] = [ends[2 * column], ends[2 * column + 1]];
            assert!(low <= y + 1e-6 && y - 1e-6 <= high, "{x}: {low} to {high}");
        }
    }

    #[test]
    fn factor_of_1_returns_the_crate_message() {
        let mut steep = F;
        steep[8] = 1.0;
        let error = fractal_facts(&[&[0.0], steep.as_slice()].concat(), &[]).unwrap_err();
        assert!(error.lines().count() == 1 && error.contains('1'), "{error}");
        assert!(fractal_facts(&[], &[]).is_err());
    }
}
