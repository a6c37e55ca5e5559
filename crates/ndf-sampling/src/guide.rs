//! A guide table: where to begin to look for a number among sorted ones.

use alloc::vec::Vec;

/// For each of as many equal parts of [0, 1] as there are keys, the key in whose interval it begins.
///
/// Evenly drawn numbers then find their interval in O(1) steps on average, however the keys are spread.
///
/// Chen and Asau 1974, "On Generating Random Variates from an Empirical Distribution".
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Guide {
    starts: Vec<u32>,
}

impl Guide {
    /// The guide to nondecreasing `keys`, the first of which is 0.
    pub(crate) fn new(keys: &[f64]) -> Self {
        let parts = keys.len();
        let mut key = 0;
        let starts = (0..parts).map(|part| {
            let begin = part as f64 / parts as f64;
            while keys.get(key + 1).is_some_and(|&next| next <= begin) {
                key += 1;
            }
            key as u32
        });
        Self { starts: starts.collect() }
    }

    /// The last key that is at most `value`.
    #[inline]
    pub(crate) fn find(&self, keys: &[f64], value: f64) -> usize {
        let part = ((value * self.starts.len() as f64) as usize).min(self.starts.len().saturating_sub(1));
        let start = |part: usize| self.starts.get(part).map(|&start| start as usize);
        let from = start(part).unwrap_or(0);
        let to = start(part + 1).map_or(keys.len(), |start| (start + 2).min(keys.len()));
        let within = keys.get(from..to).unwrap_or_default();
        let after = if within.len() <= 8 {
            within.iter().take_while(|&&key| key <= value).count()
        } else {
            within.partition_point(|&key| key <= value)
        };
        if after > 0 {
            from + after - 1
        } else {
            // The product may have rounded into the next part.
            keys.partition_point(|&key| key <= value).saturating_sub(1)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_interval_is_found() {
        let keys = [0.0, 0.0, 1e-9, 0.3, 0.3, 0.31, 0.999, 1.0];
        let guide = Guide::new(&keys);
        for k in 0..=10_000 {
            let value = f64::from(k) / 10_000.0;
            let expected = keys.iter().filter(|&&key| key <= value).count() - 1;
            assert_eq!(guide.find(&keys, value), expected, "{value}");
        }
    }
}
