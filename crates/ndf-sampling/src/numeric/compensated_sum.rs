//! Compensated summation.

/// Neumaier's compensated sum: its error does not grow with the number of terms.
#[derive(Default)]
pub(crate) struct CompensatedSum {
    sum: f64,
    lost: f64,
}

impl CompensatedSum {
    pub(crate) fn add(&mut self, term: f64) {
        // What rounding takes from either, whichever is the larger: Knuth's exact sum of two.
        let sum = self.sum + term;
        let added = sum - self.sum;
        self.lost += (self.sum - (sum - added)) + (term - added);
        self.sum = sum;
    }

    pub(crate) fn value(&self) -> f64 {
        self.sum + self.lost
    }
}

/// Compensated sums in lanes, of terms that are not negative.
#[derive(Clone, Copy)]
pub(crate) struct CompensatedSums<const N: usize> {
    sums: [f64; N],
    lost: [f64; N],
}

impl<const N: usize> Default for CompensatedSums<N> {
    fn default() -> Self {
        Self { sums: [0.0; N], lost: [0.0; N] }
    }
}

impl<const N: usize> CompensatedSums<N> {
    #[inline(always)]
    pub(crate) fn add(&mut self, terms: [f64; N]) {
        for ((before, lost), term) in self.sums.iter_mut().zip(&mut self.lost).zip(terms) {
            let sum = *before + term;
            let (less, more) = if *before < term { (*before, term) } else { (term, *before) };
            // What rounding takes from the lesser, Dekker's exact sum of two: the same number by fewer sums.
            *lost += less - (sum - more);
            *before = sum;
        }
    }

    #[inline(always)]
    pub(crate) fn values(&self) -> [f64; N] {
        core::array::from_fn(|k| self.sums[k] + self.lost[k])
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_terms_survive_a_large_one() {
        let mut sum = CompensatedSum::default();
        for term in [1.0, 1e100, 1.0, -1e100] {
            sum.add(term);
        }
        assert_eq!(sum.value(), 2.0);
    }

    #[test]
    fn lanes_have_the_bits_of_single_sums() {
        let (mut single, mut lanes) = (CompensatedSum::default(), CompensatedSums::<2>::default());
        for k in 0..1000 {
            let term = f64::from(k * 7919 % 1009).powi(9);
            single.add(term);
            lanes.add([term, 2.0 * term]);
            assert_eq!(lanes.values(), [single.value(), 2.0 * single.value()], "{k}");
        }
    }
}
