//! A guide table: starting positions of searches in a sorted list.

use alloc::vec;
use alloc::vec::Vec;

/// For each of equal parts of [0, 1], the key in whose interval the part begins.
///
/// The number of parts is a power of two and at least twice the number of keys.
///
/// Uniform numbers then find their interval in O(1) steps on average, for any spacing of the keys.
///
/// Chen and Asau 1974, "On Generating Random Variates from an Empirical Distribution".
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct GuideTable {
    pub(crate) starts: Vec<u32>,
}

impl GuideTable {
    /// Creates the guide to nondecreasing `keys`, the first of which is 0.
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
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn guide_table_starts() {
        let keys = [0.0, 0.0, 1e-9, 0.3, 0.3, 0.31, 0.999, 1.0];
        let guide = GuideTable::new(&keys);
        for (part, &start) in guide.starts.iter().enumerate() {
            let begin = part as f64 / guide.starts.len() as f64;
            let expected = keys[1..].iter().filter(|&&key| key < begin).count();
            assert_eq!(start as usize, expected, "{begin}");
        }
    }
}
