//! A guide table: where to begin to look for a number among sorted ones.

use alloc::vec;
use alloc::vec::Vec;

/// For each of equal parts of [0, 1], a power of two and at least twice as many as there are keys, the key in whose interval it
/// begins.
///
/// Evenly drawn numbers then find their interval in O(1) steps on average, however the keys are spread.
///
/// Chen and Asau 1974, "On Generating Random Variates from an Empirical Distribution".
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct GuideTable {
    pub(crate) starts: Vec<u32>,
}

impl GuideTable {
    /// The guide to nondecreasing `keys`, the first of which is 0.
    pub(crate) fn new(keys: &[f64]) -> Self {
        let mut starts = vec![0; (2 * keys.len()).next_power_of_two()];
        let parts = starts.len() as f64;
        for key in keys.iter().skip(1) {
            // The first part that begins after the key: the product is exact.
            if let Some(passed) = starts.get_mut((key * parts) as u32 as usize + 1) {
                *passed += 1;
            }
        }
        let mut passed = 0;
        for start in &mut starts {
            passed += *start;
            *start = passed;
        }
        Self { starts }
    }

    /// The last key that is at most `value`.
    #[inline]
    pub(crate) fn find(&self, keys: &[f64], value: f64) -> usize {
        let part = ((value * self.starts.len() as f64) as usize).min(self.starts.len().saturating_sub(1));
        let mut at = self.starts.get(part).map_or(0, |&start| start as usize);
        // Four at once: whether one of them is passed is never clear before.
        while let Some(next) = keys.get(at + 1..).and_then(|keys| keys.first_chunk::<4>()) {
            let passed = next.iter().map(|&key| usize::from(key <= value)).sum::<usize>();
            at += passed;
            if passed < next.len() {
                return at;
            }
        }
        let rest = keys.get(at + 1..).unwrap_or_default();
        at + rest.iter().take_while(|&&key| key <= value).count()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_interval_is_found() {
        let keys = [0.0, 0.0, 1e-9, 0.3, 0.3, 0.31, 0.999, 1.0];
        let guide = GuideTable::new(&keys);
        for k in 0..=10_000 {
            let value = f64::from(k) / 10_000.0;
            let expected = keys.iter().filter(|&&key| key <= value).count() - 1;
            assert_eq!(guide.find(&keys, value), expected, "{value}");
        }
    }
}
